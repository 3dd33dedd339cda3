//! Instants as date and time of day.

/// Forms of instants that are dates, for messages.
pub(crate) const FORMS: &str = "2024-05-01T12:00:00.5Z, or day first 01.05.2024 12:00:00.5";

/// Hours of a time of day, and of a time since a start.
const HOURS: [i64; 2] = [24, 10_000];

/// Months by the first three letters of their names, in English and German.
const MONTHS: [(&str, i64); 17] = [
    ("jan", 1),
    ("feb", 2),
    ("mar", 3),
    ("m\u{e4}r", 3),
    ("mrz", 3),
    ("apr", 4),
    ("may", 5),
    ("mai", 5),
    ("jun", 6),
    ("jul", 7),
    ("aug", 8),
    ("sep", 9),
    ("oct", 10),
    ("okt", 10),
    ("nov", 11),
    ("dec", 12),
    ("dez", 12),
];

/// A date and time of day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Date {
    /// Seconds since 1970-01-01T00:00:00Z.
    pub(crate) seconds: f64,
    /// Whether its zone is written.
    pub(crate) is_zoned: bool,
    /// Whether the month has the day.
    pub(crate) exists: bool,
}

/// Day or month: the first number of a date between slashes where no value decides it: `02/03/2026`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum First {
    Day,
    Month,
}

/// Reads `2024-05-01T12:00:00.5+02:00`, by the day of the year `2024-122T12:00:00`, `01.05.2024 12:00:00.5`, `01.05.24 12:00` of this century, or `01-May-2024 12:00:00 PM`; a blank may stand for the T, a comma for the
/// point, and the zone, then UTC, be absent.
pub(crate) fn date(text: &str) -> Option<Date> {
    dated(text, day_of)
}

/// Reads `02/03/2026 08:00`, or `2/3/26 8:00 AM`, by what stands first.
pub(super) fn slashed(text: &str, first: First) -> Option<Date> {
    dated(text, |day| {
        let [a, b, year] = between_slashes(day)?;
        let (month, day) = if first == First::Month { (a, b) } else { (b, a) };
        ((1..=12).contains(&month) && (1..=31).contains(&day)).then_some((year, month, day))
    })
}

/// Whether a text is a date with a time of day, whatever stands first in it.
pub(super) fn is_date(text: &str) -> bool {
    date(text).is_some() || [First::Day, First::Month].iter().any(|first| slashed(text, *first).is_some())
}

fn dated(text: &str, day_of: impl Fn(&str) -> Option<(i64, i64, i64)>) -> Option<Date> {
    // what ends a date may be a letter of its month
    text.match_indices(['T', 't', ' ']).find_map(|(at, _)| {
        let (year, month, day) = day_of(&text[..at])?;
        let (clock, zone) = clock(&text[at + 1..], HOURS[0])?;
        let seconds = (days(year, month, day) * 86_400) as f64 + clock - zone.unwrap_or(0.0);
        Some(Date { seconds, is_zoned: zone.is_some(), exists: day <= length(year, month) })
    })
}

/// Whether a text is a date without a time of day.
pub(super) fn is_day(text: &str) -> bool {
    day_of(text).is_some() || between_slashes(text).is_some()
}

/// Reads `08:00:00.5` or `8:00 AM`, or hours, minutes and seconds since a start, as `31:00:00` \[s\].
pub(super) fn time_of_day(text: &str) -> Option<f64> {
    clock(text, HOURS[1]).filter(|(_, zone)| zone.is_none()).map(|(seconds, _)| seconds)
}

/// The last digit \[s\] of a text with a time of day: a minute where it shows no seconds; `None` of other texts.
pub(super) fn last_digit_of_clock(text: &str) -> Option<f64> {
    let (_, minutes) = text.split_once(':')?;
    let seconds = minutes.get(2..).and_then(|rest| rest.strip_prefix(':'));
    Some(seconds.map_or(60.0, last_digit))
}

/// The value of the last digit of the number with which a text begins.
pub(super) fn last_digit(text: &str) -> f64 {
    let decimals = text.split_once(['.', ',']).map_or("", |(_, decimals)| decimals);
    0.1_f64.powi(decimals.bytes().take_while(u8::is_ascii_digit).count() as i32)
}

/// Year, month and day.
fn day_of(text: &str) -> Option<(i64, i64, i64)> {
    ordinal(text).or_else(|| calendar(text))
}

/// Year, month and day of `2024-122`, the day of the year (ISO 8601). Those beyond the year are days that December does not have.
fn ordinal(text: &str) -> Option<(i64, i64, i64)> {
    let (year, day) = text.split_once('-').filter(|(year, day)| (year.len(), day.len()) == (4, 3))?;
    let (year, mut day) = (whole(year)?, whole(day).filter(|day| (1..=366).contains(day))?);
    let mut month = 1;
    while month < 12 && day > length(year, month) {
        day -= length(year, month);
        month += 1;
    }
    Some((year, month, day))
}

fn calendar(text: &str) -> Option<(i64, i64, i64)> {
    let three = |separator: char| {
        let mut parts = text.split(separator).map(str::trim);
        let three = [parts.next()?, parts.next()?, parts.next()?];
        parts.next().is_none().then_some(three)
    };
    let is = |part: &str, lengths: [usize; 2]| (lengths[0]..=lengths[1]).contains(&part.len()) && whole(part).is_some();
    let (year, month, day) = ['-', '.', '/', ' '].into_iter().find_map(three).and_then(|[first, second, third]| {
        let named = month(second);
        match () {
            () if is(first, [4, 4]) && is(second, [1, 2]) && is(third, [1, 2]) && !text.contains('.') => {
                Some((whole(first)?, whole(second)?, whole(third)?))
            }
            () if is(first, [1, 2]) && is(second, [1, 2]) && [2, 4].contains(&third.len()) && text.contains('.') => {
                let year = whole(third)?;
                Some((if third.len() == 2 { 2000 + year } else { year }, whole(second)?, whole(first)?))
            }
            () if is(first, [1, 2]) && is(third, [4, 4]) => Some((whole(third)?, named?, whole(first)?)),
            () => None,
        }
    })?;
    ((1..=12).contains(&month) && (1..=31).contains(&day)).then_some((year, month, day))
}

/// The number of a month by its name.
fn month(name: &str) -> Option<i64> {
    let lower = name.trim_end_matches('.').to_lowercase();
    let letters = lower.chars().all(char::is_alphabetic);
    MONTHS.iter().find(|(start, _)| letters && lower.starts_with(start)).map(|(_, number)| *number)
}

/// Seconds since midnight, and those of the zone if it is written; hours are fewer than `hours`.
fn clock(text: &str, hours: i64) -> Option<(f64, Option<f64>)> {
    let (text, noon) = half_day(text);
    let (clock, zone) = match text.find(['Z', 'z', '+', '-']) {
        Some(at) => (&text[..at], Some(zone(&text[at..])?)),
        None => (text, None),
    };
    let mut parts = clock.split(':');
    let (hour, minute) = (whole(parts.next()?)?, whole(parts.next()?)?);
    let second: f64 = parts.next().unwrap_or("0").replace(',', ".").parse().ok()?;
    let hour = match noon {
        Some(noon) => (1..=12).contains(&hour).then_some(hour % 12 + noon)?,
        None => hour,
    };
    let valid = hour < hours && minute < 60 && (0.0..61.0).contains(&second) && parts.next().is_none();
    valid.then(|| ((hour * 3600 + minute * 60) as f64 + second, zone))
}

/// A time of day without the AM or PM behind it, and the hour at which its half of the day begins.
fn half_day(text: &str) -> (&str, Option<i64>) {
    let Some(at) = text.len().checked_sub(2).filter(|at| text.is_char_boundary(*at)) else { return (text, None) };
    match text[at..].to_ascii_lowercase().as_str() {
        "am" => (text[..at].trim_end(), Some(0)),
        "pm" => (text[..at].trim_end(), Some(12)),
        _ => (text, None),
    }
}

/// The numbers of `02/03/2026` or `2/3/26`; years of two digits are of this century.
fn between_slashes(text: &str) -> Option<[i64; 3]> {
    let mut parts = text.split('/').map(str::trim);
    let mut number = |lengths: [usize; 2]| {
        let part = parts.next().filter(|part| lengths.contains(&part.len()))?;
        Some((part.len(), whole(part)?))
    };
    let (first, second, (digits, year)) = (number([1, 2])?, number([1, 2])?, number([2, 4])?);
    parts.next().is_none().then_some([first.1, second.1, if digits == 2 { 2000 + year } else { year }])
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
    use super::{First, date, is_date, is_day, last_digit, last_digit_of_clock, slashed, time_of_day};

    #[test]
    fn last_digits() {
        for (text, seconds) in [
            ("2024-05-01T12:00:00.25Z", Some(0.01)),
            ("2024-05-01T12:00+02:00", Some(60.0)),
            ("01.05.2024 12:00:07", Some(1.0)),
            ("03/04/2026 08:00 PM", Some(60.0)),
            ("8:00:00,5", Some(0.1)),
            ("1:", Some(60.0)),
            ("20.50", None),
        ] {
            assert!(last_digit_of_clock(text).map(|s| (s * 1e3).round()) == seconds.map(|s| s * 1e3), "{text}");
        }
        assert_eq!(["20.50", "20,5", "7", ""].map(|text| (last_digit(text) * 1e3).round()), [10.0, 100.0, 1e3, 1e3]);
    }

    #[test]
    fn instants() {
        let cases = [
            ("1970-01-01T00:00:00Z", 0.0),
            ("2000-02-29 12:00:00", 951_825_600.0),
            ("2024-05-01T12:00:00.5+02:00", 1_714_557_600.5),
            ("2024-05-01T12:00:00-0030", 1_714_566_600.0),
            ("2024-05-01t10:00+00", 1_714_557_600.0),
            ("1969-12-31T23:59:59Z", -1.0),
            ("2026-073 06:00:30", 1_773_468_030.0),
            ("2024-366T00:00:00Z", 1_735_603_200.0),
            ("1970-001 00:00:01", 1.0),
            ("01.05.2024 12:00:00.5+02:00", 1_714_557_600.5),
            ("29.02.2000 12:00", 951_825_600.0),
            ("01.01.1970T00:00:01,25", 1.25),
            ("29.2.00 12:00", 951_825_600.0),
            ("1.1.1970 0:00:01", 1.0),
            ("1970/01/02 00:00", 86_400.0),
            ("02-Jan-1970 12:00:01 AM", 86_401.0),
            ("1-Oct-1970 08:00", 273.0 * 86_400.0 + 28_800.0),
            ("1. Okt. 1970 08:00 pm", 273.0 * 86_400.0 + 72_000.0),
            ("1/M\u{e4}r/1970 12:30 PM", 59.0 * 86_400.0 + 45_000.0),
        ];
        for (text, expected) in cases {
            let date = date(text).unwrap();
            let zoned = text[8..].contains(['Z', '+']) || text.ends_with("-0030");
            assert_eq!((date.seconds, date.is_zoned, date.exists), (expected, zoned, true), "{text}");
        }
        #[rustfmt::skip]
        let refused = [
            "", "12:00:00", "20.5", "2024-05-01", "2024-13-01T00:00:00", "2024-05-01T25:00:00", "2024-05-01T10:00:00+2",
            "2024-05-01T1:2:3:4", "2024-05-01_10:00:00", "2024-05-0\u{e9}T10:00:00", "2024-05-01T10:00:00+0\u{e9}",
            "05/01/2024 10:00:00", "2024.05.01 10:00:00", "01-05-2024 10:00:00", "01.13.2024 10:00:00", "01.5.20241 10:00:00", "01.5.202 10:00",
            "14-Mar-2026 13:00 AM", "14-Foo-2026 08:00", "14-Mar-26 08:00", "2024/05/01", "2024-122", "2024-000 08:00", "2024-367 08:00", "2024-12 08:00", "24-122 08:00", "m", "\u{e4}", "1-1-1-1 08:00",
        ];
        for text in refused {
            assert_eq!(date(text), None, "{text}");
        }
        let days = [
            ("2024-02-29", true),
            ("2026-02-29", false),
            ("1900-02-29", false),
            ("2026-04-31", false),
            ("2026-12-31", true),
            ("2024-366", true),
            ("2026-366", false),
            ("2026-365", true),
        ];
        for (day, exists) in days {
            assert_eq!(date(&format!("{day}T00:00:00")).unwrap().exists, exists, "{day}");
        }
        for (text, seconds) in [
            ("08:00:00", Some(28_800.0)),
            ("8:00 PM", Some(72_000.0)),
            ("23:59:59.5", Some(86_399.5)),
            ("31:00:01", Some(111_601.0)),
            ("08:00Z", None),
            ("8", None),
            ("08:61", None),
            ("0:0:nan", None),
            ("666666666666666666:0", None),
        ] {
            assert_eq!(time_of_day(text), seconds, "{text}");
        }
        assert!(
            is_day("14-Mar-2026")
                && is_day("2026-03-14")
                && is_day("14.3.2026")
                && is_day("14/3/2026")
                && is_day("2026-073")
                && !is_day("3.5")
        );
        let of = |text: &str| [First::Day, First::Month].map(|first| slashed(text, first).map(|date| date.seconds / 86_400.0));
        for (text, days) in [
            ("02/01/1970 00:00:00", [Some(1.0), Some(31.0)]),
            ("2/1/70 12:00 AM", [Some(36_526.0), Some(36_556.0)]),
            ("13/01/1970 12:00", [Some(12.5), None]),
            ("01/13/1970 12:00", [None, Some(12.5)]),
            ("13/13/1970 12:00", [None, None]),
            ("2024/05/01 12:00", [None, None]),
            ("1/2 12:00", [None, None]),
            ("1/2/197 12:00", [None, None]),
            ("1/2/1970", [None, None]),
            ("20.5", [None, None]),
        ] {
            assert_eq!(of(text), days, "{text}");
        }
        assert!(
            is_date("2/1/70 12:00 AM") && is_date("2024-05-01T10:00:00") && !is_date("13/13/1970 12:00") && !is_date("1/2/1970")
        );
    }
}
