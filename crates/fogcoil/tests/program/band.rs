//! `fogcoil simulate --band` as a user runs it.

use crate::common::{COIL, Folder, schema, stderr, stdout};

/// The band against the full model with one constant a little to either side.
#[test]
fn the_band_is_what_a_tolerance_away_makes_of_the_rate() {
    let folder = Folder::new();
    folder.write("p.csv", "time_s,chamber_c\n0,20\n1800,20\n3600,50\n9000,50\n");
    let run = |coil: &str, more: &[&str]| -> (serde_json::Value, Vec<f64>) {
        folder.write("c.ron", coil);
        let arguments = ["simulate", "c.ron", "--profile", "p.csv", "--step", "60", "--out", "b.csv", "--json", "--quiet"];
        let output = folder.run(&[&arguments, more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let text = std::fs::read_to_string(folder.path("b.csv")).unwrap();
        let rates = text.lines().skip(1).map(|line| line.rsplit(',').next().unwrap().parse().unwrap()).collect();
        (serde_json::from_str(&stdout(&output)).unwrap(), rates)
    };
    let (json, rates) = run(COIL, &["--band", "band.csv", "--report", "band.html"]);
    let page = std::fs::read_to_string(folder.path("band.html")).unwrap();
    assert!(page.contains("By the design's tolerances the largest |bias| of a unit, at whichever instant it comes, is "));
    assert!(page.contains(" s the bias of a unit has a standard deviation of "));
    // the bias and the thermometer, each drawn wide and narrow
    assert_eq!(page.matches("± 1 standard deviation by the design's tolerances</text>").count(), 4);
    assert_eq!(fogcoil::schema::misfit(&json, &schema("simulate")), None);
    let table = std::fs::read_to_string(folder.path("band.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect();
    let band = &json["tolerances"];
    let peak = rows.iter().position(|row| row[0] == json["peak"]["time_s"].as_f64().unwrap()).unwrap();
    let sd = band["peak_deg_per_h"].as_f64().unwrap();
    assert!((rows[peak][1] - rates[peak]).abs() < 1e-12 && (rows[peak][2] - sd).abs() < 1e-12, "{:?}", rows[peak]);
    let shares = band["shares_at_peak"].as_array().unwrap();
    let share = |key: &str| shares.iter().find(|s| s["key"] == key).unwrap()["share"].as_f64().unwrap();
    assert!((shares.iter().map(|s| s["share"].as_f64().unwrap()).sum::<f64>() - 1.0).abs() < 1e-9);
    let scaled = |text: &str, key: &str, factor: f64| {
        let (before, rest) = text.split_once(&format!("{key}: ")).unwrap();
        let (value, after) = rest.split_once(',').unwrap();
        format!("{before}{key}: {},{after}", value.parse::<f64>().unwrap() * factor)
    };
    let stiffer = |factor: f64| scaled(&scaled(COIL, "e_r_mpa", factor), "g_zr_mpa", factor);
    let conducting = |factor: f64| {
        let at = COIL.find("medium: (").unwrap();
        format!("{}{}", &COIL[..at], scaled(&COIL[at..], "conductivity_w_per_mk", factor))
    };
    let cases: [(&str, &dyn Fn(f64) -> String); 2] =
        [("coil.material.e_r_mpa", &stiffer), ("surroundings.medium.conductivity_w_per_mk", &conducting)];
    for (key, with) in cases {
        // both have a tolerance of a tenth, and the band is linear: the slope at the drawing
        let [up, down] = [1.01, 0.99].map(|factor| run(&with(factor), &[]).1[peak]);
        let change = (0.1 / 0.02 * (up - down)).abs();
        let told = sd * share(key).sqrt();
        // the parametric model's own error
        assert!((told / change - 1.0).abs() < 0.005, "{key}: {told} {change}");
    }
    // the largest |rate| of a unit is never less than its rate in that row
    let largest = &band["largest_deg_per_h"];
    let of = |key: &str| largest[key].as_f64().unwrap();
    assert!(
        of("mean") >= rates[peak].abs() - 0.01 * sd && of("sd") > 0.0 && of("p05") < of("p50") && of("p50") < of("p95"),
        "{largest}"
    );
    folder.write("c.ron", COIL);
    let arguments =
        ["simulate", "c.ron", "--profile", "p.csv", "--step", "60", "--out", "b.csv", "--band", "band.csv", "--quiet"];
    let text = stdout(&folder.run(&arguments));
    for said in
        ["rate in the row of the drawing's largest |rate|", "of the variance of the rate in that row", "largest |rate| of a unit"]
    {
        assert!(text.contains(said), "{said}: {text}");
    }
    // what it is not made for is said
    folder.write("walls.csv", "time_s,chamber_c,left_c\n0,20,20\n3600,30,25\n");
    let output = folder.run(&["simulate", "c.ron", "--profile", "walls.csv", "--out", "w.csv", "--band", "w2.csv"]);
    assert!(output.status.code() == Some(2) && stderr(&output).contains("--band"), "{}", stderr(&output));
    assert!(!folder.path("w.csv").exists() && !folder.path("w2.csv").exists());
}

/// The largest |rate| over units, to first order and with units drawn, against designs that are each solved by themselves.
#[test]
#[ignore = "minutes"]
fn the_largest_rate_of_units_spreads_as_that_of_designs_within_tolerances() {
    let folder = Folder::new();
    folder.write("coil.ron", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/designs/small.ron")));
    let course = [(0, 20), (600, 20), (1500, 50), (2400, 50), (3300, 20), (4200, 20)];
    let between = |t: i32| {
        course
            .windows(2)
            .find(|w| t <= w[1].0)
            .map_or(20.0, |w| f64::from(w[0].1) + f64::from(w[1].1 - w[0].1) * f64::from(t - w[0].0) / f64::from(w[1].0 - w[0].0))
    };
    let rows: String = (0..=70).map(|n| format!("{},{}\n", 60 * n, between(60 * n))).collect();
    folder.write("p.csv", format!("time_s,chamber_c\n{rows}"));
    let plan =
        "(design: \"coil.ron\", sampling: Sobol(256), seed: 1, others: WithinTolerances, outputs: [Simulation(\"p.csv\")])";
    folder.write("plan.ron", plan);
    let json = |arguments: &[&str]| -> serde_json::Value {
        let output = folder.run(&[arguments, &["--json", "--quiet"]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        serde_json::from_str(&stdout(&output)).unwrap()
    };
    let swept = json(&["sweep", "plan.ron", "--out", "t.csv"]);
    let peak = swept["outputs"].as_array().unwrap().iter().find(|o| o["name"] == "peak_deg_per_h").unwrap();
    let arguments = ["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--band", "band.csv"];
    let told = json(&arguments);
    let largest = &told["tolerances"]["largest_deg_per_h"];
    let of = |object: &serde_json::Value, key: &str| object[key].as_f64().unwrap();
    let sd = of(peak, "sd");
    // 256 designs tell a standard deviation to a twentieth
    assert!((of(largest, "sd") / sd - 1.0).abs() < 0.1, "{largest} {peak}");
    for key in ["mean", "p05", "p95"] {
        assert!((of(largest, key) - of(peak, key)).abs() < 0.2 * sd, "{key}: {largest} {peak}");
    }
}
