//! Signals that ask the program to end: the user's interrupt, the system's termination, a terminal that is closed.

/// Calls `leave` with a signal's number when the program is asked to end.
///
/// Without a handler the system's own ends the program; what is lost is tidiness.
#[cfg(unix)]
pub(crate) fn on_end(leave: impl Fn(i32) + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let asked = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| *signal != SIGHUP || !is_ignored(SIGHUP));
    if let Ok(mut signals) = signal_hook::iterator::Signals::new(asked) {
        std::thread::spawn(move || signals.forever().for_each(leave));
    }
}

/// The same where the system knows the interrupt alone, of number 2.
#[cfg(not(unix))]
pub(crate) fn on_end(leave: impl Fn(i32) + Send + 'static) {
    let _ = ctrlc::set_handler(move || leave(2));
}

/// Whether the program was begun with a signal ignored, as `nohup` does; no where the system does not tell.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| (mask >> (signal - 1)) & 1 == 1)
}
