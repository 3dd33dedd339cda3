//! Commented files to start from.

/// A coil on its spool.
pub const COIL: &str = include_str!("../templates/coil.ron");
/// A fibre's cell.
pub const CELL: &str = include_str!("../templates/cell.ron");
/// Measured constants, and the cells to try.
pub const TARGETS: &str = include_str!("../templates/targets.ron");
/// A mechanism of a user's own.
pub const MECHANISM: &str = include_str!("../templates/mechanism.ron");
/// A profile of the chamber's temperature.
pub const PROFILE: &str = include_str!("../templates/profile.csv");
/// Limits that units must keep.
pub const LIMITS: &str = include_str!("../templates/limits.ron");

/// Every template by the name of its kind.
pub const ALL: [(&str, &str); 6] =
    [("coil", COIL), ("cell", CELL), ("targets", TARGETS), ("mechanism", MECHANISM), ("profile", PROFILE), ("limits", LIMITS)];
