//! Guards that are only just touched: at samples, between them, twice inside a step, and for seconds.

use seismass::{Block, EventKind, Motion, STANDARD_GRAVITY, Scene, Storey};

use super::{
    Case, Outcome, building, checked, close, difference, expect_count, expect_no_event, judged, motion, on_ground,
    oscillator, require, residual, standing, text, times,
};
use crate::DoubleDouble;

const THEME: &str = "grazing";
const MU: f64 = 0.3;
const LIMIT: f64 = MU * STANDARD_GRAVITY;
/// A slip that begins where the demand exceeds the limit by a fraction e grows as a power of e: a rounding r of the
/// input changes it by a few r / e.
const AT_UNIT_DEPTH: f64 = 1e-14;

pub(super) const CASES: &[Case] = &[
    Case {
        theme: THEME,
        name: "demand touches mu g at a sample and turns back",
        expectation: "no event, slip exactly 0",
        run: at_a_sample,
    },
    Case {
        theme: THEME,
        name: "demand touches mu g between samples (above by 1e-9, 1e-13; below by 1e-9, 1e-6)",
        expectation: "above: no event; below: slip at the closed-form time, events of the judge, numbers to 1e-14 over the depth",
        run: between_samples,
    },
    Case {
        theme: THEME,
        name: "demand touches mu g several times inside one step",
        expectation: "above by 1e-13: no event; below by 1e-9: two slips and more in the first step, events of the judge, numbers to 1e-5",
        run: inside_one_step,
    },
    Case {
        theme: THEME,
        name: "demand held at exactly mu g for 5 s, then 1 % more",
        expectation: "no event in the 5 s, one slip at their end, slip of the closed form to 1e-13",
        run: held,
    },
    Case {
        theme: THEME,
        name: "sine through the threshold with decaying amplitude",
        expectation: "slips exactly while the peaks exceed mu g; judge to 1e-11",
        run: decaying_sine,
    },
    Case {
        theme: THEME,
        name: "storey velocity touches zero while plastic",
        expectation: "neighbouring doubles on both sides differ by one unload and its yield, drifts to 1e-6, no cascade",
        run: plastic_velocity,
    },
    Case {
        theme: THEME,
        name: "storey held in equilibrium at exactly its yield force for 10 s",
        expectation: "drift stays to 1e-12, at most 2 events",
        run: held_at_yield,
    },
    Case {
        theme: THEME,
        name: "contact force touches zero and comes back",
        expectation: "a_v of exactly -g at one sample: block stuck at A = 0 stays where it is, slip exactly 0",
        run: contact_touches_zero,
    },
];

fn at_a_sample() -> Outcome {
    let samples = [0.0, 1.0, 0.0, -1.0, 0.5, 1.0, 1.0, -1.0, 0.0, 0.25, -1.0, -1.0, 0.0];
    let response = checked(&on_ground(Block::new(0, 1.0, MU))?, &motion(samples.map(|s| s * LIMIT).to_vec(), 0.01)?)?;
    expect_no_event(&response)?;
    Ok("0 events, slip 0".into())
}

/// Undamped free vibration of a storey with a stuck block of its mass: |A| peaks at w v0.
fn vibration(period: f64, excess: f64) -> Result<(Scene, f64), String> {
    let (velocity, frequency) = (0.5, std::f64::consts::TAU / period / 2f64.sqrt());
    let mu = frequency * velocity / STANDARD_GRAVITY * (1.0 + excess);
    let scene = oscillator(period, 0.0, vec![Block::new(1, 1.0, mu)])?;
    Ok((text(scene.with_initial(vec![0.0], vec![velocity]))?, frequency))
}

fn between_samples() -> Outcome {
    let motion = motion(vec![0.0; 501], 0.02)?;
    for excess in [1e-9, 1e-13] {
        expect_no_event(&checked(&vibration(0.5, excess)?.0, &motion)?)?;
    }
    let mut found = Vec::new();
    for excess in [-1e-9, -1e-6] {
        let (scene, frequency) = vibration(0.5, excess)?;
        let response = checked(&scene, &motion)?;
        let slip = times(&response, EventKind::Slip);
        let first = (1.0 + excess).asin() / frequency;
        close("first slip at", slip.first().copied().unwrap_or(f64::NAN), first, 1e-10)?;
        let difference = judged::<DoubleDouble>(&scene, &motion, &response, AT_UNIT_DEPTH / -excess)?;
        found.push(format!("{} slips, judge {difference:.0e}", slip.len()));
    }
    Ok(format!("above: 0 events; below: {}", found.join("; ")))
}

fn inside_one_step() -> Outcome {
    let motion = motion(vec![0.0; 11], 1.0)?;
    expect_no_event(&checked(&vibration(0.2, 1e-13)?.0, &motion)?)?;
    let (scene, _) = vibration(0.2, -1e-9)?;
    let response = checked(&scene, &motion)?;
    let first = times(&response, EventKind::Slip).iter().filter(|&&t| t < 1.0).count();
    require(first >= 2, || format!("{first} slips in the first step"))?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, AT_UNIT_DEPTH / 1e-9)?;
    Ok(format!("above: 0 events; below: {first} slips in the first step, judge {difference:.0e}"))
}

fn held() -> Outcome {
    let (dt, hold, after) = (0.01, 500, 100);
    let mut samples: Vec<f64> = (0..10).map(|i| LIMIT * f64::from(i) / 10.0).collect();
    samples.extend(vec![LIMIT; hold + 1]);
    let end = (samples.len() - 1) as f64 * dt;
    let more = 1.01 * LIMIT - LIMIT;
    samples.extend(vec![1.01 * LIMIT; after]);
    let mut found = Vec::new();
    for sign in [1.0, -1.0] {
        let samples = samples.iter().map(|s| sign * s).collect();
        let response = checked(&on_ground(Block::new(0, 1.0, MU))?, &motion(samples, dt)?)?;
        expect_count(&response, EventKind::Slip, 1)?;
        require(response.statistics.events.total() == 1, || "more than one event".into())?;
        close("slip at", times(&response, EventKind::Slip)[0], end, 1e-12)?;
        let t = (after - 1) as f64 * dt;
        let slip = -sign * more * (dt * dt / 6.0 + 0.5 * dt * t + 0.5 * t * t);
        close("slip", response.residual_slip[0], slip, 1e-13)?;
        found.push(response.residual_slip[0]);
    }
    Ok(format!("1 slip at {end} s each, {:.6} and {:.6} m", found[0], found[1]))
}

fn decaying_sine() -> Outcome {
    let (dt, frequency, decay) = (0.01, 12.0, 0.15);
    let at = |t: f64| 1.6 * LIMIT * (-decay * t).exp() * (frequency * t).sin();
    let samples: Vec<f64> = (0..=2000).map(|i| at(f64::from(i) * dt)).collect();
    let last = samples.iter().rposition(|a| a.abs() > LIMIT).unwrap_or(0) as f64 * dt;
    let (scene, motion) = (on_ground(Block::new(0, 1.0, MU))?, motion(samples, dt)?);
    let response = checked(&scene, &motion)?;
    let slips = times(&response, EventKind::Slip);
    let final_slip = slips.last().copied().unwrap_or(0.0);
    require(final_slip <= last && final_slip > last - 0.3, || format!("last slip at {final_slip}, peak at {last}"))?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
    Ok(format!("{} slips, the last at {final_slip:.3} s; judge {difference:.0e}", slips.len()))
}

fn plastic_velocity() -> Outcome {
    let storey = Storey { overstrength: 2.0, second_slope: 0.0, third_slope: 0.0, ..Storey::yielding(100.0, 1.0) };
    let scene = standing(building(vec![1.0], vec![storey], 0.0)?, vec![])?;
    // Pushed beyond yield, braked by `brake`, pushed again.
    let solve = |brake: f64| {
        let mut samples = vec![-5.0; 20];
        samples.extend(vec![brake; 15]);
        samples.extend(vec![-5.0; 20]);
        let motion = motion(samples, 0.01)?;
        let response = checked(&scene, &motion)?;
        Ok::<_, String>((response.statistics.events.of(EventKind::Unload), response, motion))
    };
    let (mut low, mut high) = (0.0, 20.0);
    let (few, many) = (solve(low)?.0, solve(high)?.0);
    require(many > few, || format!("{few} and {many} unloads at the ends"))?;
    while let middle = 0.5 * (low + high)
        && middle > low
        && middle < high
    {
        if solve(middle)?.0 > few { high = middle } else { low = middle }
    }
    let ((a, below, _), (b, above, _)) = (solve(low)?, solve(high)?);
    let yields = [&below, &above].map(|r| r.statistics.events.of(EventKind::Yield));
    require(b == a + 1 && yields[1] == yields[0] + 1, || format!("{a} and {b} unloads, {yields:?} yields"))?;
    let drifts = [&below, &above].map(|r| r.histories.as_ref().map(|h| h.drift.clone()).unwrap_or_default());
    let apart = difference(&drifts[0], &drifts[1]);
    require(apart <= 1e-6, || format!("drifts differ by {apart:.1e}"))?;
    Ok(format!("unloads {a} and {b}, yields {} and {}, drifts to {apart:.0e}", yields[0], yields[1]))
}

fn held_at_yield() -> Outcome {
    let mut most = 0;
    for (stiffness, strength) in [(100.0, 1.0), (93.7, 1.3), (1e7, 4321.1)] {
        let storey = Storey { second_slope: 0.0, ..Storey::yielding(stiffness, strength) };
        let scene = standing(building(vec![7.0], vec![storey], 0.02)?, vec![])?;
        let drift = strength / stiffness;
        let scene = text(scene.with_initial(vec![drift], vec![0.0]))?;
        let response = checked(&scene, &motion(vec![-strength / 7.0; 1001], 0.01)?)?;
        close("drift", response.residual_drift[0], drift, 1e-12 * drift)?;
        let events = response.statistics.events.total();
        require(events <= 2, || format!("{events} events"))?;
        most = most.max(events);
    }
    Ok(format!("at most {most} events"))
}

fn contact_touches_zero() -> Outcome {
    let samples = 101;
    let mut vertical = vec![0.0; samples];
    vertical[50] = -STANDARD_GRAVITY;
    let motion = text(Motion::new(vec![0.0; samples], 0.01, Some(vertical.into())))?;
    let response = checked(&on_ground(Block::new(0, 1.0, MU))?, &motion)?;
    require(response.slip_path[0] == 0.0, || format!("slip path {:e}", response.slip_path[0]))?;
    Ok(format!("{} events, slip 0, residual {:.0e}", response.statistics.events.total(), residual(&response)))
}
