//! Energies by direction (`numerics`, section 5.8).

use crate::general::energy::Balance;
use crate::general::plane::response::PlaneEnergy;
use crate::general::plane::series::PlaneSeries;
use crate::general::plane::state::PlaneState;
use crate::general::response::GeneralEnergy;

/// Running energy integrals of both directions.
pub(super) struct PlaneBalance {
    axes: [Balance; 2],
}

impl PlaneBalance {
    /// Notes the energies at the start.
    pub(super) fn begin(state: &PlaneState) -> Self {
        Self { axes: state.axes.each_ref().map(Balance::begin) }
    }

    /// Adds the energies of a series up to its place `end`, before the state is advanced.
    pub(super) fn add(&mut self, state: &PlaneState, series: &PlaneSeries, end: f64) {
        for (a, balance) in self.axes.iter_mut().enumerate() {
            balance.add(&state.axes[a], &series.axes[a], end);
        }
    }

    /// The energies at the end; `lost` is what was left in stops that parted.
    pub(super) fn finish(&self, state: &PlaneState, lost: [f64; 2]) -> PlaneEnergy {
        let directions = [0, 1].map(|a| self.axes[a].finish(&state.axes[a], lost[a]));
        let [x, y] = directions;
        let residual = |a: usize| directions[a].relative_residual * self.axes[a].scale();
        let scale = self.axes[0].scale() + self.axes[1].scale();
        let relative_residual = if scale > 0.0 { (residual(0) + residual(1)) / scale } else { 0.0 };
        let total = GeneralEnergy {
            initial: x.initial + y.initial,
            input: x.input + y.input,
            kinetic: x.kinetic + y.kinetic,
            elastic: x.elastic + y.elastic,
            viscous: x.viscous + y.viscous,
            hysteretic: x.hysteretic + y.hysteretic,
            friction: x.friction + y.friction,
            contact: x.contact + y.contact,
            relative_residual,
        };
        PlaneEnergy { directions, total }
    }
}
