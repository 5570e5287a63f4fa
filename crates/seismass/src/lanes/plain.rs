//! Vectors of what every architecture has.

use crate::lanes::vector::{Vector, WIDTH};

/// What every architecture has; the compiler makes vectors of it.
#[derive(Clone, Copy)]
pub(crate) struct Plain([f64; WIDTH]);

impl Plain {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.0, other.0);
        Self([f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])])
    }
}

impl Vector for Plain {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; WIDTH])
    }
    #[inline(always)]
    fn load(values: &[f64; WIDTH]) -> Self {
        Self(*values)
    }
    #[inline(always)]
    fn of(values: [f64; WIDTH]) -> Self {
        Self(values)
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; WIDTH]) {
        *values = self.0;
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self.mul(factor).add(term)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn broadcast(self, lane: usize) -> Self {
        Self([self.0[lane]; WIDTH])
    }
    #[inline(always)]
    fn shifted_up(self, before: Self) -> Self {
        Self([before.0[3], self.0[0], self.0[1], self.0[2]])
    }
    #[inline(always)]
    fn shifted_down(self, after: Self) -> Self {
        Self([self.0[1], self.0[2], self.0[3], after.0[0]])
    }
    #[inline(always)]
    fn with(mut self, bits: u32, other: Self) -> Self {
        for l in 0..WIDTH {
            if bits >> l & 1 != 0 {
                self.0[l] = other.0[l];
            }
        }
        self
    }
    #[inline(always)]
    fn with_lane(self, lane: usize, value: f64) -> Self {
        self.with(1 << lane, Self::splat(value))
    }
    #[inline(always)]
    fn transposed(vectors: [Self; WIDTH]) -> [Self; WIDTH] {
        let mut out = vectors;
        for i in 0..WIDTH {
            for j in 0..WIDTH {
                out[j].0[i] = vectors[i].0[j];
            }
        }
        out
    }
    #[inline(always)]
    fn not_below(self, other: Self) -> u32 {
        let mut bits = 0;
        for l in 0..WIDTH {
            let is_below = self.0[l] < other.0[l];
            bits |= u32::from(!is_below) << l;
        }
        bits
    }
    #[inline(always)]
    fn mark_not_below(self, other: Self, before: Self) -> Self {
        let mark = |is_below: bool| if is_below { 0 } else { u64::MAX };
        let marks = self.zip(other, |a, b| f64::from_bits(mark(a < b)));
        marks.zip(before, |a, b| f64::from_bits(a.to_bits() | b.to_bits()))
    }
    #[inline(always)]
    fn has_marks(self) -> bool {
        self.0.iter().fold(0, |marks, mark| marks | mark.to_bits()) >> (u64::BITS - 1) != 0
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        (self.0[0] + self.0[2]) + (self.0[1] + self.0[3])
    }
    #[inline(always)]
    fn total(self) -> Self {
        Self::splat(self.sum())
    }
    #[inline(always)]
    fn fused(a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }
}
