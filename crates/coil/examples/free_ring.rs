//! A potted coil that stands free, without a spool: how much of the sensitivity is the spool's doing?
//!
//! Asserts one number.
#![allow(missing_docs)]

#[path = "../tests/common/mod.rs"]
mod common;

fn main() -> Result<(), coil::Error> {
    let on_spool = coil::steady_sensitivity(&common::reference())?.sensitivity.total();
    let free = coil::steady_sensitivity(&common::changed(|design| design.spool = None))?.sensitivity.total();
    assert_eq!(format!("{:.1}", on_spool / free), "6.9");
    Ok(())
}
