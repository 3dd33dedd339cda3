//! The comparison as one HTML page that needs nothing but itself.

use charts::{Cells, facts, grid, nice, page, row};
use fogcoil::figures::{OnSpool, spools_element};
use fogcoil::input::Fingerprint;
use fogcoil::report::provenance;
use maud::{Markup, html};

use proof::validation::report::{kind, verdict};
use proof::validation::{ComparisonRow, Section, Verdict, printed};
use proof::{Failure, files};

/// Inputs besides the code.
const INPUTS: [(&str, &str); 10] = [
    ("cell", "fixtures/cell-reference.ron"),
    ("coil", "fixtures/coil-reference.ron"),
    ("the paper's tables", "fixtures/paper/tables.ron"),
    ("independent values", "fixtures/independent.ron"),
    ("spool materials", "fixtures/spool-materials.ron"),
    ("independent response", "fixtures/nominal/P1.csv"),
    ("independent response", "fixtures/nominal/P2.csv"),
    ("independent response", "fixtures/nominal/P3.csv"),
    ("independent response", "fixtures/nominal/P4.csv"),
    ("independent response", "fixtures/nominal/P5.csv"),
];

/// The meaning of the words in the tables.
const WORDS: [(&str, &str); 8] = [
    ("predicted", "follows from inputs that owe nothing to the printed value"),
    ("verified", "nothing printed is compared: the program agrees with itself, with an identity, or with an independent code"),
    ("identified", "the inputs were identified from the printed values: the cell's constituents, which the paper does not print"),
    ("calibrated", "an input that the paper leaves open was chosen to agree: the spool"),
    ("misprint", "the printed value cannot be right as it stands; the reason is given"),
    ("holds, differs, FAILS", "the outcome of a test; (must): the command fails with this row"),
    ("shown", "nothing is tested, as of an input"),
    (
        "± of a computed value",
        "the program's own estimate of its numerical error; it says nothing about physics that a model leaves out",
    ),
];

pub(super) fn html(sections: &[Section]) -> Result<String, Failure> {
    let words: Vec<_> = WORDS.iter().map(|(word, meaning)| row(word, *meaning)).collect();
    let read = |(role, file): (&'static str, &'static str)| {
        let content = std::fs::read(files::root().join(file)).map_err(|e| Failure(format!("{file}: {e}")))?;
        Ok((role, Fingerprint::of(file.into(), &content)))
    };
    let files = INPUTS.into_iter().map(read).collect::<Result<Vec<_>, Failure>>()?;
    let files: Vec<_> = files.iter().map(|(role, file)| (*role, file)).collect();
    let printed = printed()?;
    let mut parts = vec![("Summary", summary(sections)), ("Words", facts("Words", &words))];
    parts.extend(sections.iter().map(|section| (section.title.as_str(), one(section, &printed))));
    parts.push(provenance("cargo xtask validate", &files, &[row("options", "none")]));
    Ok(page("Validation against the paper's Tables I to IV", &lead(sections), &charts::sections(&parts)))
}

fn rows(sections: &[Section]) -> impl Iterator<Item = &ComparisonRow> {
    sections.iter().flat_map(|section| &section.rows)
}

fn lead(sections: &[Section]) -> Markup {
    let must = rows(sections).filter(|row| row.must_hold).count();
    let failed = rows(sections).filter(|row| row.verdict == Verdict::Fails).count();
    let differ = rows(sections).filter(|row| row.verdict == Verdict::Differs).count();
    html! {
        p {
            (must - failed) " of " (must) " rows that must hold do; " (differ) " others differ, for the reasons given. Osunluk et al., \
            Tables I to IV, and an independent finite-element code."
        }
    }
}

fn summary(sections: &[Section]) -> Markup {
    const VERDICTS: [Verdict; 4] = [Verdict::Holds, Verdict::Differs, Verdict::Fails, Verdict::Shown];
    let count = |section: &Section, verdict| section.rows.iter().filter(|row| row.verdict == verdict).count().to_string();
    let line = |section: &Section| {
        std::iter::once(section.title.clone()).chain(VERDICTS.map(|verdict| count(section, verdict))).collect()
    };
    let lines: Vec<Vec<String>> = sections.iter().map(line).collect();
    grid("Rows by verdict", Cells::Words, &["table", "hold", "differ", "fail", "are shown"], &lines)
}

fn one(section: &Section, (label, value): &(String, f64)) -> Markup {
    let line = |row: &ComparisonRow| {
        vec![
            row.quantity.clone(),
            row.printed.clone().unwrap_or_else(|| "–".into()),
            row.computed_text(),
            if row.unit.starts_with('-') { row.unit.replacen('-', "1", 1) } else { row.unit.clone() },
            format!("{}{}", verdict(row), if row.must_hold { " (must)" } else { "" }),
            kind(row.kind).to_owned(),
            row.reason.clone(),
        ]
    };
    let lines: Vec<Vec<String>> = section.rows.iter().map(line).collect();
    let head = ["quantity", "printed", "computed", "unit", "verdict", "kind", "reason"];
    html! {
        @for note in &section.notes { p { (nice(note).replace(['`', '*'], "")) } "\n" }
        (grid(&format!("{}, row by row", section.title), Cells::Words, &head, &lines))
        @if !section.lines.is_empty() { (spools_element(&on_spools(&section.lines), (label, *value))) }
    }
}

/// Lines of the comparison of spools, "material, hub, flanges".
pub(crate) fn on_spools(lines: &[(String, f64)]) -> Vec<OnSpool> {
    let one = |(name, sensitivity): &(String, f64)| {
        let (material, mounting) = name.split_once(", ").unwrap_or((name, ""));
        OnSpool { material: material.into(), mounting: mounting.into(), sensitivity: *sensitivity }
    };
    lines.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proof::validation::Agreement;

    /// Two rows and a comparison of spools.
    fn sections() -> [Section; 1] {
        let row = ComparisonRow {
            id: "IV.theory".into(),
            quantity: "S of <a> & b".into(),
            printed: Some("2.71".into()),
            computed: -2.7335,
            numerical_error: 1.4e-3,
            unit: "(deg/h)/(degC/min)".into(),
            verdict: Verdict::Shown,
            kind: Agreement::Calibrated,
            must_hold: false,
            reason: String::new(),
        };
        let mut section = Section::new("Table IV");
        section.note("`Notes` stand *above*.");
        section.rows = vec![row.clone(), ComparisonRow { printed: None, ..row }.required(true)];
        section.lines = vec![("aluminium, 2 mm hub, two flanges".into(), -1.0), ("steel, 4 mm hub, none".into(), 3.5)];
        [section]
    }

    #[test]
    fn the_page_is_whole() {
        let page = html(&sections()).unwrap();
        assert_eq!(charts::faults(&page), [""; 0]);
        assert!(page.contains("−2.7335 ± 1.4e−3"), "{page}");
        assert!(page.contains("printed, Table IV: 2.71") && page.contains("1 of 1 rows that must hold do"));
    }

    #[test]
    fn the_json_keeps_its_schema() {
        let schema = std::fs::read_to_string(files::root().join("docs/schema/validate.schema.json")).unwrap();
        let schema = serde_json::from_str(&schema).unwrap();
        let json = proof::validation::report::json(&sections(), true);
        assert_eq!(fogcoil::schema::misfit(&json, &schema), None);
    }
}
