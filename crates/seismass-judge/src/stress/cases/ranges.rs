//! Stiff and soft, light and heavy, weak and strong: parameters at the ends of their ranges.

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, EventKind, GravityEffect, Motion, Response, STANDARD_GRAVITY, Scene, Status, Storey,
    UniformBuilding,
};

use super::{
    Case, Outcome, building, checked, compared, difference, expect_count, expect_no_event, judged, largest, motion,
    oscillator, record, require, residual, standing, text,
};
use crate::{DoubleDouble, compare_events, larger};

const THEME: &str = "ranges";

pub(super) const CASES: &[Case] = &[
    Case {
        theme: THEME,
        name: "stiffness contrast 1e8, stiff on soft and soft on stiff, yielding and sliding",
        expectation: "events of the judge at its times to 1e-9; the drift of either storey to 1e-9 of its own peak",
        run: contrast,
    },
    Case {
        theme: THEME,
        name: "period 1e-4 s at dt = 0.01 s",
        expectation: "drift follows -a_g / w2 to the bound of the ramp's transient; energy residual below 1e-11",
        run: stiffest,
    },
    Case {
        theme: THEME,
        name: "24 storeys whose stiffest mode turns by 30 radians a step, and a storey a thousandth as stiff",
        expectation: "judge to 1e-9; energy residual below 1e-11",
        run: stiff_and_tall,
    },
    Case { theme: THEME, name: "period 100 s", expectation: "judge to 1e-11", run: softest },
    Case {
        theme: THEME,
        name: "alpha from 1e-9 to 1e6",
        expectation: "judge to 1e-10 each; at 1e-9 the drift is the bare building's to 1e-7",
        run: mass_ratios,
    },
    Case {
        theme: THEME,
        name: "mu = 0",
        expectation: "drift as without blocks to 1e-12, slip as of a block left behind, judge to 1e-11",
        run: no_friction,
    },
    Case {
        theme: THEME,
        name: "mu = 100",
        expectation: "no event under 5 g; drift as with the mass added to 1e-12",
        run: full_friction,
    },
    Case {
        theme: THEME,
        name: "V_y = 1e-9 W",
        expectation: "the floor stays behind: drift minus the ground displacement to 1e-6; judge to 1e-9",
        run: no_strength,
    },
    Case {
        theme: THEME,
        name: "V_y = infinity, 1e300 and r2 = r3 = 1",
        expectation: "no yield; as the elastic building: drifts to 1e-12, the same events at times to 1e-12 s",
        run: elastic_ends,
    },
    Case {
        theme: THEME,
        name: "ends of 0 <= r3 <= r2 <= 1, Omega = 1 and 2",
        expectation: "events of the judge, numbers to 1e-10",
        run: slopes,
    },
    Case {
        theme: THEME,
        name: "negative tangents by P-Delta",
        expectation: "collapses or completes as the judge does, all events at its times to 1e-9 s, numbers to 1e-8",
        run: p_delta,
    },
    Case {
        theme: THEME,
        name: "1 to 200 storeys, yielding and sliding",
        expectation: "energy residual below 1e-11; up to 20 storeys the events of the judge (double), numbers to 1e-9",
        run: heights,
    },
];

fn contrast() -> Outcome {
    let mut found = Vec::new();
    for [lower, upper] in [[40.0, 4e9], [4e9, 40.0]] {
        let spring = |k: f64| Storey { second_slope: 0.1, ..Storey::yielding(k, 1.5) };
        let scene = building(vec![1.0, 1.0], vec![spring(lower), spring(upper)], 0.05)?;
        let scene = standing(scene, (1..=2).map(|floor| Block::new(floor, 0.5, 0.1)).collect())?;
        let motion = motion(record(31, 40, 0.01, 8.0), 0.01)?;
        let response = checked(&scene, &motion)?;
        let exact = crate::solve::<DoubleDouble>(&scene, &motion, 1).map_err(|e| e.to_string())?;
        let comparison = crate::compare(&response, &exact);
        require(comparison.mismatch.is_none(), || format!("parts from the judge: {:?}", comparison.mismatch))?;
        let worst = (0..2).fold(comparison.worst_time(), |worst, i| {
            let [a, b] = [&response.peaks.drift, &exact.peaks.drift].map(|p| p[i].value);
            larger(worst, (a - b).abs() / b)
        });
        require(worst <= 1e-9, || format!("event times or peak drifts differ by {worst:.1e}"))?;
        found.push(format!("{} events, judge {worst:.0e}", response.statistics.events.total()));
    }
    Ok(found.join("; "))
}

fn stiffest() -> Outcome {
    let (period, dt) = (1e-4, 0.01);
    let w = std::f64::consts::TAU / period;
    let samples = record(32, 400, dt, 5.0);
    let slope = samples.windows(2).fold(0.0, |most, a| larger(most, (a[1] - a[0]).abs())) / dt;
    let response = checked(&oscillator(period, 0.05, vec![])?, &motion(samples.clone(), dt)?)?;
    let drifts = drifts(&response);
    // A kink of the ramp, and the start at a sample that is not zero, leave a vibration that dies within a step.
    let apart = drifts.iter().zip(&samples).skip(1).fold(0.0, |worst, (d, a)| larger(worst, (d + a / (w * w)).abs()));
    require(apart <= 3.0 * slope / w.powi(3), || format!("off by {apart:e} m"))?;
    Ok(format!("off by {:.0e} of the peak, residual {:.0e}", apart / largest(&drifts), residual(&response)))
}

/// Above 16 storeys a step is banded or full; where its phase is beyond what these take, it is solved by series. With
/// blocks of a thousand floors a motion is not divided into substeps.
fn stiff_and_tall() -> Outcome {
    let stiffness = (15.0f64 / 0.01).powi(2);
    let storey = |i: usize| {
        let k = if i == 3 { 1e-3 * stiffness } else { stiffness };
        Storey::yielding(k, if i == 3 { 40.0 } else { f64::INFINITY })
    };
    let building = building(vec![1.0; 24], (0..24).map(storey).collect(), 0.05)?;
    let scene = standing(building, vec![Block::new(2, 2e4, 0.4), Block::new(20, 1.0, 0.1)])?;
    let motion = motion(record(77, 60, 0.01, 6.0), 0.01)?;
    let response = checked(&scene, &motion)?;
    let difference = judged::<f64>(&scene, &motion, &response, 1e-9)?;
    Ok(format!("{} events, judge {difference:.0e}", response.statistics.events.total()))
}

fn softest() -> Outcome {
    let scene = oscillator(100.0, 0.05, vec![Block::new(1, 1.0, 1e-3)])?;
    let motion = motion(record(33, 1000, 0.01, 5.0), 0.01)?;
    let response = checked(&scene, &motion)?;
    let difference = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
    Ok(format!("{} events, judge {difference:.0e}", response.statistics.events.total()))
}

fn drifts(response: &Response) -> Vec<f64> {
    response.histories.as_ref().map(|h| h.drift.clone()).unwrap_or_default()
}

fn mass_ratios() -> Outcome {
    let motion = motion(record(34, 500, 0.01, 6.0), 0.01)?;
    let bare = drifts(&checked(&oscillator(0.5, 0.05, vec![])?, &motion)?);
    let mut found = Vec::new();
    for alpha in [1e-9, 1e-3, 1.0, 1e3, 1e6] {
        let scene = oscillator(0.5, 0.05, vec![Block::new(1, alpha, 0.2)])?;
        let response = checked(&scene, &motion)?;
        let worst = judged::<DoubleDouble>(&scene, &motion, &response, 1e-10)?;
        if alpha == 1e-9 {
            let apart = difference(&drifts(&response), &bare);
            require(apart <= 1e-7, || format!("bare drift differs by {apart:.1e}"))?;
        }
        found.push(format!("{alpha:e}: {} events, {worst:.0e}", response.statistics.events.total()));
    }
    Ok(found.join("; "))
}

fn no_friction() -> Outcome {
    let motion = motion(record(35, 500, 0.01, 6.0), 0.01)?;
    let scene = oscillator(0.5, 0.05, vec![Block::new(1, 2.0, 0.0)])?;
    let response = checked(&scene, &motion)?;
    let bare = checked(&oscillator(0.5, 0.05, vec![])?, &motion)?;
    let apart = difference(&drifts(&response), &drifts(&bare));
    require(apart <= 1e-12, || format!("drifts differ by {apart:.1e}"))?;
    // The block keeps its place in space: its slip is minus the displacements of ground and floor.
    let (mut velocity, mut ground) = (0.0, 0.0);
    for a in motion.acceleration().windows(2) {
        let dt = motion.dt();
        ground += velocity * dt + (2.0 * a[0] + a[1]) * dt * dt / 6.0;
        velocity += 0.5 * (a[0] + a[1]) * dt;
    }
    let expected = -ground - response.residual_drift[0];
    let off = (response.residual_slip[0] - expected).abs();
    require(off <= 1e-12 * response.peaks.slip[0].value, || format!("slip off by {off:e} m"))?;
    let worst = judged::<DoubleDouble>(&scene, &motion, &response, 1e-11)?;
    Ok(format!("drift to {apart:.0e}, slip to {off:.0e} m, judge {worst:.0e}"))
}

fn full_friction() -> Outcome {
    let motion = motion(record(36, 800, 0.01, 5.0 * STANDARD_GRAVITY), 0.01)?;
    let stiffness = 200.0;
    let light = building(vec![1.0], vec![Storey::elastic(stiffness)], 0.05)?;
    let damping = light.damping_matrix();
    let heavy = text(Building::new(vec![4.0], vec![Storey::elastic(stiffness)], Damping::Matrix(damping)))?;
    let stuck = checked(&standing(light, vec![Block::new(1, 3.0, 100.0)])?, &motion)?;
    expect_no_event(&stuck)?;
    let apart = difference(&drifts(&stuck), &drifts(&checked(&standing(heavy, vec![])?, &motion)?));
    require(apart <= 1e-12, || format!("drifts differ by {apart:.1e}"))?;
    Ok(format!("0 events, drift to {apart:.0e}"))
}

fn no_strength() -> Outcome {
    let storey = Storey { second_slope: 0.0, ..Storey::yielding(150.0, 1e-9 * STANDARD_GRAVITY) };
    let scene = standing(building(vec![1.0], vec![storey], 0.0)?, vec![])?;
    let motion = motion(record(37, 500, 0.01, 6.0), 0.01)?;
    let response = checked(&scene, &motion)?;
    let dt = motion.dt();
    let (mut velocity, mut ground, mut apart) = (0.0, 0.0, 0.0);
    let drifts = drifts(&response);
    for (a, drift) in motion.acceleration().windows(2).zip(&drifts[1..]) {
        ground += velocity * dt + (2.0 * a[0] + a[1]) * dt * dt / 6.0;
        velocity += 0.5 * (a[0] + a[1]) * dt;
        apart = larger(apart, (drift + ground).abs());
    }
    apart /= largest(&drifts);
    require(apart <= 1e-6, || format!("off by {apart:.1e} of the peak"))?;
    let worst = judged::<DoubleDouble>(&scene, &motion, &response, 1e-9)?;
    Ok(format!("off by {apart:.0e}, {} events, judge {worst:.0e}", response.statistics.events.total()))
}

fn elastic_ends() -> Outcome {
    let motion = motion(record(38, 600, 0.01, 8.0), 0.01)?;
    let solve = |storey: Storey| {
        let blocks = vec![Block::new(2, 1.0, 0.15)];
        checked(&standing(building(vec![1.0; 2], vec![storey; 2], 0.05)?, blocks)?, &motion)
    };
    let elastic = solve(Storey::elastic(300.0))?;
    let ends = [
        Storey::yielding(300.0, 1e300),
        Storey { second_slope: 1.0, third_slope: 1.0, ..Storey::yielding(300.0, 0.5) },
        Storey { overstrength: 1.0, second_slope: 1.0, third_slope: 1.0, ..Storey::yielding(300.0, 0.5) },
    ];
    let (mut worst, mut worst_time) = (0.0, 0.0);
    for end in ends {
        let response = solve(end)?;
        expect_count(&response, EventKind::Yield, 0)?;
        let [found, expected] = [&response, &elastic].map(|r| r.events.as_deref().unwrap_or_default());
        worst_time = larger(worst_time, compare_events(found, expected)?);
        worst = larger(worst, difference(&drifts(&response), &drifts(&elastic)));
    }
    require(worst <= 1e-12, || format!("drifts differ by {worst:.1e}"))?;
    require(worst_time <= 1e-12, || format!("event times differ by {worst_time:.1e} s"))?;
    let events = elastic.statistics.events.total();
    Ok(format!("0 yields, {events} events at times to {worst_time:.0e} s, drifts to {worst:.0e}"))
}

fn slopes() -> Outcome {
    let motion = motion(record(39, 500, 0.01, 6.0), 0.01)?;
    let (mut worst, mut events) = (0.0, 0);
    for (second_slope, third_slope) in [(0.0, 0.0), (1e-12, 0.0), (0.3, 0.3), (0.3, 0.0), (1.0, 0.0), (1.0, 1.0)] {
        for overstrength in [1.0, 1.0 + 1e-12, 2.0] {
            let storey = Storey { overstrength, second_slope, third_slope, ..Storey::yielding(300.0, 2.5) };
            let storeys = building(vec![1.0; 2], vec![storey; 2], 0.05)?;
            let scene = standing(storeys, vec![Block::new(1, 0.5, 0.2), Block::new(2, 0.5, 0.2)])?;
            let spring = |fault: String| format!("r2 {second_slope}, r3 {third_slope}, Omega {overstrength}: {fault}");
            let response = checked(&scene, &motion).map_err(spring)?;
            let found = judged::<DoubleDouble>(&scene, &motion, &response, 1e-10).map_err(spring)?;
            worst = larger(worst, found);
            events += response.statistics.events.total();
        }
    }
    Ok(format!("18 springs, {events} events, judge {worst:.0e}"))
}

fn p_delta() -> Outcome {
    let mut found = Vec::new();
    for (geometric, peak) in [(0.02, 6.0), (0.1, 6.0), (0.5, 3.0), (0.99, 0.5), (0.999_999, 0.01)] {
        let storey = Storey { third_slope: 0.0, ..Storey::yielding(300.0, 3.0) };
        let bare = building(vec![1.0; 3], vec![storey; 3], 0.05)?;
        let gravity = GravityEffect::GeometricStiffness(vec![300.0 * geometric; 3]);
        let building = Arc::new(text(bare.with_gravity(gravity))?);
        let scene = text(Scene::new(Some(building), (1..=3).map(|i| Block::new(i, 0.5, 0.2)).collect()))?;
        let motion = motion(record(40, 800, 0.01, peak), 0.01)?;
        let response = checked(&scene, &motion)?;
        let comparison = compared::<DoubleDouble>(&scene, &motion, &response)?;
        let (worst, time) = (comparison.worst(), comparison.event_time);
        require(worst <= 1e-8, || format!("differs from the judge by {worst:.1e}"))?;
        require(time <= 1e-9, || format!("event times differ from the judge's by {time:.1e} s"))?;
        let ending = match response.status {
            Status::Completed => "completed".into(),
            Status::Collapsed { storey, time } => format!("storey {storey} at {time:.3} s"),
        };
        found.push(format!("P/h = {geometric} k: {ending}, judge {worst:.0e}, {time:.0e} s"));
    }
    Ok(found.join("; "))
}

fn tower(storeys: usize) -> Result<Scene, String> {
    // Rayleigh beyond 50 storeys: modal damping is a full matrix.
    let damping =
        if storeys > 50 { Damping::Rayleigh { ratio: 0.05, modes: [1, 3] } } else { Damping::Modal { ratio: 0.05 } };
    let uniform = text(
        UniformBuilding { storeys, period: 0.1 * storeys as f64, mass: 1.0, damping, ..Default::default() }.build(),
    )?;
    let springs = uniform.storeys().iter().enumerate().map(|(i, s)| Storey {
        second_slope: 0.3,
        ..Storey::yielding(
            s.stiffness,
            0.06 * STANDARD_GRAVITY * ((storeys - i) as f64).sqrt() * (storeys as f64).sqrt(),
        )
    });
    let springs = springs.collect();
    let blocks = (1..storeys.max(2)).map(|floor| Block::new(floor, 0.5, 0.1)).collect();
    standing(text(uniform.with_storeys(springs))?, blocks)
}

fn heights() -> Outcome {
    let mut found = Vec::new();
    for storeys in [1, 2, 5, 10, 20, 50, 100, 200] {
        let scene = tower(storeys)?;
        let motion: Motion = motion(record(44, if storeys > 20 { 100 } else { 400 }, 0.02, 4.0), 0.02)?;
        let response = checked(&scene, &motion)?;
        let events = response.statistics.events.total();
        if storeys <= 20 {
            let worst = judged::<f64>(&scene, &motion, &response, 1e-9)?;
            found.push(format!("{storeys}: {events} events, {worst:.0e}"));
        } else {
            found.push(format!("{storeys}: {events} events, residual {:.0e}", residual(&response)));
        }
    }
    Ok(found.join("; "))
}
