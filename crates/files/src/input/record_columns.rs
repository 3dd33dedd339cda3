//! The header of a recording: meaning of its columns.

use super::InputError;
use super::record_format::RecordFormat;
use super::record_options::Key;
use super::rows::{Rows, quoted};

const MOST_NAMES: usize = 12;

pub(super) struct RecordColumns {
    pub(super) names: Vec<String>,
    /// Column of each key; of the temperatures, and of the time where an interval stands for it, `None` if there is none.
    at: [Option<usize>; 4],
    /// Column of instants that is not read, as an interval stands for it.
    pub(super) unread_clock: Option<usize>,
    /// Column of the time of day, where that of the time holds the date alone.
    pub(super) time_of_day: Option<usize>,
    /// Further columns.
    pub(super) further: Vec<usize>,
}

impl RecordColumns {
    /// Reads them from the row at which `rows` stands.
    pub(super) fn read(rows: &Rows, format: &RecordFormat) -> Result<Self, InputError> {
        check_separator(rows, format)?;
        let names: Vec<String> = rows.fields().map(str::to_owned).collect();
        if names.iter().filter(|name| !name.is_empty()).all(|name| name.parse::<f64>().is_ok()) {
            let remedy = "put a line above it that names them, e.g. time_s,chamber_c,spool_c,rate_deg_per_h";
            return Err(rows.fault(None, "the first line holds numbers, not the names of the columns", remedy));
        }
        let (mut at, mut unread_clock) = ([None; 4], None);
        for key in Key::ALL {
            let declared = format.column(key).name.as_deref();
            let name = declared.unwrap_or(key.standard());
            let found: Vec<usize> = (0..names.len()).filter(|&column| names[column] == name).collect();
            let plain = declared.is_none() && format.column(key).is_standard(key);
            at[key as usize] = match found[..] {
                [column] if key == Key::Time && format.interval.is_some() => {
                    unread_clock = Some(column);
                    None
                }
                [column] => Some(column),
                [] if plain && (key == Key::Chamber || key == Key::Spool) => None,
                [] if plain && key == Key::Time && format.interval.is_some() => None,
                [] => return Err(absent(rows, key, name, &names)),
                _ => return Err(rows.fault(Some(name), "the column is there more than once", "rename all but one")),
            };
        }
        let beside = |name: &String, who| named(rows, name, &names, who);
        let further = format.further.iter().map(|name| beside(name, "a mechanism's file names this one, by `column` or `name`"));
        let further = further.collect::<Result<_, _>>()?;
        let time_of_day = format.time_of_day.as_ref();
        let time_of_day =
            time_of_day.map(|name| beside(name, "--time-of-day (time_of_day in the map file) names this one")).transpose()?;
        Ok(Self { names, at, unread_clock, time_of_day, further })
    }

    pub(super) fn column(&self, key: Key) -> Option<usize> {
        self.at[key as usize]
    }

    /// Columns that have a name and no meaning.
    pub(super) fn unused(&self) -> Vec<usize> {
        let unused = |column: &usize| {
            let some = Some(*column);
            !self.at.contains(&some) && self.unread_clock != some && self.time_of_day != some && !self.further.contains(column)
        };
        (0..self.names.len()).filter(unused).filter(|column| !self.names[*column].is_empty()).collect()
    }

    pub(super) fn ignored(&self) -> Vec<&str> {
        self.unused().into_iter().map(|column| self.names[column].as_str()).collect()
    }
}

/// The column of this name; `who` asks for it.
fn named(rows: &Rows, name: &str, names: &[String], who: &str) -> Result<usize, InputError> {
    let found: Vec<usize> = (0..names.len()).filter(|&column| names[column] == name).collect();
    match found[..] {
        [column] => Ok(column),
        [] => {
            let remedy = format!("the columns here are {}; {who}", shown(names));
            Err(rows.fault(Some(name), "the column is missing", remedy))
        }
        _ => Err(rows.fault(Some(name), "the column is there more than once", "rename all but one")),
    }
}

pub(super) fn shown(names: &[String]) -> String {
    let mut shown: Vec<String> = names.iter().take(MOST_NAMES).map(|name| quoted(name)).collect();
    if names.len() > MOST_NAMES {
        shown.push("...".into());
    }
    shown.join(", ")
}

fn absent(rows: &Rows, key: Key, name: &str, names: &[String]) -> InputError {
    let interval = if key == Key::Time { ", or, without instants, --interval SECONDS" } else { "" };
    let key = key.name();
    let remedy = format!(
        "the columns here are {}; say which it is: --column {key}=NAME{interval}; or {key}: (column: \"NAME\") in a file for --map: fogcoil check RECORD --write-map MAP.ron proposes one, with columns, units and lines above the names",
        shown(names)
    );
    rows.fault(Some(name), "the column is missing", remedy)
}

fn check_separator(rows: &Rows, format: &RecordFormat) -> Result<(), InputError> {
    let line = rows.fields().collect::<Vec<_>>().join("\n");
    if line.contains('\r') {
        let remedy = "save the file with line feeds (Unix) or both (Windows)";
        return Err(rows.fault(None, "the lines end in carriage returns alone", remedy));
    }
    if rows.count() > 1 {
        return Ok(());
    }
    let table = rows.sniffed();
    let preamble = table.as_ref().map_or(0, |table| table.preamble);
    let [own, said] = [format.dialect.separator, table.as_ref().map_or(0, |table| table.separator_byte())];
    if preamble > 0 && said == own {
        let problem = format!("the names of the columns seem to stand in line {}, below a logger's remarks", preamble + 1);
        return Err(rows.fault(
            None,
            problem,
            format!("let {WRITE_MAP}, or give its preamble_lines: {preamble} in a file for --map"),
        ));
    }
    // most rows agree on the table's; the first line alone may be a remark
    let is_other = |byte: u8| byte != own && if table.is_some() { byte == said } else { line.as_bytes().contains(&byte) };
    let others = [(b';', "semicolons", "';'"), (b'\t', "tabs", "tab"), (b',', "commas", "','"), (b'|', "bars", "'|'")];
    let Some((_, name, flag)) = others.into_iter().find(|(byte, ..)| is_other(*byte)) else { return Ok(()) };
    let problem = format!("the fields seem to be separated by {name}");
    let flags = format!("--separator {flag} (and --decimal-comma if numbers are written like 20,5)");
    let remedy = if preamble > 0 {
        format!(
            "let {WRITE_MAP}: its names seem to stand in line {}, below a logger's remarks; or add {flags} and skip those",
            preamble + 1
        )
    } else {
        format!("add {flags}, or let {WRITE_MAP}")
    };
    Err(rows.fault(None, problem, remedy))
}

const WRITE_MAP: &str = "`fogcoil check RECORD --write-map` find how it is written";
