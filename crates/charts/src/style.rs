//! Colours of lines and areas, in light and dark; blue, vermilion and green after Okabe and Ito, with violet, darkened or lightened for contrast.

/// Name, in light, in dark.
const PALETTE: [(&str, &str, &str); 15] = [
    ("page", "#ffffff", "#14171b"),
    ("text", "#1a1d21", "#e7eaee"),
    ("quiet", "#555b63", "#a9b1ba"),
    ("rule", "#d4d8dd", "#3a4048"),
    ("grid", "#e3e6ea", "#2a2f36"),
    ("axis", "#6a7078", "#8d959f"),
    ("total", "#111111", "#ffffff"),
    ("first", "#0072b2", "#56b4e9"),
    ("second", "#c24e00", "#f0a050"),
    ("third", "#00805c", "#3fcf9f"),
    ("record", "#8a3ffc", "#8a60ff"),
    ("cool", "#cfe4f2", "#1d4a68"),
    ("sand", "#dcd6c8", "#55503f"),
    ("clay", "#c6bda6", "#6e674f"),
    ("card", "#f4f6f8", "#1b1f24"),
];

const STYLE: &str = include_str!("style.css");

/// Style sheet of a page with figures: the palette as custom properties, in light or dark as the reader prefers, and the figures' rules.
pub(crate) fn page_style() -> String {
    let properties = |dark: bool| {
        let one = |(name, light, in_dark): &(&str, &str, &str)| format!(" --{name}: {};", if dark { in_dark } else { light });
        PALETTE.iter().map(one).collect::<String>()
    };
    format!(
        ":root {{ color-scheme: light;{} }}\n@media screen and (prefers-color-scheme: dark) {{\n  \
         :root {{ color-scheme: dark;{} }}\n}}\n{STYLE}",
        properties(false),
        properties(true)
    )
}

/// Style sheet of a figure that stands alone: in light, without custom properties, which not every program knows.
pub(crate) fn document_style() -> String {
    PALETTE.iter().fold(STYLE.to_owned(), |style, (name, light, _)| style.replace(&format!("var(--{name})"), light))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_that_is_used_is_in_the_palette() {
        assert!(!document_style().contains("var("), "{}", document_style());
    }

    /// Linear light of a colour `#rrggbb`.
    fn linear(colour: &str) -> [f64; 3] {
        [1, 3, 5].map(|at| {
            let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        })
    }

    fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
    }

    /// CIELAB under D65.
    fn lab(linear: [f64; 3]) -> [f64; 3] {
        const XYZ: [[f64; 3]; 3] = [[0.4339, 0.3763, 0.1899], [0.2127, 0.7152, 0.0722], [0.0178, 0.1095, 0.8730]];
        let [x, y, z] = times(XYZ, linear.map(|v| v.clamp(0.0, 1.0)))
            .map(|t| if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// Normal sight; protanopia and deuteranopia after Machado, Oliveira and Fernandes (2009), severity 1, in linear light.
    const SIGHTS: [[[f64; 3]; 3]; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    ];
    /// CIE 1976 distance of colours that nobody mixes up in thin lines: a just noticeable one is 2.3.
    const APART: f64 = 25.0;
    /// Contrast of graphics and of text against the page (WCAG 2.2, 1.4.11 and 1.4.3).
    const CONTRAST: [(&str, f64); 8] = [
        ("total", 3.0),
        ("first", 3.0),
        ("second", 3.0),
        ("third", 3.0),
        ("record", 3.0),
        ("axis", 3.0),
        ("text", 4.5),
        ("quiet", 4.5),
    ];

    #[test]
    fn lines_are_told_apart_by_colour_blind_readers_and_from_the_page() {
        for dark in [false, true] {
            let colour = |name: &str| PALETTE.iter().find(|c| c.0 == name).map(|c| if dark { c.2 } else { c.1 }).unwrap();
            let lines = ["total", "first", "second", "third", "record"].map(|name| linear(colour(name)));
            for sight in SIGHTS {
                for (n, a) in lines.iter().enumerate() {
                    for b in &lines[..n] {
                        let [a, b] = [a, b].map(|c| lab(times(sight, *c)));
                        let apart = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                        assert!(apart > APART, "{apart}, dark: {dark}");
                    }
                }
            }
            let luminance = |name: &str| times([[0.2126, 0.7152, 0.0722]; 3], linear(colour(name)))[0];
            for (name, least) in CONTRAST {
                let [a, b] = [luminance(name), luminance("page")];
                let contrast = (a.max(b) + 0.05) / (a.min(b) + 0.05);
                assert!(contrast >= least, "{name}: {contrast}, dark: {dark}");
            }
        }
    }
}
