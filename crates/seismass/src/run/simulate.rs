//! A run from the first sample to the last.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::{Error, Result};
use crate::lanes::by_width;
use crate::machines::model::Model;
use crate::plain::plain_loop::PlainLoop;
use crate::record::observer::Observer;
use crate::response::{Response, Statistics, Status};
use crate::run::exact_run::ExactRun;
use crate::run::interval::solve_interval;
use crate::run::limits::substeps;
use crate::scene::{Motion, Options, Scene};
use crate::state::State;
use crate::step::cache::RegimeCache;

/// Solves one scene under one motion.
///
/// # Errors
/// [`Error::Invalid`] when histories do not fit into memory; [`Error::TooStiff`], [`Error::TooManyEvents`] and
/// [`Error::NotFinite`] when a run cannot go on.
pub fn simulate(scene: &Scene, motion: &Motion, options: &Options) -> Result<Response> {
    simulate_until(scene, motion, options, &AtomicBool::new(false))
}

/// Solves one scene under one motion, unless `stop` is set meanwhile.
///
/// # Errors
/// As [`simulate`], and [`Error::Interrupted`].
pub fn simulate_until(scene: &Scene, motion: &Motion, options: &Options, stop: &AtomicBool) -> Result<Response> {
    let model = Model::new(scene);
    run(scene, &model, motion, options, &mut RegimeCache::new(motion.dt()), stop)
}

/// Solves one scene; `cache` holds regimes of scenes with the same structure and time step.
pub(crate) fn run(
    scene: &Scene,
    model: &Model,
    motion: &Motion,
    options: &Options,
    cache: &mut RegimeCache,
    stop: &AtomicBool,
) -> Result<Response> {
    let substeps = substeps(cache.frequency(model) * motion.dt(), motion.acceleration().len());
    let motion = &motion.divided(substeps);
    cache.set_time_step(motion.dt());
    let vertical = motion.vertical().is_some() && !model.blocks.is_empty();
    let samples = motion.acceleration().len();
    let peaks_only = options.peaks_only && options.histories.is_none() && !options.energy;
    let mut run = ExactRun {
        state: State::new(scene, model, cache, vertical),
        plain_loop: PlainLoop::new(model),
        observer: Observer::new(model, options, samples, substeps)?,
        statistics: Statistics { substeps, ..Statistics::default() },
        log: Vec::new(),
        keep_log: options.events,
    };
    run.begin(motion);
    let first = run.skip_head_at_rest(motion);
    let rest_from = motion.acceleration().iter().rposition(|&a| a != 0.0).map_or(0, |i| i + 1);
    let mut status = Status::Completed;
    let last = samples - 1;
    let mut i = first;
    while i < last {
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        if peaks_only && i >= rest_from && run.no_peak_can_be_beaten() {
            break;
        }
        run.phase_of(motion.dt())?;
        let is_open;
        (i, is_open) = run.plain_run(motion, i, rest_from);
        if !is_open {
            continue;
        }
        run.state.begin_interval(motion, i);
        if let Some((storey, time)) = by_width!(model.width, K => solve_interval::<K>(&mut run, stop))? {
            status = Status::Collapsed { storey: storey + 1, time };
            break;
        }
        i += 1;
    }
    if status == Status::Completed {
        run.statistics.skipped.tail_samples = last - i;
    }
    let end_time = match status {
        Status::Completed => last as f64 * motion.dt(),
        Status::Collapsed { time, .. } => time,
    };
    Ok(run.finish(status, end_time, peaks_only))
}
