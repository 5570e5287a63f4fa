//! A storey's lateral spring, and its law.

use std::fmt::Display;
use std::sync::Arc;

use crate::error::Result;
use crate::scene::check::check;
use crate::tolerances::SAME_SLOPE;

/// Most points of a multilinear backbone.
pub const MAX_BACKBONE_POINTS: usize = 100;

/// The law of a storey's lateral spring (`numerics`, section 3): piecewise linear, so that the response between events is
/// solved in closed form.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
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
    /// Flag-shaped hysteresis of self-centring storeys (Christopoulos, Filiatrault and Folz 2002): slope k up to V_y, r2 k
    /// beyond. Overstrength and third slope play no part.
    FlagShaped {
        /// Height beta of the flag, 0 to 1: unloading goes down by beta V_y with slope k, then back along a line of slope
        /// r2 k to the elastic one.
        flag_height: f64,
    },
}

/// Unloading, strength loss and residual strength of a peak-oriented spring.
///
/// Unloading goes down to zero force with the stiffness k (d_y / d_max)^a (Takeda, Sozen and Nielsen 1970; a = 0: Clough),
/// or F_max / d_max where that is larger, so that it ends before the origin. Reloading goes straight to the point of the
/// largest drift in that direction so far. Each half cycle between two zeros of the force lowers the force of the point that
/// the next one aims at by the factor 1 - E_i / (lambda V_y d_y - sum of E_j), E_i the energy dissipated in it and E_j in it
/// and those before (Rahnama and Krawinkler 1993, exponent 1).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct PeakOriented {
    /// Exponent a of the unloading stiffness, 0 <= a < 1.
    pub unloading_exponent: f64,
    /// Energy that a storey can dissipate, lambda, over yield force times yield drift; infinite: no cyclic loss.
    #[cfg_attr(feature = "serde", serde(with = "crate::scene::form"))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Storey {
    /// Initial stiffness k (N/m).
    pub stiffness: f64,
    /// First yield shear V_y (N); infinite: the storey stays elastic.
    #[cfg_attr(feature = "serde", serde(with = "crate::scene::form"))]
    pub yield_shear: f64,
    /// Overstrength factor Omega >= 1.
    pub overstrength: f64,
    /// Second slope over the first, r2.
    pub second_slope: f64,
    /// Third slope over the first, r3, with 0 <= r3 <= r2 <= 1; from -1 on with a peak-oriented law.
    pub third_slope: f64,
    /// The law of the spring.
    #[cfg_attr(feature = "serde", serde(default))]
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
    /// A list that is no backbone is refused by [`Building::new`](crate::Building::new).
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
            &SpringLaw::FlagShaped { flag_height: beta } => {
                check((0.0..=1.0).contains(&beta), "flag_height", owner, "between 0 and 1", beta)
            }
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
