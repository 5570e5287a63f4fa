//! A run in progress: its state, what is kept of it, and its statistics.

use std::mem::take;

use crate::events::carry_out::settle_all;
use crate::machines::block::{BlockMotion, BlockState};
use crate::plain::plain_loop::PlainLoop;
use crate::plain::run::plain_run;
use crate::record::forces::FloorForces;
use crate::record::histories::Recorder;
use crate::record::observer::Observer;
use crate::response::{Event, Response, Statistics, Status};
use crate::run::advance::{add_energy_of_interval, moment};
use crate::scene::Motion;
use crate::state::State;

/// Steps of a tail at rest between two checks whether a peak can be beaten there: taken so whether or not it is asked,
/// since rounding may tell where a peak lies among equal values.
const STEPS_AT_REST: usize = 32;

/// Steps between two looks at the caller's wish to stop.
const STEPS_PER_POLL: usize = 1024;

pub(crate) struct ExactRun<'a> {
    pub(crate) state: State<'a>,
    pub(crate) plain_loop: PlainLoop,
    pub(crate) observer: Observer,
    pub(crate) statistics: Statistics,
    pub(crate) log: Vec<Event>,
    pub(crate) keep_log: bool,
}

impl ExactRun<'_> {
    /// Lets every floor decide at t = 0.
    pub(crate) fn begin(&mut self, motion: &Motion) {
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
        self.observer.take_forces(&mut self.state, 0.0);
        self.observer.begin_energy(&self.state);
        self.observer.record(&self.state, 0);
        let model = self.state.model;
        self.statistics.skipped.elastic_storeys = model.laws.iter().filter(|law| !law.spring.law().can_yield()).count();
        self.statistics.skipped.bare_floors = model.on_floor.iter().skip(1).filter(|blocks| blocks.is_empty()).count();
    }

    /// Takes plain steps from interval `i` as far as nothing has to be looked at between; returns the interval reached,
    /// and whether that one is not plain.
    #[inline(always)]
    pub(crate) fn plain_run(&mut self, motion: &Motion, i: usize, rest_from: usize) -> (usize, bool) {
        let last = motion.acceleration().len() - 1;
        let cut = if i < rest_from { rest_from.min(i + STEPS_PER_POLL) } else { i + STEPS_AT_REST };
        let mut end = last.min(cut);
        let state = &mut self.state;
        let before = self.observer.keeps_energy().then(|| {
            end = i + 1;
            state.begin_interval(motion, i);
            moment(state)
        });
        let reached = plain_run(state, &mut self.plain_loop, &mut self.observer, motion, i, end);
        self.statistics.intervals += reached - i;
        self.statistics.plain_steps += reached - i;
        self.statistics.series_steps += take(&mut self.plain_loop.series);
        self.statistics.guards_isolated += take(&mut self.plain_loop.isolated);
        if let Some(before) = before.filter(|_| reached > i) {
            add_energy_of_interval(state, before, &mut self.observer);
        }
        (reached, reached < end)
    }

    /// Counts the events logged since entry `from`.
    pub(crate) fn count_events(&mut self, from: usize) {
        for event in &self.log[from..] {
            self.statistics.events.add(event.kind);
        }
        if !self.keep_log {
            self.log.clear();
        }
    }

    pub(crate) fn finish(mut self, status: Status, end_time: f64, peaks_only: bool) -> Response {
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
            floor_force: self.observer.forces.as_ref().map(FloorForces::peaks),
            histories: self.observer.histories.map(Recorder::finish),
            statistics: self.statistics,
        }
    }
}
