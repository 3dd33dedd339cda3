//! A potted coil that stands free, without a spool: how much of the sensitivity is the spool's doing?
#![allow(missing_docs)]
#![allow(clippy::print_stdout, reason = "the example is a program")]

#[path = "../tests/common/mod.rs"]
mod common;

fn main() -> Result<(), coil::Error> {
    let on_spool = coil::steady_sensitivity(&common::reference())?.sensitivity.total();
    let free = coil::steady_sensitivity(&common::changed(|design| design.spool = None))?.sensitivity.total();
    println!("on its spool {on_spool:.3}, free {free:.3} (deg/h)/(degC/min)");
    assert_eq!(format!("{:.1}", on_spool / free), "6.9");
    Ok(())
}
