//! The run: sample intervals cut into pieces, pieces cut at events.

use seismass::{Event, Motion, STANDARD_GRAVITY, Scene, Status};
use thiserror::Error;

use crate::events::{Guard, Machines};
use crate::model::Model;
use crate::real::Real;
use crate::record::{Recorder, Solution};
use crate::series::{MAX_PHASE, Series};
use crate::state::{Contact, Drive, State};

/// More events than this within one piece mean that the state machines chatter.
pub(crate) const MAX_EVENTS: usize = 2000;
/// Pieces of one sample interval.
pub(crate) const MAX_PIECES: f64 = 1e8;

/// Why a scene was not solved.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum JudgeError {
    /// The state machines do not come to rest.
    #[error("more than {limit} events in one piece of an interval at t = {time} s; the last was {last}")]
    TooManyEvents {
        /// Time (s).
        time: f64,
        /// Bound on the events of one piece.
        limit: usize,
        /// The last guard that fell.
        last: String,
    },
    /// A direction of sliding is so stiff that explicit series reach no distance.
    #[error("more than {limit} series until t = {time} s")]
    TooManySeries {
        /// Time (s).
        time: f64,
        /// Bound on the series of a run.
        limit: usize,
    },
    /// All solutions asked for of one scene took too many series together.
    #[error("more than {limit} series in all solutions of the scene, one in double-double counted as {precise}")]
    TooDear {
        /// Bound on the series.
        limit: usize,
        /// What one in double-double counts.
        precise: usize,
    },
    /// The state left the range of the number type.
    #[error("the response left the range of numbers at t = {time} s")]
    NotFinite {
        /// Time (s).
        time: f64,
    },
    /// The scene is too stiff for its time step.
    #[error("dt of motion must be at most {longest} s for this building; got {dt}")]
    TooStiff {
        /// Longest time step that can be solved (s).
        longest: f64,
        /// Time step (s).
        dt: f64,
    },
    /// Histories need a positive decimation.
    #[error("every of the histories must be at least 1; got 0")]
    NoDecimation,
}

/// Linear course of the motion over the interval that follows sample `i` (a single sample: constant).
pub(crate) fn drive<R: Real>(motion: &Motion, i: usize) -> Drive<R> {
    let dt = R::of(motion.dt());
    let linear = |samples: &[f64], offset: f64| {
        let from = R::of(samples[i]);
        let to = R::of(samples[(i + 1).min(samples.len() - 1)]);
        [R::of(offset) + from, (to - from) / dt]
    };
    Drive {
        ground: linear(motion.acceleration(), 0.0),
        contact: motion.vertical().map_or([R::of(STANDARD_GRAVITY), R::zero()], |v| linear(v, STANDARD_GRAVITY)),
    }
}

/// Solves a scene under a motion, with histories at every `every`-th sample.
///
/// # Errors
/// [`JudgeError`] when the state machines chatter, numbers overflow, or the scene is far too stiff for the time step.
pub fn solve<R: Real>(scene: &Scene, motion: &Motion, every: usize) -> Result<Solution, JudgeError> {
    solve_disturbed::<R>(scene, motion, every, |_, _| {})
}

/// As [`solve`], with something done to the state at the beginning of every piece, of which it is told both ends (s).
pub(crate) fn solve_disturbed<R: Real>(
    scene: &Scene,
    motion: &Motion,
    every: usize,
    mut disturb: impl FnMut([f64; 2], &mut State<R>),
) -> Result<Solution, JudgeError> {
    if every == 0 {
        return Err(JudgeError::NoDecimation);
    }
    let model = Model::<R>::new(scene);
    let phase = model.frequency_bound() * motion.dt() / MAX_PHASE;
    if phase > MAX_PIECES {
        return Err(JudgeError::TooStiff { longest: motion.dt() * MAX_PIECES / phase, dt: motion.dt() });
    }
    let pieces = phase.ceil().max(1.0) as usize;
    let samples = motion.acceleration().len();
    let dt = R::of(motion.dt());
    let mut run = Run {
        state: State::new(scene, &model),
        model,
        drive: drive(motion, 0),
        airborne: false,
        piece: dt / R::of(pieces as f64),
        start: R::zero(),
        log: Vec::new(),
    };
    run.begin();
    let mut recorder = Recorder::new(&run.model, &run.state, &run.drive, every);
    let mut status = Status::Completed;
    'run: for i in 0..samples - 1 {
        run.drive = drive(motion, i);
        run.start = R::of(i as f64) * dt;
        for piece in 0..pieces {
            let ends = [piece, piece + 1].map(|p| dt * R::of(p as f64) / R::of(pieces as f64));
            disturb(ends.map(|tau| (run.start + tau).to_f64()), &mut run.state);
            if let Some((storey, time)) = run.solve_piece(ends, &mut recorder)? {
                status = Status::Collapsed { storey: storey + 1, time };
                break 'run;
            }
        }
        if !run.state.is_finite() {
            return Err(JudgeError::NotFinite { time: (run.start + dt).to_f64() });
        }
        recorder.sample(&run.state, i + 1);
    }
    let end_time = match status {
        Status::Completed => (R::of((samples - 1) as f64) * dt).to_f64(),
        Status::Collapsed { time, .. } => time,
    };
    Ok(recorder.finish(&run.model, &run.state, status, end_time, samples, run.log))
}

struct Run<R> {
    model: Model<R>,
    state: State<R>,
    drive: Drive<R>,
    airborne: bool,
    /// Length of a whole piece.
    piece: R,
    /// Beginning of the present sample interval.
    start: R,
    log: Vec<Event>,
}

impl<R: Real> Run<R> {
    fn machines(&mut self) -> Machines<'_, R> {
        let Self { model, state, drive, airborne, piece, start, log } = self;
        Machines { model, state, drive: *drive, airborne, piece: *piece, start: *start, log }
    }

    /// At t = 0 every floor decides, unless there is no contact.
    fn begin(&mut self) {
        let [contact, change] = self.drive.contact;
        self.airborne = contact < R::zero() || contact == R::zero() && change <= R::zero();
        if self.airborne {
            self.state.blocks.iter_mut().for_each(|b| b.contact = Contact::Airborne);
        } else {
            self.machines().settle_all(R::zero());
        }
    }

    /// Solves from `begin` to `end` after the beginning of the interval; a storey that collapses, and when.
    fn solve_piece(
        &mut self,
        [begin, end]: [R; 2],
        recorder: &mut Recorder<R>,
    ) -> Result<Option<(usize, f64)>, JudgeError> {
        let mut tau = begin;
        for _ in 0..MAX_EVENTS {
            let mut series = Series::new(&self.model, &self.state, &self.drive, tau, end - tau);
            let event = self.machines().first_event(&series);
            if let Some((place, _)) = event {
                series.shrink(place);
            }
            // An instant is no stretch of time: the regimes passed through at it have no peaks.
            if series.length > R::zero() {
                recorder.stretch(&self.model, &self.state, &series, self.start + tau);
            }
            series.advance(&mut self.state);
            let Some((_, guard)) = event else { return Ok(None) };
            tau = tau + series.length;
            if let Guard::Collapse { storey } = guard {
                return Ok(Some((storey, (self.start + tau).to_f64())));
            }
            self.machines().carry_out(guard, &series, tau);
        }
        let last = self.log.last().map_or(String::new(), |e| format!("{} of {}", e.kind.name(), e.number));
        Err(JudgeError::TooManyEvents { time: (self.start + tau).to_f64(), limit: MAX_EVENTS, last })
    }
}
