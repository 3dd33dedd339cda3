//! Cells of any arrangement, as text and JSON: constants along x, y, z at each temperature, their spread over realisations.

use serde_json::{Value, json};

use super::constants::{heavy, object, presentation};
use crate::input::{AtTemperature, GeneralCase};
use crate::table::{plus_minus, significant, table};

/// The constants in SI under their own names, `error_estimate`, and the further results of the response.
pub fn json(found: &AtTemperature) -> Value {
    let response = &found.first.response;
    let temperature = found.celsius.map(|celsius| ("temperature_c", celsius));
    let mut all = object(temperature.into_iter().chain(found.first.constants.named()));
    all.insert("error_estimate".into(), object(found.first.relative_error.clone()).into());
    all.append(&mut object(heavy(found.heavy)));
    all.insert("anisotropy".into(), found.anisotropy.into());
    all.insert("void_fraction".into(), void_fraction(found).into());
    let rows = |m: &nalgebra::Matrix6<f64>| (0..6).map(|i| m.row(i).iter().copied().collect()).collect::<Vec<Vec<f64>>>();
    all.insert("stiffness".into(), json!(rows(&response.stiffness)));
    all.insert("thermal_stress".into(), json!(response.thermal_stress.as_slice()));
    if let Some(nearest) = &found.nearest {
        all.insert("transversely_isotropic".into(), object(nearest.named()).into());
    }
    if let Some(spread) = &found.spread {
        let names = || found.first.constants.named().into_iter().map(|(name, _)| name);
        let of = |values: &[f64]| object(names().zip(values.iter().copied()));
        let all_of = json!({"realisations": spread.count, "mean": of(&spread.mean), "standard_deviation": of(&spread.deviation)});
        all.insert("spread".into(), all_of);
    }
    all.into()
}

fn void_fraction(found: &AtTemperature) -> f64 {
    let share = 1.0 - found.first.response.fractions.iter().sum::<f64>();
    // rounding of areas is no void
    if share.abs() < 1e-9 { 0.0 } else { share }
}

/// The constants as a table with units and numerical errors.
pub fn text(found: &AtTemperature, case: &GeneralCase) -> String {
    let mut rows = vec![["constant", "value", "numerical error"].map(String::from).to_vec()];
    if found.spread.is_some() {
        rows[0].extend(["mean of all", "standard deviation"].map(String::from));
    }
    rows[0].extend(["unit", "meaning"].map(String::from));
    let constants = found.first.constants.named().into_iter().zip(&found.first.relative_error);
    for (i, ((key, value), (_, relative))) in constants.enumerate() {
        let (unit, convert, meaning) = presentation(key);
        // what vanishes in symmetric cells has an error relative to its kind's size, which says nothing here
        let error =
            if ["alpha_xy", "k_xy", "m_rxy"].contains(&key) { "-".into() } else { plus_minus(relative * convert(value).abs()) };
        let mut row = vec![key.into(), significant(convert(value), 6), error];
        if let Some(spread) = &found.spread {
            row.extend([significant(convert(spread.mean[i]), 6), significant(convert(spread.deviation[i]), 2)]);
        }
        row.extend([unit.into(), meaning.into()]);
        rows.push(row);
    }
    for (key, value) in heavy(found.heavy) {
        let (gap, (unit, _, meaning)) = (vec![String::new(); rows[0].len() - 4], presentation(key));
        rows.push([vec![key.into(), significant(value, 6)], gap, vec![unit.into(), meaning.into()]].concat());
    }
    let at = found.celsius.map_or(String::new(), |t| format!(" at {t} degC"));
    let fibres = case.layouts[0].inclusions().len();
    let mut text =
        format!("{}{at}: effective constants; z = fibre (the coil's hoop), x and y across it\n\n{}\n", case.name, table(&rows));
    let response = &found.first.response;
    text += &format!(
        "{fibres} inclusions, {} elements of order {}, {} unknowns; void {:.3} % of the area; the errors are numerical, they say nothing about the \
         constituents\nnot transversely isotropic by {:.2e}: the largest relative difference of strain energy from the mean over all turns about z\n",
        found.first.solution.mesh.elements().len(),
        found.first.solution.mesh.order(),
        response.unknowns,
        100.0 * void_fraction(found),
        found.anisotropy
    );
    if let Some(t) = &found.nearest {
        let line = [
            ("e_z_gpa", t.e_z / 1e9),
            ("e_r_mpa", t.e_r / 1e6),
            ("g_zr_mpa", t.g_zr / 1e6),
            ("nu_zr", t.nu_zr),
            ("nu_r", t.nu_r),
            ("k_z", t.k_z),
            ("k_r", t.k_r),
            ("m_rx = m_ry", t.m_rx),
            ("m_rz", t.m_rz),
        ];
        let line = line.map(|(key, value)| format!("{key} {}", significant(value, 6)));
        text += &format!(
            "that mean, for a coil: {}, alpha_z {:.5e}, alpha_r {:.5e}, m_rt {:.5e} 1/K\n",
            line.join(", "),
            t.alpha_z,
            t.alpha_r,
            t.m_rt
        );
    }
    if let Some(spread) = &found.spread {
        text += &format!("value and errors are of the first of {} realisations", spread.count);
        text += ", the mean for a coil of all, the distance of the farthest\n";
    }
    text
}
