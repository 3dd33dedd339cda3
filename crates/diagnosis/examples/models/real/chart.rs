//! A picture of lines, as an SVG file that needs nothing else.

use std::fmt::Write as _;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 15.0;
const TOP: f64 = 48.0;
const BOTTOM: f64 = 45.0;
/// Width of a letter, about.
const LETTER: f64 = 6.5;
const COLOURS: [&str; 3] = ["#b5651d", "#1f5fa8", "#4a7c3a"];

/// A line with its name.
pub(crate) struct Line {
    pub(crate) name: &'static str,
    pub(crate) points: Vec<[f64; 2]>,
}

/// Lines over an axis; `shades` are ranges of it that are named and set off.
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) across: String,
    pub(crate) up: String,
    pub(crate) lines: Vec<Line>,
    pub(crate) shades: Vec<([f64; 2], String)>,
}

impl Chart {
    pub(crate) fn svg(&self) -> String {
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let range = |k: usize| points().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p[k]), b.max(p[k])]);
        let ([x0, x1], [y0, y1]) = (range(0), range(1));
        let margin = 0.08 * (y1 - y0).max(1e-12);
        let (y0, y1) = (y0 - margin, y1 + margin);
        let x = |v: f64| LEFT + (v - x0) / (x1 - x0).max(1e-12) * (WIDTH - LEFT - RIGHT);
        let y = |v: f64| HEIGHT - BOTTOM - (v - y0) / (y1 - y0) * (HEIGHT - TOP - BOTTOM);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <title>{0}</title>\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n<text x=\"{LEFT}\" y=\"16\" font-size=\"13\" font-weight=\"bold\">{0}</text>\n",
            self.title
        );
        for ([from, to], name) in &self.shades {
            let (a, b) = (x(*from), x(*to));
            let _ = writeln!(
                svg,
                "<rect x=\"{a:.1}\" y=\"{TOP}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#e8eef5\"/>",
                b - a,
                HEIGHT - TOP - BOTTOM
            );
            // a name that does not fit is left to the page
            if b - a > LETTER * name.len() as f64 {
                let _ =
                    writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#44566c\">{name}</text>", a + 4.0, HEIGHT - BOTTOM - 6.0);
            }
        }
        for value in ticks(y0, y1) {
            let at = y(value);
            let _ = writeln!(svg, "<path d=\"M{LEFT} {at:.1}H{:.1}\" stroke=\"#d0d0d0\"/>", WIDTH - RIGHT);
            let _ =
                writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>", LEFT - 6.0, at + 4.0, short(value));
        }
        for value in ticks(x0, x1) {
            let _ = writeln!(
                svg,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                x(value),
                HEIGHT - BOTTOM + 16.0,
                short(value)
            );
        }
        for (k, line) in self.lines.iter().enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            let path: Vec<String> = line.points.iter().map(|p| format!("{:.1} {:.1}", x(p[0]), y(p[1]))).collect();
            let _ = writeln!(svg, "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.4\"/>", path.join("L"));
            let at = LEFT + 200.0 * k as f64;
            let _ = writeln!(
                svg,
                "<path d=\"M{at} 34h22\" stroke=\"{colour}\" stroke-width=\"3\"/><text x=\"{:.1}\" y=\"38\">{}</text>",
                at + 28.0,
                line.name
            );
        }
        let middle = (TOP + HEIGHT - BOTTOM) / 2.0;
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            (LEFT + WIDTH) / 2.0,
            HEIGHT - 8.0,
            self.across
        );
        let _ = writeln!(
            svg,
            "<text transform=\"translate(14 {middle:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</svg>",
            self.up
        );
        svg
    }
}

/// Round values within a range, some five of them.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low).max(1e-12) / 5.0;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|step| *step >= rough).unwrap_or(rough);
    let first = (low / step).ceil() as i64;
    (first..=(high / step).floor() as i64).map(|k| k as f64 * step).collect()
}

fn short(x: f64) -> String {
    if x != 0.0 && x.abs() < 1e-3 { format!("{x:.0e}") } else { format!("{}", (x * 1e6).round() / 1e6) }
}
