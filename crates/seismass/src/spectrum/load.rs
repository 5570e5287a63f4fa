//! Motions as oscillators take them, and what they may be.

use crate::error::{Domain, Error, Result};
use crate::memory::is_there_memory;
use crate::scene::Motion;

/// OscillatorSteps that share one bound of |u|.
pub(super) const BLOCK: usize = 32;
/// Largest power of two, and its inverse, that motions are divided by.
pub(super) const LARGEST_EXPONENT: f64 = 1000.0;

/// Shortest and longest period of an oscillator over the time step of its motion.
pub const PERIOD_RANGE: [f64; 2] = [1e-3, 1e9];

/// Number of oscillators under all motions, for each of which there is memory for `numbers`.
pub(super) fn validate(motions: &[Motion], periods: &[f64], damping: &[f64], numbers: usize) -> Result<usize> {
    for (i, &period) in periods.iter().enumerate() {
        if !(period.is_finite() && period > 0.0) {
            let owner = format!("oscillator {}", i + 1);
            return Err(Error::invalid(Domain::Options, "period", owner, "a positive number", period));
        }
    }
    if let Some((i, zeta)) = damping.iter().enumerate().find(|(_, zeta)| !(0.0..1.0).contains(*zeta)) {
        let owner = format!("spectrum {}", i + 1);
        return Err(Error::invalid(Domain::Options, "damping", owner, "at least 0 and below 1", zeta));
    }
    for (m, motion) in motions.iter().enumerate() {
        let [shortest, longest] = PERIOD_RANGE.map(|ratio| ratio * motion.dt());
        if let Some((i, period)) = periods.iter().enumerate().find(|(_, t)| !(shortest..=longest).contains(*t)) {
            let owner = format!("oscillator {}", i + 1);
            let requirement = format!("from {shortest} to {longest} s for the time step of motion {}", m + 1);
            return Err(Error::invalid(Domain::Options, "period", owner, requirement, period));
        }
    }
    let count = motions.len().saturating_mul(periods.len().saturating_mul(damping.len()));
    if !is_there_memory(count.saturating_mul(numbers)) {
        let requirement = "of so few oscillators and motions that their peaks fit into memory";
        return Err(Error::invalid(Domain::Options, "periods", "spectrum", requirement, format!("{count} peaks")));
    }
    Ok(count)
}

/// A motion times dt^2 (m) and a factor, without its quiet head and tail but for the zeros that follow it, and what bounds
/// it in each block of steps. Before it nothing moves; the free vibration after it is known in closed form.
pub(super) struct Load {
    pub(super) samples: Vec<f64>,
    /// The sample of the motion with which they begin.
    pub(super) first: usize,
    pub(super) blocks: Vec<LoadBounds>,
    /// The inverse of the factor: a power of two, near the largest acceleration, so that no square leaves the range of
    /// numbers.
    pub(super) unit: f64,
}

/// Largest sample and largest increment within a block.
pub(super) struct LoadBounds {
    pub(super) sample: f64,
    pub(super) increment: f64,
}

impl Load {
    pub(super) fn new(motion: &Motion) -> Self {
        let square = motion.dt() * motion.dt();
        let acceleration = motion.acceleration();
        let first = acceleration.iter().position(|&a| a != 0.0).unwrap_or(0).saturating_sub(1);
        let last = acceleration.iter().rposition(|&a| a != 0.0).unwrap_or(0);
        let largest = acceleration.iter().fold(0.0, |most, a| a.abs().max(most));
        let exponent =
            if largest > 0.0 { libm::log2(largest).clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT) as i32 } else { 0 };
        let (unit, per_unit) = (2f64.powi(exponent), 2f64.powi(-exponent));
        let scaled = acceleration[first..=last].iter().map(|a| square * (a * per_unit));
        let samples: Vec<f64> = scaled.chain([0.0; 2]).collect();
        let ends = &samples[..samples.len() - 1];
        let blocks = (0..ends.len() - 1)
            .step_by(BLOCK)
            .map(|start| {
                let within = &ends[start..ends.len().min(start + BLOCK + 1)];
                LoadBounds {
                    sample: within.iter().fold(0.0, |most, b| b.abs().max(most)),
                    increment: within.windows(2).fold(0.0, |most, b| (b[1] - b[0]).abs().max(most)),
                }
            })
            .collect();
        Self { samples, first, blocks, unit }
    }

    /// Samples at the ends of the steps of a block, and the next.
    pub(super) fn block(&self, index: usize) -> &[f64] {
        let start = index * BLOCK;
        &self.samples[start..self.samples.len().min(start + BLOCK + 2)]
    }
}
