//! The working space of the present step.

use crate::lanes::{Padded, PaddedRows};
use crate::machines::model::Model;
use crate::state::ranges::Ranges;
use crate::step::drive::Drive;
use crate::step::series::Series;

/// Effect of the floor loads of the present state on the step of the regime's propagator.
#[derive(Debug, Default)]
pub(crate) struct LoadEffects {
    pub(crate) valid: bool,
    /// Of the springs' base forces (and of friction, without vertical motion).
    pub(crate) constant: PaddedRows<4>,
    /// With vertical motion: of friction at unit contact force.
    pub(crate) friction: PaddedRows<4>,
    /// With vertical motion: of friction with the contact force growing from zero to one.
    pub(crate) friction_ramp: PaddedRows<4>,
}

/// What the present step is solved with: its drive, its series and the ranges over it.
#[derive(Debug)]
pub(crate) struct StepSpace {
    pub(crate) effects: LoadEffects,
    pub(crate) drive: Drive,
    pub(crate) series: Series,
    pub(crate) ranges: Ranges,
}

impl StepSpace {
    pub(crate) fn new(model: &Model) -> Self {
        let (rows, zero) = (|| PaddedRows::zeros(model.width), || Padded::new(model.width, 0.0));
        Self {
            effects: LoadEffects { valid: false, constant: rows(), friction: rows(), friction_ramp: rows() },
            drive: Drive { load: zero(), load_slope: zero(), ..Drive::default() },
            series: Series::default(),
            ranges: Ranges::new(model.storeys()),
        }
    }
}
