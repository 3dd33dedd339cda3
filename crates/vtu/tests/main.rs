//! Grids and series as they stand in their files.

use vtu::{Array, Entry, Grid, Series};

fn square() -> Grid {
    Grid {
        points: vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        quadrilaterals: vec![[0, 1, 2, 3]],
        of_points: vec![Array::components("u", &["R", "Y"], (0..8).map(f64::from).collect())],
        of_cells: vec![Array::whole("part", vec![3])],
    }
}

fn text(grid: &Grid) -> Result<String, std::io::Error> {
    let mut file = Vec::new();
    grid.write(&mut file).map(|()| String::from_utf8(file).expect("text"))
}

#[test]
fn a_grid_holds_its_points_cells_and_values() {
    let text = text(&square()).unwrap();
    let array = |name: &str| {
        let rest = text.split_once(&format!("Name=\"{name}\"")).unwrap().1;
        let body = rest.split_once('>').unwrap().1.split_once('<').unwrap().0;
        body.split_whitespace().map(|word| word.parse().unwrap()).collect::<Vec<f64>>()
    };
    assert_eq!(array("position"), [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    // a vector of the plane has no third component, but viewers want one
    assert_eq!(array("u"), [0.0, 1.0, 0.0, 2.0, 3.0, 0.0, 4.0, 5.0, 0.0, 6.0, 7.0, 0.0]);
    assert!(text.contains("Name=\"u\" NumberOfComponents=\"3\""), "{text}");
    assert_eq!(
        [array("part"), array("connectivity"), array("offsets"), array("types")].concat(),
        [3.0, 0.0, 1.0, 2.0, 3.0, 4.0, 9.0]
    );
    assert!(text.contains("ComponentName0=\"R\" ComponentName1=\"Y\""), "{text}");
}

#[test]
fn bounds_an_array_that_does_not_fit_and_a_cell_without_its_points_are_refused() {
    let short = Grid { of_points: vec![Array::scalar("t", vec![1.0; 3])], ..square() };
    assert!(text(&short).unwrap_err().to_string().contains("t does not have its values at each of 4 points"));
    let odd = Grid { of_cells: vec![Array::components("e", &["A", "B"], vec![1.0; 3])], ..square() };
    assert!(text(&odd).unwrap_err().to_string().contains("1 cells"));
    let beyond = Grid { quadrilaterals: vec![[0, 1, 2, 4]], ..square() };
    assert!(text(&beyond).unwrap_err().to_string().contains("cell 0 names a point beyond the 4"));
}

#[test]
fn a_series_lists_its_parts_at_each_instant() {
    let entry = |time: f64, part: usize| Entry { time, part, file: format!("a&b_{part}.vtu") };
    let mut file = Vec::new();
    Series { entries: vec![entry(0.1, 0), entry(0.1, 1)] }.write(&mut file).unwrap();
    let text = String::from_utf8(file).expect("text");
    assert!(text.contains("<DataSet timestep=\"0.1\" group=\"\" part=\"1\" file=\"a&amp;b_1.vtu\"/>"), "{text}");
}
