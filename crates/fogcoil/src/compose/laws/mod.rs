//! The small laws that are tried where no mechanism of the library explains a record, each as a mechanism's file.

mod form;
mod of_part;
mod of_temperature;
mod of_time;

pub(crate) use form::{Law, Ranges};

/// All laws, for records of these ranges.
pub(crate) fn laws(ranges: &Ranges) -> Vec<Law> {
    let mut all = Vec::new();
    for body in ["chamber", "spool", "coil"] {
        all.extend(of_temperature::forms(body, ranges).iter().map(|form| form.law(ranges.size)));
    }
    all.extend(of_time::forms(ranges).iter().map(|form| form.law(ranges.size)));
    for (target, what) in [
        ("Bias", "all parts of the bias"),
        ("Shupe", "the thermal phase"),
        ("Axial", "the axial strain's part"),
        ("Radial", "the radial strain's part"),
    ] {
        all.extend(of_part::forms(target, what, ranges).iter().map(|form| form.law(ranges.size)));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechanisms::Scene;

    #[test]
    fn every_law_is_a_mechanism_file_of_its_own() {
        let scene = Scene { temperatures: [-38.7, 61.2], noise: 0.004, earth: None };
        let laws = laws(&Ranges::new(&scene, 0.017, 80_000.0, [0.1, 2.4, 0.3, 2.5]));
        let mut ids = Vec::new();
        for law in &laws {
            let case = crate::input::check_mechanism("law".as_ref(), law.text.clone())
                .unwrap_or_else(|error| panic!("{error}\n{}", law.text));
            assert!(!case.mechanism.starts.is_empty() && case.mechanism.starts.iter().all(|start| start[0] != 0.0));
            assert!(!ids.contains(&case.mechanism.id), "{}", case.mechanism.id);
            ids.push(case.mechanism.id);
        }
        assert_eq!(ids.len(), 82);
    }
}
