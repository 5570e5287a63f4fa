//! The steps of a regime over one sample interval.

use std::sync::Arc;

use crate::lanes::{Aligned, MAX_DENSE, Plain, WIDTH};
use crate::machines::model::Model;
use crate::polynomial::orders::terms;
use crate::regime::Regime;
use crate::step::dense::{
    ColumnCause, Propagator, column_count, column_of_change, doubled, form_columns, form_remainders,
};
use crate::step::table::SeriesTable;
use crate::step::tall::TallStep;
use crate::tolerances::SERIES_PHASE;

/// Most storeys of which tables of the series are kept.
pub(crate) const MAX_TABLE: usize = 2 * WIDTH;

/// The steps of a regime.
pub(crate) struct Steps {
    /// Series of the regime over a step of its own; none above [`MAX_TABLE`] storeys.
    pub(crate) table: Option<SeriesTable>,
    pub(crate) whole: Whole,
}

/// The step of a regime over one whole sample interval.
pub(crate) enum Whole {
    Dense(Propagator),
    Tall(Arc<TallStep>),
}

impl Steps {
    /// The steps of a regime over `dt`, by one series where it converges fast enough, else by halving. `sums` is working
    /// space.
    pub(crate) fn new(model: &Model, regime: &Regime, dt: f64, with_ramps: bool, sums: &mut Vec<f64>) -> Self {
        let n = model.storeys();
        if Self::are_tall(model, regime, dt) {
            return Self { table: None, whole: Whole::Tall(Arc::new(TallStep::new(model, regime, dt))) };
        }
        let width = model.width;
        let phase = regime.frequency * dt;
        let halvings = if phase > SERIES_PHASE { libm::log2(phase / SERIES_PHASE).ceil() } else { 0.0 };
        let h = dt * libm::exp2(-halvings);
        // Parts of a halved interval may be longer than its table's step.
        let order = terms::<Plain>(if halvings > 0.0 { SERIES_PHASE } else { regime.frequency * h });
        sums.resize(2 * n * 4 * width, 0.0);
        let mut table = Aligned::unset(if n <= MAX_TABLE { SeriesTable::columns(n, order) * width } else { 0 });
        form_remainders(model, regime, h, order, sums, &mut table);
        let formed = |with_ramps: bool| {
            let mut columns = Aligned::unset(column_count(n, with_ramps) * 4 * width);
            form_columns(model, regime, h, sums, &mut columns);
            columns
        };
        let mut columns;
        if halvings > 0.0 {
            let mut changes: Vec<f64> =
                formed(true).chunks_exact(4 * width).flat_map(|rows| &rows[..2 * width]).copied().collect();
            let mut length = h;
            for _ in 0..halvings as usize {
                changes = doubled(&changes, n, width, length);
                length *= 2.0;
            }
            columns = Aligned::unset(column_count(n, with_ramps) * 4 * width);
            let changes = changes.chunks_exact(2 * width);
            for (i, (column, change)) in columns.chunks_exact_mut(4 * width).zip(changes).enumerate() {
                column_of_change(model, regime, ColumnCause::of(i, n), change, dt, column);
            }
        } else {
            columns = formed(with_ramps);
        }
        // Ramps per interval instead of per second.
        let (others, ramps) = columns.split_at_mut(column_count(n, false) * 4 * width);
        let ground_ramp = &mut others[(2 * n + 1) * 4 * width..][..4 * width];
        ground_ramp.iter_mut().chain(ramps).for_each(|entry| *entry /= dt);
        let table = (n <= MAX_TABLE).then_some(SeriesTable { h, order, terms: table });
        Self { table, whole: Whole::Dense(Propagator { storeys: n, rows: 4 * width, columns }) }
    }

    /// Whether the step is that of a tall regime.
    pub(crate) fn are_tall(model: &Model, regime: &Regime, dt: f64) -> bool {
        model.storeys() > MAX_DENSE && TallStep::exists(regime, dt)
    }

    /// Memory taken (bytes), with the columns of ramps or without, whether or not they are there: what a run counts must
    /// not depend on which runs came before it.
    pub(crate) fn bytes(&self, with_ramps: bool) -> usize {
        match &self.whole {
            Whole::Dense(propagator) => {
                let columns = column_count(propagator.storeys, with_ramps) * propagator.rows;
                8 * (columns + self.table.as_ref().map_or(0, |table| table.terms.len()))
            }
            Whole::Tall(step) => step.bytes(),
        }
    }
}
