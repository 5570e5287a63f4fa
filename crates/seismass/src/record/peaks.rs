//! Peaks of storeys or floors.

use crate::lanes::{ALL_LANES, FAR, Padded, Vector, WIDTH, vector_of};
use crate::response::Peak;

/// Peaks of storeys or floors, padded: beyond the last they are far, and nothing beats them.
pub(crate) struct PeakLanes {
    pub(crate) size: Padded,
    time: Padded,
}

impl PeakLanes {
    pub(crate) fn new(storeys: usize) -> Self {
        let zeros = || std::iter::repeat_n(0.0, storeys);
        Self { size: Padded::filled(zeros(), storeys, FAR), time: Padded::filled(zeros(), storeys, 0.0) }
    }

    /// Sizes, padded.
    pub(crate) fn sizes(&self) -> &[f64] {
        &self.size
    }

    /// Takes one value if it beats its peak; tells whether it did.
    #[inline]
    pub(crate) fn take(&mut self, i: usize, value: f64, time: f64) -> bool {
        let beats = value.abs() > self.size[i];
        if beats {
            (self.size[i], self.time[i]) = (value.abs(), time);
        }
        beats
    }

    /// [`PeakLanes::take`] within the code of a path, of which vectors are read soon.
    #[inline(always)]
    pub(crate) fn take_lane<V: Vector, const K: usize>(&mut self, i: usize, value: f64, time: f64) -> bool {
        let values = V::splat(0.0).with_lane(i % WIDTH, value);
        self.take_vector::<V, K>(vector_of::<K>(i), values, time) != 0
    }

    /// Takes the values of vector `k` that beat their peaks; tells, as bits, which did.
    #[inline(always)]
    pub(crate) fn take_vector<V: Vector, const K: usize>(&mut self, k: usize, values: V, time: f64) -> u32 {
        let kept = self.size.vector::<V, K>(k);
        let beaten = !kept.not_below(values.abs()) & ALL_LANES;
        // What is no number beats nothing.
        self.size.set_vector::<V, K>(k, values.abs().max(kept));
        let times = self.time.vector::<V, K>(k);
        self.time.set_vector::<V, K>(k, times.with(beaten, V::splat(time)));
        beaten
    }

    pub(crate) fn peaks(&self, storeys: usize) -> Vec<Peak> {
        self.size.iter().zip(&self.time).take(storeys).map(|(&value, &time)| Peak { value, time }).collect()
    }
}
