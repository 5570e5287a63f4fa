//! How the bounds of a state follow springs and peaks.

use std::mem::take;

use crate::lanes::{FAR, MAX_LANES, Vector, load, store};
use crate::record::observer::Observer;
use crate::regime::Row;
use crate::state::State;

/// Brings the bounds up to date with springs and peaks. More storeys than vectors hold have no such bounds.
#[inline(always)]
pub(crate) fn update_bounds<V: Vector, const K: usize>(state: &mut State, observer: &mut Observer) {
    if !(observer.take_beaten() | take(&mut state.bounds.is_stale)) || state.storeys() > MAX_LANES {
        return;
    }
    let (zero, half, far) = (V::splat(0.0), V::splat(0.5), V::splat(FAR));
    let flexibility: [V; K] = state.regime.lanes(Row::SpringFlexibility);
    let (base, force): ([V; K], [V; K]) = (load(&state.springs.base_drift), load(&state.springs.base_force));
    let [drift, shear, acceleration] = observer.peak_sizes::<V, K>();
    let bounds = &mut state.bounds;
    let (lowest, highest): ([V; K], [V; K]) = (load(&bounds.guarded[0]), load(&bounds.guarded[1]));
    let plastic: [V; K] = load(&bounds.plastic);
    let [mut middle, mut reach, mut turn] = [base; 3];
    for k in 0..K {
        let rigid = zero.not_below(flexibility[k]);
        let least = zero.sub(shear[k]).sub(force[k]).mul(flexibility[k]).with(rigid, zero.sub(far));
        let most = shear[k].sub(force[k]).mul(flexibility[k]).with(rigid, far);
        let low = zero.sub(drift[k]).sub(base[k]).max(least).max(lowest[k]).max(zero.sub(far));
        let high = drift[k].sub(base[k]).min(most).min(highest[k]).min(far);
        middle[k] = half.mul(low.add(high));
        reach[k] = half.mul(high.sub(low));
        turn[k] = far.sub(far.mul(plastic[k].abs()));
    }
    store(&middle, &mut bounds.middle);
    store(&reach, &mut bounds.reach);
    store(&plastic, &mut bounds.sign);
    store(&turn, &mut bounds.turn);
    store(&acceleration, &mut bounds.a_peak);
    if let Some(forces) = &observer.forces {
        forces.narrow(state);
    }
}
