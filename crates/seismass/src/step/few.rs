//! The step of a regime of few storeys, at most [`MAX_TABLE`](crate::step::steps::MAX_TABLE). The operator has the columns of
//! a floor in one or two vectors, lanes being columns; its products from the right have those of a column: neither needs
//! shifts or sums within vectors.

use crate::lanes::{Vector, WIDTH, columns_of, differences, load, numbers, unit};
use crate::machines::model::Model;
use crate::polynomial::orders::{INVERSE, WEIGHTS};
use crate::regime::{Regime, Row};

/// Forces on `S` floors, of `K` vectors.
pub(crate) struct FewOperator<'a, const S: usize, const K: usize> {
    /// Of each storey or floor: tangent stiffness, 1 / mass, stiffness- and mass-proportional damping.
    coefficients: [[f64; 4]; S],
    full_damping: Option<&'a [[[f64; WIDTH]; K]; S]>,
}

impl<'a, const S: usize, const K: usize> FewOperator<'a, S, K> {
    #[inline(always)]
    fn new(model: &'a Model, regime: &Regime) -> Self {
        let (tangent, inverse_mass) = (regime.row(Row::Tangent), regime.row(Row::InverseMass));
        let padded = |values: &[f64], i: usize| values.get(i).copied().unwrap_or(0.0);
        let (storey_damping, floor_damping) = (&model.lanes.storey_damping, &model.lanes.floor_damping);
        let mut coefficients = [[0.0; 4]; S];
        for i in 0..S {
            coefficients[i] = [tangent[i], inverse_mass[i], padded(storey_damping, i), padded(floor_damping, i)];
        }
        Self { coefficients, full_damping: columns_of::<K>(&model.lanes.damping).first_chunk() }
    }

    /// Spring forces of storeys.
    #[inline(always)]
    fn springs<V: Vector>(&self, x: &[[V; K]; S]) -> [[V; K]; S] {
        let mut shear = [[V::splat(0.0); K]; S];
        for i in 0..S {
            for k in 0..K {
                shear[i][k] = V::splat(self.coefficients[i][0]).mul(x[i][k]);
            }
        }
        shear
    }

    /// Forces on floors of storeys with these spring forces and drift rates.
    #[inline(always)]
    fn forces<V: Vector>(&self, mut shear: [[V; K]; S], v: &[[V; K]; S]) -> [[V; K]; S] {
        let zero = V::splat(0.0);
        let (mut others, mut velocity) = ([[zero; K]; S], [[zero; K]; S]);
        if let Some(columns) = self.full_damping {
            // Two sums: half the latency of one.
            for j in 0..S {
                let sums = if j % 2 == 0 { &mut shear } else { &mut others };
                for i in 0..S {
                    for k in 0..K {
                        sums[i][k] = V::splat(columns[j].as_flattened()[i]).mul_add(v[j][k], sums[i][k]);
                    }
                }
            }
        } else {
            let mut below = [zero; K];
            for i in 0..S {
                for k in 0..K {
                    others[i][k] = V::splat(self.coefficients[i][2]).mul(v[i][k]);
                    below[k] = below[k].add(v[i][k]);
                    velocity[i][k] = V::splat(self.coefficients[i][3]).mul(below[k]);
                }
            }
        }
        let mut forces = [[zero; K]; S];
        for i in 0..S {
            for k in 0..K {
                let above = if i + 1 < S { shear[i + 1][k].add(others[i + 1][k]) } else { zero };
                forces[i][k] = above.sub(shear[i][k].add(others[i][k])).sub(velocity[i][k]);
            }
        }
        forces
    }

    /// Accelerations of a floor under a force.
    #[inline(always)]
    fn acceleration<V: Vector>(&self, i: usize, force: V) -> V {
        force.mul(V::splat(self.coefficients[i][1]))
    }
}

/// What is linear in drift accelerations and their rates, as a column each: of unit drift accelerations, of unit rates.
type FewColumns<const S: usize, const K: usize> = [[[[f64; WIDTH]; K]; S]; 2];

/// The homogeneous system over a step: rows of its length times the second derivatives of drift accelerations, of unit
/// drift accelerations and of unit rates of these.
struct Homogeneous<V, const S: usize, const K: usize> {
    length: V,
    rows: FewColumns<S, K>,
}

impl<V: Vector, const S: usize, const K: usize> Homogeneous<V, S, K> {
    /// The system over `h`, and the second derivatives of the floor accelerations.
    #[inline(always)]
    fn new(operator: &FewOperator<S, K>, h: f64) -> (Self, FewColumns<S, K>) {
        let (zero, units) = ([[V::splat(0.0); K]; S], units::<V, S, K>());
        let forces = [operator.forces(operator.springs(&units), &zero), operator.forces(zero, &units)];
        let length = V::splat(h);
        let (mut rows, mut columns) = ([[[[0.0; WIDTH]; K]; S]; 2], [[[[0.0; WIDTH]; K]; S]; 2]);
        for set in 0..2 {
            for k in 0..K {
                let mut below = V::splat(0.0);
                for floors in 0..K {
                    let mut a = [V::splat(0.0); WIDTH];
                    for i in WIDTH * floors..S.min(WIDTH * (floors + 1)) {
                        let acceleration = operator.acceleration(i, forces[set][i][k]);
                        length.mul(acceleration.sub(below)).store(&mut rows[set][i][k]);
                        below = acceleration;
                        a[i % WIDTH] = acceleration;
                    }
                    let turned = V::transposed(a);
                    for c in WIDTH * k..S.min(WIDTH * (k + 1)) {
                        turned[c % WIDTH].store(&mut columns[set][c][floors]);
                    }
                }
            }
        }
        (Self { length, rows }, columns)
    }

    /// The step's length times the time derivative of what is linear in the state, its product with the system's matrix:
    /// vector `k` of the columns of storey `c`.
    #[inline(always)]
    fn derivative(&self, [of_q, of_rate]: &FewColumns<S, K>, c: usize, k: usize) -> [V; 2] {
        // Spring forces reach the storeys next to theirs.
        let (from, to) = (c.saturating_sub(1), (c + 2).min(S));
        let mut of_drift = V::splat(self.rows[0][from].as_flattened()[c]).mul(V::load(&of_rate[from][k]));
        for i in from + 1..to {
            let factor = V::splat(self.rows[0][i].as_flattened()[c]);
            of_drift = factor.mul_add(V::load(&of_rate[i][k]), of_drift);
        }
        let mut of_rates = self.length.mul(V::load(&of_q[c][k]));
        for i in 0..S {
            let factor = V::splat(self.rows[1][i].as_flattened()[c]);
            of_rates = factor.mul_add(V::load(&of_rate[i][k]), of_rates);
        }
        [of_drift, of_rates]
    }

    /// The derivative of one and another times a factor.
    #[inline(always)]
    fn with_derivative(&self, factor: f64, other: &FewColumns<S, K>, of: &FewColumns<S, K>) -> FewColumns<S, K> {
        let mut out = [[[[0.0; WIDTH]; K]; S]; 2];
        for c in 0..S {
            for k in 0..K {
                let derivative = self.derivative(of, c, k);
                for set in 0..2 {
                    let other = V::load(&other[set][c][k]);
                    V::splat(factor).mul_add(other, derivative[set]).store(&mut out[set][c][k]);
                }
            }
        }
        out
    }
}

/// The series of unit drift accelerations and of unit rates of these over a step of length `h`, as terms of a table, and
/// their sums: see [`crate::step::dense`].
///
/// What is linear in the state is differentiated by a product with the system's matrix from the right: each term
/// follows from the one before by few products of columns, and of sums the second integrals alone are summed up, for a
/// series less its first term is `h` times the derivative of its integral.
#[inline(always)]
pub(crate) fn remainders<V: Vector, const S: usize, const K: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    order: usize,
    sums: &mut [f64],
    terms: &mut [f64],
) {
    let (system, accelerations) = Homogeneous::<V, S, K>::new(&FewOperator::new(model, regime), h);
    let terms = terms.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0.as_chunks_mut::<S>().0.as_chunks_mut::<2>().0;
    let Some((first, others)) = terms[..order - 1].split_first_mut() else { return };
    let mut twice = [[[V::splat(0.0); K]; S]; 2];
    for set in 0..2 {
        for c in 0..S {
            for k in 0..K {
                let term = V::splat(0.5 * h * h).mul(V::load(&accelerations[set][c][k]));
                term.store(&mut first[set][c][k]);
                twice[set][c][k] = V::load(&WEIGHTS[2][2]).mul(term);
            }
        }
    }
    let mut before = &*first;
    for (out, (weights, inverse)) in others.iter_mut().zip(WEIGHTS[3..].iter().zip(&INVERSE[3..])) {
        let weight = V::load(&weights[2]);
        for c in 0..S {
            for k in 0..K {
                let derivative = system.derivative(before, c, k);
                for set in 0..2 {
                    let term = V::splat(*inverse).mul(derivative[set]);
                    term.store(&mut out[set][c][k]);
                    twice[set][c][k] = weight.mul_add(term, twice[set][c][k]);
                }
            }
        }
        before = out;
    }
    let mut of_twice = [[[[0.0; WIDTH]; K]; S]; 2];
    for set in 0..2 {
        for c in 0..S {
            of_twice[set][c] = numbers(&twice[set][c]);
        }
    }
    // Terms of order k + 2 of the accelerations: drifts and drift rates are integrals of their differences.
    let once = system.with_derivative(1.0 / 3.0, first, &of_twice);
    let value = system.with_derivative(1.0, first, &once);
    let rate = system.with_derivative(2.0, first, &value);
    let inside: [V; K] = load(&model.lanes.inside);
    let (zero, length, per_second) = (V::splat(0.0), V::splat(h), V::splat(1.0 / h));
    // Of a unit of q its integrals, of a unit of its rate the next.
    let of_unit = [[0.5 * h * h, h], [h * h * h / 6.0, 0.5 * h * h]];
    let columns = sums.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0.as_chunks_mut::<4>().0;
    for (set, columns) in columns.chunks_exact_mut(S).take(2).enumerate() {
        for (c, out) in columns.iter_mut().enumerate() {
            let unit: [V; K] = unit(c);
            let of_once: [V; K] = load(once[set][c].as_flattened());
            let (of_rate, of_drift) = (differences(&of_once, zero), differences(&twice[set][c], zero));
            for k in 0..K {
                let of_rate = length.mul(of_rate[k]).mul(inside[k]);
                let of_drift = length.mul(length).mul(of_drift[k]).mul(inside[k]);
                V::splat(of_unit[set][0]).mul_add(unit[k], of_drift).store(&mut out[0][k]);
                V::splat(of_unit[set][1]).mul_add(unit[k], of_rate).store(&mut out[1][k]);
                out[2][k] = value[set][c][k];
                per_second.mul(V::load(&rate[set][c][k])).store(&mut out[3][k]);
            }
        }
    }
}

/// A unit in lane i of the vectors i.
#[inline(always)]
fn units<V: Vector, const S: usize, const K: usize>() -> [[V; K]; S] {
    let mut units = [[V::splat(0.0); K]; S];
    for i in 0..S {
        units[i] = unit(i);
    }
    units
}

/// The columns of a step of length `h` in their order, with the ramps of floor loads if there is room, from its remainders.
///
/// A row is linear in drift accelerations and their rates, in drift rates and drift accelerations, and in drifts and drift
/// rates: each by the derivative of the one before, and what the first orders add to it.
#[inline(always)]
pub(crate) fn columns<V: Vector, const S: usize, const K: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    sums: &[f64],
    out: &mut [f64],
) {
    let operator = FewOperator::new(model, regime);
    let (system, accelerations) = Homogeneous::<V, S, K>::new(&operator, 1.0);
    let (zero, units) = (V::splat(0.0), units::<V, S, K>());
    let (of_q, of_rate) = columns_of::<K>(sums).as_chunks::<4>().0[..2 * S].split_at(S);
    let columns = out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0.as_chunks_mut::<4>().0;
    let (of_state, others) = columns.split_at_mut(2 * S);
    let (of_motion, others) = others.split_at_mut(2);
    let (of_loads, of_ramps) = others.split_at_mut(S);
    // Parts of drift rates, of accelerations and of their rates in rows (dx, dv, a, j).
    for (r, [of_v, of_a, of_j]) in [[h, 0.0, 0.0], [0.0; 3], [0.0, 1.0, h], [0.0, 0.0, 1.0]].into_iter().enumerate() {
        let mut second = [[[[0.0; WIDTH]; K]; S]; 2];
        for c in 0..S {
            (second[0][c], second[1][c]) = (of_q[c][r], of_rate[c][r]);
        }
        let mut first = system.with_derivative(of_j, &accelerations, &second);
        for c in 0..S {
            for k in 0..K {
                V::splat(of_v).mul_add(units[c][k], V::load(&first[0][c][k])).store(&mut first[0][c][k]);
            }
        }
        let state = system.with_derivative(of_a, &accelerations, &first);
        for c in 0..S {
            (of_state[c][r], of_state[S + c][r]) = (state[0][c], state[1][c]);
        }
        for k in 0..K {
            // The ground moves the lowest storey alone, a floor its own and that above.
            zero.sub(V::load(&first[1][0][k])).store(&mut of_motion[0][r][k]);
            zero.sub(V::load(&second[1][0][k])).store(&mut of_motion[1][r][k]);
            for (of_storeys, part, columns) in [(&first[1], of_a, &mut *of_loads), (&second[1], of_j, &mut *of_ramps)] {
                for (c, out) in columns.iter_mut().enumerate() {
                    let above = if c + 1 < S { V::load(&of_storeys[c + 1][k]) } else { zero };
                    let force = V::splat(part).mul_add(units[c][k], V::load(&of_storeys[c][k]).sub(above));
                    operator.acceleration(c, force).store(&mut out[r][k]);
                }
            }
        }
    }
}
