//! The columns of a plain step, and their products.

use crate::lanes::{PaddedRows, Vector, WIDTH, columns_of, load, numbers};
use crate::regime::{Regime, Row};
use crate::state::State;
use crate::step::steps::Whole;
use crate::units::STANDARD_GRAVITY;

/// What bounds the fourth derivatives of drifts, drift rates, floor accelerations and block velocities.
pub(crate) const MARGINS: [Row; 4] =
    [Row::FourthOfDrift, Row::FourthOfRate, Row::FourthOfAcceleration, Row::ThirdOfAcceleration];

/// Rows (dx, dv, a, j) of a column of the step.
type Column<const K: usize> = [[[f64; WIDTH]; K]; 4];

/// What a run of plain steps reads.
pub(crate) struct StepColumns<'a, const K: usize> {
    pub(crate) regime: &'a Regime,
    pub(crate) h: f64,
    /// Columns of the step: of each drift, of each drift rate, of the ground acceleration and of its change.
    pub(crate) of_drift: &'a [Column<K>],
    pub(crate) of_rate: &'a [Column<K>],
    pub(crate) of_ground: &'a Column<K>,
    pub(crate) of_change: &'a Column<K>,
    /// Effect of constant floor loads; with vertical motion, of friction at unit contact force and at a unit ramp.
    pub(crate) constant: &'a Column<K>,
    pub(crate) friction: &'a Column<K>,
    pub(crate) friction_ramp: &'a Column<K>,
}

impl<'a, const K: usize> StepColumns<'a, K> {
    /// None where the regime has no propagator of this width.
    #[inline(always)]
    pub(crate) fn new(state: &'a State, h: f64) -> Option<Self> {
        let regime = &state.regime;
        let Whole::Dense(propagator) = &regime.steps(state.vertical)?.whole else { return None };
        let (of_drift, others) = four_rows(propagator.state_and_motion_columns()).split_at_checked(state.storeys())?;
        let (of_rate, others) = others.split_at_checked(state.storeys())?;
        let [of_ground, of_change, ..] = others else { return None };
        let effects = &state.step.effects;
        Some(Self {
            regime,
            h,
            of_drift,
            of_rate,
            of_ground,
            of_change,
            constant: effects.constant.vectors().first_chunk()?,
            friction: effects.friction.vectors().first_chunk()?,
            friction_ramp: effects.friction_ramp.vectors().first_chunk()?,
        })
    }
}

#[inline(always)]
fn four_rows<const K: usize>(values: &[f64]) -> &[Column<K>] {
    columns_of::<K>(values).as_chunks::<4>().0
}

/// rows += column * weight.
#[inline(always)]
fn add<V: Vector, const K: usize>(rows: &mut [[V; K]; 4], column: &Column<K>, weight: V) {
    for r in 0..4 {
        for k in 0..K {
            rows[r][k] = V::load(&column[r][k]).mul_add(weight, rows[r][k]);
        }
    }
}

/// rows += columns * weights.
#[inline(always)]
pub(crate) fn multiply<V: Vector, const K: usize>(rows: &mut [[V; K]; 4], columns: &[Column<K>], weights: &[V; K]) {
    let values = numbers(weights);
    let each = columns.iter().zip(values.as_flattened());
    if K <= 2 {
        for (column, &weight) in each {
            add(rows, column, V::splat(weight));
        }
    } else {
        // As many rows at a time as stay in the registers.
        for pair in [[0, 1], [2, 3]] {
            for (column, &weight) in each.clone() {
                let weight = V::splat(weight);
                for r in pair {
                    for k in 0..K {
                        rows[r][k] = V::load(&column[r][k]).mul_add(weight, rows[r][k]);
                    }
                }
            }
        }
    }
}

/// The step of a scene with so many storeys, from columns of each drift and of each drift rate, of the ground acceleration
/// and of its change.
///
/// Two sums: half the latency of one, which is what a small step waits for. As many rows at a time as stay in the registers.
#[inline(always)]
pub(crate) fn small_step<V: Vector, const K: usize, const S: usize>(
    step_columns: &StepColumns<K>,
    [of_drift, of_rate]: [&[Column<K>; S]; 2],
    [ground, change]: [f64; 2],
    [x, v]: [&[V; K]; 2],
) -> [[V; K]; 4] {
    let (ground, change) = (V::splat(ground), V::splat(change));
    let at_once = if K == 1 { 4 } else { 2 };
    let mut rows = [[V::splat(0.0); K]; 4];
    for first in (0..4).step_by(at_once) {
        let mut of_rates = [[V::splat(0.0); K]; 4];
        for r in first..first + at_once {
            for k in 0..K {
                let constant = V::load(&step_columns.constant[r][k]);
                let of_change = V::load(&step_columns.of_change[r][k]).mul_add(change, constant);
                rows[r][k] = V::load(&step_columns.of_ground[r][k]).mul_add(ground, of_change);
            }
        }
        for c in 0..S {
            let (x, v) = (x[c / WIDTH].broadcast(c % WIDTH), v[c / WIDTH].broadcast(c % WIDTH));
            for r in first..first + at_once {
                for k in 0..K {
                    rows[r][k] = V::load(&of_drift[c][r][k]).mul_add(x, rows[r][k]);
                    of_rates[r][k] = V::load(&of_rate[c][r][k]).mul_add(v, of_rates[r][k]);
                }
            }
        }
        for r in first..first + at_once {
            for k in 0..K {
                rows[r][k] = rows[r][k].add(of_rates[r][k]);
            }
        }
    }
    rows
}

/// Forms the effects of the floor loads on the step of the present regime, if they have changed.
#[inline(always)]
pub(crate) fn prepare_effects<V: Vector, const K: usize, const VERTICAL: bool>(state: &mut State) {
    if state.step.effects.valid {
        return;
    }
    let steps = state.regime.steps(state.vertical);
    let Some(Whole::Dense(propagator)) = steps.map(|steps| &steps.whole) else { return };
    let of_loads = four_rows(propagator.load_columns());
    let (mut loads, friction): ([V; K], [V; K]) = (load(&state.springs.load), load(&state.blocks.friction));
    let effects = &mut state.step.effects;
    if VERTICAL {
        let of_ramps = four_rows(propagator.ramp_columns());
        put_product::<V, K>(of_loads, &friction, &mut effects.friction);
        put_product::<V, K>(of_ramps, &friction, &mut effects.friction_ramp);
    } else {
        for k in 0..K {
            loads[k] = friction[k].mul_add(V::splat(STANDARD_GRAVITY), loads[k]);
        }
    }
    put_product::<V, K>(of_loads, &loads, &mut effects.constant);
    effects.valid = true;
}

/// rows = columns * weights.
#[inline(always)]
fn put_product<V: Vector, const K: usize>(columns: &[Column<K>], weights: &[V; K], rows: &mut PaddedRows<4>) {
    let mut product = [[V::splat(0.0); K]; 4];
    multiply(&mut product, columns, weights);
    for (out, row) in rows.vectors_mut::<K>().iter_mut().zip(&product) {
        *out = numbers(row);
    }
}
