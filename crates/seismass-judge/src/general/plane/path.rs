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
    let scale = end * (vector[0].size() + vector[1].size());
    // A zero so near an end that no place of the rule is beyond it is not seen by bisection.
    let turns = vector[0].times(&vector[0]).plus(&vector[1].times(&vector[1])).turns();
    let (mut from, mut sum) = (0.0, 0.0);
    for to in turns.into_iter().filter(|&place| place > 0.0 && place < end).chain([end]) {
        sum += refined(&speed, from, to, rule(&speed, from, to), f64::EPSILON * scale, MAX_DEPTH);
        from = to;
    }
    sum
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A velocity along a line that turns just after the beginning, 1 - s / a: the path is (a^2 + (1 - a)^2) / 2a.
    #[test]
    fn a_turn_beside_an_end_counts() {
        for a in [0.5, 1e-2, 1e-4, 1e-7, 1.0 - 1e-6] {
            let [x, y] = [0.6, -0.8].map(|factor| Polynomial(vec![factor, -factor / a]));
            let expected = (a * a + (1.0 - a) * (1.0 - a)) / (2.0 * a);
            let found = length([&x, &y], 1.0);
            assert!((found / expected - 1.0).abs() < 1e-14, "{a}: {found} for {expected}");
        }
    }
}
