//! Bounds between which no guard of a storey or floor falls and no peak is beaten.

use crate::lanes::{FAR, Padded, Vector, load, store};
use crate::machines::sign::Sign;
use crate::polynomial::enclosure::{distance_against, largest_distance, separations};
use crate::state::sample::Sample;

/// Bounds of all storeys and floors, padded; in lanes beyond the last storey they are far. They hold once they are
/// brought up to date (`record::update`), until a spring changes or a peak is beaten; where a run of plain steps
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
    pub(crate) is_stale: bool,
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

/// The bounds of [`crate::state::limits::Bounds`] in vectors.
pub(crate) struct BoundsInLanes<V, const K: usize> {
    pub(crate) middle: [V; K],
    pub(crate) reach: [V; K],
    pub(crate) sign: [V; K],
    pub(crate) turn: [V; K],
    pub(crate) stuck_mu: [V; K],
    pub(crate) a_peak: [V; K],
}

impl<V: Vector, const K: usize> BoundsInLanes<V, K> {
    #[inline(always)]
    pub(crate) fn of(bounds: &Bounds) -> Self {
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
            0 => largest_distance(range, self.middle[k]).not_below(self.reach[k]),
            1 => distance_against(range, self.sign[k]).not_below(self.turn[k]),
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

    /// [`separations`] of all vectors.
    #[inline(always)]
    pub(crate) fn separations(&self, sample: &Sample<V, K>, third: V) -> [[V; K]; 3] {
        let mut out = [sample.x, sample.v, sample.a];
        for k in 0..K {
            let (drift, floor) = ([sample.x[k], sample.v[k], sample.q[k]], [sample.a[k], sample.jerk[k]]);
            [out[0][k], out[1][k], out[2][k]] = separations(drift, floor, self.middle[k], self.sign[k], third);
        }
        out
    }
}
