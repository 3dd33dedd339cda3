//! Units: a factor and powers of base units.

use crate::Fault;

/// Base units: metre, kilogram, second, kelvin, ampere, radian.
pub(crate) const BASES: [&str; 6] = ["m", "kg", "s", "K", "A", "rad"];
/// Relative difference of factors, and difference of powers, below which two are the same.
pub(crate) const SAME: f64 = 1e-9;
/// Longest unit that is read, bytes.
const LONGEST: usize = 80;
/// Largest power of a unit.
const MOST_POWER: f64 = 12.0;

/// A unit as a multiple of a product of powers of m, kg, s, K, A and rad. A temperature in °C counts as kelvins: differences alone have meaning here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub(crate) factor: f64,
    pub(crate) powers: [f64; 6],
}

/// A unit's name, its factor, and its powers of the base units.
pub(crate) type Named = (&'static str, f64, [i8; 6]);

pub(crate) const UNITS: [Named; 46] = [
    ("1", 1.0, [0; 6]),
    ("%", 1e-2, [0; 6]),
    ("ppm", 1e-6, [0; 6]),
    ("m", 1.0, [1, 0, 0, 0, 0, 0]),
    ("km", 1e3, [1, 0, 0, 0, 0, 0]),
    ("cm", 1e-2, [1, 0, 0, 0, 0, 0]),
    ("mm", 1e-3, [1, 0, 0, 0, 0, 0]),
    ("um", 1e-6, [1, 0, 0, 0, 0, 0]),
    ("nm", 1e-9, [1, 0, 0, 0, 0, 0]),
    ("kg", 1.0, [0, 1, 0, 0, 0, 0]),
    ("g", 1e-3, [0, 1, 0, 0, 0, 0]),
    ("mg", 1e-6, [0, 1, 0, 0, 0, 0]),
    ("s", 1.0, [0, 0, 1, 0, 0, 0]),
    ("ms", 1e-3, [0, 0, 1, 0, 0, 0]),
    ("us", 1e-6, [0, 0, 1, 0, 0, 0]),
    ("min", 60.0, [0, 0, 1, 0, 0, 0]),
    ("h", 3600.0, [0, 0, 1, 0, 0, 0]),
    ("d", 86_400.0, [0, 0, 1, 0, 0, 0]),
    ("Hz", 1.0, [0, 0, -1, 0, 0, 0]),
    ("K", 1.0, [0, 0, 0, 1, 0, 0]),
    ("mK", 1e-3, [0, 0, 0, 1, 0, 0]),
    ("degC", 1.0, [0, 0, 0, 1, 0, 0]),
    ("N", 1.0, [1, 1, -2, 0, 0, 0]),
    ("Pa", 1.0, [-1, 1, -2, 0, 0, 0]),
    ("hPa", 1e2, [-1, 1, -2, 0, 0, 0]),
    ("kPa", 1e3, [-1, 1, -2, 0, 0, 0]),
    ("MPa", 1e6, [-1, 1, -2, 0, 0, 0]),
    ("GPa", 1e9, [-1, 1, -2, 0, 0, 0]),
    ("bar", 1e5, [-1, 1, -2, 0, 0, 0]),
    ("mbar", 1e2, [-1, 1, -2, 0, 0, 0]),
    ("J", 1.0, [2, 1, -2, 0, 0, 0]),
    ("kJ", 1e3, [2, 1, -2, 0, 0, 0]),
    ("W", 1.0, [2, 1, -3, 0, 0, 0]),
    ("mW", 1e-3, [2, 1, -3, 0, 0, 0]),
    ("A", 1.0, [0, 0, 0, 0, 1, 0]),
    ("mA", 1e-3, [0, 0, 0, 0, 1, 0]),
    ("V", 1.0, [2, 1, -3, 0, -1, 0]),
    ("mV", 1e-3, [2, 1, -3, 0, -1, 0]),
    ("T", 1.0, [0, 1, -2, 0, -1, 0]),
    ("mT", 1e-3, [0, 1, -2, 0, -1, 0]),
    ("uT", 1e-6, [0, 1, -2, 0, -1, 0]),
    ("G", 1e-4, [0, 1, -2, 0, -1, 0]),
    ("rad", 1.0, [0, 0, 0, 0, 0, 1]),
    ("mrad", 1e-3, [0, 0, 0, 0, 0, 1]),
    ("urad", 1e-6, [0, 0, 0, 0, 0, 1]),
    ("deg", std::f64::consts::PI / 180.0, [0, 0, 0, 0, 0, 1]),
];

impl Unit {
    /// Unit of a pure number.
    pub const ONE: Self = Self { factor: 1.0, powers: [0.0; 6] };

    /// A unit as it is written: `deg/h/K`, `W/(m2 K)`, `1/K^2`, `%`; empty for a pure number.
    ///
    /// # Errors
    /// The name that is no unit, or the sign that does not belong there.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let of = |known: &str| UNITS.iter().find(|(name, ..)| *name == known).map_or(Self::ONE, Self::of);
        Self::words(text).map(|words| words.iter().fold(Self::ONE, |unit, (known, power)| unit.times(of(known).to_the(*power))))
    }

    /// Names of known units in it with their powers, in the order in which they stand.
    ///
    /// # Errors
    /// As [`Self::parse`].
    pub fn words(text: &str) -> Result<Vec<(&'static str, f64)>, Fault> {
        if text.len() > LONGEST {
            return Err(Fault::new(
                0..LONGEST,
                format!("the unit is longer than {LONGEST} characters"),
                "give it by its usual names",
            ));
        }
        if let Some((at, c)) = text.char_indices().find(|(_, c)| !c.is_ascii()) {
            let remedy = "write degC, um, W/(m2 K) and the like in plain letters";
            return Err(Fault::new(at..at + c.len_utf8(), format!("`{}` is no part of a unit", c.escape_debug()), remedy));
        }
        let mut reader = Reader { text, at: 0 };
        let words = reader.product(false)?;
        reader.blanks();
        if reader.at < text.len() { Err(reader.fault("a unit ends before this point")) } else { Ok(words) }
    }

    pub(crate) fn of((_, factor, powers): &Named) -> Self {
        Self { factor: *factor, powers: powers.map(f64::from) }
    }

    /// The product of two.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        let powers = std::array::from_fn(|k| self.powers[k] + other.powers[k]);
        Self { factor: self.factor * other.factor, powers }
    }

    /// The quotient of two.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        self.times(other.to_the(-1.0))
    }

    /// A power.
    #[must_use]
    pub fn to_the(self, power: f64) -> Self {
        Self { factor: self.factor.powf(power), powers: self.powers.map(|p| p * power) }
    }

    /// Whether numbers in this unit are numbers in the other.
    pub fn is(self, other: Self) -> bool {
        self.is_of_kind(other) && (self.factor / other.factor - 1.0).abs() < SAME
    }

    /// Whether both measure the same kind of quantity, whatever their factors.
    pub fn is_of_kind(self, other: Self) -> bool {
        self.powers.iter().zip(&other.powers).all(|(a, b)| (a - b).abs() < SAME)
    }

    /// Factor by which numbers in this unit are larger in the other.
    pub fn in_units_of(self, other: Self) -> f64 {
        self.factor / other.factor
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn blanks(&mut self) {
        while self.peek() == Some(b' ') {
            self.at += 1;
        }
    }

    fn fault(&self, problem: &str) -> Fault {
        let end = (self.at + 1).min(self.text.len());
        Fault::new(self.at..end, problem, "write a unit like deg/h, W/(m2 K) or 1/K2")
    }

    /// Units side by side or with `*` or `/` between them; inside a bracket if `inner`.
    fn product(&mut self, inner: bool) -> Result<Vec<(&'static str, f64)>, Fault> {
        let mut words = Vec::new();
        let mut divides = false;
        let mut first = true;
        loop {
            self.blanks();
            match self.peek() {
                None => break,
                Some(b')') if inner => break,
                Some(b'*') if !first => self.at += 1,
                Some(b'/') if !first => {
                    self.at += 1;
                    divides = true;
                }
                _ => {}
            }
            self.blanks();
            let sign = if divides { -1.0 } else { 1.0 };
            words.extend(self.factor(inner)?.into_iter().map(|(name, power)| (name, sign * power)));
            (divides, first) = (false, false);
        }
        Ok(words)
    }

    fn factor(&mut self, inner: bool) -> Result<Vec<(&'static str, f64)>, Fault> {
        if self.peek() == Some(b'(') {
            if inner {
                return Err(self.fault("brackets within brackets are not read"));
            }
            self.at += 1;
            let words = self.product(true)?;
            if self.peek() != Some(b')') {
                return Err(self.fault("a bracket is not closed"));
            }
            self.at += 1;
            return Ok(words);
        }
        let start = self.at;
        let rest = &self.text[start..];
        let letters = if rest.starts_with('%') || rest.starts_with('1') {
            1
        } else {
            rest.bytes().take_while(u8::is_ascii_alphabetic).count()
        };
        let name = &rest[..letters];
        if name == "1" && rest[1..].starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return Err(self.fault("a unit has no factor"));
        }
        self.at += letters;
        let Some((known, ..)) = UNITS.iter().find(|(known, ..)| *known == name) else {
            if name.is_empty() {
                return Err(self.fault("a unit is needed here"));
            }
            let known: Vec<&str> = UNITS.iter().map(|(name, ..)| *name).collect();
            return Err(Fault::new(
                start..self.at,
                format!("`{name}` is no unit here"),
                format!("the units are {}", known.join(", ")),
            ));
        };
        Ok(vec![(known, self.power()?)])
    }

    /// `2`, `^2`, `^-1`, `-1` behind a unit's name; 1 if there is none.
    fn power(&mut self) -> Result<f64, Fault> {
        let start = self.at;
        if self.peek() == Some(b'^') {
            self.at += 1;
        }
        if self.peek() == Some(b'-') {
            self.at += 1;
        }
        let digits = self.text[self.at..].bytes().take_while(|c| c.is_ascii_digit() || *c == b'.').count();
        if digits == 0 {
            return if self.at == start { Ok(1.0) } else { Err(self.fault("a power is needed here")) };
        }
        self.at += digits;
        let power = self.text[start..self.at].trim_start_matches('^').parse().ok();
        power
            .filter(|power: &f64| power.abs() <= MOST_POWER)
            .ok_or_else(|| Fault::new(start..self.at, "this is no power", "write it like m2 or m^2"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(text: &str) -> Unit {
        Unit::parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}"))
    }

    #[test]
    fn exact_units_are_products_of_powers() {
        for (a, b) in [
            ("W/(m2 K)", "W m-2 K^-1"),
            ("W/m2/K", "W/(m^2*K)"),
            ("Pa", "N/m2"),
            ("J", "W s"),
            ("V A", "W"),
            ("T", "V s/m2"),
            ("", "1"),
            ("1/K2", "K-2"),
            ("degC", "K"),
        ] {
            assert!(unit(a).is(unit(b)), "{a} and {b}");
        }
        assert!(!unit("deg/h").is(unit("deg/s")) && unit("deg/h").is_of_kind(unit("rad/s")));
        assert!(!unit("K").is_of_kind(unit("m")));
        assert!((unit("min").in_units_of(unit("s")) - 60.0).abs() < 1e-12);
        for (text, shown) in
            [("N m", "J"), ("mm", "mm"), ("m/s", "m/s"), ("deg K-1/h", "deg/K/h"), ("K-2", "1/K/K"), ("kg2 A3", "kg^2 A^3")]
        {
            assert_eq!(unit(text).to_string(), shown);
        }
    }

    #[test]
    fn what_is_no_unit_is_refused_where_it_stands() {
        for (text, at, says) in [
            ("furlong", 0..7, "`furlong` is no unit"),
            ("K/foo", 2..5, "`foo`"),
            ("K/", 2..2, "a unit is needed"),
            ("W/(m2 K", 7..7, "not closed"),
            ("K^", 2..2, "a power is needed"),
            ("m99", 1..3, "no power"),
            ("K)", 1..2, "a unit is needed"),
            ("((K))", 1..2, "brackets within"),
            ("\u{b5}m", 0..2, "no part of a unit"),
            ("/K", 0..1, "a unit is needed"),
            ("10 deg/h", 0..1, "no factor"),
            ("1.5 K", 0..1, "no factor"),
            ("100/K", 0..1, "no factor"),
        ] {
            let fault = Unit::parse(text).expect_err(text);
            assert!(fault.at == at && fault.problem.contains(says), "{text}: {fault:?}");
        }
        assert!(Unit::parse(&"K ".repeat(1000)).is_err());
    }
}
