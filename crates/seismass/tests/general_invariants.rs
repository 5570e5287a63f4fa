//! What must hold for every scene with racks, walls and stops (`numerics`, section 8), on random ones.

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // What agrees with references is measured elsewhere.
mod general_compare;
mod general_random;
mod maximum;

use general_compare::{ENERGY, OPTIONS, compare_events, deviation, events, values};
use general_random::random_general;
use maximum::larger;
use seismass::{GeneralResponse, Motion, simulate_general};

const SEEDS: std::ops::Range<u64> = 0..150;

/// Rounding grows along a motion, most where blocks hit stiff stops: peaks agree to this fraction of the largest.
const SAME: f64 = 1e-9;

fn apart(one: &GeneralResponse, other: &GeneralResponse) -> f64 {
    [
        deviation(&values(&one.peaks.drift), &values(&other.peaks.drift)),
        deviation(&values(&one.peaks.acceleration), &values(&other.peaks.acceleration)),
        deviation(&values(&one.peaks.shear), &values(&other.peaks.shear)),
        deviation(&values(&one.peaks.slip), &values(&other.peaks.slip)),
        deviation(&values(&one.peaks.contact_force), &values(&other.peaks.contact_force)),
    ]
    .into_iter()
    .fold(0.0, larger)
}

/// A motion with each sample interval divided into four.
fn divided(motion: &Motion) -> Motion {
    let divide = |samples: &[f64]| -> Vec<f64> {
        let pairs = samples
            .windows(2)
            .flat_map(|pair| (0..4).map(|part| pair[0] + (pair[1] - pair[0]) * 0.25 * f64::from(part)));
        pairs.chain(samples.last().copied()).collect()
    };
    let vertical = motion.vertical().map(|samples| divide(samples).into());
    Motion::new(divide(motion.acceleration()), motion.dt() / 4.0, vertical).unwrap()
}

fn reversed(motion: &Motion) -> Motion {
    let samples: Vec<f64> = motion.acceleration().iter().map(|a| -a).collect();
    Motion::new(samples, motion.dt(), motion.vertical().map(|samples| samples.into())).unwrap()
}

#[test]
fn energies_balance() {
    let (mut worst, mut count, mut contacts) = (0.0, 0, 0);
    for seed in SEEDS {
        let (scene, motion) = random_general(seed);
        let response = simulate_general(&scene, &motion, &OPTIONS).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let residual = response.energy.unwrap().relative_residual.abs();
        assert!(residual < ENERGY, "seed {seed}: {residual:e}");
        worst = larger(worst, residual);
        count += response.statistics.events.total();
        contacts += response.statistics.events.of(seismass::EventKind::TouchStop);
    }
    println!("worst residual {worst:.1e}, {count} events, {contacts} of them touches of stops");
    assert!(contacts > 500);
}

/// To divide every sample interval by four changes the result by rounding, and the number of events not at all.
#[test]
fn divided_steps_give_the_same() {
    let mut worst = 0.0;
    for seed in SEEDS {
        let (scene, motion) = random_general(seed);
        let whole = simulate_general(&scene, &motion, &OPTIONS).unwrap();
        let parts = simulate_general(&scene, &divided(&motion), &OPTIONS).unwrap();
        let times = compare_events(events(&parts), events(&whole));
        assert!(times.is_ok(), "seed {seed}: {times:?}");
        let difference = apart(&parts, &whole);
        assert!(difference <= SAME, "seed {seed}: {difference:e}");
        worst = larger(worst, difference);
    }
    println!("worst difference {worst:.1e}");
}

/// The opposite motion gives the opposite response where stops are as far on both sides.
#[test]
fn the_opposite_motion_gives_the_opposite_response() {
    for seed in SEEDS {
        let (scene, motion) = random_general(seed);
        if scene.all_goods().any(|goods| goods.stops.is_some_and(|stops| stops.clearance[0] != stops.clearance[1])) {
            continue;
        }
        let one = simulate_general(&scene, &motion, &OPTIONS).unwrap();
        let other = simulate_general(&scene, &reversed(&motion), &OPTIONS).unwrap();
        assert_eq!(one.statistics.events, other.statistics.events, "seed {seed}");
        assert!(apart(&one, &other) <= SAME, "seed {seed}");
        let opposite: Vec<f64> = other.residual_slip.iter().map(|slip| -slip).collect();
        assert!(deviation(&opposite, &one.residual_slip) <= SAME, "seed {seed}");
    }
}
