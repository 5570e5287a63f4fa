//! The exact step of a tall regime over one sample interval with a full damping matrix D between drift rates and storey
//! forces.
//!
//! With linear loads the floor accelerations w against the ground obey the homogeneous system. Let B take floors to
//! storeys by differences, s be the sums of mass times w from a floor up, and r = s' + D B w. Then q = B w = W s with
//! W = B M^-1 B^T, and s' = r - D q, r' = -T q with the tangents T. The response G of q to r, with
//!
//! ```text
//! G(0) = 0, G'(0) = W, G'' = -(G' D + G T) W,
//! ```
//!
//! is symmetric at all times, as the reciprocity of elastic and viscous forces has it; so are its integrals. What a
//! step adds to drift rates and, beyond the first order, to drifts, is
//!
//! ```text
//! integral of q = G s + (integral of G) r,  second integral of q = (integral of G) s + (second integral of G) r.
//! ```
//!
//! Nothing of this needs D itself: r is what changes the loads, less what changes the springs. The part of s and r that
//! comes from the motion of the ground, a mass times the same number on all floors, is large where nothing happens:
//! what it does is formed apart, from the storey on the ground, so that storeys which no wave has reached stay at rest.

use nalgebra::DMatrix;

use crate::lanes::{Symmetric, Vector, WIDTH, filled_to, for_each_path};
use crate::machines::model::Model;
use crate::regime::{Regime, Row};
use crate::step::banded::whole_blocks;
use crate::tolerances::{BANDED_PHASE, BELOW_ROUNDING};

/// Rows of a product that are formed together: two vectors.
const PANEL: usize = 2 * WIDTH;

/// The step of a regime.
pub(crate) struct FullStep {
    /// G and its first and second integrals over the step.
    effects: Symmetric<3>,
    /// First, second and third integrals of q after a jump of the ground's acceleration by one.
    of_ground: [Vec<f64>; 3],
}

/// A square matrix by columns, padded to whole panels of rows.
#[derive(Clone)]
struct Square {
    size: usize,
    length: usize,
    values: Vec<f64>,
}

impl Square {
    fn zeros(size: usize) -> Self {
        let length = whole_blocks(size);
        Self { size, length, values: vec![0.0; size * length] }
    }

    #[inline(always)]
    fn column(&self, j: usize) -> &[f64] {
        &self.values[j * self.length..(j + 1) * self.length]
    }

    #[inline(always)]
    fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.values[j * self.length..(j + 1) * self.length]
    }

    /// Adds `other` times a factor.
    #[inline(always)]
    fn add(&mut self, other: &Self, factor: f64) {
        for (sum, value) in self.values.iter_mut().zip(&other.values) {
            *sum += factor * value;
        }
    }

    /// The matrix with row i multiplied by `factors[i]`.
    #[inline(always)]
    fn with_rows_times(&self, factors: &[f64]) -> Self {
        let mut out = self.clone();
        for column in out.values.chunks_exact_mut(self.length) {
            column.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
        }
        out
    }

    fn transposed(&self) -> Self {
        let mut out = Self::zeros(self.size);
        for j in 0..self.size {
            for i in 0..self.size {
                out.values[i * self.length + j] = self.values[j * self.length + i];
            }
        }
        out
    }

    /// Makes what is below the diagonal the mirror image of what is above it.
    fn mirror(&mut self) {
        for j in 1..self.size {
            for i in 0..j {
                self.values[i * self.length + j] = self.values[j * self.length + i];
            }
        }
    }

    /// For the right side of products: by four columns, by row.
    fn packed(&self) -> Vec<[f64; WIDTH]> {
        let columns = (0..self.size).step_by(WIDTH);
        let entry = |i: usize, j: usize| if j < self.size { self.values[j * self.length + i] } else { 0.0 };
        columns.flat_map(|j| (0..self.size).map(move |i| [0, 1, 2, 3].map(|c| entry(i, j + c)))).collect()
    }

    /// The product with a packed matrix, of which the entries up to `below` places below the diagonal are formed, and
    /// perhaps more.
    #[inline(always)]
    fn times<V: Vector>(&self, packed: &[[f64; WIDTH]], below: usize) -> Self {
        let mut out = Self::zeros(self.size);
        let mut panel = vec![[0.0; PANEL]; self.size];
        for from in (0..self.length).step_by(PANEL) {
            for (panel, column) in panel.iter_mut().zip(self.values.chunks_exact(self.length)) {
                panel.copy_from_slice(&column[from..from + PANEL]);
            }
            for (block, right) in packed.chunks_exact(self.size).enumerate() {
                let first = WIDTH * block;
                if from > first + WIDTH - 1 + below {
                    continue;
                }
                let mut sums = [[V::splat(0.0); 2]; WIDTH];
                for (left, right) in panel.iter().zip(right) {
                    let (&[low, high], []) = left.as_chunks::<WIDTH>() else { continue };
                    let (low, high) = (V::load(&low), V::load(&high));
                    for c in 0..WIDTH {
                        let factor = V::splat(right[c]);
                        sums[c] = [low.mul_add(factor, sums[c][0]), high.mul_add(factor, sums[c][1])];
                    }
                }
                for (j, sums) in (first..self.size).zip(sums) {
                    let (rows, _) = out.column_mut(j)[from..from + PANEL].as_chunks_mut::<WIDTH>();
                    sums[0].store(&mut rows[0]);
                    sums[1].store(&mut rows[1]);
                }
            }
        }
        out
    }
}

/// What a regime's system is made of.
pub(crate) struct FullSystem<'a> {
    tangent: &'a [f64],
    /// W: its diagonal, and the entries beside it.
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    /// D, packed.
    damping: Vec<[f64; WIDTH]>,
}

impl<'a> FullSystem<'a> {
    fn new(damping: &DMatrix<f64>, regime: &'a Regime) -> Self {
        let n = damping.nrows();
        let inverse_mass = &regime.row(Row::InverseMass)[..n];
        let of_floor_below = |i: usize| if i > 0 { inverse_mass[i - 1] } else { 0.0 };
        let mut square = Square::zeros(n);
        for (j, column) in damping.column_iter().enumerate() {
            square.column_mut(j)[..n].iter_mut().zip(&column).for_each(|(value, entry)| *value = *entry);
        }
        Self {
            tangent: &regime.row(Row::Tangent)[..n],
            diagonal: (0..n).map(|i| of_floor_below(i) + inverse_mass[i]).collect(),
            beside: inverse_mass[..n - 1].iter().map(|inverse_mass| -inverse_mass).collect(),
            damping: square.packed(),
        }
    }

    /// W.
    fn inertia(&self) -> Square {
        let mut out = Square::zeros(self.tangent.len());
        for (i, &diagonal) in self.diagonal.iter().enumerate() {
            out.column_mut(i)[i] = diagonal;
        }
        for (i, &beside) in self.beside.iter().enumerate() {
            out.column_mut(i)[i + 1] = beside;
            out.column_mut(i + 1)[i] = beside;
        }
        out
    }

    /// The term of G of order k from those of order k - 1 and k - 2 over a step `h`.
    #[inline(always)]
    fn term<V: Vector>(&self, before: &Square, last: &Square, h: f64, k: usize) -> Square {
        let n = self.tangent.len();
        let (of_rate, of_value) = (-h / k as f64, -h * h / (k * (k - 1)) as f64);
        let mut forces = last.times::<V>(&self.damping, 1);
        for (j, &tangent) in self.tangent.iter().enumerate() {
            let rows = forces.column_mut(j).iter_mut().zip(before.column(j)).take(j + 2);
            rows.for_each(|(force, before)| *force = of_rate * *force + of_value * tangent * before);
        }
        let mut out = Square::zeros(n);
        for j in 0..n {
            let column = &mut out.column_mut(j)[..=j];
            column.iter_mut().zip(forces.column(j)).for_each(|(sum, force)| *sum = self.diagonal[j] * force);
            let neighbours = [(j.wrapping_sub(1), j.wrapping_sub(1)), (j + 1, j)];
            for (neighbour, beside) in neighbours.into_iter().filter(|&(neighbour, _)| neighbour < n) {
                let beside = self.beside[beside];
                column.iter_mut().zip(forces.column(neighbour)).for_each(|(sum, force)| *sum += beside * force);
            }
        }
        out.mirror();
        out
    }

    /// G and its integrals by series over `h`, to the first term below rounding at frequency times time `phase`.
    #[inline(always)]
    fn by_series<V: Vector>(&self, h: f64, phase: f64) -> [Square; 3] {
        let n = self.tangent.len();
        let mut sums = [Square::zeros(n), Square::zeros(n), Square::zeros(n)];
        let (mut before, mut term) = (Square::zeros(n), Square::zeros(n));
        term.add(&self.inertia(), h);
        let mut size = 1.0;
        for k in 1.. {
            let once = h / (k + 1) as f64;
            for (sum, factor) in sums.iter_mut().zip([1.0, once, once * h / (k + 2) as f64]) {
                sum.add(&term, factor);
            }
            size *= phase / k as f64;
            if size <= BELOW_ROUNDING {
                break;
            }
            let next = self.term::<V>(&before, &term, h, k + 1);
            before = std::mem::replace(&mut term, next);
        }
        sums
    }

    /// Forces that stop what a unit has set going, by rate and drift, by the end of the first half.
    #[inline(always)]
    fn stopping<V: Vector>(&self, rate: &Square, drift: &Square) -> Vec<[f64; WIDTH]> {
        let mut forces = rate.times::<V>(&self.damping, rate.size).transposed();
        forces.add(&drift.with_rows_times(self.tangent), 1.0);
        forces.packed()
    }

    /// G and its integrals over twice `h`.
    #[inline(always)]
    fn doubled<V: Vector>(&self, [value, once, twice]: &[Square; 3], h: f64) -> [Square; 3] {
        // Of a unit of s, and of r.
        let of_s = self.stopping::<V>(value, once);
        let of_r = self.stopping::<V>(once, twice);
        let [springsof_s, springsof_r] = [value, once].map(|rate| rate.with_rows_times(self.tangent).packed());
        [
            sum::<V>([(value, 2.0), (value, 0.0)], [(once, &springsof_s), (value, &of_s)]),
            sum::<V>([(once, 2.0), (value, h)], [(twice, &springsof_s), (once, &of_s)]),
            sum::<V>([(twice, 2.0), (once, 2.0 * h)], [(twice, &springsof_r), (once, &of_r)]),
        ]
    }
}

/// Terms times their factors, less products with packed matrices.
#[inline(always)]
fn sum<V: Vector>(terms: [(&Square, f64); 2], products: [(&Square, &[[f64; WIDTH]]); 2]) -> Square {
    let mut out = Square::zeros(terms[0].0.size);
    for (term, factor) in terms {
        out.add(term, factor);
    }
    for (left, right) in products {
        out.add(&left.times::<V>(right, 0), -1.0);
    }
    out.mirror();
    out
}

for_each_path! {
    fn effects(damping: &DMatrix<f64>, regime: &Regime, dt: f64) -> [Square; 3] = effects_by_path
}

#[inline(always)]
fn effects_by_path<V: Vector>(damping: &DMatrix<f64>, regime: &Regime, dt: f64) -> [Square; 3] {
    let system = FullSystem::new(damping, regime);
    let halvings = libm::log2(regime.frequency * dt / BANDED_PHASE).ceil().max(0.0);
    let mut h = dt * libm::exp2(-halvings);
    let mut effects = system.by_series::<V>(h, regime.frequency * h);
    for _ in 0..halvings as usize {
        effects = system.doubled::<V>(&effects, h);
        h *= 2.0;
    }
    effects
}

impl FullStep {
    /// The step of a regime over `dt` with a damping matrix.
    pub(crate) fn new(model: &Model, damping: &DMatrix<f64>, regime: &Regime, dt: f64) -> Self {
        let [value, once, twice] = effects(damping, regime, dt);
        let entry = |i: usize, j: usize| [&value, &once, &twice].map(|matrix| matrix.column(j)[i]);
        Self { effects: Symmetric::new(model.storeys(), entry), of_ground: of_ground(model, regime, dt) }
    }

    /// Memory taken (bytes).
    pub(crate) fn bytes(&self) -> usize {
        self.effects.bytes() + 8 * self.of_ground.iter().map(Vec::len).sum::<usize>()
    }

    /// Forms (dx - h v, dv) from [`Shears`] and the ground's acceleration and slope at the start.
    #[inline(always)]
    pub(crate) fn advance<V: Vector>(&self, shears: &Shears, ground: [f64; 2], dx: &mut [f64], dv: &mut [f64]) {
        self.effects.multiply_pairs::<V>(&shears.inertia, &shears.rate, dv, dx);
        let [jump, slope] = [V::splat(-ground[0]), V::splat(-ground[1])];
        let lanes = |which: usize| self.of_ground[which].as_chunks::<WIDTH>().0;
        let out = dx.as_chunks_mut::<WIDTH>().0.iter_mut().zip(dv.as_chunks_mut::<WIDTH>().0);
        for ((dx, dv), ((once, twice), thrice)) in out.zip(lanes(0).iter().zip(lanes(1)).zip(lanes(2))) {
            let (once, twice, thrice) = (V::load(once), V::load(twice), V::load(thrice));
            twice.mul_add(jump, thrice.mul_add(slope, V::load(dx))).store(dx);
            once.mul_add(jump, twice.mul_add(slope, V::load(dv))).store(dv);
        }
    }
}

/// First, second and third integrals of q over `dt` after the lowest floor's acceleration against the ground has jumped
/// by one, padded: by series over steps that are short enough.
fn of_ground(model: &Model, regime: &Regime, dt: f64) -> [Vec<f64>; 3] {
    let n = model.storeys();
    let zero = vec![0.0; n];
    let steps = (regime.frequency * dt / BANDED_PHASE).ceil().max(1.0);
    let h = dt / steps;
    let mut integrals = [zero.clone(), zero.clone(), zero.clone()];
    let (mut q, mut a) = (zero.clone(), zero.clone());
    q[0] = 1.0;
    regime.accelerations(model, &zero, &q, &zero, &mut a);
    let mut rate = differences(&a);
    for _ in 0..steps as usize {
        // Integrals from the start on grow with those before the step.
        for i in 0..n {
            integrals[2][i] += h * (integrals[1][i] + 0.5 * h * integrals[0][i]);
            integrals[1][i] += h * integrals[0][i];
        }
        let (mut value, mut of_value) =
            (std::mem::replace(&mut q, zero.clone()), std::mem::replace(&mut rate, zero.clone()));
        let mut size = 1.0;
        for k in 0.. {
            let [once, twice, thrice] = [1, 2, 3].map(|places| h / (k + places) as f64);
            for i in 0..n {
                q[i] += value[i];
                rate[i] += of_value[i];
                integrals[0][i] += once * value[i];
                integrals[1][i] += once * twice * value[i];
                integrals[2][i] += once * twice * thrice * value[i];
            }
            if size <= BELOW_ROUNDING {
                break;
            }
            size *= regime.frequency * once;
            regime.accelerations(model, &value, &of_value, &zero, &mut a);
            value = of_value.iter().map(|rate| once * rate).collect();
            of_value = differences(&a).iter().map(|change| once * change).collect();
        }
    }
    integrals.map(|values| filled_to(whole_blocks(n), values, 0.0))
}

/// Differences between neighbours; the first is from zero.
fn differences(values: &[f64]) -> Vec<f64> {
    let below = std::iter::once(&0.0).chain(values);
    values.iter().zip(below).map(|(value, below)| value - below).collect()
}

/// What [`FullStep`] acts on, padded to whole blocks: s and r of the storeys at the start of a step, without the motion
/// of the ground.
pub(crate) struct Shears {
    mass: Vec<f64>,
    tangent: Vec<f64>,
    inertia: Vec<f64>,
    rate: Vec<f64>,
}

impl Shears {
    pub(crate) fn new(regime: &Regime, storeys: usize) -> Self {
        let length = whole_blocks(storeys);
        let row = |row: Row| filled_to(length, regime.row(row)[..storeys].iter().copied(), 0.0);
        let (inertia, rate) = (vec![0.0; length], vec![0.0; length]);
        Self { mass: row(Row::Mass), tangent: row(Row::Tangent), inertia, rate }
    }

    /// Forms them from floor accelerations, drift rates, and slopes of the floor loads.
    #[inline(always)]
    pub(crate) fn form<V: Vector>(&mut self, a: &[f64], v: &[f64], load_slope: Option<&[f64]>) {
        let lanes = |values| <[f64]>::as_chunks::<WIDTH>(values).0;
        let zero = V::splat(0.0);
        let floors = lanes(&self.mass).iter().zip(lanes(a));
        let mut above = zero;
        for (out, (mass, a)) in self.inertia.as_chunks_mut::<WIDTH>().0.iter_mut().zip(floors).rev() {
            let sums = suffix_sums(V::load(mass).mul(V::load(a)), above);
            sums.store(out);
            above = sums.broadcast(0);
        }
        let storeys = lanes(&self.tangent).iter().zip(lanes(v));
        let mut loads = zero;
        let rates = self.rate.as_chunks_mut::<WIDTH>().0.iter_mut().zip(storeys).enumerate();
        for (k, (out, (tangent, v))) in rates.rev() {
            if let Some(slope) = load_slope {
                loads = suffix_sums(V::load(&lanes(slope)[k]), loads.broadcast(0));
            }
            loads.sub(V::load(tangent).mul(V::load(v))).store(out);
        }
    }
}

/// Sums of each lane and all above it, and of what is `above` them all.
#[inline(always)]
fn suffix_sums<V: Vector>(values: V, above: V) -> V {
    let zero = V::splat(0.0);
    let pairs = values.add(values.shifted_down(zero));
    pairs.add(pairs.shifted_down(zero).shifted_down(zero)).add(above)
}
