//! Instants as date and time of day.

/// How instants are written that are dates, for messages.
pub(crate) const FORMS: &str = "2024-05-01T12:00:00.5Z, or day first 01.05.2024 12:00:00.5";

/// A date and time of day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Date {
    /// Since 1970-01-01T00:00:00Z.
    pub(crate) seconds: f64,
    /// Whether its zone is written.
    pub(crate) is_zoned: bool,
    /// Whether the month has the day.
    pub(crate) exists: bool,
}

/// Reads `2024-05-01T12:00:00.5+02:00` or `01.05.2024 12:00:00.5`; a blank may stand for the T, a comma for the point, and the zone, then
/// UTC, be absent.
pub(crate) fn date(text: &str) -> Option<Date> {
    let (date, rest) = (text.get(..10)?, text.get(11..)?);
    if !matches!(text.as_bytes()[10], b'T' | b't' | b' ') {
        return None;
    }
    let (year, month, day) = match date.as_bytes() {
        [_, _, b'.', _, _, b'.', ..] => (&date[6..], &date[3..5], &date[..2]),
        [_, _, _, _, b'-', _, _, b'-', ..] => (&date[..4], &date[5..7], &date[8..]),
        _ => return None,
    };
    let (year, month, day) = (whole(year)?, whole(month)?, whole(day)?);
    let (clock, zone) = match rest.find(['Z', 'z', '+', '-']) {
        Some(at) => (&rest[..at], Some(zone(&rest[at..])?)),
        None => (rest, None),
    };
    let mut parts = clock.split(':');
    let (hour, minute) = (whole(parts.next()?)?, whole(parts.next()?)?);
    let second: f64 = parts.next().unwrap_or("0").replace(',', ".").parse().ok()?;
    let valid = (1..=12).contains(&month) && (1..=31).contains(&day) && hour < 24 && minute < 60 && (0.0..61.0).contains(&second);
    let seconds = |days: i64| (days * 86_400 + hour * 3600 + minute * 60) as f64 + second - zone.unwrap_or(0.0);
    (valid && parts.next().is_none()).then(|| Date {
        seconds: seconds(days(year, month, day)),
        is_zoned: zone.is_some(),
        exists: day <= length(year, month),
    })
}

/// Whether a text seems to be a date of which it is not said whether the day or the month is first: `02/03/2026 08:00`.
pub(crate) fn is_ambiguous(text: &str) -> bool {
    let mut parts = text.split('/');
    let short = |part: Option<&str>| part.is_some_and(|part| matches!(part.len(), 1 | 2) && whole(part).is_some());
    short(parts.next()) && short(parts.next()) && parts.next().is_some_and(|year| year.starts_with(|c: char| c.is_ascii_digit()))
}

fn whole(text: &str) -> Option<i64> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok())?
}

/// Seconds east of Greenwich: `Z`, `+02`, `+0200` or `+02:00`.
fn zone(text: &str) -> Option<f64> {
    if text.eq_ignore_ascii_case("z") {
        return Some(0.0);
    }
    let digits: String = text[1..].chars().filter(|c| *c != ':').collect();
    let (hours, minutes) = (whole(digits.get(..2)?)?, whole(digits.get(2..)?).unwrap_or(0));
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    (hours < 24 && minutes < 60 && digits.len() <= 4).then(|| sign * (hours * 3600 + minutes * 60) as f64)
}

/// Days of a month.
fn length(year: i64, month: i64) -> i64 {
    let (after, next) = if month == 12 { (year + 1, 1) } else { (year, month + 1) };
    days(after, next, 1) - days(year, month, 1)
}

/// Days since 1970-01-01 in the Gregorian calendar (H. Hinnant, *chrono-compatible low-level date algorithms*).
fn days(year: i64, month: i64, day: i64) -> i64 {
    let year = year - i64::from(month <= 2);
    let era = year.div_euclid(400);
    let of_era = year - era * 400;
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468
}

#[cfg(test)]
mod tests {
    use super::{date, is_ambiguous};

    #[test]
    fn instants() {
        let cases = [
            ("1970-01-01T00:00:00Z", 0.0),
            ("2000-02-29 12:00:00", 951_825_600.0),
            ("2024-05-01T12:00:00.5+02:00", 1_714_557_600.5),
            ("2024-05-01T12:00:00-0030", 1_714_566_600.0),
            ("2024-05-01t10:00+00", 1_714_557_600.0),
            ("1969-12-31T23:59:59Z", -1.0),
            ("01.05.2024 12:00:00.5+02:00", 1_714_557_600.5),
            ("29.02.2000 12:00", 951_825_600.0),
            ("01.01.1970T00:00:01,25", 1.25),
        ];
        for (text, expected) in cases {
            let date = date(text).unwrap();
            let zoned = text[11..].contains(['Z', '+', '-']);
            assert_eq!((date.seconds, date.is_zoned, date.exists), (expected, zoned, true), "{text}");
        }
        #[rustfmt::skip]
        let refused = [
            "", "12:00:00", "20.5", "2024-05-01", "2024-13-01T00:00:00", "2024-05-01T25:00:00", "2024-05-01T10:00:00+2",
            "2024-05-01T1:2:3:4", "2024-05-01_10:00:00", "2024-05-0\u{e9}T10:00:00", "2024-05-01T10:00:00+0\u{e9}",
            "05/01/2024 10:00:00", "2024.05.01 10:00:00", "01-05-2024 10:00:00", "01.13.2024 10:00:00", "01.5.20241 10:00:00",
        ];
        for text in refused {
            assert_eq!(date(text), None, "{text}");
        }
        let days =
            [("2024-02-29", true), ("2026-02-29", false), ("1900-02-29", false), ("2026-04-31", false), ("2026-12-31", true)];
        for (day, exists) in days {
            assert_eq!(date(&format!("{day}T00:00:00")).unwrap().exists, exists, "{day}");
        }
        for (text, ambiguous) in
            [("05/01/2024 10:00", true), ("5/1/24", true), ("2024/05/01", false), ("1/2", false), ("20.5", false)]
        {
            assert_eq!(is_ambiguous(text), ambiguous, "{text}");
        }
    }
}
