//! Random shear buildings, solved by both engines.

use std::num::NonZeroUsize;

use rayon::prelude::*;
use seismass::{GeneralScene, Options, Response, simulate, simulate_general};

use crate::general::as_chain;
use crate::random_scene::random_scene;
use crate::{DoubleDouble, compare, compare_events, larger, solve};

/// Rounding grows along a motion, and more in a collapse: where the engines part by more than this of the largest peak of a
/// kind, the judge decides.
pub const PEAK: f64 = 1e-12;
/// Largest difference from the judge that counts as agreement.
const AGREEMENT: f64 = 1e-9;

/// What a comparison of both engines came to.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chains {
    /// Scenes compared.
    pub scenes: u64,
    /// Events of all of them.
    pub events: u64,
    /// Largest difference of those that agree within `PEAK`, and its seed.
    pub worst: (f64, u64),
    /// Seeds of those that part, of which the judge says that the general engine is right, or that neither is.
    pub judged: Vec<u64>,
    /// Those of which it says that the chain engine alone is right: seed, difference.
    pub defects: Vec<(u64, String)>,
}

/// One scene by both engines.
enum Found {
    Same(f64),
    /// The judge does not hold it against the general engine.
    Judged,
    Defect(String),
}

/// Solves the random shear buildings of these seeds with both engines.
pub fn compare_engines(seeds: std::ops::Range<u64>) -> Chains {
    let found: Vec<(u64, u64, Found)> = seeds.into_par_iter().map(both).collect();
    let mut chains = Chains::default();
    for (seed, events, found) in found {
        chains.scenes += 1;
        chains.events += events;
        match found {
            Found::Same(difference) if difference > chains.worst.0 => chains.worst = (difference, seed),
            Found::Same(_) => {}
            Found::Judged => chains.judged.push(seed),
            Found::Defect(difference) => chains.defects.push((seed, difference)),
        }
    }
    chains
}

fn both(seed: u64) -> (u64, u64, Found) {
    let options = Options { histories: NonZeroUsize::new(1), events: true, ..Options::default() };
    let solved = random_scene(seed).and_then(|(scene, motion)| {
        let chain = simulate(&scene, &motion, &options)?;
        let general = as_chain(simulate_general(&GeneralScene::from(&scene), &motion, &options)?, &chain);
        Ok((scene, motion, chain, general))
    });
    let (scene, motion, chain, mut general) = match solved {
        Ok(solved) => solved,
        Err(error) => return (seed, 0, Found::Defect(error.to_string())),
    };
    let events = chain.statistics.events.total() as u64;
    let difference = match apart(&general, &chain) {
        Ok(difference) if difference <= PEAK => return (seed, events, Found::Same(difference)),
        other => other,
    };
    // The general engine counts paths in contact alone.
    general.slip_path.clone_from(&chain.slip_path);
    let Ok(exact) = solve::<DoubleDouble>(&scene, &motion, 1) else {
        return (seed, events, Found::Defect("the judge failed".into()));
    };
    let [own, of_chain] = [&general, &chain].map(|response| compare(response, &exact).agrees(AGREEMENT));
    let found = if own || !of_chain { Found::Judged } else { Found::Defect(format!("{difference:?}")) };
    (seed, events, found)
}

/// Largest difference of lists over the largest value of the second.
fn deviation(found: &[f64], expected: &[f64]) -> f64 {
    let scale = expected.iter().fold(0.0, |scale, value| larger(scale, value.abs()));
    let worst = found.iter().zip(expected).fold(0.0, |worst, (f, e)| larger(worst, (f - e).abs()));
    if worst == 0.0 { 0.0 } else { worst / scale }
}

/// Largest difference of peaks and residuals, or the first mismatch of events or endings.
fn apart(one: &Response, other: &Response) -> Result<f64, String> {
    let lists = |r: &Response| {
        let peaks = [&r.peaks.drift, &r.peaks.slip, &r.peaks.floor_acceleration, &r.peaks.storey_shear];
        let values = peaks.map(|peaks| peaks.iter().map(|peak| peak.value).collect::<Vec<f64>>());
        values.into_iter().chain([r.residual_drift.clone(), r.residual_slip.clone()]).collect::<Vec<_>>()
    };
    let log = |r: &Response| r.events.clone().unwrap_or_default();
    compare_events(&log(one), &log(other))?;
    if std::mem::discriminant(&one.status) != std::mem::discriminant(&other.status) {
        return Err(format!("{:?} and {:?}", one.status, other.status));
    }
    Ok(lists(one).iter().zip(&lists(other)).fold(0.0, |worst, (f, e)| larger(worst, deviation(f, e))))
}
