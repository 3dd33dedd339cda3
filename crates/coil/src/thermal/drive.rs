//! Drives of the temperature.

use crate::Side;

/// Something whose course in time a profile gives, in K (walls, mounts) or in units of the design's power (heaters).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Drive {
    /// The chamber's wall, and every mount, where no other drive of the list takes them.
    Chamber,
    /// The end wall of the chamber on this side.
    EndWall(Side),
    /// The mount of the flange on this side.
    Mount(Side),
    /// All heaters of the design; 1 is their full power.
    Heaters,
}
