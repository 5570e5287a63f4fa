//! Ground motion between two samples.

use crate::scene::Motion;
use crate::units::STANDARD_GRAVITY;

/// Ground motion between two samples, linear in time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Interval {
    /// The first sample.
    pub(crate) sample: usize,
    /// Its time (s).
    pub(crate) start: f64,
    /// Length (s).
    pub(crate) h: f64,
    /// Ground acceleration at the start (m/s2).
    pub(crate) ground: f64,
    /// Its change over the interval (m/s2).
    pub(crate) ground_change: f64,
    /// Its slope (m/s3).
    pub(crate) ground_slope: f64,
    /// Contact force per unit mass g + a_v at the start (m/s2).
    pub(crate) contact: f64,
    /// Its change over the interval (m/s2).
    pub(crate) contact_change: f64,
    /// Its slope (m/s3).
    pub(crate) contact_slope: f64,
}

impl Interval {
    /// Ground acceleration at `tau` from the start (m/s2).
    #[inline]
    pub(crate) fn ground_at(&self, tau: f64) -> f64 {
        if self.h > 0.0 { self.ground + self.ground_change * (tau / self.h) } else { self.ground }
    }

    /// Contact force per unit mass at `tau` from the start (m/s2).
    #[inline]
    pub(crate) fn contact_at(&self, tau: f64) -> f64 {
        if self.h > 0.0 { self.contact + self.contact_change * (tau / self.h) } else { self.contact }
    }
}

#[inline(always)]
pub(crate) fn interval(motion: &Motion, vertical: Option<&[f64]>, i: usize) -> Interval {
    let last = motion.acceleration().len() - 1;
    let pair = |samples: &[f64]| (samples[i], samples[(i + 1).min(last)] - samples[i]);
    let (ground, ground_change) = pair(motion.acceleration());
    let (vertical, contact_change) = vertical.map_or((0.0, 0.0), pair);
    let (h, per_second) = if i < last { (motion.dt(), 1.0 / motion.dt()) } else { (0.0, 0.0) };
    Interval {
        sample: i,
        start: i as f64 * motion.dt(),
        h,
        ground,
        ground_change,
        ground_slope: ground_change * per_second,
        contact: STANDARD_GRAVITY + vertical,
        contact_change,
        contact_slope: contact_change * per_second,
    }
}
