//! SVG under construction: numbers are formatted by who draws, text is escaped on its way in.

use std::fmt::{self, Write};

use maud::{Escaper, Markup, PreEscaped, Render};

/// Names of attributes with their values, as [`attributes!`](crate::attributes) makes them.
pub type Attributes<'a> = &'a [(&'static str, fmt::Arguments<'a>)];

/// Attributes of an element of an [`Svg`]: a name and a format string each, with its arguments in parentheses if it has any.
///
/// ```
/// let (x, name) = (1.25, "a \"b\"");
/// let mut svg = charts::Svg::default();
/// svg.leaf("circle", charts::attributes! { "cx": "{x:.1}", "cy": "{:.1}"(2.0 * x), "class": "{name}" });
/// assert_eq!(svg.into_string(), "<circle cx=\"1.2\" cy=\"2.5\" class=\"a &quot;b&quot;\"/>\n");
/// ```
#[macro_export]
macro_rules! attributes {
    ($($name:literal: $format:literal $(($($argument:expr),+))?),* $(,)?) => {
        &[$(($name, ::core::format_args!($format $(, $($argument),+)?))),*]
    };
}

/// A piece of SVG. Names of elements and attributes are the program's own; all else is escaped, so that no text can break out of its
/// place, and control characters, which no document may hold, are dropped.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Svg(String);

/// Writes text as the content of an element or attribute.
struct Escaped<'a>(&'a mut String);

impl Write for Escaped<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.split(char::is_control).try_for_each(|piece| Escaper::new(self.0).write_str(piece))
    }
}

impl Svg {
    /// Opens an element; [`Self::close`] it.
    pub fn open(&mut self, tag: &'static str, attributes: Attributes) -> &mut Self {
        self.start(tag, attributes, ">")
    }

    /// Closes the element that was opened last, and ends the line.
    pub fn close(&mut self, tag: &'static str) {
        self.0 += &format!("</{tag}>\n");
    }

    /// An element without content, on a line of its own.
    pub fn leaf(&mut self, tag: &'static str, attributes: Attributes) -> &mut Self {
        self.start(tag, attributes, "/>\n")
    }

    /// An element with text.
    pub fn element(&mut self, tag: &'static str, attributes: Attributes, content: &str) {
        self.open(tag, attributes);
        let _ = Escaped(&mut self.0).write_str(content);
        self.close(tag);
    }

    /// Text at (`x`, `y`) \[px\], `anchor` being `start`, `middle` or `end`.
    pub fn text(&mut self, [x, y]: [f64; 2], anchor: &str, content: &str) {
        self.element("text", attributes! { "x": "{x:.1}", "y": "{y:.1}", "text-anchor": "{anchor}" }, content);
    }

    /// A group of what `inside` draws.
    pub fn group(&mut self, attributes: Attributes, inside: impl FnOnce(&mut Self)) {
        self.open("g", attributes).line();
        inside(self);
        self.close("g");
    }

    /// A group that is moved by (`x`, `y`) \[px\].
    pub fn moved(&mut self, [x, y]: [f64; 2], inside: impl FnOnce(&mut Self)) {
        self.group(attributes! { "transform": "translate({x:.1} {y:.1})" }, inside);
    }

    /// Elements that were drawn elsewhere.
    pub fn append(&mut self, other: &Self) -> &mut Self {
        self.0 += &other.0;
        self
    }

    pub(crate) fn line(&mut self) {
        self.0.push('\n');
    }

    /// The next element stands on the line of the last one.
    pub fn joined(&mut self) -> &mut Self {
        self.0.truncate(self.0.trim_end_matches('\n').len());
        self
    }

    fn start(&mut self, tag: &'static str, attributes: Attributes, end: &str) -> &mut Self {
        self.0 += "<";
        self.0 += tag;
        for (name, value) in attributes {
            self.0 += &format!(" {name}=\"");
            let _ = Escaped(&mut self.0).write_fmt(*value);
            self.0 += "\"";
        }
        self.0 += end;
        self
    }

    /// The text of the element, as it stands in a document.
    pub fn into_string(self) -> String {
        self.0
    }
}

impl Render for Svg {
    fn render(&self) -> Markup {
        PreEscaped(self.0.clone())
    }
}

/// The frame of an SVG document: its measures, and what is said to who does not see it.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// Ids of title and description.
    pub ids: [&'a str; 2],
    /// Width and height \[px\].
    pub size: [f64; 2],
    /// Size of the font \[px\].
    pub font: f64,
    /// The subject of the picture, in a line.
    pub title: &'a str,
    /// Description of the picture.
    pub description: &'a str,
    /// Attributes of the whole.
    pub attributes: Attributes<'a>,
    /// Its style sheet; none if empty.
    pub style: &'a str,
}

impl Frame<'_> {
    /// The document: white paper, and on it what `inside` draws.
    pub fn document(&self, inside: impl FnOnce(&mut Svg)) -> String {
        let ([title, description], [width, height], font) = (self.ids, self.size, self.font);
        let mut svg = Svg::default();
        let name: Attributes = attributes! { "xmlns": "http://www.w3.org/2000/svg" };
        let all = [
            name,
            self.attributes,
            attributes! {
                "viewBox": "0 0 {width:.0} {height:.0}", "width": "{width:.0}", "height": "{height:.0}", "font-family": "sans-serif",
                "font-size": "{font}", "role": "img", "aria-labelledby": "{title} {description}"
            },
        ];
        svg.open("svg", &all.concat()).line();
        svg.element("title", attributes! { "id": "{title}" }, self.title);
        svg.element("desc", attributes! { "id": "{description}" }, self.description);
        if !self.style.is_empty() {
            svg.0 += &format!("<style>\n{}</style>\n", self.style);
        }
        svg.leaf("rect", attributes! { "width": "100%", "height": "100%", "fill": "#ffffff" });
        inside(&mut svg);
        svg.close("svg");
        svg.into_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_breaks_out_of_its_place() {
        let hostile = "</text><script>\"&'\u{0}\n";
        let mut svg = Svg::default();
        svg.text([1.0, 2.0], hostile, hostile);
        svg.moved([0.0, 0.0], |inner| inner.element("title", &[], hostile));
        let safe = "&lt;/text&gt;&lt;script&gt;&quot;&amp;'";
        let group = format!("<g transform=\"translate(0.0 0.0)\">\n<title>{safe}</title>\n</g>\n");
        assert_eq!(svg.into_string(), format!("<text x=\"1.0\" y=\"2.0\" text-anchor=\"{safe}\">{safe}</text>\n{group}"));
    }

    #[test]
    fn a_document_says_what_it_is() {
        let frame = Frame {
            ids: ["t", "d"],
            size: [10.4, 20.0],
            font: 12.0,
            title: "a < b",
            description: "c & d",
            attributes: attributes! { "class": "plot" },
            style: "",
        };
        let text = frame.document(|svg| svg.text([0.0, 0.0], "end", "x"));
        assert!(text.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 10 20\" "), "{text}");
        assert!(
            text.contains("font-size=\"12\" role=\"img\" aria-labelledby=\"t d\">\n<title id=\"t\">a &lt; b</title>\n"),
            "{text}"
        );
        assert!(text.ends_with("fill=\"#ffffff\"/>\n<text x=\"0.0\" y=\"0.0\" text-anchor=\"end\">x</text>\n</svg>\n"), "{text}");
    }
}
