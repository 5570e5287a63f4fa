//! A motion with its sample intervals divided.

use seismass::{Motion, Result};

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
