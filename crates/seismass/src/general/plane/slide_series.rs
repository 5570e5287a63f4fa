//! The series of a block that slides on the circle: direction and length of its relative velocity (`numerics`, section 9.7).

use crate::general::plane::vector::{Vector2, across, dot, length, minus, plus, times};
use crate::lanes::Plain;
use crate::polynomial::orders::INVERSE;
use crate::polynomial::power::{MAX_DEGREE, Polynomial};

/// Highest order of accelerations where a block slides.
pub(super) const ORDER: usize = MAX_DEGREE - 2;

/// Part of itself by which a velocity may fall in a step: a stop is some ten steps away, and the twentieth that is left is
/// known to twenty times rounding.
const MOST_FALL: f64 = 0.95;

/// How the relative velocity begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Beginning {
    /// Not at zero: r itself is divided into length and direction.
    Moving,
    /// At zero with an acceleration: r = t R.
    Jump,
    /// At zero with acceleration zero: r = t^2 R, and the series is asymptotic.
    Smooth,
    /// At zero without friction: r = t^p R, with the power of its first term. Zero: it is not known yet.
    Free(usize),
}

impl Beginning {
    /// Whether the series is one of a start against friction, which its own direction takes part in.
    pub(super) fn is_implicit(self) -> bool {
        matches!(self, Self::Jump | Self::Smooth)
    }

    /// The power of time that is divided out of the relative velocity.
    pub(super) fn power(self) -> usize {
        match self {
            Self::Moving => 0,
            Self::Jump => 1,
            Self::Smooth => 2,
            Self::Free(power) => power,
        }
    }
}

/// How long blocks take to their stop, and the mean direction of their friction until then.
#[derive(Debug, Clone, Copy)]
pub(super) struct LastWay {
    pub(super) time: f64,
    pub(super) mean: Vector2,
}

impl LastWay {
    /// |r| + r . A/beta falls by beta - A^2/beta, whatever the angle; None: friction does not stop it.
    pub(super) fn new(r: Vector2, drive: Vector2, friction: f64) -> Option<Self> {
        let slowing = friction * friction - dot(drive, drive);
        let time = (length(r) * friction + dot(r, drive)) / slowing;
        let mean = times(1.0 / (friction * time), plus(r, times(time, drive)));
        (slowing > 0.0 && time > 0.0).then_some(Self { time, mean })
    }
}

/// Direction and length of a relative velocity, by order.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlideSeries {
    /// Position among the blocks that move, and the block.
    pub(super) position: usize,
    pub(super) block: usize,
    pub(super) beginning: Beginning,
    /// Velocity at which it ends on the straight line to its stop: its direction turns by less than shows. None: it turns.
    pub(super) straight_to: Option<f64>,
    /// The mean direction on the last way to its stop, at the end of which the step ends. None: it is not that.
    pub(super) mean: Option<Vector2>,
    /// Direction at the start of the step.
    pub(super) heading: Vector2,
    /// Terms of the direction.
    pub(super) direction: [Vector2; MAX_DEGREE + 1],
    /// Terms of the length of R.
    pub(super) length: [f64; MAX_DEGREE + 1],
    /// Terms of R.
    relative: [Vector2; MAX_DEGREE + 1],
}

impl SlideSeries {
    pub(super) fn none() -> Self {
        let none = [[0.0; 2]; MAX_DEGREE + 1];
        Self {
            position: 0,
            block: 0,
            beginning: Beginning::Moving,
            straight_to: None,
            mean: None,
            heading: [0.0; 2],
            direction: none,
            length: [0.0; MAX_DEGREE + 1],
            relative: none,
        }
    }

    /// Begins anew in place, with the direction of a start.
    pub(super) fn begin(&mut self, (position, block): (usize, usize), beginning: Beginning, direction: Vector2) {
        (self.position, self.block, self.beginning) = (position, block, beginning);
        (self.straight_to, self.mean, self.heading) = (None, None, direction);
        self.direction.fill([0.0; 2]);
        self.length.fill(0.0);
        self.direction[0] = direction;
    }

    /// Length and direction of order k of a velocity that does not begin at zero:
    /// rho_k = (sum r_i . r_(k-i) - sum rho_i rho_(k-i)) / (2 rho_0), d_k = (r_k - sum rho_i d_(k-i)) / rho_0.
    pub(super) fn divide(&mut self, k: usize, r: Vector2) {
        self.relative[k] = r;
        if k == 0 {
            self.length[0] = length(r);
            self.heading = times(1.0 / self.length[0], r);
            self.direction[0] = self.mean.unwrap_or(self.heading);
            return;
        }
        if self.mean.is_some() {
            self.length[k] = if k == 1 { -self.length[0] } else { 0.0 };
            return;
        }
        if self.straight_to.is_some() {
            self.length[k] = dot(self.direction[0], r);
            return;
        }
        let (terms, lengths) = (&self.relative[1..k], &self.length[1..k]);
        let product = |r: Vector2, other: Vector2, rho: f64, last: f64| dot(r, other) - rho * last;
        let upper = terms.iter().zip(lengths).rev();
        let pairs = terms.iter().zip(lengths).zip(upper).take((k - 1) / 2);
        let inner = pairs.map(|((r, rho), (other, last))| product(*r, *other, *rho, *last)).sum::<f64>();
        let mut squares = dot(self.relative[0], r) + inner;
        if k.is_multiple_of(2) {
            let (middle, rho) = (self.relative[k / 2], self.length[k / 2]);
            squares += 0.5 * product(middle, middle, rho, rho);
        }
        self.length[k] = squares / self.length[0];
        // Two sums, so that a term need not wait for the one before it.
        let (mut one, mut other) = (r, [0.0; 2]);
        let (lengths, last_length) = self.length[1..=k].as_chunks();
        let (first_direction, directions) = self.direction[..k].as_rchunks();
        for ([rho, next_rho], [before, d]) in lengths.iter().zip(directions.iter().rev()) {
            (one, other) = (minus(one, times(*rho, *d)), minus(other, times(*next_rho, *before)));
        }
        if let ([rho], [d]) = (last_length, first_direction) {
            one = minus(one, times(*rho, *d));
        }
        self.direction[k] = times(1.0 / self.length[0], plus(one, other));
    }

    /// Divides a velocity without friction that begins at zero by the power of its first term above a size, up to an order of
    /// accelerations. False: there is none.
    pub(super) fn divide_free(&mut self, order: usize, size: f64, term: impl Fn(usize) -> Vector2) -> bool {
        let Some(power) = (1..=order).find(|&k| length(term(k)) > if k == 1 { size } else { 0.0 }) else {
            return false;
        };
        self.beginning = Beginning::Free(power);
        (0..=order + 1 - power).for_each(|k| self.divide(k, term(k + power)));
        true
    }

    /// The direction across the first one.
    pub(super) fn normal(&self) -> Vector2 {
        across(self.direction[0])
    }

    /// What is known of the direction of order k of a start: its part along the first one, since its length is 1.
    pub(super) fn along(&mut self, k: usize) {
        if k > 0 {
            let sum: f64 = (1..k).map(|i| dot(self.direction[i], self.direction[k - i])).sum();
            self.direction[k] = times(-0.5 * sum, self.direction[0]);
        }
    }

    /// What is known of the part across of the term R_k of a jump, or R_(k-1) of a smooth start, without the direction of
    /// order k.
    pub(super) fn known_across(&self, k: usize) -> f64 {
        let normal = self.normal();
        match self.beginning {
            Beginning::Smooth => (0..k).map(|i| self.length[i] * dot(self.direction[k - 1 - i], normal)).sum(),
            _ => (1..k).map(|i| self.length[i] * dot(self.direction[k - i], normal)).sum(),
        }
    }

    /// Takes the part across of the direction of order k.
    pub(super) fn add_across(&mut self, k: usize, part: f64) {
        self.direction[k] = plus(self.direction[k], times(part, self.normal()));
    }

    /// Takes a term of R of a start, and the length of its order.
    pub(super) fn take(&mut self, k: usize, term: Vector2) {
        let first = self.direction[0];
        let known: f64 = (0..k).map(|i| self.length[i] * dot(self.direction[k - i], first)).sum();
        self.length[k] = dot(term, first) - known;
    }

    /// Takes the length of a velocity whose direction is known, by its terms.
    pub(super) fn take_length(&mut self, terms: &[Vector2]) {
        for k in 0..terms.len() {
            self.length[k] = (0..=k).map(|i| dot(terms[i], self.direction[k - i])).sum();
        }
    }

    /// Order of the last known term of R in a series of accelerations to an order.
    fn last(&self, order: usize) -> usize {
        order.min((order + 1).saturating_sub(self.beginning.power()))
    }

    /// Length of the relative velocity as a polynomial up to an order of accelerations.
    pub(super) fn speed(&self, order: usize) -> Polynomial {
        let power = self.beginning.power();
        let last = self.last(order);
        Polynomial::new(std::iter::repeat_n(0.0, power).chain(self.length[..=last].iter().copied()))
    }

    /// Integral of the length up to the place `s`, and the rate of the length there.
    pub(super) fn path_and_rate(&self, order: usize, s: f64) -> (f64, f64) {
        let power = self.beginning.power();
        let (mut path, mut rate) = (0.0, 0.0);
        // A constant has no rate.
        let lowest = usize::from(power == 0);
        for k in (0..=self.last(order)).rev() {
            path = path * s + INVERSE[k + power + 1] * self.length[k];
            if k >= lowest {
                rate = rate * s + (k + power) as f64 * self.length[k];
            }
        }
        (path * s.powi(power as i32 + 1), rate * s.powi((power + lowest) as i32 - 1))
    }

    /// Ends the series at its place `end`, which is the new 1.
    pub(super) fn shorten(&mut self, end: f64) {
        let mut power = 1.0;
        for k in 1..=MAX_DEGREE {
            power *= end;
            self.direction[k] = times(power, self.direction[k]);
            self.length[k] *= power;
        }
        let unit = end.powi(self.beginning.power() as i32);
        self.length.iter_mut().for_each(|term| *term *= unit);
    }

    /// The direction before the step, where the step goes to a stop without a turn of its own.
    pub(super) fn before_last_step(&self) -> Option<Vector2> {
        (self.mean.is_some() || self.straight_to.is_some()).then_some(self.heading)
    }

    /// Whether a velocity that falls comes to its stop before the place `last` and turns so little until then that less than
    /// `least` of it would be seen.
    pub(super) fn is_straight(&self, last: f64, least: f64) -> bool {
        let rest = -self.length[0] / self.length[1];
        // What drives it may begin at zero, and its rate too: all terms count.
        let turn = rest * self.direction[1..=ORDER].iter().rev().fold(0.0, |sum, term| sum * rest + length(*term));
        let falls = self.beginning == Beginning::Moving && self.length[1] < 0.0;
        falls && rest < last && turn * self.length[0] < least
    }

    /// The place where the length has fallen to a velocity, if it does, from a first guess by its rate.
    fn falls_to(&self, velocity: f64, order: usize) -> Option<f64> {
        let speed = self.speed(order);
        let mut s = (velocity - self.length[0]) / self.length[1];
        for _ in 0..20 {
            let (value, rate) = speed.at_with_rate::<Plain>(s);
            let change = (velocity - value) / rate;
            s += change;
            if change.abs() <= f64::EPSILON * s {
                break;
            }
        }
        (s > 0.0 && s < 1.0 && (speed.at::<Plain>(s) - velocity).abs() < 0.5 * velocity).then_some(s)
    }

    /// The longest part of the series in which the negative terms of the length are hardly more than [`MOST_FALL`] of its
    /// first: along a straight line a longer step would jump over a stop. On the straight line to a stop it is the whole way.
    pub(super) fn before_stop(&self, order: usize, mut end: f64) -> f64 {
        if self.mean.is_some() {
            return end;
        }
        if let Some(place) = self.straight_to.and_then(|velocity| self.falls_to(velocity, order)) {
            return end.min(place);
        }
        let first = self.length[0];
        if self.length[1] < 0.0 {
            end = end.min(-MOST_FALL * first / self.length[1]);
        }
        // From beyond it, Newton's method comes down to the place.
        loop {
            let (mut sum, mut rate, mut power) = (0.0, 0.0, 1.0);
            for (k, term) in self.length[..order].iter().enumerate().skip(1) {
                rate += k as f64 * power * term.min(0.0);
                power *= end;
                sum += power * term.min(0.0);
            }
            let excess = -sum - MOST_FALL * first;
            if excess <= 0.01 * first {
                return end;
            }
            end += excess / rate;
        }
    }

    /// Whether both terms of the direction before order k and at it are below rounding at the place `end`.
    fn is_below(&self, k: usize, end: f64, rounding: f64) -> bool {
        let before = rounding / end.powi(k as i32 - 1);
        length(self.direction[k - 1]) <= before && length(self.direction[k]) * end <= before
    }

    /// The longest part of the series up to its place `end` in which both terms of the direction before the last and at it
    /// are below rounding.
    pub(super) fn reach(&self, order: usize, end: f64, rounding: f64) -> f64 {
        let last = match self.beginning {
            Beginning::Free(_) => self.last(order),
            _ => order,
        }
        .max(2);
        if self.is_below(last, end, rounding) {
            return end;
        }
        let of = |k: usize| {
            let size = length(self.direction[k]);
            if size == 0.0 { f64::INFINITY } else { libm::pow(rounding / size, 1.0 / k as f64) }
        };
        of(last).min(of(last - 1)).min(end)
    }
}
