//! Response spectra of motions.

use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::scene::Motion;
use crate::spectrum::load::{Load, validate};
use crate::spectrum::oscillator;
use crate::spectrum::oscillator::Oscillator;
use crate::spectrum::steps::{Block, LANES, LargeSteps, OscillatorSteps, SmallSteps, Values, advance, gather, larger};
use crate::threads::{Control, in_pool};

/// Blocks between two searches for peaks inside steps; what is kept of them fits the second-level cache.
pub(super) const BLOCKS_PER_SEARCH: usize = 256;

/// Peak relative displacement (m) of oscillators at rest at the first sample, in continuous time, the free vibration
/// after the motion included; row-major (motions, damping, periods).
///
/// `periods` in s, `damping` as ratios of critical. Any number of `threads` gives the same bits (default: all cores).
///
/// ```
/// use seismass::spectrum::response_spectra;
/// use seismass::{Control, Motion};
///
/// # fn main() -> seismass::Result<()> {
/// let step = Motion::new(vec![1.0; 400], 0.01, None)?;
/// let peaks = response_spectra(&[step], &[0.5, 1.0], &[0.0], None, &Control::default())?;
/// // An undamped oscillator under a step a goes to 2 a / w^2.
/// for (peak, period) in peaks.iter().zip([0.5, 1.0]) {
///     let frequency: f64 = std::f64::consts::TAU / period;
///     assert!((peak * frequency.powi(2) - 2.0).abs() < 1e-12);
/// }
/// # Ok(())
/// # }
/// ```
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
pub(super) fn solve_one(
    motion: &Motion,
    periods: &[f64],
    damping: &[f64],
    control: &Control,
    peaks: &mut [f64],
) -> Result<()> {
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

/// [`peaks_of`] steps of one size.
pub(super) type PeaksOf = fn(&Load, &[Oscillator; LANES], &Control) -> Result<Values>;

/// Peak displacement of each oscillator.
pub(super) fn peaks_of<S: OscillatorSteps>(
    load: &Load,
    oscillators: &[Oscillator; LANES],
    control: &Control,
) -> Result<Values> {
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
