//! The section as files for ParaView: they are read back, fill the section's area, and carry the bias of the table.

use std::collections::BTreeMap;

use crate::common::{COIL, Folder, change, stderr};

/// An unstructured grid as it stands in its file.
struct Read {
    arrays: BTreeMap<String, Vec<f64>>,
}

impl Read {
    fn of(text: &str) -> Self {
        let attribute = |tag: &str, name: &str| {
            let rest = tag.split_once(&format!("{name}=\""))?.1;
            Some(rest.split_once('"')?.0.to_owned())
        };
        assert!(text.starts_with("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\""));
        let piece = text.split_once("<Piece ").unwrap().1.split_once('>').unwrap().0;
        let count = |name: &str| attribute(piece, name).unwrap().parse::<usize>().unwrap();
        let (points, cells) = (count("NumberOfPoints"), count("NumberOfCells"));
        let mut arrays = BTreeMap::new();
        for array in text.split("<DataArray ").skip(1) {
            let (tag, rest) = array.split_once('>').unwrap();
            let values: Vec<f64> =
                rest.split_once("</DataArray>").unwrap().0.split_whitespace().map(|w| w.parse().unwrap()).collect();
            let name = attribute(tag, "Name").unwrap();
            let width = attribute(tag, "NumberOfComponents").map_or(1, |n| n.parse().unwrap());
            if name != "connectivity" {
                assert!([points, cells].iter().any(|places| values.len() == places * width), "{name}");
            }
            arrays.insert(name, values);
        }
        let read = Self { arrays };
        assert_eq!((read["position"].len(), read["connectivity"].len()), (3 * points, 4 * cells));
        assert!(read["connectivity"].iter().all(|point| (*point as usize) < points));
        assert!(read["types"].iter().all(|kind| *kind == 9.0));
        read
    }

    /// By the corners, in the order in which they are named.
    fn area(&self) -> f64 {
        let corner = |point: f64| [0, 1].map(|c| self["position"][3 * point as usize + c]);
        let quadrilateral = |four: &[f64]| {
            let at: Vec<[f64; 2]> = four.iter().map(|point| corner(*point)).collect();
            (0..4).map(|k| at[k][0] * at[(k + 1) % 4][1] - at[(k + 1) % 4][0] * at[k][1]).sum::<f64>() / 2.0
        };
        self["connectivity"].chunks(4).map(quadrilateral).sum()
    }
}

impl std::ops::Index<&str> for Read {
    type Output = Vec<f64>;
    fn index(&self, name: &str) -> &Vec<f64> {
        &self.arrays[name]
    }
}

const SIMULATE: [&str; 8] = ["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--vtu", "section"];

fn simulated(profile: &str) -> Folder {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", profile);
    let output = folder.run(&SIMULATE);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    folder
}

fn read(folder: &Folder, name: &str) -> Read {
    Read::of(&std::fs::read_to_string(folder.path("section").join(name)).unwrap())
}

#[test]
fn the_solids_fill_their_area_and_the_turns_carry_the_bias() {
    // a minute of rows every 2 s, in which the rate is nearly steady
    let rows: Vec<String> = (0..=330).map(|k| format!("{},{}", 2 * k, 20.0 + f64::from(k) / 30.0)).collect();
    let folder = simulated(&format!("time_s,chamber_c\n{}\n", rows.join("\n")));
    let series = std::fs::read_to_string(folder.path("section/section.pvd")).unwrap();
    let entries: Vec<&str> = series.lines().filter(|line| line.starts_with("<DataSet ")).collect();
    assert_eq!(entries.len(), 31 * 4, "coil, hub, right flange and turns");
    for entry in &entries {
        let name = entry.split("file=\"").nth(1).unwrap().split('"').next().unwrap();
        assert!(folder.path("section").join(name).is_file(), "{name}");
    }
    assert!(entries[0].contains("timestep=\"0\"") && entries[123].contains("timestep=\"660\""), "{}", entries[123]);
    // the reference coil: 5.325 × 18.02 mm on a hub of 4 mm, with a flange of 2 mm that reaches 1 mm beyond
    let areas = [("coil", 5.325e-3 * 18.02e-3), ("hub", 4e-3 * 18.02e-3), ("right_flange", 2e-3 * (48.825e-3 + 1e-3 - 39.5e-3))];
    for (part, area) in areas {
        let found = read(&folder, &format!("{part}_30.vtu")).area();
        assert!((found / area - 1.0).abs() < 1e-6, "{part}: {found} of {area}");
    }
    // the last frame is the end of the last row, whose rate is that of its middle
    let turns = read(&folder, "turns_30.vtu");
    let table = std::fs::read_to_string(folder.path("b.csv")).unwrap();
    let lines: Vec<&str> = table.lines().rev().take(2).collect();
    let [last, before] = [0, 1].map(|k| lines[k].split(',').map(|word| word.parse().unwrap()).collect::<Vec<f64>>());
    for (name, column) in [("shupe", 3), ("eo_axial", 4), ("eo_radial", 5), ("bias", 6)] {
        let sum: f64 = turns[format!("{name}_deg_per_h").as_str()].iter().sum();
        let expected = 1.5 * last[column] - 0.5 * before[column];
        assert!((sum - expected).abs() < 1e-5 * last[6].abs(), "{name}: {sum} against {expected}");
    }
    let coil = read(&folder, "coil_30.vtu");
    let ends = |values: &[f64]| values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)]);
    let ([cold, warm], [least, most]) = (ends(&coil["temperature_c"]), ends(&turns["temperature_c"]));
    assert!(cold - 0.01 < least && most < warm + 0.01 && cold > 20.0 && warm < 31.0, "{cold} {least} {most} {warm}");
}

#[test]
fn a_profile_of_one_row_is_one_instant_at_rest() {
    let folder = simulated("time_s,chamber_c\n0,20\n");
    let coil = read(&folder, "coil_00.vtu");
    assert!(coil["temperature_c"].iter().all(|t| (t - 20.0).abs() < 1e-9));
    assert!(coil["strain"].iter().chain(&coil["displacement_m"]).all(|value| value.abs() < 1e-15));
    assert!(!folder.path("section/coil_01.vtu").exists());
}

#[test]
fn no_file_that_the_run_reads_is_replaced_and_a_mistake_leaves_no_folder() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("section")).unwrap();
    folder.write("section/hub_03.vtu", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n30,20\n");
    let arguments = SIMULATE.map(|word| if word == "coil.ron" { "section/hub_03.vtu" } else { word });
    let output = folder.run(&arguments);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("hub_03.vtu: is given twice, or is an input"), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(folder.path("section/hub_03.vtu")).unwrap(), COIL);
    let folder = Folder::new();
    folder.write("coil.ron", change(COIL, "layers: 36", "layers: 37"));
    folder.write("p.csv", "time_s,chamber_c\n0,20\n30,20\n");
    assert_eq!(folder.run(&SIMULATE).status.code(), Some(2));
    assert_eq!(folder.names(), ["coil.ron", "p.csv"]);
    folder.write("section", "a file");
    folder.write("coil.ron", COIL);
    let output = folder.run(&SIMULATE);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("section"), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(folder.path("section")).unwrap(), "a file");
    let output = folder.run(&SIMULATE.map(|word| if word == "section" { "b.csv" } else { word }));
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}
