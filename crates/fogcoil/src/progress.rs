//! Notes, and a line for what takes longer than a second, on standard error.

use std::io::Write;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// What takes this long is named.
const PATIENCE: Duration = Duration::from_secs(1);

/// Whether to say what is going on.
#[derive(Clone, Copy)]
pub(crate) enum Progress {
    OnStandardError,
    Silent,
}

impl Progress {
    /// Says something.
    pub(crate) fn note(self, text: &str) {
        match self {
            // nobody is left to tell if standard error is closed
            Self::OnStandardError => drop(writeln!(std::io::stderr().lock(), "note: {text}")),
            Self::Silent => {}
        }
    }

    /// Does `work`, and names it if it takes long.
    pub(crate) fn during<T>(self, name: &str, work: impl FnOnce() -> T) -> T {
        let (done, watch) = channel::<()>();
        thread::scope(|scope| {
            scope.spawn(move || {
                if watch.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                    self.note(&format!("{name} ..."));
                }
            });
            let result = work();
            drop(done);
            result
        })
    }
}
