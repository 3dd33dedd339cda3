//! `new`: a commented file to start from.

use std::path::PathBuf;

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use fogcoil::{Error, output, templates};

use crate::print;

#[derive(Args)]
pub(crate) struct New {
    /// The file to write; an existing one is left as it is
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Kind of the file; it may stand before the file, too
    #[arg(long, value_enum, default_value_t = Kind::Coil)]
    kind: Kind,
    /// The file, where its kind stands first
    #[arg(value_name = "FILE", hide = true, conflicts_with = "kind")]
    second: Option<PathBuf>,
}

/// Kinds of files to start from.
#[derive(Clone, Copy, ValueEnum)]
enum Kind {
    /// A coil on its spool, for wind, sensitivity, trim, simulate, diagnose, recommend and explain
    Coil,
    /// A fibre's cell, for homogenize
    Cell,
    /// Measured constants and the cells to try, for identify
    Targets,
    /// A mechanism of your own, for diagnose, simulate, recommend and explain
    Mechanism,
    /// A profile of the chamber's temperature, for simulate and trim
    Profile,
    /// Limits that units must keep, for batch
    Limits,
}

impl Kind {
    fn template(self) -> &'static str {
        match self {
            Self::Coil => templates::COIL,
            Self::Cell => templates::CELL,
            Self::Targets => templates::TARGETS,
            Self::Mechanism => templates::MECHANISM,
            Self::Profile => templates::PROFILE,
            Self::Limits => templates::LIMITS,
        }
    }

    /// First command to try on it.
    fn first(self) -> &'static str {
        match self {
            Self::Coil => "fogcoil sensitivity",
            Self::Cell => "fogcoil homogenize",
            Self::Targets => "fogcoil identify",
            Self::Mechanism => "fogcoil explain",
            Self::Profile => "fogcoil simulate COIL.ron --step 30 --out BIAS.csv --profile",
            Self::Limits => "fogcoil batch COIL.ron RECORDS --out DIR --limits",
        }
    }
}

pub(crate) fn run(New { file, kind, second }: &New) -> Result<(), Error> {
    let (file, kind) = match second {
        None => (file, *kind),
        Some(second) => {
            let first = file.to_string_lossy();
            let kind = Kind::from_str(&first, false).map_err(|_| {
                let kinds: Vec<_> = Kind::value_variants().iter().filter_map(Kind::to_possible_value).collect();
                let kinds = kinds.iter().map(PossibleValue::get_name).collect::<Vec<_>>().join(", ");
                Error::usage(format!("{} is no kind of file; one file at a time, of a kind: {kinds}", files::shown(&first)))
            })?;
            (second, kind)
        }
    };
    // a file is read as its name says
    let (form, right, wrong) = match kind {
        Kind::Profile => ("the template of a profile is a table", "csv", ["json", "ron"]),
        _ => ("templates are RON", "ron", ["json", "csv"]),
    };
    if file.extension().is_some_and(|end| wrong.iter().any(|wrong| end.eq_ignore_ascii_case(wrong))) {
        let (file, name) = (files::shown_path(file), files::shown_path(&file.with_extension(right)));
        return Err(Error::usage(format!("{file}: {form}; name it {name}")));
    }
    output::write_new(file, kind.template())?;
    print(&format!("{} is written; try `{} {0}`\n", files::shown_path(file), kind.first()))
}
