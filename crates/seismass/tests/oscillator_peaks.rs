//! Sign and time of peak displacements, and peak absolute accelerations: closed forms and invariants.

#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::sync::atomic::Ordering;

use seismass::Control;
use seismass::spectrum::{OscillatorPeak, oscillator_peaks, response_spectra};
use seismass::{Error, Motion};

const TOLERANCE: f64 = 1e-12;

fn jagged() -> Motion {
    let samples: Vec<f64> = (0..40).map(|k| f64::from((k * k * 31 + 57 * k) % 211 - 105) / 64.0).collect();
    Motion::new(samples, 0.01, None).unwrap()
}

fn peak(motion: &Motion, period: f64, damping: f64) -> OscillatorPeak {
    oscillator_peaks(std::slice::from_ref(motion), &[period], &[damping], None, &Control::default()).unwrap()[0]
}

fn near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found:e} in place of {expected:e}");
}

/// A step of ground acceleration -A. The displacement peaks after half a damped period. The absolute acceleration is
/// A (1 - e^(-zeta w t) (cos - (zeta / q) sin)(q w t)), largest where q w t = pi - 2 phi with sin phi = zeta:
/// A (1 + e^(-zeta (pi - 2 phi) / q)).
#[test]
fn step_load_peaks_by_its_closed_form() {
    for (dt, length) in [(0.005, 4000), (0.4, 60), (7.0, 3)] {
        for sign in [-1.0, 1.0] {
            let motion = Motion::new(vec![sign * 3.0; length], dt, None).unwrap();
            for period in [0.31, 1.0, 4.7] {
                for damping in [0.0f64, 0.02, 0.05, 0.5, 0.9] {
                    let what = format!("dt {dt}, T {period}, zeta {damping}, sign {sign}");
                    let (w, q) = (TAU / period, (1.0 - damping * damping).sqrt());
                    let found = peak(&motion, period, damping);
                    let overshoot = (-PI * damping / q).exp();
                    near(found.displacement, -sign * 3.0 / (w * w) * (1.0 + overshoot), TOLERANCE, &what);
                    // Undamped vibration has the same peak once a period.
                    let since = if damping == 0.0 { found.time % period } else { found.time };
                    near(since, PI / (w * q), 1e-7, &what);
                    let angle = PI - 2.0 * damping.asin();
                    near(found.acceleration, 3.0 * (1.0 + (-damping * angle / q).exp()), TOLERANCE, &what);
                }
            }
        }
    }
}

/// Without damping the absolute acceleration is w^2 u, so its peak is the pseudo-acceleration.
#[test]
fn displacements_are_those_of_spectra_and_undamped_accelerations_are_pseudo_accelerations() {
    let periods: Vec<f64> = (0..200).map(|i| 0.003 * 1.05f64.powi(i)).collect();
    let damping = [0.0, 0.03, 0.25, 0.9, 0.999];
    let motions = [jagged()];
    let found = oscillator_peaks(&motions, &periods, &damping, None, &Control::default()).unwrap();
    let expected = response_spectra(&motions, &periods, &damping, None, &Control::default()).unwrap();
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        let what = format!("oscillator {index}");
        near(found.displacement.abs(), expected, TOLERANCE, &what);
        if index < periods.len() {
            let w = TAU / periods[index];
            near(found.acceleration, w * w * expected, TOLERANCE, &what);
        }
    }
}

/// Splitting intervals moves the samples, not the motion: extremes that one finds inside steps the other has elsewhere.
#[test]
fn splitting_every_interval_in_four_changes_nothing() {
    let coarse = jagged();
    let mut samples: Vec<f64> = Vec::new();
    for pair in coarse.acceleration().windows(2) {
        samples.extend((0..4).map(|k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / 4.0));
    }
    let last = coarse.acceleration()[39];
    samples.extend([1.0, 0.75, 0.5, 0.25].map(|part| part * last));
    let fine = Motion::new(samples, 0.0025, None).unwrap();
    for damping in [0.0, 0.03, 0.25, 0.9] {
        for i in 0..200 {
            let period = 0.003 * 1.05f64.powi(i);
            let what = format!("T {period}, zeta {damping}");
            let (a, b) = (peak(&coarse, period, damping), peak(&fine, period, damping));
            near(a.displacement, b.displacement, TOLERANCE, &what);
            near(a.acceleration, b.acceleration, TOLERANCE, &what);
            // The time of a flat maximum is known to the square root of rounding.
            assert!((a.time - b.time).abs() <= 1e-6 * period.max(b.time), "{what}: {} {}", a.time, b.time);
        }
    }
}

/// A stiff oscillator moves with the ground, whose acceleration it has, where that does not begin with a jump.
#[test]
fn stiff_oscillators_have_the_acceleration_of_the_ground() {
    let motion = Motion::new([&[0.0], jagged().acceleration()].concat(), 0.01, None).unwrap();
    let pga = motion.acceleration().iter().fold(0.0f64, |most, a| a.abs().max(most));
    near(peak(&motion, 1e-4, 0.9).acceleration, pga, 1e-3, "T 1e-4");
}

/// A quiet head moves times, and nothing else.
#[test]
fn a_quiet_head_moves_times_by_its_length() {
    let mut samples = vec![0.0; 100];
    samples.extend(jagged().acceleration());
    let late = Motion::new(samples, 0.01, None).unwrap();
    let early = Motion::new([&[0.0], jagged().acceleration()].concat(), 0.01, None).unwrap();
    for period in [0.03, 0.25, 10.0] {
        let (late, early) = (peak(&late, period, 0.05), peak(&early, period, 0.05));
        assert_eq!(late.displacement, early.displacement);
        assert_eq!(late.acceleration, early.acceleration);
        near(late.time - early.time, 0.99, 1e-12, "shift");
    }
}

#[test]
fn order_and_threads_change_no_bit() {
    let motions = [jagged(), jagged().scaled(-2.0).unwrap()];
    let (periods, damping) = ([0.03, 0.25, 1.0], [0.02, 0.05]);
    let all = oscillator_peaks(&motions, &periods, &damping, Some(1), &Control::default()).unwrap();
    assert_eq!(all, oscillator_peaks(&motions, &periods, &damping, Some(3), &Control::default()).unwrap());
    assert_eq!(all[4], peak(&motions[0], 0.25, 0.05));
    assert_eq!(all[6 + 2].displacement, -2.0 * all[2].displacement);
}

#[test]
fn wrong_input_a_set_flag_and_an_overflow_are_errors() {
    let control = Control::default();
    let error = oscillator_peaks(&[jagged()], &[-1.0], &[0.05], None, &control).unwrap_err();
    assert!(error.to_string().starts_with("period of oscillator 1 must be a positive number"), "{error}");
    let huge = Motion::new(vec![1e308; 100], 1.0, None).unwrap();
    let overflow = oscillator_peaks(&[huge], &[1e3], &[0.05], None, &control);
    assert!(matches!(overflow, Err(Error::NotFinite { .. })), "{overflow:?}");
    control.stop.store(true, Ordering::Relaxed);
    assert_eq!(oscillator_peaks(&[jagged()], &[1.0], &[0.05], None, &control), Err(Error::Interrupted));
}
