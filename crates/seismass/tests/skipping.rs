//! Skipping what a scene does not need never changes a digit that is reported, and is reported itself.

#![allow(clippy::unwrap_used)]

use std::num::NonZeroUsize;
use std::sync::Arc;

use seismass::{
    Block, Building, Control, Damping, Error, EventKind, Motion, Options, Run, Scene, Storey, UniformBuilding,
    simulate, simulate_many, simulate_until,
};

fn building() -> Arc<Building> {
    let storeys = vec![Storey::yielding(5.5e5, 7000.0), Storey::yielding(5.5e5, 4000.0), Storey::elastic(5.5e5)];
    Arc::new(Building::new(vec![1000.0; 3], storeys, Damping::Modal { ratio: 0.05 }).unwrap())
}

fn scene(mu: f64) -> Scene {
    Scene::new(Some(building()), vec![Block::new(1, 1000.0, mu)]).unwrap()
}

/// Shaking for 8 s between quiet stretches.
fn motion(head: usize, tail: usize) -> Motion {
    let shaking = (0..800).map(|i| 4.0 * (0.06 * f64::from(i)).sin() * (0.004 * f64::from(i)).sin());
    let samples: Vec<f64> =
        std::iter::repeat_n(0.0, head).chain(shaking).chain(std::iter::repeat_n(0.0, tail)).collect();
    Motion::new(samples, 0.01, None).unwrap()
}

/// Vertical motion of that length that takes no contact away.
fn vertical() -> Arc<[f64]> {
    (0..800).map(|i| 2.0 * (0.23 * f64::from(i)).sin()).collect()
}

#[test]
fn a_quiet_tail_is_left_out_when_only_peaks_are_wanted() {
    let motion = motion(0, 5000);
    let whole = simulate(&scene(0.2), &motion, &Options::default()).unwrap();
    let short = simulate(&scene(0.2), &motion, &Options::PEAKS).unwrap();
    assert_eq!(whole.peaks, short.peaks);
    assert_eq!(whole.statistics.events, short.statistics.events);
    assert!(short.statistics.skipped.tail_samples > 4000, "{:?}", short.statistics.skipped);
    assert!(short.residual_drift.iter().all(|d| d.is_nan()));
    assert_eq!(whole.statistics.skipped.tail_samples, 0);
}

/// A tail is left out where nothing can happen in it any more: of scenes whose blocks stick and whose storeys yield with
/// each swing, no event and no peak is lost, whatever the strength of the pulse before. Hardly damped, they swing on.
#[test]
fn no_event_of_a_tail_is_left_out() {
    let options = |peaks_only: bool| Options { peaks_only, ..Options::default() };
    let (mut left_out, mut late_slips, mut late_yields) = (0, 0, 0);
    for (ratio, mu, yield_shear) in [(0.0, 0.197, f64::INFINITY), (0.0013, 0.127, f64::INFINITY), (0.0013, 9.0, 2.9e3)]
    {
        let spring = Storey { overstrength: 1.47, second_slope: 0.313, ..Storey::yielding(4.37e5, yield_shear) };
        let building = Building::new(vec![1130.0], vec![spring], Damping::Modal { ratio }).unwrap();
        let scene = Scene::new(Some(Arc::new(building)), vec![Block::new(1, 431.0, mu)]).unwrap();
        for size in 1..100 {
            let pulse = |i: usize| 0.13 * f64::from(size) * (0.19 * i as f64).sin();
            let samples: Vec<f64> = (0..600).map(|i| if i < 40 { pulse(i) } else { 0.0 }).collect();
            let motion = Motion::new(samples, 0.0107, None).unwrap();
            let whole = simulate(&scene, &motion, &Options { events: true, ..options(false) }).unwrap();
            let short = simulate(&scene, &motion, &options(true)).unwrap();
            assert_eq!(whole.peaks, short.peaks, "{ratio}, {size}");
            assert_eq!(whole.statistics.events, short.statistics.events, "{ratio}, {size}");
            left_out += short.statistics.skipped.tail_samples;
            let late = |kind: EventKind| {
                let events = whole.events.iter().flatten();
                events.filter(|event| event.kind == kind && event.time > 40.0 * 0.0107).count()
            };
            late_slips += late(EventKind::Slip);
            late_yields += late(EventKind::Yield);
        }
    }
    assert!(left_out > 20_000 && late_slips > 100 && late_yields > 50, "{left_out}, {late_slips}, {late_yields}");
}

#[test]
fn a_quiet_head_is_left_out() {
    let (with, without) = (motion(1000, 0), motion(0, 0));
    let a = simulate(&scene(0.2), &with, &Options::default()).unwrap();
    let b = simulate(&scene(0.2), &without, &Options::default()).unwrap();
    assert_eq!(a.statistics.skipped.head_samples, 1000);
    assert_eq!(a.residual_drift, b.residual_drift);
    assert_eq!(a.residual_slip, b.residual_slip);
    assert_eq!(a.statistics.intervals, b.statistics.intervals);
}

#[test]
fn what_does_not_exist_is_counted_as_skipped() {
    let response = simulate(&scene(0.2), &motion(0, 0), &Options::default()).unwrap();
    assert_eq!((response.statistics.skipped.elastic_storeys, response.statistics.skipped.bare_floors), (1, 2));
    let bare = simulate(&Scene::new(Some(building()), vec![]).unwrap(), &motion(0, 0), &Options::default()).unwrap();
    assert_eq!(bare.statistics.skipped.bare_floors, 3);
}

/// Vertical motion acts on blocks alone: without them it changes no digit and no step, even where contact would be lost.
#[test]
fn vertical_motion_of_a_bare_building_is_left_out() {
    let bare = Scene::new(Some(building()), vec![]).unwrap();
    let horizontal = motion(0, 0);
    let vertical = (0..800).map(|i| 12.0 * (0.05 * f64::from(i)).sin()).collect::<Vec<_>>();
    let both = Motion::new(horizontal.acceleration().to_vec(), horizontal.dt(), Some(vertical.into())).unwrap();
    let options = Options { histories: std::num::NonZeroUsize::new(1), ..Options::default() };
    let with = simulate(&bare, &both, &options).unwrap();
    assert!(with.statistics.events.total() > 0);
    assert_eq!(with, simulate(&bare, &horizontal, &options).unwrap());
}

#[test]
fn equal_runs_of_a_batch_are_solved_once() {
    let scenes = [scene(0.2), scene(0.3), scene(0.2)];
    let motions = [motion(0, 0), motion(0, 0)];
    let runs: Vec<_> = (0..3).flat_map(|s| [Run::new(s, 0), Run::new(s, 1)]).collect();
    let control = Control::default();
    let responses = simulate_many(&scenes, &motions, &runs, &Options::default(), None, &control).unwrap();
    assert_eq!(control.done.into_inner(), 6);
    assert_eq!(responses[0], responses[5]);
    assert_ne!(responses[0], responses[2]);
}

#[test]
fn a_batch_can_be_stopped() {
    let control = Control::default();
    control.stop.store(true, std::sync::atomic::Ordering::Relaxed);
    let runs = [Run::new(0, 0)];
    let stopped = simulate_many(&[scene(0.2)], &[motion(0, 0)], &runs, &Options::default(), None, &control);
    assert_eq!(stopped.unwrap_err(), Error::Interrupted);
    let long = Motion::new(vec![0.1; 5000], 0.01, None).unwrap();
    assert_eq!(simulate_until(&scene(0.2), &long, &Options::default(), &control.stop).unwrap_err(), Error::Interrupted);
    let wrong = simulate_many(
        &[scene(0.2)],
        &[motion(0, 0)],
        &[Run::new(0, 3)],
        &Options::default(),
        None,
        &Control::default(),
    );
    assert!(
        wrong.unwrap_err().to_string().contains("motion index of run 1 must be below the number of them, 1; got 3")
    );
}

/// Runs of one structure share what they form for its regimes, some of it only once a run has stayed there long enough:
/// which run comes first changes no bit, whatever the number of storeys.
#[test]
fn a_run_of_a_batch_is_the_run_alone_to_the_bit() {
    for (storeys, damping) in [
        (3, Damping::Modal { ratio: 0.05 }),
        (6, Damping::Modal { ratio: 0.05 }),
        (8, Damping::Rayleigh { ratio: 0.05, modes: [1, 2] }),
        (12, Damping::Modal { ratio: 0.05 }),
        (20, Damping::Rayleigh { ratio: 0.05, modes: [1, 2] }),
    ] {
        let building =
            UniformBuilding { storeys, period: 0.12 * storeys as f64, mass: 1000.0, damping, ..Default::default() };
        let building = building.build().unwrap();
        let yields = |(i, s): (usize, &Storey)| Storey {
            second_slope: 0.1,
            ..Storey::yielding(s.stiffness, 900.0 * (storeys - i) as f64)
        };
        let yielding = building.storeys().iter().enumerate().map(yields).collect();
        let building = Arc::new(building.with_storeys(yielding).unwrap());
        let blocks = (1..=storeys).map(|floor| Block::new(floor, 500.0, 0.15)).collect();
        let scenes = [Scene::new(Some(building), blocks).unwrap()];
        let horizontal = motion(0, 0);
        let both = Motion::new(horizontal.acceleration(), 0.01, Some(vertical())).unwrap();
        let motions = [horizontal, both];
        // With vertical motion, steps have more columns.
        let mut runs: Vec<Run> = [0.4, 0.7, 1.0, 1.6].map(|scale| Run { scale, ..Run::new(0, 0) }).into();
        runs.insert(2, Run::new(0, 1));
        for is_reversed in [false, true] {
            if is_reversed {
                runs.reverse();
            }
            let batch = simulate_many(&scenes, &motions, &runs, &Options::default(), Some(1), &Control::default());
            for (run, response) in runs.iter().zip(batch.unwrap()) {
                let Run { motion, scale, .. } = *run;
                let samples: Vec<f64> = motions[motion].acceleration().iter().map(|a| a * scale).collect();
                let alone = Motion::new(samples, 0.01, motions[motion].vertical().map(Into::into)).unwrap();
                let alone = simulate(&scenes[0], &alone, &Options::default()).unwrap();
                assert!(alone.statistics.regime_hits > 10 && alone.statistics.plain_steps > 10, "{storeys} storeys");
                assert_eq!(response.unwrap(), alone, "{storeys} storeys, motion {motion}, factor {scale}");
            }
        }
    }
}

/// What blocks do is read from the lanes of their floors where block after block stands on floor after floor, one by one
/// elsewhere: histories are the same.
#[test]
fn the_order_of_blocks_changes_no_history() {
    let options = Options { histories: NonZeroUsize::new(1), ..Options::default() };
    for (n, vertical) in [1, 3, 4, 7, 13, 20, 40].into_iter().flat_map(|n| [(n, None), (n, Some(vertical()))]) {
        let (period, damping) = (0.15 * n as f64, Damping::Modal { ratio: 0.03 });
        let building = UniformBuilding { storeys: n, period, mass: 1000.0, damping, ..Default::default() };
        let building = Arc::new(building.build().unwrap());
        let block = |i: usize| Block::new(i + 1, 400.0 + 10.0 * i as f64, 0.05 + 0.3 * (i % 3) as f64);
        let response = |blocks: Vec<Block>| {
            let motion = Motion::new(motion(0, 0).acceleration(), 0.01, vertical.clone()).unwrap();
            simulate(&Scene::new(Some(Arc::clone(&building)), blocks).unwrap(), &motion, &options).unwrap()
        };
        let (upwards, downwards) = (response((0..n).map(block).collect()), response((0..n).rev().map(block).collect()));
        assert!(upwards.statistics.events.total() > 0, "{n} storeys");
        let turned = |values: &[f64]| values.chunks(n).flat_map(|row| row.iter().rev().copied()).collect::<Vec<_>>();
        let (mut found, expected) = (downwards.histories.unwrap(), upwards.histories.unwrap());
        (found.slip, found.block_velocity) = (turned(&found.slip), turned(&found.block_velocity));
        assert_eq!(found, expected, "{n} storeys");
    }
}

#[test]
fn a_scaled_motion_of_a_batch_is_the_motion_times_its_factor() {
    let (scenes, motions) = ([scene(0.2)], [motion(100, 0)]);
    let factors = [2.0, 1.0, -0.7, 2.0, 1e308];
    let runs = factors.map(|scale| Run { scale, ..Run::new(0, 0) });
    let batch = simulate_many(&scenes, &motions, &runs, &Options::default(), Some(2), &Control::default()).unwrap();
    for (factor, response) in factors.iter().zip(&batch).take(4) {
        let samples: Vec<f64> = motions[0].acceleration().iter().map(|a| a * factor).collect();
        let alone = simulate(&scenes[0], &Motion::new(samples, 0.01, None).unwrap(), &Options::default()).unwrap();
        assert_eq!(response.as_ref().unwrap(), &alone);
    }
    let message = batch[4].as_ref().unwrap_err().to_string();
    assert!(message.starts_with("acceleration of motion must be finite at every sample; got "), "{message}");
}

/// A long motion has fewer substeps than a short one, so as to be held in memory: what one run of a group forms is no
/// other run's.
#[test]
fn runs_of_a_batch_have_substeps_of_their_own() {
    let storeys = vec![Storey { second_slope: 0.1, ..Storey::yielding(5e8, 5000.0) }, Storey::elastic(5.5e5)];
    let building = Building::new(vec![1000.0; 2], storeys, Damping::Modal { ratio: 0.05 }).unwrap();
    let scenes = [Scene::new(Some(Arc::new(building)), vec![Block::new(2, 1000.0, 0.1)]).unwrap()];
    let motions = [motion(0, 0), motion(1_100_000, 0), motion(10, 10)];
    let runs = [0, 1, 2, 1, 0].map(|motion| Run::new(0, motion));
    let options = Options { events: true, ..Options::default() };
    let batch = simulate_many(&scenes, &motions, &runs, &options, Some(1), &Control::default()).unwrap();
    let alone = motions.map(|motion| simulate(&scenes[0], &motion, &options).unwrap());
    assert_eq!(alone.each_ref().map(|response| response.statistics.substeps), [2, 1, 2]);
    assert!(alone.iter().all(|response| response.statistics.events.total() > 10));
    for (run, response) in runs.iter().zip(batch) {
        assert_eq!(response.unwrap(), alone[run.motion], "motion {}", run.motion);
    }
}

/// Rows of histories, and what is skipped, go by samples, whatever a step is.
#[test]
fn substeps_leave_rows_and_skipped_samples_as_they_are() {
    let storeys = vec![Storey::yielding(5e9, 5000.0), Storey::yielding(5.5e5, 3000.0)];
    let building = Building::new(vec![1000.0; 2], storeys, Damping::Modal { ratio: 0.05 }).unwrap();
    let scene = Scene::new(Some(Arc::new(building)), vec![Block::new(2, 1000.0, 0.1)]).unwrap();
    for tail in 0..7 {
        let motion = motion(100, tail);
        let of_every = |every: usize| {
            let response =
                simulate(&scene, &motion, &Options { histories: NonZeroUsize::new(every), ..Options::default() });
            let response = response.unwrap();
            assert!(response.statistics.substeps > 1);
            assert_eq!(response.statistics.skipped.head_samples, 100);
            assert_eq!(response.statistics.intervals, 800 - 1 + tail);
            response.histories.unwrap()
        };
        let (all, few) = (of_every(1), of_every(7));
        assert_eq!((all.rows, few.rows), (900 + tail, (900 + tail).div_ceil(7)));
        assert_eq!((all.every, few.every), (1, 7));
        for (row, of_few) in few.drift.chunks_exact(2).enumerate() {
            assert_eq!(of_few, &all.drift[2 * 7 * row..][..2], "row {row}");
        }
    }
}

/// What else is asked for changes no bit, however many storeys: with energies, and in a quiet tail of which peaks alone are
/// wanted, plain steps are taken one by one.
#[test]
fn what_is_asked_for_changes_no_bit() {
    let swing = |i: usize| 9.0 * (0.05 * i as f64).sin() * (0.004 * i as f64).sin();
    let horizontal: Vec<f64> = (0..700).map(|i| if i < 400 { swing(i) } else { 0.0 }).collect();
    let vertical: Arc<[f64]> = (0..700).map(|i| 3.0 * (0.31 * i as f64).sin()).collect();
    let options = Options { histories: NonZeroUsize::new(1), ..Options::default() };
    let mut plain_steps = 0;
    for (storeys, damping, vertical) in [3, 6, 17, 24, 50].into_iter().flat_map(|storeys| {
        let modal = Damping::Modal { ratio: 0.03 };
        let rayleigh = Damping::Rayleigh { ratio: 0.03, modes: [1, 2] };
        [(storeys, modal, None), (storeys, rayleigh.clone(), Some(vertical.clone())), (storeys, rayleigh, None)]
    }) {
        let uniform = UniformBuilding { storeys, period: 0.1 * storeys as f64, mass: 1000.0, ..Default::default() };
        let springs = vec![Storey::yielding(uniform.stiffness().unwrap(), 12e3); storeys];
        let building = Building::new(vec![1000.0; storeys], springs, damping).unwrap();
        let blocks = [1, storeys / 2, storeys].map(|floor| Block::new(floor.max(1), 400.0, 0.15));
        let scene = Scene::new(Some(Arc::new(building)), blocks.to_vec()).unwrap();
        let motion = Motion::new(horizontal.clone(), 0.01, vertical).unwrap();
        let whole = simulate(&scene, &motion, &options).unwrap();
        plain_steps += whole.statistics.plain_steps;
        let with_energy = simulate(&scene, &motion, &Options { energy: true, ..options }).unwrap();
        assert_eq!(whole.histories, with_energy.histories, "{storeys} storeys");
        assert_eq!(whole.peaks, with_energy.peaks, "{storeys} storeys");
        let without = simulate(&scene, &motion, &Options::default()).unwrap();
        assert_eq!((&whole.peaks, &whole.slip_path), (&without.peaks, &without.slip_path), "{storeys} storeys");
        let peaks = simulate(&scene, &motion, &Options::PEAKS).unwrap();
        assert_eq!((whole.peaks, whole.end_time), (peaks.peaks, peaks.end_time), "{storeys} storeys");
    }
    assert!(plain_steps > 5000, "{plain_steps}");
}

/// Without damping the same peak comes back in each cycle, but for rounding: it counts where it is largest.
#[test]
fn an_undamped_tail_is_not_left_out() {
    let building = Building::new(vec![1.0], vec![Storey::elastic(100.0)], Damping::Modal { ratio: 0.0 }).unwrap();
    let scene = Scene::new(Some(Arc::new(building)), vec![]).unwrap();
    let mut random: u32 = 1;
    for turn in 0..40 {
        let samples = (0..2040).map(|i| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            if i < 40 { f64::from(random) / f64::from(u32::MAX) - 0.5 } else { 0.0 }
        });
        let motion = Motion::new(samples.collect::<Vec<_>>(), 0.02, None).unwrap();
        let whole = simulate(&scene, &motion, &Options::default()).unwrap();
        let peaks = simulate(&scene, &motion, &Options::PEAKS).unwrap().peaks;
        assert_eq!(peaks, whole.peaks, "{turn}");
    }
}
