//! The report: well-formed, and complete in itself.

use charts::faults;

use crate::common::{COIL, Folder, change, stderr};

fn report(coil: &str, profile: &str) -> String {
    let folder = Folder::new();
    folder.write("coil.ron", coil);
    folder.write("p & <q>.csv", profile);
    let output =
        folder.run(&["simulate", "coil.ron", "--profile", "p & <q>.csv", "--out", "b.csv", "--report", "r.html", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    std::fs::read_to_string(folder.path("r.html")).unwrap()
}

#[test]
fn the_report_is_well_formed_and_needs_nothing_else() {
    let coil = change(COIL, "name: \"reference-coil\"", "name: \"a <b> & \\\"c\\\"\"");
    let page = report(&coil, "time_s,chamber_c\n0,20\n60,21\n120,22\n600,22\n");
    assert_eq!(faults(&page), [""; 0]);
    assert!(page.contains("a &lt;b&gt; &amp; &quot;c&quot; under p &amp; &lt;q&gt;.csv"));
    let figures = [
        "section",
        "section-in-time",
        "model",
        "temperatures",
        "bias",
        "bias-against-rate",
        "temperature-along-fibre",
        "radial-strain-along-fibre",
        "axial-strain-along-fibre",
        "contributions",
        "convergence",
    ];
    assert_eq!(page.matches("role=\"img\"").count(), 2 * figures.len(), "each for wide and narrow paper");
    assert_eq!(page.matches("<details>").count(), figures.len(), "a table for each");
    for figure in figures {
        for size in ["wide", "narrow"] {
            assert!(page.contains(&format!(" id=\"{figure}-{size}-title\"")), "{figure}-{size}");
        }
    }
    for part in ["°/h", "[°C]", "[°C/min]", "SHA-256", env!("CARGO_PKG_VERSION"), "prefers-color-scheme: dark", "<details>"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn a_profile_of_any_length_and_size_has_a_report() {
    for profile in ["0,20\n", "0,20\n30,20\n", "0,0\n1e-6,1000\n1e12,-273.15\n", "0,1e-300\n5,-1e-300\n"] {
        let page = report(COIL, &format!("time_s,chamber_c\n{profile}"));
        assert_eq!(faults(&page), [""; 0], "{profile}");
    }
}

#[test]
fn every_design_has_its_figures() {
    let spool = |text: &str| {
        let (before, rest) = COIL.split_once("    spool: Some((").unwrap();
        let (_, after) = rest.split_once("    )),\n").unwrap();
        format!("{before}    spool: {text},\n{after}")
    };
    let material = "material: (youngs_modulus_gpa: 68.9, poisson_ratio: 0.33, thermal_expansion_per_k: 23.6e-6, \
                    conductivity_w_per_mk: 167.0, density_kg_per_m3: 2700.0, specific_heat_j_per_kgk: 896.0), hub_thickness_mm: 4.0, ";
    let flange = |side: &str, bonded: bool| format!("(side: {side}, thickness_mm: 2.0, overhang_mm: 1.0, bonded: {bonded})");
    let two = format!("Some(({material}hub_bonded: false, flanges: [{}, {}]))", flange("Left", false), flange("Right", true));
    let bare = format!("Some(({material}hub_bonded: true, flanges: []))");
    let few = |coil: String| {
        change(
            &change(&change(&coil, "layers: 36", "layers: 3"), "odd_layers: 106", "odd_layers: 3"),
            "even_layers: 105",
            "even_layers: 2",
        )
    };
    let small =
        change(&change(&spool("None"), "outer_radius_mm: 48.825", "outer_radius_mm: 44.1"), "height_mm: 18.02", "height_mm: 0.6");
    let film = change(COIL, "sensor: (radius_mm", "heat: (film_w_per_m2k: Some(20.0)), sensor: (radius_mm");
    for coil in [spool("None"), spool(&two), spool(&bare), few(small), film] {
        let page = report(&coil, "time_s,chamber_c\n0,20\n600,30\n1200,15\n");
        assert_eq!(faults(&page), [""; 0]);
        let numberless = ["inf<", "infL", "infV", "infH"].into_iter().find(|word| page.contains(word));
        assert_eq!(numberless, None, "{coil}");
        assert_eq!(page.matches("<figure>").count(), 11);
    }
}

#[test]
fn figures_alone_are_documents_and_the_contributions_add_up() {
    let folder = Folder::new();
    // unequal tails have a part in the bias
    folder.write("coil.ron", change(COIL, "tails_m: (cw: 0.0, ccw: 0.0)", "tails_m: (cw: 0.4, ccw: 0.0)"));
    folder.write("p.csv", "time_s,chamber_c\n0,20\n3600,40\n7200,30\n");
    let case = fogcoil::input::read_coil(&folder.path("coil.ron")).unwrap();
    let profile = fogcoil::input::read_profile(&folder.path("p.csv"), &case.design, &[]).unwrap();
    let cache = fogcoil::cache::Cache::NONE;
    let (model, fields) = fogcoil::simulate::model_with_fields(&case, &profile.drives, &cache).unwrap();
    let simulation = fogcoil::simulate::simulate(&case, &profile, &model).unwrap();
    let documents = fogcoil::figures::documents(&simulation, Some(&fields), &[("a unit", -1.98)]);
    assert!(documents.iter().any(|(name, svg)| *name == "bias-against-rate" && svg.contains("a unit: slope \u{2212}1.98")));
    assert_eq!(documents.len(), 10);
    let winding = ("winding", fogcoil::picture::svg(&case.name, &case.winding));
    for (name, svg) in documents.iter().chain([&winding]) {
        let said = |tag: &str| {
            let rest = svg.split_once(&format!("<{tag} id=")).map_or("", |(_, rest)| rest);
            rest.split(['>', '<']).nth(1).unwrap_or("").to_owned()
        };
        assert!(svg.contains("role=\"img\""), "{name}");
        assert!(said("title").len() > 8 && said("desc").len() > 30, "{name}: {}; {}", said("title"), said("desc"));
        assert!(svg.starts_with("<svg xmlns=") && svg.len() < 400_000, "{name}: {} bytes", svg.len());
        assert!(!svg.contains("NaN") && !svg.contains("var(") && !svg.contains(">inf"), "{name}");
    }
    let ramp = fogcoil::figures::contributions_in_ramp(&simulation, &fields.turns).unwrap();
    let sum = ramp.turns.iter().fold(ramp.tails, |sum, turn| sum + *turn);
    // on the mesh of the fields
    let steady = coil::Model::new(&case.design, &coil::COARSE).unwrap().sensitivity().unwrap();
    for (part, expected) in [(sum.shupe, steady.shupe), (sum.eo_axial, steady.eo_axial), (sum.eo_radial, steady.eo_radial)] {
        assert!((part - expected).abs() < 1e-8, "{part} against {expected}");
    }
    // a title's sum is that of the whole fibre
    let together = format!("tails {}, together {}", charts::signed(ramp.tails.total(), 3), charts::signed(steady.total(), 3));
    // a long heading has several lines
    let of = |figure: &str| {
        let svg = &documents.iter().find(|(name, _)| *name == figure).unwrap().1;
        svg.split("</text>").map(|text| text.rsplit_once('>').map_or(text, |(_, text)| text)).collect::<Vec<_>>().join(" ")
    };
    assert!(ramp.tails.total().abs() > 0.01 && of("contributions").contains(&together), "{together}");
    assert!(of("section").contains(": together "));
}

#[test]
fn the_report_names_what_heats_the_coil() {
    let sensor = "sensor: (radius_mm";
    let heat = "heat: (mounts: [(side: Right, conductance_w_per_m2k: 50.0)], heaters: [(side: Right, power_w: 0.25)]), ";
    let page = report(&change(COIL, sensor, &format!("{heat}{sensor}")), "time_s,chamber_c\n0,20\n30,20\n");
    assert!(page.contains("50 W/(m² K)") && page.contains("0.25 W, on from the first row") && page.contains("heaters"));
}
