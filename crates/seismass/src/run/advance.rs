//! How the state moves on within an interval.

use crate::error::Error;
use crate::lanes::{Padded, Vector, by_width, for_each_path};
use crate::machines::block::BlockMotion;
use crate::record::observer::Observer;
use crate::state::State;
use crate::state::relative::block_change;
use crate::tolerances::SERIES_PHASE;

for_each_path! {
    /// Integrates energies over `h` from `tau`, up to which nothing happens, and advances by it.
    fn add_energy[K: usize](state: &mut State, observer: &mut Observer, tau: f64, h: f64) = add_energy_by_path
}

#[inline(always)]
fn add_energy_by_path<V: Vector, const K: usize>(state: &mut State, observer: &mut Observer, tau: f64, h: f64) {
    state.form_series::<V, K>(tau, h);
    observer.add_energy(state, tau, 1.0);
    advance::<V, K>(state, tau, true);
}

/// What moves: drifts, drift rates, floor accelerations, their rates, drift accelerations, and blocks.
pub(crate) struct Moment {
    lanes: [Padded; 5],
    /// See [`Kinematics`](crate::state::kinematics::Kinematics).
    jerk_slope: f64,
    is_formed: bool,
    motions: Vec<BlockMotion>,
}

/// Moves drifts, drift rates and blocks to the place of the present series, which begins at `tau`; at its end,
/// accelerations too. Returns whether all is finite.
#[inline(always)]
pub(crate) fn advance<V: Vector, const K: usize>(state: &mut State, tau: f64, to_end: bool) -> bool {
    let mut blocks = 0.0;
    if state.blocks.is_sliding || state.blocks.airborne {
        for position in 0..state.blocks.moving.len() {
            let j = state.blocks.moving[position];
            let change = block_change::<K>(state, j);
            state.blocks.motions[j].move_by(change);
            // No number times zero is zero but a finite one.
            blocks += 0.0 * (change.0 + change.1);
        }
    }
    let end = to_end.then(|| tau + state.step.series.h());
    state.take_changes::<V, K>(end) && blocks == 0.0
}

/// What moves, at this moment.
pub(crate) fn moment(state: &State) -> Moment {
    let lanes = [
        &state.kinematics.x,
        &state.kinematics.v,
        &state.kinematics.a,
        &state.kinematics.jerk,
        &state.kinematics.drift_acceleration,
    ]
    .map(Clone::clone);
    let (jerk_slope, is_formed) = (state.kinematics.jerk_slope, state.kinematics.is_formed);
    Moment { lanes, jerk_slope, is_formed, motions: state.blocks.motions.clone() }
}

fn set_moment(state: &mut State, moment: Moment) {
    [
        state.kinematics.x,
        state.kinematics.v,
        state.kinematics.a,
        state.kinematics.jerk,
        state.kinematics.drift_acceleration,
    ] = moment.lanes;
    (state.kinematics.jerk_slope, state.kinematics.is_formed) = (moment.jerk_slope, moment.is_formed);
    state.blocks.motions = moment.motions;
}

/// Integrates the energies of an interval without events from its start, and leaves the state at its end as it is.
pub(crate) fn add_energy_of_interval(state: &mut State, start: Moment, observer: &mut Observer) {
    let end = moment(state);
    set_moment(state, start);
    let pieces = (state.regime.frequency * state.interval.h / SERIES_PHASE).ceil().max(1.0);
    let h = state.interval.h / pieces;
    for piece in 0..pieces as usize {
        let tau = piece as f64 * h;
        by_width!(state.model.width, K => add_energy::<K>(state, observer, tau, h));
    }
    set_moment(state, end);
}

#[cold]
pub(crate) fn not_finite(state: &State, tau: f64) -> Error {
    let storey = state.kinematics.x.iter().zip(&state.kinematics.v).position(|(x, v)| !(x + v).is_finite());
    let block = state.blocks.motions.iter().position(|m| !(m.slip + m.velocity).is_finite());
    let element = match (storey, block) {
        (Some(i), _) => format!("storey {}", i + 1),
        (None, Some(j)) => format!("block {}", j + 1),
        // Only what is formed of them, as their squares.
        (None, None) => "the building".into(),
    };
    Error::NotFinite { time: state.interval.start + tau, element }
}
