//! What a run gives back, gathered stretch by stretch: peaks, slip paths, energies, histories.

use seismass::{Energy, Event, Peak, Peaks, Status};

use crate::model::{Model, Terms};
use crate::polynomial::{Polynomial, term};
use crate::real::Real;
use crate::series::Series;
use crate::state::{Contact, Drive, State};

/// The response of a scene, rounded to doubles. Index 0 is storey, floor or block 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// How the run ended.
    pub status: Status,
    /// Time reached (s): the last sample, or the collapse.
    pub end_time: f64,
    /// One row of the histories every so many samples, from sample 0.
    pub every: usize,
    /// Number of rows.
    pub rows: usize,
    /// Storey drift (m), rows x storeys; NaN after a collapse.
    pub drift: Vec<f64>,
    /// Slip (m), rows x blocks; NaN after a collapse.
    pub slip: Vec<f64>,
    /// Peaks in continuous time.
    pub peaks: Peaks,
    /// Drift of each storey at the end (m).
    pub residual_drift: Vec<f64>,
    /// Slip of each block at the end (m).
    pub residual_slip: Vec<f64>,
    /// Path slipped by each block, airborne motion included (m).
    pub slip_path: Vec<f64>,
    /// All events, in order.
    pub events: Vec<Event>,
    /// Energies at the end.
    pub energy: Energy,
    /// Condition of the energy balance against cancellation in the contact force: the most by which the work of
    /// friction along this motion changes if g and each a_v change by a fraction, over that fraction and the scale of
    /// the energy residual. Of the order of 1 where friction takes most of the energy and g and a_v do not cancel,
    /// large where they do.
    pub contact_condition: f64,
}

/// Work done since the start.
struct Work<R> {
    initial: R,
    input: R,
    largest_input: R,
    viscous: R,
    friction: R,
    /// The work of friction with g + |a_v| for g + a_v.
    friction_sizes: R,
}

pub(crate) struct Recorder<R> {
    peaks: Peaks,
    path: Vec<R>,
    work: Work<R>,
    every: usize,
    drift: Vec<f64>,
    slip: Vec<f64>,
}

fn take(peak: &mut Peak, value: f64, time: f64) {
    if value > peak.value {
        *peak = Peak { value, time };
    }
}

impl<R: Real> Recorder<R> {
    /// A record that begins with the values at t = 0.
    pub(crate) fn new(model: &Model<R>, state: &State<R>, drive: &Drive<R>, every: usize) -> Self {
        let peak = |value: R| Peak { value: value.abs().to_f64(), time: 0.0 };
        let acceleration = |i| peak(state.acceleration(model, i + 1, drive, R::zero(), Terms::Signed));
        let mut recorder = Self {
            peaks: Peaks {
                drift: state.drift.iter().map(|&d| peak(d)).collect(),
                slip: vec![Peak::default(); state.blocks.len()],
                floor_acceleration: (0..state.drift.len()).map(acceleration).collect(),
                storey_shear: state.storey_forces(Terms::Signed).into_iter().map(peak).collect(),
            },
            path: vec![R::zero(); state.blocks.len()],
            work: Work {
                initial: state.kinetic_energy(model) + state.elastic_energy(model),
                input: R::zero(),
                largest_input: R::zero(),
                viscous: R::zero(),
                friction: R::zero(),
                friction_sizes: R::zero(),
            },
            every,
            drift: Vec::new(),
            slip: Vec::new(),
        };
        recorder.sample(state, 0);
        recorder
    }

    /// Adds a row of the histories if the sample has one.
    pub(crate) fn sample(&mut self, state: &State<R>, sample: usize) {
        if sample.is_multiple_of(self.every) {
            self.drift.extend(state.drift.iter().map(|d| d.to_f64()));
            self.slip.extend(state.blocks.iter().map(|b| b.slip.to_f64()));
        }
    }

    /// Takes in a stretch that starts at `time` and at this state.
    pub(crate) fn stretch(&mut self, model: &Model<R>, state: &State<R>, series: &Series<R>, time: R) {
        let beat = |peak: &mut Peak, p: &Polynomial<R>| {
            if p.size().to_f64() > peak.value {
                let (value, place) = p.extreme();
                take(peak, value.to_f64(), (time + place * series.length).to_f64());
            }
        };
        for i in 0..model.storeys.len() {
            let linear = series.drift[i].scaled(state.springs[i].linear());
            let shear = series.force[i].iter().fold(linear, |sum, force| sum.plus(force));
            beat(&mut self.peaks.drift[i], &series.drift[i]);
            beat(&mut self.peaks.storey_shear[i], &shear);
            beat(&mut self.peaks.floor_acceleration[i], &series.acceleration[i + 1]);
        }
        let mut paths = vec![R::zero(); series.slip.len()];
        for (j, slip) in series.slip.iter().enumerate() {
            beat(&mut self.peaks.slip[j], slip);
            if state.blocks[j].contact != Contact::Stuck {
                paths[j] = series.length * series.velocity[j].absolute_integral();
                self.path[j] = self.path[j] + paths[j];
            }
        }
        self.add_work(model, state, series, &paths);
    }

    /// Integrals of the powers, exact for the polynomials; `paths` are those of the blocks on this stretch.
    fn add_work(&mut self, model: &Model<R>, state: &State<R>, series: &Series<R>, paths: &[R]) {
        let n = model.mass.len();
        let length = series.length;
        let orders = series.rate.iter().map(|r| r.0.len()).max().unwrap_or(0);
        let mut velocity = vec![Polynomial::constant(R::zero()); n];
        let mut damping = vec![Polynomial(Vec::new()); n];
        for order in 0..orders {
            let rate: Vec<R> = series.rate.iter().map(|r| term(r, order)).collect();
            for (i, force) in model.damping_forces(&rate, Terms::Signed).into_iter().enumerate() {
                damping[i].0.push(force);
            }
        }
        let work = &mut self.work;
        let mut momentum = Polynomial::constant(R::zero());
        for i in 0..n {
            velocity[i] = if i > 0 { velocity[i - 1].plus(&series.rate[i]) } else { series.rate[0].clone() };
            momentum = momentum.plus(&velocity[i].scaled(model.mass[i]));
            let floor = velocity[i].scaled(model.mass_damping_force(i, R::of(1.0))).times(&velocity[i]);
            let storey = damping[i].times(&series.rate[i]);
            work.viscous = work.viscous + length * floor.plus(&storey).integral();
        }
        for (j, data) in model.blocks.iter().enumerate() {
            let relative = &series.velocity[j];
            let floor = if data.floor > 0 { velocity[data.floor - 1].clone() } else { Polynomial::constant(R::zero()) };
            momentum = momentum.plus(&floor.plus(relative).scaled(data.mass));
            let block = &state.blocks[j];
            if let Contact::Sliding(sign) = block.contact {
                let force = series.contact.scaled(sign.times(block.mu_k * data.mass));
                work.friction = work.friction + length * force.times(relative).integral();
                let vertical = |contact: R| (contact - model.gravity).abs();
                let size = model.gravity + vertical(series.contact.start()).max(vertical(series.contact.end()));
                work.friction_sizes = work.friction_sizes + block.mu_k * data.mass * size * paths[j];
            }
        }
        work.input = work.input - length * momentum.times(&series.ground).integral();
        work.largest_input = work.largest_input.max(work.input.abs());
    }

    /// The solution, with the histories filled up to `samples`.
    pub(crate) fn finish(
        mut self,
        model: &Model<R>,
        state: &State<R>,
        status: Status,
        end_time: f64,
        samples: usize,
        events: Vec<Event>,
    ) -> Solution {
        let rows = (samples - 1) / self.every + 1;
        self.drift.resize(rows * state.drift.len(), f64::NAN);
        self.slip.resize(rows * state.blocks.len(), f64::NAN);
        let Work { initial, input, largest_input, viscous, friction, friction_sizes } = self.work;
        let hysteretic = state.springs.iter().fold(R::zero(), |sum, spring| sum + spring.dissipated());
        let (kinetic, elastic) = (state.kinetic_energy(model), state.elastic_energy(model));
        let residual = initial + input - kinetic - elastic - viscous - hysteretic - friction;
        let scale = initial.abs() + largest_input;
        let relative = |energy: R| if energy == R::zero() { energy } else { energy / scale };
        let relative_residual = relative(residual);
        Solution {
            status,
            end_time,
            every: self.every,
            rows,
            drift: self.drift,
            slip: self.slip,
            peaks: self.peaks,
            residual_drift: state.drift.iter().map(|d| d.to_f64()).collect(),
            residual_slip: state.blocks.iter().map(|b| b.slip.to_f64()).collect(),
            slip_path: self.path.iter().map(|p| p.to_f64()).collect(),
            events,
            energy: Energy {
                initial: initial.to_f64(),
                input: input.to_f64(),
                kinetic: kinetic.to_f64(),
                elastic: elastic.to_f64(),
                viscous: viscous.to_f64(),
                hysteretic: hysteretic.to_f64(),
                friction: friction.to_f64(),
                relative_residual: relative_residual.to_f64(),
            },
            contact_condition: relative(friction_sizes).to_f64(),
        }
    }
}
