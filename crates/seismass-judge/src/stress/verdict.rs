//! What becomes of a scene in which kernel and judge part.

use crate::Comparison;

/// Relative differences below this are agreement.
pub const AGREEMENT: f64 = 1e-9;

/// Changes of the input tried, in units of the last digit of a double (2^-52).
pub(super) const LAST_DIGITS: [f64; 4] = [1.0, 4.0, 16.0, 64.0];

/// Different changes of each size.
pub(super) const TRIALS: u64 = 6;

/// What became of a scene on which two implementations were compared.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Same events at the same times, same numbers: how far apart.
    Agrees(Comparison),
    /// As that, but for peak accelerations of nodes in the last instants before a block stops in the plane, which depend on
    /// where a run is cut off.
    BeforeStops {
        /// How far apart all else is.
        comparison: Comparison,
        /// How the two differed.
        difference: String,
    },
    /// As agreement, but for touches and leaves of stops whose velocities are rounding.
    SlowTouches {
        /// How far apart all else is.
        comparison: Comparison,
        /// How the two differed.
        difference: String,
    },
    /// The judge, with its input changed in the last digits, comes to the kernel's events and numbers.
    Grazing {
        /// The change, in units of the last digit.
        digits: f64,
        /// How the two differed.
        difference: String,
    },
    /// The judge, with its input changed in the last digits or not, has the kernel's events, and moves as far as the
    /// kernel is from it with its input changed in the last digits once more, or by its own rounding in double precision.
    /// Or, for the general engine, a change of the motion in the last digits has been found with which the judge comes to
    /// its events and numbers from the first sample to the last, where differences grow until all events are others.
    Sensitive {
        /// The change, in units of the last digit; 0 where it is the judge's own rounding.
        digits: f64,
        /// How the two differed.
        difference: String,
    },
    /// The logs differ by pairs of events that begin and end at a graze, and nothing else differs: the judge, with its
    /// state changed in the last digits, comes to have or to lack each of them (see [`pairs`]).
    GrazingPairs {
        /// The change, in units of the last digit.
        digits: f64,
        /// How the two differed.
        difference: String,
    },
    /// None of these: a defect of one of them.
    Unexplained(String),
}
