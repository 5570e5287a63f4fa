//! Bounds between which no guard of a storey or floor falls and no peak is beaten.

use std::mem::take;

use crate::lanes::padded::Padded;
use crate::lanes::{FAR, MAX_LANES, Vector, load, store};
use crate::machines::sign::Sign;
use crate::record::observer::Observer;
use crate::regime::Row;
use crate::state::State;

/// Storeys or floors as bits.
pub(crate) type Set = u64;

/// The set of the first so many storeys, or of all that a set holds.
#[inline]
pub(crate) fn first(storeys: usize) -> Set {
    if storeys < Set::BITS as usize { (1 << storeys) - 1 } else { Set::MAX }
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
    pub(crate) middle: Padded,
    pub(crate) reach: Padded,
    /// Drift coordinates between which no guard falls.
    pub(crate) guarded: [Padded; 2],
    /// Drift rates of plastic storeys: their signs, and what their negative may not reach (0; else far).
    pub(crate) sign: Padded,
    pub(crate) turn: Padded,
    /// Smallest mu_s of the blocks stuck to each floor, far where none is; peak of the floor acceleration.
    pub(crate) stuck_mu: Padded,
    pub(crate) a_peak: Padded,
    /// Signs of plastic storeys, 0 of others.
    pub(crate) plastic: Padded,
    /// Whether springs have changed since the last update, or bounds themselves.
    is_stale: bool,
}

impl Bounds {
    /// Bounds that are to be formed yet.
    pub(crate) fn new(storeys: usize) -> Self {
        let lanes = |inside: f64, padding: f64| Padded::filled(std::iter::repeat_n(inside, storeys), storeys, padding);
        Self {
            middle: lanes(0.0, 0.0),
            reach: lanes(0.0, FAR),
            guarded: [lanes(0.0, -FAR), lanes(0.0, FAR)],
            sign: lanes(0.0, 0.0),
            turn: lanes(FAR, FAR),
            stuck_mu: lanes(FAR, FAR),
            a_peak: lanes(0.0, FAR),
            plastic: lanes(0.0, 0.0),
            is_stale: true,
        }
    }

    /// Follows a change of a storey's spring: drift coordinates between which no guard falls, and the sign of its forces
    /// if it is plastic.
    #[inline(always)]
    pub(crate) fn follow_spring<V: Vector, const K: usize>(
        &mut self,
        i: usize,
        guarded: (f64, f64),
        plastic: Option<Sign>,
    ) {
        self.guarded[0].set_lane::<V, K>(i, guarded.0);
        self.guarded[1].set_lane::<V, K>(i, guarded.1);
        self.plastic.set_lane::<V, K>(i, plastic.map_or(0.0, Sign::factor));
        self.is_stale = true;
    }

    /// Notes that they are those of a run of plain steps no more.
    pub(crate) fn spoil(&mut self) {
        self.is_stale = true;
    }

    /// Plastic storeys of vector `k`, as bits.
    #[inline(always)]
    pub(crate) fn plastic_in<V: Vector, const K: usize>(&self, k: usize) -> u32 {
        self.plastic.vector::<V, K>(k).abs().not_below(V::splat(1.0))
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

impl State<'_> {
    /// Brings the bounds up to date with springs and peaks. More storeys than vectors hold have no such bounds.
    #[inline(always)]
    pub(crate) fn update_bounds<V: Vector, const K: usize>(&mut self, observer: &mut Observer) {
        if !(observer.take_beaten() | take(&mut self.bounds.is_stale)) || self.storeys() > MAX_LANES {
            return;
        }
        let (zero, half, far) = (V::splat(0.0), V::splat(0.5), V::splat(FAR));
        let flexibility: [V; K] = self.regime.lanes(Row::SpringFlexibility);
        let (base, force): ([V; K], [V; K]) = (load(&self.base_drift), load(&self.base_force));
        let [drift, shear, acceleration] = observer.peak_sizes::<V, K>();
        let bounds = &mut self.bounds;
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
    }

    /// Drift coordinates of a storey between which it does not yield or collapse.
    #[inline]
    pub(crate) fn guarded_drift(&self, i: usize) -> (f64, f64) {
        let (yields, collapses) = (self.segment_ends[i], self.collapse_bounds[i]);
        (yields.0.max(collapses.0), yields.1.min(collapses.1))
    }
}
