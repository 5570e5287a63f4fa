//! Validated input of a run: building, blocks, scene, motion and options. What exists is valid.

use std::fmt::{Display, Formatter};
use std::sync::Arc;

use nalgebra::DMatrix;

use crate::STANDARD_GRAVITY;
use crate::damping::{StoreyDamping, natural_frequencies};
use crate::error::{Domain, Error, Result};

/// Longest motion a run takes (samples): 0.8 GB.
pub const MAX_SAMPLES: usize = 100_000_000;
/// Most storeys of a building: a full damping matrix takes 8 MB.
pub const MAX_STOREYS: usize = 1000;

/// A storey, floor or block by its index, named by its number where an error is written: a grid has a scene per row,
/// and names formed in advance would cost more than its checks.
#[derive(Clone, Copy)]
pub(crate) struct Nth(pub(crate) &'static str, pub(crate) usize);

impl Display for Nth {
    fn fmt(&self, out: &mut Formatter) -> std::fmt::Result {
        write!(out, "{} {}", self.0, self.1 + 1)
    }
}

fn check(ok: bool, parameter: &str, owner: impl Display, requirement: impl Display, value: f64) -> Result<()> {
    if ok { Ok(()) } else { Err(refusal(parameter, &owner, &requirement, value)) }
}

#[cold]
fn refusal(parameter: &str, owner: &dyn Display, requirement: &dyn Display, value: f64) -> Error {
    Error::invalid(Domain::Scene, parameter, owner.to_string(), requirement.to_string(), value)
}

fn check_storeys(count: usize) -> Result<()> {
    check(count <= MAX_STOREYS, "storeys", "building", format_args!("at most {MAX_STOREYS}"), count as f64)
}

fn check_length(parameter: &str, owner: &str, expected: usize, of: &str, got: usize) -> Result<()> {
    if expected == got {
        Ok(())
    } else {
        Err(Error::invalid(
            Domain::Scene,
            parameter,
            owner,
            format!("a list of {expected} values, one per {of}"),
            format!("{got} values"),
        ))
    }
}

/// Most points of a multilinear backbone.
pub const MAX_BACKBONE_POINTS: usize = 100;
/// Slopes of a backbone that differ by less than this, relatively, are those of points on a line, but for rounding.
pub(crate) const SAME_SLOPE: f64 = 1e-9;
/// Most changes of a block's friction coefficients over its slip path.
pub const MAX_WEAR_STAGES: usize = 100;

/// The law of a storey's lateral spring (`numerics`, section 3): piecewise linear, so that the response between events is
/// solved in closed form.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum SpringLaw {
    /// Trilinear backbone with Masing unloading (paper, Fig. 3).
    #[default]
    Trilinear,
    /// Backbone through points with Masing unloading: elastic-perfectly-plastic elements in parallel (Iwan 1966). Slope
    /// and strength of the [`Storey`] are those of the first segment; overstrength and slopes play no part.
    Multilinear {
        /// Drifts (m) and forces (N), both increasing from the origin, which is not given, with slopes that do not
        /// increase; beyond the last point its segment goes on.
        backbone: Arc<[[f64; 2]]>,
    },
    /// The trilinear spring beside an elastic stop on each side, which touches where the drift exceeds a clearance.
    Gap {
        /// Clearance of the storey to either side (m).
        clearance: f64,
        /// Stiffness of a stop (N/m), added to that of the spring while it touches.
        stop_stiffness: f64,
    },
    /// Peak-oriented hysteresis (Clough and Johnston 1966) on the trilinear backbone, whose third slope may be negative.
    PeakOriented(PeakOriented),
}

/// Unloading, strength loss and residual strength of a peak-oriented spring.
///
/// Unloading goes down to zero force with the stiffness k (d_y / d_max)^a (Takeda, Sozen and Nielsen 1970; a = 0: Clough),
/// or F_max / d_max where that is larger, so that it ends before the origin. Reloading goes straight to the point of the
/// largest drift in that direction so far. Each half cycle between two zeros of the force lowers the force of the point that
/// the next one aims at by the factor 1 - E_i / (lambda V_y d_y - sum of E_j), E_i the energy dissipated in it and E_j in it
/// and those before (Rahnama and Krawinkler 1993, exponent 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeakOriented {
    /// Exponent a of the unloading stiffness, 0 <= a < 1.
    pub unloading_exponent: f64,
    /// Energy that a storey can dissipate, lambda, over yield force times yield drift; infinite: no cyclic loss.
    pub energy_capacity: f64,
    /// Residual strength over the first yield shear, 0 to 1: strength does not fall below it.
    pub residual_strength: f64,
}

impl Default for PeakOriented {
    /// Clough's unloading, no cyclic loss, no residual strength.
    fn default() -> Self {
        Self { unloading_exponent: 0.0, energy_capacity: f64::INFINITY, residual_strength: 0.0 }
    }
}

/// A storey's lateral spring: a trilinear backbone and a law.
///
/// Slope `stiffness` up to `yield_shear`, `second_slope * stiffness` up to `overstrength * yield_shear`,
/// `third_slope * stiffness` beyond.
#[derive(Debug, Clone, PartialEq)]
pub struct Storey {
    /// Initial stiffness k (N/m).
    pub stiffness: f64,
    /// First yield shear V_y (N); infinite: the storey stays elastic.
    pub yield_shear: f64,
    /// Overstrength factor Omega >= 1.
    pub overstrength: f64,
    /// Second slope over the first, r2.
    pub second_slope: f64,
    /// Third slope over the first, r3, with 0 <= r3 <= r2 <= 1; from -1 on with a peak-oriented law.
    pub third_slope: f64,
    /// The law of the spring.
    pub law: SpringLaw,
}

impl Storey {
    /// Default overstrength Omega, of the paper's section 4.
    pub const DEFAULT_OVERSTRENGTH: f64 = 2.0;
    /// Default second slope r2: an inference, not the paper's number.
    pub const DEFAULT_SECOND_SLOPE: f64 = 0.05;
    /// Default third slope r3: an inference, not the paper's number.
    pub const DEFAULT_THIRD_SLOPE: f64 = 0.0;

    /// A storey that never yields.
    pub fn elastic(stiffness: f64) -> Self {
        Self::yielding(stiffness, f64::INFINITY)
    }

    /// A storey with the default overstrength and slopes.
    pub fn yielding(stiffness: f64, yield_shear: f64) -> Self {
        Self {
            stiffness,
            yield_shear,
            overstrength: Self::DEFAULT_OVERSTRENGTH,
            second_slope: Self::DEFAULT_SECOND_SLOPE,
            third_slope: Self::DEFAULT_THIRD_SLOPE,
            law: SpringLaw::Trilinear,
        }
    }

    /// A storey whose backbone goes from the origin through points of drift (m) and force (N), with Masing unloading.
    ///
    /// A list that is no backbone is refused by [`Building::new`].
    pub fn multilinear(backbone: impl Into<Arc<[[f64; 2]]>>) -> Self {
        let backbone = backbone.into();
        let [drift, force] = backbone.first().copied().unwrap_or([f64::NAN; 2]);
        let yield_shear = if backbone.len() > 1 { force } else { f64::INFINITY };
        Self { law: SpringLaw::Multilinear { backbone }, ..Self::yielding(force / drift, yield_shear) }
    }

    /// Largest drift (m) up to which the virgin storey is linear.
    pub fn elastic_drift(&self) -> f64 {
        let limit = self.yield_shear / self.stiffness;
        match self.law {
            SpringLaw::Gap { clearance, .. } => limit.min(clearance),
            _ => limit,
        }
    }

    /// Largest slope of the spring (N/m).
    pub fn largest_stiffness(&self) -> f64 {
        match self.law {
            SpringLaw::Gap { stop_stiffness, .. } => self.stiffness + stop_stiffness,
            _ => self.stiffness,
        }
    }

    pub(crate) fn validate(&self, owner: impl Display + Copy) -> Result<()> {
        let &Self { stiffness: k, yield_shear: vy, overstrength: omega, second_slope: r2, third_slope: r3, ref law } =
            self;
        if let SpringLaw::Multilinear { backbone } = law {
            check_backbone(backbone, owner)?;
        }
        check(k.is_finite() && k > 0.0, "stiffness", owner, "a positive number", k)?;
        check(vy > 0.0, "yield_shear", owner, "positive (infinite: elastic)", vy)?;
        check(omega.is_finite() && omega >= 1.0, "overstrength", owner, "finite and at least 1", omega)?;
        check((0.0..=1.0).contains(&r2), "second_slope", owner, "between 0 and 1", r2)?;
        let least = if matches!(law, SpringLaw::PeakOriented(_)) { -1.0 } else { 0.0 };
        let requirement = format_args!("between {least} and the second slope {r2}");
        check((least..=r2).contains(&r3), "third_slope", owner, requirement, r3)?;
        match law {
            SpringLaw::Trilinear => Ok(()),
            SpringLaw::Multilinear { backbone } => check_first_segment(self, backbone, owner),
            SpringLaw::Gap { clearance, stop_stiffness } => {
                let positive = |value: f64| value.is_finite() && value > 0.0;
                check(positive(*clearance), "clearance", owner, "a positive number", *clearance)?;
                check(positive(*stop_stiffness), "stop_stiffness", owner, "a positive number", *stop_stiffness)
            }
            SpringLaw::PeakOriented(law) => law.validate(owner),
        }
    }
}

impl PeakOriented {
    fn validate(&self, owner: impl Display + Copy) -> Result<()> {
        let &Self { unloading_exponent: a, energy_capacity: capacity, residual_strength: residual } = self;
        check((0.0..1.0).contains(&a), "unloading_exponent", owner, "at least 0 and below 1", a)?;
        check(capacity > 0.0, "energy_capacity", owner, "positive (infinite: no cyclic loss)", capacity)?;
        check((0.0..=1.0).contains(&residual), "residual_strength", owner, "between 0 and 1", residual)
    }
}

/// Whether points are a backbone: drifts increase, forces do not decrease, slopes do not increase.
fn check_backbone(points: &[[f64; 2]], owner: impl Display + Copy) -> Result<()> {
    let (count, name) = (points.len(), "number of backbone points");
    let requirement = format_args!("1 to {MAX_BACKBONE_POINTS}");
    check((1..=MAX_BACKBONE_POINTS).contains(&count), name, owner, requirement, count as f64)?;
    let ([mut drift, mut force], mut slope) = ([0.0; 2], f64::INFINITY);
    for (i, &[next_drift, next_force]) in points.iter().enumerate() {
        let name = |what: &str| format!("{what} of backbone point {}", i + 1);
        let beyond = next_drift.is_finite() && next_drift > drift;
        check(beyond, &name("drift"), owner, format_args!("finite and above {drift} m"), next_drift)?;
        let is_force = next_force.is_finite() && next_force >= force && next_force > 0.0;
        check(is_force, &name("force"), owner, format_args!("finite, positive and not below {force} N"), next_force)?;
        let next_slope = (next_force - force) / (next_drift - drift);
        let falls = next_slope <= slope * (1.0 + SAME_SLOPE);
        let requirement = format_args!("not above {slope} N/m, that of the segment before");
        check(falls, &name("slope of the segment"), owner, requirement, next_slope)?;
        ([drift, force], slope) = ([next_drift, next_force], next_slope);
    }
    Ok(())
}

/// Whether slope and strength of a storey are those of its backbone's first segment.
fn check_first_segment(storey: &Storey, backbone: &Arc<[[f64; 2]]>, owner: impl Display + Copy) -> Result<()> {
    let of_backbone = Storey::multilinear(Arc::clone(backbone));
    let (k, vy) = (of_backbone.stiffness, of_backbone.yield_shear);
    let first = format_args!("{k} N/m, that of the backbone's first segment");
    check(storey.stiffness == k, "stiffness", owner, first, storey.stiffness)?;
    let first = format_args!("{vy} N, that of the backbone's first point");
    check(storey.yield_shear == vy, "yield_shear", owner, first, storey.yield_shear)
}

/// How the damping matrix C of the bare building is made; it stays constant through yielding and sliding.
#[derive(Debug, Clone, PartialEq)]
pub enum Damping {
    /// This ratio of critical damping in every vibration mode.
    Modal {
        /// Damping ratio: 0.05 for 5 %.
        ratio: f64,
    },
    /// C = a M + b K with this ratio in two modes.
    Rayleigh {
        /// Damping ratio in both modes.
        ratio: f64,
        /// The two modes, counted from 1.
        modes: [usize; 2],
    },
    /// A symmetric matrix in floor coordinates (N s/m).
    Matrix(DMatrix<f64>),
}

/// Where the P-Delta effect comes from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum GravityEffect {
    /// No P-Delta.
    #[default]
    None,
    /// P/h of each storey (N/m), finished.
    GeometricStiffness(Vec<f64>),
    /// P of a storey is the gravity load of all floors above it, the weight of their blocks included.
    Loads {
        /// Height of each storey (m).
        heights: Vec<f64>,
        /// Gravity load of each floor without blocks (N).
        floor_loads: Vec<f64>,
    },
}

/// A shear building: lumped floor masses, storey springs, damping.
#[derive(Debug, Clone, PartialEq)]
pub struct Building {
    mass: Vec<f64>,
    storeys: Vec<Storey>,
    damping: Damping,
    gravity: GravityEffect,
    storey_damping: StoreyDamping,
}

impl Building {
    /// A building of `mass.len()` floors.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a number is out of its range.
    pub fn new(mass: Vec<f64>, storeys: Vec<Storey>, damping: Damping) -> Result<Self> {
        if mass.is_empty() {
            return Err(Error::invalid(Domain::Scene, "mass", "building", "a list of at least one floor mass", "none"));
        }
        check_storeys(mass.len())?;
        check_length("stiffness", "building", mass.len(), "storey", storeys.len())?;
        for (i, (&m, storey)) in mass.iter().zip(&storeys).enumerate() {
            check(m.is_finite() && m > 0.0, "mass", Nth("floor", i), "a positive number", m)?;
            storey.validate(Nth("storey", i))?;
        }
        let stiffness: Vec<f64> = storeys.iter().map(|s| s.stiffness).collect();
        let storey_damping = StoreyDamping::new(&mass, &stiffness, &damping)?;
        Ok(Self { mass, storeys, damping, gravity: GravityEffect::None, storey_damping })
    }

    /// Equal floor masses and storey stiffnesses with the given first period (s):
    /// w_1 = 2 sqrt(k/m) sin(pi / (2 (2 n + 1))).
    ///
    /// # Errors
    /// [`Error::Invalid`] when a number is out of its range.
    pub fn uniform(storeys: usize, period: f64, mass: f64, damping: Damping) -> Result<Self> {
        let stiffness = uniform_stiffness(storeys, period, mass)?;
        Self::new(vec![mass; storeys], vec![Storey::elastic(stiffness); storeys], damping)
    }

    /// The same building with other springs; its damping is made again from their initial stiffness.
    ///
    /// # Errors
    /// [`Error::Invalid`] as for [`Building::new`].
    pub fn with_storeys(self, storeys: Vec<Storey>) -> Result<Self> {
        let gravity = self.gravity;
        Self::new(self.mass, storeys, self.damping)?.with_gravity(gravity)
    }

    /// The same building with P-Delta.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a number is out of its range.
    pub fn with_gravity(mut self, gravity: GravityEffect) -> Result<Self> {
        let n = self.mass.len();
        match &gravity {
            GravityEffect::None => {}
            GravityEffect::GeometricStiffness(values) => {
                check_length("geometric_stiffness", "building", n, "storey", values.len())?;
                for (i, &value) in values.iter().enumerate() {
                    let owner = Nth("storey", i);
                    check(value.is_finite() && value >= 0.0, "geometric_stiffness", owner, "zero or positive", value)?;
                }
            }
            GravityEffect::Loads { heights, floor_loads } => {
                check_length("heights", "building", n, "storey", heights.len())?;
                check_length("gravity_load", "building", n, "floor", floor_loads.len())?;
                for (i, (&height, &load)) in heights.iter().zip(floor_loads).enumerate() {
                    let (storey, floor) = (Nth("storey", i), Nth("floor", i));
                    check(height.is_finite() && height > 0.0, "heights", storey, "a positive number", height)?;
                    check(load.is_finite() && load >= 0.0, "gravity_load", floor, "zero or positive", load)?;
                }
            }
        }
        self.gravity = gravity;
        Ok(self)
    }

    /// Number of storeys.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether the building has no storeys: never.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Floor masses (kg).
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Storey springs.
    pub fn storeys(&self) -> &[Storey] {
        &self.storeys
    }

    /// P-Delta as given.
    pub fn gravity(&self) -> &GravityEffect {
        &self.gravity
    }

    /// How damping was given.
    pub fn damping(&self) -> &Damping {
        &self.damping
    }

    /// The damping operator in storey coordinates.
    pub fn storey_damping(&self) -> &StoreyDamping {
        &self.storey_damping
    }

    /// Damping matrix C in floor coordinates (N s/m).
    pub fn damping_matrix(&self) -> DMatrix<f64> {
        self.storey_damping.floor_matrix(&self.mass, &self.stiffness())
    }

    /// No circular frequency of the bare building, elastic, is above this (rad/s).
    pub fn frequency_bound(&self) -> f64 {
        let stiffest = self.storeys.iter().map(Storey::largest_stiffness).fold(0.0, f64::max);
        let lightest = self.mass.iter().copied().fold(f64::INFINITY, f64::min);
        2.0 * (stiffest / lightest).sqrt()
    }

    /// Natural periods of the bare building (s), longest first, without P-Delta.
    pub fn periods(&self) -> Vec<f64> {
        let frequencies = natural_frequencies(&self.mass, &self.stiffness());
        frequencies.iter().map(|w| 2.0 * std::f64::consts::PI / w).collect()
    }

    fn stiffness(&self) -> Vec<f64> {
        self.storeys.iter().map(|s| s.stiffness).collect()
    }
}

/// Storey stiffness (N/m) of a uniform building with the given first period (s) and floor mass (kg).
///
/// # Errors
/// [`Error::Invalid`] when a number is out of its range.
pub fn uniform_stiffness(storeys: usize, period: f64, mass: f64) -> Result<f64> {
    check(storeys >= 1, "storeys", "building", "at least 1", storeys as f64)?;
    check_storeys(storeys)?;
    check(period.is_finite() && period > 0.0, "period", "building", "a positive number", period)?;
    check(mass.is_finite() && mass > 0.0, "mass", "building", "a positive number", mass)?;
    let angle = std::f64::consts::PI / (2.0 * (2 * storeys + 1) as f64);
    let root = std::f64::consts::PI / (period * libm::sin(angle));
    Ok(mass * root * root)
}

/// Friction coefficients of a block from a slip path on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wear {
    /// Path slipped in contact (m) from which they hold.
    pub path: f64,
    /// Static friction coefficient.
    pub mu_s: f64,
    /// Kinetic friction coefficient, at most the static one.
    pub mu_k: f64,
}

/// A rigid block that sticks to its floor or slides on it by Coulomb friction.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Floor that carries it, counted from 1; 0 is the ground slab.
    pub floor: usize,
    /// Mass (kg).
    pub mass: f64,
    /// Static friction coefficient.
    pub mu_s: f64,
    /// Kinetic friction coefficient, at most the static one.
    pub mu_k: f64,
    /// Initial velocity relative to the ground (m/s); default: its floor's.
    pub velocity: Option<f64>,
    /// Coefficients that follow those above, by the path slipped; paths increase. Empty: they stay as they are.
    pub wear: Vec<Wear>,
}

impl Block {
    /// A block with equal friction coefficients, at rest on its floor.
    pub fn new(floor: usize, mass: f64, mu: f64) -> Self {
        Self { floor, mass, mu_s: mu, mu_k: mu, velocity: None, wear: Vec::new() }
    }

    pub(crate) fn validate(&self, owner: impl Display + Copy, floors: usize) -> Result<()> {
        let &Self { floor, mass, mu_s, mu_k, velocity, ref wear } = self;
        if floor > floors {
            let requirement = match floors {
                0 => "0, the ground, where there is no building".to_string(),
                _ => format!("a floor of the building, 1 to {floors}, or 0 for the ground"),
            };
            return Err(Error::invalid(Domain::Scene, "floor", owner.to_string(), requirement, floor));
        }
        check(mass.is_finite() && mass > 0.0, "mass", owner, "a positive number", mass)?;
        check_friction(mu_s, mu_k, owner)?;
        velocity.map_or(Ok(()), |v| check(v.is_finite(), "velocity", owner, "a finite number", v))?;
        if wear.is_empty() { Ok(()) } else { check_wear(wear, &owner) }
    }
}

fn check_friction(mu_s: f64, mu_k: f64, owner: impl Display + Copy) -> Result<()> {
    check(mu_s.is_finite() && mu_s >= 0.0, "mu_s", owner, "finite and not negative", mu_s)?;
    check(mu_k >= 0.0, "mu_k", owner, "finite and not negative", mu_k)?;
    check(mu_k <= mu_s, "mu_k", owner, format_args!("at most mu_s = {mu_s}"), mu_k)
}

fn check_wear(wear: &[Wear], block: &dyn Display) -> Result<()> {
    let requirement = format_args!("at most {MAX_WEAR_STAGES}");
    check(wear.len() <= MAX_WEAR_STAGES, "number of wear stages", block, requirement, wear.len() as f64)?;
    let mut before = 0.0;
    for (stage, &Wear { path, mu_s, mu_k }) in wear.iter().enumerate() {
        let owner = format!("wear stage {} of {block}", stage + 1);
        let requirement = format_args!("finite and above {before} m");
        check(path.is_finite() && path > before, "path", &owner, requirement, path)?;
        check_friction(mu_s, mu_k, &owner)?;
        before = path;
    }
    Ok(())
}

/// Building and blocks, with their initial state.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    building: Option<Arc<Building>>,
    blocks: Vec<Block>,
    initial_drift: Vec<f64>,
    initial_velocity: Vec<f64>,
    geometric_stiffness: Vec<f64>,
    collapse_drift: Option<Vec<f64>>,
}

impl Scene {
    /// A scene at rest. Without a building, all blocks stand on the ground.
    ///
    /// # Errors
    /// [`Error::Invalid`] when there is nothing in the scene, a block is invalid, or P/h reaches a storey's stiffness.
    pub fn new(building: Option<Arc<Building>>, blocks: Vec<Block>) -> Result<Self> {
        let n = building.as_ref().map_or(0, |b| b.len());
        if n == 0 && blocks.is_empty() {
            return Err(Error::invalid(
                Domain::Scene,
                "blocks",
                "scene",
                "at least one where there is no building",
                "none",
            ));
        }
        for (j, block) in blocks.iter().enumerate() {
            block.validate(Nth("block", j), n)?;
        }
        let geometric_stiffness = building.as_ref().map_or(Ok(Vec::new()), |b| geometric_stiffness(b, &blocks))?;
        Ok(Self {
            building,
            blocks,
            initial_drift: vec![0.0; n],
            initial_velocity: vec![0.0; n],
            geometric_stiffness,
            collapse_drift: None,
        })
    }

    /// The same scene from an initial state: storey drifts (m, within the elastic range) and floor velocities
    /// relative to the ground (m/s).
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a drift exceeds the first yield drift.
    pub fn with_initial(mut self, drift: Vec<f64>, velocity: Vec<f64>) -> Result<Self> {
        let storeys = self.building.as_ref().map_or(&[][..], |b| b.storeys());
        check_length("drift", "initial state", storeys.len(), "storey", drift.len())?;
        check_length("velocity", "initial state", storeys.len(), "floor", velocity.len())?;
        for (i, ((&d, &v), storey)) in drift.iter().zip(&velocity).zip(storeys).enumerate() {
            let limit = storey.elastic_drift();
            check(
                d.is_finite() && d.abs() <= limit,
                "initial drift",
                Nth("storey", i),
                format_args!("within {limit} m, its elastic range"),
                d,
            )?;
            check(v.is_finite(), "initial velocity", Nth("floor", i), "a finite number", v)?;
        }
        self.initial_drift = drift;
        self.initial_velocity = velocity;
        self.check_collapse()?;
        Ok(self)
    }

    /// The same scene with another collapse drift per storey (m; infinite: never).
    ///
    /// # Errors
    /// [`Error::Invalid`] when the list has the wrong length or a drift is not positive.
    pub fn with_collapse_drift(mut self, collapse_drift: Vec<f64>) -> Result<Self> {
        check_length("collapse_drift", "scene", self.storeys(), "storey", collapse_drift.len())?;
        self.collapse_drift = Some(collapse_drift);
        self.check_collapse()?;
        Ok(self)
    }

    fn check_collapse(&self) -> Result<()> {
        for (i, (&limit, &start)) in self.collapse_drift.iter().flatten().zip(&self.initial_drift).enumerate() {
            let (owner, requirement) = (Nth("storey", i), format_args!("below the collapse drift {limit} m"));
            check(limit > 0.0, "collapse_drift", owner, "a positive number", limit)?;
            check(start.abs() < limit, "initial drift", owner, requirement, start)?;
        }
        Ok(())
    }

    /// Number of storeys (0 without a building).
    pub fn storeys(&self) -> usize {
        self.initial_drift.len()
    }

    /// The building, if any.
    pub fn building(&self) -> Option<&Arc<Building>> {
        self.building.as_ref()
    }

    /// The blocks, in the order given.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Initial storey drifts (m).
    pub fn initial_drift(&self) -> &[f64] {
        &self.initial_drift
    }

    /// Initial floor velocities relative to the ground (m/s).
    pub fn initial_velocity(&self) -> &[f64] {
        &self.initial_velocity
    }

    /// P/h of each storey (N/m): zero without P-Delta.
    pub fn geometric_stiffness(&self) -> &[f64] {
        &self.geometric_stiffness
    }

    /// Collapse drift per storey as given (m).
    pub fn collapse_drift(&self) -> Option<&[f64]> {
        self.collapse_drift.as_deref()
    }
}

/// P/h of each storey (N/m): the gravity load above it over its height.
fn geometric_stiffness(building: &Building, blocks: &[Block]) -> Result<Vec<f64>> {
    let n = building.len();
    let values = match building.gravity() {
        GravityEffect::None => vec![0.0; n],
        GravityEffect::GeometricStiffness(values) => values.clone(),
        GravityEffect::Loads { heights, floor_loads } => {
            let mut load = floor_loads.clone();
            for block in blocks.iter().filter(|b| b.floor > 0) {
                load[block.floor - 1] += block.mass * STANDARD_GRAVITY;
            }
            for i in (0..n - 1).rev() {
                load[i] += load[i + 1];
            }
            load.iter().zip(heights).map(|(p, h)| p / h).collect()
        }
    };
    for (i, (&value, storey)) in values.iter().zip(building.storeys()).enumerate() {
        let requirement = format_args!("below its stiffness {} N/m", storey.stiffness);
        check(value < storey.stiffness, "geometric stiffness P/h", Nth("storey", i), requirement, value)?;
    }
    Ok(values)
}

/// Ground acceleration, linear between samples; the first sample is at t = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    dt: f64,
    acceleration: Arc<[f64]>,
    vertical: Option<Arc<[f64]>>,
}

impl Motion {
    /// A motion of horizontal samples (m/s2) at step `dt` (s), optionally with vertical ones (up positive).
    ///
    /// # Errors
    /// [`Error::Invalid`] when there is no sample, a value is not finite, `dt` is not positive, or lengths differ.
    pub fn new(acceleration: impl Into<Arc<[f64]>>, dt: f64, vertical: Option<Arc<[f64]>>) -> Result<Self> {
        let acceleration = acceleration.into();
        let refuse = |parameter: &str, requirement: String, value: String| {
            Err(Error::invalid(Domain::Motion, parameter, "motion", requirement, value))
        };
        if !(dt.is_finite() && dt > 0.0) {
            return refuse("dt", "a positive number".into(), dt.to_string());
        }
        if acceleration.is_empty() || acceleration.len() > MAX_SAMPLES {
            let requirement = format!("a list of 1 to {MAX_SAMPLES} samples");
            return refuse("acceleration", requirement, format!("{} samples", acceleration.len()));
        }
        if let Some(i) = acceleration.iter().position(|a| !a.is_finite()) {
            return refuse(
                "acceleration",
                "finite at every sample".into(),
                format!("{} at sample {i}", acceleration[i]),
            );
        }
        if let Some(vertical) = &vertical {
            if vertical.len() != acceleration.len() {
                let requirement = format!("as long as the horizontal one, {} samples", acceleration.len());
                return refuse("vertical acceleration", requirement, format!("{} samples", vertical.len()));
            }
            if let Some(i) = vertical.iter().position(|a| !a.is_finite()) {
                return refuse(
                    "vertical acceleration",
                    "finite at every sample".into(),
                    format!("{} at sample {i}", vertical[i]),
                );
            }
        }
        Ok(Self { dt, acceleration, vertical })
    }

    /// The motion up to the sample nearest to `duration` (s): cut, or continued at zero, which it reaches over one step.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the duration is negative, not finite or too long.
    pub fn with_duration(&self, duration: f64) -> Result<Self> {
        let last = (duration / self.dt).round();
        if !(duration >= 0.0 && last < MAX_SAMPLES as f64) {
            let requirement = format!("between 0 and {} s", (MAX_SAMPLES - 1) as f64 * self.dt);
            return Err(Error::invalid(Domain::Motion, "duration", "motion", requirement, duration));
        }
        let length = last as usize + 1;
        let resize = |samples: &Arc<[f64]>| -> Arc<[f64]> {
            let mut samples = samples.to_vec();
            samples.resize(length, 0.0);
            samples.into()
        };
        Ok(Self { dt: self.dt, acceleration: resize(&self.acceleration), vertical: self.vertical.as_ref().map(resize) })
    }

    /// The motion with both components multiplied by `factor`.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the factor, or a sample times it, is not a finite number.
    pub fn scaled(&self, factor: f64) -> Result<Self> {
        if !factor.is_finite() {
            return Err(Error::invalid(Domain::Motion, "factor", "scaled motion", "a finite number", factor));
        }
        if factor == 1.0 {
            return Ok(self.clone());
        }
        let multiply = |samples: &Arc<[f64]>| -> Arc<[f64]> { samples.iter().map(|a| a * factor).collect() };
        Self::new(multiply(&self.acceleration), self.dt, self.vertical.as_ref().map(multiply))
    }

    /// The same motion with each sample interval divided into `parts`.
    pub(crate) fn divided(&self, parts: usize) -> Self {
        if parts == 1 {
            return self.clone();
        }
        let divide = |samples: &Arc<[f64]>| -> Arc<[f64]> {
            let (intervals, last) = (samples.iter().zip(&samples[1..]), samples.last().copied());
            let within = |part: usize| part as f64 / parts as f64;
            let divided =
                intervals.flat_map(|(&start, &end)| (0..parts).map(move |part| start + (end - start) * within(part)));
            divided.chain(last).collect()
        };
        let (acceleration, vertical) = (divide(&self.acceleration), self.vertical.as_ref().map(divide));
        Self { dt: self.dt / parts as f64, acceleration, vertical }
    }

    /// Time step (s).
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Horizontal ground acceleration (m/s2).
    pub fn acceleration(&self) -> &[f64] {
        &self.acceleration
    }

    /// Vertical ground acceleration (m/s2), up positive.
    pub fn vertical(&self) -> Option<&[f64]> {
        self.vertical.as_deref()
    }
}

/// What a run gives back beside peaks, residuals and statistics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// Histories at every so many samples.
    pub histories: Option<std::num::NonZeroUsize>,
    /// Histories of drifts and slips alone: those of velocities, accelerations and forces stay empty.
    pub displacements_only: bool,
    /// Energies and their residual.
    pub energy: bool,
    /// The event log.
    pub events: bool,
    /// Nothing but peaks is wanted: the run may stop when none can be beaten any more, and residuals are NaN. Without
    /// effect where histories or energies are asked for.
    pub peaks_only: bool,
}
