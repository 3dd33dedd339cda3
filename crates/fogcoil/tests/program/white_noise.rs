//! White noise as `fogcoil check` states it: its uncertainty is honest whatever else is in the record.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::common::{Folder, stdout};
use serde_json::Value;

/// xorshift64* and Box–Muller.
fn normals(seed: u64) -> impl FnMut() -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15 ^ (seed + 1).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mut uniform = move || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    };
    move || (-2.0 * (1.0 - uniform()).ln()).sqrt() * (TAU * uniform()).cos()
}

/// What a record holds beside white noise.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// A slow response to the chamber's ramps.
    Ramps,
    /// The same, read by a thermometer with the noise of a cheap one.
    NoisyThermometer,
    /// The same at a standstill, with a line.
    Line,
    /// A hum whose frequency wanders, so that it is no line.
    Hum,
    /// A bond that opens above a temperature, and closes.
    Opening,
}

/// Rows of 20 s under ramps between -40 and 60 degC; `white` is that of the rate in a row \[deg/h\], and everything else is in proportion.
fn record(kind: Kind, seed: u64, white: f64) -> String {
    let mut normal = normals(seed);
    let (mut fast, mut slow, mut phase) = (20.0, 20.0, 0.0);
    let mut text = String::from("time_s,chamber_c,rate_deg_per_h\n");
    for row in 0..1500 {
        let t = 20.0 * f64::from(row);
        let ramp = |from: f64, by: f64| ((t - from) / 57.0).clamp(0.0, by.abs()) * by.signum();
        let is_still = matches!(kind, Kind::Line | Kind::Hum);
        let chamber = 20.0 + if is_still { 0.0 } else { ramp(3600.0, -60.0) + ramp(9600.0, 100.0) + ramp(18_000.0, -40.0) };
        fast += (chamber - fast) * (1.0 - (-20.0_f64 / 90.0).exp());
        slow += (chamber - slow) * (1.0 - (-20.0_f64 / 900.0).exp());
        let is_open = kind == Kind::Opening && fast > 35.0;
        let response = white * (8.0 * (chamber - fast) + 1.5 * (fast - slow)) * if is_open { 2.0 } else { 1.0 };
        phase += TAU * 20.0 / 97.0 + if kind == Kind::Hum { 0.3 * normal() } else { 0.0 };
        let hum = if is_still { 3.0 * white * phase.sin() } else { 0.0 };
        let thermometer = if kind == Kind::NoisyThermometer { 0.05 } else { 1e-4 };
        let (read, rate) = (chamber + thermometer * normal(), 0.3 + response + hum + white * normal());
        writeln!(text, "{t},{read:.4},{rate:.9}").expect("a text takes everything");
    }
    text
}

/// Of any size of noise: the truth lies within the stated standard deviation twice over in nine records of ten, and never beyond three and a half.
#[test]
fn the_stated_error_of_white_noise_holds_the_truth() {
    const SEEDS: u64 = 10;
    let folder = Folder::new();
    for kind in [Kind::Ramps, Kind::NoisyThermometer, Kind::Line, Kind::Hum, Kind::Opening] {
        let sigmas = |seed: u64| {
            let white = [0.0134, 0.13, 1.3e-3][seed as usize % 3];
            folder.write("record.csv", record(kind, seed, white));
            let checked: Value =
                serde_json::from_str(&stdout(&folder.run(&["check", "--json", "record.csv"]))).expect("an object");
            let noise = &checked["noise"];
            let (found, error) =
                (noise["white_deg_per_h"].as_f64().unwrap(), noise["relative_errors"]["white"].as_f64().unwrap());
            ((found / white).ln() / error, error)
        };
        let all: Vec<(f64, f64)> = (0..SEEDS).map(sigmas).collect();
        let within = |sds: f64| all.iter().filter(|(z, _)| z.abs() < sds).count() as u64;
        assert!(10 * within(2.0) >= 9 * SEEDS && within(3.5) == SEEDS, "{kind:?}: {all:.2?}");
        // where the model is right it says so
        let is_right = kind != Kind::Hum && kind != Kind::Opening;
        assert!(!is_right || all.iter().all(|(_, error)| *error < 0.12), "{kind:?}: {all:.2?}");
    }
}

/// Six hours at rest in rows of a second, hum of 50 Hz that they fold to 0.21 Hz.
#[test]
fn a_line_is_told_and_is_no_noise() {
    let folder = Folder::new();
    let write = |name: &str, hum: f64| {
        let mut normal = normals(7);
        let row = |t: u32| {
            let rate = 11.0 + hum * (TAU * 0.21 * f64::from(t)).sin() + 0.09 * normal();
            format!("{t},{:.2},{rate:.4}\n", 35.0 + 0.01 * normal())
        };
        let rows: String = (0..21_600).map(row).collect();
        folder.write(name, format!("time_s,chamber_c,rate_deg_per_h\n{rows}"));
    };
    write("hum.csv", 0.25);
    write("clean.csv", 0.0);
    let check = |name: &str| stdout(&folder.run(&["check", name]));
    let (hum, clean) = (check("hum.csv"), check("clean.csv"));
    let told = "warning: rate_deg_per_h has a line with a period of 4.762 s and an amplitude of 0.25 deg/h: ";
    assert!(hum.contains(told) && !clean.contains("[line]"), "{hum}{clean}");
    let value: Value = serde_json::from_str(&stdout(&folder.run(&["check", "--json", "hum.csv"]))).expect("an object");
    let noise = &value["noise"];
    assert!((noise["white_deg_per_h"].as_f64().unwrap() / 0.09 - 1.0).abs() < 0.03, "{noise}");
    assert_eq!((noise["lines"].as_array().map(Vec::len), &noise["lines"][0]["of_temperature"]), (Some(1), &Value::Null));
    // the model goes through its own Allan deviation
    for point in noise["allan"].as_array().unwrap().iter().take(12) {
        let of = |key: &str| point[key].as_f64().unwrap();
        assert!((of("model_deg_per_h") / of("deviation_deg_per_h") - 1.0).abs() < 0.15, "{point}");
    }
    let measured = stdout(&folder.run(&["measure", "hum.csv"]));
    assert!(measured.contains(told.trim_start_matches("warning: ")) && measured.contains("[line]"), "{measured}");
}
