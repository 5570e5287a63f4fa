//! Blocks that reverse, re-slip, share a floor, or have different static and kinetic friction.

use seismass::{Block, EventKind, STANDARD_GRAVITY};

use super::{
    Case, Outcome, checked, close, difference, expect_count, expect_no_event, judged, motion, on_ground, oscillator,
    record, require, text,
};
use crate::DoubleDouble;

const THEME: &str = "friction";

pub(super) const CASES: &[Case] = &[
    Case {
        theme: THEME,
        name: "slip reversal: thrown forward on a ground of constant 5 m/s2",
        expectation: "one reverse at w0 / (a + mu g), no stick, slip and path of the closed form to 1e-13",
        run: reversal,
    },
    Case {
        theme: THEME,
        name: "re-slip without sticking: square wave of 5 mu g",
        expectation: "one slip at the start, then reversals alone; judge to 1e-11",
        run: square_wave,
    },
    Case {
        theme: THEME,
        name: "mu_s > mu_k, demand between them",
        expectation: "at rest: no event; moving: slides on for ever, slip of the closed form to 1e-13",
        run: between_the_coefficients,
    },
    Case {
        theme: THEME,
        name: "mu_s = mu_k and mu_s just above: shaken oscillator",
        expectation: "judge to 1e-11 for mu_s / mu_k = 1, 1 + 1e-12, 1.001, 1.5, infinite (mu_k = 0)",
        run: static_above_kinetic,
    },
    Case {
        theme: THEME,
        name: "three blocks of equal mu on a floor",
        expectation: "slips equal to the bit, drift as with one block of their mass to 1e-12, three times its events",
        run: equal_blocks,
    },
    Case {
        theme: THEME,
        name: "ten blocks of different mu on a floor",
        expectation: "events of the judge, numbers to 1e-11; smoother blocks break away first",
        run: ten_blocks,
    },
];

fn reversal() -> Outcome {
    let (a, mu, w0, duration) = (5.0, 0.2, 1.0, 2.0);
    let limit = mu * STANDARD_GRAVITY;
    let block = Block { velocity: Some(w0), ..Block::new(0, 3.0, mu) };
    let response = checked(&on_ground(block.clone())?, &motion(vec![a; 201], 0.01)?)?;
    expect_count(&response, EventKind::Reverse, 1)?;
    require(response.statistics.events.total() == 1, || "more than one event".into())?;
    let turn = w0 / (a + limit);
    let (ahead, back) = (0.5 * w0 * turn, 0.5 * (a - limit) * (duration - turn).powi(2));
    close("slip", response.residual_slip[0], ahead - back, 1e-13)?;
    close("path", response.slip_path[0], ahead + back, 1e-13)?;
    Ok(format!("1 reverse, slip {:.6} m", response.residual_slip[0]))
}

fn square_wave() -> Outcome {
    let mu = 0.1;
    let level = 5.0 * mu * STANDARD_GRAVITY;
    let samples = (0..=800).map(|i| if (i / 40) % 2 == 0 { level } else { -level }).collect();
    let (scene, motion) = (on_ground(Block::new(0, 1.0, mu))?, motion(samples, 0.01)?);
    let response = checked(&scene, &motion)?;
    expect_count(&response, EventKind::Slip, 1)?;
    expect_count(&response, EventKind::Stick, 0)?;
    let reverses = response.statistics.events.of(EventKind::Reverse);
    require(reverses >= 10, || format!("{reverses} reversals"))?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
    Ok(format!("1 slip, {reverses} reversals, 0 sticks; judge {difference:.0e}"))
}

fn between_the_coefficients() -> Outcome {
    let (a, duration) = (0.4 * STANDARD_GRAVITY, 3.0);
    let motion = motion(vec![a; 301], 0.01)?;
    let block = Block { mu_k: 0.3, ..Block::new(0, 1.0, 0.5) };
    expect_no_event(&checked(&on_ground(block.clone())?, &motion)?)?;
    let moving = checked(&on_ground(Block { velocity: Some(-0.1), ..block })?, &motion)?;
    require(moving.statistics.events.total() == 0, || "an event of the moving block".into())?;
    let slip = -0.1 * duration - 0.5 * (a - 0.3 * STANDARD_GRAVITY) * duration * duration;
    close("slip", moving.residual_slip[0], slip, 1e-13 * slip.abs())?;
    Ok(format!("at rest 0; moving {:.6} m, 0 events", moving.residual_slip[0]))
}

fn static_above_kinetic() -> Outcome {
    let mut found = Vec::new();
    for (name, mu_k, mu_s) in [
        ("1", 0.2, 0.2),
        ("1+1e-12", 0.2, 0.2 * (1.0 + 1e-12)),
        ("1.001", 0.2, 0.2002),
        ("1.5", 0.2, 0.3),
        ("inf", 0.0, 0.2),
    ] {
        let block = Block { mu_k, ..Block::new(1, 0.7, mu_s) };
        let scene = oscillator(0.6, 0.05, vec![block])?;
        let motion = motion(record(11, 1000, 0.01, 6.0), 0.01)?;
        let response = checked(&scene, &motion)?;
        let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
        found.push(format!("{name}: {} events, {difference:.0e}", response.statistics.events.total()));
    }
    Ok(found.join("; "))
}

fn equal_blocks() -> Outcome {
    let motion = motion(record(5, 1500, 0.01, 6.0), 0.01)?;
    let three = [0.1, 0.25, 0.35].map(|mass| Block::new(1, mass, 0.15)).to_vec();
    let three = checked(&oscillator(0.5, 0.05, three)?, &motion)?;
    let one = checked(&oscillator(0.5, 0.05, vec![Block::new(1, 0.7, 0.15)])?, &motion)?;
    let (a, b) = (text(three.histories.as_ref().ok_or("no histories"))?, text(one.histories.as_ref().ok_or("none"))?);
    require(a.slip.chunks(3).all(|s| s[0] == s[1] && s[1] == s[2]), || "slips differ".into())?;
    let apart = difference(&a.drift, &b.drift);
    require(apart <= 1e-12, || format!("drifts differ by {apart:.1e}"))?;
    let (events, single) = (three.statistics.events.total(), one.statistics.events.total());
    require(events == 3 * single && single > 10, || format!("{events} events for 3 x {single}"))?;
    Ok(format!("{events} = 3 x {single} events, drift to {apart:.0e}"))
}

fn ten_blocks() -> Outcome {
    let motion = motion(record(6, 1000, 0.01, 7.0), 0.01)?;
    let blocks: Vec<Block> = (1..=10).map(|i| Block::new(1, 0.1, 0.06 * f64::from(i))).collect();
    let scene = oscillator(0.4, 0.05, blocks)?;
    let response = checked(&scene, &motion)?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
    let slipped = |number: usize| {
        let mut log = response.events.iter().flatten();
        log.find(|e| e.kind == EventKind::Slip && e.number == number).map_or(f64::INFINITY, |e| e.time)
    };
    let ordered = (1..10).all(|i| slipped(i) <= slipped(i + 1));
    require(ordered, || "a rougher block slipped first".into())?;
    Ok(format!("{} events, judge {difference:.0e}", response.statistics.events.total()))
}
