//! Questions of a page.

use serde::Deserialize;

/// Keys, and their values as RON.
pub(crate) type Values = Vec<(String, String)>;

#[derive(Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Question {
    /// Files to start from.
    Start {},
    /// A coil file with other values.
    Design(Changes),
    /// Bias in a steady ramp.
    Sensitivity { coil: String },
    /// Bias under a profile.
    Simulate {
        coil: String,
        profile: String,
        /// Seconds between rows that are added.
        step: Option<f64>,
    },
    /// Whether a recording is usable.
    Check { name: String, text: String },
}

/// A design and its changes.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Changes {
    pub(crate) coil: String,
    #[serde(default)]
    pub(crate) values: Values,
    /// A cell file whose constants take the place of the coil file's.
    pub(crate) cell: Option<String>,
    #[serde(default)]
    pub(crate) of_cell: Values,
}
