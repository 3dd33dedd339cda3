//! Colours of lines and areas, in light and dark; blue, vermilion and green after Okabe and Ito, darkened or lightened for contrast.

/// Name, in light, in dark.
const PALETTE: [(&str, &str, &str); 14] = [
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
    ("coil", "#cfe4f2", "#1d4a68"),
    ("hub", "#dcd6c8", "#55503f"),
    ("flange", "#c6bda6", "#6e674f"),
    ("card", "#f4f6f8", "#1b1f24"),
];

const STYLE: &str = include_str!("style.css");

/// Style sheet of a page with figures: the palette as custom properties, by the reader's preference in light or dark, and the figures'
/// rules.
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
pub(super) fn document_style() -> String {
    PALETTE.iter().fold(STYLE.to_owned(), |style, (name, light, _)| style.replace(&format!("var(--{name})"), light))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_that_is_used_is_in_the_palette() {
        assert!(!document_style().contains("var("), "{}", document_style());
    }
}
