//! Long work, which tells its steps to Python and ends when the user interrupts it.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::OnceLock;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::Builder;
use std::time::Duration;

use fogcoil::Error;
use progress::Step;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::error::raised;

/// Interval between two looks at signals.
const LOOK: Duration = Duration::from_millis(50);
/// Bytes of the stack on which work is done: those of a main thread.
const STACK: usize = 8 << 20;

/// The payload with which stopped work unwinds at one of its steps.
struct Stopped;

/// Does `work`, whose steps `progress` is told, with the interpreter free. An interrupt, or an exception of `progress`, ends the work at its next step.
///
/// # Errors
/// That exception; else the work's own.
pub(crate) fn watched<T: Send>(
    py: Python,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&(dyn Fn(Step) + Sync)) -> Result<T, Error> + Send,
) -> PyResult<T> {
    let stop: OnceLock<PyErr> = OnceLock::new();
    let tell = |step: Step| {
        if let Some(call) = progress.filter(|_| stop.get().is_none())
            && let Err(error) = Python::attach(|py| call.call1(py, (step.task, step.done)).map(drop))
        {
            let _ = stop.set(error);
        }
        if stop.get().is_some() {
            // no panic: nothing is said of it, and the work's own threads take it up to here
            resume_unwind(Box::new(Stopped));
        }
    };
    let ended = py.detach(|| {
        std::thread::scope(|scope| {
            let (done, waiting) = channel::<()>();
            let (tell, work) = (&tell, AssertUnwindSafe(work));
            let run = move || {
                let AssertUnwindSafe(work) = { work };
                let result = catch_unwind(AssertUnwindSafe(|| work(tell)));
                drop(done);
                result
            };
            let thread = Builder::new().stack_size(STACK).spawn_scoped(scope, run)?;
            while waiting.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    let _ = stop.set(error);
                }
            }
            Ok::<_, std::io::Error>(thread.join().and_then(|result| result))
        })
    });
    let ended = ended.map_err(|error| PyRuntimeError::new_err(format!("no thread can be started: {error}")))?;
    match (stop.into_inner(), ended) {
        (Some(error), _) => Err(error),
        (None, Ok(result)) => result.map_err(raised),
        (None, Err(panic)) => resume_unwind(panic),
    }
}
