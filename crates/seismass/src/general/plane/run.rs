//! A run in the plane from the first sample to the last.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::error::{Error, Result};
use crate::general::guards::Guard;
use crate::general::histories::Recorder;
use crate::general::outcome::Outcome;
use crate::general::plane::energy::PlaneBalance;
use crate::general::plane::guards::{PlaneGuard, PlaneSearch};
use crate::general::plane::outcome::PlaneHappening;
use crate::general::plane::peaks::PlaneObserver;
use crate::general::plane::response::{Axis, PlaneEvent, PlaneResponse};
use crate::general::plane::series::PlaneSeries;
use crate::general::plane::state::PlaneState;
use crate::general::plane::vector::length;
use crate::general::response::GeneralStatus;
use crate::general::series::Quantity;
use crate::general::system::System;
use crate::machines::block::BlockState;
use crate::response::{EventKind, Statistics};
use crate::run::limits::{EVENTS_PER_INTERVAL, EVENTS_PER_MACHINE};
use crate::scene::{Options, PlaneMotion, PlaneScene};
use crate::state::interval::interval;
use crate::tolerances::{ARRIVED_ON_CIRCLE, REFUSED_PHASE};

/// Steps that sliding blocks may take within one sample interval, beside one for each radian of the stiffest vibration.
const STEPS_PER_INTERVAL: usize = 200_000;

/// Blocks of a node this many times as fast as one that stops, or slower, stop with it.
const STOP_TOGETHER: f64 = 4.0;

/// Solves a scene in two horizontal directions under one motion.
///
/// # Errors
/// [`Error::Invalid`] when histories do not fit into memory; [`Error::TooStiff`], [`Error::TooManyEvents`] and
/// [`Error::NotFinite`] when a run cannot go on.
pub fn simulate_plane(scene: &PlaneScene, motion: &PlaneMotion, options: &Options) -> Result<PlaneResponse> {
    simulate_plane_until(scene, motion, options, &AtomicBool::new(false))
}

/// Solves a scene in two horizontal directions under one motion, unless `stop` is set meanwhile.
///
/// # Errors
/// As [`simulate_plane`], and [`Error::Interrupted`].
pub fn simulate_plane_until(
    scene: &PlaneScene,
    motion: &PlaneMotion,
    options: &Options,
    stop: &AtomicBool,
) -> Result<PlaneResponse> {
    let ([x, y], [of_x, of_y]) = (scene.directions(), motion.directions());
    let systems = [System::new(x, of_x)?, System::new(y, of_y)?];
    let vertical = of_x.vertical().is_some() && !systems[0].blocks.is_empty();
    let state = PlaneState::new(scene, systems.each_ref(), vertical);
    let samples = of_x.acceleration().len();
    let recorder =
        |system: &System| options.histories.map(|every| Recorder::new(system, options, samples, every)).transpose();
    let mut run = Run {
        observer: PlaneObserver::new(&state),
        series: PlaneSeries::default(),
        rows: Default::default(),
        recorders: [recorder(&systems[0])?, recorder(&systems[1])?],
        balance: None,
        lost_at_stops: [0.0; 2],
        statistics: Statistics { substeps: 1, ..Statistics::default() },
        log: Vec::new(),
        keep_log: options.events,
        state,
    };
    let enter = |run: &mut Run, i: usize| {
        run.state.axes[0].interval = interval(of_x, of_x.vertical(), i);
        run.state.axes[1].interval = interval(of_y, of_y.vertical(), i);
    };
    enter(&mut run, 0);
    let mut status = GeneralStatus::Completed;
    if let Some((number, time)) = run.begin(options.energy)? {
        status = GeneralStatus::Collapsed { number, time };
    }
    for i in 0..samples - 1 {
        if status != GeneralStatus::Completed {
            break;
        }
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        enter(&mut run, i);
        if let Some((number, time)) = run.solve_interval(stop)? {
            status = GeneralStatus::Collapsed { number, time };
        }
    }
    let end_time = match status {
        GeneralStatus::Completed => {
            run.record(samples - 1, if samples > 1 { of_x.dt() } else { 0.0 });
            (samples - 1) as f64 * of_x.dt()
        }
        GeneralStatus::Collapsed { time, .. } => time,
    };
    if end_time == 0.0 {
        run.observer.take_accelerations(&run.state.accelerations(0.0), 0.0);
    }
    Ok(run.finish(status, end_time))
}

struct Run<'a> {
    state: PlaneState<'a>,
    series: PlaneSeries,
    /// Working space: rows by node, of each direction.
    rows: [[Vec<f64>; 2]; 3],
    observer: PlaneObserver,
    recorders: [Option<Recorder>; 2],
    balance: Option<PlaneBalance>,
    lost_at_stops: [f64; 2],
    statistics: Statistics,
    log: Vec<PlaneEvent>,
    keep_log: bool,
}

impl<'a> Run<'a> {
    /// Lets every node decide at t = 0.
    fn begin(&mut self, energy: bool) -> Result<Option<(usize, f64)>> {
        let interval = self.state.axes[0].interval;
        if self.state.axes[0].vertical
            && (interval.contact < 0.0 || interval.contact == 0.0 && interval.contact_change <= 0.0)
        {
            self.state.axes.iter_mut().for_each(|axis| axis.airborne = true);
            (0..self.state.slides.len()).for_each(|j| self.state.set(j, BlockState::Airborne));
        }
        self.state.follow();
        let mut collapsed = None;
        if !self.state.axes[0].airborne {
            let outcome = self.happening(0.0).decide_all();
            self.state.follow();
            collapsed = self.judge(outcome, 0.0)?;
        }
        self.note_events(0);
        self.observer.take_values(&self.state, 0.0);
        self.balance = energy.then(|| PlaneBalance::begin(&self.state));
        Ok(collapsed)
    }

    fn happening(&mut self, tau: f64) -> PlaneHappening<'a, '_> {
        PlaneHappening { state: &mut self.state, tau, log: &mut self.log, lost_at_stops: &mut self.lost_at_stops }
    }

    /// Solves the present interval; returns the spring that collapsed, and when.
    fn solve_interval(&mut self, stop: &AtomicBool) -> Result<Option<(usize, f64)>> {
        self.statistics.intervals += 1;
        let (sample, h) = (self.state.axes[0].interval.sample, self.state.axes[0].interval.h);
        let (mut events, mut steps, mut tau) = (0, 0, 0.0);
        let most = self.event_limit(h)?;
        let most_steps = STEPS_PER_INTERVAL + self.radians(h)? as usize;
        let mut is_recorded = false;
        while tau < h {
            let remaining = h - tau;
            self.radians(remaining)?;
            if let Some(block) = self.series.form(&self.state, tau, remaining, true) {
                let logged = self.log.len();
                self.happening(tau).graze(block);
                self.note_events(logged);
                events += 1;
                if events > most {
                    return Err(self.too_many("slip", Some(block), tau, most));
                }
                continue;
            }
            self.statistics.series_steps += 1;
            steps += 1;
            let (mut first, isolated) = PlaneSearch::first(&self.state, &self.series);
            self.statistics.guards_isolated += isolated;
            if first.is_some() && self.series.is_last_way() {
                // Something happens before the stop, where the closed form says nothing.
                self.series.form(&self.state, tau, remaining, false);
                first = PlaneSearch::first(&self.state, &self.series).0;
            }
            let place = first.map_or(1.0, |(place, _)| place);
            // A row at the time of an event is the state after it.
            if !is_recorded && place > 0.0 {
                self.record(sample, 0.0);
                is_recorded = true;
            }
            let step = self.series.h();
            tau = if place == 1.0 && step == remaining { h } else { (tau + place * step).min(h) };
            let stopping = self.advance(place, tau)?;
            let outcome = match first {
                Some((_, guard)) => {
                    events += 1;
                    self.carry_out(guard, tau)?
                }
                None => None,
            };
            if let Some(collapsed) = outcome {
                return Ok(Some(collapsed));
            }
            events += usize::from(self.stop_blocks(&stopping, tau)?);
            if place > 0.0 {
                self.renew_starts(tau)?;
            }
            if events > most {
                let (name, block) = first.map_or(("stick", stopping.first().copied()), |(_, guard)| name_of(guard));
                return Err(self.too_many(name, block, tau, most));
            }
            if steps > most_steps {
                let speed = |block: &usize| length(self.state.velocity(*block));
                let sliding = self.series.slides.iter().map(|slide| slide.block);
                let block = sliding.min_by(|one, other| speed(one).total_cmp(&speed(other)));
                return Err(self.too_many("step of sliding", block, tau, most_steps));
            }
            if stop.load(Ordering::Relaxed) {
                return Err(Error::Interrupted);
            }
        }
        Ok(None)
    }

    /// Advances to the place of the present series, which is at `tau`; returns the blocks that become slower there.
    fn advance(&mut self, place: f64, tau: f64) -> Result<Vec<usize>> {
        let (state, series) = (&mut self.state, &self.series);
        let start = state.axes[0].interval.start;
        let [accelerations, drifts, rates] = &mut self.rows;
        let at = |place: f64, rows: &mut [Vec<f64>; 2]| {
            for (series, row) in series.axes.iter().zip(rows) {
                series.values(Quantity::Acceleration, place, row);
            }
        };
        // An instant is no stretch of time: what it passes through has no peaks.
        let lasts = place > 0.0;
        if lasts {
            at(0.0, accelerations);
            self.observer.take_accelerations(accelerations, start + series.tau());
        }
        self.statistics.guards_isolated += self.observer.observe(state, series, place);
        if let Some(balance) = &mut self.balance {
            balance.add(state, series, place);
        }
        for (a, (axis, series)) in state.axes.iter_mut().zip(&series.axes).enumerate() {
            series.changes(Quantity::Drift, place, &mut drifts[a]);
            series.changes(Quantity::Rate, place, &mut rates[a]);
            for p in 1..drifts[a].len() {
                axis.x[p] += drifts[a][p];
                axis.v[p] += rates[a][p];
            }
        }
        let mut slowing = Vec::new();
        for position in 0..state.axes[0].moving.len() {
            let block = state.axes[0].moving[position];
            // Slides are in the order of the blocks that move.
            let slide = series.slides.iter().find(|slide| slide.position == position);
            let (path, rate) = slide.map_or((0.0, 0.0), |slide| series.path_and_rate(slide, place));
            if rate < 0.0 {
                slowing.push(block);
            }
            let [x, y] = [0, 1].map(|a: usize| series.axes[a].block_changes(position, place));
            if lasts {
                state.move_block(block, [x.0, y.0], [x.1, y.1], path);
            }
        }
        state.note_velocities();
        let time = start + tau;
        at(place, accelerations);
        if lasts {
            self.observer.take_accelerations(accelerations, time);
        }
        self.observer.take_values(state, time);
        let is_finite = accelerations.iter().flatten().all(|a| a.is_finite());
        if is_finite && (0..state.slides.len()).all(|j| length(state.slip(j)).is_finite()) {
            return Ok(slowing);
        }
        Err(Error::NotFinite { time, element: "the building".into() })
    }

    fn carry_out(&mut self, guard: PlaneGuard, tau: f64) -> Result<Option<(usize, f64)>> {
        let logged = self.log.len();
        let outcome = self.happening(tau).carry_out(guard);
        self.observer.take_values(&self.state, self.state.axes[0].interval.start + tau);
        self.note_events(logged);
        self.judge(outcome, tau)
    }

    /// Stops the blocks that come to rest: their relative velocity is below rounding and falls. Tells whether there are any.
    fn stop_blocks(&mut self, slowing: &[usize], tau: f64) -> Result<bool> {
        let slow = ARRIVED_ON_CIRCLE * self.state.fastest;
        let is_slow = |state: &PlaneState, j: usize, limit: f64| {
            state.slides(j) && !state.slides[j].is_young && length(state.velocity(j)) < limit
        };
        let mut stops = false;
        for node in 0..self.state.system().on_node.len() {
            let on_node = self.state.system().on_node[node].iter().copied().filter(|j| slowing.contains(j));
            let arriving: Vec<usize> = on_node.filter(|&j| is_slow(&self.state, j, STOP_TOGETHER * slow)).collect();
            if arriving.iter().any(|&j| is_slow(&self.state, j, slow)) {
                stops = true;
                if node > 0 {
                    let before = |j: usize| {
                        let slide = self.series.slides.iter().find(|slide| slide.block == j);
                        slide.and_then(|slide| slide.before_last_step()).unwrap_or(self.state.direction(j))
                    };
                    let arrived: Vec<_> = arriving.iter().map(|&j| (j, before(j))).collect();
                    if let Some(a) = self.state.acceleration_at_stop(node, &arrived, tau) {
                        self.observer.take_node(node, a, self.state.axes[0].interval.start + tau);
                    }
                }
                let logged = self.log.len();
                let outcome = self.happening(tau).arrive(node, &arriving);
                self.note_events(logged);
                self.judge(outcome, tau)?;
            }
        }
        Ok(stops)
    }

    /// Lets the nodes decide at which blocks have started that are at rest still.
    fn renew_starts(&mut self, tau: f64) -> Result<()> {
        if self.state.slides.iter().all(|slide| !slide.is_young) {
            return Ok(());
        }
        for node in 0..self.state.system().on_node.len() {
            if self.state.system().on_node[node].iter().any(|&j| self.state.slides[j].is_young) {
                let logged = self.log.len();
                let outcome = self.happening(tau).renew_starts(node);
                self.note_events(logged);
                self.judge(outcome, tau)?;
            }
        }
        Ok(())
    }

    fn judge(&self, outcome: Outcome, tau: f64) -> Result<Option<(usize, f64)>> {
        let time = self.state.axes[0].interval.start + tau;
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
        for (a, recorder) in self.recorders.iter_mut().enumerate() {
            if let Some(recorder) = recorder {
                let accelerations = || self.state.accelerations(tau)[a].clone();
                recorder.append(&self.state.axes[a], sample, accelerations);
            }
        }
    }

    /// Counts the events logged since entry `from`, and notes the velocities at which blocks came to stops.
    fn note_events(&mut self, from: usize) {
        for PlaneEvent { event, axis, .. } in &self.log[from..] {
            self.statistics.events.add(event.event.kind);
            if let (EventKind::TouchStop, Some(axis)) = (event.event.kind, axis) {
                let a = usize::from(*axis == Axis::Y);
                self.observer.take_contact_velocity(a, event.event.number - 1, event.velocity, event.event.time);
            }
        }
        if !self.keep_log {
            self.log.clear();
        }
    }

    /// Radians of the stiffest vibration of the present regimes in a time.
    fn radians(&self, time: f64) -> Result<f64> {
        let frequency = self.state.axes.iter().map(|axis| axis.regime.frequency).fold(0.0, f64::max);
        let phase = frequency * time;
        if phase <= REFUSED_PHASE {
            return Ok(phase);
        }
        Err(Error::TooStiff { time: self.state.axes[0].interval.start, phase, limit: REFUSED_PHASE })
    }

    fn event_limit(&self, h: f64) -> Result<usize> {
        let machines = 2 * self.state.system().nodes + self.state.slides.len();
        Ok(EVENTS_PER_INTERVAL + EVENTS_PER_MACHINE * machines * (1 + self.radians(h)? as usize))
    }

    #[cold]
    fn too_many(&self, event: &'static str, block: Option<usize>, tau: f64, limit: usize) -> Error {
        let (element, state) = match block {
            Some(j) => (format!("block {}", j + 1), self.state.axes[0].motions[j].state_name()),
            None => ("the building".into(), "in motion"),
        };
        let time = self.state.axes[0].interval.start + tau;
        Error::TooManyEvents { time, limit, event, element, state: state.to_string() }
    }

    fn finish(mut self, status: GeneralStatus, end_time: f64) -> PlaneResponse {
        let state = &self.state;
        let [x, y] = &state.axes;
        self.statistics.regimes = x.regimes.entered.0 + y.regimes.entered.0;
        self.statistics.regime_hits = x.regimes.entered.1 + y.regimes.entered.1;
        let laws = x.system.laws.iter().zip(&y.system.laws);
        let is_elastic = |law: &crate::machines::storey::StoreyLaw| !law.spring.law().can_yield();
        self.statistics.skipped.elastic_storeys = laws.filter(|(x, y)| is_elastic(x) && is_elastic(y)).count();
        let on_node = &state.system().on_node;
        self.statistics.skipped.bare_floors = on_node.iter().skip(1).filter(|blocks| blocks.is_empty()).count();
        let histories = match self.recorders.map(|recorder| recorder.map(Recorder::finish)) {
            [Some((x, _)), Some((y, _))] => Some([x, y]),
            _ => None,
        };
        PlaneResponse {
            storeys: x.system.storeys,
            levels: x.system.levels.clone(),
            status,
            end_time,
            residual_drift: (1..=x.system.nodes).map(|p| state.drift(p)).collect(),
            residual_slip: (0..state.slides.len()).map(|j| state.slip(j)).collect(),
            slip_path: state.slides.iter().map(|slide| slide.path).collect(),
            events: self.keep_log.then_some(self.log),
            histories,
            energy: self.balance.map(|balance| balance.finish(state, self.lost_at_stops)),
            peaks: self.observer.finish(),
            statistics: self.statistics,
        }
    }
}

/// What an event is called in an error, and the block that has it.
fn name_of(guard: PlaneGuard) -> (&'static str, Option<usize>) {
    match guard {
        PlaneGuard::Breakaway { block } => ("slip", Some(block)),
        PlaneGuard::Wear { block } => ("wear", Some(block)),
        PlaneGuard::Collapse { .. } | PlaneGuard::Along { guard: Guard::Collapse { .. }, .. } => ("collapse", None),
        PlaneGuard::Along { guard, .. } => match guard {
            Guard::Touch { block, .. } | Guard::TouchAgain { block } => ("touch of a stop", Some(block)),
            Guard::Leave { block } | Guard::Clear { block } => ("leave of a stop", Some(block)),
            Guard::Contact => ("lift or land", None),
            _ => ("event of a spring", None),
        },
    }
}
