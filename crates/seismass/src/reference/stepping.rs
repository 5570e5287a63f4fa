//! A run by equal steps of an implicit method, with states switched at the ends of steps or at located events.
//!
//! Location is of the kind usual in ODE codes: after a step with a fallen guard, the root of the guard along the step's
//! length is found, each trial being a step of the method itself (Hairer, Norsett & Wanner, Solving Ordinary
//! Differential Equations I, 1993, section II.6), so the order of the method is kept.

use nalgebra::DMatrix;

use super::guards::{carry_out, fallen, value};
use super::history::{History, check_finite};
use super::method::{Error, Events};
use super::roots::first_fall;
use super::scheme::{Columns, Scheme, StepMap, SteppedSystem};
use crate::events::carry_out::settle_all;
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::guard::{Guard, Outcome};
use crate::machines::model::Model;
use crate::regime::Row;
use crate::response::{Event, Status};
use crate::scene::{Motion, Scene};
use crate::state::State;
use crate::step::cache::RegimeCache;

/// Events one step may have for each storey and block.
const EVENTS_PER_MACHINE: usize = 64;

/// Integrates a scene.
pub(super) fn integrate(
    scheme: &impl Scheme,
    scene: &Scene,
    motion: &Motion,
    substeps: usize,
    events: Events,
) -> Result<History, Error> {
    let model = Model::new(scene);
    let mut cache = RegimeCache::new(motion.dt());
    let vertical = motion.vertical().is_some() && !scene.blocks().is_empty();
    let state = State::new(scene, &model, &mut cache, vertical);
    let samples = motion.acceleration().len();
    let (n, blocks) = (state.storeys(), scene.blocks().len());
    let mut run = SteppedRun {
        scheme,
        start: StageStart { x: vec![0.0; n], v: vec![0.0; n], q: vec![0.0; n], motions: Vec::with_capacity(blocks) },
        end_load: vec![0.0; n],
        change: vec![0.0; 2 * n],
        maps: Vec::new(),
        log: Vec::new(),
        history: History::new(samples, n, blocks),
        events,
        step: motion.dt() / substeps as f64,
        state,
    };
    run.begin(motion);
    for i in 0..samples - 1 {
        run.state.set_interval(motion, i);
        run.refresh(0.0);
        for k in 0..substeps {
            let tau = motion.dt() * k as f64 / substeps as f64;
            let end = motion.dt() * (k + 1) as f64 / substeps as f64;
            if let Some((storey, time)) = run.solve(tau, end)? {
                run.history.status = Status::Collapsed { storey: storey + 1, time };
                return Ok(run.history);
            }
        }
        run.record(i + 1)?;
    }
    Ok(run.history)
}

/// The state at the start of a step.
struct StageStart {
    x: Vec<f64>,
    v: Vec<f64>,
    q: Vec<f64>,
    motions: Vec<BlockMotion>,
}

struct SteppedRun<'a, S> {
    scheme: &'a S,
    state: State<'a>,
    start: StageStart,
    end_load: Vec<f64>,
    change: Vec<f64>,
    /// Maps of a whole step, by the regime's index.
    maps: Vec<Option<StepMap>>,
    log: Vec<Event>,
    history: History,
    events: Events,
    /// Length of a whole step (s).
    step: f64,
}

impl<S: Scheme> SteppedRun<'_, S> {
    /// Lets every floor decide at t = 0.
    fn begin(&mut self, motion: &Motion) {
        let state = &mut self.state;
        state.set_interval(motion, 0);
        let (contact, change) = (state.interval.contact, state.interval.contact_change);
        if state.vertical && (contact < 0.0 || contact == 0.0 && change <= 0.0) {
            state.blocks.airborne = true;
            state.blocks.motions.iter_mut().for_each(|m| m.state = BlockState::Airborne);
        }
        state.enter_regime();
        if !state.blocks.airborne {
            settle_all(state, 0.0, &mut self.log);
            state.enter_regime();
            self.history.events += self.log.len();
            self.log.clear();
        }
        self.refresh(0.0);
        self.observe();
        let state = &self.state;
        self.history.record(0, drifts(state), state.blocks.motions.iter().map(|m| m.slip));
    }

    fn record(&mut self, row: usize) -> Result<(), Error> {
        let state = &self.state;
        let slips = || state.blocks.motions.iter().map(|m| m.slip);
        check_finite(state.interval.start + state.interval.h, drifts(state), slips())?;
        self.history.record(row, drifts(state), slips());
        Ok(())
    }

    fn observe(&mut self) {
        let state = &self.state;
        self.history.observe(drifts(state), state.blocks.motions.iter().map(|m| m.slip));
    }

    /// Forms accelerations, and q for the step that starts at `tau`.
    fn refresh(&mut self, tau: f64) {
        self.state.refresh_accelerations(tau);
        load(&mut self.state, tau, &mut self.start.q);
    }

    /// One step from `tau` to `end`, events included; returns the storey that collapsed, and when.
    fn solve(&mut self, mut tau: f64, end: f64) -> Result<Option<(usize, f64)>, Error> {
        let machines = self.state.storeys() + self.state.blocks.motions.len();
        let limit = EVENTS_PER_MACHINE * (1 + machines);
        let mut whole = true;
        let mut count = 0;
        loop {
            self.save();
            self.advance(tau, end - tau, whole)?;
            let mut reached = end;
            let mut guard = fallen(&self.state, end, None);
            if let Events::Located { tolerance } = self.events {
                let width = tolerance * self.step;
                // The earliest root: those of the guards that have fallen at the root of the last one come before it.
                while let Some(latest) = guard {
                    let length = self.locate(latest, tau, reached - tau, width)?;
                    let gain = reached - tau - length;
                    reached = tau + length;
                    let earlier = fallen(&self.state, reached, guard);
                    if earlier.is_none() || gain <= width {
                        break;
                    }
                    guard = earlier;
                }
            }
            tau = reached;
            let switched = guard.is_some();
            self.observe();
            while let Some(event) = guard {
                count += 1;
                let time = self.state.interval.start + tau;
                if count > limit {
                    return Err(Error::TooManyEvents { time, limit });
                }
                let outcome = carry_out(&mut self.state, event, tau, self.events, &mut self.log);
                self.history.events += self.log.len();
                self.log.clear();
                if let Outcome::Collapse(storey) = outcome {
                    return Ok(Some((storey, time)));
                }
                guard = fallen(&self.state, tau, None);
            }
            if switched {
                load(&mut self.state, tau, &mut self.start.q);
            } else {
                std::mem::swap(&mut self.start.q, &mut self.end_load);
            }
            if tau >= end {
                return Ok(None);
            }
            whole = false;
        }
    }

    fn save(&mut self) {
        let n = self.start.x.len();
        self.start.x.copy_from_slice(&self.state.kinematics.x[..n]);
        self.start.v.copy_from_slice(&self.state.kinematics.v[..n]);
        self.start.motions.clone_from(&self.state.blocks.motions);
    }

    /// Takes the state from the start at `tau` over a step of length `h`.
    fn advance(&mut self, tau: f64, h: f64, whole: bool) -> Result<(), Error> {
        self.history.steps += 1;
        load(&mut self.state, tau + h, &mut self.end_load);
        let n = self.start.x.len();
        // Blocks may be on the ground alone.
        if n > 0 {
            self.form_change(tau, h, whole)?;
        }
        let (dx, dv) = self.change.split_at(n);
        for i in 0..n {
            self.state.kinematics.x[i] = self.start.x[i] + dx[i];
            self.state.kinematics.v[i] = self.start.v[i] + dv[i];
        }
        self.advance_blocks(tau, h);
        let state = &mut self.state;
        state.regime.accelerations(
            state.model,
            &state.kinematics.x,
            &state.kinematics.v,
            &state.step.drive.load,
            &mut state.kinematics.a[..n],
        );
        Ok(())
    }

    /// Forms the changes of drifts and drift rates over a step of length `h` from the start at `tau`.
    fn form_change(&mut self, tau: f64, h: f64, whole: bool) -> Result<(), Error> {
        let time = self.state.interval.start + tau;
        let singular = || Error::SingularStep { time };
        let start = &self.start;
        if whole {
            let index = self.state.key.entry;
            if self.maps.len() <= index {
                self.maps.resize_with(index + 1, || None);
            }
            let regime = &self.state.regime;
            if !self.maps[index].as_ref().is_some_and(|map| map.belongs_to(regime)) {
                let system = SteppedSystem::new(&self.state);
                self.maps[index] = Some(StepMap::new(self.scheme, &system, regime, self.step).ok_or_else(singular)?);
            }
            if let Some(map) = &self.maps[index] {
                map.apply(&start.x, &start.v, &start.q, &self.end_load, &mut self.change);
            }
        } else {
            let column = |values: &[f64]| DMatrix::from_column_slice(values.len(), 1, values);
            let state = DMatrix::from_iterator(2 * start.x.len(), 1, start.x.iter().chain(&start.v).copied());
            let columns = Columns { state, start: column(&start.q), end: column(&self.end_load) };
            let change = self.scheme.change(&SteppedSystem::new(&self.state), h, &columns).ok_or_else(singular)?;
            self.change.copy_from_slice(change.as_slice());
        }
        Ok(())
    }

    fn advance_blocks(&mut self, tau: f64, h: f64) {
        let state = &mut self.state;
        let [first, second] = self.scheme.displacement_weights();
        let (dx, dv) = self.change.split_at(self.start.x.len());
        let ground = [state.interval.ground_at(tau), state.interval.ground_at(tau + h)];
        let contact = [state.contact_at(tau), state.contact_at(tau + h)];
        for (j, law) in state.model.blocks.iter().enumerate() {
            let before = self.start.motions[j];
            if before.is_stuck() {
                continue;
            }
            let friction = before.sliding().map_or(0.0, |sign| sign.factor() * before.mu_k);
            let [b0, b1] = [0, 1].map(|e| -friction * contact[e] - ground[e]);
            let sum = |values: &[f64]| values[..law.floor].iter().sum::<f64>();
            let velocity = before.velocity + sum(&self.start.v);
            let motion = &mut state.blocks.motions[j];
            motion.velocity = before.velocity + 0.5 * h * (b0 + b1) - sum(dv);
            motion.slip = before.slip + h * velocity + h * h * (first * b0 + second * b1) - sum(dx);
        }
    }

    /// The length of the step from `tau` at which a guard that has fallen at length `h` falls; the state is left there,
    /// on the fallen side.
    fn locate(&mut self, guard: Guard, tau: f64, h: f64, width: f64) -> Result<f64, Error> {
        let at_end = value(&self.state, guard, tau + h);
        let length = first_fall(h, at_end, width, |length| {
            self.advance(tau, length, false)?;
            Ok(value(&self.state, guard, tau + length))
        })?;
        self.advance(tau, length, false)?;
        Ok(length)
    }
}

fn drifts<'s>(state: &'s State) -> impl ExactSizeIterator<Item = f64> + 's {
    state.springs.machines.iter().zip(&state.kinematics.x).map(|(spring, &x)| spring.drift(x))
}

/// q at `tau`: drift accelerations by the loads and the ground alone.
fn load(state: &mut State, tau: f64, q: &mut [f64]) {
    state.set_drive(tau);
    let mut below = state.step.drive.ground;
    let regime = &state.regime;
    for i in 0..q.len() {
        let a = state.step.drive.load[i] * regime.row(Row::InverseMass)[i];
        q[i] = a - below;
        below = a;
    }
}
