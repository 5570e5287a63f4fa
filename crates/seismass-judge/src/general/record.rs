//! What a run gives back, gathered stretch by stretch: peaks, slip paths, energies, histories.

use seismass::{EventKind, GeneralBase, GeneralEnergy, GeneralEvent, GeneralPeaks, GeneralStatus, Peak};

use super::model::Model;
use super::series::Series;
use super::state::{State, Stopped};
use crate::model::Terms;
use crate::polynomial::{Polynomial, term};
use crate::real::Real;
use crate::state::{BlockState, Contact};

/// The response of a scene with racks, walls and stops, rounded to doubles. Storeys, then levels of racks; goods on floors,
/// then those of racks.
#[derive(Debug, Clone, PartialEq)]
pub struct GeneralSolution {
    /// How the run ended.
    pub status: GeneralStatus,
    /// Time reached (s): the last sample, or the collapse.
    pub end_time: f64,
    /// One row of the histories every so many samples, from sample 0.
    pub every: usize,
    /// Drift (m), rows x nodes; NaN after a collapse.
    pub drift: Vec<f64>,
    /// Slip (m), rows x goods; NaN after a collapse.
    pub slip: Vec<f64>,
    /// Peaks in continuous time.
    pub peaks: GeneralPeaks,
    /// Drift of each spring at the end (m).
    pub residual_drift: Vec<f64>,
    /// Slip of each block at the end (m).
    pub residual_slip: Vec<f64>,
    /// Path slipped by each block in contact with its node (m).
    pub slip_path: Vec<f64>,
    /// Of a sliding base.
    pub base: Option<GeneralBase>,
    /// All events, in order.
    pub events: Vec<GeneralEvent>,
    /// Energies at the end.
    pub energy: GeneralEnergy,
}

/// Work done since the start.
struct Work<R> {
    initial: R,
    input: R,
    largest_input: R,
    viscous: R,
    friction: R,
    stops: R,
}

pub(super) struct Recorder<R> {
    peaks: GeneralPeaks,
    path: Vec<R>,
    work: Work<R>,
    every: usize,
    drift: Vec<f64>,
    slip: Vec<f64>,
    base: GeneralBase,
    base_path: R,
}

fn beat<R: Real>(peak: &mut Peak, p: &Polynomial<R>, time: R, length: R) {
    if p.size().to_f64() > peak.value {
        let (value, place) = p.extreme();
        if value.to_f64() > peak.value {
            *peak = Peak { value: value.to_f64(), time: (time + place * length).to_f64() };
        }
    }
}

impl<R: Real> Recorder<R> {
    /// A record that begins with the values at t = 0, of which those are the nodes' accelerations.
    pub(super) fn new(model: &Model<R>, state: &State<R>, acceleration: Vec<R>, every: usize) -> Self {
        let peak = |value: R| Peak { value: value.abs().to_f64(), time: 0.0 };
        let m = model.goods.len();
        let forces = state.spring_forces(Terms::Signed);
        let displacement = model.displacements(&state.drift, Terms::Signed);
        let of_matrix = model.matrix_forces(&displacement, Terms::Signed);
        let on_ground = if model.has_building { forces[0] } else { R::zero() };
        let base = of_matrix.into_iter().fold(on_ground, |sum, force| sum + force);
        let zero = R::zero();
        let initial = state.kinetic_energy(model) + state.elastic_energy(model);
        let mut recorder = Self {
            peaks: GeneralPeaks {
                drift: state.drift.iter().map(|&d| peak(d)).collect(),
                acceleration: acceleration.into_iter().map(peak).collect(),
                shear: forces.into_iter().map(peak).collect(),
                base_shear: peak(base),
                slip: vec![Peak::default(); m],
                contact_force: vec![Peak::default(); m],
                contact_velocity: vec![Peak::default(); m],
            },
            path: vec![zero; m],
            work: Work { initial, input: zero, largest_input: zero, viscous: zero, friction: zero, stops: zero },
            every,
            drift: Vec::new(),
            slip: Vec::new(),
            base: GeneralBase::default(),
            base_path: zero,
        };
        recorder.sample(state, 0);
        recorder
    }

    /// Takes in the acceleration of the slab at t = 0.
    pub(super) fn begin_base(&mut self, acceleration: R) {
        self.base.acceleration.value = acceleration.abs().to_f64();
    }

    /// Adds a row of the histories if the sample has one.
    pub(super) fn sample(&mut self, state: &State<R>, sample: usize) {
        if sample.is_multiple_of(self.every) {
            self.drift.extend(state.drift.iter().map(|d| d.to_f64()));
            self.slip.extend(state.blocks.iter().map(|b| b.slip.to_f64()));
            self.base.history.extend(state.base.iter().map(|b| b.slip.to_f64()));
        }
    }

    /// Takes in the acceleration of a node at an instant.
    pub(super) fn acceleration(&mut self, node: usize, value: R, time: R) {
        let (value, peak) = (value.abs().to_f64(), &mut self.peaks.acceleration[node]);
        if value > peak.value {
            *peak = Peak { value, time: time.to_f64() };
        }
    }

    /// Takes in a stretch that starts at `time` and at this state.
    pub(super) fn stretch(&mut self, model: &Model<R>, state: &State<R>, series: &Series<R>, time: R) {
        let take = |peak: &mut Peak, p: &Polynomial<R>| beat(peak, p, time, series.length);
        let peaks = &mut self.peaks;
        let shears = shears(model, state, series);
        for (p, shear) in shears.iter().enumerate() {
            take(&mut peaks.drift[p], &series.drift[p]);
            take(&mut peaks.shear[p], shear);
            take(&mut peaks.acceleration[p], &series.acceleration[p + 1]);
        }
        if let Some(base) = base_shear(model, series, &shears) {
            take(&mut peaks.base_shear, &base);
        }
        for (j, slip) in series.slip.iter().enumerate() {
            take(&mut peaks.slip[j], slip);
            if matches!(state.stopped[j], Stopped::Pressing(_)) {
                take(&mut peaks.contact_force[j], &series.push[j]);
            }
            if let Contact::Sliding(_) = state.blocks[j].contact {
                self.path[j] = self.path[j] + series.length * series.velocity[j].absolute_integral();
            }
        }
        if let Some(base) = &series.base {
            take(&mut self.base.slip, &base.slip);
            take(&mut self.base.acceleration, &series.acceleration[0]);
            if let Some(BlockState { contact: Contact::Sliding(_), .. }) = state.base {
                self.base_path = self.base_path + series.length * base.velocity.absolute_integral();
            }
        }
        self.add_work(model, state, series);
    }

    /// Integrals of the powers, exact for the polynomials.
    fn add_work(&mut self, model: &Model<R>, state: &State<R>, series: &Series<R>) {
        let n = model.mass.len();
        let length = series.length;
        let orders = series.rate.iter().map(|r| r.0.len()).max().unwrap_or(0);
        let mut damping = vec![Polynomial(Vec::new()); n];
        for order in 0..orders {
            let rate: Vec<R> = series.rate.iter().map(|r| term(r, order)).collect();
            for (p, force) in model.damping_forces(&rate, Terms::Signed).into_iter().enumerate() {
                damping[p].0.push(force);
            }
        }
        let work = &mut self.work;
        let zero = Polynomial::constant(R::zero());
        let below = series.base.as_ref().map_or(&zero, |base| &base.velocity);
        let mut momentum = below.scaled(model.base.as_ref().map_or(R::zero(), |base| base.mass));
        if let (Some(data), Some(base), Some(own)) = (&model.base, &state.base, &series.base) {
            // By the slope of a pendulum the vertical motion, or in flight nothing, does the work of a_v or of -g.
            let in_contact = base.contact != Contact::Airborne;
            let contact = if in_contact { series.contact.clone() } else { zero.clone() };
            let along = own.slip.times(&own.velocity).scaled(length * data.restoring);
            let vertical = contact.plus(&Polynomial::constant(-model.gravity));
            work.input = work.input - along.times(&vertical).integral();
            if let Contact::Sliding(sign) = base.contact {
                let friction = contact.scaled(sign.times(length * base.mu_k * data.carried));
                work.friction = work.friction + friction.times(&own.velocity).integral();
            }
        }
        let mut velocity: Vec<Polynomial<R>> = Vec::with_capacity(n);
        for p in 0..n {
            let own = &series.rate[p];
            velocity.push(model.parent[p].map_or(below, |parent| &velocity[parent]).plus(own));
            momentum = momentum.plus(&velocity[p].scaled(model.mass[p]));
            work.viscous = work.viscous + length * damping[p].times(own).integral();
        }
        for (j, data) in model.goods.iter().enumerate() {
            let relative = &series.velocity[j];
            let node = data.node.map_or(below, |node| &velocity[node]);
            momentum = momentum.plus(&node.plus(relative).scaled(data.mass));
            if let Contact::Sliding(_) = state.blocks[j].contact {
                work.friction = work.friction + length * series.friction[j].times(relative).integral();
            }
            if let (Stopped::Pressing(_), Some(stops)) = (state.stopped[j], &data.stops) {
                work.stops = work.stops + length * stops.damping * relative.times(relative).integral();
            }
        }
        work.input = work.input - length * momentum.times(&series.ground).integral();
        work.largest_input = work.largest_input.max(work.input.abs());
    }

    /// The solution, with the histories filled up to `samples`; `parted` is what stops have lost where they parted.
    pub(super) fn finish(
        mut self,
        model: &Model<R>,
        state: &State<R>,
        (status, end_time): (GeneralStatus, f64),
        samples: usize,
        events: Vec<GeneralEvent>,
        parted: R,
    ) -> GeneralSolution {
        let rows = (samples - 1) / self.every + 1;
        self.drift.resize(rows * state.drift.len(), f64::NAN);
        self.slip.resize(rows * state.blocks.len(), f64::NAN);
        self.base.history.resize(rows * usize::from(state.base.is_some()), f64::NAN);
        self.base.residual_slip = state.base.map_or(0.0, |base| base.slip.to_f64());
        self.base.slip_path = self.base_path.to_f64();
        for entry in events.iter().filter(|entry| entry.event.kind == EventKind::TouchStop) {
            let (peak, value) = (&mut self.peaks.contact_velocity[entry.event.number - 1], entry.velocity.abs());
            if value > peak.value {
                *peak = Peak { value, time: entry.event.time };
            }
        }
        let Work { initial, input, largest_input, viscous, friction, stops } = self.work;
        let hysteretic = state.springs.iter().fold(R::zero(), |sum, spring| sum + spring.dissipated());
        let (kinetic, elastic, contact) = (state.kinetic_energy(model), state.elastic_energy(model), stops + parted);
        let residual = initial + input - kinetic - elastic - viscous - hysteretic - friction - contact;
        let scale = initial.abs() + largest_input;
        let relative_residual = if residual == R::zero() { residual } else { residual / scale };
        GeneralSolution {
            status,
            end_time,
            every: self.every,
            drift: self.drift,
            slip: self.slip,
            peaks: self.peaks,
            residual_drift: state.drift.iter().map(|d| d.to_f64()).collect(),
            residual_slip: state.blocks.iter().map(|b| b.slip.to_f64()).collect(),
            slip_path: self.path.iter().map(|p| p.to_f64()).collect(),
            base: state.base.map(|_| self.base),
            events,
            energy: GeneralEnergy {
                initial: initial.to_f64(),
                input: input.to_f64(),
                kinetic: kinetic.to_f64(),
                elastic: elastic.to_f64(),
                viscous: viscous.to_f64(),
                hysteretic: hysteretic.to_f64(),
                friction: friction.to_f64(),
                contact: contact.to_f64(),
                relative_residual: relative_residual.to_f64(),
            },
        }
    }
}

/// Force of each spring over a stretch.
pub(super) fn shears<R: Real>(model: &Model<R>, state: &State<R>, series: &Series<R>) -> Vec<Polynomial<R>> {
    let shear = |p: usize| {
        let linear = series.drift[p].scaled(state.springs[p].linear());
        series.force[p].iter().fold(linear, |sum, force| sum.plus(force))
    };
    (0..model.mass.len()).map(shear).collect()
}

/// Base shear of a building over a stretch, from those of its springs.
pub(super) fn base_shear<R: Real>(
    model: &Model<R>,
    series: &Series<R>,
    shears: &[Polynomial<R>],
) -> Option<Polynomial<R>> {
    model.has_building.then(|| shears[0].plus(&matrix_at_base(model, series)))
}

/// The share of the elastic matrix in the base shear: the sum of its forces on the floors.
fn matrix_at_base<R: Real>(model: &Model<R>, series: &Series<R>) -> Polynomial<R> {
    let floors = model.matrix.len();
    let mut displacement: Vec<Polynomial<R>> = Vec::with_capacity(floors);
    for p in 0..floors {
        let own = series.drift[p].clone();
        displacement.push(model.parent[p].map_or(own.clone(), |parent| displacement[parent].plus(&own)));
    }
    let column = |q: usize| (0..floors).fold(R::zero(), |sum, p| sum + model.matrix[p][q]);
    let shares = displacement.iter().enumerate().map(|(q, u)| u.scaled(column(q)));
    shares.fold(Polynomial::constant(R::zero()), |sum, share| sum.plus(&share))
}
