//! Lines of the fields in a RON text.

use std::ops::Range;

use super::scanner::{Scanner, Token};
use crate::units::SUFFIXES;

/// Deeper than any case file, and as deep as the RON reader goes.
const DEEPEST: usize = 128;

/// The fields of a RON text as a tree; enum names, `Some` and the parentheses of a newtype leave no level.
pub(crate) struct FieldMap<'a> {
    fields: Vec<Field<'a>>,
    /// Whether the text ends inside a bracket.
    pub(crate) is_cut_short: bool,
}

struct Field<'a> {
    parent: Option<usize>,
    segment: Segment<'a>,
    /// Byte offset of the key, or of the list's element.
    start: usize,
    /// Byte offset of what follows the value.
    end: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Segment<'a> {
    Key(&'a str),
    Index(usize),
}

struct Frame {
    bracket: u8,
    /// The field whose value it is.
    owner: Option<usize>,
    /// The field inside it that is being read.
    current: Option<usize>,
    /// Elements of a list so far.
    index: usize,
}

impl<'a> FieldMap<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        let mut map = Self { fields: Vec::new(), is_cut_short: false };
        let mut frames = vec![Frame { bracket: b'(', owner: None, current: None, index: 0 }];
        let mut tokens = Scanner::new(text).peekable();
        while let Some((at, token)) = tokens.next() {
            let followed_by_colon = matches!(tokens.peek(), Some((_, Token::Colon)));
            let depth = frames.len();
            let Some(frame) = frames.last_mut() else { break };
            map.begin(frame, at, token, followed_by_colon, text.len());
            match token {
                Token::Open(bracket) if depth < DEEPEST => {
                    let owner = frame.current.or(frame.owner);
                    frames.push(Frame { bracket, owner, current: None, index: 0 });
                }
                Token::Comma => {
                    map.close(frame, at);
                    frame.index += 1;
                }
                Token::Close => {
                    map.close(frame, at);
                    frames.pop();
                }
                Token::Open(_) => break,
                Token::Colon | Token::Word(_) | Token::Other => {}
            }
        }
        map.is_cut_short = frames.len() > 1;
        map
    }

    fn begin(&mut self, frame: &mut Frame, at: usize, token: Token<'a>, followed_by_colon: bool, end: usize) {
        let segment = match token {
            Token::Close | Token::Comma | Token::Colon => return,
            Token::Word(key) if frame.bracket != b'[' && followed_by_colon => Segment::Key(key),
            _ if frame.bracket == b'[' && frame.current.is_none() => Segment::Index(frame.index),
            _ => return,
        };
        self.close(frame, at);
        frame.current = Some(self.fields.len());
        self.fields.push(Field { parent: frame.owner, segment, start: at, end });
    }

    fn close(&mut self, frame: &mut Frame, at: usize) {
        if let Some(field) = frame.current.take() {
            self.fields[field].end = at;
        }
    }

    pub(crate) fn at(&self, offset: usize) -> Option<usize> {
        self.fields.iter().rposition(|field| (field.start..field.end).contains(&offset))
    }

    /// Path of a field, e.g. `rings[1].material.poisson_ratio`; empty for the whole file.
    pub(crate) fn path(&self, field: Option<usize>) -> String {
        let mut segments = Vec::new();
        let mut next = field;
        while let Some(i) = next {
            segments.push(self.fields[i].segment);
            next = self.fields[i].parent;
        }
        segments.iter().rev().fold(String::new(), |path, segment| match segment {
            Segment::Key(key) => join(&path, key),
            Segment::Index(index) => format!("{path}[{index}]"),
        })
    }

    /// Byte offsets from where a field begins to what follows its value.
    pub(crate) fn span(&self, field: usize) -> Range<usize> {
        self.fields[field].start..self.fields[field].end
    }

    /// The first field inside another, or of the whole file.
    pub(crate) fn first_inside(&self, parent: Option<usize>) -> Option<usize> {
        self.fields.iter().position(|field| field.parent == parent)
    }

    pub(crate) fn is_element(&self, field: usize) -> bool {
        matches!(self.fields[field].segment, Segment::Index(_))
    }

    /// The field that `path` names, and what of the path the text does not have.
    ///
    /// A name without its unit finds the key with it: `coil.height` is `coil.height_mm`.
    pub(crate) fn find<'p>(&self, path: &'p str) -> (Option<usize>, &'p str) {
        let (mut found, mut rest) = (None, path);
        while !rest.is_empty() {
            let trimmed = rest.trim_start_matches('.');
            let length = trimmed.char_indices().skip(1).find(|&(_, c)| c == '.' || c == '[').map_or(trimmed.len(), |(i, _)| i);
            let Some(child) = self.child(found, &trimmed[..length]) else { break };
            (found, rest) = (Some(child), &trimmed[length..]);
        }
        (found, rest.trim_start_matches('.'))
    }

    fn child(&self, parent: Option<usize>, name: &str) -> Option<usize> {
        let index = name.strip_prefix('[').and_then(|n| n.strip_suffix(']')).and_then(|n| n.parse().ok());
        let find = |wanted: &dyn Fn(Segment) -> bool| self.fields.iter().position(|f| f.parent == parent && wanted(f.segment));
        find(&|segment| match segment {
            Segment::Key(key) => key == name,
            Segment::Index(i) => Some(i) == index,
        })
        .or_else(|| find(&|segment| matches!(segment, Segment::Key(key) if without_unit(key) == Some(name))))
    }
}

/// `parent.name`, or `name` at the top.
pub(crate) fn join(parent: &str, name: &str) -> String {
    if parent.is_empty() { name.to_owned() } else { format!("{parent}.{name}") }
}

fn without_unit(key: &str) -> Option<&str> {
    SUFFIXES.iter().find_map(|suffix| key.strip_suffix(suffix)?.strip_suffix('_'))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// rings: 1\n(\n  name: \"a: (\", /* x: */\n  coil: (material: Constants((\n    e_z_gpa: 1.0,\n  )), height_mm: 2),\n  \
                        spool: Some((\n    flanges: [(side: Right,\n      t_mm: 1), (side: Left)],\n  )),\n  list: [1.0, \"b\",\n 3],\n)\n";

    fn line(path: &str) -> Option<usize> {
        let map = FieldMap::new(TEXT);
        let (Some(field), "") = map.find(path) else { return None };
        Some(1 + TEXT[..map.span(field).start].matches('\n').count())
    }

    #[test]
    fn fields_are_found_through_enums_lists_and_comments() {
        assert_eq!(line("name"), Some(3));
        assert_eq!(line("coil.material.e_z_gpa"), Some(5));
        assert_eq!(line("coil.height_mm"), Some(6));
        assert_eq!(line("spool.flanges[0].t_mm"), Some(9));
        assert_eq!(line("spool.flanges[1].side"), Some(9));
        assert_eq!(line("list[2]"), Some(12));
        assert_eq!(line("rings"), None);
    }

    #[test]
    fn a_name_without_its_unit_finds_the_key() {
        assert_eq!(line("coil.material.e_z"), Some(5));
        assert_eq!(line("coil.height"), Some(6));
        assert_eq!(line("coil.h"), None);
        let map = FieldMap::new(TEXT);
        let (field, rest) = map.find("coil.depth.x");
        assert_eq!((map.path(field).as_str(), rest), ("coil", "depth.x"));
    }

    #[test]
    fn every_offset_has_its_innermost_field() {
        let map = FieldMap::new(TEXT);
        let path = |word: &str| map.path(map.at(TEXT.find(word).unwrap()));
        assert_eq!(path("1.0,\n  ))"), "coil.material.e_z_gpa");
        assert_eq!(path("Left"), "spool.flanges[1].side");
        assert_eq!(path(")],"), "spool.flanges[1]");
        assert_eq!(path("\"b\""), "list[1]");
        assert_eq!(path("// rings"), "");
    }

    #[test]
    fn deep_and_broken_texts_are_survived() {
        for text in ["(".repeat(100_000), "[".repeat(100_000), ")]}".repeat(1000), "a:[".repeat(10_000), "a:a:,,:(b".into()] {
            let map = FieldMap::new(&text);
            let _ = map.path(map.at(text.len() / 2));
        }
    }
}
