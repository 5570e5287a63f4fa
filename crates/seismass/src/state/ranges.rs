//! Ranges of storeys and floors over a step.

use crate::lanes::{ALL_LANES, MAX_LANES, Padded, Set, Vector, WIDEST, WIDTH, first_members, padded, store};
use crate::polynomial::enclosure::{THIRD, off_cubic, ranges};
use crate::regime::{Regime, Row};
use crate::state::limits::BoundsInLanes;
use crate::state::sample::Sample;

/// Ranges of the storeys and floors over a step, proved: each quantity stays between its two bounds. Padded.
#[derive(Debug, Default)]
pub(crate) struct Ranges {
    /// Lower and upper bounds: of drift coordinates, drift rates, floor accelerations.
    pub(crate) bounds: [[Padded; 2]; 3],
    /// Storeys and floors whose drifts, drift rates and accelerations come to their bounds (see [`Bounds`](crate::state::limits::Bounds)).
    pub(crate) near_bound: [Set; 3],
    /// Number of storeys.
    storeys: usize,
    /// h^4 / 384 times the norm of the derivatives: what bounds of fourth derivatives are multiplied with.
    pub(crate) remainder: f64,
    /// h^2 / 8 times the norm of the derivatives, for bounds of second derivatives.
    pub(crate) chord: f64,
    /// Whether they are those of the next series: found by the plain step that was not cleared.
    pub(crate) are_known: bool,
}

impl Ranges {
    pub(crate) fn new(storeys: usize) -> Self {
        let zero = || Padded::new(padded(storeys), 0.0);
        let pair = || [zero(), zero()];
        let bounds = [pair(), pair(), pair()];
        Self { bounds, near_bound: [Set::MAX; 3], storeys, remainder: 0.0, chord: 0.0, are_known: false }
    }

    /// Keeps what the bounds of higher derivatives are multiplied with over `h`, from the norm of the derivatives.
    #[inline]
    pub(crate) fn set_margins(&mut self, derivative_norm: f64, h: f64) {
        (self.remainder, self.chord) = (derivative_norm * off_cubic(h), derivative_norm * (0.125 * h * h));
    }

    /// Whether what is kept by [`Ranges::set_margins`] is a number: if not, no bound holds, nor in lanes beyond the last
    /// storey.
    #[inline(always)]
    pub(crate) fn are_finite(&self) -> bool {
        self.remainder < f64::INFINITY
    }

    /// Forms the ranges over a step of `h` in a regime, of which the margins are kept, from the state at its ends, and
    /// tells which come to their bounds; `contact` is the least contact force.
    #[inline(always)]
    pub(crate) fn form<V: Vector, const K: usize>(
        &mut self,
        [start, end]: [&Sample<V, K>; 2],
        (regime, h): (&Regime, f64),
        (bounds, contact): (&BoundsInLanes<V, K>, V),
    ) {
        let (third, remainder) = (V::splat(h * THIRD), V::splat(self.remainder));
        let of_drifts = (Row::FourthOfDrift, [start.x, start.v], [end.x, end.v]);
        let of_rates = (Row::FourthOfRate, [start.v, start.q], [end.v, end.q]);
        let of_accelerations = (Row::FourthOfAcceleration, [start.a, start.jerk], [end.a, end.jerk]);
        for (which, (row, start, end)) in [of_drifts, of_rates, of_accelerations].into_iter().enumerate() {
            let margins: [V; K] = regime.lanes(row);
            let (mut lows, mut highs, mut near_bound) = (start[0], start[0], 0);
            for k in 0..K {
                let (start, end) = ([start[0][k], start[1][k]], [end[0][k], end[1][k]]);
                (lows[k], highs[k]) = ranges(start, end, third, remainder.mul(margins[k]));
                near_bound |= Set::from(bounds.reached(which, k, (lows[k], highs[k]), contact)) << (WIDTH * k);
            }
            let [low, high] = &mut self.bounds[which];
            store(&lows, low);
            store(&highs, high);
            self.near_bound[which] = near_bound & first_members(self.storeys);
        }
    }

    /// Keeps ranges, and which of them come to their bounds.
    #[inline(always)]
    pub(crate) fn keep<V: Vector, const K: usize>(&mut self, ranges: &[[[V; K]; 2]; 3], near_bound: [Set; 3]) {
        for (bounds, ranges) in self.bounds.iter_mut().zip(ranges) {
            store(&ranges[0], &mut bounds[0]);
            store(&ranges[1], &mut bounds[1]);
        }
        self.near_bound = near_bound;
    }

    #[inline(always)]
    fn of<const K: usize>(&self, which: usize, i: usize) -> (f64, f64) {
        let [low, high] = &self.bounds[which];
        (low.numbers::<K>()[i], high.numbers::<K>()[i])
    }

    #[inline(always)]
    fn vector<V: Vector, const K: usize>(&self, which: usize, k: usize) -> (V, V) {
        let [low, high] = &self.bounds[which];
        (low.vector::<V, K>(k), high.vector::<V, K>(k))
    }

    /// Storeys of vector `k` near their bounds, as bits: drifts (0), drift rates (1) or accelerations (2). All are where there
    /// are more than vectors hold.
    #[inline(always)]
    pub(crate) fn near_bound_in<const K: usize>(&self, which: usize, k: usize) -> Set {
        if K < WIDEST || self.storeys <= MAX_LANES {
            self.near_bound[which] >> (WIDTH * k) & Set::from(ALL_LANES)
        } else {
            first_members(self.storeys.saturating_sub(WIDTH * k).min(WIDTH))
        }
    }

    /// Ranges of the drift coordinates of storeys in vector `k`.
    #[inline(always)]
    pub(crate) fn drifts<V: Vector, const K: usize>(&self, k: usize) -> (V, V) {
        self.vector::<V, K>(0, k)
    }

    /// Ranges of the drift rates of storeys in vector `k`.
    #[inline(always)]
    pub(crate) fn rates<V: Vector, const K: usize>(&self, k: usize) -> (V, V) {
        self.vector::<V, K>(1, k)
    }

    /// Ranges of the absolute accelerations of floors in vector `k`.
    #[inline(always)]
    pub(crate) fn accelerations<V: Vector, const K: usize>(&self, k: usize) -> (V, V) {
        self.vector::<V, K>(2, k)
    }

    /// Range of the drift coordinate of storey `i`.
    #[inline(always)]
    pub(crate) fn drift<const K: usize>(&self, i: usize) -> (f64, f64) {
        self.of::<K>(0, i)
    }

    /// Range of the drift rate of storey `i`.
    #[inline(always)]
    pub(crate) fn rate<const K: usize>(&self, i: usize) -> (f64, f64) {
        self.of::<K>(1, i)
    }

    /// Range of the absolute acceleration of floor `i`.
    #[inline(always)]
    pub(crate) fn acceleration<const K: usize>(&self, i: usize) -> (f64, f64) {
        self.of::<K>(2, i)
    }
}
