//! No circle of files: a reader can begin with a file that names nothing of another, and go on. What a file names counts: types, functions, modules. A method
//! of a type that is implemented in several files is not followed to the file that has it.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A module's or an item's names from the crate's root.
type Names = Vec<String>;

/// References of a file to other modules.
#[derive(Default)]
struct Said {
    /// every path it uses, as far as it lies in the crate
    used: Vec<Names>,
    /// names that it has from elsewhere, and where those are
    imported: BTreeMap<String, Names>,
    /// what it names by them, or by its own
    named: Vec<Names>,
}

/// The files of a crate that lie on circles: each uses another of them, and is used by one. What only a test uses does not count, nor does a name that is
/// passed on by `pub use`: who uses it, uses the file that has it.
fn on_circles(files: &BTreeMap<Names, String>) -> BTreeSet<String> {
    let said: BTreeMap<&Names, Said> = files.iter().map(|(module, text)| (module, Said::by(module, text, files))).collect();
    let mut uses: BTreeMap<&Names, BTreeSet<&Names>> = BTreeMap::new();
    for (module, own) in &said {
        let others = own.used.iter().filter_map(|path| holder(path, &said, 0)).filter(|other| other != module);
        uses.insert(module, others.collect());
    }
    // whatever uses none of those that are left, or is used by none of them, lies on no circle
    loop {
        let left: BTreeSet<&Names> = uses.keys().copied().collect();
        let used: BTreeSet<&Names> = uses.values().flatten().copied().collect();
        uses.values_mut().for_each(|others| others.retain(|other| left.contains(other)));
        uses.retain(|module, others| !others.is_empty() && used.contains(module));
        if uses.len() == left.len() {
            return left.iter().map(|module| module.join("::")).collect();
        }
    }
}

/// The file that holds what a path names.
fn holder<'a>(path: &[String], said: &BTreeMap<&'a Names, Said>, passed_on: usize) -> Option<&'a Names> {
    let (module, own) = (0..=path.len()).rev().find_map(|end| said.get_key_value(&path[..end].to_vec()))?;
    let Some(name) = path.get(module.len()) else { return Some(module) };
    match own.imported.get(name) {
        Some(from) if passed_on < 10 => holder(&[from, &path[module.len() + 1..]].concat(), said, passed_on + 1),
        _ => Some(module),
    }
}

impl Said {
    fn by(module: &Names, text: &str, files: &BTreeMap<Names, String>) -> Self {
        let mut said = Self::default();
        let tokens: TokenStream = text.parse().unwrap_or_else(|error| panic!("{}: {error}", module.join("::")));
        said.read(module, tokens, files);
        // what it passes on, it may use itself
        let by_name = |path: &Names| Some([said.imported.get(&path[0])?, &path[1..]].concat());
        let by_name: Vec<Names> = said.named.iter().filter_map(by_name).collect();
        said.used.extend(by_name);
        said
    }

    fn read(&mut self, module: &Names, tokens: TokenStream, files: &BTreeMap<Names, String>) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let (mut at, mut public) = (0, false);
        while at < tokens.len() {
            match &tokens[at] {
                TokenTree::Punct(sign) if sign.as_char() == '#' && is_of_tests(tokens.get(at + 1)) => {
                    at = end_of_item(&tokens, at + 2);
                    public = false;
                    continue;
                }
                TokenTree::Ident(word) if word == "mod" && matches!(tokens.get(at + 2), Some(TokenTree::Group(_))) => {
                    let inside = [module.clone(), vec![tokens[at + 1].to_string()]].concat();
                    let TokenTree::Group(body) = &tokens[at + 2] else { continue };
                    self.read(&inside, body.stream(), files);
                    (at, public) = (at + 2, false);
                }
                // `use<'a>` is a bound
                TokenTree::Ident(word) if word == "use" && !is(&tokens, at + 1, '<') => {
                    let end = (at..tokens.len()).find(|&n| is(&tokens, n, ';')).unwrap_or(tokens.len());
                    for (path, name) in tree(&tokens[at + 1..end], &[]) {
                        let Some(path) = absolute(module, &path, files) else { continue };
                        self.imported.insert(name, path.clone());
                        if !public {
                            self.used.push(path);
                        }
                    }
                    (at, public) = (end, false);
                }
                TokenTree::Ident(word) if word == "pub" => {
                    public = true;
                    at += usize::from(matches!(tokens.get(at + 1), Some(TokenTree::Group(_))));
                }
                TokenTree::Ident(_) => {
                    let (path, end) = path(&tokens, at);
                    let is_whole = path.len() > 1 || is_named(&tokens, at);
                    (at, public) = (end - 1, false);
                    if path.len() > 1
                        && let Some(path) = absolute(module, &path, files)
                    {
                        self.used.push(path);
                    } else if is_whole {
                        self.named.push(path);
                    }
                }
                TokenTree::Group(group) => {
                    self.read(module, group.stream(), files);
                    public = false;
                }
                TokenTree::Punct(_) | TokenTree::Literal(_) => public = false,
            }
            at += 1;
        }
    }
}

/// Whether a lone word names an item: a type, or a function that is called.
fn is_named(tokens: &[TokenTree], at: usize) -> bool {
    let word = tokens[at].to_string();
    let is_before = |what: &str| at > 0 && tokens[at - 1].to_string() == what;
    let called = matches!(tokens.get(at + 1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
    !is_before(".") && !is_before("fn") && (word.starts_with(char::is_uppercase) || called)
}

/// Whether an attribute is `[cfg(test)]`.
fn is_of_tests(attribute: Option<&TokenTree>) -> bool {
    attribute.is_some_and(|attribute| attribute.to_string().replace(' ', "") == "[cfg(test)]")
}

/// The place behind the item that begins at a place.
fn end_of_item(tokens: &[TokenTree], from: usize) -> usize {
    let is_use = |n: usize| matches!(&tokens[n], TokenTree::Ident(word) if word == "use");
    let import = (from..tokens.len()).take(3).any(is_use);
    let is_body = |n: usize| matches!(&tokens[n], TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
    // a field, or an arm of a match
    let of_item = |n: usize| {
        ["fn", "mod", "use", "impl", "struct", "enum", "const", "static", "trait", "type"]
            .contains(&tokens[n].to_string().as_str())
    };
    let lone = !(from..tokens.len()).take(4).any(of_item);
    let ends = |n: &usize| is(tokens, *n, ';') || lone && is(tokens, *n, ',') || !import && is_body(*n);
    (from..tokens.len()).find(ends).map_or(tokens.len(), |n| n + 1)
}

fn is(tokens: &[TokenTree], at: usize, sign: char) -> bool {
    matches!(tokens.get(at), Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

/// The path that begins at a place, and the place behind it.
fn path(tokens: &[TokenTree], from: usize) -> (Names, usize) {
    let (mut names, mut at) = (Names::new(), from);
    while let Some(TokenTree::Ident(name)) = tokens.get(at) {
        names.push(name.to_string());
        at += 1;
        if !(is(tokens, at, ':') && is(tokens, at + 1, ':') && matches!(tokens.get(at + 2), Some(TokenTree::Ident(_)))) {
            break;
        }
        at += 2;
    }
    (names, at)
}

/// The paths of what stands behind `use`, each with the name that it has here.
fn tree(tokens: &[TokenTree], before: &[String]) -> Vec<(Names, String)> {
    let (names, at) = path(tokens, 0);
    let mut whole = [before, &names].concat();
    // a list stands behind `::` or alone
    let list = tokens[at..].iter().find_map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group),
        _ => None,
    });
    if let Some(list) = list {
        return in_list(list).iter().flat_map(|one| tree(one, &whole)).collect();
    }
    if whole.last().is_some_and(|last| last == "self") {
        whole.pop();
    }
    let renamed = matches!(tokens.get(at), Some(TokenTree::Ident(word)) if word == "as").then(|| tokens[at + 1].to_string());
    let name = renamed.or_else(|| whole.last().cloned());
    name.map(|name| (whole, name)).into_iter().collect()
}

fn in_list(list: &Group) -> Vec<Vec<TokenTree>> {
    let tokens: Vec<TokenTree> = list.stream().into_iter().collect();
    let is_comma = |token: &TokenTree| matches!(token, TokenTree::Punct(sign) if sign.as_char() == ',');
    tokens.split(is_comma).filter(|one| !one.is_empty()).map(<[TokenTree]>::to_vec).collect()
}

/// A path from the crate's root; `None` if it leads out of the crate.
fn absolute(module: &Names, path: &[String], files: &BTreeMap<Names, String>) -> Option<Names> {
    let mut above = module.clone();
    match path[0].as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([&above, &path[1..]].concat()),
        "super" => {
            let up = path.iter().take_while(|name| *name == "super").count();
            above.truncate(above.len().checked_sub(up)?);
            Some([&above, &path[up..]].concat())
        }
        child => {
            let whole = [&above, path].concat();
            above.push(child.to_owned());
            files.contains_key(&above).then_some(whole)
        }
    }
}

/// Every source file below a folder with its module.
fn modules(folder: &Path, module: &Names, all: &mut BTreeMap<Names, String>) {
    for entry in std::fs::read_dir(folder).expect("a folder of sources") {
        let file = entry.expect("a file").path();
        let name = file.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
        let inside = || [module.clone(), vec![name.clone()]].concat();
        if file.is_dir() {
            modules(&file, &inside(), all);
        } else if file.extension().is_some_and(|end| end == "rs") {
            // beside a library, its program is a crate of its own
            let alone = name == "main" && folder.join("lib.rs").is_file();
            let own = if ["mod", "lib", "main"].contains(&name.as_str()) { module.clone() } else { inside() };
            if !alone {
                all.insert(own, std::fs::read_to_string(&file).expect("text"));
            }
        }
    }
}

#[test]
fn no_crate_has_a_circle_of_files() {
    let root: PathBuf = [env!("CARGO_MANIFEST_DIR"), ".."].iter().collect();
    let crates = std::fs::read_dir(root.join("crates")).expect("crates").map(|entry| entry.expect("a crate").path());
    let mut seen = 0;
    for folder in crates.chain([root.join("xtask"), root.join("python")]) {
        let mut files = BTreeMap::new();
        modules(&folder.join("src"), &Names::new(), &mut files);
        let circles = on_circles(&files);
        assert!(circles.is_empty(), "{}: files that use one another: {circles:?}", folder.display());
        seen += files.len();
    }
    assert!(seen > 300, "{seen}");
}

#[test]
fn a_circle_of_names_is_seen_however_they_are_written() {
    let files = |texts: &[(&str, &str)]| -> BTreeMap<Names, String> {
        let names = |path: &str| path.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect();
        texts.iter().map(|(path, text)| (names(path), (*text).to_owned())).collect()
    };
    let line = [
        ("", "mod a; mod b; pub use b::B;"),
        ("a", "use crate::B;"),
        ("b", "pub struct B; #[cfg(test)] mod tests { use crate::a; }"),
    ];
    assert_eq!(on_circles(&files(&line)), BTreeSet::new());
    let both: BTreeSet<String> = ["a", "b"].map(String::from).into();
    for back in
        ["use super::a::A;", "use crate::{a::{A, C}, D};", "fn f() { page! { (crate::a::f()) } }", "type A = super::a::A;"]
    {
        let circle = [("", "mod a; mod b; pub use b::B as C;"), ("a", "use crate::C;"), ("b", back)];
        assert_eq!(on_circles(&files(&circle)), both, "{back}");
    }
    // a folder's own file, and one in it
    let folder = [("", "mod a;"), ("a", "mod b; fn f() { b::g() }"), ("a::b", "use super::f;")];
    assert_eq!(on_circles(&files(&folder)), ["a", "a::b"].map(String::from).into());
}
