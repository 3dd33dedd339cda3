//! The report: well-formed, and complete in itself.
#![allow(clippy::unwrap_used)]

mod common;

use common::{COIL, Folder, change, stderr};

fn report(coil: &str, profile: &str) -> String {
    let folder = Folder::new();
    folder.write("coil.ron", coil);
    folder.write("p & <q>.csv", profile);
    let output =
        folder.run(&["simulate", "coil.ron", "--profile", "p & <q>.csv", "--out", "b.csv", "--report", "r.html", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    std::fs::read_to_string(folder.path("r.html")).unwrap()
}

/// Every element that is opened is closed in its turn, every attribute is quoted, every bare ampersand is an entity.
fn assert_well_formed(page: &str) {
    let page = page.strip_prefix("<!DOCTYPE html>").unwrap();
    let mut open: Vec<&str> = Vec::new();
    for (i, piece) in page.split('<').enumerate().skip(1) {
        let (tag, text) = piece.split_once('>').unwrap_or_else(|| panic!("tag {i} is not closed: {piece}"));
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "tag {i}");
        } else if !tag.ends_with('/') {
            open.push(tag.split_whitespace().next().unwrap());
        }
        assert!(!text.contains('>') || open.last() == Some(&"style"), "{text}");
        let entity = |rest: &str| ["amp;", "lt;", "gt;", "quot;"].iter().any(|entity| rest.starts_with(entity));
        assert!(text.split('&').skip(1).all(entity), "{text}");
    }
    assert_eq!(open, [""; 0]);
}

#[test]
fn the_report_is_well_formed_and_needs_nothing_else() {
    let coil = change(COIL, "name: \"reference-coil\"", "name: \"a <b> & \\\"c\\\"\"");
    let page = report(&coil, "time_s,chamber_c\n0,20\n60,21\n120,22\n600,22\n");
    assert_well_formed(&page);
    for banned in ["http://", "https://", "<script", "<link", "<img", "url(", "@import", "javascript:", "onclick", "NaN", "inf "]
    {
        assert!(!page.contains(banned), "{banned}");
    }
    assert!(page.contains("a &lt;b&gt; &amp; &quot;c&quot; under p &amp; &lt;q&gt;.csv"));
    let ids: Vec<&str> = page.split(" id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert!(ids.iter().enumerate().all(|(i, id)| !ids[..i].contains(id)), "{ids:?}");
    for labels in page.split("aria-labelledby=\"").skip(1) {
        assert!(labels.split('"').next().unwrap().split(' ').all(|id| ids.contains(&id)));
    }
    assert_eq!(page.matches("role=\"img\"").count(), 6, "three plots, for wide and narrow paper");
    for part in ["°/h", "[°C]", "[°C/min]", "FNV-1a", env!("CARGO_PKG_VERSION"), "prefers-color-scheme: dark", "<details>"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn a_profile_of_any_length_and_size_has_a_report() {
    for profile in ["0,20\n", "0,20\n30,20\n", "0,0\n1e-6,1000\n1e12,-273.15\n", "0,1e-300\n5,-1e-300\n"] {
        let page = report(COIL, &format!("time_s,chamber_c\n{profile}"));
        assert_well_formed(&page);
        assert!(!page.contains("NaN") && !page.contains("inf "), "{profile}");
    }
}

#[test]
fn the_report_names_what_heats_the_coil() {
    let sensor = "sensor: (radius_mm";
    let heat = "heat: (mounts: [(side: Right, conductance_w_per_m2k: 50.0)], heaters: [(side: Right, power_w: 0.25)]), ";
    let page = report(&change(COIL, sensor, &format!("{heat}{sensor}")), "time_s,chamber_c\n0,20\n30,20\n");
    assert!(page.contains("50 W/(m² K)") && page.contains("0.25 W, on from the first row") && page.contains("heaters"));
}
