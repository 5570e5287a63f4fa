//! Bounds between which no guard of a storey or floor falls and no peak is beaten, kept up to date storey by storey.

use crate::lanes::{FAR, Vector, filled};
use crate::observe::Observer;
use crate::state::State;
use crate::storey::Sign;

/// Storeys or floors as bits.
pub(crate) type Set = u64;

/// The set of one storey, or of none beyond the bits: so many storeys are always looked at all.
#[inline]
pub(crate) fn only(i: usize) -> Set {
    if i < Set::BITS as usize { 1 << i } else { 0 }
}

/// The set of the first so many storeys, or of all that a set holds.
#[inline]
pub(crate) fn first(storeys: usize) -> Set {
    if storeys < Set::BITS as usize { only(storeys) - 1 } else { Set::MAX }
}

/// The members of a set, in order.
#[inline(always)]
pub(crate) fn members(mut set: Set) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (set != 0).then(|| set.trailing_zeros() as usize);
        set &= set.wrapping_sub(1);
        lowest
    })
}

/// Bounds of all storeys and floors, padded; in lanes beyond the last storey they are far. They hold once they are
/// brought up to date ([`State::update_bounds`]), until a spring changes or a peak is beaten; where a run of plain steps
/// follows a peak that a drift beats, they are the guard ahead and the sign that its rate must keep, up to the run's end.
#[derive(Debug)]
pub(crate) struct Bounds {
    /// Drift coordinates: the middle, and how far they may go from it.
    pub(crate) middle: Vec<f64>,
    pub(crate) reach: Vec<f64>,
    /// Drift coordinates between which no guard falls.
    pub(crate) guarded: [Vec<f64>; 2],
    /// Drift rates of plastic storeys: their signs, and what their negative may not reach (0; else far).
    pub(crate) sign: Vec<f64>,
    pub(crate) turn: Vec<f64>,
    /// Smallest mu_s of the blocks stuck to each floor, far where none is; peak of the floor acceleration.
    pub(crate) stuck_mu: Vec<f64>,
    pub(crate) a_peak: Vec<f64>,
    /// Plastic storeys.
    pub(crate) plastic: Set,
    /// Storeys whose springs have changed since the last update.
    stale: Set,
}

impl Bounds {
    /// Bounds that are to be formed yet.
    pub(crate) fn new(storeys: usize) -> Self {
        let lanes = |inside: f64, padding: f64| filled(std::iter::repeat_n(inside, storeys), storeys, padding);
        Self {
            middle: lanes(0.0, 0.0),
            reach: lanes(0.0, FAR),
            guarded: [lanes(0.0, -FAR), lanes(0.0, FAR)],
            sign: lanes(0.0, 0.0),
            turn: lanes(FAR, FAR),
            stuck_mu: lanes(FAR, FAR),
            a_peak: lanes(0.0, FAR),
            plastic: 0,
            stale: Set::MAX,
        }
    }

    /// Notes that the spring of a storey has changed.
    #[inline]
    pub(crate) fn spring_changed(&mut self, i: usize) {
        self.stale |= only(i);
    }
}

/// How far values are from their middles after h / 3 at their rates, to either side: of drifts, of the negative of plastic
/// storeys' rates, of accelerations; from (x, v, q) of drifts and (a, jerk) of floors.
#[inline(always)]
pub(crate) fn apart<V: Vector>([x, v, q]: [V; 3], [a, jerk]: [V; 2], middle: V, sign: V, third: V) -> [V; 3] {
    [
        third.mul_add(v.abs(), x.sub(middle).abs()),
        third.mul(q.abs()).sub(sign.mul(v)),
        third.mul_add(jerk.abs(), a.abs()),
    ]
}

/// How far ranges go from their middles, to either side.
#[inline(always)]
pub(crate) fn farthest<V: Vector>((low, high): (V, V), middle: V) -> V {
    high.sub(middle).max(middle.sub(low))
}

/// How far ranges go against a sign.
#[inline(always)]
pub(crate) fn against<V: Vector>((low, high): (V, V), sign: V) -> V {
    let zero = V::splat(0.0);
    zero.sub(sign.mul(low)).max(zero.sub(sign.mul(high)))
}

/// Lanes, as bits, of ranges above zero, and of those below it.
#[inline(always)]
pub(crate) fn signs<V: Vector>((low, high): (V, V)) -> (u32, u32) {
    let zero = V::splat(0.0);
    (!zero.not_below(low), !high.not_below(zero))
}

/// The middle of a range and half its length, made finite.
#[inline(always)]
pub(crate) fn middle_and_reach((low, high): (f64, f64)) -> (f64, f64) {
    let (low, high) = (low.max(-FAR), high.min(FAR));
    (0.5 * (low + high), 0.5 * (high - low))
}

impl State<'_> {
    /// Brings the bounds up to date with springs and peaks.
    #[inline]
    pub(crate) fn update_bounds(&mut self, observer: &mut Observer) {
        let (drifts, accelerations) = observer.take_beaten();
        let springs = self.bounds.stale;
        if drifts | accelerations | springs == 0 {
            return;
        }
        let within = first(self.storeys());
        for i in members((springs | drifts) & within) {
            (self.bounds.middle[i], self.bounds.reach[i]) = self.quiet_middle_and_reach(observer, i);
        }
        for i in members(springs & within) {
            (self.bounds.guarded[0][i], self.bounds.guarded[1][i]) = self.guarded_drift(i);
            let sign = self.springs[i].plastic().map_or(0.0, Sign::factor);
            (self.bounds.sign[i], self.bounds.turn[i]) = (sign, if sign == 0.0 { FAR } else { 0.0 });
            self.bounds.plastic = self.bounds.plastic & !only(i) | if sign == 0.0 { 0 } else { only(i) };
        }
        for i in members(accelerations & within) {
            self.bounds.a_peak[i] = observer.peaks.floor_acceleration[i].value;
        }
        self.bounds.stale = 0;
    }

    /// Middle and reach of the drift coordinates of a storey between which no guard falls and no peak is beaten.
    #[inline]
    pub(crate) fn quiet_middle_and_reach(&self, observer: &Observer, i: usize) -> (f64, f64) {
        let (guarded, quiet) = (self.guarded_drift(i), observer.quiet_drift(self, i));
        middle_and_reach((guarded.0.max(quiet.0), guarded.1.min(quiet.1)))
    }

    /// Drift coordinates of a storey between which it does not yield or collapse.
    #[inline]
    pub(crate) fn guarded_drift(&self, i: usize) -> (f64, f64) {
        let (yields, collapses) = (self.yield_bounds[i], self.collapse_bounds[i]);
        (yields.0.max(collapses.0), yields.1.min(collapses.1))
    }
}
