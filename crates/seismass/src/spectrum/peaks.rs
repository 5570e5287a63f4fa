//! What a spectrum of displacements leaves out: the sign and the time of the peak, and the peak absolute acceleration.
//!
//! # Method
//! One oscillator at a time, the exact step of `oscillator.rs`. With p = 2 zeta s u' + s^2 u, minus the absolute
//! acceleration in units of the load, the equation of motion gives p'' + 2 zeta s p' + s^2 p = -(s^2 b + 2 zeta s b'): within
//! a step p is the displacement of the same oscillator under another linear load, so its extremes are found in the same
//! way. p and p' are continuous at samples.

use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::scene::Motion;
use crate::spectrum::load::{Load, validate};
use crate::spectrum::oscillator::{Oscillator, Step};
use crate::threads::{Control, in_pool};

/// OscillatorSteps between two looks whether the caller wants to stop.
const STEPS_PER_LOOK: usize = 4096;

/// Largest values of one oscillator in continuous time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OscillatorPeak {
    /// Relative displacement u (m), with its sign, where |u| is largest.
    pub displacement: f64,
    /// Time of it (s), that of the first sample being zero.
    pub time: f64,
    /// Largest absolute acceleration |u'' + a| (m/s2), a being that of the ground.
    pub acceleration: f64,
}

/// Peaks of oscillators at rest at the first sample, the free vibration after the motion included; row-major (motions,
/// damping, periods). Arguments and errors are those of [`super::response_spectra`].
///
/// # Errors
/// [`Error::Invalid`] when a period, a ratio or the number of threads is out of its range, [`Error::NotFinite`] when a
/// peak is, [`Error::Interrupted`] when stopped.
pub fn oscillator_peaks(
    motions: &[Motion],
    periods: &[f64],
    damping: &[f64],
    threads: Option<usize>,
    control: &Control,
) -> Result<Vec<OscillatorPeak>> {
    let count = validate(motions, periods, damping, 3)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    let solve = || {
        let loads: Vec<Load> = motions.par_iter().map(Load::new).collect();
        let of_all = (0..count).into_par_iter().map(|index| {
            let (rest, period) = (index / periods.len(), periods[index % periods.len()]);
            let (motion, zeta) = (rest / damping.len(), damping[rest % damping.len()]);
            let dt = motions[motion].dt();
            let peak = one(&loads[motion], &Oscillator::new(period, zeta, dt), dt, control)?;
            if peak.displacement.is_finite() && peak.acceleration.is_finite() {
                return Ok(peak);
            }
            Err(Error::NotFinite {
                time: dt * motions[motion].acceleration().len() as f64,
                element: format!("the oscillator of period {period} s"),
            })
        });
        of_all.collect()
    };
    in_pool(threads, "spectrum", solve)?
}

fn one(load: &Load, oscillator: &Oscillator, dt: f64, control: &Control) -> Result<OscillatorPeak> {
    let mut displacement = Extreme::default();
    let mut absolute = Extreme::default();
    let samples = &load.samples[..load.samples.len() - 1];
    let mut state = [0.0; 2];
    for (index, pair) in samples.windows(2).enumerate() {
        if index % STEPS_PER_LOOK == 0 && control.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let step = oscillator.step(state, [pair[0], pair[1]]);
        displacement.look_into(oscillator, &step, index);
        absolute.look_into(oscillator, &absolute_step(oscillator, &step), index);
        state = step.end();
    }
    // Nothing moves the ground any more.
    let steps = samples.len() - 1;
    displacement.look_beyond(oscillator, state, steps);
    absolute.look_beyond(oscillator, absolute_state(oscillator, state, 0.0), steps);
    // A state that is no number compares with nothing, and is told from here.
    let scale = if state.iter().all(|value| value.is_finite()) { load.unit } else { f64::NAN };
    Ok(OscillatorPeak {
        displacement: scale * displacement.value,
        time: dt * (load.first as f64 + displacement.steps),
        acceleration: scale * absolute.value.abs() / (dt * dt),
    })
}

/// p and p' of a state under the load b.
fn absolute_state(oscillator: &Oscillator, [u, v]: [f64; 2], b: f64) -> [f64; 2] {
    let (viscous, square) = (2.0 * oscillator.zeta * oscillator.s, oscillator.s * oscillator.s);
    let p = viscous * v + square * u;
    [p, square * v - viscous * (b + p)]
}

/// The step of p that goes with one of u.
fn absolute_step(oscillator: &Oscillator, step: &Step) -> Step {
    let (viscous, square) = (2.0 * oscillator.zeta * oscillator.s, oscillator.s * oscillator.s);
    let [b0, b1] = step.b;
    let [p0, rate0] = absolute_state(oscillator, [step.u[0], step.v[0]], b0);
    let [p1, rate1] = absolute_state(oscillator, [step.u[1], step.v[1]], b1);
    let b = [b0, b1].map(|b| square * b + viscous * (b1 - b0));
    Step { u: [p0, p1], v: [rate0, rate1], b }
}

/// The largest value so far, with its sign, and the steps until it.
#[derive(Debug, Clone, Copy, Default)]
struct Extreme {
    value: f64,
    steps: f64,
}

impl Extreme {
    fn take(&mut self, value: f64, steps: f64) {
        if value.abs() > self.value.abs() {
            *self = Self { value, steps };
        }
    }

    /// Takes what is larger at a zero of u' inside a step or at its end.
    fn look_into(&mut self, oscillator: &Oscillator, step: &Step, index: usize) {
        if oscillator.bound(step) > self.value.abs() {
            let [time, value] = oscillator.interior_extreme(step);
            self.take(value, index as f64 + time);
            self.take(step.u[1], (index + 1) as f64);
        }
    }

    fn look_beyond(&mut self, oscillator: &Oscillator, [u, v]: [f64; 2], steps: usize) {
        let [after, value] = oscillator.free_extreme(u, v);
        self.take(value, steps as f64 + after);
    }
}
