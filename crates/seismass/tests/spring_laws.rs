//! Loops of each spring law against values computed by hand, slowly driven and in motion.

#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, EventKind, Motion, Options, PeakOriented, Response, Scene, SpringLaw, SpringPath, Status,
    Storey, Wear, simulate, spring_path,
};

fn close(value: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (value - expected).abs() / expected.abs().max(1e-300);
    assert!(error <= tolerance, "{what}: {value} for {expected}, relative error {error:e}");
}

/// k = 100, V_y = 10 (d_y = 0.1), Omega = 2, r2 = 0.1 (cap at 1.1, 20), r3 as given.
fn storey(third_slope: f64, law: SpringLaw) -> Storey {
    Storey { overstrength: 2.0, second_slope: 0.1, third_slope, law, ..Storey::yielding(100.0, 10.0) }
}

fn forces(storey: &Storey, drifts: &[f64], expected: &[f64]) -> SpringPath {
    let path = spring_path(storey, drifts).unwrap();
    for (i, (force, expected)) in path.force.iter().zip(expected).enumerate() {
        assert!((force - expected).abs() < 1e-11, "{i}: {force} for {expected} at {}", drifts[i]);
    }
    assert_eq!(path.force.len(), expected.len());
    check_work(drifts, &path);
    path
}

/// The work of the force along the path is what is stored and dissipated; dissipation never falls.
fn check_work(drifts: &[f64], path: &SpringPath) {
    let mut ordered = vec![(0.0, 0.0)];
    for leg in 0..drifts.len() {
        ordered.extend(path.events.iter().filter(|e| e.leg == leg).map(|e| (e.drift, e.force)));
        ordered.push((drifts[leg], path.force[leg]));
    }
    let work: f64 = ordered.windows(2).map(|p| 0.5 * (p[0].1 + p[1].1) * (p[1].0 - p[0].0)).sum();
    let (stored, dissipated) = (path.stored.last().unwrap(), path.dissipated.last().unwrap());
    assert!((work - stored - dissipated).abs() < 1e-10, "{work} is not {stored} + {dissipated}");
    assert!(path.dissipated.windows(2).all(|pair| pair[1] >= pair[0] - 1e-12));
}

fn kinds(path: &SpringPath) -> Vec<(EventKind, i8, u8)> {
    path.events.iter().map(|e| (e.kind, e.sign, e.element)).collect()
}

/// Backbone of slopes k, r2 k, r3 k with breaks at V_y and Omega V_y, and Masing: the branch back is the backbone doubled.
#[test]
fn trilinear() {
    let storey = storey(0.02, SpringLaw::Trilinear);
    forces(&storey, &[0.1, 0.6, 1.1, 2.1], &[10.0, 15.0, 20.0, 22.0]);
    // Down from (2.1, 22): 20 N by k, 20 N by r2 k, then r3 k.
    forces(&storey, &[2.1, 1.9, -0.1, -1.1, 2.1], &[22.0, 2.0, -18.0, -20.0, 22.0]);
}

/// Four segments of slopes 100, 50, 20, 5; the last goes on. Down from (0.6, 24.0): twice each segment.
#[test]
fn multilinear() {
    let points = vec![[0.1, 10.0], [0.2, 15.0], [0.4, 19.0], [0.5, 19.5]];
    let storey = Storey::multilinear(points);
    let path = forces(&storey, &[0.05, 0.15, 0.3, 0.6], &[5.0, 12.5, 17.0, 20.0]);
    let yields = [1, 2, 3].map(|n| (EventKind::Yield, 1, n));
    assert_eq!(kinds(&path), yields);
    let drifts = [0.6, 0.4, 0.2, -0.2, -0.4, -0.6, 0.6];
    let path = forces(&storey, &drifts, &[20.0, 0.0, -10.0, -18.0, -19.0, -20.0, 20.0]);
    assert_eq!(path.events[3].kind, EventKind::Unload);
    // A closed loop between +-0.6: four times the area between the backbone and its chord, doubled.
    let backbone = 0.5 * 0.1 * 10.0 + 0.1 * 12.5 + 0.2 * 17.0 + 0.2 * 19.5;
    let chord = 0.5 * 0.6 * 20.0;
    let cycle = path.dissipated[6] - path.dissipated[0];
    assert!((cycle - 8.0 * (backbone - chord)).abs() < 1e-10, "{cycle}");
}

/// The trilinear spring with stops of 50 N/m from 0.3 m on.
#[test]
fn gap() {
    let storey = storey(0.02, SpringLaw::Gap { clearance: 0.3, stop_stiffness: 50.0 });
    // 10 + 10 * 0.2 = 12 at the stop; 10 + 4 + 50 * 0.2 at 0.5; back to 0.3 by 150, then by 100; the stop opens at 0.3.
    let path = forces(&storey, &[0.3, 0.5, 0.4, 0.3, 0.2, -0.3, -0.4], &[12.0, 24.0, 9.0, -6.0, -7.0, -12.0, -18.0]);
    let of_stops = kinds(&path).into_iter().filter(|&(kind, ..)| matches!(kind, EventKind::Close | EventKind::Open));
    let expected = [(EventKind::Close, 1, 0), (EventKind::Open, 1, 0), (EventKind::Close, -1, 0)];
    assert_eq!(of_stops.collect::<Vec<_>>(), expected);
}

/// Clough: unloading with k down to zero force, then straight to the largest drift of the other side.
#[test]
fn peak_oriented_without_loss() {
    let storey = storey(0.0, SpringLaw::PeakOriented(PeakOriented::default()));
    // Up to (0.6, 15), down by k to (0.45, 0), then to the yield point (-0.1, -10), on with r2 k to (-0.6, -15).
    let drifts = [0.6, 0.5, 0.45, 0.175, -0.1, -0.6, -0.45, 0.075, 0.6, 0.7];
    let expected = [15.0, 5.0, 0.0, -5.0, -10.0, -15.0, 0.0, 7.5, 15.0, 16.0];
    let path = forces(&storey, &drifts, &expected);
    use EventKind::{Reload, Unload, Yield};
    let log = [
        (Yield, 1, 1),
        (Unload, 1, 0),
        (Reload, -1, 0),
        (Yield, -1, 1),
        (Unload, -1, 0),
        (Reload, 1, 0),
        (Yield, 1, 1),
    ];
    assert_eq!(kinds(&path), log);
    // Before zero force, loading goes back to where unloading began; on a reloading line too.
    forces(&storey, &[0.6, 0.5, 0.6, 0.7], &[15.0, 5.0, 15.0, 16.0]);
    // The line from (0.45, 0) to (-0.1, -10): at 0.175 up by k, back at 0.175, on to -0.1.
    let path = forces(&storey, &[0.6, 0.175, 0.2, 0.175, -0.1], &[15.0, -5.0, -2.5, -5.0, -10.0]);
    assert_eq!(kinds(&path)[3..5], [(Unload, -1, 0), (Reload, -1, 0)]);
}

/// Takeda: k_u = 100 (0.1 / 0.9)^0.5 = 33.333... from (0.9, 18).
#[test]
fn unloading_stiffness_falls_with_the_largest_drift() {
    let law = PeakOriented { unloading_exponent: 0.5, ..PeakOriented::default() };
    let storey = storey(0.0, SpringLaw::PeakOriented(law));
    forces(&storey, &[0.9, 0.63, 0.36, -0.1], &[18.0, 9.0, 0.0, -10.0]);
    // From a little beyond the yield drift on: the force 10 + 10 (d - 0.1) is gone at d - F/k_u, if that is positive.
    for exponent in [0.2, 0.37, 0.5, 0.8] {
        for step in 1..60 {
            let drift = 0.1 * 1.04_f64.powi(step);
            let law = PeakOriented { unloading_exponent: exponent, ..PeakOriented::default() };
            let force = 9.0 + 10.0 * drift;
            let stiffness = (100.0 * (0.1 / drift).powf(exponent)).max(force / drift);
            let half = drift - 0.5 * force / stiffness;
            let drifts = [drift, half, drift - force / stiffness, -0.1];
            forces(
                &Storey { law: SpringLaw::PeakOriented(law), ..storey.clone() },
                &drifts,
                &[force, 0.5 * force, 0.0, -10.0],
            );
        }
    }
}

/// Unloading is not softer than the line from the origin: from (0.4, 37) with 92.5 N/m, where Takeda's is 50, to the origin,
/// and from there to the yield point of the other side.
#[test]
fn unloading_ends_before_the_origin() {
    let law = PeakOriented { unloading_exponent: 0.5, ..PeakOriented::default() };
    let law = SpringLaw::PeakOriented(law);
    let storey =
        Storey { overstrength: 100.0, second_slope: 0.9, third_slope: 0.0, law, ..Storey::yielding(100.0, 10.0) };
    forces(&storey, &[0.4, 0.2, 0.0, -0.05, -0.35], &[37.0, 18.5, 0.0, -5.0, -32.5]);
}

/// Softening: to (1.1, 20), by -20 N/m to the residual 5 N at 1.85, then flat; reloading aims at the softened peak.
#[test]
fn softening_to_residual_strength() {
    let law = PeakOriented { residual_strength: 0.5, ..PeakOriented::default() };
    let storey = storey(-0.2, SpringLaw::PeakOriented(law));
    let path = forces(&storey, &[1.1, 1.35, 1.85, 3.0], &[20.0, 15.0, 5.0, 5.0]);
    assert_eq!(kinds(&path), [1, 2, 3].map(|n| (EventKind::Yield, 1, n)));
    // From (1.35, 15) to zero at 1.2, to the other side's yield point at (-0.1, -10), back from there by k to zero at 0,
    // to (1.35, 15) with slope 15 / 1.35, and on down the softening branch.
    forces(&storey, &[1.35, 1.2, 0.55, -0.1, 0.0, 0.675, 1.35, 1.6], &[15.0, 0.0, -5.0, -10.0, 0.0, 7.5, 15.0, 10.0]);
}

/// lambda = 20: capacity 20 * 10 * 0.1 = 20 J. The first half cycle up to (0.6, 15) dissipates 12.5 * 0.5 + 0.5 - 15^2/200
/// = 5.625 J, so beta = 5.625 / (20 - 5.625); the force of the yield point of the other side falls by it.
#[test]
fn cyclic_loss_lowers_the_next_target() {
    let law = PeakOriented { energy_capacity: 20.0, residual_strength: 0.1, ..PeakOriented::default() };
    let storey = storey(0.0, SpringLaw::PeakOriented(law));
    let target = 10.0 * (1.0 - 5.625 / 14.375);
    let path = forces(&storey, &[0.6, 0.45, 0.175, -0.1], &[15.0, 0.0, -0.5 * target, -target]);
    close(path.dissipated[1], 5.625, 1e-13, "first half cycle");
    // Many cycles: strength comes down to the residual and no further.
    let drifts: Vec<f64> = (0..40).map(|i| if i % 2 == 0 { 0.6 } else { -0.6 }).collect();
    let path = spring_path(&storey, &drifts).unwrap();
    check_work(&drifts, &path);
    close(path.force[38], 1.0, 1e-12, "residual strength");
}

/// Without any strength left on its side a turn is followed by a reload at once: towards the yield point (-0.1, -10) of the
/// other side, 10 * 0.1 / 3.1 N on the way to 2.9, and back on the line of no force.
#[test]
fn a_side_without_strength_has_no_force() {
    let storey = storey(-0.2, SpringLaw::PeakOriented(PeakOriented::default()));
    let path = forces(&storey, &[1.1, 2.1, 3.0, 2.9, 3.0, 3.5], &[20.0, 0.0, 0.0, -1.0 / 3.1, 0.0, 0.0]);
    assert_eq!(kinds(&path)[3..5], [(EventKind::Unload, 1, 0), (EventKind::Reload, -1, 0)]);
}

/// Slopes 100 and 10 N/m; with beta = 0.8 unloading falls by 8 N to the line through (0.02, 2).
#[test]
fn flag_shaped() {
    let flag = |flag_height: f64| storey(0.02, SpringLaw::FlagShaped { flag_height });
    let drifts = [0.6, 0.52, 0.32, 0.4, 0.5, 0.45, 0.55, 0.0, -0.6, -0.52, -0.02, 0.0];
    let expected = [15.0, 7.0, 5.0, 13.0, 14.0, 9.0, 14.5, 0.0, -15.0, -7.0, -2.0, 0.0];
    let path = forces(&flag(0.8), &drifts, &expected);
    use EventKind::{Reload, Unload, Yield};
    let log = [
        (Yield, 1, 1),
        (Unload, 1, 0),
        (Yield, 1, 2),
        (Reload, 1, 0),
        (Yield, 1, 1),
        (Unload, 1, 0),
        (Yield, 1, 1),
        (Unload, 1, 0),
        (Yield, 1, 2),
        (Unload, 1, 0),
        (Yield, -1, 1),
        (Unload, -1, 0),
        (Yield, -1, 2),
        (Unload, -1, 0),
    ];
    assert_eq!(kinds(&path), log);
    // 7.2 N between the lines at one drift, over all ways along an upper line.
    close(path.dissipated[11], 7.2 * (0.5 + 0.1 + 0.05 + 0.5), 1e-13, "dissipated");
    // Up and down one line; and down to the origin.
    forces(&flag(0.0), &[0.6, 0.3, 0.6, 0.1, -0.6, -0.3, 0.0], &[15.0, 12.0, 15.0, 10.0, -15.0, -12.0, 0.0]);
    forces(&flag(1.0), &[0.6, 0.5, 0.25, 0.0, -0.1], &[15.0, 5.0, 2.5, 0.0, -10.0]);
}

fn oscillator(storey: Storey, mass: f64) -> Building {
    Building::new(vec![mass], vec![storey], Damping::Modal { ratio: 0.0 }).unwrap()
}

fn run(scene: &Scene, samples: usize, dt: f64) -> Response {
    let motion = Motion::new(vec![0.0; samples], dt, None).unwrap();
    let options = Options { energy: true, events: true, ..Options::default() };
    simulate(scene, &motion, &options).unwrap()
}

/// Free vibration through a gap: each half period is pi / w1-ish parts of two frequencies. From v0 at zero drift with k, the
/// stop is reached after asin(c w / v0) / w at the velocity v1 = sqrt(v0^2 - (c w)^2), and left after a half turn of the
/// stiffer vibration: 2 atan(v1 w2 m / (k c)) / w2.
#[test]
fn period_of_an_oscillator_with_a_gap() {
    let (k, stop, mass, clearance, v0) = (100.0_f64, 700.0, 1.0, 0.02, 0.5_f64);
    let law = SpringLaw::Gap { clearance, stop_stiffness: stop };
    let building = oscillator(Storey { law, ..Storey::elastic(k) }, mass);
    let scene = Scene::new(Some(Arc::new(building)), Vec::new()).unwrap();
    let scene = scene.with_initial(vec![0.0], vec![v0]).unwrap();
    let response = run(&scene, 400, 0.01);
    let (w1, w2) = ((k / mass).sqrt(), ((k + stop) / mass).sqrt());
    let v1 = (v0 * v0 - (clearance * w1).powi(2)).sqrt();
    let quarter = (clearance * w1 / v0).asin() / w1 + (v1 * w2 * mass / (k * clearance)).atan() / w2;
    let events = response.events.unwrap();
    let closes: Vec<f64> =
        events.iter().filter(|e| e.kind == EventKind::Close && e.sign == 1).map(|e| e.time).collect();
    assert!(closes.len() > 5);
    for (i, time) in closes.iter().enumerate() {
        let expected = (clearance * w1 / v0).asin() / w1 + 4.0 * quarter * i as f64;
        close(*time, expected, 2e-13, "stop touched");
    }
    // Energy: (k c^2 + ...) at the largest drift c + y: k (c + y)^2 + stop y^2 = m v0^2.
    let (a, b, c) = (k + stop, 2.0 * k * clearance, k * clearance * clearance - mass * v0 * v0);
    let y = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    close(response.peaks.drift[0].value, clearance + y, 1e-13, "largest drift");
    assert!(response.energy.unwrap().relative_residual.abs() < 1e-12);
}

/// Free vibration of an oscillator with a flat flag, from v0 at zero drift. Of the energy m v0^2 / 2 that above V_y d_y / 2
/// takes the storey beyond yield, and 1 - beta of it comes back in each half cycle. The force is k d, V_y, k d and
/// (1 - beta) V_y in turn.
#[test]
fn free_vibration_of_a_flag() {
    let (k, vy, mass, beta, v0) = (100.0_f64, 10.0, 4.0, 0.3, 3.0_f64);
    let law = SpringLaw::FlagShaped { flag_height: beta };
    let building = oscillator(Storey { law, second_slope: 0.0, third_slope: 0.0, ..Storey::yielding(k, vy) }, mass);
    let scene = Scene::new(Some(Arc::new(building)), Vec::new()).unwrap();
    let scene = scene.with_initial(vec![0.0], vec![v0]).unwrap();
    // It ends on the way to the sixth yield.
    let response = run(&scene, 970, 0.01);
    let (w, dy, low) = ((k / mass).sqrt(), vy / k, (1.0 - beta) * vy);
    let mut excess = 0.5 * mass * v0 * v0 - 0.5 * vy * dy;
    close(response.peaks.drift[0].value, dy + excess / vy, 1e-13, "largest drift");
    // Speeds on the way of a half cycle: at zero drift, at yield, when the lower line is met, when it is left.
    let mut start = 0.0;
    let mut expected = Vec::new();
    for sign in [1, -1, 1, -1, 1] {
        let speed = |energy: f64| (2.0 * energy / mass).sqrt();
        let (at_yield, at_lower) = (speed(excess), w * dy * (1.0 - (1.0 - beta).powi(2)).sqrt());
        let at_zero = speed(excess + 0.5 * vy * dy);
        let at_corner = speed(0.5 * mass * at_lower * at_lower + (1.0 - beta) * excess);
        let yields = start + (w * dy / at_zero).asin() / w;
        let turns = yields + at_yield * mass / vy;
        let meets = turns + (1.0 - beta).acos() / w;
        let leaves = meets + (at_corner - at_lower) * mass / low;
        excess *= 1.0 - beta;
        start = leaves + (w * (1.0 - beta) * dy / speed(excess + 0.5 * vy * dy)).asin() / w;
        let kinds = [(EventKind::Yield, 1), (EventKind::Unload, 0), (EventKind::Yield, 2), (EventKind::Unload, 0)];
        expected.extend(
            kinds.map(|(kind, element)| (kind, 1, sign, element)).into_iter().zip([yields, turns, meets, leaves]),
        );
    }
    let events = response.events.as_ref().unwrap();
    for ((found, event), (expected, time)) in counts(&response).into_iter().zip(events).zip(&expected) {
        assert_eq!(found, *expected);
        close(event.time, *time, 1e-12, "event");
    }
    let half_cycles =
        i32::try_from(events.iter().filter(|e| (e.kind, e.element) == (EventKind::Yield, 2)).count()).unwrap();
    assert_eq!(half_cycles, 5);
    let first = 0.5 * mass * v0 * v0 - 0.5 * vy * dy;
    let energy = response.energy.unwrap();
    close(energy.hysteretic, first * (1.0 - (1.0 - beta).powi(half_cycles)), 1e-12, "dissipated");
    assert!(energy.relative_residual.abs() < 1e-12);
}

/// A storey pushed by its velocity into softening collapses when its energy exceeds the area under the backbone.
#[test]
fn softening_to_collapse() {
    let storey = storey(-0.2, SpringLaw::PeakOriented(PeakOriented::default()));
    // Area under the backbone: 0.5 + 15 + 10 = 25.5 J.
    let area: f64 = 0.5 * 0.1 * 10.0 + 15.0 * 1.0 + 0.5 * 1.0 * 20.0;
    for (factor, collapses) in [(0.999, false), (1.001, true)] {
        let building = oscillator(storey.clone(), 2.0);
        let scene = Scene::new(Some(Arc::new(building)), Vec::new()).unwrap();
        let scene = scene.with_initial(vec![0.0], vec![(factor * area).sqrt()]).unwrap();
        let response = run(&scene, 3000, 0.01);
        let energy = response.energy.unwrap();
        assert!(energy.relative_residual.abs() < 1e-12, "{energy:?}");
        match response.status {
            Status::Collapsed { storey: 1, .. } => {
                assert!(collapses);
                close(response.peaks.drift[0].value, 2.1, 1e-12, "collapse drift");
                // What is left is kinetic.
                close(energy.kinetic, (factor - 1.0) * area, 1e-9, "kinetic energy at collapse");
            }
            _ => assert!(!collapses),
        }
    }
}

/// In motion a peak-oriented spring follows the path that it follows when driven through the same drifts.
#[test]
fn forces_in_motion_are_those_of_the_path() {
    let law = PeakOriented { unloading_exponent: 0.4, energy_capacity: 60.0, residual_strength: 0.2 };
    let laws = [
        SpringLaw::PeakOriented(law),
        SpringLaw::Gap { clearance: 0.25, stop_stiffness: 80.0 },
        SpringLaw::FlagShaped { flag_height: 0.7 },
        SpringLaw::Trilinear,
    ];
    for law in laws {
        let softening = if matches!(law, SpringLaw::PeakOriented(_)) { -0.05 } else { 0.02 };
        let storey = storey(softening, law);
        let scene = Scene::new(Some(Arc::new(oscillator(storey.clone(), 1.0))), Vec::new()).unwrap();
        let samples: Vec<f64> =
            (0..1500).map(|i| 9.0 * (0.05 * f64::from(i)).sin() * (0.003 * f64::from(i)).cos()).collect();
        let motion = Motion::new(samples, 0.01, None).unwrap();
        let histories = std::num::NonZeroUsize::new(1);
        let options = Options { histories, energy: true, events: true, ..Options::default() };
        let response = simulate(&scene, &motion, &options).unwrap();
        assert!(response.energy.unwrap().relative_residual.abs() < 1e-12, "{:?}", response.energy);
        let histories = response.histories.unwrap();
        // The drifts at samples, with those at turns between them, from the log.
        assert!(response.events.unwrap().len() > 20);
        let force = histories.storey_force;
        assert!(force.iter().all(|f| f.abs() <= response.peaks.storey_shear[0].value * (1.0 + 1e-12)));
        let path = spring_path(&storey, &histories.drift).unwrap();
        // Turns between samples are cut off by at most the drift between them.
        let step = histories.drift.windows(2).map(|d| (d[1] - d[0]).abs()).fold(0.0, f64::max);
        let worst = path.force.iter().zip(&force).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 200.0 * step, "{worst} with steps of {step}");
    }
}

#[test]
fn what_is_no_law_is_refused() {
    let refused = |storey: Storey, message: &str| {
        let error = Building::new(vec![1.0], vec![storey], Damping::Modal { ratio: 0.05 }).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    };
    refused(Storey::multilinear(vec![]), "number of backbone points of storey 1 must be 1 to 100; got 0");
    refused(
        Storey::multilinear(vec![[0.1, 1.0], [0.1, 2.0]]),
        "drift of backbone point 2 of storey 1 must be finite and above 0.1 m",
    );
    refused(Storey::multilinear(vec![[0.1, 1.0], [0.2, 3.0]]), "must be not above 10 N/m, that of the segment before");
    refused(Storey::multilinear(vec![[0.1, 1.0], [0.2, 0.5]]), "force of backbone point 2");
    refused(
        storey(-0.1, SpringLaw::Trilinear),
        "third_slope of storey 1 must be between 0 and the second slope 0.1; got -0.1",
    );
    refused(
        storey(0.0, SpringLaw::Gap { clearance: 0.0, stop_stiffness: 1.0 }),
        "clearance of storey 1 must be a positive number",
    );
    refused(
        storey(0.0, SpringLaw::FlagShaped { flag_height: 1.1 }),
        "flag_height of storey 1 must be between 0 and 1; got 1.1",
    );
    let law = PeakOriented { residual_strength: 1.5, ..PeakOriented::default() };
    refused(
        storey(0.0, SpringLaw::PeakOriented(law)),
        "residual_strength of storey 1 must be between 0 and 1; got 1.5",
    );
}

/// Uniform numbers in [0, 1) of a linear congruential generator (Knuth's MMIX constants).
struct Draw(u64);

/// The laws of a random storey, each of which is as likely: what they make of a trilinear one.
const LAWS: [fn(&mut Draw, Storey) -> Storey; 5] =
    [Draw::multilinear, Draw::gap, Draw::peak_oriented, Draw::flag_shaped, |_, trilinear| trilinear];

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn law(&mut self, stiffness: f64, strength: f64) -> Storey {
        let base = Storey {
            overstrength: if self.next() < 0.3 { 1.0 } else { self.between(1.05, 2.5) },
            second_slope: if self.next() < 0.2 { 0.0 } else { self.between(0.01, 0.4) },
            third_slope: 0.0,
            ..Storey::yielding(stiffness, strength)
        };
        LAWS[(LAWS.len() as f64 * self.next()) as usize](self, base)
    }

    fn multilinear(&mut self, base: Storey) -> Storey {
        let (mut slope, strength) = (base.stiffness, base.yield_shear);
        let drift = strength / slope;
        let mut point = [drift, strength];
        let mut points = vec![point];
        for _ in 0..(6.0 * self.next()) as usize {
            slope *= self.between(0.1, 0.9);
            let length = drift * self.between(0.2, 3.0);
            point = [point[0] + length, point[1] + slope * length];
            points.push(point);
        }
        Storey::multilinear(points)
    }

    fn gap(&mut self, base: Storey) -> Storey {
        let clearance = base.elastic_drift() * self.between(0.3, 4.0);
        let law = SpringLaw::Gap { clearance, stop_stiffness: base.stiffness * self.between(0.1, 10.0) };
        Storey { law, ..base }
    }

    fn peak_oriented(&mut self, base: Storey) -> Storey {
        let law = PeakOriented {
            unloading_exponent: if self.next() < 0.5 { 0.0 } else { self.between(0.1, 0.8) },
            energy_capacity: if self.next() < 0.4 { f64::INFINITY } else { self.between(20.0, 400.0) },
            residual_strength: self.between(0.05, 0.8),
        };
        let third_slope = if self.next() < 0.5 { 0.0 } else { -self.between(0.01, 0.2) };
        Storey { third_slope, law: SpringLaw::PeakOriented(law), ..base }
    }

    fn flag_shaped(&mut self, base: Storey) -> Storey {
        let flag_height = if self.next() < 0.2 { 0.0 } else { self.between(0.05, 1.0) };
        Storey { law: SpringLaw::FlagShaped { flag_height }, ..base }
    }

    fn block(&mut self, floor: usize, mass: f64) -> Block {
        let mu_s = self.between(0.05, 0.4);
        let mut block = Block { mu_k: mu_s * self.between(0.6, 1.0), ..Block::new(floor, mass, mu_s) };
        let mut path = 0.0;
        for _ in 0..(4.0 * self.next()) as usize {
            path += self.between(0.001, 0.05);
            let mu_s = block.mu_s * self.between(0.5, 1.5);
            block.wear.push(Wear { path, mu_s, mu_k: mu_s * self.between(0.6, 1.0) });
        }
        block
    }

    /// One to three storeys of any law, a block on most floors, a motion of three sines.
    fn scene(&mut self) -> (Scene, Vec<f64>) {
        let n = 1 + (3.0 * self.next()) as usize;
        let storeys = (0..n).map(|i| {
            let strength = 1000.0 * 9.80665 * self.between(0.05, 0.3) * (n - i) as f64;
            let stiffness = 1000.0 * self.between(100.0, 900.0) * (n - i) as f64;
            self.law(stiffness, strength)
        });
        let storeys = storeys.collect();
        let building = Building::new(vec![1000.0; n], storeys, Damping::Modal { ratio: 0.03 }).unwrap();
        let mut blocks = Vec::new();
        for floor in 1..=n {
            let mass = self.between(100.0, 1500.0);
            if self.next() < 0.7 {
                blocks.push(self.block(floor, mass));
            }
        }
        let waves: Vec<[f64; 3]> =
            (0..3).map(|_| [self.between(0.5, 4.0), self.between(3.0, 25.0), self.between(0.0, 6.0)]).collect();
        let at = |t: f64| waves.iter().map(|[a, w, phase]| a * (w * t + phase).sin()).sum::<f64>();
        let samples = (0..600).map(|i| at(0.02 * f64::from(i))).collect();
        (Scene::new(Some(Arc::new(building)), blocks).unwrap(), samples)
    }
}

fn whole(scene: &Scene, samples: Vec<f64>, dt: f64) -> Response {
    let options = Options { energy: true, events: true, ..Options::default() };
    simulate(scene, &Motion::new(samples, dt, None).unwrap(), &options).unwrap()
}

fn counts(response: &Response) -> Vec<(EventKind, usize, i8, u8)> {
    response.events.as_ref().unwrap().iter().map(|e| (e.kind, e.number, e.sign, e.element)).collect()
}

/// Of random scenes of all laws and of wear: energies balance; the opposite motion gives the opposite response, bit for
/// bit; sample intervals cut in four, where steps are other ones, give the same response and the same log.
#[test]
fn invariants_of_random_scenes() {
    let mut draw = Draw(20_260_101);
    let mut seen = std::collections::HashMap::new();
    for number in 0..200 {
        let (scene, samples) = draw.scene();
        let response = whole(&scene, samples.clone(), 0.02);
        let residual = response.energy.unwrap().relative_residual;
        assert!(residual.abs() < 1e-11, "scene {number}: residual {residual:e}");
        for (kind, ..) in counts(&response) {
            *seen.entry(kind).or_insert(0) += 1;
        }
        let opposite = whole(&scene, samples.iter().map(|a| -a).collect(), 0.02);
        assert_eq!(response.peaks, opposite.peaks, "scene {number}");
        for (one, other) in response.residual_drift.iter().zip(&opposite.residual_drift) {
            assert_eq!(*one, -other, "scene {number}");
        }
        let mut quarters: Vec<f64> = Vec::new();
        for pair in samples.windows(2) {
            quarters.extend((0..4).map(|part| pair[0] + (pair[1] - pair[0]) * 0.25 * f64::from(part)));
        }
        quarters.extend(samples.last());
        let divided = whole(&scene, quarters, 0.005);
        assert_eq!(counts(&response), counts(&divided), "scene {number}");
        assert_eq!(response.status, divided.status, "scene {number}");
        let worst = |other: &Response| {
            let drifts = response.peaks.drift.iter().zip(&other.peaks.drift);
            let pairs = drifts.chain(response.peaks.slip.iter().zip(&other.peaks.slip));
            pairs.map(|(a, b)| (a.value - b.value).abs() / a.value.max(1e-9)).fold(0.0, f64::max)
        };
        // The samples between are rounded: a change of the input, which softening and slips may amplify.
        let moved = whole(&scene, samples.iter().map(|a| a * (1.0 + 1e-11)).collect(), 0.02);
        let tolerance = 1e-12_f64.max(1e-14 * worst(&moved) / 1e-11);
        assert!(worst(&divided) < tolerance, "scene {number}: {:e} above {tolerance:e}", worst(&divided));
    }
    for kind in
        [EventKind::Yield, EventKind::Unload, EventKind::Reload, EventKind::Close, EventKind::Open, EventKind::Wear]
    {
        assert!(seen.get(&kind).is_some_and(|&n| n > 200), "{kind:?} in {seen:?}");
    }
}

/// A block pushed over the ground: mu = 0.2 for the first 0.1 m, 0.1 after. v0^2 = 2 g (0.2 * 0.1 + 0.1 s).
#[test]
fn friction_changes_with_the_path() {
    let g = seismass::STANDARD_GRAVITY;
    let v0 = 1.0_f64;
    let wear = vec![Wear { path: 0.1, mu_s: 0.1, mu_k: 0.1 }];
    let block = Block { velocity: Some(v0), wear, ..Block::new(0, 2.0, 0.2) };
    let scene = Scene::new(None, vec![block]).unwrap();
    let response = whole(&scene, vec![0.0; 300], 0.01);
    let v1 = (v0 * v0 - 2.0 * g * 0.2 * 0.1).sqrt();
    let first = (v0 - v1) / (0.2 * g);
    let events = response.events.as_ref().unwrap();
    assert_eq!(counts(&response), [(EventKind::Wear, 1, 1, 1), (EventKind::Stick, 1, 1, 0)]);
    close(events[0].time, first, 1e-13, "wear");
    close(events[1].time, first + v1 / (0.1 * g), 1e-7, "stop");
    close(response.residual_slip[0], 0.1 + v1 * v1 / (2.0 * g * 0.1), 1e-13, "slip");
    close(response.energy.unwrap().friction, 0.5 * 2.0 * v0 * v0, 1e-13, "energy");
}
