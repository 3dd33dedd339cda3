//! The recordings, as their files hold them.

use super::cell;
use super::heaters;
use super::table::{self, means, medians, read};

/// A cell's test in a folder, such as `one_c` of cell `R1`.
pub(crate) fn cell(folder: &str, cell: &str, test: &str) -> Result<cell::Test, String> {
    let wanted = ["time_s", "current_a", "voltage_v", "surface_c"];
    let [time, current, voltage, surface] = arrayed(read(&format!("{folder}/{cell}_{test}.csv"), ',', &wanted)?)?;
    let [soc, volt] = arrayed(read(&format!("{folder}/{cell}_ocv.csv"), ',', &["soc", "ocv_v"])?)?;
    let mut open_circuit: Vec<[f64; 2]> = soc.iter().zip(&volt).map(|(s, v)| [*s, *v]).collect();
    open_circuit.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Ok(cell::Test { time, current, voltage, surface, open_circuit })
}

/// The board with two heaters.
pub(crate) fn heaters(path: &str) -> Result<heaters::Test, String> {
    let wanted = ["time_s", "heater1_percent", "heater2_percent", "t1_c", "t2_c"];
    let [time, q1, q2, t1, t2] = arrayed(read(path, ',', &wanted)?)?;
    Ok(heaters::Test { time, heaters: [q1, q2], thermometers: [t1, t2] })
}

/// A rate sensor's time \[s\], temperature \[°C\] and rates.
pub(crate) struct Rates {
    pub(crate) time: Vec<f64>,
    pub(crate) temperature: Vec<f64>,
    pub(crate) rates: Vec<Vec<f64>>,
}

/// Rows of a burst of which one is made, where rows are not yet medians of so many: a fifth of a burst.
const GROUP: usize = 50;
/// Interval below which rows are single readings \[ms\].
const SINGLE_MS: f64 = 100.0;

/// The cold chamber: three axes.
pub(crate) fn cold_chamber(path: &str) -> Result<Rates, String> {
    let names = ["time_ms", "temp_raw", "gyro_x_rad_per_s", "gyro_y_rad_per_s", "gyro_z_rad_per_s"];
    let [ms, raw, x, y, z] = arrayed(read(path, ',', &names)?)?;
    let group = if ms[1] - ms[0] < SINGLE_MS { GROUP } else { 1 };
    let ms = means(&ms, group);
    // 16 bits with a sign, 256 to the kelvin, about 25 °C
    let celsius: Vec<f64> = raw.iter().map(|r| 25.0 + (if *r > 32_767.0 { r - 65_536.0 } else { *r }) / 256.0).collect();
    Ok(Rates {
        time: ms.iter().map(|t| 1e-3 * (t - ms[0])).collect(),
        temperature: means(&celsius, group),
        rates: [x, y, z].iter().map(|rate| medians(rate, group)).collect(),
    })
}

/// Interval to which the thermal cycle is averaged \[s\]: far below any time in which a sensor's case warms up.
const INTERVAL_S: f64 = 10.0;

/// The thermal cycle: one column.
pub(crate) fn thermal_cycle(path: &str, column: &str) -> Result<Rates, String> {
    let [time, temperature, rate] = arrayed(table::read(path, '\t', &["timestamp", "imu.temperature", column])?)?;
    let span = 1e-6 * (time[time.len() - 1] - time[0]);
    let group = ((INTERVAL_S * time.len() as f64 / span).round() as usize).max(1);
    // the first row of what is not yet averaged is read before the sensor has settled
    let first = usize::from(group > 1);
    let [time, temperature, rate] = [time, temperature, rate].map(|series| means(&series[first..], group));
    Ok(Rates { time: time.iter().map(|t| 1e-6 * (t - time[0])).collect(), temperature, rates: vec![rate] })
}

/// So many columns.
pub(crate) fn arrayed<const N: usize>(columns: Vec<Vec<f64>>) -> Result<[Vec<f64>; N], String> {
    match <[Vec<f64>; N]>::try_from(columns) {
        Ok(columns) if columns.iter().all(|c| c.len() > 2) => Ok(columns),
        _ => Err(format!("{N} columns of more than two rows are needed")),
    }
}
