//! Elastic response spectra: peak relative displacement of linear oscillators under a sampled ground motion.
//!
//! # Method
//! The motion is linear between samples, so the state after a step is an exact linear function of the state before
//! and the two samples (Nigam and Jennings 1969, Bull. Seism. Soc. Am. 59:909). Time is measured in steps: with
//! s = w dt and b = dt^2 a, the oscillator is u'' + 2 zeta s u' + s^2 u = -b. Within a step u'' is a free vibration,
//! so its zeros are known in closed form; between them u' is monotone and each of its zeros is bracketed. Samples come
//! first, several oscillators at a time, small steps by the increment of u in place of u'; then only steps are looked
//! into whose bound on |u| exceeds the largest sample.
//!
//! # Limitation
//! Damping ratios from 0 to below 1. After the last sample the motion goes to zero over one step and stays there.

use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::error::{Domain, Error, Result};
use crate::lanes::InstructionSet;
use crate::memory::is_there_memory;
use crate::scene::Motion;
use crate::threads::{Control, in_pool};

mod oscillator;
mod peaks;

use oscillator::Oscillator;
pub use peaks::{OscillatorPeak, oscillator_peaks};

/// Oscillators advanced together.
const LANES: usize = 16;
/// A number of each of them.
type Values = [f64; LANES];
/// OscillatorSteps that share one bound of |u|.
const BLOCK: usize = 32;
/// Blocks between two searches for peaks inside steps; what is kept of them fits the second-level cache.
const BLOCKS_PER_SEARCH: usize = 256;
/// Largest power of two, and its inverse, that motions are divided by.
const LARGEST_EXPONENT: f64 = 1000.0;
/// Shortest and longest period of an oscillator over the time step of its motion.
pub const PERIOD_RANGE: [f64; 2] = [1e-3, 1e9];

/// Peak relative displacement (m) of oscillators at rest at the first sample, in continuous time, the free vibration
/// after the motion included; row-major (motions, damping, periods).
///
/// `periods` in s, `damping` as ratios of critical. Any number of `threads` gives the same bits (default: all cores).
///
/// # Errors
/// [`Error::Invalid`] when a period, a ratio or the number of threads is out of its range, [`Error::NotFinite`] when a
/// displacement is, [`Error::Interrupted`] when stopped.
pub fn response_spectra(
    motions: &[Motion],
    periods: &[f64],
    damping: &[f64],
    threads: Option<usize>,
    control: &Control,
) -> Result<Vec<f64>> {
    let count = validate(motions, periods, damping, 1)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    let per_motion = periods.len() * damping.len();
    let mut peaks = vec![0.0; count];
    let solve = |peaks: &mut [f64]| {
        let each = peaks.par_chunks_mut(per_motion).zip(motions);
        each.try_for_each(|(peaks, motion)| solve_one(motion, periods, damping, control, peaks))
    };
    in_pool(threads, "spectrum", || solve(&mut peaks))??;
    Ok(peaks)
}

/// Peak displacements under one motion.
fn solve_one(motion: &Motion, periods: &[f64], damping: &[f64], control: &Control, peaks: &mut [f64]) -> Result<()> {
    let load = Load::new(motion);
    let of = |index: usize| (periods[index % periods.len()], damping[index / periods.len()]);
    let found = |indices: &[usize], peaks_of: PeaksOf| -> Result<Vec<Values>> {
        let groups = indices.par_chunks(LANES).map(|indices| {
            let oscillators = std::array::from_fn(|lane| {
                let (period, zeta) = of(indices[lane.min(indices.len() - 1)]);
                Oscillator::new(period, zeta, motion.dt())
            });
            let peaks = peaks_of(&load, &oscillators, control)?;
            match indices.iter().zip(peaks).find(|(_, peak)| !peak.is_finite()) {
                None => Ok(peaks),
                Some((&index, _)) => Err(Error::NotFinite {
                    time: motion.dt() * motion.acceleration().len() as f64,
                    element: format!("the oscillator of period {} s", of(index).0),
                }),
            }
        });
        groups.collect()
    };
    // Side by side are oscillators of about the same period: what bounds them is large in the same blocks.
    let by_period = (0..periods.len()).flat_map(|i| (i..peaks.len()).step_by(periods.len()));
    let (small, large): (Vec<usize>, Vec<usize>) =
        by_period.partition(|&index| oscillator::is_small_step(of(index).0, of(index).1, motion.dt()));
    let of_both = rayon::join(|| found(&small, peaks_of::<SmallSteps>), || found(&large, peaks_of::<LargeSteps>));
    for (indices, found) in [(small, of_both.0?), (large, of_both.1?)] {
        for (index, peak) in indices.into_iter().zip(found.into_iter().flatten()) {
            peaks[index] = peak;
        }
    }
    Ok(())
}

/// Number of oscillators under all motions, for each of which there is memory for `numbers`.
fn validate(motions: &[Motion], periods: &[f64], damping: &[f64], numbers: usize) -> Result<usize> {
    for (i, &period) in periods.iter().enumerate() {
        if !(period.is_finite() && period > 0.0) {
            let owner = format!("oscillator {}", i + 1);
            return Err(Error::invalid(Domain::Options, "period", owner, "a positive number", period));
        }
    }
    if let Some((i, zeta)) = damping.iter().enumerate().find(|(_, zeta)| !(0.0..1.0).contains(*zeta)) {
        let owner = format!("spectrum {}", i + 1);
        return Err(Error::invalid(Domain::Options, "damping", owner, "at least 0 and below 1", zeta));
    }
    for (m, motion) in motions.iter().enumerate() {
        let [shortest, longest] = PERIOD_RANGE.map(|ratio| ratio * motion.dt());
        if let Some((i, period)) = periods.iter().enumerate().find(|(_, t)| !(shortest..=longest).contains(*t)) {
            let owner = format!("oscillator {}", i + 1);
            let requirement = format!("from {shortest} to {longest} s for the time step of motion {}", m + 1);
            return Err(Error::invalid(Domain::Options, "period", owner, requirement, period));
        }
    }
    let count = motions.len().saturating_mul(periods.len().saturating_mul(damping.len()));
    if !is_there_memory(count.saturating_mul(numbers)) {
        let requirement = "of so few oscillators and motions that their peaks fit into memory";
        return Err(Error::invalid(Domain::Options, "periods", "spectrum", requirement, format!("{count} peaks")));
    }
    Ok(count)
}

/// A motion times dt^2 (m) and a factor, without its quiet head and tail but for the zeros that follow it, and what bounds
/// it in each block of steps. Before it nothing moves; the free vibration after it is known in closed form.
struct Load {
    samples: Vec<f64>,
    /// The sample of the motion with which they begin.
    first: usize,
    blocks: Vec<LoadBounds>,
    /// The inverse of the factor: a power of two, near the largest acceleration, so that no square leaves the range of
    /// numbers.
    unit: f64,
}

/// Largest sample and largest increment within a block.
struct LoadBounds {
    sample: f64,
    increment: f64,
}

impl Load {
    fn new(motion: &Motion) -> Self {
        let square = motion.dt() * motion.dt();
        let acceleration = motion.acceleration();
        let first = acceleration.iter().position(|&a| a != 0.0).unwrap_or(0).saturating_sub(1);
        let last = acceleration.iter().rposition(|&a| a != 0.0).unwrap_or(0);
        let largest = acceleration.iter().fold(0.0, |most, a| a.abs().max(most));
        let exponent =
            if largest > 0.0 { libm::log2(largest).clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT) as i32 } else { 0 };
        let (unit, per_unit) = (2f64.powi(exponent), 2f64.powi(-exponent));
        let scaled = acceleration[first..=last].iter().map(|a| square * (a * per_unit));
        let samples: Vec<f64> = scaled.chain([0.0; 2]).collect();
        let ends = &samples[..samples.len() - 1];
        let blocks = (0..ends.len() - 1)
            .step_by(BLOCK)
            .map(|start| {
                let within = &ends[start..ends.len().min(start + BLOCK + 1)];
                LoadBounds {
                    sample: within.iter().fold(0.0, |most, b| b.abs().max(most)),
                    increment: within.windows(2).fold(0.0, |most, b| (b[1] - b[0]).abs().max(most)),
                }
            })
            .collect();
        Self { samples, first, blocks, unit }
    }

    /// Samples at the ends of the steps of a block, and the next.
    fn block(&self, index: usize) -> &[f64] {
        let start = index * BLOCK;
        &self.samples[start..self.samples.len().min(start + BLOCK + 2)]
    }
}

/// Numbers of several oscillators side by side.
fn gather<const N: usize>(oscillators: &[Oscillator; LANES], of: impl Fn(&Oscillator) -> [f64; N]) -> [Values; N] {
    std::array::from_fn(|i| std::array::from_fn(|lane| of(&oscillators[lane])[i]))
}

/// Several oscillators side by side, advanced by steps of one size: the displacement u and another number of each.
trait OscillatorSteps {
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
struct SmallSteps {
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
struct LargeSteps {
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
fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// `f64::max` without its care for NaN, which costs a second comparison.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A block of steps as the search for peaks inside steps finds it.
#[derive(Clone)]
struct Block {
    /// u and the other number at its start.
    start: [Values; 2],
    /// Bound of |u| within it.
    bound: Values,
}

/// [`OscillatorSteps::advance`] by the widest vectors of the machine. A function of its own, so that what it needs stays in
/// registers.
#[allow(unsafe_code)]
fn advance<S: OscillatorSteps>(steps: &S, state: &mut [Values; 2], samples: &[f64], load: &LoadBounds) -> [Values; 2] {
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

/// [`peaks_of`] steps of one size.
type PeaksOf = fn(&Load, &[Oscillator; LANES], &Control) -> Result<Values>;

/// Peak displacement of each oscillator.
fn peaks_of<S: OscillatorSteps>(load: &Load, oscillators: &[Oscillator; LANES], control: &Control) -> Result<Values> {
    let steps = S::new(oscillators);
    let mut state = gather(oscillators, |o| S::at_rest(o, load.block(0)));
    let mut peak = [0.0; LANES];
    let zeros = [0.0; LANES];
    let blocks = &mut vec![Block { start: [zeros; 2], bound: zeros }; BLOCKS_PER_SEARCH.min(load.blocks.len())];
    for first in (0..load.blocks.len()).step_by(BLOCKS_PER_SEARCH) {
        if control.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let bounds = &load.blocks[first..];
        for (index, (block, bounds)) in blocks.iter_mut().zip(bounds).enumerate() {
            block.start = state;
            let most;
            [most, block.bound] = advance(&steps, &mut state, load.block(first + index), bounds);
            peak = std::array::from_fn(|lane| larger(most[lane], peak[lane]));
        }
        for (index, block) in blocks.iter().enumerate().take(bounds.len()) {
            // Most blocks beat no lane's peak: asked of all lanes at once.
            if !(0..LANES).fold(false, |any, lane| any | (block.bound[lane] > peak[lane])) {
                continue;
            }
            let samples = load.block(first + index);
            for (lane, peak) in peak.iter_mut().enumerate() {
                if block.bound[lane] > *peak {
                    let oscillator = &oscillators[lane];
                    let start = S::to_rate(oscillator, block.start.map(|values| values[lane]), samples);
                    *peak = oscillator.peak_inside_steps(start, &samples[..samples.len() - 1], *peak);
                }
            }
        }
    }
    // Nothing moves the ground any more.
    Ok(std::array::from_fn(|lane| {
        let [u, v] = S::to_rate(&oscillators[lane], state.map(|values| values[lane]), &[0.0; 2]);
        let finite = u.is_finite() && v.is_finite();
        if finite { load.unit * peak[lane].max(oscillators[lane].free_peak(u, v)) } else { f64::NAN }
    }))
}
