//! The gap law: a Masing spring beside an elastic stop on each side, which touches beyond a clearance.

use seismass::EventKind;

use crate::real::Real;
use crate::sign::Sign;
use crate::springs::contract::{Course, Crossing, Limit, Part, Slope, Spring, SpringGuard};
use crate::springs::masing::Masing;

/// A spring and its stops. Both touch at a drift, so that they agree where; the stop's force is zero there.
#[derive(Debug, Clone)]
pub(super) struct Gap<R> {
    spring: Masing<R>,
    clearance: R,
    stiffness: R,
    /// Sign of the drift while a stop touches.
    closed: Option<Sign>,
    /// Force of the stop.
    force: R,
}

impl<R: Real> Gap<R> {
    pub(super) fn new(spring: Masing<R>, clearance: R, stiffness: R) -> Self {
        Self { spring, clearance, stiffness, closed: None, force: R::zero() }
    }
}

impl<R: Real + 'static> Spring<R> for Gap<R> {
    fn copied(&self) -> Box<dyn Spring<R>> {
        Box::new(self.clone())
    }

    fn start(&mut self, drift: R) {
        self.spring.start(drift);
    }

    fn parts(&self) -> Vec<Part<R>> {
        let tangent = if self.closed.is_some() { self.stiffness } else { R::zero() };
        let mut parts = self.spring.parts();
        parts.push(Part { force: self.force, tangent });
        parts
    }

    fn linear(&self) -> R {
        self.spring.linear()
    }

    fn largest_stiffness(&self) -> R {
        self.spring.largest_stiffness() + self.stiffness
    }

    fn backbone(&self) -> Vec<Slope<R>> {
        let spring = self.spring.backbone();
        let (before, after): (Vec<_>, Vec<_>) = spring.into_iter().partition(|slope| slope.from < self.clearance);
        let touching = before.last().map(|last| Slope { from: self.clearance, slope: last.slope });
        let stiffer = |slope: Slope<R>| Slope { slope: slope.slope + self.stiffness, ..slope };
        let beyond = touching.into_iter().chain(after).map(stiffer);
        before.iter().copied().chain(beyond).collect()
    }

    fn limits(&self, course: &Course<R>, rate_size: R) -> Vec<Limit<R>> {
        let mut limits = self.spring.limits(course, rate_size);
        match self.closed {
            None => {
                for sign in [Sign::Positive, Sign::Negative] {
                    limits.push(Limit::below(SpringGuard::Close(sign), self.clearance, sign, course.drift));
                }
            }
            Some(sign) => limits.push(Limit::above(SpringGuard::Open, self.clearance, sign, course.drift)),
        }
        limits
    }

    fn advance(&mut self, course: &Course<R>) {
        self.spring.advance(course);
        self.force = course.forces.last().map_or(self.force, |force| force.end());
    }

    fn cross(&mut self, guard: SpringGuard, drift: R) -> Vec<Crossing> {
        match guard {
            SpringGuard::Close(sign) => {
                self.force = R::zero();
                self.closed = Some(sign);
                vec![Crossing::new(EventKind::Close, sign, 0)]
            }
            SpringGuard::Open => {
                self.force = R::zero();
                self.closed.take().map(|sign| Crossing::new(EventKind::Open, sign, 0)).into_iter().collect()
            }
            other => self.spring.cross(other, drift),
        }
    }

    fn stored(&self, drift: R) -> R {
        self.spring.stored(drift) + R::of(0.5) * self.force * self.force / self.stiffness
    }

    fn dissipated(&self) -> R {
        self.spring.dissipated()
    }

    fn scale(&mut self, factor: &mut dyn FnMut() -> R) {
        self.spring.scale(factor);
        self.force = self.force * factor();
    }
}

#[cfg(test)]
mod tests {
    use seismass::{SpringLaw, Storey};

    use super::*;
    use crate::real::DoubleDouble;
    use crate::springs::loops::Loop;
    use crate::springs::{collapse_drift, spring};

    /// Elastic-plastic, 100 N/m up to 10 N, with stops of 400 N/m beyond 0.25 m.
    fn storey() -> Storey {
        let law = SpringLaw::Gap { clearance: 0.25, stop_stiffness: 400.0 };
        Storey { law, second_slope: 0.0, ..Storey::yielding(100.0, 10.0) }
    }

    fn gap_loop<R: Real>() {
        let mut spring = Loop::<R>::new(&storey());
        spring.follow(&[[0.1, 10.0], [0.25, 10.0], [0.3, 30.0]]);
        // Unloading elastic: 500 N/m to the stop's end, 100 N/m after it.
        spring.follow(&[[0.25, 5.0], [0.1, -10.0], [-0.25, -10.0], [-0.35, -50.0], [-0.25, 0.0]]);
        use EventKind::{Close, Open, Unload, Yield};
        spring.logged(&[
            (Yield, 1, 1, 0.1, 10.0),
            (Close, 1, 0, 0.25, 10.0),
            (Unload, 1, 0, 0.3, 30.0),
            (Open, 1, 0, 0.25, 5.0),
            (Yield, -1, 1, 0.1, -10.0),
            (Close, -1, 0, -0.25, -10.0),
            (Unload, -1, 0, -0.35, -50.0),
        ]);
        // 10 N over 0.2 m and 0.45 m; the stop gives back what it took.
        spring.close(spring.spring.dissipated(), 6.5);
        spring.follow(&[[0.0, 10.0]]);
        assert_eq!(spring.log[7].0, Open);
    }

    #[test]
    fn a_loop_in_both_precisions() {
        gap_loop::<f64>();
        gap_loop::<DoubleDouble>();
    }

    /// 10 N meets 50 d at 0.2 m, before the stop; 30 d is met by no line before it, and 400 N/m are steeper than it; with
    /// stops of 10 N/m, 10 + 10 (d - 0.25) = 30 d at 0.375 m.
    #[test]
    fn collapse_counts_the_stop() {
        let drift = |stiffness: f64, geometric: f64| {
            let law = SpringLaw::Gap { clearance: 0.25, stop_stiffness: stiffness };
            let spring = spring::<f64>(&Storey { law, ..storey() });
            collapse_drift(&spring.backbone(), geometric)
        };
        assert!((drift(400.0, 50.0).unwrap() - 0.2).abs() < 1e-15);
        assert_eq!(drift(400.0, 30.0), None);
        assert!((drift(10.0, 30.0).unwrap() - 0.375).abs() < 1e-15);
    }
}
