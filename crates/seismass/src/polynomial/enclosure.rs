//! What a quantity stays between over a step, from values and rates at its ends.

use crate::lanes::Vector;

/// The Bezier points of a cubic are so much of a step's length apart. Divisions would be waited for.
pub(crate) const THIRD: f64 = 1.0 / 3.0;

/// What a quantity differs at most from the cubic through values and rates at both ends of a step of length `h`, per unit
/// of its fourth derivative.
#[inline(always)]
pub(crate) fn off_cubic(h: f64) -> f64 {
    let square = h * h;
    square * square * (1.0 / 384.0)
}

/// What a quantity differs at most from the quintic through values and two derivatives at both ends of a step of length `h`,
/// per unit of its sixth derivative.
#[inline(always)]
pub(crate) fn off_quintic(h: f64) -> f64 {
    let cube = h * h * h;
    cube * cube / 46080.0
}

/// The cubic through values and rates at both ends of a step stays between the least and the largest of its Bezier
/// points; what deviates from it by at most `margin` stays within these widened by it.
#[inline(always)]
pub(crate) fn range(start: f64, start_rate: f64, end: f64, end_rate: f64, third: f64, margin: f64) -> (f64, f64) {
    let (first, second) = (start + third * start_rate, end - third * end_rate);
    let smaller = |a: f64, b: f64| if a < b { a } else { b };
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let low = smaller(smaller(start, end), smaller(first, second));
    let high = larger(larger(start, end), larger(first, second));
    (low - margin, high + margin)
}

/// Whether what does not start below zero stays above it from there on, a rate of -`least` at the start being as good as
/// none. It differs by at most 16 `margin` s^2 (1 - s)^2 from the cubic through values and rates at both ends, which is
/// less than 16 / 3 `margin` times the Bernstein polynomial of the second inner Bezier point: the others need no margin,
/// the start among them, where what has just fired is zero and often at rest.
#[inline(always)]
pub(crate) fn stays_above_zero(
    [start, start_rate]: [f64; 2],
    [end, end_rate]: [f64; 2],
    third: f64,
    margin: f64,
    least: f64,
) -> bool {
    start >= 0.0
        && start + third * (start_rate + least) >= 0.0
        && end - third * end_rate > (16.0 / 3.0) * margin
        && end > 0.0
}

/// [`range`] of several, from values and rates.
#[inline(always)]
pub(crate) fn ranges<V: Vector>(start: [V; 2], end: [V; 2], third: V, margin: V) -> (V, V) {
    let (first, second) = (third.mul_add(start[1], start[0]), end[0].sub(third.mul(end[1])));
    let (low, high) = (start[0].min(end[0]).min(first.min(second)), start[0].max(end[0]).max(first.max(second)));
    (low.sub(margin), high.add(margin))
}

/// How far values are from their middles after h / 3 at their rates, to either side: of drifts, of the negative of plastic
/// storeys' rates, of accelerations; from (x, v, q) of drifts and (a, jerk) of floors.
#[inline(always)]
pub(crate) fn separations<V: Vector>([x, v, q]: [V; 3], [a, jerk]: [V; 2], middle: V, sign: V, third: V) -> [V; 3] {
    [
        third.mul_add(v.abs(), x.sub(middle).abs()),
        third.mul(q.abs()).sub(sign.mul(v)),
        third.mul_add(jerk.abs(), a.abs()),
    ]
}

/// How far ranges go from their middles, to either side.
#[inline(always)]
pub(crate) fn largest_distance<V: Vector>((low, high): (V, V), middle: V) -> V {
    high.sub(middle).max(middle.sub(low))
}

/// How far ranges go against a sign.
#[inline(always)]
pub(crate) fn distance_against<V: Vector>((low, high): (V, V), sign: V) -> V {
    let zero = V::splat(0.0);
    zero.sub(sign.mul(low)).max(zero.sub(sign.mul(high)))
}

/// Lanes, as bits, of ranges above zero, and of those below it.
#[inline(always)]
pub(crate) fn signs<V: Vector>((low, high): (V, V)) -> (u32, u32) {
    let zero = V::splat(0.0);
    (!zero.not_below(low), !high.not_below(zero))
}

/// The quintic through values and two derivatives at both ends of a step stays between the least and the largest of its
/// Bezier points; what deviates from it by at most `margin` stays within these widened by it.
#[inline(always)]
pub(crate) fn quintic_range(start: [f64; 3], end: [f64; 3], h: f64, margin: f64) -> (f64, f64) {
    let (fifth, twentieth) = (h / 5.0, h * h / 20.0);
    let points = [
        start[0],
        start[0] + fifth * start[1],
        start[0] + 2.0 * fifth * start[1] + twentieth * start[2],
        end[0] - 2.0 * fifth * end[1] + twentieth * end[2],
        end[0] - fifth * end[1],
        end[0],
    ];
    let smaller = |a: f64, b: f64| if a < b { a } else { b };
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    (
        points.into_iter().fold(f64::INFINITY, smaller) - margin,
        points.into_iter().fold(f64::NEG_INFINITY, larger) + margin,
    )
}

/// [`quintic_range`] of several.
#[inline(always)]
pub(crate) fn quintic_ranges<V: Vector>(start: [V; 3], end: [V; 3], h: f64, margin: V) -> (V, V) {
    let (fifth, two_fifths, twentieth) = (V::splat(h / 5.0), V::splat(2.0 * h / 5.0), V::splat(h * h / 20.0));
    let points = [
        fifth.mul_add(start[1], start[0]),
        twentieth.mul_add(start[2], two_fifths.mul_add(start[1], start[0])),
        twentieth.mul_add(end[2], end[0].sub(two_fifths.mul(end[1]))),
        end[0].sub(fifth.mul(end[1])),
        end[0],
    ];
    let (mut low, mut high) = (start[0], start[0]);
    for point in points {
        (low, high) = (low.min(point), high.max(point));
    }
    (low.sub(margin), high.add(margin))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (t (h - t))^n has n zeros at each end and the derivative (2 n)! of order 2 n: what it differs by from the polynomial
    /// that is nothing there is itself, largest in the middle with (h / 2)^(2 n). No function has more.
    #[test]
    fn what_a_polynomial_misses_is_reached() {
        for h in [0.3, 1.7] {
            let middle: f64 = 0.5 * h;
            assert!((24.0 * off_cubic(h) / middle.powi(4) - 1.0).abs() < 1e-14);
            assert!((720.0 * off_quintic(h) / middle.powi(6) - 1.0).abs() < 1e-14);
        }
    }

    /// The Bezier points of a polynomial that rises in a straight line are on it; the margin widens to both sides.
    #[test]
    fn ranges_of_a_line() {
        let (start, rate, h) = (0.7, 1.3, 0.3);
        let end = start + rate * h;
        let near =
            |found: (f64, f64)| (found.0 - (start - 0.11)).abs() < 1e-15 && (found.1 - (end + 0.11)).abs() < 1e-15;
        assert!(near(range(start, rate, end, rate, h * THIRD, 0.11)));
        assert!(near(quintic_range([start, rate, 0.0], [end, rate, 0.0], h, 0.11)));
    }

    /// What is said to stay above zero does so: cubics that deviate by their margin times 16 s^2 (1 - s)^2 either way.
    #[test]
    fn what_stays_above_zero_does_so() {
        let points = || (0..=8).map(|k| -1.0 + 0.25 * f64::from(k));
        let (mut proved, mut others) = (0, 0);
        for (start, b1, b2, end) in [0.0, 0.25, 1.0]
            .into_iter()
            .flat_map(|start| points().map(move |b1| (start, b1)))
            .flat_map(|(start, b1)| points().map(move |b2| (start, b1, b2)))
            .flat_map(|(start, b1, b2)| points().map(move |end| (start, b1, b2, end)))
        {
            for margin in [0.0, 0.01, 0.1] {
                let rates = [3.0 * (b1 - start), 3.0 * (end - b2)];
                let stays = stays_above_zero([start, rates[0]], [end, rates[1]], 1.0 / 3.0, margin, 0.0);
                let lowest = (1..=1000).map(|k| f64::from(k) / 1000.0).fold(f64::INFINITY, |lowest, s| {
                    let t = 1.0 - s;
                    let cubic = start * t * t * t + 3.0 * s * t * (b1 * t + b2 * s) + end * s * s * s;
                    lowest.min(cubic - 16.0 * margin * s * s * t * t)
                });
                assert!(!stays || lowest > 0.0, "{start} {b1} {b2} {end} {margin}: {lowest}");
                if stays { proved += 1 } else { others += usize::from(lowest > 0.0) }
            }
        }
        assert!(proved > 500 && others < 3 * proved, "proved {proved}, true without proof {others}");
    }
}
