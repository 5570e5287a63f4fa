//! Storeys as lanes of vectors, and the instructions the hot loops may use for them.

pub(crate) mod padded;
pub(crate) mod symmetric;

use std::cell::RefCell;
use std::ops::{Deref, DerefMut};
use std::sync::OnceLock;

use crate::lanes::padded::Lanes;

/// Instructions the hot loops are compiled for. Paths agree to rounding; each gives the same bits on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InstructionSet {
    /// What every machine of the architecture has.
    Baseline,
    /// 256-bit vectors and fused multiply-add (x86-64-v3).
    Avx2,
    /// The same with twice the registers (x86-64-v4): the same bits.
    Avx512,
}

impl InstructionSet {
    /// The one in use: the widest this machine has, or what the environment variable `SEISMASS_INSTRUCTIONS`
    /// (`baseline`, `avx2`, `avx512`) names. Where the machine does not have that, or it is no such name, it is the baseline,
    /// and a line on standard error says so. Read once.
    #[inline]
    pub fn in_use() -> Self {
        static CHOSEN: OnceLock<InstructionSet> = OnceLock::new();
        *CHOSEN.get_or_init(|| {
            let wanted = std::env::var("SEISMASS_INSTRUCTIONS").unwrap_or_default();
            let chosen = [Self::Avx512, Self::Avx2]
                .into_iter()
                .find(|set| set.is_available() && (wanted.is_empty() || wanted == set.name()))
                .unwrap_or(Self::Baseline);
            if !wanted.is_empty() && wanted != chosen.name() {
                let known = [Self::Avx512, Self::Avx2].iter().any(|set| wanted == set.name());
                let reason = if known { "which this machine does not have" } else { "not baseline, avx2 or avx512" };
                eprintln!("seismass: SEISMASS_INSTRUCTIONS is {wanted:?}, {reason}: the baseline is used");
            }
            chosen
        })
    }

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            Self::Avx512 => {
                Self::Avx2.is_available() && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl")
            }
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Self::Baseline
    }
}

/// Lanes of a vector.
pub(crate) const WIDTH: usize = 4;
/// All lanes of a vector, as bits.
pub(crate) const LANES: u32 = (1 << WIDTH) - 1;
/// Most storeys that the hot loops hold in vectors.
pub(crate) const MAX_LANES: usize = 48;
/// As many vectors.
pub(crate) const WIDEST: usize = MAX_LANES / WIDTH;
/// Stands for a bound that is never reached in lanes: finite, so that the middle between two of them is.
pub(crate) const FAR: f64 = 1e300;

/// Storeys padded to whole vectors.
pub(crate) fn padded(storeys: usize) -> usize {
    match storeys {
        0..=4 => 4,
        5..=8 => 8,
        9..=16 => 16,
        17..=32 => 32,
        33..=MAX_LANES => MAX_LANES,
        _ => storeys.next_multiple_of(8),
    }
}

/// Values padded to whole vectors of a scene with `storeys`.
pub(crate) fn filled(values: impl IntoIterator<Item = f64>, storeys: usize, padding: f64) -> Vec<f64> {
    filled_to(padded(storeys), values, padding)
}

/// Values padded to a length.
pub(crate) fn filled_to(length: usize, values: impl IntoIterator<Item = f64>, padding: f64) -> Vec<f64> {
    let mut out = Vec::with_capacity(length);
    out.extend(values);
    out.resize(length, padding);
    out
}

/// Numbers that begin at a cache line: no vector of them lies across two.
///
/// Their memory is kept by the thread for the next ones: regimes come and go by the thousand, and memory that goes back
/// to the system returns page by page, each page at the cost of an event.
#[derive(Debug, Default)]
pub(crate) struct Aligned {
    values: Vec<f64>,
    offset: usize,
}

/// Most numbers that a thread keeps memory for; beyond that it lets all of it go.
const MOST_SPARE: usize = 1 << 20;

/// Memory kept by a thread, by class of its capacity.
#[derive(Default)]
struct Spare {
    by_class: Vec<Vec<Vec<f64>>>,
    numbers: usize,
}

thread_local! {
    static SPARE: RefCell<Spare> = RefCell::default();
}

impl Spare {
    /// The class of so many numbers, and its capacity: there are four within each power of two.
    fn class(length: usize) -> (usize, usize) {
        let step = (length.next_power_of_two() / 8).max(1);
        let steps = length.div_ceil(step);
        (4 * step.ilog2() as usize + steps, steps * step)
    }

    fn take(&mut self, class: usize) -> Option<Vec<f64>> {
        let values = self.by_class.get_mut(class)?.pop()?;
        self.numbers -= values.capacity();
        Some(values)
    }

    fn keep(&mut self, values: Vec<f64>) {
        let capacity = values.capacity();
        if capacity > MOST_SPARE {
            return;
        }
        if self.numbers + capacity > MOST_SPARE {
            *self = Self::default();
        }
        self.numbers += capacity;
        let (class, _) = Self::class(capacity);
        if self.by_class.len() <= class {
            self.by_class.resize_with(class + 1, Vec::new);
        }
        self.by_class[class].push(values);
    }
}

impl Aligned {
    /// So many zeros.
    pub(crate) fn zeros(length: usize) -> Self {
        let mut zeros = Self::unset(length);
        zeros.fill(0.0);
        zeros
    }

    /// So many numbers, any, each of which is to be set.
    pub(crate) fn unset(length: usize) -> Self {
        const LINE: usize = 64;
        let slack = LINE / size_of::<f64>() - 1;
        if length == 0 {
            return Self::default();
        }
        let (class, capacity) = Spare::class(length + slack);
        let kept = SPARE.try_with(|spare| spare.borrow_mut().take(class)).ok().flatten();
        let mut values = kept.unwrap_or_else(|| Vec::with_capacity(capacity));
        let offset = values.as_ptr().align_offset(LINE).min(slack);
        values.resize(offset + length, 0.0);
        if cfg!(debug_assertions) {
            // What is read before it is set shows.
            values.fill(f64::NAN);
        }
        Self { values, offset }
    }
}

impl Drop for Aligned {
    fn drop(&mut self) {
        if self.values.capacity() > 0 {
            let values = std::mem::take(&mut self.values);
            // Without the thread's store, at its end, memory is simply freed.
            let _ = SPARE.try_with(|spare| spare.borrow_mut().keep(values));
        }
    }
}

impl Deref for Aligned {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        &self.values[self.offset..]
    }
}

impl DerefMut for Aligned {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.offset..]
    }
}

/// At the start of a cache line: no vector of it lies across two.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct OnLine<T>(pub(crate) T);

impl<T> Deref for OnLine<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}

/// Four lanes.
pub(crate) trait Vector: Copy {
    fn splat(value: f64) -> Self;
    fn load(values: &[f64; WIDTH]) -> Self;
    /// From numbers that are not in memory yet: to put them there and load them at once would wait for each.
    fn of(values: [f64; WIDTH]) -> Self;
    fn store(self, values: &mut [f64; WIDTH]);
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    /// self * factor + term, fused where the path has it.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    fn abs(self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// One lane in all.
    fn broadcast(self, lane: usize) -> Self;
    /// Each lane takes that below it, the lowest takes the highest of `before`.
    fn shifted_up(self, before: Self) -> Self;
    /// Each lane takes that above it, the highest takes the lowest of `after`.
    fn shifted_down(self, after: Self) -> Self;
    /// The same with the lanes of `other` of which the bits are set.
    fn with(self, bits: u32, other: Self) -> Self;
    /// The same with a number in one lane. What is made so can be stored and read again at once.
    fn with_lane(self, lane: usize, value: f64) -> Self;
    /// Lane j of vector i becomes lane i of vector j.
    fn transposed(vectors: [Self; WIDTH]) -> [Self; WIDTH];
    /// Bits of the lanes that are not below those of `other`; lanes that are no numbers are not.
    fn not_below(self, other: Self) -> u32;
    fn sum(self) -> f64;
    /// The same sum in every lane.
    fn total(self) -> Self;
    /// a * b + c of numbers, fused where the path has it.
    fn fused(a: f64, b: f64, c: f64) -> f64;
}

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

/// Vectors of padded values.
#[inline(always)]
pub(crate) fn lanes(values: &[f64]) -> &[[f64; WIDTH]] {
    values.as_chunks::<WIDTH>().0
}

#[inline(always)]
pub(crate) fn lanes_mut(values: &mut [f64]) -> &mut [[f64; WIDTH]] {
    values.as_chunks_mut::<WIDTH>().0
}

/// Vector `k` of padded values.
#[inline(always)]
pub(crate) fn at<V: Vector>(values: &[f64], k: usize) -> V {
    V::load(&lanes(values)[k])
}

/// The first `K` vectors of padded values; zeros where there are fewer.
#[inline(always)]
pub(crate) fn load<V: Vector, const K: usize>(values: &(impl Lanes + ?Sized)) -> [V; K] {
    let mut vectors = [V::splat(0.0); K];
    if let Some(lanes) = values.vectors::<K>() {
        for k in 0..K {
            vectors[k] = V::load(&lanes[k]);
        }
    }
    vectors
}

/// The vectors of storey `i`, of at most [`MAX_LANES`], alone: 1 in its lane, 0 elsewhere. They are read from one place for
/// all: a vector read where a number has just been written waits for it to arrive in memory.
#[inline(always)]
pub(crate) fn unit<V: Vector, const K: usize>(i: usize) -> [V; K] {
    static UNIT: [f64; 2 * MAX_LANES] = {
        let mut values = [0.0; 2 * MAX_LANES];
        values[MAX_LANES] = 1.0;
        values
    };
    load(&UNIT[MAX_LANES - i..])
}

/// Puts vectors into padded values, if these hold as many.
#[inline(always)]
pub(crate) fn store<V: Vector, const K: usize>(vectors: &[V; K], values: &mut (impl Lanes + ?Sized)) {
    if let Some(lanes) = values.vectors_mut::<K>() {
        for k in 0..K {
            vectors[k].store(&mut lanes[k]);
        }
    }
}

/// Vectors as numbers.
#[inline(always)]
pub(crate) fn numbers<V: Vector, const K: usize>(vectors: &[V; K]) -> [[f64; WIDTH]; K] {
    let mut out = [[0.0; WIDTH]; K];
    for k in 0..K {
        vectors[k].store(&mut out[k]);
    }
    out
}

/// Padded columns, one after the other.
#[inline(always)]
pub(crate) fn columns_of<const K: usize>(values: &[f64]) -> &[[[f64; WIDTH]; K]] {
    values.as_chunks::<WIDTH>().0.as_chunks::<K>().0
}

/// Differences between each lane and that below it; the lowest keeps `bottom` below it.
#[inline(always)]
pub(crate) fn differences<V: Vector, const K: usize>(values: &[V; K], bottom: V) -> [V; K] {
    let mut out = *values;
    for k in 0..K {
        let before = if k > 0 { values[k - 1] } else { bottom };
        out[k] = values[k].sub(values[k].shifted_up(before));
    }
    out
}

/// Sums of each lane and all below it.
#[inline(always)]
pub(crate) fn prefix_sums<V: Vector, const K: usize>(values: &[V; K]) -> [V; K] {
    let zero = V::splat(0.0);
    let mut out = *values;
    for k in 0..K {
        let pairs = values[k].add(values[k].shifted_up(zero));
        out[k] = pairs.add(pairs.shifted_up(zero).shifted_up(zero));
        if k > 0 {
            out[k] = out[k].add(out[k - 1].broadcast(WIDTH - 1));
        }
    }
    out
}

/// An expression in which `$count` is the number of vectors in a padded width of at most [`MAX_LANES`], as a constant.
macro_rules! by_width {
    ($width:expr, $count:ident => $call:expr) => {
        match $width {
            4 => {
                const $count: usize = 1;
                $call
            }
            8 => {
                const $count: usize = 2;
                $call
            }
            16 => {
                const $count: usize = 4;
                $call
            }
            32 => {
                const $count: usize = 8;
                $call
            }
            _ => {
                const $count: usize = crate::lanes::WIDEST;
                $call
            }
        }
    };
}
pub(crate) use by_width;

/// Defines a function of which each path is compiled for its instructions: `inner`, generic in the vector and in the
/// constants in brackets, if there are any.
macro_rules! for_each_path {
    ($(#[$meta:meta])* $vis:vis fn $name:ident $([$($constant:ident: $of:ty),*])? ($($arg:ident: $type:ty),* $(,)?)
        $(-> $out:ty)? = $inner:ident) => {
        $(#[$meta])*
        #[allow(unsafe_code)]
        $vis fn $name $(<$(const $constant: $of),*>)? ($($arg: $type),*) $(-> $out)? {
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma,avx512f,avx512vl")]
            fn avx512 $(<$(const $constant: $of),*>)? ($($arg: $type),*) $(-> $out)? {
                $inner::<crate::lanes::Fused $($(, $constant)*)?>($($arg),*)
            }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma")]
            fn avx2 $(<$(const $constant: $of),*>)? ($($arg: $type),*) $(-> $out)? {
                $inner::<crate::lanes::Fused $($(, $constant)*)?>($($arg),*)
            }
            match crate::lanes::InstructionSet::in_use() {
                // SAFETY: `in_use` returns only what this machine has.
                #[cfg(target_arch = "x86_64")]
                crate::lanes::InstructionSet::Avx512 => unsafe { avx512 $(::<$($constant),*>)? ($($arg),*) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                crate::lanes::InstructionSet::Avx2 => unsafe { avx2 $(::<$($constant),*>)? ($($arg),*) },
                _ => $inner::<crate::lanes::Plain $($(, $constant)*)?>($($arg),*),
            }
        }
    };
}
pub(crate) use for_each_path;

#[cfg(target_arch = "x86_64")]
pub(crate) use x86::Fused;

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod x86 {
    use std::arch::x86_64::*;

    use super::{Vector, WIDTH};

    /// A 256-bit vector with fused multiply-add.
    ///
    /// To be used only inside functions compiled for `avx2,fma`, which call nothing that is not inlined into them: these
    /// are reached through [`super::InstructionSet::in_use`] alone. A closure is a call: it is compiled for the baseline,
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
                let (more_even, more_odd) =
                    (_mm256_unpacklo_pd(third.0, fourth.0), _mm256_unpackhi_pd(third.0, fourth.0));
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
}
