//! First falls and sign changes of polynomials on [0, 1], refined to rounding.

use crate::lanes::{OnLine, Plain, Vector, WIDTH};
use crate::polynomial::bernstein::{Bernstein, MAX_DEPTH};
use crate::polynomial::power::{MAX_DEGREE, Polynomial, by_length};

impl Polynomial {
    /// What the coefficients say of values and derivatives on [0, 1].
    #[inline(always)]
    fn shape<V: Vector>(&self) -> PolynomialShape {
        by_length!(self, F => self.shape_of_first::<V, F>())
    }

    #[inline(always)]
    fn shape_of_first<V: Vector, const F: usize>(&self) -> PolynomialShape {
        let zero = V::splat(0.0);
        let [mut sum, mut fall, mut slow, mut fast, mut low, mut high] = [zero; 6];
        let fours = self.fours::<V, F>();
        for f in 0..F {
            let [of_sum, of_rate, of_bend] = &SHAPE_WEIGHTS[f];
            let (c, rate, bend) = (fours[f].mul(V::load(of_sum)), V::load(of_rate), V::load(of_bend));
            let (negative, positive) = (c.min(zero), c.max(zero));
            sum = sum.add(c);
            fall = fall.add(negative);
            slow = rate.mul_add(negative, slow);
            fast = rate.mul_add(positive, fast);
            low = bend.mul_add(negative, low);
            high = bend.mul_add(positive, high);
        }
        let [start, rate, bend, ..] = self.coefficients;
        PolynomialShape {
            end: start + (rate + sum.sum()),
            slope: rate + fall.sum(),
            rates: [rate + slow.sum(), rate + fast.sum()],
            bends: [2.0 * bend + low.sum(), 2.0 * bend + high.sum()],
        }
    }

    /// The first `s` in [0, 1] where the polynomial falls through zero to below `-tolerance`.
    ///
    /// Dips that stay above `-tolerance` are rounding and do not count; the place returned is the zero itself, or 0
    /// when the polynomial starts at or below zero and never rises above it before.
    #[inline(always)]
    pub(crate) fn first_fall<V: Vector>(&self, tolerance: f64) -> Option<f64> {
        let [start, rate, ..] = self.coefficients;
        let PolynomialShape { end, slope, rates, bends: [lowest, highest] } = self.shape::<V>();
        if start + if slope < 0.0 { slope } else { 0.0 } >= -tolerance {
            return None;
        }
        if start > 0.0 && rates[1] < 0.0 {
            return if end < -tolerance { Some(self.only_root::<V>(end)) } else { None };
        }
        // Above the parabola of least bend. What has just fired starts at zero, often at rest.
        if lowest > 0.0 && start - if rate < 0.0 { 0.5 * rate * rate / lowest } else { 0.0 } >= -tolerance {
            return None;
        }
        // From above zero to below it, and bent to one side: one root. Bent down: nothing below both ends.
        if start > 0.0 && (highest <= 0.0 || lowest >= 0.0 && end < -tolerance) {
            return if end < -tolerance { Some(self.only_root::<V>(end)) } else { None };
        }
        self.first_of_falls(tolerance)
    }

    /// [`Polynomial::first_fall`] of any polynomial.
    #[inline(never)]
    fn first_of_falls(&self, tolerance: f64) -> Option<f64> {
        let mut shifted = *self;
        shifted.coefficients[0] += tolerance;
        // A start at exactly zero, without tolerance, is judged by the first derivative that is not.
        if shifted.coefficients().iter().find(|&&c| c != 0.0).is_none_or(|&c| c < 0.0) {
            return Some(0.0);
        }
        let (left, right) = Bernstein::new(&shifted).first_sign_change(0.0, 1.0, MAX_DEPTH)?;
        let below = shifted.refine(left, right);
        Some(self.zero_before(below))
    }

    /// The zero of the polynomial just before `end`, where it is slightly negative; 0 if there is none.
    fn zero_before(&self, end: f64) -> f64 {
        let (value, rate) = self.at_with_rate::<Plain>(end);
        if value >= 0.0 {
            return end;
        }
        let mut back = (2.0 * value / rate).abs().max(f64::EPSILON * end);
        loop {
            let start = end - back;
            if start.is_nan() || start <= 0.0 {
                return self.without_zeros_at_start().map_or(0.0, |rising| rising.refine(0.0, end));
            }
            if self.at::<Plain>(start) >= 0.0 {
                return self.refine(start, end);
            }
            back *= 4.0;
        }
    }

    /// The polynomial without its zeros at 0, if it is positive or rises there, by however little: what it does first
    /// decides, for a guard that has just fired starts at exactly zero.
    fn without_zeros_at_start(&self) -> Option<Self> {
        let zeros = self.coefficients().iter().position(|&c| c != 0.0)?;
        let rest = &self.coefficients()[zeros..];
        (rest[0] > 0.0).then(|| Self::new(rest.iter().copied()))
    }

    /// The root in [left, right], at whose ends the polynomial has different signs, to rounding.
    fn refine(&self, left: f64, right: f64) -> f64 {
        let (at_left, at_right) = (self.at::<Plain>(left), self.at::<Plain>(right));
        let secant = left + (right - left) * (at_left / (at_left - at_right));
        self.newton::<Plain>(secant, left, right, at_left > at_right)
    }

    /// The only root in [0, 1] of a polynomial whose value at 1, `end`, has not the sign of its start.
    #[inline(always)]
    fn only_root<V: Vector>(&self, end: f64) -> f64 {
        let [start, rate, ..] = self.coefficients;
        // First guess: the root of the parabola with this start, rate and end.
        let curvature = end - start - rate;
        let root = V::fused(rate, rate, -4.0 * curvature * start).sqrt();
        let guess = 2.0 * start.abs() / (root - if start > 0.0 { rate } else { -rate });
        self.newton::<V>(guess, 0.0, 1.0, start > 0.0)
    }

    /// The root in [left, right] by Newton's method from a guess, kept inside the bracket by bisection, to rounding.
    #[inline(always)]
    fn newton<V: Vector>(&self, guess: f64, mut left: f64, mut right: f64, falls: bool) -> f64 {
        let mut s = if guess > left && guess < right { guess } else { middle(left, right) };
        let mut last_step = 0.0;
        for _ in 0..100 {
            let (value, rate) = self.at_with_rate::<V>(s);
            if value == 0.0 {
                return s;
            }
            let is_left = (value > 0.0) == falls;
            (left, right) = (if is_left { s } else { left }, if is_left { right } else { s });
            let newton = s - value / rate;
            let (next, step);
            if newton > left && newton < right {
                (next, step) = (newton, (newton - s).abs());
                // Steps of Newton's method square: the next would be step^3 / last_step^2.
                if step * (step * step) <= f64::EPSILON * s * (last_step * last_step) {
                    return next;
                }
                last_step = step;
            } else {
                next = middle(left, right);
                (step, last_step) = ((next - s).abs(), 0.0);
            }
            if step <= f64::EPSILON * s.abs() || right - left <= f64::EPSILON * right {
                return next;
            }
            s = next;
        }
        s
    }

    /// The places in (0, 1) where the polynomial changes sign, in order: the first, and the others.
    #[inline(always)]
    pub(crate) fn sign_changes<V: Vector>(&self) -> (Option<f64>, Vec<f64>) {
        let start = self.coefficients[0];
        let PolynomialShape { end, rates, .. } = self.shape::<V>();
        if rates[0] > 0.0 || rates[1] < 0.0 {
            return (if start * end < 0.0 { Some(self.only_root::<V>(end)) } else { None }, Vec::new());
        }
        self.all_sign_changes()
    }

    /// [`Polynomial::sign_changes`] of a polynomial that is not known to be monotonic.
    #[inline(never)]
    fn all_sign_changes(&self) -> (Option<f64>, Vec<f64>) {
        let rest: f64 = self.coefficients().iter().skip(1).map(|c| c.abs()).sum();
        let (mut first, mut others) = (None, Vec::new());
        if self.length > 0 && self.coefficients[0].abs() <= rest {
            Bernstein::new(self).all_sign_changes(0.0, 1.0, MAX_DEPTH, &mut |left, right| {
                let place = if left < right { self.refine(left, right) } else { left };
                if first.is_none() { first = Some(place) } else { others.push(place) }
            });
        }
        (first, others)
    }
}

/// What the coefficients of a polynomial p say of it on [0, 1].
pub(crate) struct PolynomialShape {
    /// p(1).
    end: f64,
    /// No power from the first on is above s: p(s) >= p(0) + slope s.
    slope: f64,
    /// Bounds of the first and of the second derivative.
    rates: [f64; 2],
    bends: [f64; 2],
}

/// By order k: 1 and k from the second on, k (k - 1) from the third on.
static SHAPE_WEIGHTS: OnLine<[[[f64; WIDTH]; 3]; (MAX_DEGREE + 1) / WIDTH]> = {
    let mut table = [[[0.0; WIDTH]; 3]; (MAX_DEGREE + 1) / WIDTH];
    let mut k = 2;
    while k <= MAX_DEGREE {
        let of_four = &mut table[k / WIDTH];
        of_four[0][k % WIDTH] = 1.0;
        of_four[1][k % WIDTH] = k as f64;
        of_four[2][k % WIDTH] = if k > 2 { (k * (k - 1)) as f64 } else { 0.0 };
        k += 1;
    }
    OnLine(table)
};

/// The middle of a bracket. Newton's method hardly ever needs it: that it is cold keeps the choice a branch, which the
/// processor foresees, where it would wait for a selection.
#[cold]
fn middle(left: f64, right: f64) -> f64 {
    0.5 * (left + right)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from_roots(scale: f64, roots: &[f64]) -> Polynomial {
        let mut c = vec![scale];
        for &root in roots {
            c.push(0.0);
            for k in (0..c.len()).rev() {
                c[k] = if k > 0 { c[k - 1] } else { 0.0 } - root * c[k];
            }
        }
        Polynomial::new(c)
    }

    #[test]
    fn finds_the_first_of_several_roots() {
        let p = from_roots(-1.0, &[0.3, 0.31, 0.7]);
        assert!((p.first_fall::<Plain>(1e-15).unwrap() - 0.3).abs() < 1e-13);
        let (first, others) = p.sign_changes::<Plain>();
        let all: Vec<f64> = first.into_iter().chain(others).collect();
        assert_eq!(all.len(), 3);
        for (s, root) in all.iter().zip([0.3, 0.31, 0.7]) {
            assert!((s - root).abs() < 1e-13);
        }
    }

    /// A root at a middle of halvings, where a coefficient of both halves is exactly zero.
    #[test]
    fn finds_roots_where_intervals_are_split() {
        for (coefficients, roots) in
            [(vec![0.125, -0.75, 1.0], vec![0.25, 0.5]), (vec![0.375, -1.25, 1.0], vec![0.5, 0.75])]
        {
            let (first, others) = Polynomial::new(coefficients).sign_changes::<Plain>();
            assert_eq!(first.into_iter().chain(others).collect::<Vec<_>>(), roots);
        }
    }

    /// The root of a monotonic polynomial, falling or rising, near either end and far from its first guess.
    #[test]
    fn finds_the_only_root_of_monotonic_polynomials() {
        for root in [1e-14, 1e-9, 0.01, 0.37, 0.5, 0.93, 1.0 - 1e-9] {
            for (linear, cubic) in [(1.0, 0.0), (1.0, 0.5), (1e-3, 1.0), (1.0, 1e3)] {
                // linear (s - root) + cubic (s^3 - root^3) and its negative.
                let rising = Polynomial::new([-linear * root - cubic * root * root * root, linear, 0.0, cubic]);
                let falling = Polynomial::new(rising.coefficients().iter().map(|c| -c));
                let size = root.max(1e-300) * 8.0 * f64::EPSILON * (1.0 + cubic * root * root / linear);
                let fall = falling.first_fall::<Plain>(0.0).unwrap();
                assert!((fall - root).abs() <= size, "{fall:e} for {root:e}, {linear}, {cubic}");
                for p in [rising, falling] {
                    let (first, others) = p.sign_changes::<Plain>();
                    assert!((first.unwrap() - root).abs() <= size && others.is_empty());
                }
            }
        }
    }

    /// Polynomials bent to one side that turn before they fall, or after, and one that comes back in time.
    #[test]
    fn finds_falls_of_bent_polynomials() {
        for (coefficients, root) in [
            (vec![1.0, 1.0, -6.0, -1e-3], Some(0.499_975_002_999_542_95)),
            (vec![1.0, -6.0, 4.5, 0.0], Some(0.195_262_145_875_634_94)),
            (vec![1e-3, 1.0, -1.001], None),
            (vec![0.0, 1.0, -0.5, -0.4], None),
            (vec![0.0, 0.0, 1.0, -0.1], None),
            (vec![1e-6, -1e-3, 1.0, -0.1], None),
            (vec![2e-7, -1e-3, 1.0, -0.1], Some(2.763_884_811_822_42e-4)),
        ] {
            match (Polynomial::new(coefficients.iter().copied()).first_fall::<Plain>(1e-15), root) {
                (Some(found), Some(root)) => assert!((found - root).abs() < 1e-12, "{found} for {root}"),
                (found, root) => assert_eq!(found, root),
            }
        }
    }

    #[test]
    fn a_touch_is_no_fall() {
        let p = from_roots(1.0, &[0.4, 0.4]);
        assert_eq!(p.first_fall::<Plain>(1e-15), None);
        let dips = from_roots(1.0, &[0.4, 0.4 + 1e-6]);
        assert!((dips.first_fall::<Plain>(1e-15).unwrap() - 0.4).abs() < 1e-8);
    }

    #[test]
    fn a_start_at_zero_is_judged_by_what_follows() {
        assert_eq!(Polynomial::new([0.0, 1.0, 0.5]).first_fall::<Plain>(1e-15), None);
        assert_eq!(Polynomial::new([0.0, -1.0, 0.5]).first_fall::<Plain>(1e-15), Some(0.0));
        assert_eq!(Polynomial::new([0.0, 0.0, -1.0]).first_fall::<Plain>(1e-15), Some(0.0));
        assert_eq!(Polynomial::new([0.0, 0.0, -1.0]).first_fall::<Plain>(0.0), Some(0.0));
        assert_eq!(Polynomial::new([0.0, 0.0, 0.0]).first_fall::<Plain>(0.0), None);
        assert_eq!(Polynomial::new([0.0, 0.0, 1.0]).first_fall::<Plain>(0.0), None);
        // Leaves zero upwards and comes back.
        let s = Polynomial::new([0.0, 1.0, -2.0]).first_fall::<Plain>(1e-15).unwrap();
        assert!((s - 0.5).abs() < 1e-15);
        // Rises off zero by less than the tolerance, and falls: the fall is where it comes back, not the start.
        let s = Polynomial::new([0.0, 1e-9, 0.0, -1e3]).first_fall::<Plain>(1e-12).unwrap();
        assert!((s - 1e-6).abs() < 1e-20, "{s}");
        // Noise below zero at the start, then rises.
        assert_eq!(Polynomial::new([-1e-17, -1e-17, 1.0]).first_fall::<Plain>(1e-15), None);
    }

    #[test]
    fn derivatives_are_those_of_the_powers() {
        let p = Polynomial::new([1.0, -2.0, 0.5, 3.0]);
        assert!((p.derivative().at::<Plain>(0.3) - (-2.0 + 0.3 + 9.0 * 0.09)).abs() < 1e-15);
    }
}
