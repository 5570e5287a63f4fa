//! Tolerances and phases, each with its reason.

use crate::units::STANDARD_GRAVITY;

/// Slopes of a backbone that differ by less than this, relatively, are those of points on a line, but for rounding.
pub(crate) const SAME_SLOPE: f64 = 1e-9;

/// Columns whose cosine is below this are orthogonal to rounding.
pub(crate) const ORTHOGONAL: f64 = 1e-16;

/// Entries of a matrix across its diagonal that differ by less than this part of the diagonal are equal.
pub(crate) const SAME_ENTRY: f64 = 1e-12;

/// A matrix whose pivots are not below zero by more than this part of its largest diagonal entry is positive
/// semi-definite: matrices are often given with few digits more.
pub(crate) const SEMI_DEFINITE: f64 = 1e-9;

/// Forces of a backbone that agree to this fraction of the largest are equal.
pub(crate) const SAME_FORCE: f64 = 1e-12;

/// Forces and accelerations that agree to this fraction of their terms are equal.
pub(crate) const DECISION_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A segment that ends this close to the collapse drift, relatively, ends there.
pub(crate) const SAME_DRIFT: f64 = 1e-12;

/// A guard falls when it is below zero by more than this fraction of its terms.
pub(crate) const FALL_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Contact forces per unit mass up to this are none (m/s2).
pub(crate) const NO_CONTACT: f64 = FALL_ROUNDING * STANDARD_GRAVITY;

/// Relative velocities below this fraction of their terms, which nothing but rounding drives on, have arrived.
pub(crate) const ARRIVED: f64 = 64.0 * f64::EPSILON;

/// A block on the circle has come to rest where its relative velocity is below this fraction of the largest velocity so far
/// and falls: the rest of slip and time is below rounding.
pub(crate) const ARRIVED_ON_CIRCLE: f64 = 40.0 * f64::EPSILON;

/// A relative velocity below this fraction of the change of its floor's in a step has lost too many digits: at 1e-6, slips
/// of blocks that hardly move were known to 1e-9.
pub(crate) const SMALL_DIFFERENCE: f64 = 1e-4;

/// Peaks this close to each other, relatively, may be the same but for rounding.
pub(crate) const SAME_PEAK: f64 = 1e-9;

/// What a series may leave out of a value, as a part of it.
pub(crate) const SERIES_ROUNDING: f64 = 0.25 * f64::EPSILON;

/// What is at most so large a part of the largest term, or of the largest value in the building, is below rounding: 2^-60.
pub(crate) const BELOW_ROUNDING: f64 = 1.0 / (1u64 << 60) as f64;

/// Entries below this part of the largest in their row are left out: 2^27 below rounding, so that neighbours may differ
/// by as much before it is seen.
pub(crate) const NEGLIGIBLE: f64 = 1.0 / (1u128 << 80) as f64;

/// Longest step of one series, as frequency times time: longer intervals are split.
pub(crate) const SERIES_PHASE: f64 = 1.0;

/// Longest step of one series of the general engine, as frequency times time; beyond [`SERIES_PHASE`] it ends where its terms
/// say. 4^21/21! = 9e-8: the stiffest mode ends it if more than 6e-10 of the accelerations is in it, and at 1.6 if all are.
pub(crate) const GENERAL_PHASE: f64 = 4.0;

/// Longest step of one series, as frequency times time: the largest of its terms is 2.
pub(crate) const BANDED_PHASE: f64 = 2.0;

/// Longest step as frequency times time. What steps act on are differences of large forces there: their rounding would
/// be seen.
pub(crate) const TALL_PHASE: f64 = 8.0;

/// Longest step of a run, as the frequency of the elastic building times time; a motion with longer sample intervals is
/// solved in substeps. What clears a step is a bound that grows with its fourth power, and a step that it does not clear
/// is solved by a series for each radian: shorter steps cost less.
pub(crate) const SUBSTEP_PHASE: f64 = 4.0;

/// Largest growth of a norm over a step by which it is bounded: its products with bounds of derivatives are numbers.
pub(crate) const LARGEST_GROWTH: f64 = 1e100;

/// Most radians of the stiffest vibration in a step: each takes a series of its own where something happens.
pub(crate) const REFUSED_PHASE: f64 = 65536.0;

/// What a decision of blocks at stops takes as equal, as a part of limits and accelerations, times how much heavier a node
/// is with its goods than without: a smaller one releases and sticks for ever where goods are far heavier.
pub(crate) const AT_STOPS_ROUNDING: f64 = 1000.0 * f64::EPSILON;
