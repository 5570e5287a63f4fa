//! The closer look at a step that the loop of plain steps does not clear, and the peaks that its runs beat.
//!
//! A step in which no guard falls is plain whatever peaks it beats: those at its end are kept, in vectors, until they are
//! taken; where a drift or an acceleration turns beyond its peak inside the step, the step's series gives the extreme.

use std::mem::take;

use crate::lanes::padded::Padded;
use crate::lanes::{LANES, Vector, WIDTH, by_width, for_each_path, load, store};
use crate::machines::model::Model;
use crate::record::observer::Observer;
use crate::state::limits::{self, Bounds, Set, against, farthest, members, signs};
use crate::state::{State, THIRD, off_cubic, ranges};

/// The state at a sample: drifts, drift rates, floor accelerations, their rates, and drift accelerations.
#[derive(Clone, Copy)]
pub(crate) struct Sample<V, const K: usize> {
    pub(crate) x: [V; K],
    pub(crate) v: [V; K],
    pub(crate) a: [V; K],
    pub(crate) jerk: [V; K],
    pub(crate) q: [V; K],
}

impl<V: Vector, const K: usize> Sample<V, K> {
    #[inline(always)]
    pub(crate) fn of(state: &State) -> Self {
        Self {
            x: load(&state.x),
            v: load(&state.v),
            a: load(&state.a),
            jerk: load(&state.jerk),
            q: load(&state.drift_acceleration),
        }
    }

    #[inline(always)]
    pub(crate) fn put_into(&self, state: &mut State) {
        store(&self.x, &mut state.x);
        store(&self.v, &mut state.v);
        store(&self.a, &mut state.a);
        store(&self.jerk, &mut state.jerk);
        store(&self.q, &mut state.drift_acceleration);
    }
}

/// The bounds of [`crate::state::limits::Bounds`] in vectors.
pub(crate) struct BoundsInLanes<V, const K: usize> {
    middle: [V; K],
    pub(crate) reach: [V; K],
    sign: [V; K],
    pub(crate) turn: [V; K],
    pub(crate) stuck_mu: [V; K],
    pub(crate) a_peak: [V; K],
}

impl<V: Vector, const K: usize> BoundsInLanes<V, K> {
    #[inline(always)]
    pub(crate) fn of(state: &State) -> Self {
        let bounds = &state.bounds;
        Self {
            middle: load(&bounds.middle),
            reach: load(&bounds.reach),
            sign: load(&bounds.sign),
            turn: load(&bounds.turn),
            stuck_mu: load(&bounds.stuck_mu),
            a_peak: load(&bounds.a_peak),
        }
    }

    #[inline(always)]
    pub(crate) fn put_into(&self, bounds: &mut Bounds) {
        store(&self.middle, &mut bounds.middle);
        store(&self.reach, &mut bounds.reach);
        store(&self.sign, &mut bounds.sign);
        store(&self.turn, &mut bounds.turn);
        store(&self.a_peak, &mut bounds.a_peak);
    }

    /// Lanes, as bits, of vector `k` whose ranges come to their bounds: of drifts (0), drift rates (1) or floor
    /// accelerations (2), with this least contact force.
    #[inline(always)]
    pub(crate) fn reached(&self, which: usize, k: usize, range: (V, V), least_contact: V) -> u32 {
        match which {
            0 => farthest(range, self.middle[k]).not_below(self.reach[k]),
            1 => against(range, self.sign[k]).not_below(self.turn[k]),
            _ => {
                let size = range.1.max(V::splat(0.0).sub(range.0));
                size.not_below(self.of_accelerations(k, least_contact))
            }
        }
    }

    /// What floor accelerations of vector `k` may not reach, with this least contact force.
    #[inline(always)]
    pub(crate) fn of_accelerations(&self, k: usize, least_contact: V) -> V {
        self.stuck_mu[k].mul(least_contact).min(self.a_peak[k])
    }

    /// [`limits::apart`] of all vectors.
    #[inline(always)]
    pub(crate) fn apart(&self, sample: &Sample<V, K>, third: V) -> [[V; K]; 3] {
        let mut out = [sample.x, sample.v, sample.a];
        for k in 0..K {
            let (drift, floor) = ([sample.x[k], sample.v[k], sample.q[k]], [sample.a[k], sample.jerk[k]]);
            [out[0][k], out[1][k], out[2][k]] = limits::apart(drift, floor, self.middle[k], self.sign[k], third);
        }
        out
    }
}

/// What a closer look at a step finds that the loop did not clear.
pub(crate) struct Closer<V, const K: usize> {
    /// Whether a guard may fall.
    pub(crate) fails: bool,
    /// Storeys and floors whose peaks of drift or shear and of acceleration the end of the step may beat.
    beaten: [Set; 2],
    /// Those that may turn beyond their peaks inside the step.
    turns: [Set; 2],
    /// Storeys and floors whose drifts, drift rates and accelerations come to their bounds, and the ranges of these.
    pub(crate) suspects: [Set; 3],
    pub(crate) ranges: [[[V; K]; 2]; 3],
}

impl<V: Vector, const K: usize> Closer<V, K> {
    /// Looks at what the loop did not clear in a step by the Bezier points themselves. Margins are per unit of `norm`;
    /// `bounds` are those of the run, `in_state` those that the state has.
    #[inline(always)]
    pub(crate) fn look(
        suspects: [Set; 3],
        bounds: &BoundsInLanes<V, K>,
        in_state: &Bounds,
        [before, after]: [&Sample<V, K>; 2],
        (norm, margins): (V, &[[V; K]; 4]),
        h: f64,
        least_contact: V,
    ) -> Self {
        let (zero, third) = (V::splat(0.0), V::splat(h * THIRD));
        let (lowest, highest): ([V; K], [V; K]) = (load(&in_state.guarded[0]), load(&in_state.guarded[1]));
        // Between its ends a jerk differs from its chord by at most h^2 / 8 times its second derivative.
        let chord = V::splat(0.125 * h * h / off_cubic(h));
        let mut closer =
            Self { fails: false, beaten: [0; 2], turns: [0; 2], suspects: [0; 3], ranges: [[[zero; K]; 2]; 3] };
        for k in 0..K {
            let lanes = WIDTH * k;
            let of = [suspects[0] >> lanes, suspects[1] >> lanes, suspects[2] >> lanes];
            let of = [of[0] as u32 & LANES, of[1] as u32 & LANES, of[2] as u32 & LANES];
            // Rates keep the signs that they must keep: those of plastic storeys, and where a peak is followed.
            let (start, end) = ([before.v[k], before.q[k]], [after.v[k], after.q[k]]);
            let rate = ranges(start, end, third, norm.mul(margins[1][k]));
            let turning = of[1] & against(rate, bounds.sign[k]).not_below(bounds.turn[k]);
            // Drifts come to no guard; they beat no peak, or at the end of the step.
            let (start, end) = ([before.x[k], before.v[k]], [after.x[k], after.v[k]]);
            let drift = ranges(start, end, third, norm.mul(margins[0][k]));
            let beaten = of[0] & farthest(drift, bounds.middle[k]).not_below(bounds.reach[k]);
            let guarded = drift.1.not_below(highest[k]) | lowest[k].not_below(drift.0);
            let (forward, backward) = signs(rate);
            let steady = forward | backward;
            let plastic = in_state.plastic_in::<V, K>(k);
            closer.fails |= (beaten | turning) & guarded | turning & plastic != 0;
            closer.beaten[0] |= Set::from(beaten) << lanes;
            closer.turns[0] |= Set::from(turning & !plastic | beaten & !steady) << lanes;
            // The same of accelerations.
            let (start, end) = ([before.a[k], before.jerk[k]], [after.a[k], after.jerk[k]]);
            let (low, high) = ranges(start, end, third, norm.mul(margins[2][k]));
            let size = high.max(zero.sub(low));
            let breaks = size.not_below(bounds.stuck_mu[k].mul(least_contact));
            let beaten = of[2] & size.not_below(bounds.a_peak[k]);
            let (jerk, jerk_after) = (before.jerk[k], after.jerk[k]);
            let turn = norm.mul(margins[3][k]).mul(chord);
            let steady = !zero.not_below(jerk.mul(jerk_after)) & !turn.not_below(jerk.abs().min(jerk_after.abs()));
            closer.fails |= of[2] & breaks != 0;
            closer.beaten[1] |= Set::from(beaten) << lanes;
            closer.turns[1] |= Set::from(beaten & !steady) << lanes;
            closer.suspects[1] |= Set::from(turning) << lanes;
            closer.suspects[2] |= Set::from(beaten | of[2] & breaks) << lanes;
            for (out, (low, high)) in closer.ranges.iter_mut().zip([drift, rate, (low, high)]) {
                (out[0][k], out[1][k]) = (low, high);
            }
        }
        closer.suspects[0] = closer.beaten[0];
        closer
    }
}

/// Peaks that a run of plain steps beats, and what is known of them until they are taken.
pub(crate) struct Beaten {
    /// Storeys whose drifts beat their peaks: taken at the end, up to which their rates must keep their signs.
    followed: Set,
    /// Floors whose accelerations have beaten their peaks, with these accelerations and their times.
    floors: Set,
    acceleration: Padded,
    time: Padded,
    /// Storeys and floors that turn beyond their peaks inside the step at which the run has stopped, where that is all.
    turns: [Set; 2],
    /// Whether they may not do so once the peaks up to the start of the step are taken.
    waits: bool,
    /// Those of which the turns inside the first step are taken.
    turned: [Set; 2],
    /// Storeys of these whose drifts at its end may beat their peaks, and drifts there.
    ended: Set,
    end: Padded,
}

impl Beaten {
    pub(crate) fn new(model: &Model) -> Self {
        let zero = || Padded::new(model.width, 0.0);
        Self {
            followed: 0,
            floors: 0,
            acceleration: zero(),
            time: zero(),
            turns: [0; 2],
            waits: false,
            turned: [0; 2],
            ended: 0,
            end: zero(),
        }
    }

    /// Whether bounds have been changed for peaks that are not taken yet.
    pub(crate) fn any(&self) -> bool {
        self.followed | self.floors != 0
    }

    /// Takes note of what a closer look has found of a step; false where the run has to stop at it, as it has where it
    /// `fails`, by the look or for another reason. `bounds` are those of the state.
    #[inline(always)]
    pub(crate) fn note<V: Vector, const K: usize>(
        &mut self,
        closer: &Closer<V, K>,
        fails: bool,
        is_first: bool,
        [before, after]: [&Sample<V, K>; 2],
        time: f64,
        (bounds, in_lanes): (&Bounds, &mut BoundsInLanes<V, K>),
    ) -> bool {
        let turned = if is_first { self.turned } else { [0; 2] };
        let turns = [closer.turns[0] & !turned[0], closer.turns[1] & !turned[1]];
        if fails {
            return false;
        }
        if turns != [0; 2] {
            // A drift that is followed may not have beaten its peak yet.
            let (middle, reach): ([V; K], [V; K]) = (load(&bounds.middle), load(&bounds.reach));
            let mut beyond = 0;
            for k in 0..K {
                beyond |= Set::from(before.x[k].sub(middle[k]).abs().not_below(reach[k])) << (WIDTH * k);
            }
            (self.turns, self.waits) = (turns, turns[0] & self.followed & !beyond != 0);
            return false;
        }
        if turned[0] != 0 {
            self.ended = turned[0];
            store(&after.x, &mut self.end);
        }
        let followed = closer.beaten[0] & !turned[0];
        self.followed |= followed;
        let (low, high): ([V; K], [V; K]) = (load(&bounds.guarded[0]), load(&bounds.guarded[1]));
        let (mut accelerations, mut times): ([V; K], [V; K]) = (load(&self.acceleration), load(&self.time));
        for k in 0..K {
            let lanes = WIDTH * k;
            let (x, a, size) = (after.x[k], after.a[k], after.a[k].abs());
            let drifts = (followed >> lanes) as u32 & LANES;
            let negative = !after.v[k].not_below(V::splat(0.0));
            let sign = V::splat(1.0).with(negative, V::splat(-1.0));
            // From here to the guard on the side that the drift goes to.
            let to_guard = high[k].sub(x).with(negative, x.sub(low[k]));
            in_lanes.middle[k] = in_lanes.middle[k].with(drifts, x);
            in_lanes.reach[k] = in_lanes.reach[k].with(drifts, to_guard);
            in_lanes.sign[k] = in_lanes.sign[k].with(drifts, sign);
            in_lanes.turn[k] = in_lanes.turn[k].with(drifts, V::splat(0.0));
            let floors = (closer.beaten[1] >> lanes) as u32 & LANES & !in_lanes.a_peak[k].not_below(size);
            self.floors |= Set::from(floors) << lanes;
            in_lanes.a_peak[k] = in_lanes.a_peak[k].with(floors, size);
            accelerations[k] = accelerations[k].with(floors, a);
            times[k] = times[k].with(floors, V::splat(time));
        }
        store(&accelerations, &mut self.acceleration);
        store(&times, &mut self.time);
        true
    }

    /// Storeys whose drifts beat their peaks, which their bounds do not tell.
    pub(crate) fn followed(&self) -> Set {
        self.followed
    }

    /// Takes peaks after steps, the first of which ended at a time: of accelerations, and of drifts at the end of a first
    /// step in which these have turned.
    pub(crate) fn take_steps(&mut self, state: &State, observer: &mut Observer, first_end: f64) {
        for i in members(take(&mut self.floors)) {
            observer.take_acceleration(i, self.acceleration[i], self.time[i]);
        }
        for i in members(take(&mut self.ended)) {
            observer.take_drift(state, i, self.end[i], first_end);
        }
    }

    /// Forgets of which the turns inside the first step are taken: the run begins or has gone on.
    pub(crate) fn forget_turned(&mut self) {
        self.turned = [0; 2];
    }

    /// Takes the peaks of drifts that have been followed, where they have come to.
    pub(crate) fn take_followed(&mut self, state: &mut State, observer: &mut Observer, time: f64) {
        for i in members(take(&mut self.followed)) {
            state.bounds.spoil();
            observer.take_drift(state, i, state.x[i], time);
        }
    }

    /// Storeys and floors that turn beyond their peaks inside the step at which the run has stopped, and whether they may
    /// not do so once the peaks up to its start are taken; none where it has stopped for a guard.
    pub(crate) fn take_turns(&mut self) -> ([Set; 2], bool) {
        (take(&mut self.turns), take(&mut self.waits))
    }

    /// Takes the turns inside the interval of `h` at which the run has stopped, by its series, and what beats a peak at its
    /// end once it is taken.
    pub(crate) fn turn(&mut self, state: &mut State, observer: &mut Observer, h: f64, turns: [Set; 2]) {
        by_width!(state.model.width, K => take_turns::<K>(state, observer, h, turns));
        self.turned = [self.turned[0] | turns[0], self.turned[1] | turns[1]];
    }
}

for_each_path! {
    /// Takes the turns of some storeys and floors inside an interval of `h`, at whose start the state is, into the peaks.
    fn take_turns[K: usize](state: &mut State, observer: &mut Observer, h: f64, turns: [Set; 2]) = turns_by_path
}

#[inline(always)]
fn turns_by_path<V: Vector, const K: usize>(state: &mut State, observer: &mut Observer, h: f64, turns: [Set; 2]) {
    state.form_series::<V, K>(0.0, h);
    observer.take_turns::<V, K>(state, turns);
}
