//! Polynomials on [0, 1]: values, products, and sign changes isolated in Bernstein form.

use std::cmp::Ordering;

use crate::real::Real;

/// Terms below this part of the rounding of a polynomial do not count.
const NEGLIGIBLE: f64 = 1e-6;

/// Bernstein coefficients in doubles are right to this part of the sum of the coefficients.
const CERTAIN: f64 = 1e-12;

/// Power-basis coefficients, lowest first; never empty.
#[derive(Debug, Clone)]
pub(crate) struct Polynomial<R>(pub(crate) Vec<R>);

/// The coefficient of an order; zero beyond the last.
pub(crate) fn term<R: Real>(p: &Polynomial<R>, order: usize) -> R {
    p.0.get(order).copied().unwrap_or(R::zero())
}

impl<R: Real> Polynomial<R> {
    pub(crate) fn constant(value: R) -> Self {
        Self(vec![value])
    }

    /// Sum of the absolute coefficients: bounds the value on [0, 1], and measures its rounding.
    pub(crate) fn size(&self) -> R {
        self.0.iter().fold(R::zero(), |sum, c| sum + c.abs())
    }

    /// Value and first derivative.
    pub(crate) fn at(&self, s: R) -> (R, R) {
        let (mut value, mut derivative) = (R::zero(), R::zero());
        for &c in self.0.iter().rev() {
            derivative = derivative * s + value;
            value = value * s + c;
        }
        (value, derivative)
    }

    pub(crate) fn start(&self) -> R {
        self.0[0]
    }

    pub(crate) fn end(&self) -> R {
        self.0.iter().rev().fold(R::zero(), |sum, &c| sum + c)
    }

    pub(crate) fn scaled(&self, factor: R) -> Self {
        Self(self.0.iter().map(|&c| c * factor).collect())
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self((0..self.0.len().max(other.0.len())).map(|k| term(self, k) + term(other, k)).collect())
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut product = vec![R::zero(); self.0.len() + other.0.len() - 1];
        for (i, &a) in self.0.iter().enumerate() {
            for (j, &b) in other.0.iter().enumerate() {
                product[i + j] = product[i + j] + a * b;
            }
        }
        Self(product)
    }

    pub(crate) fn derivative(&self) -> Self {
        let terms: Vec<R> = self.0.iter().enumerate().skip(1).map(|(k, &c)| c * R::of(k as f64)).collect();
        if terms.is_empty() { Self::constant(R::zero()) } else { Self(terms) }
    }

    /// Integral over [0, 1].
    pub(crate) fn integral(&self) -> R {
        self.0.iter().enumerate().rev().fold(R::zero(), |sum, (k, &c)| sum + c / R::of((k + 1) as f64))
    }

    /// The polynomial over [0, `length`], mapped to [0, 1], without last terms that are far below its rounding there.
    pub(crate) fn shrink(&mut self, length: R) {
        let mut power = R::of(1.0);
        for c in &mut self.0 {
            *c = *c * power;
            power = power * length;
        }
        let largest = self.0.iter().fold(R::zero(), |largest, c| largest.max(c.abs()));
        let least = R::of(NEGLIGIBLE) * R::epsilon() * largest;
        // What is no number stays.
        let counts = |c: &R| c.abs().partial_cmp(&least).is_none_or(Ordering::is_gt);
        let last = self.0.iter().rposition(counts).unwrap_or(0);
        self.0.truncate(last + 1);
    }

    /// Places in [0, 1] where the sign changes, in order. A polynomial that starts without the sign `before` changes it at 0.
    fn sign_changes(&self, before: Ordering, only_first: bool) -> Vec<R> {
        if let Some(sign) = self.sign_in_doubles() {
            return if before.is_ne() && before != sign { vec![R::zero()] } else { Vec::new() };
        }
        let mut scan = Scan { polynomial: self, last: before, only_first, found: Vec::new() };
        scan.visit(&bernstein(&self.0), R::zero(), R::of(1.0));
        scan.found
    }

    /// The one sign on [0, 1], where doubles can tell and are cheaper.
    fn sign_in_doubles(&self) -> Option<Ordering> {
        if R::EPSILON >= f64::EPSILON {
            return None;
        }
        let coefficients: Vec<f64> = self.0.iter().map(|c| c.to_f64()).collect();
        let least = CERTAIN * coefficients.iter().map(|c| c.abs()).sum::<f64>();
        let b = bernstein(&coefficients);
        let is_beyond = |value: &f64| value * b[0].signum() > least;
        b.iter().all(is_beyond).then(|| sign(b[0]))
    }

    /// Places in [0, 1] where the derivative changes its sign, in order.
    pub(crate) fn turns(&self) -> Vec<R> {
        self.derivative().sign_changes(Ordering::Equal, false)
    }

    /// Largest absolute value on [0, 1], and the first place where it is reached.
    pub(crate) fn extreme(&self) -> (R, R) {
        let mut best = (self.start().abs(), R::zero());
        for place in self.turns().into_iter().chain([R::of(1.0)]) {
            let value = self.at(place).0.abs();
            if value > best.0 {
                best = (value, place);
            }
        }
        best
    }

    /// Integral over [0, 1] of the absolute value.
    pub(crate) fn absolute_integral(&self) -> R {
        let mut terms = vec![R::zero()];
        terms.extend(self.0.iter().enumerate().map(|(k, &c)| c / R::of((k + 1) as f64)));
        let primitive = Self(terms);
        let (mut from, mut sum) = (R::zero(), R::zero());
        for place in self.sign_changes(Ordering::Equal, false).into_iter().chain([R::of(1.0)]) {
            let value = primitive.at(place).0;
            sum = sum + (value - from).abs();
            from = value;
        }
        sum
    }

    /// Where a guard falls: the last zero before it is first below `-tolerance` on [0, 1], or 0 if there is none.
    ///
    /// A guard that dips below zero by no more than its rounding has not fallen.
    pub(crate) fn first_fall(&self, tolerance: R) -> Option<R> {
        let mut lifted = self.clone();
        lifted.0[0] = lifted.0[0] + tolerance;
        let reach = lifted.0[1..].iter().fold(R::zero(), |sum, c| sum + c.abs());
        if lifted.0[0] >= reach {
            return None;
        }
        let passed = *lifted.sign_changes(Ordering::Greater, true).first()?;
        let mut approach = self.clone();
        approach.shrink(passed);
        // It ends below zero, so the last change of sign is a fall.
        let zero = approach.sign_changes(Ordering::Equal, false).last().copied();
        Some(zero.map_or(R::zero(), |place| place * passed))
    }
}

/// Bernstein coefficients on [0, 1]: b_i = sum over j <= i of C(i, j) / C(n, j) c_j.
fn bernstein<R: Real>(c: &[R]) -> Vec<R> {
    let n = c.len() - 1;
    let mut binomial = R::of(1.0);
    let mut b = Vec::with_capacity(c.len());
    for (j, &c) in c.iter().enumerate() {
        b.push(c / binomial);
        binomial = binomial * R::of((n - j) as f64) / R::of((j + 1) as f64);
    }
    for k in 1..=n {
        for i in (k..=n).rev() {
            b[i] = b[i] + b[i - 1];
        }
    }
    b
}

/// Sign of a number.
fn sign<R: Real>(value: R) -> Ordering {
    value.partial_cmp(&R::zero()).unwrap_or(Ordering::Equal)
}

/// A walk from left to right over parts of [0, 1] on which the Bernstein coefficients change sign at most once:
/// there the polynomial has no root, or exactly one.
struct Scan<'a, R> {
    polynomial: &'a Polynomial<R>,
    /// The last sign met; none yet: equal.
    last: Ordering,
    only_first: bool,
    found: Vec<R>,
}

impl<R: Real> Scan<'_, R> {
    fn visit(&mut self, b: &[R], left: R, width: R) {
        if self.only_first && !self.found.is_empty() {
            return;
        }
        let signs: Vec<Ordering> = b.iter().map(|&b| sign(b)).filter(|s| s.is_ne()).collect();
        let (Some(&first), Some(&last)) = (signs.first(), signs.last()) else { return };
        let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let narrow = width <= R::epsilon() * left.max(R::epsilon());
        if changes > 1 && !narrow {
            let half = R::of(0.5);
            let (b_left, b_right) = split(b);
            self.visit(&b_left, left, width * half);
            self.visit(&b_right, left + width * half, width * half);
            return;
        }
        if self.last.is_ne() && self.last != first {
            self.found.push(left);
        }
        if first != last {
            self.found.push(if narrow { left } else { self.refine(left, left + width, first) });
        }
        self.last = last;
    }

    /// The only root between `low` and `high`: Newton's method, kept inside a bracket by bisection.
    fn refine(&self, mut low: R, mut high: R, sign_at_low: Ordering) -> R {
        let half = R::of(0.5);
        let mut x = (low + high) * half;
        while high - low > R::epsilon() * high {
            let (value, derivative) = self.polynomial.at(x);
            match sign(value) {
                Ordering::Equal => return x,
                s if s == sign_at_low => low = x,
                _ => high = x,
            }
            let newton = x - value / derivative;
            let next = if newton > low && newton < high { newton } else { (low + high) * half };
            if (next - x).abs() <= R::epsilon() * x {
                return next;
            }
            x = next;
        }
        x
    }
}

/// De Casteljau at one half: the coefficients of both halves.
fn split<R: Real>(b: &[R]) -> (Vec<R>, Vec<R>) {
    let half = R::of(0.5);
    let mut right = b.to_vec();
    let mut left = Vec::with_capacity(b.len());
    for last in (0..b.len()).rev() {
        left.push(right[0]);
        for i in 0..last {
            right[i] = (right[i] + right[i + 1]) * half;
        }
    }
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real::DoubleDouble;

    /// Product of (s - root), scaled.
    fn with_roots<R: Real>(roots: &[f64], scale: f64) -> Polynomial<R> {
        roots
            .iter()
            .fold(Polynomial::constant(R::of(scale)), |p, &root| p.times(&Polynomial(vec![R::of(-root), R::of(1.0)])))
    }

    fn finds_all_roots<R: Real>(tolerance: f64) {
        for roots in [vec![0.5], vec![0.25, 0.5, 0.75], vec![0.1, 0.11, 0.9], vec![1e-9, 0.3, 0.3000001]] {
            let p = with_roots::<R>(&roots, -3.0);
            let found = p.sign_changes(Ordering::Equal, false);
            assert_eq!(found.len(), roots.len(), "{roots:?} {found:?}");
            for (f, r) in found.iter().zip(&roots) {
                assert!((f.to_f64() - r).abs() < tolerance, "{found:?}");
            }
        }
    }

    #[test]
    fn all_sign_changes_are_found() {
        finds_all_roots::<f64>(1e-8);
        finds_all_roots::<DoubleDouble>(1e-16);
    }

    #[test]
    fn a_touch_within_rounding_is_no_fall() {
        let p = Polynomial(vec![0.25, -1.0, 1.0]);
        assert!(p.first_fall(1e-14).is_none());
        let mut dip = p;
        dip.0[0] -= 1e-10;
        let place = dip.first_fall(1e-14).unwrap();
        assert!((place - (0.5 - 1e-5)).abs() < 1e-9, "{place}");
    }

    /// A guard that has just fired: zero, with a slope that is rounding, judged by its second derivative.
    #[test]
    fn a_guard_at_zero_is_judged_by_its_first_derivative_beyond_rounding() {
        assert!(Polynomial(vec![0.0, -1e-16, 1.0]).first_fall(1e-14).is_none());
        assert!(Polynomial(vec![0.0, 1e-16, -1.0]).first_fall(1e-14).unwrap() < 2e-16);
        assert_eq!(Polynomial(vec![0.0, -1.0]).first_fall(1e-14), Some(0.0));
        let later = Polynomial(vec![0.0, 1.0, -2.0]).first_fall(1e-14).unwrap();
        assert!((later - 0.5).abs() < 1e-15);
    }

    #[test]
    fn extreme_and_absolute_integral() {
        let p = Polynomial(vec![0.0, 1.0, -1.0]);
        let (value, place) = p.extreme();
        assert!((value - 0.25).abs() < 1e-16 && (place - 0.5).abs() < 1e-8);
        let q = Polynomial(vec![-0.5, 1.0]);
        assert!((q.absolute_integral() - 0.25).abs() < 1e-16);
    }
}
