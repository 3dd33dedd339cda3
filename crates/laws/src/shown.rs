//! Units as a person writes them.

use std::fmt;

use crate::Unit;
use crate::unit::{BASES, SAME, UNITS};

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.known().unwrap_or_else(|| self.of_bases()))
    }
}

impl Unit {
    /// The shortest name of known units: one, over one, over two.
    fn known(&self) -> Option<String> {
        let named = || UNITS.iter().map(|unit| (unit.0, Self::of(unit)));
        let single = || named().find(|(_, unit)| self.is(*unit)).map(|(name, _)| name.to_owned());
        let ratio = |of: Self| {
            named().find_map(|(a, over)| {
                named().skip(1).find(|(_, under)| of.is(over.over(*under))).map(|(b, _)| format!("{a}/{b}"))
            })
        };
        single()
            .or_else(|| ratio(*self))
            .or_else(|| named().skip(1).find_map(|(c, last)| ratio(self.times(last)).map(|ab| format!("{ab}/{c}"))))
    }

    /// As a product of powers: a known unit or deg/h, over another known one where that is shorter, times the fewest powers of m, kg, K, A, an angle
    /// and a time that need no factor; a factor before the base units where there is none.
    fn of_bases(&self) -> String {
        // none of the pure numbers, which stand before the others
        let named = || UNITS.iter().skip(3).map(|unit| (unit.0, Self::of(unit)));
        let none = || std::iter::once(("", Self::ONE));
        let drift = find("deg").over(find("h"));
        let mut best: Option<(usize, String)> = None;
        for (head, above) in none().chain([("deg/h", drift)]).chain(named()) {
            for (tail, below) in none().chain(named()) {
                let more = usize::from(!head.is_empty()) + usize::from(!tail.is_empty());
                let least = best.as_ref().map_or(usize::MAX, |(fewest, _)| *fewest);
                let rest = self.over(above).times(below);
                if !tail.is_empty() && above.is_of_kind(below) {
                    continue;
                }
                if let Some(powers) = rest.plain().filter(|powers| powers.len() + more < least) {
                    best = Some((powers.len() + more, written(head, &powers, tail)));
                }
            }
        }
        best.map_or_else(
            || {
                let powers = BASES.into_iter().zip(self.powers).filter(|(_, power)| power.abs() > SAME);
                format!("{:.3e} {}", self.factor, written("", &powers.collect::<Vec<_>>(), ""))
            },
            |(_, text)| text,
        )
    }

    /// As powers of m, kg, K, A, an angle and a time, if it needs no factor.
    fn plain(self) -> Option<Vec<(&'static str, f64)>> {
        let of = |(time, angle): (&'static str, &'static str)| {
            let bases = ["m", "kg", time, "K", "A", angle].into_iter().zip(self.powers);
            let powers: Vec<(&str, f64)> = bases.filter(|(_, power)| power.abs() > SAME).collect();
            let product = powers.iter().fold(Self::ONE, |all, (base, power)| all.times(find(base).to_the(*power)));
            self.is(product).then_some(powers)
        };
        TIMES.iter().flat_map(|time| ANGLES.map(|angle| (*time, angle))).find_map(of)
    }
}

/// A known unit by its name.
fn find(name: &str) -> Unit {
    UNITS.iter().find(|unit| unit.0 == name).map_or(Unit::ONE, Unit::of)
}

/// Times and angles that a person writes.
const TIMES: [&str; 4] = ["s", "min", "h", "d"];
const ANGLES: [&str; 2] = ["rad", "deg"];

/// `head` times powers of units, divided by those whose power is negative and by `tail`.
fn written(head: &str, powers: &[(&str, f64)], tail: &str) -> String {
    let word = |(base, power): (&str, f64)| {
        let power = (power * 1e9).round() / 1e9;
        if power == 1.0 { base.to_owned() } else { format!("{base}^{power}") }
    };
    let above = powers.iter().filter(|(_, power)| *power > 0.0).map(|power| word(*power));
    let above: Vec<String> = Some(head.to_owned()).filter(|head| !head.is_empty()).into_iter().chain(above).collect();
    let below = powers.iter().filter(|(_, power)| *power < 0.0).map(|(base, power)| word((base, -power)));
    let below = below.chain(Some(tail.to_owned()).filter(|tail| !tail.is_empty()));
    let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
    below.fold(above, |all, by| format!("{all}/{by}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(text: &str) -> Unit {
        Unit::parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}"))
    }

    #[test]
    fn what_has_no_name_is_shown_as_a_person_writes_it() {
        for (text, shown) in [
            ("deg/h/K^0.5", "deg/h/K^0.5"),
            ("deg/h K", "deg/h K"),
            ("deg/h K2", "deg/h K^2"),
            ("deg/h K/min", "deg/h K/min"),
            ("deg/h/K2/V", "deg/h/K^2/V"),
            ("W K", "W K"),
            ("K^-1.5", "1/K^1.5"),
            ("K/h^0.5", "K/h^0.5"),
        ] {
            assert_eq!(unit(text).to_string(), shown, "{text}");
            assert!(unit(text).is(unit(shown)), "{text} reads back");
        }
    }
}
