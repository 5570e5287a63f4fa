//! The exact steps of a regime, formed once: over one whole sample interval, and as tables of its Taylor series.
//!
//! Within an interval, floor accelerations are linear in drifts and drift rates, and loads are linear in time; so from
//! the second order on everything is linear in the drift accelerations q and their rates alone, which obey the
//! homogeneous system. Its series of unit vectors give all: summed, the step of a whole interval; kept, tables that make
//! of a series independent products in place of a chain. An interval too long for one series is halved until it is
//! short enough, and the step composed with itself.

use crate::lanes::{
    Aligned, Vector, WIDTH, by_dense_width, columns_of, differences, for_each_path, load, numbers, store, unit,
};
use crate::machines::model::Model;
use crate::polynomial::orders::INVERSE;
use crate::regime::{Regime, RegimeOperator};
use crate::step::few;

/// The step of a regime over one sample interval, acting on rows (dx, dv, a, j): changes of drifts and drift rates,
/// floor accelerations and their rates at the end, each padded to whole vectors.
pub(crate) struct Propagator {
    pub(crate) storeys: usize,
    pub(crate) rows: usize,
    /// Columns, one after the other: of the state (x, v); of a constant ground acceleration and of one that grows from
    /// zero by one per interval; of constant floor loads; where vertical motion needs them, of floor loads that grow from
    /// zero by one per interval.
    pub(crate) columns: Aligned,
}

/// What a column of the step is the effect of, all else being zero.
#[derive(Clone, Copy)]
pub(crate) enum ColumnCause {
    Drift(usize),
    DriftRate(usize),
    Load(usize),
    /// A floor load that grows from zero by one per second.
    Ramp(usize),
    Ground,
    /// A ground acceleration that grows from zero by one per second.
    GroundRamp,
}

impl ColumnCause {
    /// Of a column of a step of `n` storeys.
    #[inline(always)]
    pub(crate) fn of(column: usize, n: usize) -> Self {
        match column.checked_sub(2 * n) {
            None if column < n => Self::Drift(column),
            None => Self::DriftRate(column - n),
            Some(0) => Self::Ground,
            Some(1) => Self::GroundRamp,
            Some(load) if load < n + 2 => Self::Load(load - 2),
            Some(ramp) => Self::Ramp(ramp - n - 2),
        }
    }
}

/// Columns of a step of `n` storeys, with the ramps of floor loads or without.
pub(crate) fn column_count(n: usize, with_ramps: bool) -> usize {
    if with_ramps { 4 * n + 2 } else { 3 * n + 2 }
}

for_each_path! {
    /// What a step of length `h` adds to (dx, dv, a, j) beyond the first order, of unit drift accelerations and of unit
    /// rates of these: `sums` gets columns of four padded rows. `terms` gets those of a
    /// [`SeriesTable`](crate::step::table::SeriesTable), if it has room.
    pub(crate) fn form_remainders(model: &Model, regime: &Regime, h: f64, order: usize, sums: &mut [f64], terms: &mut [f64])
        = remainders_by_width
}

#[inline(always)]
fn remainders_by_width<V: Vector>(
    model: &Model,
    regime: &Regime,
    h: f64,
    order: usize,
    sums: &mut [f64],
    terms: &mut [f64],
) {
    match model.storeys() {
        1 => few::remainders::<V, 1, 1>(model, regime, h, order, sums, terms),
        2 => few::remainders::<V, 2, 1>(model, regime, h, order, sums, terms),
        3 => few::remainders::<V, 3, 1>(model, regime, h, order, sums, terms),
        4 => few::remainders::<V, 4, 1>(model, regime, h, order, sums, terms),
        #[cfg(feature = "tall-buildings")]
        5 => few::remainders::<V, 5, 2>(model, regime, h, order, sums, terms),
        #[cfg(feature = "tall-buildings")]
        6 => few::remainders::<V, 6, 2>(model, regime, h, order, sums, terms),
        #[cfg(feature = "tall-buildings")]
        7 => few::remainders::<V, 7, 2>(model, regime, h, order, sums, terms),
        #[cfg(feature = "tall-buildings")]
        8 => few::remainders::<V, 8, 2>(model, regime, h, order, sums, terms),
        _ => by_dense_width!(model.width, K => remainders::<V, K>(model, regime, h, order, sums, terms)),
    }
}

/// [`form_remainders`] storey by storey: the series of (q, q') = unit vectors, as drifts and drift rates of the homogeneous
/// system, whose accelerations then are the second derivatives of the floor accelerations.
#[inline(always)]
fn remainders<V: Vector, const K: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    order: usize,
    sums: &mut [f64],
    terms: &mut [f64],
) {
    let (n, width) = (model.storeys(), WIDTH * K);
    let operator = RegimeOperator::<V, K>::new(model, regime);
    let zero = [V::splat(0.0); K];
    let inside: [V; K] = load(&model.lanes.inside);
    let keeps_terms = !terms.is_empty();
    for storey in 0..n {
        let (mut x, mut v) = ([unit(storey), zero], [zero, unit(storey)]);
        let mut floors = [zero, operator.floor_velocities(&v[1])];
        let places = [storey, n + storey];
        let mut rows = [[zero; 4]; 2];
        for k in 0..=order {
            let (once, twice) = (h * INVERSE[k + 1], h * h * (INVERSE[k + 1] * INVERSE[k + 2]));
            let (once, twice) = (V::splat(once), V::splat(twice));
            for column in 0..2 {
                let a = operator.accelerations(&x[column], &v[column], &floors[column], zero);
                let drift_acceleration = differences(&a, V::splat(0.0));
                let mut term = zero;
                for l in 0..K {
                    let rows = &mut rows[column];
                    term[l] = twice.mul(a[l]);
                    rows[0][l] = twice.mul_add(x[column][l], rows[0][l]);
                    rows[1][l] = once.mul_add(x[column][l], rows[1][l]);
                    rows[2][l] = rows[2][l].add(term[l]);
                    rows[3][l] = once.mul_add(a[l], rows[3][l]);
                    x[column][l] = once.mul(v[column][l]);
                    v[column][l] = once.mul(drift_acceleration[l]).mul(inside[l]);
                    floors[column][l] = once.mul(a[l]);
                }
                if keeps_terms && k + 2 <= order {
                    store(&term, &mut terms[(2 * n * k + places[column]) * width..]);
                }
            }
        }
        for column in 0..2 {
            let out = &mut sums[4 * places[column] * width..];
            for r in 0..4 {
                store(&rows[column][r], &mut out[r * width..]);
            }
        }
    }
}

for_each_path! {
    /// Forms the columns over a step of length `h`, whose remainders are `sums`: rows (dx, dv, a, j).
    pub(crate) fn form_columns(model: &Model, regime: &Regime, h: f64, sums: &[f64], out: &mut [f64])
        = columns_by_width
}

#[inline(always)]
fn columns_by_width<V: Vector>(model: &Model, regime: &Regime, h: f64, sums: &[f64], out: &mut [f64]) {
    match model.storeys() {
        1 => few::columns::<V, 1, 1>(model, regime, h, sums, out),
        2 => few::columns::<V, 2, 1>(model, regime, h, sums, out),
        3 => few::columns::<V, 3, 1>(model, regime, h, sums, out),
        4 => few::columns::<V, 4, 1>(model, regime, h, sums, out),
        #[cfg(feature = "tall-buildings")]
        5 => few::columns::<V, 5, 2>(model, regime, h, sums, out),
        #[cfg(feature = "tall-buildings")]
        6 => few::columns::<V, 6, 2>(model, regime, h, sums, out),
        #[cfg(feature = "tall-buildings")]
        7 => few::columns::<V, 7, 2>(model, regime, h, sums, out),
        #[cfg(feature = "tall-buildings")]
        8 => few::columns::<V, 8, 2>(model, regime, h, sums, out),
        _ => by_dense_width!(model.width, K => columns::<V, K>(model, regime, h, sums, out)),
    }
}

/// [`form_columns`] one after the other.
#[inline(always)]
fn columns<V: Vector, const K: usize>(model: &Model, regime: &Regime, h: f64, sums: &[f64], out: &mut [f64]) {
    let operator = RegimeOperator::<V, K>::new(model, regime);
    let (sums_of_q, sums_of_rate) =
        columns_of::<K>(sums).as_chunks::<4>().0[..2 * model.storeys()].split_at(model.storeys());
    let columns = out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0.as_chunks_mut::<4>().0;
    for (column, out) in columns.iter_mut().enumerate() {
        let zero = [V::splat(0.0); K];
        let (mut x, mut v, mut force, mut slope, mut ground, mut ground_slope) = (zero, zero, zero, zero, 0.0, 0.0);
        match ColumnCause::of(column, model.storeys()) {
            ColumnCause::Drift(i) => x = unit(i),
            ColumnCause::DriftRate(i) => v = unit(i),
            ColumnCause::Load(i) => force = unit(i),
            ColumnCause::Ramp(i) => slope = unit(i),
            ColumnCause::Ground => ground = 1.0,
            ColumnCause::GroundRamp => ground_slope = 1.0,
        }
        let a = operator.accelerations(&x, &v, &operator.floor_velocities(&v), force);
        let (q, mut floors) = (differences(&a, V::splat(ground)), a);
        for k in 0..K {
            floors[k] = a[k].sub(V::splat(ground));
        }
        let jerk = operator.accelerations(&v, &q, &floors, slope);
        let rate = differences(&jerk, V::splat(ground_slope));
        let mut rows = [zero; 4];
        for k in 0..K {
            rows[0][k] = V::splat(h).mul(v[k]);
            rows[2][k] = V::splat(h).mul_add(jerk[k], a[k]);
            rows[3][k] = jerk[k];
        }
        for (sums, weights) in [(sums_of_q, numbers(&q)), (sums_of_rate, numbers(&rate))] {
            for (sums, &weight) in sums.iter().zip(weights.as_flattened()) {
                let weight = V::splat(weight);
                for r in 0..4 {
                    for k in 0..K {
                        rows[r][k] = V::load(&sums[r][k]).mul_add(weight, rows[r][k]);
                    }
                }
            }
        }
        for r in 0..4 {
            out[r] = numbers(&rows[r]);
        }
    }
}

for_each_path! {
    /// The step taken twice: its columns, of changes of drifts and drift rates over `h`, each padded to whole vectors. Ramps
    /// are per second.
    pub(crate) fn doubled(changes: &[f64], storeys: usize, width: usize, h: f64) -> Vec<f64> = doubled_by_width
}

#[inline(always)]
fn doubled_by_width<V: Vector>(changes: &[f64], storeys: usize, width: usize, h: f64) -> Vec<f64> {
    by_dense_width!(width, K => doubled_columns::<V, K>(changes, storeys, h))
}

#[inline(always)]
fn doubled_columns<V: Vector, const K: usize>(changes: &[f64], n: usize, h: f64) -> Vec<f64> {
    let mut out = vec![0.0; changes.len()];
    let columns = columns_of::<K>(changes).as_chunks::<2>().0;
    let columns_out = out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0.as_chunks_mut::<2>().0;
    for (c, (column, out)) in columns.iter().zip(columns_out).enumerate() {
        let mut sums = [[V::splat(0.0); K]; 2];
        let mut add = |column: &[[[f64; WIDTH]; K]; 2], weight: f64| {
            let weight = V::splat(weight);
            for r in 0..2 {
                for k in 0..K {
                    sums[r][k] = V::load(&column[r][k]).mul_add(weight, sums[r][k]);
                }
            }
        };
        // What the first half changes in the state goes on in the second, and a ramp is at `h` there.
        let [of_drifts, of_rates] = column.each_ref().map(|rows| &rows.as_flattened()[..n]);
        for (state, &weight) in columns.iter().zip(of_drifts.iter().chain(of_rates)) {
            add(state, weight);
        }
        match ColumnCause::of(c, n) {
            ColumnCause::GroundRamp => add(&columns[c - 1], h),
            ColumnCause::Ramp(_) => add(&columns[c - n], h),
            _ => {}
        }
        add(column, 2.0);
        for r in 0..2 {
            out[r] = numbers(&sums[r]);
        }
    }
    out
}

impl Propagator {
    /// Columns of constant floor loads, one after the other.
    #[inline(always)]
    pub(crate) fn load_columns(&self) -> &[f64] {
        let first = 2 * self.storeys + 2;
        self.columns.get(first * self.rows..(first + self.storeys) * self.rows).unwrap_or(&[])
    }

    /// Columns of floor loads that grow from zero by one per interval; none where vertical motion has not asked for them.
    #[inline(always)]
    pub(crate) fn ramp_columns(&self) -> &[f64] {
        self.columns.get(column_count(self.storeys, false) * self.rows..).unwrap_or(&[])
    }

    /// Columns of the state (x, v), one after the other, and those of the motion after them: of a constant ground
    /// acceleration, and of one that grows from zero by one.
    #[inline(always)]
    pub(crate) fn state_and_motion_columns(&self) -> &[f64] {
        &self.columns
    }
}

/// Forms the rows (dx, dv, a, j) of a column from its change of the state over `h`: dx and dv, each padded.
pub(crate) fn column_of_change(
    model: &Model,
    regime: &Regime,
    cause: ColumnCause,
    change: &[f64],
    h: f64,
    out: &mut [f64],
) {
    let n = model.storeys();
    let [dx, dv] = [0, model.width].map(|first| &change[first..first + n]);
    let (mut x, mut v) = (dx.to_vec(), dv.to_vec());
    let (mut load, mut slope, mut ground) = (vec![0.0; n], vec![0.0; n], 0.0);
    match cause {
        ColumnCause::Drift(i) => x[i] += 1.0,
        ColumnCause::DriftRate(i) => v[i] += 1.0,
        ColumnCause::Load(i) => load[i] = 1.0,
        ColumnCause::Ramp(i) => (load[i], slope[i]) = (h, 1.0),
        ColumnCause::Ground => ground = 1.0,
        ColumnCause::GroundRamp => ground = h,
    }
    let (mut a, mut jerk) = (vec![0.0; n], vec![0.0; n]);
    regime.accelerations(model, &x, &v, &load, &mut a);
    let mut below = ground;
    let drift_acceleration: Vec<f64> = a.iter().map(|&a| a - std::mem::replace(&mut below, a)).collect();
    regime.accelerations(model, &v, &drift_acceleration, &slope, &mut jerk);
    for (row, part) in out.chunks_exact_mut(model.width).zip([dx, dv, &a, &jerk]) {
        row[..n].copy_from_slice(part);
        row[n..].fill(0.0);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::sync::Arc;

    use super::*;
    use crate::lanes::Plain;
    use crate::scene::{Block, Building, Damping, GravityEffect, Scene, Storey};
    use crate::step::steps::MAX_TABLE;
    use crate::step::table::SeriesTable;

    /// A building of uneven floors and storeys, with P-Delta, and a block on each floor.
    fn uneven(n: usize, damping: Damping) -> Scene {
        let wave = |i: usize, step: f64| 1.0 + 0.8 * (step * (i + 1) as f64).sin();
        let mass: Vec<f64> = (0..n).map(|i| 1000.0 * wave(i, 2.1)).collect();
        let storeys = (0..n).map(|i| Storey::elastic(1e5 * wave(i, 1.3))).collect();
        let geometric = (0..n).map(|i| 3e3 * wave(i, 0.9)).collect();
        let building = Building::new(mass, storeys, damping).unwrap();
        let building = building.with_gravity(GravityEffect::GeometricStiffness(geometric)).unwrap();
        Scene::new(Some(Arc::new(building)), (1..=n).map(|floor| Block::new(floor, 700.0, 0.3)).collect()).unwrap()
    }

    fn are_close(found: &[f64], expected: &[f64], what: &str) {
        let largest = expected.iter().fold(0.0f64, |largest, value| largest.max(value.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= 1e-14 * largest, "{what}: {found:e} for {expected:e} of {largest:e}");
        }
    }

    /// Products from the right and from the left, and rows by derivatives and cause by cause.
    #[test]
    fn few_storeys_take_the_steps_of_many() {
        let dampings = [Damping::Modal { ratio: 0.05 }, Damping::Rayleigh { ratio: 0.03, modes: [1, 2] }];
        for (n, damping) in (1..=MAX_TABLE).flat_map(|n| dampings.clone().map(|damping| (n, damping))) {
            if n == 1 && matches!(damping, Damping::Rayleigh { .. }) {
                continue;
            }
            let model = Model::new(&uneven(n, damping.clone()));
            let width = model.width;
            let stuck: Vec<f64> = (0..n).map(|i| if i % 2 == 0 { 700.0 } else { 0.0 }).collect();
            let regime = Regime::new(&model, |i| model.laws[i].spring.law().largest_tangent(), &stuck);
            let (h, order) = (0.7 / regime.frequency, 14);
            let formed = |few: bool| {
                let mut sums = vec![0.0; 2 * n * 4 * width];
                let mut terms = vec![0.0; width * SeriesTable::columns(n, order)];
                let mut out = vec![0.0; column_count(n, true) * 4 * width];
                if few {
                    remainders_by_width::<Plain>(&model, &regime, h, order, &mut sums, &mut terms);
                    columns_by_width::<Plain>(&model, &regime, h, &sums, &mut out);
                } else {
                    by_dense_width!(width, K => {
                        remainders::<Plain, K>(&model, &regime, h, order, &mut sums, &mut terms);
                        columns::<Plain, K>(&model, &regime, h, &sums, &mut out);
                    });
                }
                [terms, out]
            };
            let ([terms, out], [expected_terms, expected_out]) = (formed(true), formed(false));
            let of_order = 2 * n * width;
            for (found, expected) in terms.chunks(of_order).zip(expected_terms.chunks(of_order)) {
                are_close(found, expected, &format!("terms of {n} storeys"));
            }
            for (c, (found, expected)) in
                out.chunks_exact(4 * width).zip(expected_out.chunks_exact(4 * width)).enumerate()
            {
                for (r, (found, expected)) in found.chunks(width).zip(expected.chunks(width)).enumerate() {
                    are_close(found, expected, &format!("{damping:?}, {n} storeys, column {c}, row {r}"));
                }
            }
        }
    }
}
