//! Limits of a run: events and phases of an interval, substeps.

use crate::tolerances::SUBSTEP_PHASE;

/// Events one sample interval may have, beside [`EVENTS_PER_MACHINE`].
pub(crate) const EVENTS_PER_INTERVAL: usize = 256;

/// Events each storey and block may have within one vibration of the stiffest mode.
pub(crate) const EVENTS_PER_MACHINE: usize = 64;

/// Most substeps of a sample interval, and of a motion: they are held in memory.
const MOST_SUBSTEPS: usize = 1 << 10;

const MOST_SUBSTEPS_OF_MOTION: usize = 1 << 21;

/// Substeps of each sample interval, a power of two: a time step divided by it, and times that multiples of that are, are
/// exact. `phase` is the frequency that a step must suit times the interval.
pub(crate) fn substeps(phase: f64, samples: usize) -> usize {
    let most = (MOST_SUBSTEPS_OF_MOTION / samples).min(MOST_SUBSTEPS);
    let mut substeps = 1;
    while phase > SUBSTEP_PHASE * substeps as f64 && 2 * substeps <= most {
        substeps *= 2;
    }
    substeps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn substeps_are_short_enough_unless_they_are_too_many() {
        let phases = [0.0, 4.0, 4.1, 8.0, 8.1, 1e3, 1e9, f64::INFINITY, f64::NAN];
        assert_eq!(phases.map(|phase| substeps(phase, 8000)), [1, 1, 2, 2, 4, 256, 256, 256, 1]);
        assert_eq!(phases.map(|phase| substeps(phase, 100)), [1, 1, 2, 2, 4, 256, 1024, 1024, 1]);
        assert_eq!(phases.map(|phase| substeps(phase, MOST_SUBSTEPS_OF_MOTION)), [1; 9]);
    }
}
