//! The run in the plane: sample intervals cut into pieces, pieces cut at events and where a series ends.

use seismass::{GeneralStatus, PlaneMotion, PlaneScene};

use super::record::{PlaneRecorder, PlaneSolution};
use super::series::PlaneSeries;
use super::state::{Direction, Plane};
use crate::general::guards::Guard;
use crate::general::series::MAX_PHASE;
use crate::general::solve::{Budget, Scale};
use crate::real::Real;
use crate::solve::{JudgeError, MAX_EVENTS, MAX_PIECES};

/// Series of a run in double precision, and in a wider one. Those of a stiff direction reach no distance; so many take ten
/// seconds, and a minute.
const MAX_SERIES: [usize; 2] = [100_000, 20_000];

/// Solves a scene in two directions under a motion, with histories at every `every`-th sample.
///
/// # Errors
/// [`JudgeError`] when the state machines chatter, numbers overflow, or the scene is far too stiff for the time step.
pub fn solve_plane<R: Real>(
    scene: &PlaneScene,
    motion: &PlaneMotion,
    every: usize,
) -> Result<PlaneSolution, JudgeError> {
    solve_plane_scaled(scene, motion, every, Scale::<R>::none(), &Budget::unlimited())
}

/// As [`solve_plane`], under the motion times factors and within a budget.
pub(crate) fn solve_plane_scaled<R: Real>(
    scene: &PlaneScene,
    motion: &PlaneMotion,
    every: usize,
    scale: Scale<R>,
    budget: &Budget,
) -> Result<PlaneSolution, JudgeError> {
    if every == 0 {
        return Err(JudgeError::NoDecimation);
    }
    let motions = motion.directions();
    let mut plane = Plane::new(scene, motion, scale);
    let bound = plane.directions.each_ref().map(|direction| direction.model.frequency_bound(|_| false));
    let step = motions[0].dt();
    let phase = bound[0].max(bound[1]) * step / MAX_PHASE;
    if phase > MAX_PIECES {
        return Err(JudgeError::TooStiff { longest: step * MAX_PIECES / phase, dt: step });
    }
    let pieces = phase.ceil().max(1.0) as usize;
    let samples = motions[0].acceleration().len();
    let dt = R::of(step);
    plane.piece = dt / R::of(pieces as f64);
    plane.begin();
    let mut recorder = PlaneRecorder::new(&plane, every);
    let mut status = GeneralStatus::Completed;
    'run: for i in 0..samples - 1 {
        for (direction, motion) in plane.directions.iter_mut().zip(motions) {
            direction.drive = scale.drive(motion, i);
        }
        plane.start = R::of(i as f64) * dt;
        for piece in 0..pieces {
            let ends = [piece, piece + 1].map(|p| dt * R::of(p as f64) / R::of(pieces as f64));
            if let Some((node, time)) = plane.solve_piece(ends, &mut recorder, budget)? {
                status = GeneralStatus::Collapsed { number: node + 1, time };
                break 'run;
            }
        }
        if !plane.directions.iter().all(|direction| direction.state.is_finite()) {
            return Err(JudgeError::NotFinite { time: (plane.start + dt).to_f64() });
        }
        recorder.sample(&plane, i + 1);
    }
    let end_time = match status {
        GeneralStatus::Completed => (R::of((samples - 1) as f64) * dt).to_f64(),
        GeneralStatus::Collapsed { time, .. } => time,
    };
    Ok(recorder.finish(plane, (status, end_time), samples))
}

impl<R: Real> Plane<R> {
    /// At t = 0 every node decides, unless there is no contact.
    fn begin(&mut self) {
        self.look_at_velocities();
        let [contact, change] = self.directions[0].drive.contact;
        self.airborne = contact < R::zero() || contact == R::zero() && change <= R::zero();
        self.place_blocks();
        if !self.airborne {
            self.settle_all(R::zero());
        }
    }

    /// Solves from `begin` to `end` after the beginning of the interval; a spring that collapses, and when.
    fn solve_piece(
        &mut self,
        [begin, end]: [R; 2],
        recorder: &mut PlaneRecorder<R>,
        budget: &Budget,
    ) -> Result<Option<(usize, f64)>, JudgeError> {
        let (mut tau, mut events) = (begin, 0);
        while events < MAX_EVENTS {
            budget.spend::<R>()?;
            self.series += 1;
            let limit = MAX_SERIES[usize::from(R::EPSILON < f64::EPSILON)];
            if self.series > limit {
                return Err(JudgeError::TooManySeries { time: (self.start + tau).to_f64(), limit });
            }
            let mut length = end - tau;
            for Direction { model, state, stretches, .. } in &mut self.directions {
                length = stretches.longest(model, state).filter(|&longest| longest < length).unwrap_or(length);
            }
            let time = |tau: R| (self.start + tau).to_f64();
            let Some(mut series) = PlaneSeries::new(self, tau, length) else {
                let last = "a block that begins to slide and does not".into();
                return Err(JudgeError::TooManyEvents { time: time(tau), limit: 0, last });
            };
            if let Some(block) = self.arrival(&series) {
                self.arrive(block, tau, recorder);
            } else {
                let event = self.first_event(&series);
                if let Some((place, ..)) = event {
                    series.shrink(place);
                }
                // An instant is no stretch of time: the regimes passed through at it have no peaks.
                if series.length() > R::zero() {
                    recorder.stretch(self, &series, self.start + tau);
                }
                self.add_paths(&series);
                for (direction, series) in self.directions.iter_mut().zip(&series.directions) {
                    series.advance(&mut direction.state);
                }
                self.look_at_velocities();
                self.keep_young();
                let reaches_end = series.length() == end - tau;
                tau = if reaches_end { end } else { tau + series.length() };
                match event {
                    None => {
                        self.settle_young(tau);
                        if reaches_end {
                            return Ok(None);
                        }
                        continue;
                    }
                    Some((.., Guard::Collapse { node })) => return Ok(Some((node, (self.start + tau).to_f64()))),
                    Some((_, a, guard)) => self.carry_out((a, guard), &series, tau),
                }
            }
            self.settle_young(tau);
            events += 1;
        }
        let of_directions = self.directions.iter().filter_map(|direction| direction.log.last());
        let logged = of_directions.chain(self.log.last().map(|entry| &entry.event)).map(|entry| entry.event);
        let last = logged.max_by(|one, other| one.time.total_cmp(&other.time));
        let last = last.map_or(String::new(), |e| format!("{} of {}", e.kind.name(), e.number));
        Err(JudgeError::TooManyEvents { time: (self.start + tau).to_f64(), limit: events, last })
    }
}
