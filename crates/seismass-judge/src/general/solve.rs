//! The run: sample intervals cut into pieces, pieces cut at events.

use std::cell::Cell;

use seismass::{GeneralEvent, GeneralScene, GeneralStatus, Motion};

use super::arrangement::Machines;
use super::guards::Guard;
use super::model::Model;
use super::record::{GeneralSolution, Recorder};
use super::series::{MAX_PHASE, Series};
use super::state::State;
use super::stretches::Stretches;
use crate::model::Terms;
use crate::real::Real;
use crate::solve::{JudgeError, MAX_EVENTS, MAX_PIECES, drive};
use crate::state::{Contact, Drive};

/// Solves a scene of the general engine under a motion, with histories at every `every`-th sample.
///
/// # Errors
/// [`JudgeError`] when the state machines chatter, numbers overflow, or the scene is far too stiff for the time step.
pub fn solve_general<R: Real>(
    scene: &GeneralScene,
    motion: &Motion,
    every: usize,
) -> Result<GeneralSolution, JudgeError> {
    solve_scaled(scene, motion, every, Scale::<R>::none(), &Budget::unlimited())
}

/// Series that all solutions of one scene may take together. One in double-double counts as thirty: so much longer it takes.
#[derive(Debug)]
pub(crate) struct Budget {
    limit: usize,
    spent: Cell<usize>,
}

impl Budget {
    /// What a series in double-double counts.
    const PRECISE: usize = 30;

    /// So many series in double precision.
    pub(crate) fn of(limit: usize) -> Self {
        Self { limit, spent: Cell::new(0) }
    }

    pub(super) fn unlimited() -> Self {
        Self::of(usize::MAX)
    }

    /// Takes one series.
    ///
    /// # Errors
    /// [`JudgeError::TooDear`] where there are none left.
    pub(super) fn spend<R: Real>(&self) -> Result<(), JudgeError> {
        self.check()?;
        self.spent.set(self.spent.get() + if R::EPSILON < f64::EPSILON { Self::PRECISE } else { 1 });
        Ok(())
    }

    /// # Errors
    /// [`JudgeError::TooDear`] where no series are left.
    pub(crate) fn check(&self) -> Result<(), JudgeError> {
        let left = self.spent.get() < self.limit;
        if left { Ok(()) } else { Err(JudgeError::TooDear { limit: self.limit, precise: Self::PRECISE }) }
    }
}

/// Factors of the motion. In double-double they may differ from 1 by less than a double can.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale<R> {
    /// Of the ground acceleration.
    pub(crate) ground: R,
    /// Of g + a_v, and so of all limits of friction.
    pub(crate) contact: R,
}

impl<R: Real> Scale<R> {
    /// The motion as it is.
    pub(crate) fn none() -> Self {
        Self { ground: R::of(1.0), contact: R::of(1.0) }
    }

    pub(super) fn drive(&self, motion: &Motion, sample: usize) -> Drive<R> {
        let Drive { ground, contact } = drive(motion, sample);
        Drive { ground: ground.map(|term: R| term * self.ground), contact: contact.map(|term: R| term * self.contact) }
    }
}

/// As [`solve_general`], under the motion times factors and within a budget.
pub(crate) fn solve_scaled<R: Real>(
    scene: &GeneralScene,
    motion: &Motion,
    every: usize,
    scale: Scale<R>,
    budget: &Budget,
) -> Result<GeneralSolution, JudgeError> {
    if every == 0 {
        return Err(JudgeError::NoDecimation);
    }
    let mut model = Model::<R>::new(scene);
    model.base.iter_mut().for_each(|base| base.bound(motion));
    let phase = model.frequency_bound(|_| false) * motion.dt() / MAX_PHASE;
    if phase > MAX_PIECES {
        return Err(JudgeError::TooStiff { longest: motion.dt() * MAX_PIECES / phase, dt: motion.dt() });
    }
    let pieces = phase.ceil().max(1.0) as usize;
    let samples = motion.acceleration().len();
    let dt = R::of(motion.dt());
    let mut run = Run {
        state: State::new(scene, &model),
        stretches: Stretches::default(),
        model,
        drive: scale.drive(motion, 0),
        airborne: false,
        piece: dt / R::of(pieces as f64),
        start: R::zero(),
        log: Vec::new(),
        parted: R::zero(),
    };
    run.begin();
    let at_start = |node| run.state.acceleration(&run.model, node, &run.drive, R::zero(), Terms::Signed);
    let acceleration = (0..run.model.mass.len()).map(|p| at_start(Some(p))).collect();
    let mut recorder = Recorder::new(&run.model, &run.state, acceleration, every);
    recorder.begin_base(at_start(None));
    let mut status = GeneralStatus::Completed;
    'run: for i in 0..samples - 1 {
        run.drive = scale.drive(motion, i);
        run.start = R::of(i as f64) * dt;
        for piece in 0..pieces {
            let ends = [piece, piece + 1].map(|p| dt * R::of(p as f64) / R::of(pieces as f64));
            if let Some((node, time)) = run.solve_piece(ends, &mut recorder, budget)? {
                status = GeneralStatus::Collapsed { number: node + 1, time };
                break 'run;
            }
        }
        if !run.state.is_finite() {
            return Err(JudgeError::NotFinite { time: (run.start + dt).to_f64() });
        }
        recorder.sample(&run.state, i + 1);
    }
    let end_time = match status {
        GeneralStatus::Completed => (R::of((samples - 1) as f64) * dt).to_f64(),
        GeneralStatus::Collapsed { time, .. } => time,
    };
    Ok(recorder.finish(&run.model, &run.state, (status, end_time), samples, run.log, run.parted))
}

struct Run<R> {
    model: Model<R>,
    state: State<R>,
    stretches: Stretches,
    drive: Drive<R>,
    airborne: bool,
    /// Length of a whole piece.
    piece: R,
    /// Beginning of the present sample interval.
    start: R,
    log: Vec<GeneralEvent>,
    parted: R,
}

impl<R: Real> Run<R> {
    fn machines(&mut self) -> Machines<'_, R> {
        let Self { model, state, drive, airborne, piece, start, log, parted, .. } = self;
        Machines { model, state, drive: *drive, airborne, piece: *piece, start: *start, log, parted }
    }

    /// At t = 0 every node decides, unless there is no contact.
    fn begin(&mut self) {
        let [contact, change] = self.drive.contact;
        self.airborne = contact < R::zero() || contact == R::zero() && change <= R::zero();
        if self.airborne {
            self.state.blocks.iter_mut().chain(&mut self.state.base).for_each(|b| b.contact = Contact::Airborne);
        } else {
            self.machines().settle_all(R::zero());
        }
    }

    /// Solves from `begin` to `end` after the beginning of the interval; a spring that collapses, and when.
    fn solve_piece(
        &mut self,
        [begin, end]: [R; 2],
        recorder: &mut Recorder<R>,
        budget: &Budget,
    ) -> Result<Option<(usize, f64)>, JudgeError> {
        let (mut tau, mut events) = (begin, 0);
        loop {
            budget.spend::<R>()?;
            let rest = end - tau;
            let short = self.stretches.longest(&self.model, &self.state).filter(|&longest| longest < rest);
            let length = short.unwrap_or(rest);
            let mut series = Series::new(&self.model, &self.state, &self.drive, tau, length);
            let event = self.machines().first_event(&series);
            if let Some((place, ..)) = event {
                series.shrink(place);
            }
            // An instant is no stretch of time: the regimes passed through at it have no peaks.
            if series.length > R::zero() {
                recorder.stretch(&self.model, &self.state, &series, self.start + tau);
            }
            series.advance(&mut self.state);
            series.add_paths(&mut self.state);
            tau = tau + series.length;
            match event {
                None if short.is_some() => continue,
                None => return Ok(None),
                Some((.., Guard::Collapse { node })) => return Ok(Some((node, (self.start + tau).to_f64()))),
                Some((.., guard)) => self.machines().carry_out(guard, &series, tau),
            }
            events += 1;
            if events == MAX_EVENTS {
                let last = self.log.last().map(|e| e.event);
                let last = last.map_or(String::new(), |e| format!("{} of {}", e.kind.name(), e.number));
                return Err(JudgeError::TooManyEvents { time: (self.start + tau).to_f64(), limit: MAX_EVENTS, last });
            }
        }
    }
}
