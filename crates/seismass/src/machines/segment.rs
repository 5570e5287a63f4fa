//! The contract of a spring law: it hands out segments, and nothing else of it is known to the run.
//!
//! Between two events a storey spring is a straight line of force over drift. A law gives that line with the drifts at
//! which it ends, and changes its own state when it does; force and drift are continuous there. A new law is a file in
//! `springs/`, a variant of `Spring`, and one way to give its parameters in `scene`.

use crate::machines::sign::Sign;
use crate::response::EventKind;
use crate::tolerances::SAME_FORCE;

/// A straight piece of a spring's force over drift. Its drift coordinate counts from its base, the drift of the last
/// event: however far the storey has yielded, a force never comes from the difference of two large drifts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment {
    /// Drift at the base (m).
    pub(crate) base_drift: f64,
    /// Force at the base (N).
    pub(crate) base_force: f64,
    /// Slope, without P-Delta (N/m).
    pub(crate) tangent: f64,
    /// Drift coordinates at which it ends, below and above; infinite where it does not.
    pub(crate) ends: (f64, f64),
    /// Size of the drifts that the ends come from: times rounding, their error (m).
    pub(crate) range: f64,
    /// Sign that the drift rate keeps: the segment ends too where the rate turns. None: it may have either.
    pub(crate) rate_sign: Option<Sign>,
    /// Which of the law's tangents it has ([`SpringMachine::tangents`]); without meaning where these are not a finite set.
    pub(crate) class: u8,
}

impl Segment {
    /// The line through a base, without ends.
    pub(crate) fn line(base_drift: f64, base_force: f64, tangent: f64) -> Self {
        let ends = (f64::NEG_INFINITY, f64::INFINITY);
        Self { base_drift, base_force, tangent, ends, range: 0.0, rate_sign: None, class: 0 }
    }

    /// The same line, that ends at the coordinate `end` in one direction alone, in which the rate must go.
    pub(crate) fn towards(self, sign: Sign, end: f64) -> Self {
        let ends = match sign {
            Sign::Positive => (f64::NEG_INFINITY, end),
            Sign::Negative => (end, f64::INFINITY),
        };
        Self { ends, rate_sign: Some(sign), ..self }
    }

    /// Force at a drift coordinate (N).
    pub(crate) fn force(&self, x: f64) -> f64 {
        self.base_force + self.tangent * x
    }
}

/// What an event of a spring is called in the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    pub(crate) kind: EventKind,
    pub(crate) sign: i8,
    pub(crate) element: u8,
}

impl Crossing {
    pub(crate) fn new(kind: EventKind, sign: Sign) -> Self {
        Self { kind, sign: sign.as_i8(), element: 0 }
    }

    /// A yield, after which so many segments of the backbone have been left.
    pub(crate) fn of_yield(sign: Sign, left: usize) -> Self {
        Self { kind: EventKind::Yield, sign: sign.as_i8(), element: left as u8 }
    }
}

/// The monotonic backbone of a virgin spring: where its slope changes, by how much, and the slope at last.
pub(crate) struct Backbone {
    /// Drifts, increasing, and by how much the slope falls there.
    pub(crate) breaks: Vec<(f64, f64)>,
    pub(crate) last_slope: f64,
}

impl Backbone {
    /// The drift d > 0 where the backbone meets the line `geometric` d; infinite if it never does.
    pub(crate) fn collapse_drift(&self, geometric: f64) -> f64 {
        let falls = self.breaks.iter().map(|&(_, fall)| fall);
        let is_concave = falls.clone().all(|fall| fall >= 0.0);
        if self.last_slope >= geometric && is_concave {
            return f64::INFINITY;
        }
        let mut slope = self.last_slope - geometric + falls.sum::<f64>();
        let (mut drift, mut margin, mut largest) = (0.0, 0.0, 0.0_f64);
        for &(end, fall) in &self.breaks {
            let next = margin + slope * (end - drift);
            largest = largest.max(next);
            // What is met at a break is met there but for rounding.
            if next <= SAME_FORCE * largest {
                return drift - margin / slope;
            }
            (drift, margin) = (end, next);
            slope -= fall;
        }
        if !is_concave {
            slope = self.last_slope - geometric;
        }
        if slope < 0.0 { drift - margin / slope } else { f64::INFINITY }
    }
}

/// A spring law in motion: its parameters and its state.
pub(crate) trait SpringMachine {
    /// The present segment.
    fn segment(&self) -> Segment;

    /// The segment has come to its end at the coordinate `x`, below or above by `sign`: another one begins there.
    fn end(&mut self, x: f64, sign: Sign) -> Crossing;

    /// The drift rate has turned at the coordinate `x`, where the segment does not allow it: another one begins there.
    fn turn(&mut self, x: f64) -> Crossing;

    /// Energy stored at the coordinate `x`, less the work of a geometric stiffness (J).
    fn stored(&self, x: f64, geometric: f64) -> f64;

    /// Energy dissipated on the way from the coordinate `x` by `change` (J).
    fn dissipated(&self, x: f64, change: f64) -> f64;

    /// Name of the state, for errors.
    fn state_name(&self) -> &'static str;

    /// The backbone of the virgin spring.
    fn backbone(&self) -> Backbone;

    /// All tangents that the law can have, by [`Segment::class`]; none where they are not known in advance.
    fn tangents(&self) -> Option<Vec<f64>>;

    /// The largest of its tangents (N/m).
    fn largest_tangent(&self) -> f64;

    /// Whether it can leave its first segment.
    fn can_yield(&self) -> bool;

    /// What its response depends on, beside its tangents.
    fn parameters(&self) -> Vec<f64>;
}
