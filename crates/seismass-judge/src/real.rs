//! The number types in which the model can be solved: double and double-double.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number type: field operations, order, conversion, and how far its rounding reaches.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + 'static
{
    /// Bound of the relative error of one operation.
    const EPSILON: f64;

    /// The nearest number to a double: itself.
    fn of(value: f64) -> Self;

    /// The nearest double.
    fn to_f64(self) -> f64;

    /// A positive number to a power.
    fn power(self, exponent: Self) -> Self;

    /// Square root of a number that is not negative.
    fn sqrt(self) -> Self;

    /// Zero.
    fn zero() -> Self {
        Self::of(0.0)
    }

    /// Absolute value.
    fn abs(self) -> Self {
        if self < Self::zero() { -self } else { self }
    }

    /// The larger of two.
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// Bound of the relative error of one operation, in the type itself.
    fn epsilon() -> Self {
        Self::of(Self::EPSILON)
    }
}

impl Real for f64 {
    const EPSILON: f64 = f64::EPSILON;

    fn of(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn power(self, exponent: Self) -> Self {
        self.powf(exponent)
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

/// Double-double: an unevaluated sum of two doubles, the second at most half a unit in the last place of the first.
///
/// At least 104 correct bits in every operation; the algorithms are those of Joldes, Muller and Popescu, *Tight and
/// rigorous error bounds for basic building blocks of double-word arithmetic* (ACM TOMS 44, 2017).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Sum of two doubles of which the first is the larger.
    #[inline]
    fn ordered_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// Exact sum of two doubles.
    #[inline]
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_part = high - a;
        Self { high, low: (a - (high - b_part)) + (b - b_part) }
    }

    /// Exact product of two doubles.
    #[inline]
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        let product = Self::product(self.high, factor);
        Self::ordered_sum(product.high, self.low.mul_add(factor, product.low))
    }

    /// e to this power: a power of two times the Taylor series of what is left, below ln 2 / 2.
    fn exponential(self) -> Self {
        let doublings = (self.high / LN_2.high).round();
        let rest = self - LN_2.times(doublings);
        let (mut term, mut sum) = (Self::of(1.0), Self::of(1.0));
        for order in 1..=EXPONENTIAL_ORDERS {
            term = term * rest / Self::of(f64::from(order));
            sum = sum + term;
        }
        let power = 2f64.powi(doublings as i32);
        Self { high: sum.high * power, low: sum.low * power }
    }

    /// Natural logarithm of a positive number: Newton's method doubles the digits of a double's.
    fn logarithm(self) -> Self {
        let mut logarithm = Self::of(self.high.ln());
        for _ in 0..2 {
            logarithm = logarithm + self * (-logarithm).exponential() - Self::of(1.0);
        }
        logarithm
    }
}

/// ln 2, to 107 bits.
const LN_2: DoubleDouble = DoubleDouble { high: std::f64::consts::LN_2, low: 2.319_046_813_846_299_6e-17 };
/// (ln 2 / 2)^k / k! is below 1e-34 from here on.
const EXPONENTIAL_ORDERS: u32 = 24;

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let first = Self::ordered_sum(high.high, high.low + low.high);
        Self::ordered_sum(first.high, first.low + low.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.low);
        let cross = self.low.mul_add(other.high, cross);
        Self::ordered_sum(product.high, product.low + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// Long division: each quotient digit is a double, and the remainder is exact to double-double.
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other.times(first);
        let second = rest.high / other.high;
        let rest = rest - other.times(second);
        let third = rest.high / other.high;
        Self::ordered_sum(first, second) + Self { high: third, low: 0.0 }
    }
}

impl Real for DoubleDouble {
    /// 16 u^2 with u = 2^-53, above the proved bounds (3 u^2 for a sum, 5 u^2 for a product, 10 u^2 for a quotient).
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON * 4.0;

    fn of(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    fn to_f64(self) -> f64 {
        self.high
    }

    fn power(self, exponent: Self) -> Self {
        (exponent * self.logarithm()).exponential()
    }

    /// Newton's method doubles the digits of a double's.
    fn sqrt(self) -> Self {
        let root = Self::of(self.high.sqrt());
        if root.high == 0.0 { root } else { root + (self - root * root) / root.times(2.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of 50-bit integers are exact in 106 bits, and so are their quotients.
    #[test]
    fn double_double_is_exact_where_it_can_be() {
        let mut state = 1u64;
        let mut integer = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 14) | 1) as f64
        };
        for _ in 0..100_000 {
            let (a, b) = (integer(), integer());
            let product = DoubleDouble::of(a) * DoubleDouble::of(b);
            assert_eq!((product.high, product.low), (a * b, a.mul_add(b, -(a * b))));
            let error = (product / DoubleDouble::of(b) - DoubleDouble::of(a)).abs() / DoubleDouble::of(a);
            assert!(error <= DoubleDouble::epsilon(), "{a} {b} {error:?}");
        }
    }

    /// The square root squared, and the product of powers that add up to 1, are the number: 1e-30.
    #[test]
    fn powers_round_below_their_epsilon() {
        let tolerance = DoubleDouble::of(100.0) * DoubleDouble::epsilon();
        for i in 1..2000 {
            let x = DoubleDouble::of(f64::from(i * i)) / DoubleDouble::of(7000.0);
            for root in [x.power(DoubleDouble::of(0.5)), x.sqrt()] {
                assert!((root * root - x).abs() <= tolerance * x, "{x:?} {root:?}");
            }
            let a = DoubleDouble::of(f64::from(i) / 2000.0);
            let product = x.power(a) * x.power(DoubleDouble::of(1.0) - a);
            assert!((product - x).abs() <= tolerance * x, "{x:?} {a:?} {product:?}");
        }
    }

    /// (x + y)^2 = x^2 + 2 x y + y^2 and (x / y) y = x with full-length operands: 1e-31.
    #[test]
    fn double_double_rounds_below_its_epsilon() {
        let two = DoubleDouble::of(2.0);
        for i in 1..20_000 {
            let x = DoubleDouble::of(1.0) / DoubleDouble::of(f64::from(i) + 0.7);
            let y = DoubleDouble::of(f64::from(i) * 0.013 + 0.3) / DoubleDouble::of(7.0);
            let square = (x + y) * (x + y);
            let expanded = x * x + two * x * y + y * y;
            assert!((square - expanded).abs() <= DoubleDouble::of(6.0) * DoubleDouble::epsilon() * square);
            let quotient = (x / y) * y - x;
            assert!(quotient.abs() <= DoubleDouble::of(2.0) * DoubleDouble::epsilon() * x, "{quotient:?}");
        }
    }
}
