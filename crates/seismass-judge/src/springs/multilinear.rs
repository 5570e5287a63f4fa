//! The multilinear law: one plastic element for each point of the backbone but the last, beside the last slope.

use super::masing::Masing;
use crate::real::Real;

/// Slopes that differ by less than this fraction are one.
const EQUAL_SLOPES: f64 = 1e-9;

/// The virgin spring of a backbone through points of drift and force.
pub(super) fn spring<R: Real>(backbone: &[[f64; 2]]) -> Masing<R> {
    let mut before = [R::zero(); 2];
    let mut segments = Vec::new();
    for point in backbone {
        let [drift, force] = point.map(R::of);
        segments.push((drift, (force - before[1]) / (drift - before[0])));
        before = [drift, force];
    }
    let element = |pair: &[(R, R)]| {
        let [(end, slope), (_, next)] = [pair[0], pair[1]];
        (slope - next > R::of(EQUAL_SLOPES) * slope).then_some((slope - next, end))
    };
    let last = segments.last().map_or(R::zero(), |&(_, slope)| slope);
    Masing::new(segments.windows(2).filter_map(element), last)
}
