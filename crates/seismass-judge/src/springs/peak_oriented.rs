//! The peak-oriented law: unloading to zero force, reloading straight to the largest drift of that direction so far, and
//! strength lost by the energy dissipated in each half cycle.

use seismass::{EventKind, Storey};

use crate::real::Real;
use crate::sign::Sign;
use crate::springs::contract::{Course, Crossing, Limit, Part, Slope, Spring, SpringGuard};

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
    /// The slope with which the force last left zero, none before it has come back there.
    from_zero: R,
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
            from_zero: R::zero(),
            half_cycle: R::zero(),
            before: R::zero(),
        }
    }

    /// k (d_y / d_max)^a, of a largest drift and the force there; at least F_max / d_max, and, where strength can be lost,
    /// the slope with which the force left zero and that of the backbone after first yield.
    fn unloading_stiffness(&self, drift: R, force: R) -> R {
        if self.exponent == R::zero() || drift <= self.yield_drift {
            return self.stiffness;
        }
        let takeda = self.stiffness * (self.yield_drift / drift).power(self.exponent);
        let softest = takeda.max(force / drift);
        if self.capacity.is_none() {
            return softest;
        }
        softest.max(self.from_zero).max(self.branches[0].slope)
    }

    /// The unloading stiffness of a side by its peak.
    fn by_peak(&self, side: Sign) -> R {
        let peak = &self.peaks[index(side)];
        self.unloading_stiffness(peak.drift, peak.force)
    }

    /// The unloading stiffness that belongs to the present side, at this drift.
    fn present_unloading_stiffness(&self, drift: R) -> R {
        match self.mode {
            Mode::Elastic => self.stiffness,
            Mode::Backbone { side, .. } => self.unloading_stiffness(side.times(drift), side.times(self.force)),
            Mode::Unloading { side, .. } | Mode::Reloading { side, .. } => self.by_peak(side),
        }
    }

    fn tangent(&self) -> R {
        match self.mode {
            Mode::Elastic => self.stiffness,
            Mode::Backbone { branch, .. } => self.branches[branch].slope,
            Mode::Unloading { side, .. } => self.by_peak(side),
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
        self.half_cycle = self.half_cycle.max(R::zero());
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
        self.from_zero = slope;
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

#[cfg(test)]
mod tests {
    use seismass::EventKind::{Reload, Unload, Yield};
    use seismass::SpringLaw;

    use super::*;
    use crate::real::DoubleDouble;
    use crate::springs::loops::Loop;
    use crate::springs::{collapse_drift, spring};

    /// k = 100 N/m, V_y = 10 N, d_y = 0.1 m.
    fn storey(omega: f64, r2: f64, r3: f64, law: seismass::PeakOriented) -> Storey {
        let law = SpringLaw::PeakOriented(law);
        Storey { overstrength: omega, second_slope: r2, third_slope: r3, law, ..Storey::yielding(100.0, 10.0) }
    }

    fn plain() -> seismass::PeakOriented {
        seismass::PeakOriented::default()
    }

    /// Clough's law on a bilinear backbone of slope 10 N/m: 12 N at 0.3 m, zero at 0.18 m, straight to (-0.1, -10), on the
    /// backbone to (-0.2, -11), zero at -0.09 m, straight to (0.3, 12). On that line, at 0.105 m, half of the way: 6 N; back
    /// by 0.03 m to 3 N; up again to 6 N, on the line to 9 N at 0.2025 m, to the peak, and on the backbone.
    fn clough<R: Real>() {
        let mut spring = Loop::<R>::new(&storey(100.0, 0.1, 0.1, plain()));
        spring.follow(&[[0.1, 10.0], [0.3, 12.0], [0.18, 0.0], [-0.1, -10.0], [-0.2, -11.0], [-0.09, 0.0]]);
        // The stored energy is 0 and the loop closed but for its ends: triangles and trapezoids of the lines.
        let area =
            0.5 * 10.0 * 0.1 + 11.0 * 0.2 - 0.5 * 12.0 * 0.12 + 0.5 * 10.0 * 0.28 + 10.5 * 0.1 - 0.5 * 11.0 * 0.11;
        spring.close(spring.spring.dissipated(), area);
        spring.follow(&[[0.105, 6.0], [0.075, 3.0], [0.105, 6.0], [0.2025, 9.0], [0.3, 12.0], [0.4, 13.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Unload, 1, 0, 0.3, 12.0),
            (Reload, -1, 0, 0.18, 0.0),
            (Yield, -1, 1, -0.1, -10.0),
            (Unload, -1, 0, -0.2, -11.0),
            (Reload, 1, 0, -0.09, 0.0),
            (Unload, 1, 0, 0.105, 6.0),
            (Reload, 1, 0, 0.105, 6.0),
            (Yield, 1, 1, 0.3, 12.0),
        ]);
    }

    /// With a = 1/2 a spring that went to 4 d_y unloads with half its stiffness: 13 N at 0.4 m, zero at 0.14 m. An inner turn
    /// at half of the line to (-0.1, -10), (-0.02 m, -5 N), unloads with k, for that side is virgin: zero at 0.03 m.
    fn takeda<R: Real>() {
        let law = seismass::PeakOriented { unloading_exponent: 0.5, ..plain() };
        let mut spring = Loop::<R>::new(&storey(100.0, 0.1, 0.1, law));
        spring.follow(&[[0.4, 13.0], [0.27, 6.5], [0.14, 0.0], [0.02, -5.0], [0.03, -4.0], [0.07, 0.0]]);
        // From (0.07, 0) straight to (0.4, 13): half of it at 0.235 m.
        spring.follow(&[[0.235, 6.5], [0.5, 14.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Unload, 1, 0, 0.4, 13.0),
            (Reload, -1, 0, 0.14, 0.0),
            (Unload, -1, 0, 0.02, -5.0),
            (Reload, 1, 0, 0.07, 0.0),
            (Yield, 1, 1, 0.4, 13.0),
        ]);
    }

    /// Softening: 50 N/m from 0.1 m to (0.2, 15), -25 N/m to (0.6, 5), then 5 N for ever. Unloaded from (0.4, 10) to zero at
    /// 0.3 m, virgin on the other side, whose backbone it follows to (-0.7, -5), zero at -0.65 m, back to (0.4, 10): on
    /// branch 2 from there.
    fn softening<R: Real>() {
        let law = seismass::PeakOriented { residual_strength: 0.5, ..plain() };
        let mut spring = Loop::<R>::new(&storey(1.5, 0.5, -0.25, law));
        spring.follow(&[[0.1, 10.0], [0.2, 15.0], [0.4, 10.0], [0.3, 0.0], [-0.1, -10.0], [-0.2, -15.0], [-0.6, -5.0]]);
        spring.follow(&[[-0.7, -5.0], [-0.65, 0.0], [0.4, 10.0], [0.6, 5.0], [0.7, 5.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Yield, 1, 2, 0.2, 15.0),
            (Unload, 1, 0, 0.4, 10.0),
            (Reload, -1, 0, 0.3, 0.0),
            (Yield, -1, 1, -0.1, -10.0),
            (Yield, -1, 2, -0.2, -15.0),
            (Yield, -1, 3, -0.6, -5.0),
            (Unload, -1, 0, -0.7, -5.0),
            (Reload, 1, 0, -0.65, 0.0),
            (Yield, 1, 2, 0.4, 10.0),
            (Yield, 1, 3, 0.6, 5.0),
        ]);
    }

    /// Elastic-plastic to 0.3 m and back dissipates 2 J of lambda V_y d_y = 5 J: the other side loses 2 / (5 - 2) of its 10 N
    /// and yields at -10/3 N. It dissipates 1/2 10/3 0.3 + 10/3 0.1 - 1/2 10/3 10/300 = 7/9 J: the first side loses
    /// (7/9) / (5 - 2 - 7/9) = 7/20 of its 10 N.
    fn cyclic_loss<R: Real>() {
        let law = seismass::PeakOriented { energy_capacity: 5.0, ..plain() };
        let mut spring = Loop::<R>::new(&storey(2.0, 0.0, 0.0, law));
        let third = 10.0 / 3.0;
        spring.follow(&[[0.3, 10.0], [0.2, 0.0], [-0.1, -third], [-0.2, -third], [-0.2 + third / 100.0, 0.0]]);
        spring.close(spring.spring.dissipated(), 2.0 + 7.0 / 9.0);
        spring.follow(&[[0.3, 6.5], [0.5, 6.5]]);
        let yields: Vec<_> = spring.log.iter().filter(|event| event.0 == Yield).map(|event| event.3).collect();
        assert_eq!(yields.len(), 3);
        assert!((yields[1] + 0.1).abs() < 1e-12 && (yields[2] - 0.3).abs() < 1e-12, "{yields:?}");
    }

    /// A capacity below what the first half cycle dissipates leaves the residual strength, here none: without force the
    /// spring turns and reloads at once, on both sides.
    fn exhausted<R: Real>() {
        let law = seismass::PeakOriented { energy_capacity: 1.0, ..plain() };
        let mut spring = Loop::<R>::new(&storey(2.0, 0.0, 0.0, law));
        spring.follow(&[[0.3, 10.0], [0.2, 0.0], [-0.3, 0.0], [0.5, 0.0], [0.0, 0.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Unload, 1, 0, 0.3, 10.0),
            (Reload, -1, 0, 0.2, 0.0),
            (Yield, -1, 1, -0.1, 0.0),
            (Unload, -1, 0, -0.3, 0.0),
            (Reload, 1, 0, -0.3, 0.0),
            (Yield, 1, 1, 0.3, 0.0),
            (Unload, 1, 0, 0.5, 0.0),
            (Reload, -1, 0, 0.5, 0.0),
        ]);
    }

    /// Omega = 1 has no branch 1: softening from the yield, 10 N to 0 at 0.5 m; with c = 1 it is flat at once.
    fn without_hardening<R: Real>() {
        let mut spring = Loop::<R>::new(&storey(1.0, 0.5, -0.25, plain()));
        // From (0.6, 0) straight to (-0.1, -10).
        spring.follow(&[[0.3, 5.0], [0.5, 0.0], [0.6, 0.0], [0.4, -20.0 / 7.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Yield, 1, 2, 0.5, 0.0),
            (Unload, 1, 0, 0.6, 0.0),
            (Reload, -1, 0, 0.6, 0.0),
        ]);
        let law = seismass::PeakOriented { residual_strength: 1.0, ..plain() };
        let mut spring = Loop::<R>::new(&storey(1.0, 0.5, -0.25, law));
        spring.follow(&[[0.3, 10.0]]);
        spring.logged(&[(Yield, 1, 1, 0.1, 10.0), (Yield, 1, 2, 0.1, 10.0)]);
    }

    /// A loss of all strength on a softening side leaves it where branch 3 begins: it yields twice at its peak.
    fn exhausted_on_the_softening_branch<R: Real>() {
        let law = seismass::PeakOriented { energy_capacity: 1.0, residual_strength: 0.2, ..plain() };
        let mut spring = Loop::<R>::new(&storey(1.0, 0.5, -0.25, law));
        // Zero force at 0.25 m; (0, -0.1, -2), flat: branch 2 of that side is at its end.
        spring.follow(&[[0.3, 5.0], [0.25, 0.0], [-0.1, -2.0], [-0.2, -2.0], [-0.18, 0.0], [0.3, 2.0], [0.4, 2.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Unload, 1, 0, 0.3, 5.0),
            (Reload, -1, 0, 0.25, 0.0),
            (Yield, -1, 1, -0.1, -2.0),
            (Yield, -1, 2, -0.1, -2.0),
            (Unload, -1, 0, -0.2, -2.0),
            (Reload, 1, 0, -0.18, 0.0),
            (Yield, 1, 1, 0.3, 2.0),
            (Yield, 1, 2, 0.3, 2.0),
        ]);
    }

    #[test]
    fn loops_in_both_precisions() {
        for in_precision in [
            [clough::<f64>, clough::<DoubleDouble>],
            [takeda::<f64>, takeda::<DoubleDouble>],
            [softening::<f64>, softening::<DoubleDouble>],
            [cyclic_loss::<f64>, cyclic_loss::<DoubleDouble>],
            [exhausted::<f64>, exhausted::<DoubleDouble>],
            [without_hardening::<f64>, without_hardening::<DoubleDouble>],
            [exhausted_on_the_softening_branch::<f64>, exhausted_on_the_softening_branch::<DoubleDouble>],
        ] {
            in_precision.iter().for_each(|loops| loops());
        }
    }

    /// (0.2, 15), then -25 N/m: zero force at 0.8 m; 12.5 N/m d met at 0.533 m; 5 N of residual strength meet 5 N/m d at 1 m,
    /// and nothing without P-Delta.
    #[test]
    fn collapse_is_on_the_backbone() {
        let drift = |residual_strength: f64, geometric: f64| {
            let law = seismass::PeakOriented { residual_strength, ..plain() };
            let spring = spring::<f64>(&storey(1.5, 0.5, -0.25, law));
            collapse_drift(&spring.backbone(), geometric)
        };
        assert!((drift(0.0, 0.0).unwrap() - 0.8).abs() < 1e-15);
        assert!((drift(0.0, 12.5).unwrap() - 20.0 / 37.5).abs() < 1e-15);
        assert!((drift(0.5, 5.0).unwrap() - 1.0).abs() < 1e-15);
        assert_eq!(drift(0.5, 0.0), None);
    }
}
