//! Response spectra against numbers made in 40 digits, closed forms and invariants.

#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::sync::atomic::Ordering;

use seismass::Control;
use seismass::spectrum::response_spectra;
use seismass::{Error, Motion};

const TOLERANCE: f64 = 1e-12;

/// (period, damping, peak displacement) of `jagged()`: the oscillator solved per step in closed form with mpmath 1.3
/// at 40 digits, every zero of the velocity bracketed on a grid of at least eight points per period and bisected.
const FORTY_DIGITS: [(f64, f64, f64); 40] = [
    (60_000.0, 0.0, 1.6435234668502328e+3),
    (60_000.0, 0.05, 1.5230400830475254e+3),
    (60_000.0, 0.3, 1.1037033511011113e+3),
    (60_000.0, 0.999, 6.0502182897337116e+2),
    (10.0, 0.0, 2.7288856319675492e-1),
    (10.0, 0.05, 2.5288384227177538e-1),
    (10.0, 0.3, 1.8325852228777087e-1),
    (10.0, 0.999, 1.0045986858220171e-1),
    (1.0, 0.0, 1.8014098198461707e-2),
    (1.0, 0.05, 1.6724441992929726e-2),
    (1.0, 0.3, 1.2423928381823429e-2),
    (1.0, 0.999, 7.5771663823133463e-3),
    (0.25, 0.0, 1.8053376455171228e-3),
    (0.25, 0.05, 1.6657658190777999e-3),
    (0.25, 0.3, 1.1904752224589893e-3),
    (0.25, 0.999, 8.6035642997060929e-4),
    (0.0629, 0.0, 3.1605167889312691e-4),
    (0.0629, 0.05, 1.8367718147195579e-4),
    (0.0629, 0.3, 1.3416714736261205e-4),
    (0.0629, 0.999, 9.4205155148721090e-5),
    (0.0628, 0.0, 3.1906382695553998e-4),
    (0.0628, 0.05, 1.8490538898594064e-4),
    (0.0628, 0.3, 1.3373237227591088e-4),
    (0.0628, 0.999, 9.3931968186014342e-5),
    (0.03, 0.0, 6.8201961353350784e-5),
    (0.03, 0.05, 4.9976874542813551e-5),
    (0.03, 0.3, 3.5737034094683309e-5),
    (0.03, 0.999, 2.5048833372798877e-5),
    (0.011, 0.0, 1.0509272476429741e-5),
    (0.011, 0.05, 7.3552393983336060e-6),
    (0.011, 0.3, 5.3257795755006438e-6),
    (0.011, 0.999, 4.2146850235733785e-6),
    (0.001, 0.0, 8.1388362638830105e-8),
    (0.001, 0.05, 7.5441103524122494e-8),
    (0.001, 0.3, 5.5679866850478205e-8),
    (0.001, 0.999, 4.0940071383785723e-8),
    (0.0001, 0.0, 8.2941035551162411e-10),
    (0.0001, 0.05, 7.6903145137716395e-10),
    (0.0001, 0.3, 5.6893740227568846e-10),
    (0.0001, 0.999, 4.1495772193850917e-10),
];

fn jagged() -> Motion {
    let samples: Vec<f64> = (0..40).map(|k| f64::from((k * k * 31 + 57 * k) % 211 - 105) / 64.0).collect();
    Motion::new(samples, 0.01, None).unwrap()
}

fn spectrum(motion: &Motion, period: f64, damping: f64) -> f64 {
    response_spectra(std::slice::from_ref(motion), &[period], &[damping], None, &Control::default()).unwrap()[0]
}

#[test]
fn peaks_agree_with_forty_digits_from_tiny_to_huge_steps() {
    for (period, damping, expected) in FORTY_DIGITS {
        let error = spectrum(&jagged(), period, damping) / expected - 1.0;
        assert!(error.abs() < TOLERANCE, "T {period}, zeta {damping}: relative error {error:e}");
    }
}

/// A step of ground acceleration A: peak (A / w^2) (1 + exp(-pi zeta / sqrt(1 - zeta^2))), half a period later.
#[test]
fn step_load_overshoots_by_its_closed_form() {
    for (dt, length) in [(0.005, 4000), (0.4, 60), (7.0, 3)] {
        let motion = Motion::new(vec![-3.0; length], dt, None).unwrap();
        for period in [0.31, 1.0, 4.7] {
            for damping in [0.0f64, 0.02, 0.05, 0.5, 0.9] {
                let w = TAU / period;
                let overshoot = (-PI * damping / (1.0 - damping * damping).sqrt()).exp();
                let expected = 3.0 / (w * w) * (1.0 + overshoot);
                let error = spectrum(&motion, period, damping) / expected - 1.0;
                assert!(error.abs() < TOLERANCE, "dt {dt}, T {period}, zeta {damping}: relative error {error:e}");
            }
        }
    }
}

/// One sample A, zero a step later: undamped amplitude afterwards (A / w^2) |i + (1 - e^(i x)) / x| with x = w dt.
#[test]
fn free_vibration_after_the_motion_counts() {
    let motion = Motion::new(vec![2.0], 0.01, None).unwrap();
    for period in [0.05, 0.3, 20.0] {
        let w = TAU / period;
        let x = w * 0.01;
        // 1 - sin(x) / x and (1 - cos(x)) / x without cancellation.
        let lag: f64 = (1..12).map(|k| -(-x * x).powi(k) / (2..=2 * k + 1).map(f64::from).product::<f64>()).sum();
        let expected = 2.0 / (w * w) * lag.hypot(2.0 * (0.5 * x).sin().powi(2) / x);
        let error = spectrum(&motion, period, 0.0) / expected - 1.0;
        assert!(error.abs() < TOLERANCE, "T {period}: relative error {error:e}");
    }
}

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
    // From steps of many radians to small ones, so that the two motions are often solved by steps of different kinds.
    for damping in [0.0, 0.03, 0.25, 0.9] {
        for i in 0..200 {
            let period = 0.003 * 1.05f64.powi(i);
            let (a, b) = (spectrum(&coarse, period, damping), spectrum(&fine, period, damping));
            assert!((a / b - 1.0).abs() < TOLERANCE, "T {period}, zeta {damping}: {a} {b}");
        }
    }
}

/// Row-major (motions, damping, periods), the same bits alone, in company and on any number of threads.
#[test]
fn order_company_and_threads_change_no_bit() {
    let motions = [jagged(), Motion::new(vec![1.0, -2.0, 0.5], 0.02, None).unwrap()];
    let periods: Vec<f64> = (1..=21).map(|i| 0.05 * f64::from(i)).collect();
    let damping = [0.0, 0.05, 0.4];
    let solve = |threads| response_spectra(&motions, &periods, &damping, threads, &Control::default()).unwrap();
    let all = solve(None);
    assert_eq!(all.len(), 2 * 3 * 21);
    assert_eq!(all, solve(Some(1)));
    assert_eq!(all, solve(Some(3)));
    let alone = motions.iter().flat_map(|motion| {
        let periods = &periods;
        damping.iter().flat_map(move |&zeta| periods.iter().map(move |&period| spectrum(motion, period, zeta)))
    });
    assert_eq!(all, alone.collect::<Vec<_>>());
}

/// Neither costs a step: the same oscillators go through the same samples.
#[test]
fn a_quiet_head_and_tail_change_no_bit() {
    let solve = |head: usize, tail: usize| {
        let quiet = |length: usize| vec![0.0; length];
        let samples = [quiet(head), jagged().acceleration().to_vec(), quiet(tail)].concat();
        let motion = Motion::new(samples, 0.01, None).unwrap();
        response_spectra(&[motion], &[0.03, 0.25, 1.0, 10.0], &[0.0, 0.05, 0.999], None, &Control::default()).unwrap()
    };
    assert_eq!(solve(1, 0), solve(500, 3000));
    let still = Motion::new(vec![0.0; 3], 0.01, None).unwrap();
    assert_eq!(spectrum(&still, 1.0, 0.05), 0.0);
}

#[test]
fn wrong_input_is_refused_by_name() {
    let refused = |periods: &[f64], damping: &[f64], threads| {
        response_spectra(&[jagged()], periods, damping, threads, &Control::default()).unwrap_err().to_string()
    };
    for (message, expected) in [
        (refused(&[1.0, -1.0], &[0.05], None), "period of oscillator 2 must be a positive number; got -1"),
        (refused(&[f64::NAN], &[0.05], None), "period of oscillator 1 must be a positive number; got NaN"),
        (
            refused(&[1e-6], &[0.05], None),
            "period of oscillator 1 must be from 0.00001 to 10000000 s for the time step of motion 1; got 0.000001",
        ),
        (refused(&[1.0], &[1.0], None), "damping of spectrum 1 must be at least 0 and below 1; got 1"),
        (refused(&[1.0], &[0.05, -0.1], None), "damping of spectrum 2 must be at least 0 and below 1; got -0.1"),
        (refused(&[1.0], &[0.05], Some(0)), "threads of spectrum must be at least 1; got 0"),
    ] {
        assert_eq!(message, expected);
    }
}

#[test]
fn a_set_flag_stops_it_and_an_overflow_is_an_error() {
    let control = Control::default();
    control.stop.store(true, Ordering::Relaxed);
    let stopped = response_spectra(&[jagged()], &[1.0], &[0.05], None, &control);
    assert_eq!(stopped, Err(Error::Interrupted));
    let huge = Motion::new(vec![1e308; 100], 1.0, None).unwrap();
    let overflow = response_spectra(&[huge], &[1e3], &[0.05], None, &Control::default());
    assert!(matches!(overflow, Err(Error::NotFinite { .. })), "{overflow:?}");
}

/// A motion times a power of two has the same peaks times that, to the bit, up to the ends of the range of numbers.
#[test]
fn peaks_are_proportional_to_the_motion_however_small_or_large() {
    for exponent in [-900, -500, -3, 0, 1, 400, 900] {
        let factor = 2f64.powi(exponent);
        let scaled = jagged().scaled(factor).unwrap();
        for period in [0.005, 0.03, 0.25, 10.0] {
            assert_eq!(
                spectrum(&scaled, period, 0.05),
                factor * spectrum(&jagged(), period, 0.05),
                "{exponent} {period}"
            );
        }
    }
}

#[test]
fn what_does_not_fit_into_memory_is_refused() {
    let (periods, damping) = (vec![1.0; 1 << 22], vec![0.05; 1 << 22]);
    let error = response_spectra(&[jagged()], &periods, &damping, None, &Control::default()).unwrap_err();
    assert!(error.to_string().starts_with("periods of spectrum must be of so few"), "{error}");
}
