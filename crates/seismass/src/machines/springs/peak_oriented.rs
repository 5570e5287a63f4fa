//! Peak-oriented hysteresis (Clough and Johnston 1966) on a backbone that may soften down to a residual strength, with
//! Takeda's unloading stiffness and cyclic loss of strength (Rahnama and Krawinkler 1993; `numerics`, section 3).

use crate::machines::segment::{Backbone, Crossing, Segment, SpringMachine};
use crate::machines::sign::Sign;
use crate::response::EventKind;
use crate::scene::{PeakOriented as Parameters, Storey};

/// The line of the backbone that follows a break: by its number of breaks before, 1 to 3.
type Branch = usize;

/// The backbone: slopes k, r2 k, r3 k, and 0 once the residual strength is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shape {
    stiffness: f64,
    yield_force: f64,
    yield_drift: f64,
    /// Slopes of branches 1 to 3.
    slopes: [f64; 3],
    /// Drift at which branch 1 ends.
    cap_drift: f64,
    /// The branch that begins at first yield: 1, or 2 without overstrength.
    first: Branch,
    residual: f64,
    exponent: f64,
    /// Energy that can be dissipated (J).
    capacity: f64,
    /// Slope of the first branch, not below zero.
    hardening: f64,
}

impl Shape {
    fn new(storey: &Storey, law: &Parameters) -> Self {
        let &Storey { stiffness, yield_shear, overstrength, second_slope, third_slope, .. } = storey;
        let yield_drift = yield_shear / stiffness;
        let rise = (overstrength - 1.0) * yield_shear / (second_slope * stiffness);
        let first_slope = if overstrength == 1.0 { third_slope } else { second_slope };
        Self {
            stiffness,
            yield_force: yield_shear,
            yield_drift,
            slopes: [second_slope * stiffness, third_slope * stiffness, 0.0],
            cap_drift: if second_slope > 0.0 { yield_drift + rise } else { f64::INFINITY },
            first: if overstrength == 1.0 { 2 } else { 1 },
            residual: law.residual_strength * yield_shear,
            exponent: law.unloading_exponent,
            capacity: law.energy_capacity * yield_shear * yield_drift,
            hardening: first_slope.max(0.0) * stiffness,
        }
    }

    fn slope(&self, branch: Branch) -> f64 {
        self.slopes[branch - 1]
    }

    /// How far a branch goes on from a drift and a force on it, both in its direction.
    fn length(&self, branch: Branch, drift: f64, force: f64) -> f64 {
        match branch {
            1 => (self.cap_drift - drift).max(0.0),
            2 if self.slope(2) < 0.0 => ((force - self.residual) / -self.slope(2)).max(0.0),
            _ => f64::INFINITY,
        }
    }

    /// Stiffness of unloading from the side whose largest drift is `drift`, with `force` there, after the force went up
    /// from zero with the slope `reload_slope`. Not below that of the line from the origin; where strength can be lost, nor
    /// below that slope and the hardening one: what is stored is not more than the work since the force was zero.
    fn unloading(&self, drift: f64, force: f64, reload_slope: f64) -> f64 {
        if self.exponent == 0.0 || drift <= self.yield_drift {
            return self.stiffness;
        }
        let by_drift = self.stiffness * libm::pow(self.yield_drift / drift, self.exponent);
        let least = if self.capacity.is_finite() { reload_slope.max(self.hardening) } else { 0.0 };
        by_drift.max(force / drift).max(least)
    }

    /// How many segments have been left on a branch.
    fn left(&self, branch: Branch) -> usize {
        branch + 1 - self.first
    }
}

/// The point that a side reloads to: its largest drift and the force there, in its direction, and the branch beyond.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Peak {
    drift: f64,
    force: f64,
    branch: Branch,
}

/// A line on which the spring is loaded in the direction of its force.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Loading {
    /// A branch of the backbone.
    Backbone(Branch),
    /// Straight to the peak, with this slope.
    Reloading(f64),
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    /// Not yielded yet.
    Virgin,
    Loading(Sign, Loading),
    /// Down from a turn: the sign of the force, the stiffness, the force at the turn in its direction, and the line that
    /// was left there.
    Unloading {
        sign: Sign,
        stiffness: f64,
        turn_force: f64,
        left: Loading,
    },
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeakOriented {
    shape: Shape,
    mode: Mode,
    base_drift: f64,
    base_force: f64,
    /// Of the positive and of the negative side.
    peaks: [Peak; 2],
    /// Slope of the line on which the force last went up from zero; 0 before the first.
    reload_slope: f64,
    /// Energy dissipated before the last zero of the force, and since.
    dissipated: [f64; 2],
}

fn side(sign: Sign) -> usize {
    usize::from(sign == Sign::Negative)
}

impl PeakOriented {
    pub(crate) fn new(storey: &Storey, law: &Parameters) -> Self {
        let shape = Shape::new(storey, law);
        let virgin = Peak { drift: shape.yield_drift, force: shape.yield_force, branch: shape.first };
        Self {
            shape,
            mode: Mode::Virgin,
            base_drift: 0.0,
            base_force: 0.0,
            peaks: [virgin; 2],
            reload_slope: 0.0,
            dissipated: [0.0; 2],
        }
    }

    /// Moves the base to coordinate `x`.
    fn rebase(&mut self, x: f64) {
        self.dissipated[1] += self.dissipated(0.0, x);
        self.base_force += self.tangent() * x;
        self.base_drift += x;
    }

    fn tangent(&self) -> f64 {
        match self.mode {
            Mode::Virgin => self.shape.stiffness,
            Mode::Loading(_, Loading::Backbone(branch)) => self.shape.slope(branch),
            Mode::Loading(_, Loading::Reloading(slope)) => slope,
            Mode::Unloading { stiffness, .. } => stiffness,
        }
    }

    /// Energy stored in the spring itself at coordinate `x`: what unloading to zero force gives back.
    fn recoverable(&self, x: f64) -> f64 {
        let (shape, force) = (&self.shape, self.base_force + self.tangent() * x);
        let stiffness = match self.mode {
            Mode::Virgin => shape.stiffness,
            Mode::Loading(_, Loading::Backbone(_)) => {
                shape.unloading((self.base_drift + x).abs(), force.abs(), self.reload_slope)
            }
            Mode::Loading(sign, Loading::Reloading(_)) => {
                let Peak { drift, force, .. } = self.peaks[side(sign)];
                shape.unloading(drift, force, self.reload_slope)
            }
            Mode::Unloading { stiffness, .. } => stiffness,
        };
        0.5 * force * force / stiffness
    }

    /// The force is zero: loading begins in the direction `sign`, towards a peak that has lost strength by what the half
    /// cycle has dissipated.
    fn reload(&mut self, sign: Sign) -> Crossing {
        let [before, half_cycle] = [self.dissipated[0], self.dissipated[1].max(0.0)];
        self.dissipated = [before + half_cycle, 0.0];
        let peak = &mut self.peaks[side(sign)];
        if self.shape.capacity.is_finite() {
            let rest = self.shape.capacity - self.dissipated[0];
            let loss = if half_cycle < rest { half_cycle / rest } else { 1.0 };
            peak.force = ((1.0 - loss) * peak.force).max(self.shape.residual.min(peak.force));
        }
        let distance = peak.drift - sign.factor() * self.base_drift;
        let slope = if distance > 0.0 { peak.force / distance } else { 0.0 };
        self.base_force = 0.0;
        self.reload_slope = slope;
        self.mode = Mode::Loading(sign, Loading::Reloading(slope));
        Crossing::new(EventKind::Reload, sign)
    }

    /// The spring is on a branch of the backbone from its base on.
    fn enter(&mut self, sign: Sign, branch: Branch) -> Crossing {
        self.mode = Mode::Loading(sign, Loading::Backbone(branch));
        Crossing::of_yield(sign, self.shape.left(branch))
    }
}

impl SpringMachine for PeakOriented {
    fn segment(&self) -> Segment {
        let shape = &self.shape;
        let line = Segment {
            range: shape.yield_drift.max(self.base_drift.abs()),
            ..Segment::line(self.base_drift, self.base_force, self.tangent())
        };
        let along = |sign: Sign| (sign.factor() * self.base_drift, sign.factor() * self.base_force);
        match self.mode {
            Mode::Virgin => {
                Segment { ends: (-shape.yield_drift - self.base_drift, shape.yield_drift - self.base_drift), ..line }
            }
            Mode::Loading(sign, Loading::Backbone(branch)) => {
                let (drift, force) = along(sign);
                line.towards(sign, sign.factor() * shape.length(branch, drift, force))
            }
            Mode::Loading(sign, Loading::Reloading(_)) => {
                let distance = self.peaks[side(sign)].drift - along(sign).0;
                line.towards(sign, sign.factor() * distance.max(0.0))
            }
            Mode::Unloading { sign, stiffness, turn_force, .. } => {
                let (_, force) = along(sign);
                let (to_zero, to_turn) = (force / stiffness, (turn_force - force) / stiffness);
                let ends = match sign {
                    Sign::Positive => (-to_zero, to_turn),
                    Sign::Negative => (-to_turn, to_zero),
                };
                Segment { ends, ..line }
            }
        }
    }

    fn end(&mut self, x: f64, sign: Sign) -> Crossing {
        self.rebase(x);
        match self.mode {
            Mode::Virgin => {
                self.base_force = sign.factor() * self.shape.yield_force;
                self.enter(sign, self.shape.first)
            }
            Mode::Loading(sign, Loading::Backbone(branch)) => {
                if branch == 2 {
                    self.base_force = sign.factor() * self.shape.residual;
                }
                self.enter(sign, branch + 1)
            }
            Mode::Loading(sign, Loading::Reloading(_)) => {
                let Peak { force, branch, .. } = self.peaks[side(sign)];
                self.base_force = sign.factor() * force;
                self.enter(sign, branch)
            }
            Mode::Unloading { sign: of_force, turn_force, left, .. } if sign == of_force => {
                self.base_force = sign.factor() * turn_force;
                self.mode = Mode::Loading(sign, left);
                Crossing::new(EventKind::Reload, sign)
            }
            Mode::Unloading { sign, .. } => self.reload(sign.opposite()),
        }
    }

    fn turn(&mut self, x: f64) -> Crossing {
        self.rebase(x);
        let Mode::Loading(sign, left) = self.mode else {
            return Crossing::new(EventKind::Unload, Sign::of(self.base_force));
        };
        let (drift, turn_force) = (sign.factor() * self.base_drift, (sign.factor() * self.base_force).max(0.0));
        let peak = &mut self.peaks[side(sign)];
        if let Loading::Backbone(branch) = left {
            *peak = Peak { drift: drift.max(self.shape.yield_drift), force: turn_force, branch };
        }
        let stiffness = self.shape.unloading(peak.drift, peak.force, self.reload_slope);
        self.mode = Mode::Unloading { sign, stiffness, turn_force, left };
        Crossing::new(EventKind::Unload, sign)
    }

    fn stored(&self, x: f64, geometric: f64) -> f64 {
        let drift = self.base_drift + x;
        self.recoverable(x) - 0.5 * geometric * drift * drift
    }

    /// The work of the force less what is stored.
    fn dissipated(&self, x: f64, change: f64) -> f64 {
        let elastic = matches!(self.mode, Mode::Virgin | Mode::Unloading { .. });
        if elastic {
            return 0.0;
        }
        let middle = self.base_force + self.tangent() * (x + 0.5 * change);
        middle * change - (self.recoverable(x + change) - self.recoverable(x))
    }

    fn state_name(&self) -> &'static str {
        match self.mode {
            Mode::Virgin => "elastic",
            Mode::Loading(_, Loading::Backbone(_)) => "on its backbone",
            Mode::Loading(_, Loading::Reloading(_)) => "reloading",
            Mode::Unloading { .. } => "unloading",
        }
    }

    fn backbone(&self) -> Backbone {
        let shape = &self.shape;
        if !self.can_yield() {
            return Backbone { breaks: Vec::new(), last_slope: shape.stiffness };
        }
        let mut breaks = Vec::new();
        let (mut drift, mut force, mut slope) = (shape.yield_drift, shape.yield_force, shape.stiffness);
        for branch in shape.first..=3 {
            breaks.push((drift, slope - shape.slope(branch)));
            slope = shape.slope(branch);
            let length = shape.length(branch, drift, force);
            if length == f64::INFINITY {
                break;
            }
            (drift, force) = (drift + length, force + length * slope);
        }
        Backbone { breaks, last_slope: slope }
    }

    /// Unloading and reloading have any slope.
    fn tangents(&self) -> Option<Vec<f64>> {
        None
    }

    fn largest_tangent(&self) -> f64 {
        self.shape.stiffness
    }

    fn can_yield(&self) -> bool {
        self.shape.yield_force.is_finite()
    }

    fn parameters(&self) -> Vec<f64> {
        let shape = &self.shape;
        let mut parameters = vec![shape.stiffness, shape.yield_force, shape.cap_drift, shape.first as f64];
        parameters.extend(shape.slopes);
        parameters.extend([shape.residual, shape.exponent, shape.capacity]);
        parameters
    }
}
