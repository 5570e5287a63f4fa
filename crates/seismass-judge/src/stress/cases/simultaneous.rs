//! Events at one instant: symmetric scenes, equal blocks, both elements of a storey, contact lost by all.

use seismass::{Block, Damping, Event, EventKind, Motion, Response, STANDARD_GRAVITY, Scene, Storey, UniformBuilding};

use super::{
    Case, Outcome, building, checked, difference, expect_count, judged, motion, record, require, standing, text,
};
use crate::DoubleDouble;

const THEME: &str = "simultaneous";
/// Events of a symmetric scene are this close (s).
const ONE_INSTANT: f64 = 1e-10;

pub(super) const CASES: &[Case] = &[
    Case {
        theme: THEME,
        name: "five storeys vibrating in mode 1, mu proportional to the mode",
        expectation: "all blocks slip and stick together, each as in the equivalent oscillator, roof to 1e-9",
        run: blocks_in_mode,
    },
    Case {
        theme: THEME,
        name: "five storeys in mode 1, mu and both yield drifts proportional to the mode",
        expectation: "all storeys yield and unload together, all blocks slip together, roof as the oscillator to 1e-9",
        run: everything_in_mode,
    },
    Case {
        theme: THEME,
        name: "both elements of a storey unload and re-yield together",
        expectation: "after a small unloading yields 1 and 2 within 1e-12 s; judge to 1e-12",
        run: both_elements,
    },
    Case {
        theme: THEME,
        name: "fifty equal blocks on the ground",
        expectation: "fifty times the events of one, slips equal to the bit",
        run: fifty_blocks,
    },
    Case {
        theme: THEME,
        name: "all blocks of all floors lift and land together",
        expectation: "one lift and one land per block and loss of contact; judge to 1e-10",
        run: lift_and_land,
    },
];

const FLOORS: usize = 5;
const PERIOD: f64 = 0.8;
const ROOF_VELOCITY: f64 = 2.4;

/// Free vibration in mode 1 of a uniform building, and the oscillator of its roof. With a block of `alpha` floor masses
/// and of mu proportional to the mode on every floor, and springs that yield at drifts proportional to the mode's, all
/// forces stay proportional to it, and every floor moves as the oscillator does.
fn in_mode(mu: f64, yield_drift: f64) -> Result<(Scene, Scene), String> {
    let alpha = 0.8;
    let shape = |i: usize| {
        let angle = std::f64::consts::PI / (2 * FLOORS + 1) as f64;
        (i as f64 * angle).sin() / (FLOORS as f64 * angle).sin()
    };
    let damping = Damping::Modal { ratio: 0.02 };
    let spring = |stiffness: f64, drift: f64| Storey {
        overstrength: 1.5,
        second_slope: 0.3,
        third_slope: 0.1,
        ..Storey::yielding(stiffness, stiffness * drift)
    };
    let uniform = UniformBuilding { storeys: FLOORS, period: PERIOD, mass: 1.0, damping, ..Default::default() };
    let uniform = text(uniform.build())?;
    let storeys = uniform.storeys().iter().enumerate();
    let storeys = storeys.map(|(i, s)| spring(s.stiffness, yield_drift * (shape(i + 1) - shape(i)))).collect();
    let blocks = (1..=FLOORS).map(|i| Block::new(i, alpha, mu * shape(i))).collect();
    let velocity = (1..=FLOORS).map(|i| ROOF_VELOCITY * shape(i)).collect();
    let scene = standing(text(uniform.with_storeys(storeys))?, blocks)?;
    let scene = text(scene.with_initial(vec![0.0; FLOORS], velocity))?;
    let stiffness = (std::f64::consts::TAU / PERIOD).powi(2);
    let single = building(vec![1.0], vec![spring(stiffness, yield_drift)], 0.02)?;
    let single = standing(single, vec![Block::new(1, alpha, mu)])?;
    Ok((scene, text(single.with_initial(vec![0.0], vec![ROOF_VELOCITY]))?))
}

/// Checks that every event of the oscillator happens on every floor at its instant; the number of events.
fn together(response: &Response, single: &Response) -> Result<usize, String> {
    let log = |r: &Response| r.events.clone().unwrap_or_default();
    let (all, one) = (log(response), log(single));
    require(all.len() == FLOORS * one.len(), || format!("{} events for {FLOORS} x {}", all.len(), one.len()))?;
    for expected in &one {
        let same = |e: &&Event| {
            e.kind == expected.kind
                && e.sign == expected.sign
                && e.element == expected.element
                && (e.time - expected.time).abs() <= ONE_INSTANT
        };
        let found = all.iter().filter(same).count();
        require(found == FLOORS, || format!("{found} of {FLOORS} at {expected:?}"))?;
    }
    let roof = |r: &Response, n: usize| -> Vec<f64> {
        r.histories.as_ref().map(|h| h.drift.chunks(n).map(|d| d.iter().sum()).collect()).unwrap_or_default()
    };
    let roofs = difference(&roof(response, FLOORS), &roof(single, 1));
    require(roofs <= 1e-9, || format!("roofs differ by {roofs:.1e}"))?;
    Ok(one.len())
}

fn mode(mu: f64, yield_drift: f64, least: usize) -> Outcome {
    let (scene, single) = in_mode(mu, yield_drift)?;
    let motion = motion(vec![0.0; 401], 0.01)?;
    let (response, single) = (checked(&scene, &motion)?, checked(&single, &motion)?);
    let instants = together(&response, &single)?;
    require(instants >= least, || format!("only {instants} events of the oscillator"))?;
    Ok(format!("{instants} instants, {} events", response.statistics.events.total()))
}

fn blocks_in_mode() -> Outcome {
    mode(0.3, f64::INFINITY, 4)
}

fn everything_in_mode() -> Outcome {
    mode(0.3, 0.04, 8)
}

fn both_elements() -> Outcome {
    let storey = Storey { overstrength: 1.5, second_slope: 0.3, third_slope: 0.05, ..Storey::yielding(400.0, 2.0) };
    let scene = standing(building(vec![1.0], vec![storey], 0.05)?, vec![])?;
    // Pushed beyond second yield, braked until its velocity just turns, pushed on.
    let pushed = |brake: usize| motion([vec![-6.0; 16], vec![6.0; brake], vec![-9.0; 60]].concat(), 0.01);
    let turns = |brake: &usize| {
        let response = pushed(*brake).and_then(|motion| checked(&scene, &motion));
        response.is_ok_and(|r| r.statistics.events.of(EventKind::Unload) > 0)
    };
    let motion = pushed((1..30).find(turns).ok_or("no unload")?)?;
    let response = checked(&scene, &motion)?;
    let log = response.events.clone().unwrap_or_default();
    let unload = log.iter().position(|e| e.kind == EventKind::Unload).ok_or("no unload")?;
    let again: Vec<&Event> = log[unload..].iter().filter(|e| e.kind == EventKind::Yield).take(2).collect();
    let [first, second] = again[..] else { return Err("no second yield".into()) };
    let gap = second.time - first.time;
    require(first.element == 1 && second.element == 2 && gap <= 1e-12, || format!("{first:?}, {second:?}"))?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-12)?;
    Ok(format!("{} events, yields 1 and 2 {gap:.0e} s apart, judge {difference:.0e}", log.len()))
}

fn fifty_blocks() -> Outcome {
    let motion = motion(record(8, 1000, 0.01, 5.0), 0.01)?;
    let blocks = |number| text(Scene::new(None, vec![Block::new(0, 2.0, 0.12); number]));
    let (fifty, one) = (checked(&blocks(50)?, &motion)?, checked(&blocks(1)?, &motion)?);
    let (events, single) = (fifty.statistics.events.total(), one.statistics.events.total());
    require(events == 50 * single && single > 4, || format!("{events} events for 50 x {single}"))?;
    require(fifty.residual_slip.iter().all(|&s| s == one.residual_slip[0]), || "slips differ".into())?;
    Ok(format!("{events} = 50 x {single} events"))
}

fn lift_and_land() -> Outcome {
    let building = text(UniformBuilding { storeys: 4, period: 0.5, mass: 1.0, ..Default::default() }.build())?;
    let blocks: Vec<Block> = (0..=4).map(|i| Block::new(i, 0.5, 0.3)).collect();
    let number = blocks.len();
    let scene = standing(building, blocks)?;
    let (samples, dt) = (400, 0.01);
    let vertical: Vec<f64> = (0..samples).map(|i| -1.5 * STANDARD_GRAVITY * (0.06 * f64::from(i)).sin()).collect();
    let lost = vertical.windows(2).filter(|v| v[0] > -STANDARD_GRAVITY && v[1] <= -STANDARD_GRAVITY).count();
    let motion = text(Motion::new(record(9, samples as usize, dt, 4.0), dt, Some(vertical.into())))?;
    let response = checked(&scene, &motion)?;
    expect_count(&response, EventKind::Lift, number * lost)?;
    expect_count(&response, EventKind::Land, number * lost)?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-10)?;
    Ok(format!("{lost} losses of contact x {number} blocks, judge {difference:.0e}"))
}
