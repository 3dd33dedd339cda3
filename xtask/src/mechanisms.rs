//! `cargo xtask mechanisms`: the numbers and pictures of docs/mechanisms.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use fogcoil::cache::Cache;
use fogcoil::comparison::Comparison;
use fogcoil::explain::{Explained, Explanation, Reach, explain};
use fogcoil::glossary::mechanisms;
use fogcoil::input;

use coil::Mount;

use proof::{Failure, files};

const COIL: &str = "fixtures/coil-reference.ron";
/// Of the mount where one is drawn, W/(m² K).
const CONDUCTANCE: f64 = 20.0;
const PAGES: &str = "docs/mechanisms";
/// Their numbers, which `fogcoil explain ID` prints.
const MEASURED: &str = "crates/fogcoil/src/glossary/measured.md";
const PICTURES: &str = "docs/pictures/mechanisms";
/// Measured sensitivities of Table IV, (deg/h)/(degC/min).
const COILS: [f64; 3] = [3.01, 1.39, 1.98];
/// Between these lines a page holds what this command writes.
const MARKS: [&str; 2] = ["<!-- measured: written by `cargo xtask mechanisms` -->", "<!-- measured end -->"];

/// Writes the measured part of every page and all pictures; always `true`.
pub(crate) fn run() -> Result<bool, Failure> {
    let case = input::read_coil(COIL.as_ref())?;
    let comparison = Comparison::measure(&case, &Cache::of_user(), &|task| eprintln!("{task}"))?;
    let on_request = Comparison::on_request(&case, &Cache::of_user(), &|task| eprintln!("{task}"))?;
    // what acts on a mount that is drawn
    let mut mounted = case.clone();
    let sides = case.design.spool.iter().flat_map(|spool| &spool.flanges).map(|flange| flange.side);
    mounted.design.heat.mounts.extend(sides.map(|side| Mount { side, conductance: CONDUCTANCE }));
    let is_new = |id: &str| comparison.entries.iter().all(|known| known.id != id);
    let drawn = Comparison::only(&mounted, is_new, &Cache::of_user(), &|task| eprintln!("{task}"))?;
    fs::create_dir_all(PICTURES)?;
    let pictures = Path::new(PICTURES);
    let mut measured = String::new();
    let of = |all| move |entry| (entry, all);
    let entries = [&comparison, &drawn, &on_request].into_iter().flat_map(|all| all.entries.iter().map(of(all)));
    let mut count = 0;
    for (entry, all) in entries {
        let file = format!("{}.svg", entry.id);
        fs::write(pictures.join(&file), all.signature(entry))?;
        let mut numbers = all.page(entry, &format!("../pictures/mechanisms/{file}"));
        count += 1;
        if std::ptr::eq(all, &raw const drawn) {
            let _ = write!(numbers, "\nThe reference coil has a mount of {CONDUCTANCE} W/(m² K) here.\n");
        }
        let _ = write!(measured, "# {}\n\n{}\n\n", entry.id, numbers.trim());
        let mechanism =
            mechanisms().find(|m| m.id == entry.id).ok_or_else(|| Failure(format!("{}: no such mechanism", entry.id)))?;
        fs::write(Path::new(PAGES).join(format!("{}.md", entry.id)), mechanism.page(&numbers))?;
    }
    fs::write(MEASURED, format!("{}\n", measured.trim_end()))?;
    let last = comparison.programmes.len() - 1;
    fs::write(pictures.join("confusion.svg"), comparison.confusion(&[0, last]))?;
    rewrite(&Path::new(PAGES).join("README.md"), &comparison.overview())?;
    rewrite(&Path::new(PAGES).join("on-request.md"), &on_request.overview())?;
    let coils = COILS.map(|measured| explain(&case, measured, true, &Cache::of_user(), &|task| eprintln!("{measured}: {task}")));
    let [a, b, c] = coils;
    rewrite(&Path::new(PAGES).join("paper-coils.md"), &coils_text(&[a?, b?, c?]))?;
    println!("{PAGES} and {PICTURES}: {} mechanisms", count);
    Ok(true)
}

/// Explanations of several coils of one design, side by side.
fn coils_text(coils: &[Explained]) -> String {
    let row = |name: &str, cell: &dyn Fn(&Explained) -> String| {
        let cells: Vec<String> = coils.iter().map(cell).collect();
        format!("| {name} | {} |\n", cells.join(" | "))
    };
    let mut out = row("measured, (°/h)/(°C/min)", &|c| format!("{:.2}", c.measured.abs()));
    out.push_str(&format!("|---|{}\n", "---|".repeat(coils.len())));
    out += &row("the design's own constants together", &|c| format!("{:+.1} σ", c.recalibrate));
    for (k, first) in coils[0].explanations.iter().enumerate() {
        if matches!(first.outcome, Reach::Unable { .. }) {
            continue;
        }
        let when = if first.when.is_empty() { String::new() } else { format!(", {}", first.when) };
        out += &row(&format!("{} (`{}`){when}", first.id, first.parameter), &|c| outcome(&c.explanations[k]));
    }
    out.push_str("\n| a tail told from | measured | ln odds, slow ramp | ln odds, best | by |\n|---|---|---|---|---|\n");
    for coil in coils {
        for test in &coil.tests {
            let (slow, best) = (test.slow.1.log_odds, test.best.1.log_odds);
            let by = if test.best.1.decides() { test.best.0.as_str() } else { "none of these" };
            let _ = writeln!(out, "| {} | {:.2} | {slow:.1} | {best:.1} | {by} |", test.between[1], coil.measured.abs());
        }
    }
    out
}

fn outcome(explanation: &Explanation) -> String {
    match explanation.outcome {
        Reach::Gives { value, sigma, layer: None, .. } => format!("{value:.3} ({sigma:+.1} σ)"),
        Reach::Gives { value, sigma, layer: Some((layer, others)), .. } => {
            format!("{value:.0} in layer {layer} ({sigma:+.1} σ), plausible in {others} layers")
        }
        Reach::OutOfReach { range: [low, high] } => {
            format!("only {:.2} to {:.2}", low.abs().min(high.abs()), low.abs().max(high.abs()))
        }
        Reach::Unable { .. } => "unable".into(),
    }
}

/// Puts `text` between the marks of a page.
fn rewrite(page: &Path, text: &str) -> Result<(), Failure> {
    files::renew(page, MARKS, &format!("\n\n{}\n", text.trim_end()))
}
