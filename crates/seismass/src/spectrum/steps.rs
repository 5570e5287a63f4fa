//! Several oscillators at a time.

use crate::lanes::InstructionSet;
use crate::spectrum::load::LoadBounds;
use crate::spectrum::oscillator::Oscillator;

/// Oscillators advanced together.
pub(super) const LANES: usize = 16;

/// A number of each of them.
pub(super) type Values = [f64; LANES];

/// Numbers of several oscillators side by side.
pub(super) fn gather<const N: usize>(
    oscillators: &[Oscillator; LANES],
    of: impl Fn(&Oscillator) -> [f64; N],
) -> [Values; N] {
    std::array::from_fn(|i| std::array::from_fn(|lane| of(&oscillators[lane])[i]))
}

/// Several oscillators side by side, advanced by steps of one size: the displacement u and another number of each.
pub(super) trait OscillatorSteps {
    fn new(oscillators: &[Oscillator; LANES]) -> Self;

    /// u and the other number of an oscillator at rest at the start of a block.
    fn at_rest(oscillator: &Oscillator, samples: &[f64]) -> [f64; 2];

    /// u and u' of an oscillator with u and the other number at the start of a block.
    fn to_rate(oscillator: &Oscillator, state: [f64; 2], samples: &[f64]) -> [f64; 2];

    /// Carries the oscillators through a block. Returns the largest |u| of its samples, and a bound of |u| within it.
    fn advance<const FUSED: bool>(&self, state: &mut [Values; 2], samples: &[f64], load: &LoadBounds) -> [Values; 2];
}

/// OscillatorSteps small enough that |u| is bounded by its samples ([`oscillator::is_small_step`]). The other number is the increment
/// of u over the next step: seven operations, where u and u' take ten.
pub(super) struct SmallSteps {
    step_w: [Values; 5],
    screen: [Values; 2],
}

impl OscillatorSteps for SmallSteps {
    fn new(oscillators: &[Oscillator; LANES]) -> Self {
        Self { step_w: gather(oscillators, |o| o.step_w), screen: gather(oscillators, Oscillator::screen) }
    }

    fn at_rest(oscillator: &Oscillator, samples: &[f64]) -> [f64; 2] {
        [0.0, oscillator.increment([0.0; 2], [samples[0], samples[1]])]
    }

    fn to_rate(oscillator: &Oscillator, state: [f64; 2], samples: &[f64]) -> [f64; 2] {
        [state[0], oscillator.rate(state, [samples[0], samples[1]])]
    }

    #[inline(always)]
    fn advance<const FUSED: bool>(&self, state: &mut [Values; 2], samples: &[f64], load: &LoadBounds) -> [Values; 2] {
        let [of_u, of_w, first, second, third] = &self.step_w;
        let [mut u, mut w] = *state;
        let mut most = u.map(f64::abs);
        for b in samples.windows(3) {
            for lane in 0..LANES {
                let of_load = multiply_add::<FUSED>(first[lane], b[0], third[lane] * b[2]);
                let of_load = multiply_add::<FUSED>(second[lane], b[1], of_load);
                let of_load = multiply_add::<FUSED>(of_u[lane], u[lane], of_load);
                u[lane] += w[lane];
                w[lane] += multiply_add::<FUSED>(of_w[lane], w[lane], of_load);
                most[lane] = larger(u[lane].abs(), most[lane]);
            }
        }
        *state = [u, w];
        let [of_u, of_load] = &self.screen;
        [most, std::array::from_fn(|lane| of_u[lane] * most[lane] + of_load[lane] * load.sample)]
    }
}

/// OscillatorSteps of any size. The other number is u', and |u| is bounded by the particular solution, which is linear within a
/// step, and the amplitude of the free vibration about it.
pub(super) struct LargeSteps {
    step_u: [Values; 4],
    step_v: [Values; 4],
    particular: [Values; 2],
    decay: Values,
    /// 1 / (q s).
    quarter: Values,
}

impl OscillatorSteps for LargeSteps {
    fn new(oscillators: &[Oscillator; LANES]) -> Self {
        let [decay, quarter] = gather(oscillators, |o| [o.zeta * o.s, 1.0 / (o.q * o.s)]);
        Self {
            step_u: gather(oscillators, |o| o.step_u),
            step_v: gather(oscillators, |o| o.step_v),
            particular: gather(oscillators, |o| o.particular),
            decay,
            quarter,
        }
    }

    fn at_rest(_: &Oscillator, _: &[f64]) -> [f64; 2] {
        [0.0; 2]
    }

    fn to_rate(_: &Oscillator, state: [f64; 2], _: &[f64]) -> [f64; 2] {
        state
    }

    #[inline(always)]
    fn advance<const FUSED: bool>(&self, state: &mut [Values; 2], samples: &[f64], load: &LoadBounds) -> [Values; 2] {
        let [uu, uv, u0, u1] = &self.step_u;
        let [vu, vv, v0, v1] = &self.step_v;
        let [per_load, per_increment] = &self.particular;
        let [mut u, mut v] = *state;
        let mut most = u.map(f64::abs);
        let mut square = [0.0; LANES];
        for b in samples.windows(3) {
            let (b0, b1) = (b[0], b[1]);
            let increment = b1 - b0;
            for lane in 0..LANES {
                let (from_u, from_v) = (u[lane], v[lane]);
                let of_load = multiply_add::<FUSED>(u0[lane], b0, u1[lane] * b1);
                let of_state = multiply_add::<FUSED>(uv[lane], from_v, of_load);
                u[lane] = from_u + multiply_add::<FUSED>(uu[lane], from_u, of_state);
                let of_load = multiply_add::<FUSED>(v0[lane], b0, v1[lane] * b1);
                let of_state = multiply_add::<FUSED>(vu[lane], from_u, of_load);
                v[lane] = from_v + multiply_add::<FUSED>(vv[lane], from_v, of_state);
                most[lane] = larger(u[lane].abs(), most[lane]);
                let free = from_u + (per_load[lane] * b0 - per_increment[lane] * increment);
                let free_rate = from_v + per_load[lane] * increment;
                let out_of_phase = (free_rate + self.decay[lane] * free) * self.quarter[lane];
                square[lane] = larger(free * free + out_of_phase * out_of_phase, square[lane]);
            }
        }
        *state = [u, v];
        let bound =
            |lane: usize| square[lane].sqrt() + (per_load[lane] * load.sample + per_increment[lane] * load.increment);
        [most, std::array::from_fn(bound)]
    }
}

/// a b + c, fused or not.
#[inline(always)]
pub(super) fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// `f64::max` without its care for NaN, which costs a second comparison.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A block of steps as the search for peaks inside steps finds it.
#[derive(Clone)]
pub(super) struct Block {
    /// u and the other number at its start.
    pub(super) start: [Values; 2],
    /// Bound of |u| within it.
    pub(super) bound: Values,
}

/// [`OscillatorSteps::advance`] by the widest vectors of the machine. A function of its own, so that what it needs stays in
/// registers.
#[allow(unsafe_code)]
pub(super) fn advance<S: OscillatorSteps>(
    steps: &S,
    state: &mut [Values; 2],
    samples: &[f64],
    load: &LoadBounds,
) -> [Values; 2] {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,avx512f,avx512vl")]
    fn avx512<S: OscillatorSteps>(
        steps: &S,
        state: &mut [Values; 2],
        samples: &[f64],
        load: &LoadBounds,
    ) -> [Values; 2] {
        steps.advance::<true>(state, samples, load)
    }
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn avx2<S: OscillatorSteps>(steps: &S, state: &mut [Values; 2], samples: &[f64], load: &LoadBounds) -> [Values; 2] {
        steps.advance::<true>(state, samples, load)
    }
    match InstructionSet::in_use() {
        // SAFETY: `in_use` returns only what this machine has.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { avx512(steps, state, samples, load) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { avx2(steps, state, samples, load) },
        _ => steps.advance::<false>(state, samples, load),
    }
}
