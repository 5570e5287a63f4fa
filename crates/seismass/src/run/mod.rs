//! The run: a scene and a motion in, a response out.

use std::mem::take;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::{Error, Result};
use crate::events::carry_out::{carry_out_in_lanes, settle_all};
use crate::events::first::First;
use crate::events::guards::first_event;
use crate::lanes::{Padded, Vector, by_width, for_each_path};
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::guard::{Guard, Outcome};
use crate::machines::model::Model;
use crate::plain::run::Walk;
use crate::plain::run::plain_run;
use crate::polynomial::orders::MAX_PHASE;
use crate::record::histories::Recorder;
use crate::record::observer::Observer;
use crate::record::update::update_bounds;
use crate::regime::Row;
use crate::response::{Event, Response, Statistics, Status};
use crate::scene::{Motion, Options, Scene};
use crate::state::State;
use crate::state::relative::block_change;
use crate::step::cache::RegimeCache;

/// Events one sample interval may have, beside [`EVENTS_PER_MACHINE`].
const EVENTS_PER_INTERVAL: usize = 256;
/// Events each storey and block may have within one vibration of the stiffest mode.
const EVENTS_PER_MACHINE: usize = 64;
/// Longest step of a run, as the frequency of the elastic building times time; a motion with longer sample intervals is
/// solved in substeps. What clears a step is a bound that grows with its fourth power, and a step that it does not clear
/// is solved by a series for each radian: shorter steps cost less.
const LONGEST_PHASE: f64 = 4.0;
/// Most substeps of a sample interval, and of a motion: they are held in memory.
const MOST_SUBSTEPS: usize = 1 << 10;
const MOST_SUBSTEPS_OF_MOTION: usize = 1 << 21;
/// Most radians of the stiffest vibration in a step: each takes a series of its own where something happens.
const MOST_PHASE: f64 = 65536.0;
/// Peaks this close to each other, relatively, may be the same but for rounding.
const SAME_PEAK: f64 = 1e-9;
/// Steps of a quiet tail between two looks at whether a peak can be beaten there: taken so whether or not it is asked,
/// since rounding may tell where a peak lies among equal values.
const STEPS_OF_QUIET: usize = 32;
/// Steps between two looks at the caller's wish to stop.
const STEPS_PER_POLL: usize = 1024;

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
    let mut run = Run {
        state: State::new(scene, model, cache, vertical),
        walk: Walk::new(model),
        observer: Observer::new(model, options, samples, substeps)?,
        statistics: Statistics { substeps, ..Statistics::default() },
        log: Vec::new(),
        keep_log: options.events,
    };
    run.begin(motion);
    let first = run.skip_quiet_head(motion);
    let quiet_from = motion.acceleration().iter().rposition(|&a| a != 0.0).map_or(0, |i| i + 1);
    let mut status = Status::Completed;
    let last = samples - 1;
    let mut i = first;
    while i < last {
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        if peaks_only && i >= quiet_from && run.no_peak_can_be_beaten() {
            break;
        }
        run.phase_of(motion.dt())?;
        let is_open;
        (i, is_open) = run.plain_run(motion, i, quiet_from);
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

/// Substeps of each sample interval, a power of two: a time step divided by it, and times that multiples of that are, are
/// exact. `phase` is the frequency that a step must suit times the interval.
fn substeps(phase: f64, samples: usize) -> usize {
    let most = (MOST_SUBSTEPS_OF_MOTION / samples).min(MOST_SUBSTEPS);
    let mut substeps = 1;
    while phase > LONGEST_PHASE * substeps as f64 && 2 * substeps <= most {
        substeps *= 2;
    }
    substeps
}

for_each_path! {
    /// Solves the present interval by series and records its end; returns the storey that collapsed, and when.
    fn solve_interval[K: usize](run: &mut Run, stop: &AtomicBool) -> Result<Option<(usize, f64)>> = interval_by_path
}

#[inline(always)]
fn interval_by_path<V: Vector, const K: usize>(run: &mut Run, stop: &AtomicBool) -> Result<Option<(usize, f64)>> {
    run.statistics.intervals += 1;
    let h = run.state.interval.h;
    let phase_at_start = run.state.regime.frequency * h;
    let mut events = 0;
    let mut tau = 0.0;
    while tau < h {
        let remaining = h - tau;
        let phase = run.phase_of(remaining)?;
        let pieces = if phase > MAX_PHASE { (phase / MAX_PHASE).ceil() } else { 1.0 };
        let event = run.series_step::<V, K>(tau, remaining / pieces)?;
        match event.guard() {
            None if pieces == 1.0 => tau = h,
            None if stop.load(Ordering::Relaxed) => return Err(Error::Interrupted),
            None => tau += remaining / pieces,
            Some(guard) => {
                tau = (tau + event.place() * remaining / pieces).min(h);
                events += 1;
                if let Outcome::Collapse(storey) = run.carry_out::<V, K>(guard, tau) {
                    return Ok(Some((storey, run.state.interval.start + tau)));
                }
                if events > EVENTS_PER_INTERVAL {
                    let limit = run.event_limit(phase_at_start);
                    if events > limit {
                        return Err(run.too_many_events(guard, tau, limit));
                    }
                }
                continue;
            }
        }
        let time = run.state.interval.start + tau;
        if run.state.blocks.is_sliding || run.state.blocks.airborne {
            run.observer.observe_slips(&run.state, time);
        }
    }
    run.observer.record_in_lanes::<V, K>(&run.state, run.state.interval.sample + 1);
    Ok(None)
}

for_each_path! {
    /// Integrates energies over `h` from `tau`, up to which nothing happens, and advances by it.
    fn add_energy[K: usize](state: &mut State, observer: &mut Observer, tau: f64, h: f64) = add_energy_by_path
}

#[inline(always)]
fn add_energy_by_path<V: Vector, const K: usize>(state: &mut State, observer: &mut Observer, tau: f64, h: f64) {
    state.form_series::<V, K>(tau, h);
    observer.add_energy(state, tau, 1.0);
    advance::<V, K>(state, tau, true);
}

struct Run<'a> {
    state: State<'a>,
    walk: Walk,
    observer: Observer,
    statistics: Statistics,
    log: Vec<Event>,
    keep_log: bool,
}

impl Run<'_> {
    /// Lets every floor decide at t = 0.
    fn begin(&mut self, motion: &Motion) {
        let state = &mut self.state;
        state.set_interval(motion, 0);
        let contact = (state.interval.contact, state.interval.contact_change);
        if state.vertical && (contact.0 < 0.0 || contact.0 == 0.0 && contact.1 <= 0.0) {
            state.blocks.airborne = true;
            state.blocks.motions.iter_mut().for_each(|m| m.state = BlockState::Airborne);
        }
        state.enter_regime();
        state.refresh_accelerations(0.0);
        if !state.blocks.airborne {
            settle_all(state, 0.0, &mut self.log);
            state.enter_regime();
            state.refresh_accelerations(0.0);
        }
        self.count_events(0);
        self.observer.observe_values(&self.state, 0.0);
        self.observer.begin_energy(&self.state);
        self.observer.record(&self.state, 0);
        let model = self.state.model;
        self.statistics.skipped.elastic_storeys = model.laws.iter().filter(|law| !law.spring.law().can_yield()).count();
        self.statistics.skipped.bare_floors = model.on_floor.iter().skip(1).filter(|blocks| blocks.is_empty()).count();
    }

    /// The first interval in which anything can move: before it, zeros drive a scene at rest.
    fn skip_quiet_head(&mut self, motion: &Motion) -> usize {
        if self.state.vertical || !self.state.is_at_rest() {
            return 0;
        }
        let samples = motion.acceleration();
        let quiet = samples.iter().position(|&a| a != 0.0).unwrap_or(samples.len());
        let first = quiet.saturating_sub(1);
        for sample in 1..=first {
            self.observer.record(&self.state, sample);
        }
        self.statistics.skipped.head_samples = first;
        first
    }

    /// Whether in a motionless tail the energy left bounds everything below its peak and its guard.
    fn no_peak_can_be_beaten(&self) -> bool {
        let state = &self.state;
        let regime = &state.regime;
        let tangent = &regime.row(Row::Tangent)[..state.storeys()];
        let settled = state.blocks.motions.iter().all(BlockMotion::is_stuck)
            && state.springs.machines.iter().all(|s| s.rate_sign().is_none())
            && tangent.iter().all(|&k| k > 0.0);
        if !settled || state.vertical || !regime.is_passive() {
            return false;
        }
        let rest: Vec<f64> = (0..state.storeys())
            .map(|i| -state.springs.machines[i].base_load(&state.model.laws[i]) / tangent[i])
            .collect();
        let kinetic: f64 =
            regime.row(Row::Mass).iter().zip(state.kinematics.floor_velocities()).map(|(m, v)| m * v * v).sum();
        let elastic: f64 = (0..rest.len()).map(|i| tangent[i] * (state.kinematics.x[i] - rest[i]).powi(2)).sum();
        // Wider than rounding: without damping the same peak comes back in each cycle.
        let liveliness = (kinetic + elastic).sqrt() * (1.0 + SAME_PEAK);
        let contact = state.interval.contact;
        (0..rest.len()).all(|i| {
            let reach = liveliness / tangent[i].sqrt();
            let (low, high) = (rest[i] - reach, rest[i] + reach);
            let inside = |(lower, upper): (f64, f64)| high < upper && low > lower;
            let a = liveliness * regime.row(Row::SecondOfAcceleration)[i];
            inside(state.springs.segment_ends[i])
                && inside(state.springs.collapse_bounds[i])
                && !self.observer.drift_may_peak(state, i, low, high)
                && !self.observer.acceleration_may_peak(i, -a, a)
                && a < state.blocks.stuck_mu[i + 1] * contact
        })
    }

    /// Takes plain steps from interval `i` as far as nothing has to be looked at between; returns the interval reached,
    /// and whether that one is not plain.
    #[inline(always)]
    fn plain_run(&mut self, motion: &Motion, i: usize, quiet_from: usize) -> (usize, bool) {
        let last = motion.acceleration().len() - 1;
        let cut = if i < quiet_from { quiet_from.min(i + STEPS_PER_POLL) } else { i + STEPS_OF_QUIET };
        let mut end = last.min(cut);
        let state = &mut self.state;
        let before = self.observer.keeps_energy().then(|| {
            end = i + 1;
            state.begin_interval(motion, i);
            moment(state)
        });
        let reached = plain_run(state, &mut self.walk, &mut self.observer, motion, i, end);
        self.statistics.intervals += reached - i;
        self.statistics.plain_steps += reached - i;
        self.statistics.series_steps += take(&mut self.walk.series);
        self.statistics.guards_isolated += take(&mut self.walk.isolated);
        if let Some(before) = before.filter(|_| reached > i) {
            add_energy_of_interval(state, before, &mut self.observer);
        }
        (reached, reached < end)
    }

    /// Radians of the stiffest vibration of the present regime in a time.
    fn phase_of(&self, time: f64) -> Result<f64> {
        let phase = self.state.regime.frequency * time;
        if phase <= MOST_PHASE { Ok(phase) } else { Err(self.too_stiff(phase)) }
    }

    /// Events that an interval may have, of so many radians of the stiffest mode.
    #[cold]
    #[inline(never)]
    fn event_limit(&self, phase: f64) -> usize {
        let machines = self.state.storeys() + self.state.blocks.motions.len();
        EVENTS_PER_INTERVAL + EVENTS_PER_MACHINE * machines * (1 + phase as usize)
    }

    /// Advances by a series over at most `h` from `tau`, up to the first event, which is returned with its place.
    ///
    /// Accelerations are advanced with the state where there is no event.
    #[inline(always)]
    fn series_step<V: Vector, const K: usize>(&mut self, tau: f64, h: f64) -> Result<First> {
        self.statistics.series_steps += 1;
        let (state, observer) = (&mut self.state, &mut self.observer);
        let isolated = &mut self.statistics.guards_isolated;
        state.form_series::<V, K>(tau, h);
        update_bounds::<V, K>(state, observer);
        state.form_ranges::<V, K>();
        // Squares of the response overflow before it does: nothing bounds it then, and no guard can be looked at.
        if !state.step.ranges.are_finite() {
            return Err(not_finite(state, tau));
        }
        let event = first_event::<V, K>(state, tau, isolated);
        let end = event.place();
        observer.observe_series::<V, K>(state, tau, end, isolated);
        if state.blocks.airborne {
            observer.observe_flights(state, tau, end);
        }
        if !event.is_none() {
            state.step.series.stop_at::<V, K>(state.model, end);
        }
        if observer.keeps_energy() {
            observer.add_energy(state, tau, end);
        }
        if !advance::<V, K>(state, tau, event.is_none()) {
            return Err(not_finite(state, tau + end * h));
        }
        if event.is_none() && state.step.ranges.suspects != [0; 3] {
            observer.take_building_in_lanes::<V, K>(state, state.interval.start + tau + state.step.series.h());
        }
        Ok(event)
    }

    /// Carries out an event at `tau`, to which the state has been advanced.
    #[inline(always)]
    fn carry_out<V: Vector, const K: usize>(&mut self, guard: Guard, tau: f64) -> Outcome {
        let (state, observer) = (&mut self.state, &mut self.observer);
        let time = state.interval.start + tau;
        if !guard.is_smooth() {
            state.refresh::<V, K>(tau);
            observer.take_accelerations_in_lanes::<V, K>(state, time);
        }
        let logged = self.log.len();
        let outcome = carry_out_in_lanes::<V, K>(state, guard, tau, &mut self.log);
        if outcome == Outcome::Continue {
            state.refresh::<V, K>(tau);
        }
        observer.take_building_in_lanes::<V, K>(state, time);
        if !guard.is_smooth() || state.blocks.is_sliding || state.blocks.airborne {
            observer.observe_slips(state, time);
        }
        if time == state.interval.start {
            observer.record_again(state, state.interval.sample);
        }
        self.count_events(logged);
        outcome
    }

    /// Counts the events logged since entry `from`.
    fn count_events(&mut self, from: usize) {
        for event in &self.log[from..] {
            self.statistics.events.add(event.kind);
        }
        if !self.keep_log {
            self.log.clear();
        }
    }

    #[cold]
    fn too_stiff(&self, phase: f64) -> Error {
        let substeps = self.statistics.substeps as f64;
        Error::TooStiff { time: self.state.interval.start, phase: phase * substeps, limit: MOST_PHASE * substeps }
    }

    #[cold]
    fn too_many_events(&self, guard: Guard, tau: f64, limit: usize) -> Error {
        let storey = |i: usize| (format!("storey {}", i + 1), self.state.springs.machines[i].state_name());
        let block = |j: usize| (format!("block {}", j + 1), self.state.blocks.motions[j].state_name());
        let on = |floor: usize| self.state.model.on_floor[floor].first().copied().unwrap_or(0);
        let (event, (element, state)) = match guard {
            Guard::SegmentEnd { storey: i, .. } => ("end of a spring's segment", storey(i)),
            Guard::Collapse { storey: i } => ("collapse", storey(i)),
            Guard::Turn { storey: i } => ("unload", storey(i)),
            Guard::Breakaway { floor, .. } => ("slip", block(on(floor))),
            Guard::Arrival { block: j } => ("stick", block(j)),
            Guard::Wear { block: j } => ("wear", block(j)),
            Guard::Contact => ("lift or land", block(0)),
        };
        Error::TooManyEvents { time: self.state.interval.start + tau, limit, event, element, state: state.to_string() }
    }

    fn finish(mut self, status: Status, end_time: f64, peaks_only: bool) -> Response {
        let n = self.state.storeys();
        let state = &self.state;
        let statistics = &mut self.statistics;
        (statistics.regimes, statistics.regime_hits) = state.key.entered;
        statistics.intervals = statistics.intervals.div_ceil(statistics.substeps);
        statistics.skipped.head_samples /= statistics.substeps;
        statistics.skipped.tail_samples /= statistics.substeps;
        let at_end = |value: f64| if peaks_only { f64::NAN } else { value };
        Response {
            status,
            end_time,
            residual_drift: (0..n).map(|i| at_end(state.springs.machines[i].drift(state.kinematics.x[i]))).collect(),
            residual_slip: state.blocks.motions.iter().map(|m| at_end(m.slip)).collect(),
            slip_path: state.blocks.motions.iter().map(BlockMotion::path).collect(),
            energy: self.observer.finish_energy(state),
            events: self.keep_log.then_some(self.log),
            peaks: self.observer.peaks(n),
            histories: self.observer.histories.map(Recorder::finish),
            statistics: self.statistics,
        }
    }
}

/// What moves: drifts, drift rates, floor accelerations, their rates, drift accelerations, and blocks.
struct Moment {
    lanes: [Padded; 5],
    /// See [`State::jerk_slope`] and [`State::is_formed`].
    jerk_slope: f64,
    is_formed: bool,
    motions: Vec<BlockMotion>,
}

/// Moves drifts, drift rates and blocks to the place of the present series, which begins at `tau`; at its end,
/// accelerations too. Returns whether all is finite.
#[inline(always)]
fn advance<V: Vector, const K: usize>(state: &mut State, tau: f64, to_end: bool) -> bool {
    let mut blocks = 0.0;
    if state.blocks.is_sliding || state.blocks.airborne {
        for j in 0..state.blocks.motions.len() {
            if !state.blocks.motions[j].is_stuck() {
                let change = block_change::<K>(state, j);
                state.blocks.motions[j].move_by(change);
                // No number times zero is zero but a finite one.
                blocks += 0.0 * (change.0 + change.1);
            }
        }
    }
    let end = to_end.then(|| tau + state.step.series.h());
    state.take_changes::<V, K>(end) && blocks == 0.0
}

/// What moves, at this moment.
fn moment(state: &State) -> Moment {
    let lanes = [
        &state.kinematics.x,
        &state.kinematics.v,
        &state.kinematics.a,
        &state.kinematics.jerk,
        &state.kinematics.drift_acceleration,
    ]
    .map(Clone::clone);
    let (jerk_slope, is_formed) = (state.kinematics.jerk_slope, state.kinematics.is_formed);
    Moment { lanes, jerk_slope, is_formed, motions: state.blocks.motions.clone() }
}

fn set_moment(state: &mut State, moment: Moment) {
    [
        state.kinematics.x,
        state.kinematics.v,
        state.kinematics.a,
        state.kinematics.jerk,
        state.kinematics.drift_acceleration,
    ] = moment.lanes;
    (state.kinematics.jerk_slope, state.kinematics.is_formed) = (moment.jerk_slope, moment.is_formed);
    state.blocks.motions = moment.motions;
}

/// Integrates the energies of an interval without events from its start, and leaves the state at its end as it is.
fn add_energy_of_interval(state: &mut State, start: Moment, observer: &mut Observer) {
    let end = moment(state);
    set_moment(state, start);
    let pieces = (state.regime.frequency * state.interval.h / MAX_PHASE).ceil().max(1.0);
    let h = state.interval.h / pieces;
    for piece in 0..pieces as usize {
        let tau = piece as f64 * h;
        by_width!(state.model.width, K => add_energy::<K>(state, observer, tau, h));
    }
    set_moment(state, end);
}

#[cold]
fn not_finite(state: &State, tau: f64) -> Error {
    let storey = state.kinematics.x.iter().zip(&state.kinematics.v).position(|(x, v)| !(x + v).is_finite());
    let block = state.blocks.motions.iter().position(|m| !(m.slip + m.velocity).is_finite());
    let element = match (storey, block) {
        (Some(i), _) => format!("storey {}", i + 1),
        (None, Some(j)) => format!("block {}", j + 1),
        // Only what is formed of them, as their squares.
        (None, None) => "the building".into(),
    };
    Error::NotFinite { time: state.interval.start + tau, element }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn substeps_are_short_enough_unless_they_are_too_many() {
        let phases = [0.0, 4.0, 4.1, 8.0, 8.1, 1e3, 1e9, f64::INFINITY, f64::NAN];
        assert_eq!(phases.map(|phase| substeps(phase, 8000)), [1, 1, 2, 2, 4, 256, 256, 256, 1]);
        assert_eq!(phases.map(|phase| substeps(phase, 100)), [1, 1, 2, 2, 4, 256, 1024, 1024, 1]);
        assert_eq!(phases.map(|phase| substeps(phase, MOST_SUBSTEPS_OF_MOTION)), [1; 9]);
    }
}
