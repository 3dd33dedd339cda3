//! The arguments.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

use crate::cli_batch::BatchOf;
use crate::cli_calibrate::Calibrate;
use crate::cli_check::{Check, Format};
use crate::cli_compare::Compare;
use crate::cli_explain::Explain;
use crate::cli_homogenize::Homogenize;
use crate::cli_measure::Measure;
use crate::cli_new::New;
use crate::cli_optimise::Optimise;
use crate::cli_recommend::Recommend;
use crate::cli_simulate::Simulate;
use crate::cli_sweep::Sweep;
use crate::cli_under::Under;

/// Thermal bias of fibre-optic-gyroscope coils.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit status: 0 done; 2 bad usage or input; 1 the program's own failure, and of `batch` a unit that has not passed its limits; 130 interrupted, 143 terminated, 129 hung up."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// No notes, and no progress on standard error; results and warnings stay
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Number of threads [default: $RAYON_NUM_THREADS, or that of the cores]
    #[arg(long, value_name = "N", global = true)]
    pub(crate) jobs: Option<std::num::NonZeroUsize>,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Effective constants and the M row of a fibre's cell, and the strains inside it
    Homogenize(Homogenize),
    /// Constituents from measured effective constants, with their determined and undetermined combinations
    Identify {
        /// Measured effective constants and the cells to try, e.g. fixtures/identify/table-one.ron
        #[arg(value_name = "TARGETS.ron")]
        targets: PathBuf,
        /// Print one JSON object, in SI
        #[arg(long)]
        json: bool,
    },
    /// Summary of the winding; turn table and cross-section picture
    Wind {
        /// Case file of the coil
        #[arg(value_name = "COIL.ron")]
        coil: PathBuf,
        /// Write the turn table here
        #[arg(long, value_name = "FILE")]
        csv: Option<PathBuf>,
        /// Draw the cross-section here
        #[arg(long, value_name = "FILE")]
        svg: Option<PathBuf>,
        /// Print the summary as one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Steady-ramp sensitivity in (deg/h)/(degC/min), by part
    Sensitivity {
        /// Case file of the coil
        #[arg(value_name = "COIL.ron")]
        coil: PathBuf,
        /// List every tolerance, also those below 0.5 % of the variance
        #[arg(long)]
        all: bool,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Tail lengths, or turns to cut off, that null the steady sensitivity, with their uncertainty
    Trim {
        /// Case file of the coil
        #[arg(value_name = "COIL.ron")]
        coil: PathBuf,
        #[command(flatten)]
        under: Under,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Two designs side by side: differing keys, sensitivity by part with tolerances, bias under a profile
    Compare(Compare),
    /// Designs around a drawing by the thousand, as a table: grids, samples, tolerances, and the part of the design from which the spread comes
    Sweep(Sweep),
    /// The design with the least sensitivity, spread, mass or length within limits, over numbers and choices; the front where several are weighed
    #[command(alias = "optimize")]
    Optimise(Optimise),
    /// Thermometer and bias in time under a profile of the chamber's temperature, or from a thermometer's record
    Simulate(Simulate),
    /// The difference between a unit's recording and its design, and its most likely cause
    Diagnose(Diagnose),
    /// Constants of a lot from records of its good units, as a design for its further units
    Calibrate(Calibrate),
    /// Many units of one design: each measured, diagnosed and judged by limits; tables, and a page with trends
    Batch(BatchOf),
    /// The chamber programme, or the further sensor, that tells mechanisms apart
    Recommend(Recommend),
    /// The meaning of an id of a mechanism or a warning; or the change of a coil that would give a measured sensitivity
    Explain(Explain),
    /// Are recordings usable? Gaps, units, outliers, noise, Allan deviation; of several a line each
    Check(Check),
    /// Bias sensitivity per degC/min, bias over temperature and noise of recordings, as specifications state them
    Measure(Measure),
    /// A commented file to start from: a coil design, a cell, targets to identify, a mechanism of your own, a profile, or limits of a batch
    New(New),
    /// Completions of the command line, for a shell to read
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: Shell,
    },
    /// The manual: the program's page, or with --dir one for each command too
    Man {
        /// Write fogcoil.1, fogcoil-check.1 and so on into this folder
        #[arg(long, value_name = "DIR")]
        dir: Option<PathBuf>,
    },
}

#[derive(Args)]
pub(crate) struct Diagnose {
    /// Case file of the coil
    #[arg(value_name = "COIL.ron")]
    pub(crate) coil: PathBuf,
    /// Record to find and fit with; may be given more than once, for one unit
    #[arg(long = "fit", value_name = "A.csv", required = true)]
    pub(crate) fits: Vec<PathBuf>,
    /// Record of the same unit to judge on
    #[arg(long = "holdout", value_name = "B.csv")]
    pub(crate) holdouts: Vec<PathBuf>,
    /// A mechanism of your own beside the program's (`fogcoil new --kind mechanism`), or the id of one that is weighed on request (`fogcoil explain`); may be given more than once
    #[arg(long = "mechanism", value_name = "MECHANISM.ron|ID")]
    pub(crate) mechanisms: Vec<PathBuf>,
    /// Id of a mechanism that the unit is known not to have, as by its inspection; may be given more than once
    #[arg(long, value_name = "ID")]
    pub(crate) without: Vec<String>,
    /// Write one JSON object here; without a file, print it alone
    #[arg(long, value_name = "J", num_args = 0..=1)]
    pub(crate) json: Option<Option<PathBuf>>,
    /// Write the prediction of the first held-out record here
    #[arg(long, value_name = "P.csv", requires = "holdouts")]
    pub(crate) prediction: Option<PathBuf>,
    /// Write the extended design here, a coil file with the explanation in its place; a mechanism of your own gets M.ID.ron beside it
    #[arg(long, value_name = "M.ron")]
    pub(crate) model_out: Option<PathBuf>,
    /// Write a page with plots here
    #[arg(long, value_name = "R.html")]
    pub(crate) report: Option<PathBuf>,
    /// Facts about the records besides their columns [default: meta.ron beside each, if it is there]
    #[arg(long, value_name = "FILE")]
    pub(crate) meta: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) format: Format,
    /// Build the models anew and do not keep them
    #[arg(long)]
    pub(crate) no_cache: bool,
}
