//! Springs along prescribed paths of drift, at rates of one metre a second: for tests against loops computed by hand.

use seismass::{EventKind, Storey};

use super::{Course, Spring, SpringGuard, spring};
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::sign::Sign;

/// A fall beyond rounding, in units of the number type's epsilon times the size of the terms.
const ROUNDING: f64 = 64.0;

/// Kind, sign, element, drift and force of an event.
pub(super) type Logged = (EventKind, i8, u8, f64, f64);

/// A spring that is moved from one drift to the next.
pub(super) struct Loop<R> {
    pub(super) spring: Box<dyn Spring<R>>,
    drift: R,
    /// Work done on the spring.
    work: R,
    pub(super) log: Vec<Logged>,
}

impl<R: Real> Loop<R> {
    pub(super) fn new(storey: &Storey) -> Self {
        Self { spring: spring(storey), drift: R::zero(), work: R::zero(), log: Vec::new() }
    }

    pub(super) fn force(&self) -> R {
        self.spring.parts().into_iter().fold(self.spring.linear() * self.drift, |sum, part| sum + part.force)
    }

    /// Moves to a drift, through all events on the way; the force there.
    pub(super) fn to(&mut self, target: R) -> R {
        for _ in 0..50 {
            let distance = target - self.drift;
            let length = distance.abs();
            let rate = Polynomial::constant(Sign::of(distance).times(R::of(1.0)));
            let mut drift = Polynomial(vec![self.drift, distance]);
            let line = |part: super::Part<R>| Polynomial(vec![part.force, part.tangent * distance]);
            let mut forces: Vec<Polynomial<R>> = self.spring.parts().into_iter().map(line).collect();
            let mut first: Option<(R, SpringGuard)> = None;
            let course = Course { length, drift: &drift, rate: &rate, forces: &forces };
            for limit in self.spring.limits(&course, R::zero()) {
                let tolerance = R::of(ROUNDING) * R::of(R::EPSILON) * limit.size;
                let Some(place) = limit.polynomial.first_fall(tolerance) else { continue };
                if first.is_none_or(|(earliest, _)| place < earliest) {
                    first = Some((place, limit.guard));
                }
            }
            let place = first.map_or(R::of(1.0), |(place, _)| place);
            drift.shrink(place);
            forces.iter_mut().for_each(|force| force.shrink(place));
            let before = self.force();
            self.spring.advance(&Course { length: length * place, drift: &drift, rate: &rate, forces: &forces });
            self.drift = if first.is_some() { drift.end() } else { target };
            self.work = self.work + R::of(0.5) * (before + self.force()) * distance * place;
            let Some((_, guard)) = first else { return self.force() };
            for crossing in self.spring.cross(guard, self.drift) {
                let (drift, force) = (self.drift.to_f64(), self.force().to_f64());
                self.log.push((crossing.kind, crossing.sign.as_i8(), crossing.element, drift, force));
            }
        }
        panic!("the spring chatters: {:?}", self.log);
    }

    /// Moves through drifts; asserts the forces there.
    pub(super) fn follow(&mut self, points: &[[f64; 2]]) {
        for &[drift, force] in points {
            let found = self.to(R::of(drift));
            self.close(found, force);
        }
        // What goes in is stored or dissipated, to the rounding of the number type.
        let kept = self.spring.stored(self.drift) + self.spring.dissipated();
        let rounding = R::of(1e3) * R::of(R::EPSILON) * (R::of(1.0) + self.work.abs());
        assert!((self.work - kept).abs() <= rounding, "{:?} for {kept:?}: {:#?}", self.work, self.log);
    }

    /// Drifts and forces by hand are doubles, tenths among them: agreement to their rounding.
    pub(super) fn close(&self, found: R, expected: f64) {
        let apart = (found - R::of(expected)).abs().to_f64();
        assert!(apart <= 1e-13 * (1.0 + expected.abs()), "{found:?} for {expected}: {:#?}", self.log);
    }

    /// Asserts the log: kinds, signs, elements, drifts and forces.
    pub(super) fn logged(&self, expected: &[Logged]) {
        assert_eq!(self.log.len(), expected.len(), "{:#?}", self.log);
        for (found, expected) in self.log.iter().zip(expected) {
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * (1.0 + b.abs());
            let same = (found.0, found.1, found.2) == (expected.0, expected.1, expected.2);
            assert!(same && close(found.3, expected.3) && close(found.4, expected.4), "{found:?} for {expected:?}");
        }
    }
}
