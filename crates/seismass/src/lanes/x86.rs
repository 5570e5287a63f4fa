//! Vectors of the x86-64 paths.

#![allow(unsafe_code)]

use std::arch::x86_64::*;

use crate::lanes::vector::{Vector, WIDTH};

/// A 256-bit vector with fused multiply-add.
///
/// To be used only inside functions compiled for `avx2,fma`, which call nothing that is not inlined into them: these
/// are reached through [`InstructionSet::in_use`](crate::lanes::InstructionSet::in_use) alone. A closure is a call: it is compiled for the baseline,
/// and each operation of a vector in it becomes a call too.
#[derive(Clone, Copy)]
pub(crate) struct Fused(__m256d);

// SAFETY, of all blocks below: see the type.
impl Vector for Fused {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(unsafe { _mm256_set1_pd(value) })
    }
    #[inline(always)]
    fn load(values: &[f64; WIDTH]) -> Self {
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }
    #[inline(always)]
    fn of([first, second, third, fourth]: [f64; WIDTH]) -> Self {
        Self(unsafe { _mm256_set_pd(fourth, third, second, first) })
    }
    #[inline(always)]
    fn store(self, values: &mut [f64; WIDTH]) {
        unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(unsafe { _mm256_add_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(unsafe { _mm256_sub_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(unsafe { _mm256_mul_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(unsafe { _mm256_div_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(unsafe { _mm256_fmadd_pd(self.0, factor.0, term.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn broadcast(self, lane: usize) -> Self {
        Self(unsafe {
            match lane {
                0 => _mm256_permute4x64_pd::<0b00_00_00_00>(self.0),
                1 => _mm256_permute4x64_pd::<0b01_01_01_01>(self.0),
                2 => _mm256_permute4x64_pd::<0b10_10_10_10>(self.0),
                _ => _mm256_permute4x64_pd::<0b11_11_11_11>(self.0),
            }
        })
    }
    #[inline(always)]
    fn shifted_up(self, before: Self) -> Self {
        // (before 2, 3, self 0, 1), of which the upper of each pair goes to the lower of the next.
        Self(unsafe {
            let middle = _mm256_permute2f128_pd::<0x21>(before.0, self.0);
            _mm256_shuffle_pd::<0b0101>(middle, self.0)
        })
    }
    #[inline(always)]
    fn shifted_down(self, after: Self) -> Self {
        // (self 2, 3, after 0, 1).
        Self(unsafe {
            let middle = _mm256_permute2f128_pd::<0x21>(self.0, after.0);
            _mm256_shuffle_pd::<0b0101>(self.0, middle)
        })
    }
    #[inline(always)]
    fn with(self, bits: u32, other: Self) -> Self {
        Self(unsafe {
            let of_lanes = _mm256_set_epi64x(8, 4, 2, 1);
            let set = _mm256_and_si256(_mm256_set1_epi64x(i64::from(bits)), of_lanes);
            let mask = _mm256_cmpeq_epi64(set, of_lanes);
            _mm256_blendv_pd(self.0, other.0, _mm256_castsi256_pd(mask))
        })
    }
    #[inline(always)]
    fn with_lane(self, lane: usize, value: f64) -> Self {
        // Of a choice of lanes that is stored the compiler makes a store of these alone, which what is read next has to
        // wait for: bits, and masks that it does not see through, are none.
        static MASKS: [[i64; WIDTH]; WIDTH] = [[-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0], [0, 0, 0, -1]];
        Self(unsafe {
            let mask = _mm256_loadu_pd(MASKS[lane % WIDTH].as_ptr().cast());
            _mm256_or_pd(_mm256_andnot_pd(mask, self.0), _mm256_and_pd(mask, _mm256_set1_pd(value)))
        })
    }
    #[inline(always)]
    fn transposed([first, second, third, fourth]: [Self; WIDTH]) -> [Self; WIDTH] {
        unsafe {
            let (even, odd) = (_mm256_unpacklo_pd(first.0, second.0), _mm256_unpackhi_pd(first.0, second.0));
            let (more_even, more_odd) = (_mm256_unpacklo_pd(third.0, fourth.0), _mm256_unpackhi_pd(third.0, fourth.0));
            [
                Self(_mm256_permute2f128_pd::<0x20>(even, more_even)),
                Self(_mm256_permute2f128_pd::<0x20>(odd, more_odd)),
                Self(_mm256_permute2f128_pd::<0x31>(even, more_even)),
                Self(_mm256_permute2f128_pd::<0x31>(odd, more_odd)),
            ]
        }
    }
    #[inline(always)]
    fn not_below(self, other: Self) -> u32 {
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_NLT_UQ>(self.0, other.0)) as u32 }
    }
    #[inline(always)]
    fn mark_not_below(self, other: Self, before: Self) -> Self {
        Self(unsafe { _mm256_or_pd(before.0, _mm256_cmp_pd::<_CMP_NLT_UQ>(self.0, other.0)) })
    }
    #[inline(always)]
    fn has_marks(self) -> bool {
        unsafe { _mm256_movemask_pd(self.0) != 0 }
    }
    #[inline(always)]
    fn fused(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        unsafe {
            let pair = _mm_add_pd(_mm256_castpd256_pd128(self.0), _mm256_extractf128_pd::<1>(self.0));
            _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)))
        }
    }
    #[inline(always)]
    fn total(self) -> Self {
        Self(unsafe {
            let pairs = _mm256_add_pd(self.0, _mm256_permute2f128_pd::<0x01>(self.0, self.0));
            _mm256_add_pd(pairs, _mm256_permute_pd::<0b0101>(pairs))
        })
    }
}
