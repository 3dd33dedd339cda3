//! All mutants of a file in one text: a switch beside each says whether it acts.

use std::collections::BTreeMap;
use std::ops::Range;

use proc_macro2::Span;
use proof::Failure;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use super::list::{Genre, Mutant};

/// The switches, put behind the crate's own text. `FOGCOIL_MUTANT` names the one that acts; `FOGCOIL_REACHED` a file to which the switches that are asked are added.
pub(super) const SWITCHES: &str = r#"
#[doc(hidden)]
#[allow(missing_docs, unreachable_pub, dead_code)]
pub mod woven {
    use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

    const UNREAD: u32 = u32::MAX;
    const TRACED: u32 = u32::MAX - 1;
    static ACTS: AtomicU32 = AtomicU32::new(UNREAD);
    static ASKED: [AtomicBool; 1 << 14] = [const { AtomicBool::new(false) }; 1 << 14];

    #[inline]
    pub fn on(id: u32) -> bool {
        let acts = ACTS.load(Ordering::Relaxed);
        if acts < TRACED { acts == id } else { asked(acts, id) }
    }

    fn asked(acts: u32, id: u32) -> bool {
        if acts == UNREAD {
            let named = std::env::var("FOGCOIL_MUTANT").ok().and_then(|id| id.parse().ok()).unwrap_or(TRACED - 1);
            ACTS.store(if std::env::var_os("FOGCOIL_REACHED").is_some() { TRACED } else { named }, Ordering::Relaxed);
            return on(id);
        }
        if !ASKED[id as usize].load(Ordering::Relaxed) && !ASKED[id as usize].swap(true, Ordering::Relaxed) {
            use std::io::Write as _;
            let into = std::env::var_os("FOGCOIL_REACHED").unwrap_or_default();
            let file = std::fs::OpenOptions::new().create(true).append(true).open(into);
            file.and_then(|mut file| file.write_all(format!("{id}\n").as_bytes())).expect("the file of switches is written");
        }
        false
    }
}
"#;

/// A text with its mutants.
#[derive(Debug)]
pub(super) struct Woven {
    pub(super) text: String,
    /// Mutants for which no place was found.
    pub(super) unplaced: Vec<usize>,
}

/// Where of a woven text a fault lies.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// In what one mutant puts in place of the source.
    Mutant(usize),
    /// Among these mutants.
    Among(Vec<usize>),
}

/// A part of the source with what stands in its place.
struct Site {
    range: Range<usize>,
    parts: Vec<Part>,
}

enum Part {
    Text(String),
    Source(Range<usize>),
}

fn text(of: impl Into<String>) -> Part {
    Part::Text(of.into())
}

fn off(ids: &[usize]) -> String {
    ids.iter().map(|id| format!("!crate::woven::on({id})")).collect::<Vec<_>>().join(" && ")
}

fn on(id: usize) -> String {
    format!("crate::woven::on({id})")
}

/// What acts in place of the source: the source first, so that a fault of types is one of the mutant's.
fn choice(ids: &[usize], source: Vec<Part>, of: impl Fn(usize) -> Vec<Part>) -> Vec<Part> {
    let mut parts = vec![text(format!("if {} {{ ", off(ids)))];
    parts.extend(source);
    for (n, &id) in ids.iter().enumerate() {
        let condition = if n + 1 == ids.len() { String::new() } else { format!("if {} ", on(id)) };
        parts.push(text(format!(" }} else {condition}{{ /*<{id}*/")));
        parts.extend(of(n));
        parts.push(text(format!("/*>{id}*/")));
    }
    parts.push(text(" }"));
    parts
}

/// Bytes of the source by its tokens' lines and columns.
fn bytes(span: Span) -> Range<usize> {
    span.byte_range()
}

/// Mutants by line and column (from 1), and the sites that were found for them.
struct Finder<'a> {
    source: &'a str,
    mutants: &'a [(usize, &'a Mutant)],
    by_start: BTreeMap<[usize; 2], Vec<usize>>,
    sites: Vec<Site>,
    placed: Vec<usize>,
}

impl Finder<'_> {
    /// Mutants of a genre that begin where the span does, by their place in the list.
    fn at(&self, span: Span, genre: Genre) -> Vec<usize> {
        let start = span.start();
        let found = self.by_start.get(&[start.line, start.column + 1]).map(Vec::as_slice).unwrap_or_default();
        found.iter().copied().filter(|&n| self.mutants[n].1.genre == genre).collect()
    }

    fn ids(&self, found: &[usize]) -> Vec<usize> {
        found.iter().map(|&n| self.mutants[n].0).collect()
    }

    fn place(&mut self, range: Range<usize>, found: &[usize], parts: Vec<Part>) {
        let ids = self.ids(found);
        let names = ids.iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
        let mut all = vec![text(format!("/*({names}*/"))];
        all.extend(parts);
        all.push(text("/*)*/"));
        self.sites.push(Site { range, parts: all });
        self.placed.extend(ids);
    }

    fn binary(&mut self, node: &syn::ExprBinary) {
        let found = self.at(node.op.span(), Genre::BinaryOperator);
        let (left, right, all) = (bytes(node.left.span()), bytes(node.right.span()), bytes(node.span()));
        let op = self.source[bytes(node.op.span())].to_owned();
        if found.is_empty() || holds_let(&node.left) || holds_let(&node.right) {
            return;
        }
        let ids = self.ids(&found);
        let other = |n: usize| self.mutants[found[n]].1.replacement.clone();
        let parts = match op.as_str() {
            "&&" | "||" => {
                let of = |op: &str| vec![text(format!("woven_l {op} (")), Part::Source(right.clone()), text(")")];
                let mut parts = vec![text("({ let woven_l: bool = "), Part::Source(left), text("; ")];
                parts.extend(choice(&ids, of(&op), |n| of(&other(n))));
                parts.push(text(" })"));
                parts
            }
            assigns if assigns.ends_with('=') && !["==", "!=", "<=", ">="].contains(&assigns) => {
                let of = |op: &str| vec![Part::Source(left.clone()), text(format!(" {op} woven_r"))];
                let mut parts = vec![text("match ("), Part::Source(right.clone()), text(") { woven_r => ")];
                parts.extend(choice(&ids, of(&op), |n| of(&other(n))));
                parts.push(text(" }"));
                parts
            }
            _ => {
                let compares = ["==", "!=", "<=", ">=", "<", ">"].contains(&op.as_str());
                let (refer, place) = if compares { ("&", "*") } else { ("", "") };
                let of = |op: &str| vec![text(format!("{place}woven_l {op} {place}woven_r"))];
                let mut parts = vec![text(format!("(match ({refer}("))];
                parts.extend([Part::Source(left), text(format!("), {refer}(")), Part::Source(right)]);
                parts.push(text(")) { (woven_l, woven_r) => "));
                parts.extend(choice(&ids, of(&op), |n| of(&other(n))));
                parts.push(text(" })"));
                parts
            }
        };
        self.place(all, &found, parts);
    }

    fn unary(&mut self, node: &syn::ExprUnary) {
        let found = self.at(node.span(), Genre::UnaryOperator);
        if found.is_empty() {
            return;
        }
        let op = &self.source[bytes(node.op.span())];
        let mut parts = vec![text("(match ("), Part::Source(bytes(node.expr.span())), text(") { woven_l => ")];
        parts.extend(choice(&self.ids(&found), vec![text(format!("{op}woven_l"))], |_| vec![text("woven_l")]));
        parts.push(text(" })"));
        self.place(bytes(node.span()), &found, parts);
    }

    /// An arm, which can go only where another without a condition takes what is left.
    fn arm(&mut self, node: &syn::Arm, can_go: bool) {
        let deleted = if can_go { self.at(node.span(), Genre::MatchArm) } else { Vec::new() };
        let Some((_, guard)) = &node.guard else {
            if !deleted.is_empty() {
                let at = bytes(node.pat.span()).end;
                let condition = format!(" if {}", off(&self.ids(&deleted)));
                self.place(at..at, &deleted, vec![text(condition)]);
            }
            return;
        };
        let set = self.at(guard.span(), Genre::MatchArmGuard);
        let found = [deleted.clone(), set.clone()].concat();
        if found.is_empty() || holds_let(guard) {
            return;
        }
        let mut parts = vec![text(if deleted.is_empty() { String::new() } else { off(&self.ids(&deleted)) + " && " }), text("(")];
        let source = vec![Part::Source(bytes(guard.span()))];
        if set.is_empty() {
            parts.extend(source);
        } else {
            let other = |n: usize| vec![text(self.mutants[set[n]].1.replacement.clone())];
            parts.extend(choice(&self.ids(&set), source, other));
        }
        parts.push(text(")"));
        self.place(bytes(guard.span()), &found, parts);
    }

    fn literal(&mut self, node: &syn::ExprStruct) {
        let fields: Vec<(usize, Range<usize>)> = node
            .fields
            .pairs()
            .filter_map(|pair| {
                let found = *self.at(pair.value().span(), Genre::StructField).first()?;
                let comma = pair.punct().map_or_else(|| pair.value().span(), |comma| comma.span());
                Some((found, bytes(pair.value().span()).start..bytes(comma).end))
            })
            .collect();
        if fields.is_empty() {
            return;
        }
        let (all, found) = (bytes(node.span()), fields.iter().map(|(n, _)| *n).collect::<Vec<_>>());
        let without = |n: usize| vec![Part::Source(all.start..fields[n].1.start), Part::Source(fields[n].1.end..all.end)];
        let mut parts = vec![text("(")];
        parts.extend(choice(&self.ids(&found), vec![Part::Source(all.clone())], without));
        parts.push(text(")"));
        self.place(all, &found, parts);
    }

    /// Answers of a function, before its first statement.
    fn block(&mut self, node: &syn::Block) {
        let Some(first) = node.stmts.first() else { return };
        let found = self.at(first.span(), Genre::FnValue);
        if found.is_empty() {
            return;
        }
        let at = bytes(first.span()).start;
        let answer = |&n: &usize| {
            let (id, mutant) = self.mutants[n];
            text(format!("if {} {{ /*<{id}*/return {};/*>{id}*/ }} ", on(id), mutant.replacement))
        };
        let parts = found.iter().map(answer).collect();
        self.place(at..at, &found, parts);
    }

    /// The text of a range: its sites from number `from` on, and the source between them.
    fn render(&self, range: Range<usize>, from: usize) -> String {
        let (mut at, mut made) = (range.start, String::new());
        for (n, site) in self.sites.iter().enumerate().skip(from) {
            if site.range.start >= range.end {
                break;
            }
            if site.range.start < at || site.range.end > range.end {
                continue;
            }
            made += &self.source[at..site.range.start];
            for part in &site.parts {
                match part {
                    Part::Text(text) => made += text,
                    Part::Source(inner) => made += &self.render(inner.clone(), n + 1),
                }
            }
            at = site.range.end;
        }
        made + &self.source[at..range.end]
    }
}

/// Whether a condition binds names, which no other form of it would.
fn holds_let(expression: &syn::Expr) -> bool {
    match expression {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(binary) => holds_let(&binary.left) || holds_let(&binary.right),
        syn::Expr::Paren(paren) => holds_let(&paren.expr),
        _ => false,
    }
}

impl<'a> Visit<'a> for Finder<'_> {
    fn visit_expr_binary(&mut self, node: &'a syn::ExprBinary) {
        self.binary(node);
        visit::visit_expr_binary(self, node);
    }

    fn visit_expr_unary(&mut self, node: &'a syn::ExprUnary) {
        self.unary(node);
        visit::visit_expr_unary(self, node);
    }

    fn visit_expr_match(&mut self, node: &'a syn::ExprMatch) {
        let takes_all = |arm: &syn::Arm| matches!(arm.pat, syn::Pat::Wild(_)) && arm.guard.is_none();
        let can_go = node.arms.iter().any(takes_all);
        node.arms.iter().for_each(|arm| self.arm(arm, can_go));
        visit::visit_expr_match(self, node);
    }

    fn visit_expr_struct(&mut self, node: &'a syn::ExprStruct) {
        self.literal(node);
        visit::visit_expr_struct(self, node);
    }

    fn visit_block(&mut self, node: &'a syn::Block) {
        self.block(node);
        visit::visit_block(self, node);
    }
}

/// A source file with the mutants, each with its number, switched off. No line is added.
///
/// # Errors
/// [`Failure`] if the file is not Rust.
pub(super) fn weave(source: &str, mutants: &[(usize, &Mutant)]) -> Result<Woven, Failure> {
    let file = syn::parse_file(source).map_err(|error| Failure(format!("not Rust: {error}")))?;
    let mut by_start = BTreeMap::<[usize; 2], Vec<usize>>::new();
    for (n, (_, mutant)) in mutants.iter().enumerate() {
        by_start.entry(mutant.start).or_default().push(n);
    }
    let mut finder = Finder { source, mutants, by_start, sites: Vec::new(), placed: Vec::new() };
    finder.visit_file(&file);
    // what holds others before them, and what is put in before what it stands before
    finder.sites.sort_by_key(|site| {
        let length = site.range.len();
        (site.range.start, length != 0, std::cmp::Reverse(length))
    });
    let woven = finder.render(0..source.len(), 0);
    let unplaced = mutants.iter().map(|(id, _)| *id).filter(|id| !finder.placed.contains(id)).collect();
    Ok(Woven { text: woven, unplaced })
}

/// Which mutants a fault at a byte of a woven text belongs to, if to any: those around it, or those of its line.
pub(super) fn place_of(woven: &str, at: usize) -> Option<Place> {
    let mut open = Vec::<Place>::new();
    let marks = |text: &str| -> Vec<(usize, String)> {
        text.match_indices("/*").filter_map(|(n, _)| Some((n, text[n + 2..].split_once("*/")?.0.to_owned()))).collect()
    };
    let number = |text: &str| text.split(' ').map(str::parse).collect::<Result<Vec<usize>, _>>().ok();
    for (_, mark) in marks(woven).into_iter().take_while(|(n, _)| *n < at) {
        if let Some(ids) = mark.strip_prefix('<').and_then(number) {
            open.push(Place::Mutant(ids[0]));
        } else if let Some(ids) = mark.strip_prefix('(').and_then(number) {
            open.push(Place::Among(ids));
        } else if mark == ")" || mark.strip_prefix('>').and_then(number).is_some() {
            open.pop();
        }
    }
    open.pop().or_else(|| {
        let start = woven[..at].rfind('\n').map_or(0, |n| n + 1);
        let line = woven[start..].lines().next().unwrap_or_default();
        let ids: Vec<usize> = marks(line).iter().filter_map(|(_, mark)| number(mark.strip_prefix('(')?)).flatten().collect();
        (!ids.is_empty()).then_some(Place::Among(ids))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = r#"
fn main() {
    let found = [area(3.0, 2.0), sign(-4.0), f64::from(inside(1, true)), kind(7), total(), side(Point { x: 2.0, ..ORIGIN })];
    println!("{}", found.map(|x| x.to_string()).join(" "));
}
fn area(a: f64, b: f64) -> f64 {
    a + b * 2.0
}
fn sign(x: f64) -> f64 {
    -x
}
fn inside(n: usize, flag: bool) -> u8 {
    u8::from(n <= 1 && flag)
}
fn kind(n: u8) -> f64 {
    match n {
        7 => 1.0,
        n if n > 3 => 2.0,
        _ => 3.0,
    }
}
fn total() -> f64 {
    let mut sum = 1.0;
    sum += 2.0 + 1.0;
    sum
}
struct Point {
    x: f64,
    y: f64,
}
const ORIGIN: Point = Point { x: 1.0, y: 1.0 };
fn side(p: Point) -> f64 {
    p.x - p.y
}
"#;

    /// Changes of the source: genre, text that is changed (where it begins), replacement, answers of the program.
    const CHANGES: [(Genre, &str, &str, &str); 14] = [
        (Genre::FnValue, "a + b", "-1.0", "-1 4 1 1 4 1"),
        (Genre::BinaryOperator, "+ b", "-", "-1 4 1 1 4 1"),
        (Genre::BinaryOperator, "+ b", "*", "12 4 1 1 4 1"),
        (Genre::BinaryOperator, "* 2.0\n", "/", "4 4 1 1 4 1"),
        (Genre::UnaryOperator, "-x", "", "7 -4 1 1 4 1"),
        (Genre::BinaryOperator, "<= 1", "<", "7 4 0 1 4 1"),
        (Genre::BinaryOperator, "<= 1", ">", "7 4 0 1 4 1"),
        (Genre::BinaryOperator, "&& flag", "||", "7 4 1 1 4 1"),
        (Genre::MatchArm, "7 =>", "", "7 4 1 2 4 1"),
        (Genre::MatchArmGuard, "n > 3 =>", "false", "7 4 1 1 4 1"),
        (Genre::BinaryOperator, "+= 2.0", "-=", "7 4 1 1 -2 1"),
        (Genre::BinaryOperator, "+ 1.0;", "-", "7 4 1 1 2 1"),
        (Genre::StructField, "x: 2.0,", "", "7 4 1 1 4 0"),
        (Genre::BinaryOperator, "- p.y", "/", "7 4 1 1 4 2"),
    ];

    fn mutants() -> Vec<Mutant> {
        let of = |(genre, begins, replacement, _): (Genre, &str, &str, &str)| {
            let before = &SOURCE[..SOURCE.find(begins).unwrap()];
            let column = before.len() - before.rfind('\n').unwrap();
            let [name, key, file, function, returns] = [""; 5].map(str::to_owned);
            let start = [before.matches('\n').count() + 1, column];
            Mutant { name, key, file, function, returns, genre, replacement: replacement.into(), start }
        };
        CHANGES.map(of).into()
    }

    #[test]
    fn each_mutant_acts_alone_and_none_unless_named() {
        let mutants = mutants();
        let woven = weave(SOURCE, &mutants.iter().enumerate().collect::<Vec<_>>()).unwrap();
        assert!(woven.unplaced.is_empty(), "{woven:?}");
        assert_eq!(woven.text.lines().count(), SOURCE.lines().count());
        let folder = tempfile::tempdir().unwrap();
        let [source, program] = ["main.rs", "main"].map(|name| folder.path().join(name));
        std::fs::write(&source, woven.text + SWITCHES).unwrap();
        let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let built = std::process::Command::new(compiler)
            .args(["--edition", "2024", "--cap-lints", "allow", "-o"])
            .args([&program, &source])
            .output()
            .unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        let answers = |named: Option<usize>| {
            let mut command = std::process::Command::new(&program);
            named.into_iter().for_each(|id| _ = command.env("FOGCOIL_MUTANT", id.to_string()));
            String::from_utf8(command.output().unwrap().stdout).unwrap().trim().to_owned()
        };
        assert_eq!(answers(None), "7 4 1 1 4 1");
        assert_eq!(answers(Some(999)), "7 4 1 1 4 1");
        for (id, (genre, begins, replacement, told)) in CHANGES.into_iter().enumerate() {
            assert_eq!(answers(Some(id)), told, "{genre:?} at {begins}: {replacement}");
        }
        // those that are asked, whether they act or not
        let reached = folder.path().join("reached");
        std::process::Command::new(&program).env("FOGCOIL_REACHED", &reached).output().unwrap();
        let mut ids: Vec<usize> = std::fs::read_to_string(reached).unwrap().lines().map(|id| id.parse().unwrap()).collect();
        ids.sort_unstable();
        // the arm of 7 is taken before the condition of the next one is asked
        assert_eq!(ids, (0..CHANGES.len()).filter(|id| CHANGES[*id].0 != Genre::MatchArmGuard).collect::<Vec<_>>());
    }

    #[test]
    fn a_fault_is_its_mutant_s_or_of_those_around() {
        let mutants = mutants();
        let text = weave(SOURCE, &mutants.iter().enumerate().collect::<Vec<_>>()).unwrap().text;
        let at = |what: &str| text.find(what).unwrap() + 1;
        assert_eq!(place_of(&text, at("woven_l * woven_r/*>2*/")), Some(Place::Mutant(2)));
        assert_eq!(place_of(&text, at("return -1.0")), Some(Place::Mutant(0)));
        let Some(Place::Among(ids)) = place_of(&text, at("woven_l + woven_r }")) else { panic!("{text}") };
        assert_eq!(ids, [1, 2]);
        // beside all marks: those of the line, if there are any
        assert_eq!(place_of(&text, at("7/*(8*/")), Some(Place::Among(vec![8])));
        assert_eq!(place_of(&text, at("match n {")), None);
    }

    #[test]
    fn a_condition_that_binds_stays_as_it_is() {
        let source = "fn f(x: Option<u8>) -> bool {\n    if let Some(n) = x && n > 1 { true } else { false }\n}\n";
        let column = source.lines().nth(1).unwrap().find("&&").unwrap() + 1;
        let [name, key, file, function, returns] = [""; 5].map(str::to_owned);
        let genre = Genre::BinaryOperator;
        let mutant = Mutant { name, key, file, function, returns, genre, replacement: "||".into(), start: [2, column] };
        let woven = weave(source, &[(5, &mutant)]).unwrap();
        assert_eq!((woven.text.as_str(), woven.unplaced), (source, vec![5]));
    }
}
