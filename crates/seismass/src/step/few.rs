//! The step of a regime of at most a vector's storeys. The operator has one floor per vector, lanes being columns; its
//! products from the right have one column per vector: neither needs shifts or sums within vectors.

use crate::lanes::{Vector, WIDTH, columns_of, differences, load, numbers, unit};
use crate::machines::model::Model;
use crate::polynomial::orders::{INVERSE, WEIGHTS};
use crate::regime::{Regime, Row};

/// Forces on `S` floors.
pub(crate) struct FewOperator<'a, const S: usize> {
    /// Of each storey or floor: tangent stiffness, 1 / mass, stiffness- and mass-proportional damping.
    coefficients: [[f64; 4]; S],
    full_damping: Option<&'a [[[f64; WIDTH]; 1]; S]>,
}

impl<'a, const S: usize> FewOperator<'a, S> {
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

/// What is linear in drift accelerations and their rates, as a column each: of unit drift accelerations, of unit rates.
type FewColumns<V, const S: usize> = [[V; S]; 2];

/// The homogeneous system over a step: rows of its length times the second derivatives of drift accelerations, of unit
/// drift accelerations and of unit rates of these.
struct Homogeneous<V, const S: usize> {
    length: V,
    rows: [[[f64; WIDTH]; S]; 2],
}

impl<V: Vector, const S: usize> Homogeneous<V, S> {
    /// The system over `h`, and the second derivatives of the floor accelerations.
    #[inline(always)]
    fn new(operator: &FewOperator<S>, h: f64) -> (Self, FewColumns<V, S>) {
        let (zero, units) = ([V::splat(0.0); S], units::<V, S>());
        let forces = [operator.forces(operator.springs(&units), &zero), operator.forces(zero, &units)];
        let length = V::splat(h);
        let (mut rows, mut columns) = ([[[0.0; WIDTH]; S]; 2], [zero; 2]);
        for set in 0..2 {
            let (mut a, mut q, mut below) = ([V::splat(0.0); WIDTH], zero, V::splat(0.0));
            for i in 0..S {
                a[i] = operator.acceleration(i, forces[set][i]);
                q[i] = length.mul(a[i].sub(below));
                below = a[i];
            }
            rows[set] = numbers(&q);
            columns[set].copy_from_slice(&V::transposed(a)[..S]);
        }
        (Self { length, rows }, columns)
    }

    /// The step's length times the time derivative of what is linear in the state: its product with the system's matrix.
    #[inline(always)]
    fn derivative(&self, [of_q, of_rate]: &FewColumns<V, S>) -> FewColumns<V, S> {
        let mut out = [*of_q, *of_q];
        for c in 0..S {
            // Spring forces reach the storeys next to theirs.
            let (from, to) = (c.saturating_sub(1), (c + 2).min(S));
            out[0][c] = V::splat(self.rows[0][from][c]).mul(of_rate[from]);
            for i in from + 1..to {
                out[0][c] = V::splat(self.rows[0][i][c]).mul_add(of_rate[i], out[0][c]);
            }
            out[1][c] = self.length.mul(of_q[c]);
            for i in 0..S {
                out[1][c] = V::splat(self.rows[1][i][c]).mul_add(of_rate[i], out[1][c]);
            }
        }
        out
    }

    /// The derivative of one and another times a factor.
    #[inline(always)]
    fn with_derivative(&self, factor: f64, other: &FewColumns<V, S>, of: &FewColumns<V, S>) -> FewColumns<V, S> {
        let mut out = self.derivative(of);
        for set in 0..2 {
            for c in 0..S {
                out[set][c] = V::splat(factor).mul_add(other[set][c], out[set][c]);
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
pub(crate) fn remainders<V: Vector, const S: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    order: usize,
    sums: &mut [f64],
    terms: &mut [f64],
) {
    let (system, mut term) = Homogeneous::<V, S>::new(&FewOperator::new(model, regime), h);
    for column in term.as_flattened_mut() {
        *column = V::splat(0.5 * h * h).mul(*column);
    }
    let (first, mut twice) = (term, [[V::splat(0.0); S]; 2]);
    let columns = terms.as_chunks_mut::<WIDTH>().0;
    for k in 0..order - 1 {
        let out = &mut columns[2 * S * k..][..2 * S];
        let weight = V::load(&WEIGHTS[k + 2][2]);
        for set in 0..2 {
            for c in 0..S {
                term[set][c].store(&mut out[set * S + c]);
                twice[set][c] = weight.mul_add(term[set][c], twice[set][c]);
            }
        }
        term = system.derivative(&term);
        for column in term.as_flattened_mut() {
            *column = V::splat(INVERSE[k + 3]).mul(*column);
        }
    }
    // Terms of order k + 2 of the accelerations: drifts and drift rates are integrals of their differences.
    let once = system.with_derivative(1.0 / 3.0, &first, &twice);
    let value = system.with_derivative(1.0, &first, &once);
    let rate = system.with_derivative(2.0, &first, &value);
    let [inside]: [V; 1] = load(&model.lanes.inside);
    let (zero, length, per_second) = (V::splat(0.0), V::splat(h), V::splat(1.0 / h));
    // Of a unit of q its integrals, of a unit of its rate the next.
    let of_unit = [[0.5 * h * h, h], [h * h * h / 6.0, 0.5 * h * h]];
    let columns = sums.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<4>().0;
    for (set, columns) in columns.chunks_exact_mut(S).take(2).enumerate() {
        for (c, out) in columns.iter_mut().enumerate() {
            let [unit] = unit(c);
            let [of_rate] = differences(&[once[set][c]], zero);
            let [of_drift] = differences(&[twice[set][c]], zero);
            let of_rate = length.mul(of_rate).mul(inside);
            let of_drift = length.mul(length).mul(of_drift).mul(inside);
            V::splat(of_unit[set][0]).mul_add(unit, of_drift).store(&mut out[0]);
            V::splat(of_unit[set][1]).mul_add(unit, of_rate).store(&mut out[1]);
            value[set][c].store(&mut out[2]);
            per_second.mul(rate[set][c]).store(&mut out[3]);
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

/// The columns of a step of length `h` in their order, with the ramps of floor loads if there is room, from its remainders.
///
/// A row is linear in drift accelerations and their rates, in drift rates and drift accelerations, and in drifts and drift
/// rates: each by the derivative of the one before, and what the first orders add to it.
#[inline(always)]
pub(crate) fn columns<V: Vector, const S: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    sums: &[f64],
    out: &mut [f64],
) {
    let operator = FewOperator::new(model, regime);
    let (system, accelerations) = Homogeneous::<V, S>::new(&operator, 1.0);
    let (zero, units) = (V::splat(0.0), units::<V, S>());
    let (of_q, of_rate) = columns_of::<4>(sums)[..2 * S].split_at(S);
    let columns = out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<4>().0;
    let (of_state, others) = columns.split_at_mut(2 * S);
    let (of_motion, others) = others.split_at_mut(2);
    let (of_loads, of_ramps) = others.split_at_mut(S);
    // Parts of drift rates, of accelerations and of their rates in rows (dx, dv, a, j).
    for (r, [of_v, of_a, of_j]) in [[h, 0.0, 0.0], [0.0; 3], [0.0, 1.0, h], [0.0, 0.0, 1.0]].into_iter().enumerate() {
        let mut second = [[zero; S]; 2];
        for c in 0..S {
            (second[0][c], second[1][c]) = (V::load(&of_q[c][r]), V::load(&of_rate[c][r]));
        }
        let mut first = system.with_derivative(of_j, &accelerations, &second);
        for c in 0..S {
            first[0][c] = V::splat(of_v).mul_add(units[c], first[0][c]);
        }
        let state = system.with_derivative(of_a, &accelerations, &first);
        for c in 0..S {
            state[0][c].store(&mut of_state[c][r]);
            state[1][c].store(&mut of_state[S + c][r]);
        }
        // The ground moves the lowest storey alone, a floor its own and that above.
        zero.sub(first[1][0]).store(&mut of_motion[0][r]);
        zero.sub(second[1][0]).store(&mut of_motion[1][r]);
        let of_floor = |c: usize, of_storeys: &[V; S], part: f64| {
            let above = if c + 1 < S { of_storeys[c + 1] } else { zero };
            operator.acceleration(c, V::splat(part).mul_add(units[c], of_storeys[c].sub(above)))
        };
        for (c, out) in of_loads.iter_mut().enumerate() {
            of_floor(c, &first[1], of_a).store(&mut out[r]);
        }
        for (c, out) in of_ramps.iter_mut().enumerate() {
            of_floor(c, &second[1], of_j).store(&mut out[r]);
        }
    }
}
