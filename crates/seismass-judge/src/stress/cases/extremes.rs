//! Records that are no earthquake, and motions far too small and far too large.

use seismass::{
    Block, Building, EventKind, Motion, Options, STANDARD_GRAVITY, Scene, Storey, UniformBuilding, simulate,
};

use super::{
    Case, Outcome, checked, close, expect_count, expect_no_event, judged, motion, on_ground, oscillator, record,
    require, residual, standing, text,
};
use crate::DoubleDouble;

const THEME: &str = "records";

pub(super) const CASES: &[Case] = &[
    Case {
        theme: THEME,
        name: "a record of zeros",
        expectation: "no event, every peak, residual and energy exactly 0",
        run: zeros,
    },
    Case {
        theme: THEME,
        name: "exact zeros before, within and after a record",
        expectation: "the head changes nothing but time; blocks at rest in the gaps stay exactly; judge to 1e-11",
        run: gaps_of_zeros,
    },
    Case {
        theme: THEME,
        name: "a constant record",
        expectation: "undamped oscillator: peak 2 a / w2 at half a period, to 1e-13",
        run: constant,
    },
    Case {
        theme: THEME,
        name: "one sample, and two",
        expectation: "one: ends at 0 s, drifts and slips exactly 0, only the ground's block has let go; two: judge to 1e-12",
        run: one_sample,
    },
    Case {
        theme: THEME,
        name: "dt = 0.1 s on a building of T = 0.2 s, yielding and sliding",
        expectation: "events of the judge, numbers to 1e-10, as with dt = 0.025 s",
        run: long_steps,
    },
    Case {
        theme: THEME,
        name: "20 000 g",
        expectation: "finite, energy residual below 1e-11, events of the judge, numbers to 1e-9",
        run: twenty_thousand_g,
    },
    Case {
        theme: THEME,
        name: "1e-12 g",
        expectation: "no event; drifts 1e-12 times those of 1 g of the elastic building, to 1e-12; with mu and V_y as small: judge to 1e-11",
        run: tiny,
    },
    Case {
        theme: THEME,
        name: "everything scaled by 2^-300 and 2^300",
        expectation: "displacements scaled to the bit, events at equal times",
        run: powers_of_two,
    },
    Case {
        theme: THEME,
        name: "vertical motion takes contact away for three seconds",
        expectation: "one lift, one land; airborne slip -a t2 / 2 and braking of the closed form to 2 %, judge to 1e-11",
        run: three_seconds_airborne,
    },
];

fn building(yield_shear: f64) -> Result<Building, String> {
    let uniform = text(UniformBuilding { storeys: 3, period: 0.2, mass: 1.0, ..Default::default() }.build())?;
    let stiffness = uniform.storeys()[0].stiffness;
    text(uniform.with_storeys(vec![Storey::yielding(stiffness, yield_shear); 3]))
}

fn loaded(yield_shear: f64, mu: f64) -> Result<Scene, String> {
    standing(building(yield_shear)?, (0..=3).map(|floor| Block::new(floor, 0.8, mu)).collect())
}

fn zeros() -> Outcome {
    let response = checked(&loaded(4.0, 0.2)?, &motion(vec![0.0; 5000], 0.01)?)?;
    expect_no_event(&response)?;
    let peaks = &response.peaks;
    let lists = [&peaks.drift, &peaks.slip, &peaks.floor_acceleration, &peaks.storey_shear];
    let zero = lists.iter().all(|list| list.iter().all(|p| p.value == 0.0))
        && response.residual_drift.iter().chain(&response.residual_slip).all(|&v| v == 0.0)
        && response.energy.is_some_and(|e| e.input == 0.0 && e.relative_residual == 0.0);
    require(zero, || format!("not all zero: {:?}", response.energy))?;
    Ok("all exactly 0".into())
}

fn gaps_of_zeros() -> Outcome {
    let (dt, head) = (0.01, 700);
    let shaking = record(21, 300, dt, 6.0);
    let scene = loaded(4.0, 0.2)?;
    let once: Vec<f64> = [&[0.0][..], &shaking, &[0.0; 500], &shaking, &[0.0; 500]].concat();
    let late: Vec<f64> = [&vec![0.0; head][..], &once].concat();
    let once = motion(once, dt)?;
    let (a, b) = (checked(&scene, &once)?, checked(&scene, &motion(late, dt)?)?);
    require(a.residual_drift == b.residual_drift && a.residual_slip == b.residual_slip, || "the head matters".into())?;
    let difference = judged::<DoubleDouble>(&scene, &once, &a, 1e-11)?;
    Ok(format!("equal to the bit, {} events, judge {difference:.0e}", a.statistics.events.total()))
}

fn constant() -> Outcome {
    let (a, period) = (3.0, 0.7);
    let w = std::f64::consts::TAU / period;
    let response = checked(&oscillator(period, 0.0, vec![])?, &motion(vec![a; 1001], 0.01)?)?;
    let peak = response.peaks.drift[0];
    close("peak", peak.value, 2.0 * a / (w * w), 1e-13 * peak.value)?;
    let turns = (peak.time / period - 0.5).rem_euclid(1.0);
    require(turns.min(1.0 - turns) < 1e-6, || format!("peak at {} s", peak.time))?;
    Ok(format!("peak {:.9} m, residual {:.0e}", peak.value, residual(&response)))
}

fn one_sample() -> Outcome {
    let scene = loaded(4.0, 0.2)?;
    let response = checked(&scene, &motion(vec![9.0], 0.01)?)?;
    require(response.end_time == 0.0, || format!("ends at {} s", response.end_time))?;
    require(response.peaks.drift.iter().chain(&response.peaks.slip).all(|p| p.value == 0.0), || "a peak".into())?;
    expect_count(&response, EventKind::Slip, 1)?;
    let two = motion(vec![9.0, -3.0], 0.01)?;
    let both = checked(&scene, &two)?;
    let difference = judged::<DoubleDouble>(&scene, &two, &both, 1e-12)?;
    Ok(format!("one: {} events; two: judge {difference:.0e}", response.statistics.events.total()))
}

fn long_steps() -> Outcome {
    let (scene, samples) = (loaded(4.0, 0.2)?, record(22, 200, 0.1, 8.0));
    let fine: Vec<f64> = samples
        .windows(2)
        .flat_map(|pair| [0.0, 0.25, 0.5, 0.75].map(|part| pair[0] + (pair[1] - pair[0]) * part))
        .chain(samples.last().copied())
        .collect();
    let (coarse, fine) = (motion(samples, 0.1)?, motion(fine, 0.025)?);
    let (a, b) = (checked(&scene, &coarse)?, checked(&scene, &fine)?);
    let events = [&a, &b].map(|r| r.statistics.events.total());
    require(events[0] == events[1], || format!("{events:?} events"))?;
    let difference = judged::<DoubleDouble>(&scene, &coarse, &a, 1e-10)?;
    Ok(format!("{} events, judge {difference:.0e}", events[0]))
}

fn twenty_thousand_g() -> Outcome {
    let mut found = Vec::new();
    for (yield_shear, mu) in [(4.0, 0.2), (4e4, 2e3)] {
        let scene = loaded(yield_shear, mu)?;
        let motion = motion(record(23, 400, 0.01, 20_000.0 * STANDARD_GRAVITY), 0.01)?;
        let response = checked(&scene, &motion)?;
        let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-9)?;
        let events = response.statistics.events.total();
        found.push(format!("{events} events, residual {:.0e}, judge {difference:.0e}", residual(&response)));
    }
    Ok(found.join("; "))
}

fn tiny() -> Outcome {
    let samples = record(24, 400, 0.01, STANDARD_GRAVITY);
    let small: Vec<f64> = samples.iter().map(|a| 1e-12 * a).collect();
    let small = motion(small, 0.01)?;
    let response = checked(&loaded(4.0, 0.2)?, &small)?;
    expect_no_event(&response)?;
    let stuck = checked(&loaded(f64::INFINITY, 1e3)?, &motion(samples, 0.01)?)?;
    for (tiny, usual) in response.peaks.drift.iter().zip(&stuck.peaks.drift) {
        close("peak drift", tiny.value, 1e-12 * usual.value, 1e-24 * usual.value)?;
    }
    let scene = loaded(4e-12, 2e-13)?;
    let sliding = checked(&scene, &small)?;
    let difference = judged::<DoubleDouble>(&scene, &small, &sliding, 1e-11)?;
    Ok(format!("0 events; scaled: {} events, judge {difference:.0e}", sliding.statistics.events.total()))
}

fn powers_of_two() -> Outcome {
    let samples = record(25, 400, 0.01, 6.0);
    let options = Options { events: true, ..Options::default() };
    let solve = |factor: f64| {
        let samples: Vec<f64> = samples.iter().map(|a| factor * a).collect();
        text(simulate(&loaded(factor * 4.0, factor * 0.2)?, &motion(samples, 0.01)?, &options))
    };
    let usual = solve(1.0)?;
    // Below 1e-308 there are no more digits, above 1e308 no numbers; energies would square the factor.
    for power in [-300, 300] {
        let factor = 2f64.powi(power);
        let scaled = solve(factor)?;
        let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a * factor == *b);
        require(same(&usual.residual_drift, &scaled.residual_drift), || format!("drifts differ at 2^{power}"))?;
        require(same(&usual.residual_slip, &scaled.residual_slip), || format!("slips differ at 2^{power}"))?;
        require(usual.events == scaled.events, || format!("events differ at 2^{power}"))?;
    }
    Ok(format!("{} events", usual.statistics.events.total()))
}

fn three_seconds_airborne() -> Outcome {
    let (a, mu, dt) = (1.0, 0.3, 0.01);
    let vertical: Vec<f64> =
        (0..1001).map(|i| if (100..400).contains(&i) { -2.0 * STANDARD_GRAVITY } else { 0.0 }).collect();
    let motion = text(Motion::new(vec![a; 1001], dt, Some(vertical.into())))?;
    let scene = on_ground(Block::new(0, 1.0, mu))?;
    let response = checked(&scene, &motion)?;
    for kind in [EventKind::Slip, EventKind::Lift, EventKind::Land, EventKind::Stick] {
        expect_count(&response, kind, 1)?;
    }
    let slip = -4.5 - 9.0 / (2.0 * (mu * STANDARD_GRAVITY - a));
    close("slip", response.residual_slip[0], slip, 0.02 * slip.abs())?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
    Ok(format!("slip {:.4} m for {slip:.4}, judge {difference:.0e}", response.residual_slip[0]))
}
