//! The path of a block without friction: its speed may pass zero, so that no series serves.

use crate::polynomial::Polynomial;
use crate::real::Real;

/// Places and weights of Gauss's rule with five points on [-1, 1].
const RULE: [(f64, f64); 5] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
];
/// Bisections of an interval.
const MAX_DEPTH: usize = 60;

/// Integral over [0, `end`] of the length of a vector, to the rounding of doubles.
pub(super) fn length<R: Real>(vector: [&Polynomial<R>; 2], end: f64) -> f64 {
    let vector = vector.map(|p| Polynomial(p.0.iter().map(|c| c.to_f64()).collect()));
    let speed = |s: f64| vector[0].at(s).0.hypot(vector[1].at(s).0);
    let whole = rule(&speed, 0.0, end);
    let scale = end * (vector[0].size() + vector[1].size());
    refined(&speed, 0.0, end, whole, f64::EPSILON * scale, MAX_DEPTH)
}

fn rule(speed: &impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    half * RULE.iter().map(|(place, weight)| weight * speed(middle + half * place)).sum::<f64>()
}

fn refined(speed: &impl Fn(f64) -> f64, from: f64, to: f64, whole: f64, rounding: f64, depth: usize) -> f64 {
    let middle = 0.5 * (from + to);
    let parts = [rule(speed, from, middle), rule(speed, middle, to)];
    let sum = parts[0] + parts[1];
    if depth == 0 || (sum - whole).abs() <= rounding {
        return sum;
    }
    refined(speed, from, middle, parts[0], rounding, depth - 1)
        + refined(speed, middle, to, parts[1], rounding, depth - 1)
}
