//! Motions with their sample intervals divided.

use seismass::{Motion, PlaneMotion, Result};

/// The same motion with each sample interval in `parts`.
///
/// # Errors
/// None for a motion that is valid.
pub fn divided(motion: &Motion, parts: usize) -> Result<Motion> {
    let divide = |samples: &[f64]| -> Vec<f64> {
        let within = |[from, to]: [f64; 2], part: usize| from + (to - from) * part as f64 / parts as f64;
        let intervals =
            samples.windows(2).flat_map(|ends| (0..parts).map(move |part| within([ends[0], ends[1]], part)));
        intervals.chain(samples.last().copied()).collect()
    };
    let vertical = motion.vertical().map(|samples| divide(samples).into());
    Motion::new(divide(motion.acceleration()), motion.dt() / parts as f64, vertical)
}

/// The same motion in two directions with each sample interval in `parts`.
///
/// # Errors
/// None for a motion that is valid.
pub fn divided_plane(motion: &PlaneMotion, parts: usize) -> Result<PlaneMotion> {
    let [x, y] = motion.directions();
    PlaneMotion::new(divided(x, parts)?, divided(y, parts)?.acceleration())
}
