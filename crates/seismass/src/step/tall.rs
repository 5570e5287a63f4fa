//! The exact step of a tall regime over one sample interval: a band where damping couples neighbours only, else full.

use crate::machines::model::Model;
use crate::regime::Regime;
use crate::scene::StoreyDamping;
use crate::step::banded::BandedStep;
use crate::step::full::FullStep;
use crate::tolerances::TALL_PHASE;

/// Whole intervals of a regime that a run solves by series before its band is formed: about as many as forming it
/// costs, however many storeys, since both costs grow like their number.
const BANDED_VISITS: u32 = 8;
/// Storeys for each such interval before a full step is formed: that costs like n^3, a series like n^2.
const STOREYS_PER_VISIT: usize = 2;

/// The step of a tall regime.
pub(crate) enum TallStep {
    Banded(BandedStep),
    Full(FullStep),
}

impl TallStep {
    /// Whether a regime has such a step over `dt`: it is not too stiff.
    pub(crate) fn exists(regime: &Regime, dt: f64) -> bool {
        regime.frequency * dt <= TALL_PHASE
    }

    /// Whole intervals of a regime that a run solves by series before its step is formed.
    pub(crate) fn series_visits(model: &Model) -> u32 {
        match model.damping() {
            StoreyDamping::Dense(_) => (model.storeys() / STOREYS_PER_VISIT) as u32,
            _ => BANDED_VISITS,
        }
    }

    /// The step of a regime over `dt`.
    pub(crate) fn new(model: &Model, regime: &Regime, dt: f64) -> Self {
        match model.damping() {
            StoreyDamping::Dense(damping) => Self::Full(FullStep::new(model, damping, regime, dt)),
            _ => Self::Banded(BandedStep::new(model, regime, dt)),
        }
    }

    /// Memory taken (bytes).
    pub(crate) fn bytes(&self) -> usize {
        match self {
            Self::Banded(step) => step.bytes(),
            Self::Full(step) => step.bytes(),
        }
    }
}
