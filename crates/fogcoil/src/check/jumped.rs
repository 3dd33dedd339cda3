//! A chamber's readings that jump: a step of its programme, or of its sensor.

use files::{Note, Remark};
use recording::Seconds;
use recording::condition::bridged;

use crate::input::{CHAMBER, RecordCase};
use crate::jumps::jumps;
use crate::table::significant;

/// Least jump that is worth a word \[K\]: what a thermometer may be off by, and no rounded corner of a programme makes.
const WORTH_K: f64 = 0.5;

/// A note on the largest jump of the chamber's readings; whether the air jumped the coil's model tells.
pub(super) fn jumped(case: &RecordCase) -> Option<Note> {
    let used = case.report.used(&case.recording);
    let chamber = bridged(used.time(), &used.channel(CHAMBER)?.values)?;
    let all: Vec<_> = jumps(used.time(), &chamber).into_iter().filter(|jump| jump.by.abs() >= WORTH_K).collect();
    let largest = all.first()?;
    let others = if all.len() > 1 { ", and at other times" } else { "" };
    let beyond = if largest.is_behind_gap { ", in the gap before it and beyond the slopes on either side" } else { "" };
    Some(Remark::ChamberJump.note(format!(
        "{CHAMBER} jumps by {} K at {} s{beyond}{others}: a step of the air, or of the sensor, which diagnose tells by the spool",
        significant(largest.by, 2),
        Seconds(used.time()[largest.row])
    )))
}
