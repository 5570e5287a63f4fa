//! One sample interval with events.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::{Error, Result};
use crate::events::carry_out::carry_out_in_lanes;
use crate::events::first::First;
use crate::events::guards::first_event;
use crate::lanes::{Vector, for_each_path};
use crate::machines::guard::{Guard, Outcome};
use crate::record::update::update_bounds;
use crate::run::advance::{advance, not_finite};
use crate::run::exact_run::ExactRun;
use crate::run::limits::{EVENTS_PER_INTERVAL, EVENTS_PER_MACHINE};
use crate::tolerances::{REFUSED_PHASE, SERIES_PHASE};

for_each_path! {
    /// Solves the present interval by series and records its end; returns the storey that collapsed, and when.
    pub(crate) fn solve_interval[K: usize](run: &mut ExactRun, stop: &AtomicBool) -> Result<Option<(usize, f64)>> = interval_by_path
}

#[inline(always)]
fn interval_by_path<V: Vector, const K: usize>(run: &mut ExactRun, stop: &AtomicBool) -> Result<Option<(usize, f64)>> {
    run.statistics.intervals += 1;
    let h = run.state.interval.h;
    let phase_at_start = run.state.regime.frequency * h;
    let mut events = 0;
    let mut tau = 0.0;
    while tau < h {
        let remaining = h - tau;
        let phase = run.phase_of(remaining)?;
        let pieces = if phase > SERIES_PHASE { (phase / SERIES_PHASE).ceil() } else { 1.0 };
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

impl ExactRun<'_> {
    /// Radians of the stiffest vibration of the present regime in a time.
    pub(crate) fn phase_of(&self, time: f64) -> Result<f64> {
        let phase = self.state.regime.frequency * time;
        if phase <= REFUSED_PHASE { Ok(phase) } else { Err(self.too_stiff(phase)) }
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
        if let Some(forces) = &mut observer.forces {
            forces.observe::<V, K>(state, tau, end);
        }
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
        if event.is_none() && state.step.ranges.near_bound != [0; 3] {
            observer.take_building_in_lanes::<V, K>(state, state.interval.start + tau + state.step.series.h());
        }
        if event.is_none() {
            observer.take_forces(state, tau + state.step.series.h());
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
            observer.take_forces(state, tau);
        }
        if state.blocks.is_sliding || state.blocks.airborne {
            observer.observe_slips(state, time);
        }
        let logged = self.log.len();
        let outcome = carry_out_in_lanes::<V, K>(state, guard, tau, &mut self.log);
        if outcome == Outcome::Continue {
            state.refresh::<V, K>(tau);
        }
        observer.take_building_in_lanes::<V, K>(state, time);
        observer.take_forces(state, tau);
        if time == state.interval.start {
            observer.record_again(state, state.interval.sample);
        }
        self.count_events(logged);
        outcome
    }

    #[cold]
    fn too_stiff(&self, phase: f64) -> Error {
        let substeps = self.statistics.substeps as f64;
        Error::TooStiff { time: self.state.interval.start, phase: phase * substeps, limit: REFUSED_PHASE * substeps }
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
}
