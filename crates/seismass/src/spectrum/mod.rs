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

mod load;
mod oscillator;
mod peaks;
mod spectra;
mod steps;

pub use load::PERIOD_RANGE;
pub use peaks::{OscillatorPeak, oscillator_peaks};
pub use spectra::response_spectra;
