//! A value of a key, as a plan draws it.

/// A value of a key.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Value {
    /// A number, in the unit of the key.
    Number(f64),
    /// A choice.
    Choice(String),
    /// A choice with a name, and what it stands for in a coil file.
    Named(String, String),
}

impl Value {
    /// The value as a coil file writes it.
    pub fn ron(&self) -> String {
        match self {
            Self::Number(value) => format!("{value}"),
            Self::Choice(text) | Self::Named(_, text) => text.clone(),
        }
    }

    /// The value as text.
    pub fn shown(&self) -> String {
        match self {
            Self::Number(value) => format!("{value:?}"),
            Self::Choice(text) | Self::Named(text, _) => text.clone(),
        }
    }
}
