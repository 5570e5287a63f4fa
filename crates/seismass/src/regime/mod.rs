//! A regime: one tuple of all state machines, in which the system is linear, and what follows from it.
//!
//! Floor accelerations are linear in drifts x and drift rates v; two derivatives on, the loads are gone (the motion is
//! linear between samples), so (v', v'') obeys the homogeneous equation, whose energy never grows where tangents and
//! damping are not negative. That energy, known at the start of a step, bounds all higher derivatives inside the step.

pub(crate) mod bounds;
pub(crate) mod operator_long;

use crate::lanes::{PaddedRows, Vector, WIDTH, columns_of, load, numbers, prefix_sums};
use crate::machines::model::{Model, ModelLanes};
use crate::scene::StoreyDamping;

/// The linear operators of one regime.
#[derive(Default)]
pub(crate) struct Regime {
    /// One row of each [`Row`], padded with zeros.
    rows: PaddedRows<ROWS>,
    /// Bound on the growth of Taylor coefficients (rad/s).
    pub(crate) frequency: f64,
    /// Exponent (1/s) with which the energy of the derivatives may grow: positive with a negative tangent.
    growth: f64,
}

/// What is known of each storey, or floor, in a regime. Bounds are per unit of [`Regime::derivative_norm_of`].
#[derive(Clone, Copy)]
pub(crate) enum Row {
    /// Storey tangent, P-Delta subtracted (N/m).
    Tangent,
    /// Spring tangent alone (N/m).
    SpringTangent,
    /// 1 / spring tangent; 0 where that is not positive.
    SpringFlexibility,
    /// Floor mass with the blocks stuck to it (kg).
    Mass,
    /// 1 / mass.
    InverseMass,
    /// Root of the mass.
    RootMass,
    /// 1 / root of the mass: bound on the relative floor velocity.
    InverseRootMass,
    /// Root of |tangent|.
    RootTangent,
    /// Bound on the second derivative of the floor acceleration.
    SecondOfAcceleration,
    /// Bound on its third derivative: the fourth of a block's relative velocity.
    ThirdOfAcceleration,
    /// Bound on its fourth derivative.
    FourthOfAcceleration,
    /// Bound on the fourth derivative of the drift.
    FourthOfDrift,
    /// Bound on the fourth derivative of the drift rate.
    FourthOfRate,
}

/// Number of rows.
pub(crate) const ROWS: usize = Row::FourthOfRate as usize + 1;

impl Regime {
    /// The regime with the tangent `tangent(i)` of each storey's spring and `stuck_mass[i]` on each floor.
    pub(crate) fn new(model: &Model, tangent: impl Fn(usize) -> f64, stuck_mass: &[f64]) -> Self {
        let width = model.width;
        let mut rows = PaddedRows::zeros(width);
        let numbers = rows.numbers_mut();
        for i in 0..model.storeys() {
            let spring = tangent(i);
            numbers[Row::SpringTangent as usize * width + i] = spring;
            numbers[Row::Tangent as usize * width + i] = spring - model.laws[i].geometric;
            numbers[Row::Mass as usize * width + i] = model.mass[i] + stuck_mass[i];
        }
        let (frequency, growth) = self::bounds::form(model, numbers);
        Self { rows, frequency, growth }
    }

    /// A row, padded.
    #[inline(always)]
    pub(crate) fn row(&self, row: Row) -> &[f64] {
        self.rows.row(row as usize)
    }

    /// A row in `K` vectors, of which a scene must have as many.
    #[inline(always)]
    pub(crate) fn lanes<V: Vector, const K: usize>(&self, row: Row) -> [V; K] {
        let mut vectors = [V::splat(0.0); K];
        if let Some(lanes) = self.rows.vectors::<K>().get(row as usize) {
            for k in 0..K {
                vectors[k] = V::load(&lanes[k]);
            }
        }
        vectors
    }

    /// Floor accelerations (absolute) from drifts, drift rates and floor loads: a_i = (S_(i+1) - S_i + load_i) / mass_i
    /// with S the storey forces of springs, P-Delta and damping. Also serves derivatives of these.
    #[inline(always)]
    pub(crate) fn accelerations(&self, model: &Model, x: &[f64], v: &[f64], load: &[f64], out: &mut [f64]) {
        let n = out.len();
        storey_forces(self.row(Row::Tangent), model, x, v, out);
        let mut velocity = 0.0;
        let (mass_factor, inverse_mass) = (mass_factor(model), self.row(Row::InverseMass));
        for i in 0..n {
            let above = if i + 1 < n { out[i + 1] } else { 0.0 };
            velocity += v[i];
            let force = above - out[i] + load[i] - mass_factor * model.mass[i] * velocity;
            out[i] = force * inverse_mass[i];
        }
    }

    /// A norm of (v', v'') at the start of a step of length `h` that bounds its later values, from its square there:
    /// the sum of mass times relative jerk squared and of tangent (absolute) times drift acceleration squared.
    #[inline]
    pub(crate) fn derivative_norm_of(&self, square: f64, h: f64) -> f64 {
        square.sqrt() * self.growth_over(h)
    }

    /// Factor by which the norm may grow over `h`.
    #[inline]
    pub(crate) fn growth_over(&self, h: f64) -> f64 {
        if self.growth > 0.0 { libm::exp(self.growth * h) } else { 1.0 }
    }

    /// Whether energy cannot grow in this regime: no negative tangent, damping known not to feed it.
    pub(crate) fn is_passive(&self) -> bool {
        self.growth == 0.0
    }
}

/// [`Regime::accelerations`] with storeys in `K` vectors, of which the lanes beyond the last storey are zero.
pub(crate) struct RegimeOperator<'a, V, const K: usize> {
    tangent: [V; K],
    inverse_mass: [V; K],
    model: &'a ModelLanes,
}

impl<'a, V: Vector, const K: usize> RegimeOperator<'a, V, K> {
    #[inline(always)]
    pub(crate) fn new(model: &'a Model, regime: &Regime) -> Self {
        let (tangent, inverse_mass) = (regime.lanes(Row::Tangent), regime.lanes(Row::InverseMass));
        Self { tangent, inverse_mass, model: &model.lanes }
    }

    /// Whether floors are damped by their own velocities, with Rayleigh damping.
    #[inline(always)]
    pub(crate) fn damps_floors(&self) -> bool {
        !self.model.floor_damping.is_empty()
    }

    /// Floor velocities against the ground from drift rates where floors are damped by them, else what nothing reads.
    #[inline(always)]
    pub(crate) fn floor_velocities(&self, v: &[V; K]) -> [V; K] {
        if self.damps_floors() { prefix_sums(v) } else { *v }
    }

    /// With Rayleigh damping, adds that of the storeys to their forces; returns that of the floors.
    #[inline(always)]
    fn add_storey_damping(&self, v: &[V; K], shear: &mut [V; K]) -> Option<[V; K]> {
        if !self.damps_floors() {
            return None;
        }
        let storeys: [V; K] = load(&self.model.storey_damping[..]);
        for k in 0..K {
            shear[k] = storeys[k].mul_add(v[k], shear[k]);
        }
        Some(load(&self.model.floor_damping[..]))
    }

    /// Sums of the sizes of the terms of the floor accelerations, from those of drifts, drift rates and other forces on
    /// floors, and from constant parts of the storey forces.
    #[inline(always)]
    pub(crate) fn sizes(&self, x: &[V; K], v: &[V; K], constant: &[V; K], mut force: [V; K]) -> [V; K] {
        let zero = V::splat(0.0);
        let mut shear = [zero; K];
        for k in 0..K {
            shear[k] = self.tangent[k].abs().mul_add(x[k], constant[k].abs());
        }
        if !self.model.damping.is_empty() {
            let rates = numbers(v);
            let columns = columns_of::<K>(&self.model.damping);
            for (column, &rate) in columns.iter().zip(rates.as_flattened()) {
                for k in 0..K {
                    shear[k] = V::load(&column[k]).abs().mul_add(V::splat(rate), shear[k]);
                }
            }
        }
        if let Some(floors) = self.add_storey_damping(v, &mut shear) {
            let velocity = prefix_sums(v);
            for k in 0..K {
                force[k] = floors[k].mul_add(velocity[k], force[k]);
            }
        }
        for k in 0..K {
            let above = if k + 1 < K { shear[k + 1] } else { zero };
            force[k] = shear[k].shifted_down(above).add(shear[k]).add(force[k]).mul(self.inverse_mass[k]);
        }
        force
    }

    /// Floor accelerations from drifts, drift rates, floor velocities ([`RegimeOperator::floor_velocities`]) and floor loads.
    #[inline(always)]
    pub(crate) fn accelerations(&self, x: &[V; K], v: &[V; K], floors: &[V; K], mut force: [V; K]) -> [V; K] {
        let zero = V::splat(0.0);
        let mut shear = [zero; K];
        for k in 0..K {
            shear[k] = self.tangent[k].mul(x[k]);
        }
        let columns = columns_of::<K>(&self.model.damping);
        if K == 1 {
            if let Some(columns) = columns.first_chunk::<4>() {
                // Two sums: half the latency of one.
                let damping = |c: usize, sum: V| V::load(&columns[c][0]).mul_add(v[0].broadcast(c), sum);
                shear[0] = damping(0, damping(1, shear[0])).add(damping(2, damping(3, zero)));
            }
        } else if !columns.is_empty() {
            add_product(columns, v, &mut shear);
        }
        if let Some(damping) = self.add_storey_damping(v, &mut shear) {
            for k in 0..K {
                force[k] = force[k].sub(damping[k].mul(floors[k]));
            }
        }
        let mut a = [zero; K];
        for k in 0..K {
            let above = if k + 1 < K { shear[k + 1] } else { zero };
            let net = shear[k].shifted_down(above).sub(shear[k]).add(force[k]);
            a[k] = net.mul(self.inverse_mass[k]);
        }
        a
    }
}

/// sums += columns * weights, of more vectors than one.
#[inline(always)]
fn add_product<V: Vector, const K: usize>(columns: &[[[f64; WIDTH]; K]], weights: &[V; K], sums: &mut [V; K]) {
    let weights = numbers(weights);
    // Two sums: there is no room for more.
    let mut others = [V::splat(0.0); K];
    for (pair, weights) in columns.as_chunks::<2>().0.iter().zip(weights.as_flattened().as_chunks::<2>().0) {
        let (even, odd) = (V::splat(weights[0]), V::splat(weights[1]));
        for k in 0..K {
            sums[k] = V::load(&pair[0][k]).mul_add(even, sums[k]);
            others[k] = V::load(&pair[1][k]).mul_add(odd, others[k]);
        }
    }
    for k in 0..K {
        sums[k] = sums[k].add(others[k]);
    }
}

/// Factor of the mass matrix in Rayleigh damping (1/s), 0 otherwise.
#[inline]
fn mass_factor(model: &Model) -> f64 {
    if let StoreyDamping::Rayleigh { mass_factor, .. } = model.damping() { *mass_factor } else { 0.0 }
}

/// Storey forces S_i = tangent_i x_i + (D v)_i, without the mass-proportional part of Rayleigh damping.
#[inline(always)]
fn storey_forces(tangent: &[f64], model: &Model, x: &[f64], v: &[f64], out: &mut [f64]) {
    let n = out.len();
    for i in 0..n {
        out[i] = tangent[i] * x[i];
    }
    match model.damping() {
        StoreyDamping::None => {}
        StoreyDamping::Rayleigh { stiffness_factor, .. } => {
            for i in 0..n {
                out[i] += stiffness_factor * model.stiffness[i] * v[i];
            }
        }
        StoreyDamping::Dense(d) => {
            // Four columns at a time: each sum is loaded and stored once for all.
            let (fours, rates) = (d.as_slice().chunks_exact(4 * n), v[..n].as_chunks::<4>());
            let rest = fours.remainder();
            for (columns, &rates) in fours.zip(rates.0) {
                let (low, high) = columns.split_at(2 * n);
                let ((first, second), (third, fourth)) = (low.split_at(n), high.split_at(n));
                for i in 0..n {
                    let even = first[i] * rates[0] + second[i] * rates[1];
                    out[i] += even + (third[i] * rates[2] + fourth[i] * rates[3]);
                }
            }
            for (column, &rate) in rest.chunks_exact(n).zip(rates.1) {
                for i in 0..n {
                    out[i] += column[i] * rate;
                }
            }
        }
    }
}

/// Power dissipated by viscous damping at drift rates `v` (W).
pub(crate) fn viscous_power(model: &Model, v: &[f64], scratch: &mut [f64]) -> f64 {
    let n = v.len();
    scratch.fill(0.0);
    match model.damping() {
        StoreyDamping::None => {}
        StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => {
            let mut velocity = 0.0;
            let mut power = 0.0;
            for i in 0..n {
                velocity += v[i];
                power += mass_factor * model.mass[i] * velocity * velocity
                    + stiffness_factor * model.stiffness[i] * v[i] * v[i];
            }
            return power;
        }
        StoreyDamping::Dense(d) => {
            for (column, &rate) in d.as_slice().chunks_exact(n).zip(v) {
                for i in 0..n {
                    scratch[i] += column[i] * rate;
                }
            }
        }
    }
    scratch.iter().zip(v).map(|(force, rate)| force * rate).sum()
}
