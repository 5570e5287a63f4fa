//! The exact steps of a regime, formed once: over one whole sample interval, and as tables of its Taylor series; and the
//! cache of regimes.
//!
//! Within an interval, floor accelerations are linear in drifts and drift rates, and loads are linear in time; so from
//! the second order on everything is linear in the drift accelerations q and their rates alone, which obey the
//! homogeneous system. Its series of unit vectors give all: summed, the step of a whole interval; kept, tables that make
//! of a series independent products in place of a chain. An interval too long for one series is halved until it is
//! short enough, and the step composed with itself.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rustc_hash::FxBuildHasher;

use crate::lanes::{
    Aligned, MAX_LANES, Vector, WIDTH, by_width, columns_of, differences, for_each_path, load, numbers, padded, store,
    unit,
};
use crate::model::Model;
use crate::regime::{Operator, Regime, Row};
use crate::tall_step::TallStep;
use crate::taylor::{INVERSE, MAX_PHASE, terms};

/// Memory one cache may take before it starts afresh (bytes).
const CACHE_BYTES: usize = 64 << 20;
/// Most storeys of which tables of the series are kept.
const MAX_TABLE: usize = 2 * WIDTH;
/// Most storeys for which steps and tables are formed at once: those of one vector. With more, most regimes of a strong
/// motion are left before they have paid for themselves.
const MAX_AT_ONCE: usize = WIDTH;

/// Most storeys for which one matrix without zeros is taken though a tall step would do.
const MAX_DENSE: usize = 16;
/// Largest ratio of a floor's mass, with blocks, to the smallest mass of a floor at which intervals are solved in substeps.
/// Each plain step repeats the rounding of its matrix, some 1e-15 of the drift rates: with many substeps it sums up to what
/// can be seen in the energy of a floor so heavy.
const MAX_MASS_RATIO: f64 = 1e4;

/// The steps of a regime.
pub(crate) struct Steps {
    /// Series of the regime over a step of its own; none above [`MAX_TABLE`] storeys.
    pub(crate) table: Option<Table>,
    pub(crate) whole: Whole,
}

/// The step of a regime over one whole sample interval.
pub(crate) enum Whole {
    Dense(Propagator),
    Tall(Arc<TallStep>),
}

/// Taylor terms of the floor accelerations from the second order on, over a step `h`, of unit drift accelerations and
/// of unit rates of these: by order, by column, by floor padded to whole vectors.
pub(crate) struct Table {
    pub(crate) h: f64,
    pub(crate) terms: Aligned,
}

/// The step of a regime over one sample interval, acting on rows (dx, dv, a, j): changes of drifts and drift rates,
/// floor accelerations and their rates at the end, each padded to whole vectors.
pub(crate) struct Propagator {
    storeys: usize,
    rows: usize,
    /// Columns, one after the other: of the state (x, v); of a constant ground acceleration and of one that grows from
    /// zero by one per interval; of constant floor loads; where vertical motion needs them, of floor loads that grow from
    /// zero by one per interval.
    columns: Aligned,
}

/// What a column of the step is the effect of, all else being zero.
#[derive(Clone, Copy)]
enum Cause {
    Drift(usize),
    DriftRate(usize),
    Load(usize),
    /// A floor load that grows from zero by one per second.
    Ramp(usize),
    Ground,
    /// A ground acceleration that grows from zero by one per second.
    GroundRamp,
}

impl Cause {
    /// Its storey or floor, and 1 for what it is: drift, drift rate, load, ramp, ground acceleration, ramp of that; else 0.
    #[inline(always)]
    fn units(self) -> (usize, [f64; 6]) {
        let (i, which) = match self {
            Self::Drift(i) => (i, 0),
            Self::DriftRate(i) => (i, 1),
            Self::Load(i) => (i, 2),
            Self::Ramp(i) => (i, 3),
            Self::Ground => (0, 4),
            Self::GroundRamp => (0, 5),
        };
        let mut units = [0.0; 6];
        units[which] = 1.0;
        (i, units)
    }
}

for_each_path! {
    /// What a step of length `h` adds to (dx, dv, a, j) beyond the first order, of unit drift accelerations and of unit
    /// rates of these: `sums` gets columns of four padded rows. `terms` gets those of a [`Table`], if it has room.
    fn form_remainders(model: &Model, regime: &Regime, h: f64, order: usize, sums: &mut [f64], terms: &mut [f64])
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
        1 => remainders_of_few::<V, 1>(model, regime, h, order, sums, terms),
        2 => remainders_of_few::<V, 2>(model, regime, h, order, sums, terms),
        3 => remainders_of_few::<V, 3>(model, regime, h, order, sums, terms),
        4 => remainders_of_few::<V, 4>(model, regime, h, order, sums, terms),
        _ => by_width!(model.width, K => remainders::<V, K>(model, regime, h, order, sums, terms)),
    }
}

/// [`form_remainders`] of `S` storeys, at most a vector's, with the terms of a table: a vector holds one floor in all
/// columns, those of q and those of its rate, so that the recursion needs neither shifts nor sums within vectors. What is
/// summed follows from the terms.
#[inline(always)]
fn remainders_of_few<V: Vector, const S: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    order: usize,
    sums: &mut [f64],
    terms: &mut [f64],
) {
    let zero = V::splat(0.0);
    let mut coefficients = [[0.0; 4]; S];
    let (tangent, inverse_mass) = (regime.row(Row::Tangent), regime.row(Row::InverseMass));
    let padded = |values: &[f64], i: usize| values.get(i).copied().unwrap_or(0.0);
    let (storey_damping, floor_damping) = (&model.lanes.storey_damping, &model.lanes.floor_damping);
    for i in 0..S {
        coefficients[i] = [tangent[i], inverse_mass[i], padded(storey_damping, i), padded(floor_damping, i)];
    }
    let full_damping = columns_of::<1>(&model.lanes.damping).first_chunk::<S>();
    let by_order = terms.as_chunks_mut::<WIDTH>().0;
    let (mut x, mut v) = ([[zero; S]; 2], [[zero; S]; 2]);
    for i in 0..S {
        let [unit] = unit(i);
        (x[0][i], v[1][i]) = (unit, unit);
    }
    for (k, out) in by_order.chunks_exact_mut(2 * S).enumerate() {
        let (once, twice) = (V::splat(h * INVERSE[k + 1]), V::splat(h * h * (INVERSE[k + 1] * INVERSE[k + 2])));
        for set in 0..2 {
            let (mut shear, mut others, mut velocity) = ([zero; S], [zero; S], [zero; S]);
            let mut below = zero;
            for i in 0..S {
                shear[i] = V::splat(coefficients[i][0]).mul(x[set][i]);
            }
            if let Some(columns) = full_damping {
                for j in 0..S {
                    let sums = if j % 2 == 0 { &mut shear } else { &mut others };
                    for i in 0..S {
                        sums[i] = V::splat(columns[j][0][i]).mul_add(v[set][j], sums[i]);
                    }
                }
            } else {
                for i in 0..S {
                    others[i] = V::splat(coefficients[i][2]).mul(v[set][i]);
                    below = below.add(v[set][i]);
                    velocity[i] = V::splat(coefficients[i][3]).mul(below);
                }
            }
            let mut term = [zero; WIDTH];
            below = zero;
            for i in 0..S {
                let shear_above = if i + 1 < S { shear[i + 1].add(others[i + 1]) } else { zero };
                let net = shear_above.sub(shear[i].add(others[i])).sub(velocity[i]);
                let a = net.mul(V::splat(coefficients[i][1]));
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
    for (column, out) in sums.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<4>().0.iter_mut().take(2 * S).enumerate() {
        let [mut once, mut twice, mut value, mut rate] = [zero; 4];
        for (k, term) in by_order.iter().skip(column).step_by(2 * S).enumerate().take(order - 1) {
            let term = V::load(term);
            once = V::splat(INVERSE[k + 3]).mul_add(term, once);
            twice = V::splat(INVERSE[k + 3] * INVERSE[k + 4]).mul_add(term, twice);
            value = value.add(term);
            rate = V::splat((k + 2) as f64).mul_add(term, rate);
        }
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
    let operator = Operator::<V, K>::new(model, regime);
    let zero = [V::splat(0.0); K];
    let inside: [V; K] = load(&model.lanes.inside);
    let keeps_terms = !terms.is_empty();
    for storey in 0..n {
        let (mut x, mut v) = ([unit(storey), zero], [zero, unit(storey)]);
        let places = [storey, n + storey];
        let mut rows = [[zero; 4]; 2];
        for k in 0..=order {
            let (once, twice) = (h * INVERSE[k + 1], h * h * (INVERSE[k + 1] * INVERSE[k + 2]));
            let (once, twice) = (V::splat(once), V::splat(twice));
            for column in 0..2 {
                let a = operator.accelerations(&x[column], &v[column], zero);
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
                }
                if keeps_terms && k + 2 <= order {
                    store(&term, &mut terms[(k * 2 * n + places[column]) * width..]);
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
    /// Forms the columns of causes over a step of length `h`, whose remainders are `sums`: rows (dx, dv, a, j).
    fn form_columns(model: &Model, regime: &Regime, h: f64, sums: &[f64], causes: &[Cause], out: &mut [f64])
        = columns_by_width
}

#[inline(always)]
fn columns_by_width<V: Vector>(
    model: &Model,
    regime: &Regime,
    h: f64,
    sums: &[f64],
    causes: &[Cause],
    out: &mut [f64],
) {
    by_width!(model.width, K => columns::<V, K>(model, regime, h, sums, causes, out))
}

/// Two at a time of one vector: each is a chain of dependent operations that the processor waits for.
#[inline(always)]
fn columns<V: Vector, const K: usize>(
    model: &Model,
    regime: &Regime,
    h: f64,
    sums: &[f64],
    causes: &[Cause],
    out: &mut [f64],
) {
    let operator = Operator::<V, K>::new(model, regime);
    let sums = &columns_of::<K>(sums).as_chunks::<4>().0[..2 * model.storeys()];
    let out = out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0.as_chunks_mut::<4>().0;
    let paired = if K == 1 { causes.len() / 2 * 2 } else { 0 };
    let ((pairs, others), (of_pairs, of_others)) = (causes.split_at(paired), out.split_at_mut(paired));
    for (causes, out) in pairs.as_chunks::<2>().0.iter().zip(of_pairs.as_chunks_mut::<2>().0) {
        columns_of_causes(&operator, h, sums, causes, out);
    }
    for (causes, out) in others.as_chunks::<1>().0.iter().zip(of_others.as_chunks_mut::<1>().0) {
        columns_of_causes(&operator, h, sums, causes, out);
    }
}

/// The columns of so many causes.
#[inline(always)]
fn columns_of_causes<V: Vector, const K: usize, const COUNT: usize>(
    operator: &Operator<V, K>,
    h: f64,
    sums: &[[[[f64; WIDTH]; K]; 4]],
    causes: &[Cause; COUNT],
    out: &mut [[[[f64; WIDTH]; K]; 4]; COUNT],
) {
    let zero = [V::splat(0.0); K];
    let mut rows = [[zero; 4]; COUNT];
    let (mut of_q, mut of_rate) = ([[[0.0; WIDTH]; K]; COUNT], [[[0.0; WIDTH]; K]; COUNT]);
    for c in 0..COUNT {
        let (i, [of_drift, of_drift_rate, of_load, of_ramp, ground, ground_slope]) = causes[c].units();
        let [mut x, mut v, mut force, mut slope] = [unit::<V, K>(i); 4];
        for k in 0..K {
            x[k] = x[k].mul(V::splat(of_drift));
            v[k] = v[k].mul(V::splat(of_drift_rate));
            force[k] = force[k].mul(V::splat(of_load));
            slope[k] = slope[k].mul(V::splat(of_ramp));
        }
        let a = operator.accelerations(&x, &v, force);
        let q = differences(&a, V::splat(ground));
        let jerk = operator.accelerations(&v, &q, slope);
        of_q[c] = numbers(&q);
        of_rate[c] = numbers(&differences(&jerk, V::splat(ground_slope)));
        for k in 0..K {
            rows[c][0][k] = V::splat(h).mul(v[k]);
            rows[c][2][k] = V::splat(h).mul_add(jerk[k], a[k]);
            rows[c][3][k] = jerk[k];
        }
    }
    let (sums_of_q, sums_of_rate) = sums.split_at(sums.len() / 2);
    for (sums, weights) in [(sums_of_q, &of_q), (sums_of_rate, &of_rate)] {
        for (i, sums) in sums.iter().enumerate() {
            for c in 0..COUNT {
                let weight = V::splat(weights[c].as_flattened()[i]);
                for r in 0..4 {
                    for k in 0..K {
                        rows[c][r][k] = V::load(&sums[r][k]).mul_add(weight, rows[c][r][k]);
                    }
                }
            }
        }
    }
    for c in 0..COUNT {
        for r in 0..4 {
            out[c][r] = numbers(&rows[c][r]);
        }
    }
}

/// Changes of the state (x, v) over a step as an affine map; slopes are per second.
struct Step {
    state: DMatrix<f64>,
    load: DMatrix<f64>,
    ramp: DMatrix<f64>,
    ground: DVector<f64>,
    ground_ramp: DVector<f64>,
}

impl Step {
    /// The step from its columns of rows (dx, dv, a, j).
    fn new(n: usize, mut rows: impl FnMut(Cause) -> Vec<f64>) -> Self {
        let mut column = |cause: Cause| {
            let rows = rows(cause);
            DVector::from_iterator(2 * n, rows[..n].iter().chain(&rows[padded(n)..padded(n) + n]).copied())
        };
        let state: Vec<_> = (0..n).map(Cause::Drift).chain((0..n).map(Cause::DriftRate)).map(&mut column).collect();
        let load: Vec<_> = (0..n).map(|i| column(Cause::Load(i))).collect();
        let ramp: Vec<_> = (0..n).map(|i| column(Cause::Ramp(i))).collect();
        Self {
            state: DMatrix::from_columns(&state),
            load: DMatrix::from_columns(&load),
            ramp: DMatrix::from_columns(&ramp),
            ground: column(Cause::Ground),
            ground_ramp: column(Cause::GroundRamp),
        }
    }

    /// The step taken twice; `h` is its length.
    fn doubled(&self, h: f64) -> Self {
        let state = &self.state;
        Self {
            state: state * 2.0 + state * state,
            load: &self.load * 2.0 + state * &self.load,
            ramp: &self.ramp * 2.0 + state * &self.ramp + &self.load * h,
            ground: &self.ground * 2.0 + state * &self.ground,
            ground_ramp: &self.ground_ramp * 2.0 + state * &self.ground_ramp + &self.ground * h,
        }
    }

    /// Change of the state in the column of a cause.
    fn change(&self, cause: Cause) -> &[f64] {
        let rows = self.ground.len();
        let column = |matrix: &'_ DMatrix<f64>, i: usize| rows * i..rows * (i + 1).min(matrix.ncols());
        match cause {
            Cause::Drift(i) => &self.state.as_slice()[column(&self.state, i)],
            Cause::DriftRate(i) => &self.state.as_slice()[column(&self.state, rows / 2 + i)],
            Cause::Load(i) => &self.load.as_slice()[column(&self.load, i)],
            Cause::Ramp(i) => &self.ramp.as_slice()[column(&self.ramp, i)],
            Cause::Ground => self.ground.as_slice(),
            Cause::GroundRamp => self.ground_ramp.as_slice(),
        }
    }
}

impl Steps {
    /// The steps of a regime over `dt`, by one series where it converges fast enough, else by halving. `sums` is working
    /// space.
    fn new(model: &Model, regime: &Regime, dt: f64, with_ramps: bool, sums: &mut Vec<f64>) -> Self {
        let n = model.storeys();
        if Self::are_tall(model, regime, dt) {
            return Self { table: None, whole: Whole::Tall(Arc::new(TallStep::new(model, regime, dt))) };
        }
        let width = model.width;
        let halvings = (regime.frequency * dt / MAX_PHASE).log2().ceil().max(0.0);
        let h = dt * (-halvings).exp2();
        // Parts of a halved interval may be longer than its table's step.
        let order = terms(if halvings > 0.0 { MAX_PHASE } else { regime.frequency * h });
        sums.resize(2 * n * 4 * width, 0.0);
        let mut table = Aligned::unset(if n <= MAX_TABLE { (order - 1) * 2 * n * width } else { 0 });
        form_remainders(model, regime, h, order, sums, &mut table);
        let composed = (halvings > 0.0).then(|| {
            let mut step = Step::new(n, |cause| {
                let mut rows = vec![0.0; 4 * width];
                form_columns(model, regime, h, sums, &[cause], &mut rows);
                rows
            });
            let mut length = h;
            for _ in 0..halvings as usize {
                step = step.doubled(length);
                length *= 2.0;
            }
            step
        });
        let causes: Vec<Cause> = (0..n)
            .map(Cause::Drift)
            .chain((0..n).map(Cause::DriftRate))
            .chain([Cause::Ground, Cause::GroundRamp])
            .chain((0..n).map(Cause::Load))
            .chain((0..if with_ramps { n } else { 0 }).map(Cause::Ramp))
            .collect();
        let mut columns = Aligned::unset(causes.len() * 4 * width);
        match &composed {
            None => form_columns(model, regime, h, sums, &causes, &mut columns),
            Some(step) => {
                for (column, &cause) in columns.chunks_exact_mut(4 * width).zip(&causes) {
                    column_of_change(model, regime, cause, step.change(cause), dt, column);
                }
            }
        }
        for (column, cause) in columns.chunks_exact_mut(4 * width).zip(&causes) {
            if matches!(cause, Cause::Ramp(_) | Cause::GroundRamp) {
                // Per interval instead of per second.
                column.iter_mut().for_each(|entry| *entry /= dt);
            }
        }
        let table = (n <= MAX_TABLE).then_some(Table { h, terms: table });
        Self { table, whole: Whole::Dense(Propagator { storeys: n, rows: 4 * width, columns }) }
    }

    /// Whether the step is that of a tall regime.
    fn are_tall(model: &Model, regime: &Regime, dt: f64) -> bool {
        model.storeys() > MAX_DENSE && TallStep::exists(regime, dt)
    }

    fn bytes(&self) -> usize {
        match &self.whole {
            Whole::Dense(propagator) => {
                8 * (propagator.columns.len() + self.table.as_ref().map_or(0, |table| table.terms.len()))
            }
            Whole::Tall(step) => step.bytes(),
        }
    }
}

for_each_path! {
    /// out = columns * weights; columns are as long as `out`, in fours of vectors.
    fn combine(columns: &[f64], weights: &[f64], out: &mut [f64]) = combine_by_path
}

#[inline(always)]
fn combine_by_path<V: Vector>(columns: &[f64], weights: &[f64], out: &mut [f64]) {
    let (columns, out) = (columns_of::<4>(columns), out.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<4>().0);
    let fours = out.len();
    for (r, out) in out.iter_mut().enumerate() {
        let mut sums = [V::splat(0.0); 4];
        let mut at = r;
        for &weight in weights {
            let Some(column) = columns.get(at) else { break };
            for k in 0..4 {
                sums[k] = V::load(&column[k]).mul_add(V::splat(weight), sums[k]);
            }
            at += fours;
        }
        *out = numbers(&sums);
    }
}

impl Propagator {
    /// Columns from the given one on.
    #[inline(always)]
    fn columns_from(&self, column: usize) -> &[f64] {
        self.columns.get(column * self.rows..).unwrap_or(&[])
    }

    /// Effect of constant floor loads (N) over the interval.
    pub(crate) fn of_load(&self, load: &[f64], out: &mut [f64]) {
        combine(self.columns_from(2 * self.storeys + 2), &load[..self.storeys], out);
    }

    /// Effect of floor loads that grow from zero to `load` (N) over the interval.
    pub(crate) fn of_ramp(&self, load: &[f64], out: &mut [f64]) {
        combine(self.columns_from(3 * self.storeys + 2), &load[..self.storeys], out);
    }

    /// Whether it knows the effect of loads that grow.
    pub(crate) fn has_ramps(&self) -> bool {
        !self.columns_from(3 * self.storeys + 2).is_empty()
    }

    /// Columns of the state (x, v), one after the other, and those of the motion after them: of a constant ground
    /// acceleration, and of one that grows from zero by one.
    #[inline(always)]
    pub(crate) fn state_and_motion_columns(&self) -> &[f64] {
        &self.columns
    }
}

/// Forms the rows (dx, dv, a, j) of a column from the change of the state over `h`.
fn column_of_change(model: &Model, regime: &Regime, cause: Cause, change: &[f64], h: f64, out: &mut [f64]) {
    let n = model.storeys();
    let (mut x, mut v) = (change[..n].to_vec(), change[n..].to_vec());
    let (mut load, mut slope, mut ground) = (vec![0.0; n], vec![0.0; n], 0.0);
    match cause {
        Cause::Drift(i) => x[i] += 1.0,
        Cause::DriftRate(i) => v[i] += 1.0,
        Cause::Load(i) => load[i] = 1.0,
        Cause::Ramp(i) => (load[i], slope[i]) = (h, 1.0),
        Cause::Ground => ground = 1.0,
        Cause::GroundRamp => ground = h,
    }
    let (mut a, mut jerk) = (vec![0.0; n], vec![0.0; n]);
    regime.accelerations(model, &x, &v, &load, &mut a);
    let mut below = ground;
    let drift_acceleration: Vec<f64> = a.iter().map(|&a| a - std::mem::replace(&mut below, a)).collect();
    regime.accelerations(model, &v, &drift_acceleration, &slope, &mut jerk);
    for (row, part) in out.chunks_exact_mut(model.width).zip([&change[..n], &change[n..], &a, &jerk]) {
        row[..n].copy_from_slice(part);
        row[n..].fill(0.0);
    }
}

/// An entry of the cache: a regime, and how often the present run took a whole interval in it.
struct Entry {
    regime: Regime,
    run: u64,
    visits: u32,
}

/// The regimes met so far by scenes of equal structure at one time step.
///
/// What a run computes never depends on what is cached: where the steps of a regime pay only after some time, a run takes
/// its first [`RegimeCache::series_visits`] intervals by series whether or not another run has already paid for them.
pub(crate) struct RegimeCache {
    dt: f64,
    /// See [`RegimeCache::frequency`]; none before it is asked for.
    frequency: Option<f64>,
    entries: Vec<Entry>,
    index: HashMap<Vec<u64>, usize, FxBuildHasher>,
    run: u64,
    /// Memory taken by all entries.
    bytes: usize,
    /// Memory taken by what the present run has met.
    run_bytes: usize,
    /// Working space of forming steps.
    sums: Vec<f64>,
}

impl RegimeCache {
    /// Whole intervals of a regime that a run solves by series before its steps are formed. To form them costs like
    /// n^3, a series saved like n^2 with full damping matrices and like n with others: about as many series as there are
    /// storeys pay for them. Up to [`MAX_AT_ONCE`] storeys they are formed at once.
    fn series_visits(storeys: usize) -> u32 {
        if storeys <= MAX_AT_ONCE { 0 } else { storeys as u32 }
    }

    /// A cache of steps of `dt`.
    pub(crate) fn new(dt: f64) -> Self {
        let index = HashMap::default();
        let (entries, sums) = (Vec::new(), Vec::new());
        Self { dt, frequency: None, entries, index, run: 0, bytes: 0, run_bytes: 0, sums }
    }

    /// Makes it one of steps of `dt`: what it holds of others is forgotten.
    pub(crate) fn set_time_step(&mut self, dt: f64) {
        if self.dt.to_bits() != dt.to_bits() {
            self.dt = dt;
            self.clear();
        }
    }

    /// The frequency that a step of a run must suit (rad/s): a bound on those of the elastic building, all blocks stuck.
    /// 0, so that any step does, where floors and their blocks differ too much in mass ([`MAX_MASS_RATIO`]).
    pub(crate) fn frequency(&mut self, model: &Model) -> f64 {
        *self.frequency.get_or_insert_with(|| {
            let mut stuck_mass = vec![0.0; model.storeys()];
            for block in model.blocks.iter().filter(|block| block.floor > 0) {
                stuck_mass[block.floor - 1] += block.mass;
            }
            let heaviest = model.mass.iter().zip(&stuck_mass).map(|(floor, stuck)| floor + stuck).fold(0.0, f64::max);
            let lightest = model.mass.iter().copied().fold(f64::INFINITY, f64::min);
            if heaviest > MAX_MASS_RATIO * lightest { 0.0 } else { Regime::new(model, |_| 0, &stuck_mass).frequency }
        })
    }

    /// Begins a run: counts of visits start afresh.
    pub(crate) fn begin_run(&mut self) {
        self.run += 1;
        self.run_bytes = 0;
        if self.bytes > CACHE_BYTES {
            self.clear();
        }
    }

    fn clear(&mut self) {
        *self = Self { run: self.run, frequency: self.frequency, ..Self::new(self.dt) };
    }

    /// The regime of a key, formed by `form` when it is new. Returns its index and whether this run knew it.
    pub(crate) fn enter(&mut self, key: &[u64], form: impl FnOnce() -> Regime) -> (usize, bool) {
        if self.run_bytes > CACHE_BYTES {
            self.clear();
        }
        let index = match self.index.get(key) {
            Some(&index) => index,
            None => {
                let regime = form();
                self.bytes += Self::entry_bytes(&regime, key);
                self.entries.push(Entry { regime, run: 0, visits: 0 });
                self.index.insert(key.to_vec(), self.entries.len() - 1);
                self.entries.len() - 1
            }
        };
        let entry = &mut self.entries[index];
        let known = entry.run == self.run;
        if !known {
            entry.run = self.run;
            entry.visits = 0;
            self.run_bytes += Self::entry_bytes(&entry.regime, key);
        }
        (index, known)
    }

    fn entry_bytes(regime: &Regime, key: &[u64]) -> usize {
        8 * regime.row(Row::Mass).len() * 16 + 16 * key.len() + 256
    }

    /// The regime at an index.
    #[inline]
    pub(crate) fn regime(&self, index: usize) -> &Regime {
        &self.entries[index].regime
    }

    /// Whether series of a regime go by its table, which then exists: once the present run has taken as many intervals in
    /// it as are solved without.
    #[inline]
    pub(crate) fn prepare_table(&mut self, index: usize, model: &Model, vertical: bool) -> bool {
        let n = model.storeys();
        let entry = &self.entries[index];
        if n == 0 || n > MAX_TABLE || n > MAX_AT_ONCE && entry.visits <= Self::series_visits(n) {
            return false;
        }
        if entry.regime.steps.is_none() {
            self.form_steps(index, model, vertical);
        }
        true
    }

    #[cold]
    fn form_steps(&mut self, index: usize, model: &Model, vertical: bool) {
        let entry = &mut self.entries[index];
        let steps = Steps::new(model, &entry.regime, self.dt, vertical, &mut self.sums);
        self.bytes += steps.bytes();
        entry.regime.steps = Some(Box::new(steps));
    }

    /// Counts a whole interval in a regime; true once its propagator is to be used, which then exists.
    pub(crate) fn visit(&mut self, index: usize, model: &Model, vertical: bool) -> bool {
        let entry = &mut self.entries[index];
        let n = model.storeys();
        let is_tall = Steps::are_tall(model, &entry.regime, self.dt);
        if n == 0 || n > MAX_LANES && !is_tall {
            return false;
        }
        let series_visits = if is_tall { TallStep::series_visits(model) } else { Self::series_visits(n) };
        entry.visits = entry.visits.saturating_add(1);
        if entry.visits <= series_visits {
            return false;
        }
        let lacks = |steps: &Steps| match &steps.whole {
            Whole::Dense(propagator) => vertical && !propagator.has_ramps(),
            Whole::Tall(_) => false,
        };
        if entry.regime.steps.as_deref().is_none_or(lacks) {
            self.form_steps(index, model, vertical);
        }
        let entry = &self.entries[index];
        if entry.visits == series_visits + 1 {
            self.run_bytes += entry.regime.steps.as_ref().map_or(0, |steps| steps.bytes());
        }
        true
    }
}
