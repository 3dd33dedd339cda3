//! The load on the cell, as it is written on the command line: `exx=1e-4,dt=10`.

use homogenization::fields::Load;

const KEYS: [&str; 7] = ["exx", "eyy", "ezz", "gyz", "gxz", "gxy", "dt"];
/// Largest strain accepted: the law is linear.
const MOST_STRAIN: f64 = 0.5;
/// Largest temperature change accepted \[K\].
const MOST_KELVIN: f64 = 1000.0;

/// Total macroscopic strains (`exx`, `eyy`, `ezz`, engineering shears `gyz`, `gxz`, `gxy`) and a temperature change `dt` \[K\], 0 if left out.
///
/// # Errors
/// The fault, in words.
pub fn parse_load(text: &str) -> Result<Load, String> {
    let mut load = Load::default();
    let mut given = [false; 7];
    if text.contains(';') {
        return Err("separate the parts by commas: exx=1e-4,dt=10".into());
    }
    for part in text.split(',') {
        let (key, value) = part.split_once('=').ok_or_else(|| format!("`{part}` is not like exx=1e-4"))?;
        let at = KEYS.iter().position(|k| *k == key.trim());
        let at = at.ok_or_else(|| format!("`{}` is not a load; give {}", key.trim(), KEYS.join(", ")))?;
        if std::mem::replace(&mut given[at], true) {
            return Err(format!("`{}` is given twice", KEYS[at]));
        }
        let most = if at == 6 { MOST_KELVIN } else { MOST_STRAIN };
        let number = value.trim().parse().ok().filter(|v: &f64| v.abs() <= most);
        let number = number.ok_or_else(|| format!("`{part}`: give a number from -{most} to {most}"))?;
        if at == 6 { load.temperature = number } else { load.strain[at] = number }
    }
    Ok(load)
}

/// The load in the same words.
pub fn words(load: &Load) -> String {
    let values = load.strain.iter().chain([&load.temperature]);
    let parts: Vec<String> = KEYS.iter().zip(values).filter(|(_, v)| **v != 0.0).map(|(k, v)| format!("{k}={v:?}")).collect();
    if parts.is_empty() { "nothing".into() } else { parts.join(",") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_are_read_as_written() {
        let load = parse_load("exx=1e-4, gxy=-2e-5,dt=10").unwrap();
        assert_eq!((load.strain[0], load.strain[5], load.temperature), (1e-4, -2e-5, 10.0));
        assert_eq!(words(&load), "exx=0.0001,gxy=-2e-5,dt=10.0");
        for (text, complaint) in [
            ("exx", "not like"),
            ("rr=1", "not a load"),
            ("dt=1,dt=2", "twice"),
            ("exx=1", "-0.5"),
            ("exx=nan", "-0.5"),
            ("", "not like"),
            ("exx=1e-4;dt=10", "by commas"),
        ] {
            assert!(parse_load(text).unwrap_err().contains(complaint), "{text}");
        }
    }
}
