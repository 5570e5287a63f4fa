//! The peak-oriented law: unloading to zero force, reloading straight to the largest drift of that direction so far, and
//! strength lost by the energy dissipated in each half cycle.

use seismass::{EventKind, Storey};

use super::{Course, Crossing, Limit, Part, Slope, Spring, SpringGuard};
use crate::real::Real;
use crate::sign::Sign;

/// Where a branch of the backbone ends, in the direction in which it is followed.
#[derive(Debug, Clone, Copy)]
enum End<R> {
    Never,
    /// At this drift.
    Drift(R),
    /// Where the force has fallen to this.
    Force(R),
}

/// A branch of the backbone after first yield.
#[derive(Debug, Clone, Copy)]
struct Branch<R> {
    slope: R,
    end: End<R>,
}

/// The point that reloading of a side aims at, in its direction.
#[derive(Debug, Clone, Copy)]
struct Peak<R> {
    drift: R,
    force: R,
    branch: usize,
}

/// What was left at a turn and goes on after a return to it.
#[derive(Debug, Clone, Copy)]
enum Left<R> {
    Backbone { branch: usize },
    Reloading { slope: R },
}

#[derive(Debug, Clone, Copy)]
enum Mode<R> {
    Elastic,
    /// On the backbone, or parallel to it after a loss of strength.
    Backbone {
        side: Sign,
        branch: usize,
    },
    /// From a turn at this drift and force.
    Unloading {
        side: Sign,
        drift: R,
        force: R,
        left: Left<R>,
    },
    /// Straight to the peak of the side.
    Reloading {
        side: Sign,
        slope: R,
    },
}

/// A spring with finite yield force.
#[derive(Debug, Clone)]
pub(super) struct PeakOriented<R> {
    stiffness: R,
    yield_drift: R,
    yield_force: R,
    exponent: R,
    branches: Vec<Branch<R>>,
    /// Drifts at which the branches of the monotonic backbone begin.
    begins: Vec<R>,
    residual_force: R,
    /// Energy that can be dissipated.
    capacity: Option<R>,
    mode: Mode<R>,
    force: R,
    /// Of the positive and the negative side.
    peaks: [Peak<R>; 2],
    /// Energy dissipated since the force was last zero, and before.
    half_cycle: R,
    before: R,
}

fn index(side: Sign) -> usize {
    usize::from(side == Sign::Negative)
}

impl<R: Real> PeakOriented<R> {
    pub(super) fn new(storey: &Storey, law: &seismass::PeakOriented) -> Self {
        let (one, k, vy) = (R::of(1.0), R::of(storey.stiffness), R::of(storey.yield_shear));
        let (omega, residual_force) = (R::of(storey.overstrength), R::of(law.residual_strength) * vy);
        let (r2, r3) = (R::of(storey.second_slope), R::of(storey.third_slope));
        let yield_drift = vy / k;
        let (mut branches, mut begins) = (Vec::new(), vec![yield_drift]);
        let hardens = omega > one;
        if hardens && r2 == R::zero() {
            branches.push(Branch { slope: R::zero(), end: End::Never });
        } else {
            if hardens {
                let end = yield_drift + (omega - one) * vy / (r2 * k);
                branches.push(Branch { slope: r2 * k, end: End::Drift(end) });
                begins.push(end);
            }
            let softens = r3 < R::zero();
            branches.push(Branch { slope: r3 * k, end: if softens { End::Force(residual_force) } else { End::Never } });
            if softens {
                begins.push(begins[begins.len() - 1] + (residual_force - omega * vy) / (r3 * k));
                branches.push(Branch { slope: R::zero(), end: End::Never });
            }
        }
        let capacity = law.energy_capacity.is_finite().then(|| R::of(law.energy_capacity) * vy * yield_drift);
        Self {
            stiffness: k,
            yield_drift,
            yield_force: vy,
            exponent: R::of(law.unloading_exponent),
            branches,
            begins,
            residual_force,
            capacity,
            mode: Mode::Elastic,
            force: R::zero(),
            peaks: [Peak { drift: yield_drift, force: vy, branch: 0 }; 2],
            half_cycle: R::zero(),
            before: R::zero(),
        }
    }

    /// k (d_y / d_max)^a.
    fn unloading_stiffness(&self, largest_drift: R) -> R {
        if self.exponent == R::zero() {
            return self.stiffness;
        }
        self.stiffness * (self.yield_drift / largest_drift.max(self.yield_drift)).power(self.exponent)
    }

    /// The unloading stiffness that belongs to the present side, at this drift.
    fn present_unloading_stiffness(&self, drift: R) -> R {
        let largest = |side: Sign| self.peaks[index(side)].drift;
        match self.mode {
            Mode::Elastic => self.stiffness,
            Mode::Backbone { side, .. } => self.unloading_stiffness(largest(side).max(side.times(drift))),
            Mode::Unloading { side, .. } | Mode::Reloading { side, .. } => self.unloading_stiffness(largest(side)),
        }
    }

    fn tangent(&self) -> R {
        match self.mode {
            Mode::Elastic => self.stiffness,
            Mode::Backbone { branch, .. } => self.branches[branch].slope,
            Mode::Unloading { side, .. } => self.unloading_stiffness(self.peaks[index(side)].drift),
            Mode::Reloading { slope, .. } => slope,
        }
    }

    /// The rate has turned away from the side that the spring moved to.
    fn turn(&mut self, drift: R) -> Vec<Crossing> {
        let (side, left) = match self.mode {
            Mode::Backbone { side, branch } => {
                let (drift, force) = (side.times(drift), side.times(self.force));
                self.peaks[index(side)] = Peak { drift, force, branch };
                (side, Left::Backbone { branch })
            }
            Mode::Reloading { side, slope } => (side, Left::Reloading { slope }),
            Mode::Elastic | Mode::Unloading { .. } => return Vec::new(),
        };
        self.mode = Mode::Unloading { side, drift, force: self.force, left };
        let mut crossings = vec![Crossing::new(EventKind::Unload, side, 0)];
        if self.force == R::zero() {
            crossings.push(self.reload(side.opposite(), drift));
        }
        crossings
    }

    /// The force is zero, and the spring goes on to the peak of this side, which the half cycle just ended has lowered.
    fn reload(&mut self, side: Sign, drift: R) -> Crossing {
        let loss = self.loss();
        self.before = self.before + self.half_cycle;
        self.half_cycle = R::zero();
        let residual = self.residual_force;
        let peak = &mut self.peaks[index(side)];
        if let Some(loss) = loss.filter(|_| peak.force > residual) {
            peak.force = ((R::of(1.0) - loss) * peak.force).max(residual);
        }
        let distance = peak.drift - side.times(drift);
        // Beyond the peak there is nothing to aim at: the spring is at once on the backbone's branch.
        let slope = if distance > R::zero() { peak.force / distance } else { R::zero() };
        self.mode = Mode::Reloading { side, slope };
        self.force = R::zero();
        Crossing::new(EventKind::Reload, side, 0)
    }

    /// The fraction of its strength that the half cycle takes from the next peak.
    fn loss(&self) -> Option<R> {
        let one = R::of(1.0);
        let rest = self.capacity? - self.before - self.half_cycle;
        let loss = if rest > R::zero() { self.half_cycle / rest } else { one };
        Some(if loss <= one { loss } else { one })
    }
}

impl<R: Real + 'static> Spring<R> for PeakOriented<R> {
    fn copied(&self) -> Box<dyn Spring<R>> {
        Box::new(self.clone())
    }

    fn start(&mut self, drift: R) {
        self.force = self.stiffness * drift;
    }

    fn parts(&self) -> Vec<Part<R>> {
        vec![Part { force: self.force, tangent: self.tangent() }]
    }

    fn linear(&self) -> R {
        R::zero()
    }

    /// A softening branch is no steeper: its slope is at least minus the elastic one.
    fn largest_stiffness(&self) -> R {
        self.stiffness
    }

    fn backbone(&self) -> Vec<Slope<R>> {
        let mut slopes = vec![Slope { from: R::zero(), slope: self.stiffness }];
        let branches = self.branches.iter().zip(&self.begins);
        slopes.extend(branches.map(|(branch, &from)| Slope { from, slope: branch.slope }));
        // Without residual strength the last branch begins at zero force, up to rounding: a collapse comes before it.
        if self.residual_force == R::zero() && self.branches.iter().any(|b| matches!(b.end, End::Force(_))) {
            slopes.pop();
        }
        slopes
    }

    fn limits(&self, course: &Course<R>, rate_size: R) -> Vec<Limit<R>> {
        let force = &course.forces[0];
        match self.mode {
            Mode::Elastic => [Sign::Positive, Sign::Negative]
                .map(|sign| Limit::below(SpringGuard::Yield { element: 0, sign }, self.yield_force, sign, force))
                .to_vec(),
            Mode::Backbone { side, branch } => {
                let end = match self.branches[branch].end {
                    End::Never => None,
                    End::Drift(end) => Some(Limit::below(SpringGuard::BranchEnd, end, side, course.drift)),
                    End::Force(end) => Some(Limit::above(SpringGuard::BranchEnd, end, side, force)),
                };
                end.into_iter().chain([Limit::no_turn(side, course.rate, rate_size)]).collect()
            }
            Mode::Unloading { side, drift, .. } => vec![
                Limit::above(SpringGuard::ZeroForce, R::zero(), side, force),
                Limit::below(SpringGuard::Return, side.times(drift), side, course.drift),
            ],
            Mode::Reloading { side, .. } => vec![
                Limit::below(SpringGuard::Peak, self.peaks[index(side)].drift, side, course.drift),
                Limit::no_turn(side, course.rate, rate_size),
            ],
        }
    }

    /// Along a straight line the work is the mean force times the drift; unloading dissipates nothing.
    fn advance(&mut self, course: &Course<R>) {
        let (before, stored) = (self.force, self.stored(course.drift.start()));
        self.force = course.forces[0].end();
        if matches!(self.mode, Mode::Backbone { .. } | Mode::Reloading { .. }) {
            let work = R::of(0.5) * (before + self.force) * course.advance();
            self.half_cycle = self.half_cycle + work - (self.stored(course.drift.end()) - stored);
        }
    }

    fn cross(&mut self, guard: SpringGuard, drift: R) -> Vec<Crossing> {
        match (guard, self.mode) {
            (SpringGuard::Yield { sign, .. }, _) => {
                self.force = sign.times(self.yield_force);
                self.mode = Mode::Backbone { side: sign, branch: 0 };
                vec![Crossing::new(EventKind::Yield, sign, 1)]
            }
            (SpringGuard::BranchEnd, Mode::Backbone { side, branch }) => {
                if let End::Force(end) = self.branches[branch].end {
                    self.force = side.times(end);
                }
                self.mode = Mode::Backbone { side, branch: branch + 1 };
                vec![Crossing::new(EventKind::Yield, side, branch + 2)]
            }
            (SpringGuard::Peak, Mode::Reloading { side, slope }) => {
                let Peak { force, branch, .. } = self.peaks[index(side)];
                if slope > R::zero() {
                    self.force = side.times(force);
                }
                self.mode = Mode::Backbone { side, branch };
                vec![Crossing::new(EventKind::Yield, side, branch + 1)]
            }
            (SpringGuard::ZeroForce, Mode::Unloading { side, .. }) => vec![self.reload(side.opposite(), drift)],
            (SpringGuard::Return, Mode::Unloading { side, force, left, .. }) => {
                self.force = force;
                self.mode = match left {
                    Left::Backbone { branch } => Mode::Backbone { side, branch },
                    Left::Reloading { slope } => Mode::Reloading { side, slope },
                };
                vec![Crossing::new(EventKind::Reload, side, 0)]
            }
            (SpringGuard::Turn(_), _) => self.turn(drift),
            _ => Vec::new(),
        }
    }

    fn stored(&self, drift: R) -> R {
        R::of(0.5) * self.force * self.force / self.present_unloading_stiffness(drift)
    }

    fn dissipated(&self) -> R {
        self.before + self.half_cycle
    }

    fn scale(&mut self, factor: &mut dyn FnMut() -> R) {
        self.force = self.force * factor();
    }
}
