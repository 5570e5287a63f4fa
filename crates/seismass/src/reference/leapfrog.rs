//! Half-explicit leapfrog: the method a good engineer writes by hand, order 2.
//!
//! Positions at the ends of steps, velocities in their middles (Stoermer-Verlet, the central difference method);
//! storey springs by return mapping; friction as an impulse, implicit in the velocity after the step and clipped to its
//! limit (half-explicit time stepping: Moreau 1988; Acary & Brogliato, Numerical Methods for Nonsmooth Dynamical
//! Systems, 2008, chapter 10). Viscous damping takes the velocity at the end of a step extrapolated from the middles of
//! the last two, which keeps order 2, needs no equations to be solved, and leaves each floor to decide alone.
//!
//! A floor's single block is of order 2 through stops, breakaways and reversals; several blocks on one floor, clipped
//! together in closed form, are of order 1 where one of them reverses.

use nalgebra::DMatrix;

use super::clipping::{Breakpoint, Contact, clip_several};
use super::history::{History, check_finite};
use super::method::Error;
use crate::lanes::{Vector, for_each_path};
use crate::machines::model::Model;
use crate::response::Status;
use crate::scene::{Motion, Scene, StoreyDamping, natural_frequencies};
use crate::units::STANDARD_GRAVITY;

for_each_path! {
    /// Integrates a scene. Paths give the same bits: they have the same operations, on wider vectors.
    pub(super) fn integrate(scene: &Scene, motion: &Motion, substeps: usize) -> Result<History, Error>
        = integrate_by_path
}

#[inline(always)]
fn integrate_by_path<V: Vector>(scene: &Scene, motion: &Motion, substeps: usize) -> Result<History, Error> {
    let model = Model::new(scene);
    let h = motion.dt() / substeps as f64;
    check_stability(&model, motion.dt(), substeps)?;
    let samples = motion.acceleration().len();
    let mut history = History::new(samples, scene.storeys(), scene.blocks().len());
    let mut run = Leapfrog::new(scene, &model);
    run.record(0, 0.0, &mut history)?;
    let vertical = |i: usize| motion.vertical().map_or(0.0, |samples| samples[i]);
    let mut length = 0.5 * h;
    'samples: for i in 0..samples - 1 {
        let ground = [motion.acceleration()[i], motion.acceleration()[i + 1]];
        let contact = [vertical(i) + STANDARD_GRAVITY, vertical(i + 1) + STANDARD_GRAVITY];
        for k in 0..substeps {
            let s = k as f64 / substeps as f64;
            run.kick(length, ground[0] + s * (ground[1] - ground[0]), contact[0] + s * (contact[1] - contact[0]));
            if length < h {
                run.start_extrapolation();
                length = h;
            }
            history.steps += 1;
            if let Some(storey) = run.drift(h) {
                let time = (i * substeps + k + 1) as f64 * h;
                history.status = Status::Collapsed { storey: storey + 1, time };
                break 'samples;
            }
        }
        run.record(i + 1, (i + 1) as f64 * motion.dt(), &mut history)?;
    }
    history.peak_drift = run.storeys.iter().map(|s| s.peak).collect();
    history.peak_slip = run.places.iter().map(|&place| run.peak_slip[place]).collect();
    Ok(history)
}

/// The central difference method needs h w < 2 for the highest frequency w. With damping forces at extrapolated rates,
/// a motion that changes its sign at every step grows unless h^2 K / 4 + h C < M: with C / M up to c, h must be below
/// 2 / (c + sqrt(c^2 + w^2)). Blocks lower both.
fn check_stability(model: &Model, dt: f64, substeps: usize) -> Result<(), Error> {
    let highest = natural_frequencies(&model.mass, &model.stiffness).last().copied().unwrap_or(0.0);
    let mut damping = model.damping().floor_matrix(&model.mass, &model.stiffness);
    for (i, j) in (0..model.storeys()).flat_map(|i| (0..model.storeys()).map(move |j| (i, j))) {
        damping[(i, j)] /= (model.mass[i] * model.mass[j]).sqrt();
    }
    let least = |damping: f64| 0.5 * dt * (damping + libm::hypot(damping, highest));
    // Sums of rows bound the eigenvalues, at no cost.
    let most = damping.row_iter().map(|row| row.iter().map(|c| c.abs()).sum()).fold(0.0, f64::max);
    if substeps as f64 > least(most) {
        return Ok(());
    }
    let least = least(damping.symmetric_eigenvalues().iter().copied().fold(0.0, f64::max));
    let requirement = format!("above {least}, for steps below {} s", dt / least);
    super::method::require(substeps as f64 > least, "substeps", &requirement, substeps)
}

/// A storey and the floor above it.
struct StoreyMotion {
    drift: f64,
    /// Drift rate in the middle of the last step (m/s).
    rate: f64,
    /// Drift rate extrapolated to the end of the last step (m/s).
    end_rate: f64,
    element_force: [f64; 2],
    element_stiffness: [f64; 2],
    element_limit: [f64; 2],
    /// Stiffness of the linear element less P/h.
    linear: f64,
    /// Stiffness-proportional damping (N s/m).
    damping: f64,
    /// Force of springs, P-Delta and damping (N).
    force: f64,
    floor_velocity: f64,
    floor_mass: f64,
    floor_inverse_mass: f64,
    /// Blocks on the floor: the range in the order of the leapfrog.
    blocks: (usize, usize),
    collapse_drift: f64,
    peak: f64,
}

struct Leapfrog {
    storeys: Vec<StoreyMotion>,
    /// Blocks by floor, the ground first.
    contacts: Vec<Contact>,
    peak_slip: Vec<f64>,
    /// The place of each block of the scene among them.
    places: Vec<usize>,
    on_ground: usize,
    /// Damping between drift rates and storey forces where it is full, and the factor of the masses.
    full_damping: Option<DMatrix<f64>>,
    mass_factor: f64,
    breakpoints: Vec<Breakpoint>,
}

impl Leapfrog {
    fn new(scene: &Scene, model: &Model) -> Self {
        let order: Vec<usize> = model.on_floor.concat();
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, &block)| places[block] = place);
        let velocity = |floor: usize| if floor > 0 { scene.initial_velocity()[floor - 1] } else { 0.0 };
        let contacts = order.iter().map(|&j| {
            let (law, floor) = (&model.blocks[j], model.blocks[j].floor);
            let own = scene.blocks()[j].velocity.unwrap_or(velocity(floor));
            let floor_inverse_mass = if floor > 0 { 1.0 / model.mass[floor - 1] } else { 0.0 };
            Contact {
                mass: law.mass,
                mu_s: law.mu_s,
                mu_k: law.mu_k,
                reduced: 1.0 / (floor_inverse_mass + 1.0 / law.mass),
                inverse_mass: 1.0 / law.mass,
                velocity: own,
                relative: own - velocity(floor),
                slip: 0.0,
                limit: 0.0,
            }
        });
        let (full_damping, mass_factor, stiffness_factor) = match model.damping() {
            StoreyDamping::None => (None, 0.0, 0.0),
            StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => (None, *mass_factor, *stiffness_factor),
            StoreyDamping::Dense(d) => (Some(d.clone()), 0.0, 0.0),
        };
        let mut first = model.on_floor[0].len();
        let storeys = (0..model.storeys()).map(|i| {
            let law = &model.laws[i];
            let mut elements = law.spring.elements().iter().map(|e| (e.stiffness, e.yield_force));
            let both = [elements.next().unwrap_or_default(), elements.next().unwrap_or_default()];
            let drift = scene.initial_drift()[i];
            let rate = velocity(i + 1) - velocity(i);
            let blocks = (first, first + model.on_floor[i + 1].len());
            first = blocks.1;
            StoreyMotion {
                drift,
                rate,
                end_rate: rate,
                element_force: both.map(|(k, _)| k * drift),
                element_stiffness: both.map(|(k, _)| k),
                element_limit: both.map(|(_, limit)| limit),
                linear: law.last_slope() - law.geometric,
                damping: stiffness_factor * model.stiffness[i],
                force: 0.0,
                floor_velocity: velocity(i + 1),
                floor_mass: model.mass[i],
                floor_inverse_mass: 1.0 / model.mass[i],
                blocks,
                collapse_drift: law.collapse_drift,
                peak: drift.abs(),
            }
        });
        let mut run = Self {
            storeys: storeys.collect(),
            contacts: contacts.collect(),
            peak_slip: vec![0.0; places.len()],
            breakpoints: Vec::with_capacity(2 * places.len()),
            places,
            on_ground: model.on_floor[0].len(),
            full_damping,
            mass_factor,
        };
        run.form_forces();
        run
    }

    /// Storey forces at the end of a step.
    #[inline(always)]
    fn form_forces(&mut self) {
        for s in &mut self.storeys {
            s.force = s.element_force[0] + s.element_force[1] + s.linear * s.drift + s.damping * s.end_rate;
        }
        if let Some(d) = &self.full_damping {
            let n = self.storeys.len();
            for (i, row) in d.as_slice().chunks_exact(n).enumerate() {
                // The matrix is symmetric: a column is a row.
                let damping: f64 = row.iter().zip(&self.storeys).map(|(c, s)| c * s.end_rate).sum();
                self.storeys[i].force += damping;
            }
        }
    }

    /// Velocities take the forces at the end of the last step over the length `h`, friction included.
    #[inline(always)]
    fn kick(&mut self, h: f64, ground: f64, contact: f64) {
        let push = h * ground;
        let contact = h * contact.max(0.0);
        for block in &mut self.contacts {
            block.velocity -= push;
        }
        for block in &mut self.contacts[..self.on_ground] {
            block.clip(0.0, 0.0, contact);
        }
        let n = self.storeys.len();
        let mut end_velocity = 0.0;
        for i in 0..n {
            let above = if i + 1 < n { self.storeys[i + 1].force } else { 0.0 };
            let s = &mut self.storeys[i];
            end_velocity += s.end_rate;
            let impulse = h * (above - s.force);
            let free = s.floor_velocity + impulse * s.floor_inverse_mass - push - h * self.mass_factor * end_velocity;
            s.floor_velocity = match &mut self.contacts[s.blocks.0..s.blocks.1] {
                [] => free,
                [block] => free + block.clip(free, s.floor_inverse_mass, contact) * s.floor_inverse_mass,
                several => clip_several(s.floor_mass, free, several, contact, &mut self.breakpoints),
            };
        }
    }

    /// After the first kick, of half a step, the rate known at t = 0 stands in for that of the step before.
    fn start_extrapolation(&mut self) {
        let mut below = 0.0;
        for s in &mut self.storeys {
            s.rate = 2.0 * s.rate - (s.floor_velocity - below);
            below = s.floor_velocity;
        }
    }

    /// Positions and forces at the end of a step of length `h`; returns the storey that collapsed.
    #[inline(always)]
    fn drift(&mut self, h: f64) -> Option<usize> {
        let mut below = 0.0;
        let mut collapsed = None;
        for (i, s) in self.storeys.iter_mut().enumerate() {
            let previous = s.rate;
            s.rate = s.floor_velocity - below;
            below = s.floor_velocity;
            s.end_rate = 1.5 * s.rate - 0.5 * previous;
            let change = h * s.rate;
            s.drift += change;
            for e in 0..2 {
                let trial = s.element_force[e] + s.element_stiffness[e] * change;
                s.element_force[e] = trial.min(s.element_limit[e]).max(-s.element_limit[e]);
            }
            s.peak = s.peak.max(s.drift.abs());
            if s.drift.abs() >= s.collapse_drift && collapsed.is_none() {
                collapsed = Some(i);
            }
        }
        for (block, peak) in self.contacts.iter_mut().zip(&mut self.peak_slip) {
            block.slip += h * block.relative;
            *peak = peak.max(block.slip.abs());
        }
        self.form_forces();
        collapsed
    }

    #[inline(always)]
    fn record(&self, row: usize, time: f64, history: &mut History) -> Result<(), Error> {
        let drifts = || self.storeys.iter().map(|s| s.drift);
        let slips = || self.places.iter().map(|&place| self.contacts[place].slip);
        if !drifts().chain(slips()).sum::<f64>().is_finite() {
            check_finite(time, drifts(), slips())?;
        }
        history.record(row, drifts(), slips());
        Ok(())
    }
}
