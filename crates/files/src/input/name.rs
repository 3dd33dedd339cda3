//! Names as they are read.

use std::borrow::Cow;

use serde::{Deserialize, Deserializer};

use crate::shown;

/// Reads a name; what a terminal would obey becomes its escape.
pub(super) fn printable<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Cow::<str>::deserialize(deserializer).map(|name| shown(&name))
}
