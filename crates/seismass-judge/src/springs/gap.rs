//! The gap law: a Masing spring beside an elastic stop on each side, which touches beyond a clearance.

use seismass::EventKind;

use super::masing::Masing;
use super::{Course, Crossing, Limit, Part, Slope, Spring, SpringGuard};
use crate::real::Real;
use crate::sign::Sign;

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
