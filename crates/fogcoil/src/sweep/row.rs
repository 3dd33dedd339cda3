//! Result of one point.

use serde::{Deserialize, Serialize};

use crate::variants::Value;

/// A row of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Value of each factor, in the unit of its key; all `None` where there is no such design.
    pub values: Vec<Option<Value>>,
    /// Outputs; none where there is no such design.
    pub outputs: Vec<Option<f64>>,
    /// Reason why there is no such design.
    pub problem: Option<String>,
}
