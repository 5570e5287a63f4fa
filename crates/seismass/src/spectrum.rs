//! Elastic response spectra: peak relative displacement of linear oscillators under a sampled ground motion.
//!
//! # Method
//! The motion is linear between samples, so the state after a step is an exact linear function of the state before
//! and the two samples (Nigam and Jennings 1969, Bull. Seism. Soc. Am. 59:909). Time is measured in steps: with
//! s = w dt and b = dt^2 a, the oscillator is u'' + 2 zeta s u' + s^2 u = -b. Within a step u'' is a free vibration,
//! so its zeros are known in closed form; between them u' is monotone and each of its zeros is bracketed. Samples come
//! first, several oscillators at a time; then only steps are looked into whose bound on |u| exceeds the largest sample.
//!
//! # Limitation
//! Damping ratios from 0 to below 1. After the last sample the motion goes to zero over one step and stays there.

use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::batch::Control;
use crate::error::{Domain, Error, Result};
use crate::lanes::InstructionSet;
use crate::scene::Motion;

mod oscillator;

use oscillator::{Oscillator, SMALL_STEP};

/// Oscillators advanced together.
const LANES: usize = 16;
/// Steps that share one bound of |u|.
const BLOCK: usize = 32;
/// Blocks between two searches for peaks inside steps; what is kept of them fits the second-level cache.
const BLOCKS_PER_SEARCH: usize = 256;
/// Shortest and longest period over the time step.
const PERIOD_RANGE: [f64; 2] = [1e-3, 1e9];

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
    validate(motions, periods, damping)?;
    let per_motion = periods.len() * damping.len();
    let mut peaks = vec![0.0; motions.len() * per_motion];
    if peaks.is_empty() {
        return Ok(peaks);
    }
    let solve = |peaks: &mut [f64]| {
        peaks.par_chunks_mut(per_motion).zip(motions).try_for_each(|(peaks, motion)| {
            let load = Load::new(motion);
            peaks.par_chunks_mut(LANES).enumerate().try_for_each(|(group, peaks)| {
                let oscillators: [Oscillator; LANES] = std::array::from_fn(|lane| {
                    let index = group * LANES + lane.min(peaks.len() - 1);
                    Oscillator::new(periods[index % periods.len()], damping[index / periods.len()], motion.dt())
                });
                let found = advance(&load, &oscillators, control)?;
                peaks.copy_from_slice(&found[..peaks.len()]);
                match peaks.iter().position(|peak| !peak.is_finite()) {
                    None => Ok(()),
                    Some(lane) => Err(Error::NotFinite {
                        time: motion.dt() * motion.acceleration().len() as f64,
                        element: format!(
                            "the oscillator of period {} s",
                            periods[(group * LANES + lane) % periods.len()]
                        ),
                    }),
                }
            })
        })
    };
    match threads {
        None => solve(&mut peaks)?,
        Some(threads) => {
            let refuse = |value: String| {
                Error::invalid(Domain::Options, "threads", "spectrum", "a number of threads that can be started", value)
            };
            if threads == 0 {
                return Err(refuse("0".into()));
            }
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.map_err(|error| refuse(format!("{threads} ({error})")))?.install(|| solve(&mut peaks))?;
        }
    }
    Ok(peaks)
}

fn validate(motions: &[Motion], periods: &[f64], damping: &[f64]) -> Result<()> {
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
    Ok(())
}

/// A motion times dt^2 (m), with the zero that follows it, and what bounds it in each block of steps.
struct Load {
    samples: Vec<f64>,
    blocks: Vec<LoadBounds>,
}

/// Largest sample and largest increment within a block.
struct LoadBounds {
    sample: f64,
    increment: f64,
}

impl Load {
    fn new(motion: &Motion) -> Self {
        let square = motion.dt() * motion.dt();
        let mut samples: Vec<f64> = motion.acceleration().iter().map(|a| square * a).collect();
        samples.push(0.0);
        let blocks = (0..samples.len() - 1)
            .step_by(BLOCK)
            .map(|start| {
                let within = &samples[start..samples.len().min(start + BLOCK + 1)];
                LoadBounds {
                    sample: within.iter().fold(0.0, |most, b| b.abs().max(most)),
                    increment: within.windows(2).fold(0.0, |most, b| (b[1] - b[0]).abs().max(most)),
                }
            })
            .collect();
        Self { samples, blocks }
    }

    /// Samples at the ends of the steps of a block.
    fn block(&self, index: usize) -> &[f64] {
        let start = index * BLOCK;
        &self.samples[start..self.samples.len().min(start + BLOCK + 1)]
    }
}

/// Coefficients of several oscillators side by side.
struct Lanes {
    step_u: [[f64; LANES]; 4],
    step_v: [[f64; LANES]; 4],
    particular: [[f64; LANES]; 2],
    decay: [f64; LANES],
    /// 1 / (q s).
    quarter: [f64; LANES],
    /// Bound of |u| within a block, per the two measures of `advance`, largest |b| and largest |increment of b|.
    screen: [[f64; LANES]; 4],
}

impl Lanes {
    fn new(oscillators: &[Oscillator; LANES], small: bool) -> Self {
        fn gather<const N: usize>(
            oscillators: &[Oscillator; LANES],
            of: impl Fn(&Oscillator) -> [f64; N],
        ) -> [[f64; LANES]; N] {
            std::array::from_fn(|i| std::array::from_fn(|lane| of(&oscillators[lane])[i]))
        }
        let [decay, quarter] = gather(oscillators, |o| [o.zeta * o.s, 1.0 / (o.q * o.s)]);
        Self {
            step_u: gather(oscillators, |o| o.step_u),
            step_v: gather(oscillators, |o| o.step_v),
            particular: gather(oscillators, |o| o.particular),
            decay,
            quarter,
            screen: gather(oscillators, |o| {
                if small {
                    [1.0 + o.chord * o.s * o.s, o.chord * 2.0 * o.zeta * o.s, o.chord, 0.0]
                } else {
                    [0.0, 1.0, o.particular[0], o.particular[1]]
                }
            }),
        }
    }

    /// Carries `u` and `v` through a block. Returns the largest |u| after a step, and the largest |v| where s is
    /// `SMALL`, otherwise the largest squared amplitude of the free vibration about the particular solution.
    #[inline(always)]
    fn advance<const SMALL: bool, const FUSED: bool>(
        &self,
        u: &mut [f64; LANES],
        v: &mut [f64; LANES],
        samples: &[f64],
    ) -> [[f64; LANES]; 2] {
        let [uu, uv, u0, u1] = &self.step_u;
        let [vu, vv, v0, v1] = &self.step_v;
        let [per_load, per_increment] = &self.particular;
        let mut most_u = [0.0; LANES];
        let mut most_other = if SMALL { v.map(f64::abs) } else { [0.0; LANES] };
        for pair in samples.windows(2) {
            let (b0, b1) = (pair[0], pair[1]);
            let increment = b1 - b0;
            for lane in 0..LANES {
                let (from_u, from_v) = (u[lane], v[lane]);
                let of_load = multiply_add::<FUSED>(u0[lane], b0, u1[lane] * b1);
                let of_state = multiply_add::<FUSED>(uv[lane], from_v, of_load);
                u[lane] = from_u + multiply_add::<FUSED>(uu[lane], from_u, of_state);
                let of_load = multiply_add::<FUSED>(v0[lane], b0, v1[lane] * b1);
                let of_state = multiply_add::<FUSED>(vu[lane], from_u, of_load);
                v[lane] = from_v + multiply_add::<FUSED>(vv[lane], from_v, of_state);
                most_u[lane] = larger(u[lane].abs(), most_u[lane]);
                let other = if SMALL {
                    v[lane].abs()
                } else {
                    let free = from_u + (per_load[lane] * b0 - per_increment[lane] * increment);
                    let free_rate = from_v + per_load[lane] * increment;
                    let out_of_phase = (free_rate + self.decay[lane] * free) * self.quarter[lane];
                    free * free + out_of_phase * out_of_phase
                };
                most_other[lane] = larger(other, most_other[lane]);
            }
        }
        [most_u, most_other]
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
struct Block {
    /// u and u' at its start.
    start: [[f64; LANES]; 2],
    /// Bound of |u| within it.
    bound: [f64; LANES],
}

/// Peak displacement of each oscillator, by the widest vectors of the machine.
#[allow(unsafe_code)]
fn advance(load: &Load, oscillators: &[Oscillator; LANES], control: &Control) -> Result<[f64; LANES]> {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,avx512f,avx512vl")]
    fn avx512(load: &Load, oscillators: &[Oscillator; LANES], control: &Control) -> Result<[f64; LANES]> {
        advance_on::<true>(load, oscillators, control)
    }
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn avx2(load: &Load, oscillators: &[Oscillator; LANES], control: &Control) -> Result<[f64; LANES]> {
        advance_on::<true>(load, oscillators, control)
    }
    match InstructionSet::in_use() {
        // SAFETY: `in_use` returns only what this machine has.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { avx512(load, oscillators, control) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { avx2(load, oscillators, control) },
        _ => advance_on::<false>(load, oscillators, control),
    }
}

#[inline(always)]
fn advance_on<const FUSED: bool>(
    load: &Load,
    oscillators: &[Oscillator; LANES],
    control: &Control,
) -> Result<[f64; LANES]> {
    let small = oscillators.iter().all(|oscillator| oscillator.s <= SMALL_STEP);
    let lanes = Lanes::new(oscillators, small);
    let [of_u, of_other, of_load, of_increment] = &lanes.screen;
    let (mut u, mut v) = ([0.0; LANES], [0.0; LANES]);
    let mut peak = [0.0; LANES];
    let mut blocks = Vec::with_capacity(BLOCKS_PER_SEARCH.min(load.blocks.len()));
    for first in (0..load.blocks.len()).step_by(BLOCKS_PER_SEARCH) {
        if control.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        blocks.clear();
        for index in first..load.blocks.len().min(first + BLOCKS_PER_SEARCH) {
            let start = [u, v];
            let LoadBounds { sample, increment } = load.blocks[index];
            let [most_u, other] = if small {
                lanes.advance::<true, FUSED>(&mut u, &mut v, load.block(index))
            } else {
                let [most_u, square] = lanes.advance::<false, FUSED>(&mut u, &mut v, load.block(index));
                [most_u, square.map(f64::sqrt)]
            };
            let bound = std::array::from_fn(|lane| {
                peak[lane] = larger(most_u[lane], peak[lane]);
                // A block starts where the one before ended, so `peak` holds its first sample too.
                let most_u = larger(start[0][lane].abs(), most_u[lane]);
                of_u[lane] * most_u
                    + of_other[lane] * other[lane]
                    + (of_load[lane] * sample + of_increment[lane] * increment)
            });
            blocks.push(Block { start, bound });
        }
        for (index, block) in blocks.iter().enumerate() {
            // Most blocks beat no lane's peak: asked of all lanes at once.
            if !(0..LANES).fold(false, |any, lane| any | (block.bound[lane] > peak[lane])) {
                continue;
            }
            for (lane, peak) in peak.iter_mut().enumerate() {
                if block.bound[lane] > *peak {
                    let start = block.start.map(|values| values[lane]);
                    *peak = oscillators[lane].peak_inside_steps(start, load.block(first + index), *peak);
                }
            }
        }
    }
    Ok(std::array::from_fn(|lane| {
        let finite = u[lane].is_finite() && v[lane].is_finite();
        if finite { peak[lane].max(oscillators[lane].free_peak(u[lane], v[lane])) } else { f64::NAN }
    }))
}
