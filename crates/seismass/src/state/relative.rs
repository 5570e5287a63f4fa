//! What blocks do relative to their floors over the present series.

use crate::lanes::{Plain, Vector, by_width};
use crate::polynomial::power::Polynomial;
use crate::state::State;

/// `p`, of [`Series::zeros`](crate::step::series::Series::zeros), becomes `factor`, 1 or -1, times the relative velocity of a
/// block over the present series; returns a bound of its size.
#[inline(always)]
pub(crate) fn relative_velocity<V: Vector, const K: usize>(
    state: &State,
    block: usize,
    factor: f64,
    p: &mut Polynomial,
) -> f64 {
    let (motion, law) = (&state.blocks.motions[block], &state.model.blocks[block]);
    let friction = motion.sliding().map_or(0.0, |sign| sign.factor() * motion.mu_k);
    let of_friction =
        [friction * state.step.drive.contact, friction * (state.step.drive.contact_slope * state.step.series.h())];
    state.step.series.velocity_against::<V, K>(law.floor, factor * motion.velocity, factor, of_friction, p)
}

/// The relative velocity of a block over the present series, for what is not in a hot loop.
pub(crate) fn velocity_of_block(state: &State, block: usize) -> Polynomial {
    let mut p = state.step.series.zeros();
    by_width!(state.model.width, K => relative_velocity::<Plain, K>(state, block, 1.0, &mut p));
    p
}

/// Slip of a block since the start of the present series.
pub(crate) fn slip_change(state: &State, block: usize) -> Polynomial {
    let velocity = velocity_of_block(state, block);
    let h = state.step.series.h();
    let terms = velocity.coefficients().iter().enumerate().map(|(k, c)| h * c / (k + 1) as f64);
    Polynomial::new(std::iter::once(0.0).chain(terms))
}

/// Changes of relative velocity and slip of a block over the present series up to its place: integrals of its floor's
/// absolute acceleration and its own, added term by term so that small ones keep their digits.
#[inline(always)]
pub(crate) fn block_change<const K: usize>(state: &State, block: usize) -> (f64, f64) {
    let (motion, law) = (&state.blocks.motions[block], &state.model.blocks[block]);
    let (s, h) = (state.step.series.place(), state.step.series.h());
    let friction = motion.sliding().map_or(0.0, |sign| sign.factor() * motion.mu_k);
    let (terms, integrals) = match law.floor.checked_sub(1) {
        Some(i) => state.step.series.terms_and_integrals::<K>(i),
        None => ([state.step.drive.ground, state.step.drive.ground_slope * h], [0.0; 2]),
    };
    let start = terms[0] + friction * state.step.drive.contact;
    let change = terms[1] + friction * state.step.drive.contact_slope * h;
    let velocity = (integrals[0] * s + 0.5 * change) * s + start;
    let slip = (integrals[1] * s + (1.0 / 6.0) * change) * s + 0.5 * start;
    let h = h * s;
    (-h * velocity, h * motion.velocity - h * h * slip)
}
