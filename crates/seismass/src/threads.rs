//! The threads of a batch, and how they are stopped and watched.

use std::num::NonZero;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize};

use crate::error::{Domain, Error, Result};

/// Shared with the caller while a batch runs.
#[derive(Debug, Default)]
pub struct Control {
    /// Set by the caller to stop the batch.
    pub stop: AtomicBool,
    /// Number of runs finished so far.
    pub done: AtomicUsize,
}

/// Runs `work` of a batch or spectrum (`owner`) in a pool of `threads` threads: where those are all cores, in the global
/// one, whose threads stay. A process that was forked from one that has used that has none of its threads: it takes a
/// pool of its own.
pub(crate) fn in_pool<T: Send>(threads: Option<usize>, owner: &str, work: impl FnOnce() -> T + Send) -> Result<T> {
    if is_first_process() && threads.is_none_or(are_all_cores) {
        return Ok(work());
    }
    let refuse =
        |reason: String| Error::invalid(Domain::Options, "threads", owner, reason, threads.unwrap_or_default());
    if threads == Some(0) {
        return Err(refuse("at least 1".into()));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or_default()).build();
    Ok(pool.map_err(|error| refuse(format!("a number the system can start ({error})")))?.install(work))
}

/// Whether this is the process that was the first to ask.
#[cfg(not(target_family = "wasm"))]
fn is_first_process() -> bool {
    static PROCESS: OnceLock<u32> = OnceLock::new();
    let process = std::process::id();
    *PROCESS.get_or_init(|| process) == process
}

/// WebAssembly has no processes, and its standard library stops where it is asked for one.
#[cfg(target_family = "wasm")]
fn is_first_process() -> bool {
    true
}

/// Whether the global pool has so many threads. It is started by this where there are as many cores, not otherwise.
fn are_all_cores(threads: usize) -> bool {
    static CORES: OnceLock<usize> = OnceLock::new();
    let cores = *CORES.get_or_init(|| std::thread::available_parallelism().map_or(0, NonZero::get));
    threads == cores && threads == rayon::current_num_threads()
}
