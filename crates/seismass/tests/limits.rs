//! Where the kernel stops: what cannot be solved is an error with its reason, and contact that is none is lost.

#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use seismass::{
    Block, Building, Control, Damping, Error, EventKind, Motion, Options, Run, STANDARD_GRAVITY, Scene, Storey,
    simulate, simulate_many,
};

fn storey(mass: f64, stiffness: f64) -> Scene {
    let springs = vec![Storey::yielding(stiffness, 1e-3 * stiffness)];
    let building = Building::new(vec![mass], springs, Damping::Modal { ratio: 0.05 }).unwrap();
    Scene::new(Some(Arc::new(building)), vec![Block::new(1, mass, 0.2)]).unwrap()
}

fn shaking(dt: f64) -> Motion {
    Motion::new((0..50).map(|i| 5.0 * f64::from(i).sin()).collect::<Vec<_>>(), dt, None).unwrap()
}

/// Frequencies without bound, and so high for the time step that no run would end.
#[test]
fn what_is_far_too_stiff_is_refused() {
    let energy = Options { energy: true, ..Options::default() };
    for (scene, dt) in [
        (storey(1e-310, 1.0), 0.01),
        (storey(1e-10, 1e300), 0.01),
        (storey(1.0, 1e24), 0.01),
        (storey(1000.0, 5e5), 1e12),
    ] {
        for options in [Options::default(), energy] {
            match simulate(&scene, &shaking(dt), &options) {
                Err(Error::TooStiff { time, phase, limit }) => assert!(time == 0.0 && phase > limit, "{phase} {limit}"),
                other => panic!("{other:?}"),
            }
        }
    }
}

/// A million radians between two samples are solved, whatever happens.
#[test]
fn what_is_very_stiff_is_solved() {
    let response = simulate(&storey(1.0, 1e16), &shaking(0.01), &Options::default()).unwrap();
    assert!(response.peaks.drift[0].value > 0.0);
    assert_eq!(response.end_time, 49.0 * 0.01);
}

/// A contact force of zero all along an interval is none: the block flies, and its velocity turns without an event.
#[test]
fn contact_that_is_zero_all_along_is_lost() {
    let fall = |i: usize| if (100..200).contains(&i) { -STANDARD_GRAVITY } else { 0.0 };
    let horizontal: Vec<f64> = (0..400).map(|i| 4.0 * (0.1 * f64::from(i)).sin()).collect();
    let motion = Motion::new(horizontal, 0.01, Some((0..400).map(fall).collect())).unwrap();
    let scene = Scene::new(None, vec![Block::new(0, 1.0, 0.3)]).unwrap();
    let response = simulate(&scene, &motion, &Options { events: true, ..Options::default() }).unwrap();
    let events = response.events.unwrap();
    let at =
        |kind: EventKind| events.iter().filter(|event| event.kind == kind).map(|event| event.time).collect::<Vec<_>>();
    assert_eq!((at(EventKind::Lift), at(EventKind::Land)), (vec![1.0], vec![1.99]));
    assert!(events.iter().all(|event| !(1.0 < event.time && event.time < 1.99)), "{events:?}");
}

/// Accelerations so large that squares of the response overflow: an error of that run, which takes no other with it.
#[test]
fn what_leaves_the_range_of_numbers_is_an_error_of_its_own_run() {
    let springs = |n: usize| vec![Storey::yielding(5e5, 3000.0); n];
    let scene = |n: usize| {
        let building = Building::new(vec![1000.0; n], springs(n), Damping::Modal { ratio: 0.05 }).unwrap();
        Scene::new(Some(Arc::new(building)), vec![Block::new(1, 1000.0, 0.3)]).unwrap()
    };
    for n in [1, 2, 3, 4, 6] {
        let scenes = [scene(n)];
        let motions = [shaking(0.01)];
        let runs = [1.0, 1e155, 1e200, 1e300, 2.0].map(|scale| Run { scene: 0, motion: 0, scale });
        let results = simulate_many(&scenes, &motions, &runs, &Options::default(), None, &Control::default()).unwrap();
        for (result, run) in results.into_iter().zip(runs) {
            let alone = simulate(&scenes[0], &motions[0].scaled(run.scale).unwrap(), &Options::default());
            match (result, alone) {
                (Ok(result), Ok(alone)) => {
                    assert!(run.scale < 3.0, "{n} storeys, {}", run.scale);
                    assert_eq!(result.peaks, alone.peaks);
                }
                (Err(Error::NotFinite { time, .. }), Err(Error::NotFinite { time: same, .. })) => {
                    assert!(run.scale > 3.0 && time == same && time >= 0.0);
                }
                other => panic!("{n} storeys, {}: {other:?}", run.scale),
            }
        }
    }
}

/// Rayleigh damping has two modes of the building, counted from 1 and not the same.
#[test]
fn modes_of_rayleigh_damping_are_those_of_the_building() {
    let building = |modes: [usize; 2]| {
        let damping = Damping::Rayleigh { ratio: 0.05, modes };
        Building::new(vec![1.0; 3], vec![Storey::yielding(40.0, 1.0); 3], damping)
    };
    for modes in [[1, 2], [1, 3], [3, 1], [2, 3]] {
        assert!(building(modes).is_ok(), "{modes:?}");
    }
    for modes in [[1, 1], [0, 2], [2, 0], [1, 4], [4, 1], [0, 4]] {
        let error = building(modes).unwrap_err().to_string();
        let [first, second] = modes;
        let expected = format!("two different modes from 1 to 3; got {first} and {second}");
        assert!(error.ends_with(&expected), "{modes:?}: {error}");
    }
}
