//! Tables of the series of a regime.

use crate::lanes::Aligned;

/// Taylor terms of the floor accelerations from the second order on, over a step `h`, of unit drift accelerations and
/// of unit rates of these: by order, by column, by floor padded to whole vectors.
pub(crate) struct SeriesTable {
    pub(crate) h: f64,
    /// Order of the last terms.
    pub(crate) order: usize,
    pub(crate) terms: Aligned,
}

impl SeriesTable {
    /// Columns that there are.
    pub(crate) fn columns(storeys: usize, order: usize) -> usize {
        2 * storeys * (order - 1)
    }
}
