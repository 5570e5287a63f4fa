//! What is kept of a run: peaks in continuous time, histories, energies.

use std::num::NonZeroUsize;

use crate::error::Result;
use crate::lanes::{Plain, Set, Vector, WIDTH, at, by_width, for_each_path, load, members};
use crate::machines::block::BlockState;
use crate::machines::model::Model;
use crate::polynomial::enclosure::signs;
use crate::polynomial::power::Polynomial;
use crate::polynomial::quadrature::GAUSS;
use crate::record::energy::{EnergyBalance, elastic_energy, kinetic_energy};
use crate::record::forces::FloorForces;
use crate::record::histories::Recorder;
use crate::record::peaks::PeakLanes;
use crate::regime::{Row, viscous_power};
use crate::response::{Energy, Peak, Peaks};
use crate::scene::Options;
use crate::state::State;
use crate::state::relative::{slip_change, velocity_of_block};

/// Keeps peaks, histories and energies.
pub(crate) struct Observer {
    pub(crate) drift: PeakLanes,
    pub(crate) shear: PeakLanes,
    pub(crate) acceleration: PeakLanes,
    pub(crate) forces: Option<FloorForces>,
    slip: Vec<Peak>,
    pub(crate) histories: Option<Recorder>,
    energy: Option<EnergyBalance>,
    /// Whether peaks of drift, shear or acceleration were beaten since last asked.
    beaten: bool,
}

for_each_path! {
    /// See [`Observer::observe_building`].
    fn take_building[K: usize](observer: &mut Observer, state: &State, time: f64) = building_by_path
}

#[inline(always)]
fn building_by_path<V: Vector, const K: usize>(observer: &mut Observer, state: &State, time: f64) {
    observer.take_building_in_lanes::<V, K>(state, time);
}

impl Observer {
    /// An observer of a run over so many samples, of which every `substeps`-th is one of the caller's.
    ///
    /// # Errors
    /// As [`Recorder::new`].
    pub(crate) fn new(model: &Model, options: &Options, samples: usize, substeps: usize) -> Result<Self> {
        let (n, blocks) = (model.storeys(), model.blocks.len());
        let recorder = |every: NonZeroUsize| Recorder::new(model, options, samples, every.get(), substeps);
        let histories = options.histories.map(recorder).transpose()?;
        Ok(Self {
            drift: PeakLanes::new(n),
            shear: PeakLanes::new(n),
            acceleration: PeakLanes::new(n),
            forces: options.floor_force.then(|| FloorForces::new(n)),
            slip: vec![Default::default(); blocks],
            histories,
            energy: options.energy.then(EnergyBalance::default),
            beaten: true,
        })
    }

    /// The peaks so far, of so many storeys.
    pub(crate) fn peaks(&self, storeys: usize) -> Peaks {
        let [drift, floor_acceleration, storey_shear] =
            [&self.drift, &self.acceleration, &self.shear].map(|peaks| peaks.peaks(storeys));
        Peaks { drift, slip: self.slip.clone(), floor_acceleration, storey_shear }
    }

    /// Sizes of the peaks of drift, shear and floor acceleration.
    #[inline(always)]
    pub(crate) fn peak_sizes<V: Vector, const K: usize>(&self) -> [[V; K]; 3] {
        [load(&self.drift.size), load(&self.shear.size), load(&self.acceleration.size)]
    }

    /// Whether energies are kept: then every step needs its series too.
    pub(crate) fn keeps_energy(&self) -> bool {
        self.energy.is_some()
    }

    /// Whether a drift coordinate between `low` and `high` could beat a peak of storey `i`.
    #[inline]
    pub(crate) fn drift_may_peak(&self, state: &State, i: usize, low: f64, high: f64) -> bool {
        let [[drift_low, shear_low], [drift_high, shear_high]] = [low, high].map(|x| drift_and_shear(state, i, x));
        drift_low.abs().max(drift_high.abs()) > self.drift.size[i]
            || shear_low.abs().max(shear_high.abs()) > self.shear.size[i]
    }

    /// Whether an acceleration between `low` and `high` could beat the peak of floor `i`.
    #[inline]
    pub(crate) fn acceleration_may_peak(&self, i: usize, low: f64, high: f64) -> bool {
        low.abs().max(high.abs()) > self.acceleration.size[i]
    }

    /// Takes drift and shear at a drift coordinate of storey `i` into their peaks.
    #[inline]
    pub(crate) fn take_drift(&mut self, state: &State, i: usize, x: f64, time: f64) {
        let [drift, shear] = drift_and_shear(state, i, x);
        self.beaten |= self.drift.take(i, drift, time) | self.shear.take(i, shear, time);
    }

    /// Takes the acceleration of floor `i` into its peak.
    #[inline]
    pub(crate) fn take_acceleration(&mut self, state: &State, i: usize, a: f64, time: f64) {
        self.beaten |= self.acceleration.take(i, a, time);
        if let Some(forces) = &mut self.forces {
            self.beaten |= forces.take_acceleration(state, i, a, time);
        }
    }

    /// Whether peaks of drift, shear or acceleration were beaten since last asked.
    #[inline]
    pub(crate) fn take_beaten(&mut self) -> bool {
        std::mem::take(&mut self.beaten)
    }

    /// Takes the present values into the peaks.
    pub(crate) fn observe_values(&mut self, state: &State, time: f64) {
        self.observe_building(state, time);
        self.observe_slips(state, time);
    }

    /// Takes the present drifts and floor accelerations into the peaks.
    pub(crate) fn observe_building(&mut self, state: &State, time: f64) {
        by_width!(state.model.width, K => take_building::<K>(self, state, time));
    }

    /// Takes the present slips of the blocks that do not stick into their peaks.
    #[inline]
    pub(crate) fn observe_slips(&mut self, state: &State, time: f64) {
        for &j in &state.blocks.moving {
            self.slip[j].take(state.blocks.motions[j].slip, time);
        }
    }

    /// Takes the present floor accelerations into their peaks.
    #[inline(always)]
    pub(crate) fn take_accelerations_in_lanes<V: Vector, const K: usize>(&mut self, state: &State, time: f64) {
        let mut beaten = 0;
        for k in 0..state.vectors::<K>() {
            beaten |= self.acceleration.take_vector::<V, K>(k, state.kinematics.a.vector::<V, K>(k), time);
        }
        self.beaten |= beaten != 0;
    }

    /// Takes the present floor forces, `tau` into the interval, after which bounds are to be formed anew.
    #[inline(always)]
    pub(crate) fn take_forces(&mut self, state: &mut State, tau: f64) {
        if let Some(forces) = &mut self.forces {
            forces.take(state, tau);
            state.bounds.spoil();
        }
    }

    /// [`Observer::observe_building`] within the code of a path.
    #[inline(always)]
    pub(crate) fn take_building_in_lanes<V: Vector, const K: usize>(&mut self, state: &State, time: f64) {
        let tangents = state.regime.row(Row::SpringTangent);
        let mut beaten = 0;
        for k in 0..state.vectors::<K>() {
            let (x, tangent): (V, V) = (state.kinematics.x.vector::<V, K>(k), at(tangents, k));
            beaten |= self.drift.take_vector::<V, K>(k, state.springs.base_drift.vector::<V, K>(k).add(x), time);
            let shear = state.springs.base_force.vector::<V, K>(k).add(tangent.mul(x));
            beaten |= self.shear.take_vector::<V, K>(k, shear, time);
        }
        self.beaten |= beaten != 0;
        self.take_accelerations_in_lanes::<V, K>(state, time);
    }

    /// Takes the extremes inside the present series, whose ranges are formed, from `tau` to its place `end`, before the
    /// state is advanced.
    #[inline(always)]
    pub(crate) fn observe_series<V: Vector, const K: usize>(
        &mut self,
        state: &State,
        tau: f64,
        end: f64,
        isolated: &mut usize,
    ) {
        let start = state.interval.start + tau;
        let [drifts, _, accelerations] = state.step.ranges.near_bound;
        if drifts | accelerations == 0 {
            return;
        }
        for k in 0..state.vectors::<K>() {
            let near_bound = state.step.ranges.near_bound_in::<K>(0, k);
            if near_bound != 0 {
                // A plastic storey's rate is a guard: it does not turn before an event.
                let (forward, backward) = signs(state.step.ranges.rates::<V, K>(k));
                let steady = forward | backward | state.bounds.plastic_in::<V, K>(k);
                for lane in members(near_bound & !Set::from(steady)) {
                    let i = WIDTH * k + lane;
                    let (low, high) = state.step.ranges.drift::<K>(i);
                    if self.drift_may_peak(state, i, low, high) {
                        *isolated += 1;
                        self.take_turns_of_drift::<V, K>(state, i, start, end);
                    }
                }
            }
            let near_bound = state.step.ranges.near_bound_in::<K>(2, k);
            if near_bound != 0 {
                for lane in members(near_bound & !Set::from(state.steady::<V, K>(k))) {
                    let i = WIDTH * k + lane;
                    let (low, high) = state.step.ranges.acceleration::<K>(i);
                    if self.acceleration_may_peak(i, low, high) {
                        *isolated += 1;
                        self.take_turns_of_acceleration::<V, K>(state, i, start, end);
                    }
                }
            }
        }
    }

    /// Takes the turns of a storey's drift inside the present series, which starts at the time `start`, up to its place
    /// `end` into its peaks.
    #[inline(always)]
    fn take_turns_of_drift<V: Vector, const K: usize>(&mut self, state: &State, i: usize, start: f64, end: f64) {
        let mut rate = state.step.series.zeros();
        state.step.series.drift_rate::<V, K>(i, 1.0, &mut rate);
        let (first, others) = rate.sign_changes::<V>();
        for s in first.into_iter().chain(others).filter(|&s| s < end) {
            let mut drift = state.step.series.zeros();
            state.step.series.drift::<V, K>(i, 1.0, 0.0, &mut drift);
            let [drift, shear] = drift_and_shear(state, i, drift.at::<V>(s));
            let time = start + s * state.step.series.h();
            self.beaten |= self.drift.take_lane::<V, K>(i, drift, time) | self.shear.take_lane::<V, K>(i, shear, time);
        }
    }

    /// The same of a floor's acceleration.
    #[inline(always)]
    fn take_turns_of_acceleration<V: Vector, const K: usize>(&mut self, state: &State, i: usize, start: f64, end: f64) {
        let mut acceleration = state.step.series.zeros();
        state.step.series.acceleration::<V, K>(i + 1, 1.0, [0.0; 2], &mut acceleration);
        let (first, others) = acceleration.derivative().sign_changes::<V>();
        for s in first.into_iter().chain(others).filter(|&s| s < end) {
            let time = start + s * state.step.series.h();
            let a = acceleration.at::<V>(s);
            self.beaten |= self.acceleration.take_lane::<V, K>(i, a, time);
            if let Some(forces) = &mut self.forces {
                self.beaten |= forces.take_acceleration(state, i, a, time);
            }
        }
    }

    /// Takes the turns of the drifts of some storeys and of the accelerations of some floors inside the present series, of
    /// a whole interval.
    #[inline(always)]
    pub(crate) fn take_turns<V: Vector, const K: usize>(&mut self, state: &State, [drifts, accelerations]: [Set; 2]) {
        for i in members(drifts) {
            self.take_turns_of_drift::<V, K>(state, i, state.interval.start, 1.0);
        }
        for i in members(accelerations) {
            self.take_turns_of_acceleration::<V, K>(state, i, state.interval.start, 1.0);
        }
    }

    /// Takes the turns of airborne blocks inside the present series, from `tau` to its place `end`, before the state is
    /// advanced.
    pub(crate) fn observe_flights(&mut self, state: &mut State, tau: f64, end: f64) {
        let (start, h) = (state.interval.start + tau, state.step.series.h());
        for j in 0..state.blocks.motions.len() {
            let velocity = velocity_of_block(state, j);
            let slip = slip_change(state, j);
            let at_start = state.blocks.motions[j].slip;
            let (peak, motion) = (&mut self.slip[j], &mut state.blocks.motions[j]);
            // A turn at the very end of one series is none inside the next.
            motion.end_stretch();
            let (first, others) = velocity.sign_changes::<Plain>();
            for s in first.into_iter().chain(others).filter(|&s| s < end) {
                let value = at_start + slip.at::<Plain>(s);
                peak.take(value, start + s * h);
                motion.turn_at(value);
            }
        }
    }

    /// Appends the present state to the histories, if they have a row at a sample.
    #[inline]
    pub(crate) fn record(&mut self, state: &State, sample: usize) {
        if let Some(recorder) = &mut self.histories {
            recorder.append_state(state, sample);
        }
    }

    /// [`Observer::record`] within the code of a path.
    #[inline(always)]
    pub(crate) fn record_in_lanes<V: Vector, const K: usize>(&mut self, state: &State, sample: usize) {
        if let Some(recorder) = &mut self.histories {
            recorder.append_state_in_lanes::<V, K>(state, sample);
        }
    }

    /// Writes the row of a sample, if the histories have one, again: an event fell at its very time.
    pub(crate) fn record_again(&mut self, state: &State, sample: usize) {
        if self.histories.as_mut().is_some_and(|recorder| recorder.take_back(sample)) {
            self.record(state, sample);
        }
    }

    /// What writes the histories, if they have a row at a sample, all rows before it being written.
    #[inline]
    pub(crate) fn recorder_at(&mut self, sample: usize) -> Option<&mut Recorder> {
        self.histories.as_mut().filter(|recorder| recorder.next_sample() == sample)
    }

    /// Notes the energy at the start.
    pub(crate) fn begin_energy(&mut self, state: &State) {
        if let Some(balance) = &mut self.energy {
            balance.energy.initial = kinetic_energy(state) + elastic_energy(state);
        }
    }

    /// Adds the energies of the present series, from `tau` to its place `end`, before the state is advanced.
    pub(crate) fn add_energy(&mut self, state: &State, tau: f64, end: f64) {
        let Some(balance) = &mut self.energy else { return };
        let n = state.storeys();
        let length = state.step.series.h() * end;
        let (mut rates, mut scratch) = (vec![0.0; n], vec![0.0; n]);
        let velocities: Vec<Option<Polynomial>> = (0..state.blocks.motions.len())
            .map(|j| (!state.blocks.motions[j].is_stuck()).then(|| velocity_of_block(state, j)))
            .collect();
        for (node, weight) in GAUSS {
            let s = node * end;
            let at = tau + s * state.step.series.h();
            state.step.series.rates_at(s, &mut rates);
            let energy = &mut balance.energy;
            energy.viscous += weight * length * viscous_power(state.model, &rates, &mut scratch);
            let mut velocity = 0.0;
            for i in 0..n {
                velocity += rates[i];
                scratch[i] = velocity;
            }
            let mut momentum: f64 = state.model.mass.iter().zip(&scratch).map(|(m, v)| m * v).sum();
            for (j, law) in state.model.blocks.iter().enumerate() {
                let relative = velocities[j].as_ref().map_or(0.0, |p| p.at::<Plain>(s));
                let floor = if law.floor > 0 { scratch[law.floor - 1] } else { 0.0 };
                momentum += law.mass * (floor + relative);
                if let BlockState::Sliding(sign) = state.blocks.motions[j].state {
                    let force = sign.factor() * state.blocks.motions[j].mu_k * law.mass * state.contact_at(at);
                    energy.friction += weight * length * force * relative;
                }
            }
            energy.input -= weight * length * momentum * state.interval.ground_at(at);
        }
        for ((spring, change), x) in
            state.springs.machines.iter().zip(state.step.series.changes()[0]).zip(&state.kinematics.x)
        {
            balance.energy.hysteretic += spring.dissipated(*x, *change);
        }
        balance.largest_input = balance.largest_input.max(balance.energy.input);
    }

    /// The energies at the end, with their residual.
    pub(crate) fn finish_energy(&self, state: &State) -> Option<Energy> {
        let balance = self.energy.as_ref()?;
        let mut energy = balance.energy;
        energy.kinetic = kinetic_energy(state);
        energy.elastic = elastic_energy(state);
        let spent = energy.kinetic + energy.elastic + energy.viscous + energy.hysteretic + energy.friction;
        let scale = energy.initial + balance.largest_input;
        let residual = energy.initial + energy.input - spent;
        energy.relative_residual = if residual == 0.0 { 0.0 } else { residual / scale };
        Some(energy)
    }
}

/// Drift and shear of storey `i` at a drift coordinate.
#[inline(always)]
fn drift_and_shear(state: &State, i: usize, x: f64) -> [f64; 2] {
    [state.springs.machines[i].drift(x), state.springs.base_force[i] + state.regime.row(Row::SpringTangent)[i] * x]
}
