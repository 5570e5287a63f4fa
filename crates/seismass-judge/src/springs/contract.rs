//! What a law tells the run: parts of its force, what it waits for, and what happens then.

use std::fmt::Debug;

use seismass::EventKind;

use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::sign::Sign;

/// A force that the run integrates with the drift rate: it never comes from the difference of two large drifts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part<R> {
    pub(crate) force: R,
    /// Slope over drift (N/m), until the next event.
    pub(crate) tangent: R,
}

/// Drift, drift rate and forces of one storey over a stretch of time, as polynomials on [0, 1].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course<'a, R> {
    pub(crate) length: R,
    pub(crate) drift: &'a Polynomial<R>,
    pub(crate) rate: &'a Polynomial<R>,
    /// Those of the parts, in their order.
    pub(crate) forces: &'a [Polynomial<R>],
}

impl<R: Real> Course<'_, R> {
    /// Change of the drift, not as a difference of drifts.
    pub(crate) fn advance(&self) -> R {
        self.length * self.rate.integral()
    }
}

/// What a spring waits for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SpringGuard {
    /// An elastic element, or a virgin spring, reaches its yield force of this sign.
    Yield { element: usize, sign: Sign },
    /// The drift rate, of this sign, turns: the run sets it to zero.
    Turn(Sign),
    /// A stop touches at a drift of this sign.
    Close(Sign),
    /// The stop that touches is left.
    Open,
    /// A branch of the backbone ends.
    BranchEnd,
    /// An unloading spring comes to zero force.
    ZeroForce,
    /// An unloading spring comes back to where it began to unload.
    Return,
    /// A reloading spring comes to the peak it aims at.
    Peak,
}

/// A guard as a polynomial that is positive until it falls, and the size of its terms.
#[derive(Debug, Clone)]
pub(crate) struct Limit<R> {
    pub(crate) guard: SpringGuard,
    pub(crate) polynomial: Polynomial<R>,
    pub(crate) size: R,
}

impl<R: Real> Limit<R> {
    /// `value` in the direction `sign` stays below `limit`.
    pub(crate) fn below(guard: SpringGuard, limit: R, sign: Sign, value: &Polynomial<R>) -> Self {
        let polynomial = Polynomial::constant(limit).plus(&value.scaled(sign.times(R::of(-1.0))));
        Self { guard, polynomial, size: limit.abs() + value.size() }
    }

    /// `value` in the direction `sign` stays above `limit`.
    pub(crate) fn above(guard: SpringGuard, limit: R, sign: Sign, value: &Polynomial<R>) -> Self {
        Self::below(guard, -limit, sign.opposite(), value)
    }

    /// The drift rate keeps this sign; its rounding beyond its own terms is that of a velocity of this size.
    pub(crate) fn no_turn(sign: Sign, rate: &Polynomial<R>, size: R) -> Self {
        let polynomial = rate.scaled(sign.times(R::of(1.0)));
        let size = polynomial.size() + size;
        Self { guard: SpringGuard::Turn(sign), polynomial, size }
    }
}

/// What an event log says of an event of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    pub(crate) kind: EventKind,
    pub(crate) sign: Sign,
    pub(crate) element: u8,
}

impl Crossing {
    pub(crate) fn new(kind: EventKind, sign: Sign, element: usize) -> Self {
        Self { kind, sign, element: element as u8 }
    }
}

/// A storey spring. Its force is the sum of its parts and of `linear` times the drift.
pub(crate) trait Spring<R>: Debug {
    /// A copy.
    fn copied(&self) -> Box<dyn Spring<R>>;

    /// Sets the virgin spring to a drift in its elastic range.
    fn start(&mut self, drift: R);

    /// Parts of the force.
    fn parts(&self) -> Vec<Part<R>>;

    /// Stiffness of what never yields, beside the parts.
    fn linear(&self) -> R;

    /// The largest tangent of any state.
    fn largest_stiffness(&self) -> R;

    /// The monotonic backbone: drifts from which slopes hold, the first at zero.
    fn backbone(&self) -> Vec<Slope<R>>;

    /// What ends the present state; `rate_size` measures the rounding of the drift rate.
    fn limits(&self, course: &Course<R>, rate_size: R) -> Vec<Limit<R>>;

    /// Moves to the end of a stretch.
    fn advance(&mut self, course: &Course<R>);

    /// Carries out an event at this drift; what the log says of it.
    fn cross(&mut self, guard: SpringGuard, drift: R) -> Vec<Crossing>;

    /// Energy stored at this drift.
    fn stored(&self, drift: R) -> R;

    /// Energy dissipated since the start.
    fn dissipated(&self) -> R;

    /// Multiplies forces by factors, but those that are no result of rounding.
    fn scale(&mut self, factor: &mut dyn FnMut() -> R);
}

/// A slope of a backbone, from a drift on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slope<R> {
    pub(crate) from: R,
    pub(crate) slope: R,
}
