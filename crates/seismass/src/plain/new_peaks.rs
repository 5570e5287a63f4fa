//! Peaks that a run of plain steps beats.

use std::mem::take;

use crate::lanes::{ALL_LANES, Padded, Set, Vector, WIDTH, by_width, for_each_path, load, members, store};
use crate::machines::model::Model;
use crate::plain::guard_check::GuardCheck;
use crate::record::observer::Observer;
use crate::state::State;
use crate::state::limits::{Bounds, BoundsInLanes};
use crate::state::sample::Sample;

/// Peaks that a run of plain steps beats, and what is known of them until they are taken.
pub(crate) struct NewPeaks {
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

impl NewPeaks {
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

    /// Takes note of what the check has found of a step; false where the run has to stop at it, as it has where it
    /// `fails`, by the check or for another reason. `bounds` are those of the state.
    #[inline(always)]
    pub(crate) fn note<V: Vector, const K: usize>(
        &mut self,
        guard_check: &GuardCheck<V, K>,
        fails: bool,
        is_first: bool,
        [before, after]: [&Sample<V, K>; 2],
        time: f64,
        (bounds, in_lanes): (&Bounds, &mut BoundsInLanes<V, K>),
    ) -> bool {
        let turned = if is_first { self.turned } else { [0; 2] };
        let turns = [guard_check.turns[0] & !turned[0], guard_check.turns[1] & !turned[1]];
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
        let followed = guard_check.beaten[0] & !turned[0];
        self.followed |= followed;
        let (low, high): ([V; K], [V; K]) = (load(&bounds.guarded[0]), load(&bounds.guarded[1]));
        let (mut accelerations, mut times): ([V; K], [V; K]) = (load(&self.acceleration), load(&self.time));
        for k in 0..K {
            let lanes = WIDTH * k;
            let (x, a, size) = (after.x[k], after.a[k], after.a[k].abs());
            let drifts = (followed >> lanes) as u32 & ALL_LANES;
            let negative = !after.v[k].not_below(V::splat(0.0));
            let sign = V::splat(1.0).with(negative, V::splat(-1.0));
            // From here to the guard on the side that the drift goes to.
            let to_guard = high[k].sub(x).with(negative, x.sub(low[k]));
            in_lanes.middle[k] = in_lanes.middle[k].with(drifts, x);
            in_lanes.reach[k] = in_lanes.reach[k].with(drifts, to_guard);
            in_lanes.sign[k] = in_lanes.sign[k].with(drifts, sign);
            in_lanes.turn[k] = in_lanes.turn[k].with(drifts, V::splat(0.0));
            let floors = (guard_check.beaten[1] >> lanes) as u32 & ALL_LANES & !in_lanes.a_peak[k].not_below(size);
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
            observer.take_acceleration(state, i, self.acceleration[i], self.time[i]);
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
            observer.take_drift(state, i, state.kinematics.x[i], time);
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
