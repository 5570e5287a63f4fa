//! TallBounds of tall buildings between which no guard falls and no peak is beaten, and the peaks that runs of theirs beat:
//! those of [`crate::state::limits`] and [`crate::record::observer`], of any number of storeys, four at a time.

use crate::lanes::{ALL_LANES, FAR, Set, Vector, WIDTH, at, filled_to, lanes, members};
use crate::machines::sign::Sign;
use crate::plain::tall::sample::TallSample;
use crate::polynomial::enclosure::separations;
use crate::record::observer::Observer;
use crate::record::peaks::PeakLanes;
use crate::regime::Row;
use crate::state::State;

/// The bounds of [`crate::state::limits::Bounds`] in a vector of storeys and their floors.
pub(crate) struct VectorBounds {
    pub(crate) middle: [f64; WIDTH],
    pub(crate) reach: [f64; WIDTH],
    pub(crate) sign: [f64; WIDTH],
    pub(crate) turn: [f64; WIDTH],
    pub(crate) stuck_mu: [f64; WIDTH],
}

/// Peaks of a vector of storeys or floors, with the values of which they are the sizes.
struct VectorPeaks {
    size: [f64; WIDTH],
    /// Drift coordinate or acceleration.
    of: [f64; WIDTH],
    time: [f64; WIDTH],
}

impl VectorPeaks {
    fn new(peaks: &PeakLanes, k: usize) -> Self {
        let size = lanes(peaks.sizes()).get(k).copied().unwrap_or([FAR; WIDTH]);
        Self { size, of: [0.0; WIDTH], time: [0.0; WIDTH] }
    }

    /// Takes the sizes of something of values at one time, where they beat the peaks.
    #[inline(always)]
    fn take<V: Vector>(&mut self, sizes: V, of: &[f64; WIDTH], time: f64) {
        let kept = V::load(&self.size);
        let beaten = !kept.not_below(sizes) & ALL_LANES;
        kept.max(sizes).store(&mut self.size);
        for lane in members(Set::from(beaten)) {
            (self.of[lane], self.time[lane]) = (of[lane], time);
        }
    }

    /// Takes the size of something of a value, if it beats the peak.
    fn take_one(&mut self, lane: usize, size: f64, of: f64, time: f64) {
        if size > self.size[lane] {
            (self.size[lane], self.of[lane], self.time[lane]) = (size, of, time);
        }
    }
}

/// What the peaks of a vector of storeys and their floors follow from.
pub(crate) struct PeakSources {
    /// Drift and spring force where the drift coordinate is zero.
    base: [f64; WIDTH],
    force: [f64; WIDTH],
    tangent: [f64; WIDTH],
    /// 1 / tangent; without it zero, and far.
    flexibility: [f64; WIDTH],
    inflexible: [f64; WIDTH],
    /// Drift coordinates between which no guard falls.
    low: [f64; WIDTH],
    high: [f64; WIDTH],
    drift: VectorPeaks,
    shear: VectorPeaks,
    acceleration: VectorPeaks,
}

impl PeakSources {
    fn new(state: &State, observer: &Observer, k: usize) -> Self {
        let (n, from, regime) = (state.storeys(), WIDTH * k, &state.regime);
        let (tangents, flexibilities) = (regime.row(Row::SpringTangent), regime.row(Row::SpringFlexibility));
        let by_storey = |padding: f64, value: &dyn Fn(usize) -> f64| {
            [0, 1, 2, 3].map(|lane| if from + lane < n { value(from + lane) } else { padding })
        };
        Self {
            base: by_storey(0.0, &|i| state.springs.machines[i].drift(0.0)),
            force: by_storey(0.0, &|i| state.springs.base_force[i]),
            tangent: by_storey(0.0, &|i| tangents[i]),
            flexibility: by_storey(0.0, &|i| flexibilities[i]),
            inflexible: by_storey(FAR, &|i| if flexibilities[i] > 0.0 { 0.0 } else { FAR }),
            low: by_storey(-FAR, &|i| state.springs.guarded_drift(i).0.max(-FAR)),
            high: by_storey(FAR, &|i| state.springs.guarded_drift(i).1.min(FAR)),
            drift: VectorPeaks::new(&observer.drift, k),
            shear: VectorPeaks::new(&observer.shear, k),
            acceleration: VectorPeaks::new(&observer.acceleration, k),
        }
    }

    /// Middle and reach of the drift coordinates between which no guard falls and no peak is beaten.
    #[inline(always)]
    fn middle_and_reach<V: Vector>(&self) -> (V, V) {
        let (base, peak, half) = (V::load(&self.base), V::load(&self.drift.size), V::splat(0.5));
        let (force, shear) = (V::load(&self.force), V::load(&self.shear.size));
        let (flexibility, inflexible) = (V::load(&self.flexibility), V::load(&self.inflexible));
        let most = shear.sub(force).mul(flexibility).add(inflexible);
        let least = shear.add(force).mul(flexibility).add(inflexible);
        let high = V::load(&self.high).min(peak.sub(base)).min(most);
        let below = V::splat(0.0).sub(V::load(&self.low)).min(peak.add(base)).min(least);
        (half.mul(high.sub(below)), half.mul(high.add(below)))
    }
}

/// TallBounds and peaks of all storeys and floors.
pub(crate) struct TallBounds {
    pub(crate) vectors: Vec<VectorBounds>,
    courses: Vec<PeakSources>,
    /// Largest peaks of drifts and of floor accelerations so far, by lane.
    largest: [[f64; WIDTH]; 2],
}

/// [`separations`] of a vector.
pub(crate) type Separations = [[f64; WIDTH]; 3];

impl TallBounds {
    pub(crate) fn new(state: &State, observer: &Observer, length: usize) -> Self {
        let signs = state.springs.machines.iter().map(|s| s.rate_sign().map_or(0.0, Sign::factor));
        let signs = filled_to(length, signs, 0.0);
        let stuck_mu = filled_to(length, state.blocks.stuck_mu[1..].iter().map(|mu| mu.min(FAR)), FAR);
        let vectors = lanes(&signs).iter().zip(lanes(&stuck_mu)).map(|(&sign, &stuck_mu)| VectorBounds {
            middle: [0.0; WIDTH],
            reach: [0.0; WIDTH],
            sign,
            turn: sign.map(|sign| if sign == 0.0 { FAR } else { 0.0 }),
            stuck_mu,
        });
        let largest = |peaks: &PeakLanes| [peaks.sizes()[..state.storeys()].iter().copied().fold(0.0, f64::max); WIDTH];
        Self {
            vectors: vectors.collect(),
            courses: (0..length / WIDTH).map(|k| PeakSources::new(state, observer, k)).collect(),
            largest: [largest(&observer.drift), largest(&observer.acceleration)],
        }
    }

    /// Brings the bounds of drifts in vector `k` up to date with their peaks.
    #[inline(always)]
    pub(crate) fn update<V: Vector>(&mut self, k: usize) {
        let (middle, reach) = self.courses[k].middle_and_reach::<V>();
        middle.store(&mut self.vectors[k].middle);
        reach.store(&mut self.vectors[k].reach);
    }

    /// Drift coordinates of vector `k` between which no guard falls.
    #[inline(always)]
    pub(crate) fn guarded_drifts<V: Vector>(&self, k: usize) -> (V, V) {
        (V::load(&self.courses[k].low), V::load(&self.courses[k].high))
    }

    /// Peaks of the floor accelerations of vector `k`.
    #[inline(always)]
    pub(crate) fn acceleration_peaks<V: Vector>(&self, k: usize) -> V {
        V::load(&self.courses[k].acceleration.size)
    }

    /// [`Separations`] of vector `k`.
    #[inline(always)]
    pub(crate) fn separations<V: Vector>(&self, sample: &TallSample, margin: usize, third: V, k: usize) -> [V; 3] {
        let of_vector = &self.vectors[k];
        let drift = [at(&sample.x, k), at(&sample.v, k), at(&sample.q[margin..], k)];
        let floor = [at(&sample.a[1..], k), at(&sample.jerk[1..], k)];
        separations(drift, floor, V::load(&of_vector.middle), V::load(&of_vector.sign), third)
    }

    /// Takes drifts and shears of vector `k` at drift coordinates into their peaks.
    #[inline(always)]
    pub(crate) fn take_drifts<V: Vector>(&mut self, k: usize, x: &[f64; WIDTH], time: f64) {
        let step_columns = &mut self.courses[k];
        let at = V::load(x);
        let drift = V::load(&step_columns.base).add(at).abs();
        let shear = V::load(&step_columns.force).add(V::load(&step_columns.tangent).mul(at)).abs();
        step_columns.drift.take(drift, x, time);
        step_columns.shear.take(shear, x, time);
        V::load(&self.largest[0]).max(drift).store(&mut self.largest[0]);
    }

    /// Takes floor accelerations of vector `k` into their peaks.
    #[inline(always)]
    pub(crate) fn take_accelerations<V: Vector>(&mut self, k: usize, a: &[f64; WIDTH], time: f64) {
        let sizes = V::load(a).abs();
        self.courses[k].acceleration.take(sizes, a, time);
        V::load(&self.largest[1]).max(sizes).store(&mut self.largest[1]);
    }

    /// Takes drift and shear of storey `i` at a drift coordinate into their peaks.
    pub(crate) fn take_drift(&mut self, i: usize, x: f64, time: f64) {
        let (step_columns, lane) = (&mut self.courses[i / WIDTH], i % WIDTH);
        let drift = (step_columns.base[lane] + x).abs();
        let shear = (step_columns.force[lane] + step_columns.tangent[lane] * x).abs();
        step_columns.drift.take_one(lane, drift, x, time);
        step_columns.shear.take_one(lane, shear, x, time);
        self.largest[0][0] = self.largest[0][0].max(drift);
    }

    /// Takes an acceleration of floor `i` into its peak.
    pub(crate) fn take_acceleration(&mut self, i: usize, a: f64, time: f64) {
        self.courses[i / WIDTH].acceleration.take_one(i % WIDTH, a.abs(), a, time);
        self.largest[1][0] = self.largest[1][0].max(a.abs());
    }

    /// Largest peaks so far, of drifts and of floor accelerations.
    pub(crate) fn largest_peaks(&self) -> (f64, f64) {
        let [drifts, accelerations] = self.largest.map(|sizes| sizes.into_iter().fold(0.0, f64::max));
        (drifts, accelerations)
    }

    /// Gives the peaks that were beaten to the observer.
    pub(crate) fn put_peaks(&self, state: &State, observer: &mut Observer) {
        for i in 0..state.storeys() {
            let (step_columns, lane) = (&self.courses[i / WIDTH], i % WIDTH);
            let beaten = |peaks: &VectorPeaks, kept: &PeakLanes| {
                (peaks.size[lane] > kept.sizes()[i]).then_some((peaks.of[lane], peaks.time[lane]))
            };
            let acceleration = beaten(&step_columns.acceleration, &observer.acceleration);
            let mut places =
                [beaten(&step_columns.drift, &observer.drift), beaten(&step_columns.shear, &observer.shear)];
            // In order of time: the value of one may be just that of the other's peak, which was there before.
            if let [Some((_, first)), Some((_, second))] = places
                && second < first
            {
                places.swap(0, 1);
            }
            for (x, time) in places.into_iter().flatten() {
                observer.take_drift(state, i, x, time);
            }
            if let Some((a, time)) = acceleration {
                observer.take_acceleration(state, i, a, time);
            }
        }
    }
}
