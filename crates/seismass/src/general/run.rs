//! A run from the first sample to the last.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::{Error, Result};
use crate::general::decay::decayed;
use crate::general::energy::Balance;
use crate::general::guards::{Guard, Search};
use crate::general::histories::Recorder;
use crate::general::outcome::{Happening, Outcome};
use crate::general::peaks::Observer;
use crate::general::regime::DecayingMode;
use crate::general::response::{GeneralBase, GeneralEvent, GeneralResponse, GeneralStatus};
use crate::general::series::{Quantity, Series};
use crate::general::state::GeneralState;
use crate::general::system::System;
use crate::general::terms::Terms;
use crate::machines::block::{BlockMotion, BlockState};
use crate::response::{EventKind, Statistics};
use crate::run::limits::{EVENTS_PER_INTERVAL, EVENTS_PER_MACHINE};
use crate::scene::{GeneralScene, Motion, Options};
use crate::state::interval::interval;
use crate::tolerances::{GENERAL_PHASE, REFUSED_PHASE, SERIES_PHASE};

/// Solves a scene of the general engine under one motion.
///
/// # Errors
/// [`Error::Invalid`] when histories do not fit into memory; [`Error::TooStiff`], [`Error::TooManyEvents`] and
/// [`Error::NotFinite`] when a run cannot go on.
pub fn simulate_general(scene: &GeneralScene, motion: &Motion, options: &Options) -> Result<GeneralResponse> {
    simulate_general_until(scene, motion, options, &AtomicBool::new(false))
}

/// Solves a scene of the general engine under one motion, unless `stop` is set meanwhile.
///
/// # Errors
/// As [`simulate_general`], and [`Error::Interrupted`].
pub fn simulate_general_until(
    scene: &GeneralScene,
    motion: &Motion,
    options: &Options,
    stop: &AtomicBool,
) -> Result<GeneralResponse> {
    let system = System::new(scene, motion)?;
    let vertical = motion.vertical().is_some() && (system.base.is_some() || !system.blocks.is_empty());
    let mut state = GeneralState::new(scene, &system, vertical);
    let samples = motion.acceleration().len();
    let recorder = options.histories.map(|every| Recorder::new(&system, options, samples, every)).transpose()?;
    state.interval = interval(motion, motion.vertical(), 0);
    let mut run = Run {
        observer: Observer::new(&state),
        state,
        series: Series::default(),
        terms: Terms::default(),
        rows: Default::default(),
        recorder,
        balance: None,
        lost_at_stops: 0.0,
        statistics: Statistics { substeps: 1, ..Statistics::default() },
        log: Vec::new(),
        keep_log: options.events,
    };
    run.begin(options.energy)?;
    let mut status = GeneralStatus::Completed;
    for i in 0..samples - 1 {
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        run.state.interval = interval(motion, motion.vertical(), i);
        if let Some((number, time)) = run.solve_interval(stop)? {
            status = GeneralStatus::Collapsed { number, time };
            break;
        }
    }
    let end_time = match status {
        GeneralStatus::Completed => {
            run.record(samples - 1, if samples > 1 { motion.dt() } else { 0.0 });
            (samples - 1) as f64 * motion.dt()
        }
        GeneralStatus::Collapsed { time, .. } => time,
    };
    if end_time == 0.0 {
        run.observer.take_accelerations(&run.state.accelerations(0.0), 0.0);
    }
    Ok(run.finish(status, end_time))
}

struct Run<'a> {
    state: GeneralState<'a>,
    series: Series,
    /// Working space of the series.
    terms: Terms<1>,
    /// Working space: rows by node.
    rows: [Vec<f64>; 3],
    observer: Observer,
    recorder: Option<Recorder>,
    balance: Option<Balance>,
    lost_at_stops: f64,
    statistics: Statistics,
    log: Vec<GeneralEvent>,
    keep_log: bool,
}

impl Run<'_> {
    /// Lets every node decide at t = 0.
    fn begin(&mut self, energy: bool) -> Result<()> {
        let state = &mut self.state;
        let contact = (state.interval.contact, state.interval.contact_change);
        if state.vertical && (contact.0 < 0.0 || contact.0 == 0.0 && contact.1 <= 0.0) {
            state.airborne = true;
            state.motions.iter_mut().chain(&mut state.base).for_each(|motion| motion.state = BlockState::Airborne);
        }
        state.follow();
        if !state.airborne {
            let mut happening =
                Happening { state, tau: 0.0, log: &mut self.log, lost_at_stops: &mut self.lost_at_stops };
            let outcome = happening.decide_all();
            self.state.follow();
            self.judge(outcome, 0.0)?;
        }
        self.count_events(0);
        self.observer.take_values(&self.state, 0.0);
        self.balance = energy.then(|| Balance::begin(&self.state));
        Ok(())
    }

    /// Solves the present interval; returns the spring that collapsed, and when.
    fn solve_interval(&mut self, stop: &AtomicBool) -> Result<Option<(usize, f64)>> {
        self.statistics.intervals += 1;
        let (sample, h) = (self.state.interval.sample, self.state.interval.h);
        let most = self.event_limit(h);
        let (mut events, mut tau) = (0, 0.0);
        let mut is_recorded = false;
        while tau < h {
            self.form_series(tau, h - tau)?;
            let (step, remaining) = (self.series.h, h - tau);
            self.statistics.series_steps += 1;
            let (first, isolated) = Search::first(&self.state, &self.series);
            self.statistics.guards_isolated += isolated;
            let place = first.map_or(1.0, |(place, _)| place);
            // A row at the time of an event is the state after it.
            if !is_recorded && place > 0.0 {
                self.record(sample, 0.0);
                is_recorded = true;
            }
            tau = if first.is_none() && step == remaining { h } else { (tau + place * step).min(h) };
            self.advance(place, tau)?;
            let Some((_, guard)) = first else {
                if stop.load(Ordering::Relaxed) {
                    return Err(Error::Interrupted);
                }
                continue;
            };
            events += 1;
            if let Some(collapsed) = self.carry_out(guard, tau)? {
                return Ok(Some(collapsed));
            }
            if events > most {
                return Err(self.too_many_events(guard, tau, most));
            }
        }
        Ok(None)
    }

    /// Forms the series from `tau` on, as long as terms allow, within the time that remains.
    fn form_series(&mut self, tau: f64, remaining: f64) -> Result<()> {
        let whole = self.phase_of(remaining)?;
        let decayed = decayed(&mut self.state, &mut self.terms, tau, remaining);
        let modes = self.state.regime.decaying.get().filter(|modes| whole > SERIES_PHASE && !modes.is_empty());
        let bound = |modes: &Vec<DecayingMode>| match modes.get(decayed) {
            Some(alive) => alive.rate.max(alive.left),
            None => modes[decayed - 1].left,
        };
        let phase = modes.map_or(whole, |modes| whole.min(bound(modes) * remaining));
        let pieces = (phase / GENERAL_PHASE).ceil().max(1.0);
        // What is left beside such modes is known less closely: the series has all orders, and ends by its terms.
        let of_order = if phase < whole { GENERAL_PHASE } else { phase / pieces };
        let step = (remaining / pieces, of_order);
        self.series.form(&mut self.terms, &self.state, tau, step, decayed, of_order > SERIES_PHASE);
        Ok(())
    }

    /// Advances to the place of the present series, which is at `tau`.
    fn advance(&mut self, place: f64, tau: f64) -> Result<()> {
        let (state, series) = (&mut self.state, &self.series);
        let [accelerations, drifts, rates] = &mut self.rows;
        let time = state.interval.start + tau;
        // An instant is no stretch of time: what it passes through has no peaks.
        let lasts = place > 0.0;
        if lasts {
            series.values(Quantity::Acceleration, 0.0, accelerations);
            self.observer.take_accelerations(accelerations, state.interval.start + series.tau);
        }
        self.statistics.guards_isolated += self.observer.observe(state, series, place);
        if let Some(balance) = &mut self.balance {
            balance.add(state, series, place);
        }
        series.changes(Quantity::Drift, place, drifts);
        series.changes(Quantity::Rate, place, rates);
        for p in 0..drifts.len() {
            state.x[p] += drifts[p];
            state.v[p] += rates[p];
        }
        if let Some(base) = &mut state.base {
            base.move_by((rates[0], drifts[0]));
        }
        for position in 0..state.moving.len() {
            let block = state.moving[position];
            let change = series.block_changes(position, place);
            state.motions[block].move_by(change);
            state.stops[block].move_by(change.1);
        }
        series.values(Quantity::Acceleration, place, accelerations);
        if lasts {
            self.observer.take_accelerations(accelerations, time);
        }
        self.observer.take_values(state, time);
        if accelerations.iter().all(|a| a.is_finite()) && state.motions.iter().all(|m| m.slip.is_finite()) {
            return Ok(());
        }
        Err(not_finite(state, time))
    }

    fn carry_out(&mut self, guard: Guard, tau: f64) -> Result<Option<(usize, f64)>> {
        let (state, logged) = (&mut self.state, self.log.len());
        let mut happening = Happening { state, tau, log: &mut self.log, lost_at_stops: &mut self.lost_at_stops };
        let outcome = happening.carry_out(guard);
        let time = self.state.interval.start + tau;
        self.observer.take_values(&self.state, time);
        for GeneralEvent { event, velocity } in &self.log[logged..] {
            if event.kind == EventKind::TouchStop {
                self.observer.take_contact_velocity(event.number - 1, *velocity, event.time);
            }
        }
        self.count_events(logged);
        self.judge(outcome, tau)
    }

    fn judge(&self, outcome: Outcome, tau: f64) -> Result<Option<(usize, f64)>> {
        let time = self.state.interval.start + tau;
        match outcome {
            Outcome::Continue => Ok(None),
            Outcome::Collapse(node) => Ok(Some((node, time))),
            Outcome::Undecided(node) => {
                let reason = format!("no consistent state of the blocks on node {node} at t = {time} s");
                Err(Error::Defect { reason })
            }
        }
    }

    fn record(&mut self, sample: usize, tau: f64) {
        if let Some(recorder) = &mut self.recorder {
            recorder.append(&self.state, sample, || self.state.accelerations(tau));
        }
    }

    /// Counts the events logged since entry `from`.
    fn count_events(&mut self, from: usize) {
        for event in &self.log[from..] {
            self.statistics.events.add(event.event.kind);
        }
        if !self.keep_log {
            self.log.clear();
        }
    }

    /// Radians of the stiffest vibration of the present regime in a time.
    fn phase_of(&self, time: f64) -> Result<f64> {
        let phase = self.state.regime.frequency * time;
        if phase <= REFUSED_PHASE {
            return Ok(phase);
        }
        Err(Error::TooStiff { time: self.state.interval.start, phase, limit: REFUSED_PHASE })
    }

    fn event_limit(&self, h: f64) -> usize {
        let machines = self.state.system.nodes + 1 + self.state.motions.len();
        EVENTS_PER_INTERVAL + EVENTS_PER_MACHINE * machines * (1 + (self.state.regime.frequency * h) as usize)
    }

    #[cold]
    fn too_many_events(&self, guard: Guard, tau: f64, limit: usize) -> Error {
        let state = &self.state;
        let spring = |node: usize| (state.system.element_name(node), state.springs[node - 1].state_name());
        let block = |j: usize| (format!("block {}", j + 1), state.motions[j].state_name());
        let base = || ("base".to_string(), state.base.map_or("", |motion| motion.state_name()));
        let on = |node: usize| state.system.on_node[node].first().copied().unwrap_or(0);
        let (event, (element, name)) = match guard {
            Guard::SegmentEnd { node, .. } => ("end of a spring's segment", spring(node)),
            Guard::Collapse { node } => ("collapse", spring(node)),
            Guard::Turn { node } => ("unload", spring(node)),
            Guard::Breakaway { node, .. } => ("slip", block(on(node))),
            Guard::BreakawayAtStop { block: j, .. } => ("slip", block(j)),
            Guard::BaseBreakaway { .. } => ("slip", base()),
            Guard::BaseArrival => ("stick", base()),
            Guard::Arrival { block: j } => ("stick", block(j)),
            Guard::Wear { block: j } => ("wear", block(j)),
            Guard::Contact if state.motions.is_empty() => ("lift or land", base()),
            Guard::Contact => ("lift or land", block(0)),
            Guard::Touch { block: j, .. } | Guard::TouchAgain { block: j } => ("touch of a stop", block(j)),
            Guard::Leave { block: j } | Guard::Clear { block: j } => ("leave of a stop", block(j)),
        };
        Error::TooManyEvents { time: state.interval.start + tau, limit, event, element, state: name.to_string() }
    }

    fn finish(mut self, status: GeneralStatus, end_time: f64) -> GeneralResponse {
        let state = &self.state;
        (self.statistics.regimes, self.statistics.regime_hits) = state.regimes.entered;
        let laws = &state.system.laws;
        self.statistics.skipped.elastic_storeys = laws.iter().filter(|law| !law.spring.law().can_yield()).count();
        let on_node = &state.system.on_node;
        self.statistics.skipped.bare_floors = on_node.iter().skip(1).filter(|blocks| blocks.is_empty()).count();
        let (histories, of_base) = self.recorder.map(Recorder::finish).unzip();
        let [history, velocity_history, acceleration_history] = of_base.unwrap_or_default();
        let base = state.base.map(|motion| {
            let (slip, acceleration) = self.observer.of_base();
            let (residual_slip, slip_path) = (motion.slip, motion.path_in_contact());
            GeneralBase {
                slip,
                acceleration,
                residual_slip,
                slip_path,
                history,
                velocity_history,
                acceleration_history,
            }
        });
        GeneralResponse {
            storeys: state.system.storeys,
            levels: state.system.levels.clone(),
            status,
            end_time,
            residual_drift: (1..=state.system.nodes).map(|p| state.drift(p)).collect(),
            residual_slip: state.motions.iter().map(|motion| motion.slip).collect(),
            slip_path: state.motions.iter().map(BlockMotion::path_in_contact).collect(),
            events: self.keep_log.then_some(self.log),
            base,
            histories,
            energy: self.balance.map(|balance| balance.finish(state, self.lost_at_stops)),
            peaks: self.observer.finish(),
            statistics: self.statistics,
        }
    }
}

#[cold]
fn not_finite(state: &GeneralState, time: f64) -> Error {
    let node = (1..state.x.len()).find(|&p| !(state.x[p] + state.v[p]).is_finite());
    let block = state.motions.iter().position(|motion| !(motion.slip + motion.velocity).is_finite());
    let element = match (node, block) {
        (Some(p), _) => state.system.element_name(p),
        (None, Some(j)) => format!("block {}", j + 1),
        (None, None) => "the building".into(),
    };
    Error::NotFinite { time, element }
}
