//! Tall and stiff buildings beside the judge: the fast kernel takes the steps of tall ones by bands or by matrices of their
//! own, those of stiff ones in substeps. The widths at which its vectors end, and how long a step may be. Short motions:
//! rounding has no time to grow.

#![allow(clippy::unwrap_used)]

use std::num::NonZeroUsize;
use std::sync::Arc;

use seismass::{
    Block, Building, Damping, Motion, Options, Response, STANDARD_GRAVITY, Scene, Storey, UniformBuilding, simulate,
};
use seismass_judge::{Comparison, DoubleDouble, Real, compare, larger, solve};

/// Both are right to some 1e-14 (printed); a guard or a peak that is missed is far beyond this.
const AGREEMENT: f64 = 1e-12;

const RAYLEIGH: Damping = Damping::Rayleigh { ratio: 0.05, modes: [1, 3] };

const MODAL: Damping = Damping::Modal { ratio: 0.05 };

/// A building whose masses and stiffnesses differ from floor to floor, with a first period near 0.1 s per storey and
/// blocks on most floors and on the ground.
fn tall(n: usize, damping: Damping) -> Scene {
    tall_with_period(0.1, n, damping)
}

/// The same with another first period per storey.
fn tall_with_period(period_per_storey: f64, n: usize, damping: Damping) -> Scene {
    let uniform = UniformBuilding {
        storeys: n,
        period: period_per_storey * n as f64,
        mass: 1.0,
        damping: RAYLEIGH,
        ..Default::default()
    };
    let uniform = uniform.build().unwrap();
    let weight = STANDARD_GRAVITY * n as f64;
    let wave = |i: usize, step: f64| 1.0 + 0.3 * (step * i as f64).sin();
    let storeys = uniform.storeys().iter().enumerate().map(|(i, storey)| Storey {
        second_slope: 0.05,
        ..Storey::yielding(storey.stiffness * wave(i, 1.3), 0.15 * weight * (n - i) as f64 / n as f64)
    });
    let mass = (0..n).map(|i| wave(i, 0.7)).collect();
    let building = Building::new(mass, storeys.collect(), damping).unwrap();
    let blocks = (0..=n).filter(|floor| floor % 5 != 3).map(|floor| Block::new(floor, wave(floor, 2.1), 0.2)).collect();
    Scene::new(Some(Arc::new(building)), blocks).unwrap()
}

/// Beats that pass through zero, with a peak of `peak_g`.
fn motion(samples: usize, peak_g: f64, vertical: bool) -> Motion {
    let dt = 0.01;
    let beat = |frequency: f64, i: usize| (std::f64::consts::TAU * frequency * dt * i as f64).sin();
    let horizontal = |i: usize| peak_g * STANDARD_GRAVITY * 0.5 * (beat(2.3, i) + beat(3.1, i));
    let upwards = |i: usize| 0.3 * STANDARD_GRAVITY * beat(7.0, i);
    let vertical = vertical.then(|| (0..samples).map(upwards).collect::<Vec<_>>().into());
    Motion::new((0..samples).map(horizontal).collect::<Vec<_>>(), dt, vertical).unwrap()
}

/// Solves by the kernel and by the judge; returns the comparison and how many steps were plain.
fn judged<R: Real>(scene: &Scene, motion: &Motion) -> (Comparison, usize) {
    let (comparison, response) = compared::<R>(scene, motion);
    (comparison, response.statistics.plain_steps)
}

/// Solves by the kernel, histories at every third sample, and by the judge; returns the comparison and the response.
fn compared<R: Real>(scene: &Scene, motion: &Motion) -> (Comparison, Response) {
    let options = Options { histories: NonZeroUsize::new(3), events: true, ..Options::default() };
    let response = simulate(scene, motion, &options).unwrap();
    let exact = solve::<R>(scene, motion, 3).unwrap();
    (compare(&response, &exact), response)
}

#[test]
fn every_width_agrees_without_events() {
    for n in [8, 9, 12, 15, 16, 17, 24, 31, 32, 33, 47, 48, 49, 63, 64, 65] {
        for (damping, vertical) in [(RAYLEIGH, false), (RAYLEIGH, true), (Damping::Modal { ratio: 0.0 }, false)] {
            let (comparison, plain) = judged::<f64>(&tall(n, damping.clone()), &motion(120, 0.004, vertical));
            println!("{n} storeys, {damping:?}, vertical {vertical}: {:.1e}, {plain} plain", comparison.worst());
            assert!(comparison.agrees(AGREEMENT), "{n} storeys, {damping:?}, vertical {vertical}: {comparison:?}");
            // Without bands a peak inside a step ends the run of plain steps.
            assert!(n <= 16 || plain > 60, "{n} storeys, {damping:?}: {plain} plain steps");
        }
    }
}

#[test]
fn every_width_agrees_with_events() {
    for n in [9, 16, 17, 33, 49, 65] {
        for vertical in [false, true] {
            let (comparison, plain) = judged::<f64>(&tall(n, RAYLEIGH), &motion(150, 0.5, vertical));
            println!("{n} storeys, vertical {vertical}: {:.1e}, {plain} plain", comparison.worst());
            assert!(comparison.agrees(AGREEMENT), "{n} storeys, vertical {vertical}: {comparison:?}");
        }
    }
}

/// Series go by tables up to eight storeys, above four once a regime has lasted; tables of a step that is halved serve
/// parts longer than it.
#[test]
fn tables_agree_at_every_number_of_storeys() {
    for n in 3..=9 {
        for damping in [RAYLEIGH, MODAL] {
            for (period_per_storey, peak_g) in [(0.1, 0.02), (0.1, 0.5), (0.012, 0.02), (0.012, 0.5)] {
                for vertical in [false, true] {
                    let scene = tall_with_period(period_per_storey, n, damping.clone());
                    let (comparison, plain) = judged::<f64>(&scene, &motion(300, peak_g, vertical));
                    let what = format!("{n} storeys, {damping:?}, {period_per_storey} s, {peak_g} g, {vertical}");
                    println!("{what}: {:.1e}, {plain} plain", comparison.worst());
                    assert!(comparison.agrees(AGREEMENT), "{what}: {comparison:?}");
                }
            }
        }
    }
}

/// Damping fitted to the lowest modes makes the highest ones overdamped: a step spans several of their time scales.
#[test]
fn tall_buildings_agree_however_stiff_their_highest_modes() {
    for (n, ratio, peak_g) in [(60, 0.05, 0.5), (60, 0.3, 0.004), (120, 0.05, 0.004)] {
        let scene = tall(n, Damping::Rayleigh { ratio, modes: [1, 3] });
        let (comparison, plain) = judged::<DoubleDouble>(&scene, &motion(40, peak_g, false));
        println!("{n} storeys, {ratio} of critical, {peak_g} g: {:.1e}, {plain} plain", comparison.worst());
        assert!(comparison.agrees(AGREEMENT), "{n} storeys, {ratio}, {peak_g} g: {comparison:?}");
    }
}

/// Where the disturbance has not come yet, floors move by rounding of the building's motion (docs/limitations.md).
/// Undamped: damping of the mass acts on all floors at once.
#[test]
fn floors_that_nothing_has_reached_move_by_rounding_alone() {
    for n in [24, 40, 64] {
        let scene = tall_with_period(0.8, n, Damping::Modal { ratio: 0.0 });
        let motion = motion(40, 0.5, false);
        let response = simulate(&scene, &motion, &Options::default()).unwrap();
        let exact = solve::<DoubleDouble>(&scene, &motion, 3).unwrap();
        let floors = response.peaks.floor_acceleration.iter().zip(&exact.peaks.floor_acceleration);
        let largest = exact.peaks.floor_acceleration.iter().fold(0.0, |largest, peak| larger(largest, peak.value));
        let error = floors.map(|(found, exact)| (found.value - exact.value).abs()).fold(0.0, larger) / largest;
        let highest = [&response.peaks, &exact.peaks].map(|peaks| peaks.floor_acceleration[n - 1].value / largest);
        println!("{n} storeys: highest floor {:.1e}, exactly {:.1e}; worst {error:.1e}", highest[0], highest[1]);
        assert!(error < 1e-14 && (highest[0] - highest[1]).abs() < 1e-16, "{n} storeys: {highest:?}");
    }
}

/// Modal damping is a full matrix: half as many intervals as there are storeys are solved by series first.
#[test]
fn full_damping_agrees_at_every_width() {
    for n in [16, 17, 24, 31, 32, 33, 48, 49, 55, 64, 65] {
        for vertical in [false, true] {
            let (comparison, plain) = judged::<f64>(&tall(n, MODAL), &motion(120, 0.004, vertical));
            println!("{n} storeys, vertical {vertical}: {:.1e}, {plain} plain", comparison.worst());
            assert!(comparison.agrees(AGREEMENT), "{n} storeys, vertical {vertical}: {comparison:?}");
            assert!(n <= 16 || plain > 60, "{n} storeys: {plain} plain steps");
        }
    }
}

/// The first strong waves break blocks away and yield storeys below, while the series' share of intervals passes.
#[test]
fn full_damping_agrees_with_events() {
    for (n, vertical) in [(17, true), (33, false), (50, false), (50, true), (67, false)] {
        let (comparison, plain) = judged::<f64>(&tall(n, MODAL), &motion(200, 0.15, vertical));
        println!("{n} storeys, vertical {vertical}: {:.1e}, {plain} plain", comparison.worst());
        assert!(comparison.agrees(AGREEMENT), "{n} storeys, vertical {vertical}: {comparison:?}");
    }
}

/// Steps of several radians of the highest mode are composed of halves.
#[test]
fn full_damping_agrees_however_long_the_step() {
    for (period_per_storey, ratio) in [(0.05, 0.05), (0.025, 0.05), (0.025, 0.2), (0.014, 0.02)] {
        let scene = tall_with_period(period_per_storey, 54, Damping::Modal { ratio });
        let (comparison, plain) = judged::<DoubleDouble>(&scene, &motion(70, 0.02, false));
        println!("{period_per_storey} s per storey, {ratio}: {:.1e}, {plain} plain", comparison.worst());
        assert!(comparison.agrees(AGREEMENT), "{period_per_storey} s per storey, {ratio}: {comparison:?}");
        assert!(plain > 30, "{period_per_storey} s per storey, {ratio}: {plain} plain steps");
    }
}

/// A storey so stiff that a sample interval is many radians of its mode long: intervals are solved in substeps, of which
/// no event, history or count by sample shows anything.
#[test]
fn stiff_storeys_are_solved_in_substeps() {
    for (n, contrast, damping, vertical) in [
        (3, 1e3, MODAL, false),
        (4, 1e5, Damping::Modal { ratio: 0.0 }, true),
        (7, 1e3, RAYLEIGH, false),
        (12, 1e3, MODAL, true),
        (20, 1e3, RAYLEIGH, true),
        (49, 1e3, MODAL, false),
    ] {
        let (scene, motion) = (stiffened(n, contrast, damping.clone()), motion(60, 0.5, vertical));
        let what = format!("{n} storeys, {contrast:e}, {damping:?}, vertical {vertical}");
        let (comparison, response) = compared::<f64>(&scene, &motion);
        let (statistics, histories) = (&response.statistics, response.histories.as_ref().unwrap());
        let steps = (statistics.plain_steps, statistics.series_steps);
        println!("{what}: {:.1e}, {} substeps, steps {steps:?}", comparison.worst(), statistics.substeps);
        assert!(comparison.agrees(AGREEMENT), "{what}: {comparison:?}");
        assert!(statistics.substeps > 1, "{what}");
        assert_eq!(statistics.intervals, 59, "{what}");
        assert_eq!((histories.every, histories.rows, histories.drift.len()), (3, 20, 20 * n), "{what}");
    }
}

/// A tall building with one storey that many times as stiff, and as strong as that takes.
fn stiffened(n: usize, contrast: f64, damping: Damping) -> Scene {
    let scene = tall(n, damping);
    let building = scene.building().unwrap();
    let mut storeys = building.storeys().to_vec();
    let storey = &mut storeys[n / 2];
    (storey.stiffness, storey.yield_shear) = (contrast * storey.stiffness, 10.0 * storey.yield_shear);
    Scene::new(Some(Arc::new(Building::clone(building).with_storeys(storeys).unwrap())), scene.blocks().to_vec())
        .unwrap()
}
