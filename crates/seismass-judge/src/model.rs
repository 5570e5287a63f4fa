//! The constant data of a scene in the number type of the run (`numerics`, sections 1 to 3).

use seismass::scene::StoreyDamping;
use seismass::{STANDARD_GRAVITY, Scene, Storey};

use crate::real::Real;
use crate::springs::{self, Spring};

/// A storey: its virgin spring, and P/h.
#[derive(Debug)]
pub(crate) struct StoreyData<R> {
    pub(crate) spring: Box<dyn Spring<R>>,
    pub(crate) geometric: R,
    /// None: never.
    pub(crate) collapse_drift: Option<R>,
}

/// Friction coefficients per unit mass and contact acceleration g + a_v, from a path slipped in contact on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stage<R> {
    pub(crate) path: R,
    pub(crate) mu_s: R,
    pub(crate) mu_k: R,
}

/// A block.
#[derive(Debug, Clone)]
pub(crate) struct BlockData<R> {
    /// 0 is the ground.
    pub(crate) floor: usize,
    pub(crate) mass: R,
    /// By path, the first from the start.
    pub(crate) stages: Vec<Stage<R>>,
}

/// Whether a sum takes its terms with their sign, or their absolute values to measure its rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Terms {
    Signed,
    Sizes,
}

impl Terms {
    pub(crate) fn of<R: Real>(self, value: R) -> R {
        if self == Self::Sizes { value.abs() } else { value }
    }
}

/// A scene in numbers of type `R`.
#[derive(Debug)]
pub(crate) struct Model<R> {
    pub(crate) mass: Vec<R>,
    pub(crate) storeys: Vec<StoreyData<R>>,
    pub(crate) blocks: Vec<BlockData<R>>,
    pub(crate) gravity: R,
    /// D, row by row: drift rates to storey damping forces.
    storey_damping: Vec<Vec<R>>,
    /// Damping per floor mass (1/s).
    mass_damping: R,
}

impl<R: Real> Model<R> {
    pub(crate) fn new(scene: &Scene) -> Self {
        let mut model = Self {
            mass: Vec::new(),
            storeys: Vec::new(),
            blocks: Vec::new(),
            gravity: R::of(STANDARD_GRAVITY),
            storey_damping: Vec::new(),
            mass_damping: R::zero(),
        };
        for block in scene.blocks() {
            let stage =
                |path: f64, mu_s: f64, mu_k: f64| Stage { path: R::of(path), mu_s: R::of(mu_s), mu_k: R::of(mu_k) };
            let worn = block.wear.iter().map(|wear| stage(wear.path, wear.mu_s, wear.mu_k));
            let stages = [stage(0.0, block.mu_s, block.mu_k)].into_iter().chain(worn).collect();
            model.blocks.push(BlockData { floor: block.floor, mass: R::of(block.mass), stages });
        }
        let Some(building) = scene.building() else { return model };
        model.mass = building.mass().iter().map(|&m| R::of(m)).collect();
        for (i, (storey, &geometric)) in building.storeys().iter().zip(scene.geometric_stiffness()).enumerate() {
            model.storeys.push(storey_data(storey, geometric, scene.collapse_drift().map(|d| d[i])));
        }
        let n = model.mass.len();
        let mut rows = vec![vec![R::zero(); n]; n];
        match building.storey_damping() {
            StoreyDamping::None => {}
            StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => {
                model.mass_damping = R::of(*mass_factor);
                for (i, storey) in building.storeys().iter().enumerate() {
                    rows[i][i] = R::of(*stiffness_factor) * R::of(storey.stiffness);
                }
            }
            StoreyDamping::Dense(d) => {
                for (i, row) in rows.iter_mut().enumerate() {
                    for (j, value) in row.iter_mut().enumerate() {
                        *value = R::of(d[(i, j)]);
                    }
                }
            }
        }
        model.storey_damping = rows;
        model
    }

    /// Damping forces of the storeys at these drift rates.
    pub(crate) fn damping_forces(&self, rate: &[R], terms: Terms) -> Vec<R> {
        let row = |row: &Vec<R>| row.iter().zip(rate).fold(R::zero(), |sum, (&d, &r)| sum + terms.of(d * r));
        self.storey_damping.iter().map(row).collect()
    }

    /// Damping forces of the floors in proportion to their mass, at these velocities.
    pub(crate) fn mass_damping_force(&self, floor: usize, velocity: R) -> R {
        self.mass_damping * self.mass[floor] * velocity
    }

    /// Q: the force of springs, P-Delta and damping on each floor, at these spring forces, drifts and drift rates.
    pub(crate) fn pull(&self, springs: &[R], drift: &[R], rate: &[R], terms: Terms) -> Vec<R> {
        let damping = self.damping_forces(rate, terms);
        let action = |i: usize| terms.of(springs[i]) + terms.of(-self.storeys[i].geometric * drift[i]) + damping[i];
        let mut above = R::zero();
        let velocity = floor_velocities(rate);
        let mut pull: Vec<R> = (0..self.storeys.len())
            .rev()
            .map(|i| {
                let below = action(i);
                let mass_damping = terms.of(-self.mass_damping_force(i, velocity[i]));
                let q = above + terms.of(-below) + mass_damping;
                above = below;
                q
            })
            .collect();
        pull.reverse();
        pull
    }

    /// Bound of the norm of the system in every regime (1/s): sqrt(kappa) + gamma, where kappa and gamma are the
    /// largest row sums from drifts and drift rates to the rates of drift rates, with all springs at their stiffest, k +
    /// P/h for k, and no mass but the floors'. With rates in units of sqrt(kappa) times a drift it is the norm of A.
    pub(crate) fn frequency_bound(&self) -> f64 {
        let n = self.mass.len();
        let row_sum = |columns: &dyn Fn(usize) -> Vec<R>| {
            let mut sums = vec![0.0; n];
            for column in 0..n {
                let q = columns(column);
                let a = |i: usize| (q[i] / self.mass[i]).to_f64();
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum += (a(i) - if i > 0 { a(i - 1) } else { 0.0 }).abs();
                }
            }
            sums.into_iter().fold(0.0, f64::max)
        };
        let unit = |at: usize, value: R| (0..n).map(|i| if i == at { value } else { R::zero() }).collect::<Vec<R>>();
        let none = vec![R::zero(); n];
        let kappa = row_sum(&|j| {
            let storey = &self.storeys[j];
            let stiffness = storey.spring.largest_stiffness() + storey.geometric;
            // P/h enters as added stiffness: a force in place of the drift.
            self.pull(&unit(j, stiffness), &none, &none, Terms::Signed)
        });
        let gamma = row_sum(&|j| self.pull(&none, &none, &unit(j, R::of(1.0)), Terms::Signed));
        kappa.sqrt() + gamma
    }
}

/// Running sums: floor velocities from drift rates.
pub(crate) fn floor_velocities<R: Real>(rate: &[R]) -> Vec<R> {
    let mut velocity = R::zero();
    let sum = |&r: &R| {
        velocity = velocity + r;
        velocity
    };
    rate.iter().map(sum).collect()
}

/// A storey with P/h, which collapses at the drift that is given, or where its backbone meets P/h.
pub(crate) fn storey_data<R: Real>(storey: &Storey, geometric: f64, collapse: Option<f64>) -> StoreyData<R> {
    let (spring, geometric) = (springs::spring::<R>(storey), R::of(geometric));
    let collapse_drift = match collapse {
        Some(drift) => drift.is_finite().then(|| R::of(drift)),
        None => springs::collapse_drift(&spring.backbone(), geometric),
    };
    StoreyData { spring, geometric, collapse_drift }
}
