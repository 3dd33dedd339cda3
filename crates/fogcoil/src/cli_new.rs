//! `new`: a commented file to start from.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fogcoil::{Error, output, templates};

use crate::print;

#[derive(Args)]
pub(crate) struct New {
    /// The file to write; an existing one is left as it is
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Kind of the file
    #[arg(long, value_enum, default_value_t = Kind::Coil)]
    kind: Kind,
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

pub(crate) fn run(New { file, kind }: &New) -> Result<(), Error> {
    output::write_new(file, kind.template())?;
    print(&format!("{} is written; try `{} {0}`\n", files::shown_path(file), kind.first()))
}
