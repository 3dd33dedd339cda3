//! What was found, as docs/pages.md.

use std::fmt::Write;

use super::axe;
use super::look::{Finding, Look};

/// The page.
pub(super) fn markdown(looks: &[Look], chromium: &str) -> String {
    let version = looks.first().map_or(axe::VERSION, |look| look.axe.as_str());
    let mut out = format!(
        "# Pages\n\n\
         Written by `cargo xtask pages`; do not edit. The reports of `fogcoil simulate`, of `fogcoil diagnose` (a unit that is explained, one \
         that nothing in the library explains, one that needs no explanation) and of `cargo xtask validate`, made from the fixtures, opened in \
         {chromium} as on a phone, a tablet and a screen, in light and dark, folded tables opened, and judged by axe-core {version}. The \
         command exits with 1 on a serious or critical finding, on an element wider than the page, on a figure's label that leaves the \
         figure, covers another or is smaller than 9 px, on an error or a warning of the console, and on any request besides the page itself. \
         Screenshots and prints on A4 are left in target/pages.\n\n\
         | page | width [px] | colours | axe: serious, critical | axe: others | wider than the page | labels | console | requests |\n\
         |---|---|---|---|---|---|---|---|---|\n"
    );
    for look in looks {
        let (grave, others): (Vec<&Finding>, Vec<&Finding>) = look.findings.iter().partition(|f| f.grave());
        let listed = |all: &[&Finding]| match all {
            [] => "0".to_owned(),
            all => all.iter().map(|f| format!("{} ({})", f.id, f.nodes)).collect::<Vec<_>>().join(", "),
        };
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            look.page,
            look.width,
            look.theme.name(),
            listed(&grave),
            listed(&others),
            look.overflow.len(),
            look.labels.len(),
            look.console.len(),
            look.requests.len()
        );
    }
    out
}
