//! The step of a regime of at most a vector's storeys, formed with one floor per vector: lanes are columns, so that neither
//! recursion nor operator needs shifts or sums within vectors.

use crate::lanes::{Vector, WIDTH, columns_of, differences, load, numbers, unit};
use crate::model::Model;
use crate::regime::{Regime, Row};
use crate::taylor::{INVERSE, WEIGHTS};

/// Forces on `S` floors.
struct Operator<'a, const S: usize> {
    /// Of each storey or floor: tangent stiffness, 1 / mass, stiffness- and mass-proportional damping.
    coefficients: [[f64; 4]; S],
    full_damping: Option<&'a [[[f64; WIDTH]; 1]; S]>,
}

impl<'a, const S: usize> Operator<'a, S> {
    #[inline(always)]
    fn new(model: &'a Model, regime: &Regime) -> Self {
        let (tangent, inverse_mass) = (regime.row(Row::Tangent), regime.row(Row::InverseMass));
        let padded = |values: &[f64], i: usize| values.get(i).copied().unwrap_or(0.0);
        let (storey_damping, floor_damping) = (&model.lanes.storey_damping, &model.lanes.floor_damping);
        let mut coefficients = [[0.0; 4]; S];
        for i in 0..S {
            coefficients[i] = [tangent[i], inverse_mass[i], padded(storey_damping, i), padded(floor_damping, i)];
        }
        Self { coefficients, full_damping: columns_of::<1>(&model.lanes.damping).first_chunk() }
    }

    /// Spring forces of storeys.
    #[inline(always)]
    fn springs<V: Vector>(&self, x: &[V; S]) -> [V; S] {
        let mut shear = [V::splat(0.0); S];
        for i in 0..S {
            shear[i] = V::splat(self.coefficients[i][0]).mul(x[i]);
        }
        shear
    }

    /// Forces on floors of storeys with these spring forces and drift rates.
    #[inline(always)]
    fn forces<V: Vector>(&self, mut shear: [V; S], v: &[V; S]) -> [V; S] {
        let zero = V::splat(0.0);
        let (mut others, mut velocity) = ([zero; S], [zero; S]);
        if let Some(columns) = self.full_damping {
            // Two sums: half the latency of one.
            for j in 0..S {
                let sums = if j % 2 == 0 { &mut shear } else { &mut others };
                for i in 0..S {
                    sums[i] = V::splat(columns[j][0][i]).mul_add(v[j], sums[i]);
                }
            }
        } else {
            let mut below = zero;
            for i in 0..S {
                others[i] = V::splat(self.coefficients[i][2]).mul(v[i]);
                below = below.add(v[i]);
                velocity[i] = V::splat(self.coefficients[i][3]).mul(below);
            }
        }
        let mut forces = [zero; S];
        for i in 0..S {
            let above = if i + 1 < S { shear[i + 1].add(others[i + 1]) } else { zero };
            forces[i] = above.sub(shear[i].add(others[i])).sub(velocity[i]);
        }
        forces
    }

    /// Accelerations of a floor under a force.
    #[inline(always)]
    fn acceleration<V: Vector>(&self, i: usize, force: V) -> V {
        force.mul(V::splat(self.coefficients[i][1]))
    }
}

/// The series of unit drift accelerations and of unit rates of these over a step of length `h`, as terms of a table, and
/// their sums: see [`crate::propagator`].
#[inline(always)]
pub(crate) fn remainders<V: Vector, const S: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    order: usize,
    sums: &mut [f64],
    terms: &mut [f64],
) {
    let zero = V::splat(0.0);
    let operator = Operator::<S>::new(model, regime);
    let by_order = &mut terms.as_chunks_mut::<WIDTH>().0[..2 * S * (order - 1)];
    let (mut x, mut v) = ([[zero; S]; 2], [[zero; S]; 2]);
    (x[0], v[1]) = (units(), units());
    for (k, out) in by_order.chunks_exact_mut(2 * S).enumerate() {
        let (once, twice) = (V::splat(h * INVERSE[k + 1]), V::splat(h * h * (INVERSE[k + 1] * INVERSE[k + 2])));
        for set in 0..2 {
            let forces = operator.forces(operator.springs(&x[set]), &v[set]);
            let mut term = [zero; WIDTH];
            let mut below = zero;
            for i in 0..S {
                let a = operator.acceleration(i, forces[i]);
                term[i] = twice.mul(a);
                x[set][i] = once.mul(v[set][i]);
                v[set][i] = once.mul(a.sub(below));
                below = a;
            }
            let columns = V::transposed(term);
            for c in 0..S {
                columns[c].store(&mut out[set * S + c]);
            }
        }
    }
    // Terms of order k + 2 of the accelerations: drifts and drift rates are integrals of their differences.
    let [inside]: [V; 1] = load(&model.lanes.inside);
    let (length, per_second) = (V::splat(h), V::splat(1.0 / h));
    let pairs = sums.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<4>().0.as_chunks_mut::<2>().0;
    for (pair, out) in pairs.iter_mut().enumerate().take(S) {
        // Two columns at a time: once, twice, value, rate.
        let mut sums = [[zero; 4]; 2];
        for (terms, [order, once, twice]) in by_order.chunks_exact(2 * S).zip(&WEIGHTS[2..]) {
            let (order, once, twice) = (V::load(order), V::load(once), V::load(twice));
            for (sums, term) in sums.iter_mut().zip(&terms[2 * pair..]) {
                let term = V::load(term);
                sums[0] = once.mul_add(term, sums[0]);
                sums[1] = twice.mul_add(term, sums[1]);
                sums[2] = sums[2].add(term);
                sums[3] = order.mul_add(term, sums[3]);
            }
        }
        for ([once, twice, value, rate], (which, out)) in sums.into_iter().zip(out.iter_mut().enumerate()) {
            let column = 2 * pair + which;
            let [unit] = unit(column % S);
            // Of a unit of q its integrals, of a unit of its rate the next.
            let (first, second) = if column < S { (h, 0.5 * h * h) } else { (0.5 * h * h, h * h * h / 6.0) };
            let [of_rate] = differences(&[once], zero);
            let [of_drift] = differences(&[twice], zero);
            let of_rate = length.mul(of_rate).mul(inside);
            let of_drift = length.mul(length).mul(of_drift).mul(inside);
            V::splat(second).mul_add(unit, of_drift).store(&mut out[0]);
            V::splat(first).mul_add(unit, of_rate).store(&mut out[1]);
            value.store(&mut out[2]);
            per_second.mul(rate).store(&mut out[3]);
        }
    }
}

/// A unit in lane i of vector i.
#[inline(always)]
fn units<V: Vector, const S: usize>() -> [V; S] {
    let mut units = [V::splat(0.0); S];
    for i in 0..S {
        [units[i]] = unit(i);
    }
    units
}

/// What columns of a step are the effects of, a lane each: drift rates, forces on floors and their slopes, the ground
/// acceleration and its slope.
struct Causes<V, const S: usize> {
    v: [V; S],
    force: [V; S],
    slope: [V; S],
    ground: [V; 2],
}

/// The columns of a step of length `h` in their order, with the ramps of floor loads if there is room, from its remainders.
#[inline(always)]
pub(crate) fn columns<V: Vector, const S: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    sums: &[f64],
    out: &mut [f64],
) {
    let operator = Operator::<S>::new(model, regime);
    let Some((of_q, of_rate)) = columns_of::<4>(sums).split_at_checked(S) else { return };
    let (zero, still, units) = ([V::splat(0.0); S], [V::splat(0.0); 2], units::<V, S>());
    let of_springs = operator.forces(operator.springs(&units), &zero);
    let of_damping = operator.forces(zero, &units);
    let ([first], [second]) = (unit(0), unit(1));
    let sets = [
        (S, Causes { v: zero, force: of_springs, slope: zero, ground: still }),
        (S, Causes { v: units, force: of_damping, slope: of_springs, ground: still }),
        (2, Causes { v: zero, force: zero, slope: zero, ground: [first, second] }),
        (S, Causes { v: zero, force: units, slope: zero, ground: still }),
        (S, Causes { v: zero, force: zero, slope: units, ground: still }),
    ];
    let mut columns = out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<4>().0;
    for (count, Causes { v, force, slope, ground }) in &sets {
        let Some((of_set, others)) = std::mem::take(&mut columns).split_at_mut_checked(*count) else { return };
        columns = others;
        let (mut a, mut q) = ([V::splat(0.0); WIDTH], zero);
        let mut below = ground[0];
        for i in 0..S {
            a[i] = operator.acceleration(i, force[i]);
            q[i] = a[i].sub(below);
            below = a[i];
        }
        let of_damping = operator.forces(zero, &q);
        let (mut jerk, mut rate) = ([V::splat(0.0); WIDTH], zero);
        let mut below = ground[1];
        for i in 0..S {
            jerk[i] = operator.acceleration(i, of_damping[i].add(slope[i]));
            rate[i] = jerk[i].sub(below);
            below = jerk[i];
        }
        let mut velocity = [V::splat(0.0); WIDTH];
        velocity[..S].copy_from_slice(v);
        let (velocity, a, jerk) = (V::transposed(velocity), V::transposed(a), V::transposed(jerk));
        let (q, rate) = (numbers(&q), numbers(&rate));
        for (c, out) in of_set.iter_mut().enumerate() {
            let length = V::splat(h);
            let mut rows = [length.mul(velocity[c]), V::splat(0.0), length.mul_add(jerk[c], a[c]), jerk[c]];
            for (sums, weights) in [(of_q, &q), (of_rate, &rate)] {
                for i in 0..S {
                    let weight = V::splat(weights[i][c]);
                    for r in 0..4 {
                        rows[r] = V::load(&sums[i][r]).mul_add(weight, rows[r]);
                    }
                }
            }
            for r in 0..4 {
                rows[r].store(&mut out[r]);
            }
        }
    }
}
