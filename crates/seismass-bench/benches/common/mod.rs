//! The scenes of the regression suites. They depend on nothing outside the repository and never change: a number
//! recorded once stays comparable.

use std::path::Path;
use std::sync::Arc;

use seismass::{Block, Damping, Motion, STANDARD_GRAVITY, Scene, Storey, UniformBuilding};

/// What can go wrong before anything is measured.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Names of all scenes, for [`case`].
pub const NAMES: [&str; 10] = [
    "plain, 4 storeys",
    "elastic, 4 storeys",
    "yielding, 4 storeys",
    "yielding, 5 storeys",
    "128 blocks, 4 storeys",
    "sliding, 3 storeys",
    "section 4, r2 = 0.05",
    "section 4, r2 = 0.5",
    "rayleigh, 12 storeys",
    "rayleigh, 100 storeys",
];

/// A scene and its motion.
pub struct Case {
    pub scene: Scene,
    pub motion: Motion,
}

/// A scene by name.
pub fn case(name: &str) -> Result<Case> {
    let modal = Damping::Modal { ratio: 0.05 };
    let rayleigh = Damping::Rayleigh { ratio: 0.05, modes: [1, 3] };
    let four = [0.24, 0.21, 0.16, 0.09];
    let (scene, peak_g) = match name {
        // Too weak for an event.
        "plain, 4 storeys" => (building(4, 0.57, modal, &four, 0.05, Some(0.3))?, 0.01),
        "elastic, 4 storeys" => (building(4, 0.57, modal, &[f64::INFINITY; 4], 0.05, None)?, 0.7),
        "yielding, 4 storeys" => (building(4, 0.57, modal, &four, 0.05, Some(0.3))?, 0.7),
        "yielding, 5 storeys" => (building(5, 0.57, modal, &[0.24, 0.22, 0.19, 0.15, 0.09], 0.05, Some(0.3))?, 0.7),
        "128 blocks, 4 storeys" => {
            let few = building(4, 0.57, modal, &four, 0.05, Some(0.3))?;
            // Beside those that act: too light to count, and stuck for good.
            let others = (4..128).map(|i| Block::new(1 + i % 4, 1e-3, 5.0));
            (Scene::new(few.building().cloned(), few.blocks().iter().cloned().chain(others).collect())?, 0.7)
        }
        "sliding, 3 storeys" => (building(3, 0.60, modal, &[0.24, 0.20, 0.12], 0.05, Some(0.05))?, 0.7),
        "section 4, r2 = 0.05" => (building(3, 0.60, modal, &[0.24, 0.20, 0.12], 0.05, Some(0.3))?, 0.7),
        "section 4, r2 = 0.5" => (building(3, 0.60, modal, &[0.24, 0.20, 0.12], 0.5, Some(0.3))?, 0.7),
        "rayleigh, 12 storeys" => (tall(12, rayleigh)?, 0.7),
        "rayleigh, 100 storeys" => (tall(100, rayleigh)?, 0.7),
        _ => return Err(format!("scene must be one of {NAMES:?}; got {name}").into()),
    };
    Ok(Case { scene, motion: motion(peak_g)? })
}

/// A uniform building of 1000 kg per floor with strengths over its weight, and a block of the same mass on each floor.
fn building(n: usize, period: f64, damping: Damping, strength: &[f64], slope: f64, mu: Option<f64>) -> Result<Scene> {
    let uniform = UniformBuilding { storeys: n, period, mass: 1000.0, damping, ..Default::default() }.build()?;
    let weight = STANDARD_GRAVITY * uniform.mass().iter().sum::<f64>();
    let storeys = uniform
        .storeys()
        .iter()
        .zip(strength)
        .map(|(storey, share)| Storey { second_slope: slope, ..Storey::yielding(storey.stiffness, share * weight) })
        .collect();
    let blocks = mu.map(|mu| (1..=n).map(|floor| Block::new(floor, 1000.0, mu)).collect()).unwrap_or_default();
    Ok(Scene::new(Some(Arc::new(uniform.with_storeys(storeys)?)), blocks)?)
}

/// Tall building whose period grows with its storeys and whose strengths fall linearly to the roof.
fn tall(n: usize, damping: Damping) -> Result<Scene> {
    let strength: Vec<f64> = (0..n).map(|i| 0.15 * (n - i) as f64 / n as f64).collect();
    building(n, 0.1 * n as f64, damping, &strength, 0.05, Some(0.2))
}

/// The third built-in motion, scaled to a peak (g).
pub fn motion(peak_g: f64) -> Result<Motion> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/synthetic/synthetic-3.AT2");
    let text = std::fs::read_to_string(path)?;
    let header = text.lines().nth(3).ok_or("the motion has no header")?;
    let dt = header.split("DT=").nth(1).and_then(|rest| rest.split_whitespace().next()).ok_or("no DT")?.parse()?;
    let words = text.lines().skip(4).flat_map(str::split_whitespace);
    let values = words.map(str::parse).collect::<std::result::Result<Vec<f64>, _>>()?;
    let peak = values.iter().fold(0.0f64, |peak, a| peak.max(a.abs()));
    let factor = peak_g * STANDARD_GRAVITY / peak;
    Ok(Motion::new(values.iter().map(|a| factor * a).collect::<Vec<_>>(), dt, None)?)
}
