//! The one way in which long and short work of the kernel is run: the interpreter is released, panics and errors
//! become exceptions, and long work is watched for Ctrl-C by the calling thread.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use seismass::{Control, Domain, Error};

use crate::errors::{from_kernel, from_panic, simulation_error};

/// How often the calling thread looks for signals and reports progress.
const WATCH_INTERVAL: Duration = Duration::from_millis(50);

/// More threads than any machine has cores for; starting them would take longer than the work.
pub(crate) const MAX_THREADS: usize = 1024;

/// The number of threads of a batch or spectrum (`owner`), refused beyond [`MAX_THREADS`].
pub(crate) fn checked_threads(py: Python<'_>, threads: Option<usize>, owner: &str) -> PyResult<Option<usize>> {
    match threads {
        Some(count) if !(1..=MAX_THREADS).contains(&count) => {
            let requirement = format!("between 1 and {MAX_THREADS}");
            Err(from_kernel(py, &Error::invalid(Domain::Options, "threads", owner, requirement, count)))
        }
        _ => Ok(threads),
    }
}

type Outcome<T> = Result<seismass::Result<T>, Box<dyn Any + Send>>;

fn finish<T>(py: Python<'_>, outcome: Outcome<T>) -> PyResult<T> {
    match outcome {
        Ok(result) => result.map_err(|error| from_kernel(py, &error)),
        Err(payload) => Err(from_panic(py, payload.as_ref())),
    }
}

/// Runs short work on the calling thread with the interpreter released.
pub(crate) fn run_inline<T: Send>(py: Python<'_>, work: impl FnOnce() -> seismass::Result<T> + Send) -> PyResult<T> {
    finish(py, py.detach(|| catch_unwind(AssertUnwindSafe(work))))
}

/// Runs long work on another thread; meanwhile this one checks signals and calls `progress` with the number of runs
/// done. If either raises, the exception is raised at once, and the work, which owns all it needs, is told to stop and
/// left to wind down by itself.
pub(crate) fn run_watched<T: Send + 'static>(
    py: Python<'_>,
    mut progress: impl FnMut(usize) -> PyResult<()>,
    work: impl FnOnce(&Control) -> seismass::Result<T> + Send + 'static,
) -> PyResult<T> {
    let control = Arc::new(Control::default());
    let (sender, mut receiver) = channel();
    let shared = Arc::clone(&control);
    let work = move || {
        // Nobody receives what an interrupted worker sends.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(|| work(&shared))));
    };
    let started = thread::Builder::new().name("seismass".into()).spawn(work);
    started.map_err(|error| simulation_error(py, format!("no thread could be started for the run: {error}")))?;
    loop {
        let waiting = &mut receiver;
        let received: Result<Outcome<T>, RecvTimeoutError> = py.detach(move || waiting.recv_timeout(WATCH_INTERVAL));
        let mut report = || py.check_signals().and_then(|()| progress(control.done.load(Ordering::Relaxed)));
        match received {
            Ok(outcome) => {
                let value = finish(py, outcome)?;
                report()?;
                return Ok(value);
            }
            Err(RecvTimeoutError::Timeout) => {
                report().inspect_err(|_| control.stop.store(true, Ordering::Relaxed))?;
            }
            Err(RecvTimeoutError::Disconnected) => return Err(from_panic(py, &"the worker thread vanished")),
        }
    }
}
