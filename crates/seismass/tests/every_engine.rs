//! Closed forms that hold in each engine: the chain of storeys, the general one, and the one in two directions.

#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use seismass::{
    Block, Building, Damping, EventKind, GeneralScene, Motion, Options, Peak, PlaneMotion, PlaneScene,
    STANDARD_GRAVITY, Scene, Storey, Wear, simulate, simulate_general, simulate_plane,
};

const G: f64 = STANDARD_GRAVITY;

/// What rounding leaves of numbers of size 1.
const ROUNDING: f64 = 1e-13;

/// What the engines have in common.
struct Outcome {
    engine: &'static str,
    events: Vec<(EventKind, usize, f64)>,
    drift: Vec<Peak>,
    shear: Vec<Peak>,
    acceleration: Vec<Peak>,
    slip: Vec<Peak>,
    residual_slip: Vec<f64>,
}

impl Outcome {
    fn times(&self, kind: EventKind, number: usize) -> Vec<f64> {
        let of = self.events.iter().filter(|(k, n, _)| (*k, *n) == (kind, number));
        of.map(|(.., time)| *time).collect()
    }
}

/// A scene by each engine; in two directions the motion is along x.
fn by_each_engine(scene: &Scene, motion: &Motion) -> [Outcome; 3] {
    let options = Options { events: true, ..Options::default() };
    let chain = simulate(scene, motion, &options).unwrap();
    let structure = GeneralScene::from(scene);
    let general = simulate_general(&structure, motion, &options).unwrap();
    let blocks = scene.blocks().iter().map(|block| Block { velocity: None, ..block.clone() }).collect();
    let across = GeneralScene::from(&Scene::new(scene.building().cloned(), blocks).unwrap());
    let still = vec![0.0; motion.acceleration().len()];
    let plane_motion = PlaneMotion::new(motion.clone(), still).unwrap();
    let plane = simulate_plane(&PlaneScene::new(structure, across).unwrap(), &plane_motion, &options).unwrap();
    let [along, _] = plane.peaks.directions;
    [
        Outcome {
            engine: "chain",
            events: chain.events.unwrap().iter().map(|e| (e.kind, e.number, e.time)).collect(),
            drift: chain.peaks.drift,
            shear: chain.peaks.storey_shear,
            acceleration: chain.peaks.floor_acceleration,
            slip: chain.peaks.slip,
            residual_slip: chain.residual_slip,
        },
        Outcome {
            engine: "general",
            events: general.events.unwrap().iter().map(|e| (e.event.kind, e.event.number, e.event.time)).collect(),
            drift: general.peaks.drift,
            shear: general.peaks.shear,
            acceleration: general.peaks.acceleration,
            slip: general.peaks.slip,
            residual_slip: general.residual_slip,
        },
        Outcome {
            engine: "two directions",
            events: plane.events.unwrap().iter().map(|e| e.event.event).map(|e| (e.kind, e.number, e.time)).collect(),
            drift: along.drift,
            shear: along.shear,
            acceleration: along.acceleration,
            slip: along.slip,
            residual_slip: plane.residual_slip.iter().map(|slip| slip[0]).collect(),
        },
    ]
}

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} for {expected}");
}

/// Vertical motion falls in a straight line from 0 to -2 g within T and rises again: contact is lost from T/2 to 3 T/2. A
/// block without friction keeps its velocity v, and has slipped p in contact, where it wears, at p/v or T after it. With
/// friction again, it stops after v/(mu g).
#[test]
fn a_flight_does_not_wear() {
    let (t, v, parts, samples) = (0.37, 0.83, 37, 200);
    let fall = |i: usize| if i < 2 * parts { 2.0 * G * ((i as f64 / parts as f64 - 1.0).abs() - 1.0) } else { 0.0 };
    let vertical: Vec<f64> = (0..samples).map(fall).collect();
    let motion = Motion::new(vec![0.0; samples], t / parts as f64, Some(vertical.into())).unwrap();
    for (path, flight) in [(0.11, 0.0), (0.61, t)] {
        let mu = 0.197;
        // A first stage that changes nothing, at a path of its own, before the flight.
        let wear = vec![Wear { path: 0.053, mu_s: 0.0, mu_k: 0.0 }, Wear { path, mu_s: mu, mu_k: 0.9 * mu }];
        let block = Block { velocity: Some(v), wear, ..Block::new(0, 3.1, 0.0) };
        for found in by_each_engine(&Scene::new(None, vec![block]).unwrap(), &motion) {
            let wear = found.times(EventKind::Wear, 1);
            close(wear[0], 0.053 / v, ROUNDING, found.engine);
            close(wear[1], path / v + flight, ROUNDING, found.engine);
            if flight > 0.0 {
                close(found.times(EventKind::Lift, 1)[0], 0.5 * t, ROUNDING, found.engine);
                close(found.times(EventKind::Land, 1)[0], 1.5 * t, ROUNDING, found.engine);
                close(found.times(EventKind::Stick, 1)[0], path / v + t + v / (0.9 * mu * G), ROUNDING, found.engine);
                let slip = path + v * t + v * v / (1.8 * mu * G);
                close(found.residual_slip[0], slip, ROUNDING, found.engine);
                close(found.slip[0].value, slip, ROUNDING, found.engine);
            }
        }
    }
}

/// Without damping, from the origin at v, the drift peaks at a quarter of a period with v/w, the spring force with k v/w and
/// the acceleration with v w. A block on the ground that stops before or after that, in the same interval of samples,
/// changes nothing of it.
#[test]
fn peaks_beside_an_event_of_the_same_interval_are_found() {
    let (mass, stiffness, v, mu) = (1130.0, 4.37e5, 0.317, 0.127);
    let w = f64::sqrt(stiffness / mass);
    let storeys = vec![Storey::elastic(stiffness)];
    let building = Arc::new(Building::new(vec![mass], storeys, Damping::Modal { ratio: 0.0 }).unwrap());
    // The peak is at 5/6 of the first interval.
    let motion = Motion::new(vec![0.0; 2], 0.3 * TAU / w, None).unwrap();
    for step in 1..120 {
        let stop = step as f64 / 120.0 * motion.dt();
        let block = Block { velocity: Some(mu * G * stop), ..Block::new(0, 283.0, mu) };
        let scene = Scene::new(Some(Arc::clone(&building)), vec![block]).unwrap();
        let scene = scene.with_initial(vec![0.0], vec![v]).unwrap();
        for found in by_each_engine(&scene, &motion) {
            let what = format!("{}, the block stops at {step}/120 of the interval", found.engine);
            close(found.times(EventKind::Stick, 1)[0], stop, ROUNDING, &what);
            for (peak, value) in
                [(&found.drift, v / w), (&found.shear, stiffness * v / w), (&found.acceleration, v * w)]
            {
                close(peak[0].value / value, 1.0, ROUNDING, &what);
                // A flat top is known to the root of rounding.
                close(peak[0].time, 0.5 * PI / w, 1e-7, &what);
            }
        }
    }
}

/// A step of ground acceleration a that ends before the first peak: u = (a/w^2) (1 - cos wt), all of which grows up to the
/// end. The time of each peak is the end, whatever the step of samples.
#[test]
fn what_grows_to_the_end_peaks_there() {
    let (mass, stiffness, a) = (1130.0, 4.37e5, 1.7);
    let w = f64::sqrt(stiffness / mass);
    let building = Building::new(vec![mass], vec![Storey::elastic(stiffness)], Damping::Modal { ratio: 0.0 }).unwrap();
    let scene = Scene::new(Some(Arc::new(building)), Vec::new()).unwrap();
    for samples in [2, 3, 7, 40, 300] {
        let end = 0.43 * TAU / w;
        let motion = Motion::new(vec![a; samples], end / (samples - 1) as f64, None).unwrap();
        for found in by_each_engine(&scene, &motion) {
            let (what, u) = (format!("{}, {samples} samples", found.engine), a / (w * w) * (1.0 - (w * end).cos()));
            for (peak, value) in [(&found.drift, u), (&found.shear, stiffness * u), (&found.acceleration, w * w * u)] {
                close(peak[0].value / value, 1.0, ROUNDING, &what);
                close(peak[0].time, end, 1e-14, &what);
            }
        }
    }
}

/// Blocks of one floor with equal coefficients, of different mass, are one block: they break away, wear and stop at the
/// same times, and slip alike.
#[test]
fn equal_blocks_move_as_one() {
    let storeys = vec![Storey::yielding(4.37e5, 5170.0)];
    let building = Arc::new(Building::new(vec![1130.0], storeys, Damping::Modal { ratio: 0.0413 }).unwrap());
    let waves = (0..400).map(|i| 3.1 * (0.083 * f64::from(i)).sin() + 2.3 * (0.131 * f64::from(i)).cos());
    let motion = Motion::new(waves.collect::<Vec<_>>(), 0.0107, None).unwrap();
    for (floor, mu_k) in [(0, 0.127), (0, 0.0953), (1, 0.127), (1, 0.0953)] {
        let wear =
            vec![Wear { path: 0.0217, mu_s: 0.113, mu_k: 0.0871 }, Wear { path: 0.0531, mu_s: 0.149, mu_k: 0.149 }];
        let block = |mass: f64| Block { mu_k, wear: wear.clone(), ..Block::new(floor, mass, 0.127) };
        let of = |masses: &[f64]| {
            let blocks = masses.iter().map(|&mass| block(mass)).collect();
            by_each_engine(&Scene::new(Some(Arc::clone(&building)), blocks).unwrap(), &motion)
        };
        for (three, one) in of(&[431.0, 173.0, 283.0]).iter().zip(of(&[887.0])) {
            let what = format!("{}, floor {floor}, mu_k {mu_k}", one.engine);
            let of_block = |outcome: &Outcome, number: usize| -> Vec<(EventKind, f64)> {
                let events = outcome.events.iter().filter(|(kind, n, _)| *kind != EventKind::Yield && *n == number);
                events.filter(|(kind, ..)| *kind != EventKind::Unload).map(|&(kind, _, time)| (kind, time)).collect()
            };
            let expected = of_block(&one, 1);
            assert!(expected.len() > 8, "{what}: {expected:?}");
            for number in 1..=3 {
                let found = of_block(three, number);
                assert_eq!(found, of_block(three, 1), "{what}: the events of block {number} are those of block 1");
                assert_eq!(three.residual_slip[number - 1], three.residual_slip[0], "{what}, block {number}");
                assert_eq!(found.len(), expected.len(), "{what}: {found:?} for {expected:?}");
                for (found, expected) in found.iter().zip(&expected) {
                    assert_eq!(found.0, expected.0, "{what}");
                    close(found.1, expected.1, 1e-11, &what);
                }
                close(three.residual_slip[number - 1], one.residual_slip[0], 1e-12, &what);
            }
        }
    }
}

/// Two blocks that slide towards each other at the same speed hold their floor still by friction of the same size. Their
/// coefficients change at the same instant, or the third block, which a third of that friction would release, slides.
#[test]
fn blocks_wear_together() {
    let storeys = vec![Storey::elastic(4.37e5)];
    let building = Arc::new(Building::new(vec![113.0], storeys, Damping::Modal { ratio: 0.0413 }).unwrap());
    let motion = Motion::new(vec![0.0; 121], 0.0107, None).unwrap();
    let thrown = |velocity: f64| Block {
        velocity: Some(velocity),
        wear: vec![Wear { path: 0.0217, mu_s: 0.113, mu_k: 0.0871 }],
        mu_k: 0.361,
        ..Block::new(1, 431.0, 0.397)
    };
    let stuck = Block { mu_k: 0.0313, ..Block::new(1, 17.3, 0.0331) };
    let scene = Scene::new(Some(building), vec![thrown(0.73), thrown(-0.73), stuck]).unwrap();
    for found in by_each_engine(&scene, &motion) {
        for number in [1, 2] {
            assert_eq!(found.times(EventKind::Wear, number).len(), 1, "{}", found.engine);
            assert_eq!(found.times(EventKind::Stick, number).len(), 1, "{}", found.engine);
        }
        assert_eq!(found.slip[2].value, 0.0, "{}: {:?}", found.engine, found.events);
    }
}

/// In flight at v against ground that accelerates by a, a block has slipped v^2/(2 a) where it turns, at v/a.
#[test]
fn a_slip_turns_in_flight_inside_a_step() {
    let (v, a) = (0.83, 1.9);
    for samples in [2, 4, 11] {
        let vertical = vec![-1.3 * G; samples].into();
        let motion = Motion::new(vec![a; samples], 0.61 / (samples - 1) as f64, Some(vertical)).unwrap();
        let block = Block { velocity: Some(v), ..Block::new(0, 3.1, 0.197) };
        for found in by_each_engine(&Scene::new(None, vec![block]).unwrap(), &motion) {
            close(found.slip[0].value, 0.5 * v * v / a, ROUNDING, found.engine);
            // A flat top is known to the root of rounding.
            close(found.slip[0].time, v / a, 1e-7, found.engine);
        }
    }
}
