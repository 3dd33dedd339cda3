//! What is computed of one point.

use serde::{Deserialize, Serialize};

use crate::variants::Value;

/// A row of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Of each factor, in the unit of its key; all `None` where there is no such design.
    pub values: Vec<Option<Value>>,
    /// What comes out; none where there is no such design.
    pub outputs: Vec<Option<f64>>,
    /// Why there is no such design.
    pub problem: Option<String>,
}
