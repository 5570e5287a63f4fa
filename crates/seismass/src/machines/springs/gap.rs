//! A trilinear spring beside an elastic stop on each side, which touches where the drift exceeds a clearance: soft up to
//! it, stiff beyond (`numerics`, section 3).

use super::masing::Masing;
use crate::machines::segment::{Backbone, Crossing, Segment, SpringMachine};
use crate::machines::sign::Sign;
use crate::response::EventKind;

/// The spring, the stops, and which of them touches.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Gap {
    spring: Masing,
    clearance: f64,
    stiffness: f64,
    /// The side that touches.
    touching: Option<Sign>,
}

impl Gap {
    pub(crate) fn new(spring: Masing, clearance: f64, stiffness: f64) -> Self {
        Self { spring, clearance, stiffness, touching: None }
    }

    /// Coordinates at which a stop is touched or left.
    fn ends_of_stops(&self) -> (f64, f64) {
        let base = self.spring.base_drift();
        match self.touching {
            None => (-self.clearance - base, self.clearance - base),
            Some(Sign::Positive) => (self.clearance - base, f64::INFINITY),
            Some(Sign::Negative) => (f64::NEG_INFINITY, -self.clearance - base),
        }
    }

    /// Force of the stop at coordinate `x`.
    fn stop_force(&self, x: f64) -> f64 {
        let at = |sign: Sign| self.stiffness * (self.spring.base_drift() - sign.factor() * self.clearance + x);
        self.touching.map_or(0.0, at)
    }

    fn stop_tangent(&self) -> f64 {
        if self.touching.is_some() { self.stiffness } else { 0.0 }
    }
}

impl SpringMachine for Gap {
    fn segment(&self) -> Segment {
        let (spring, stops) = (self.spring.segment(), self.ends_of_stops());
        Segment {
            base_force: spring.base_force + self.stop_force(0.0),
            tangent: spring.tangent + self.stop_tangent(),
            ends: (spring.ends.0.max(stops.0), spring.ends.1.min(stops.1)),
            range: spring.range.max(self.clearance).max(spring.base_drift.abs()),
            class: 2 * spring.class + u8::from(self.touching.is_some()),
            ..spring
        }
    }

    fn end(&mut self, x: f64, sign: Sign) -> Crossing {
        let (spring, stops) = (self.spring.segment().ends, self.ends_of_stops());
        let is_of_spring = match sign {
            Sign::Positive => spring.1 <= stops.1,
            Sign::Negative => spring.0 >= stops.0,
        };
        if is_of_spring {
            return self.spring.end(x, sign);
        }
        let (kind, side) = match self.touching.take() {
            Some(side) => (EventKind::Open, side),
            None => {
                self.touching = Some(sign);
                (EventKind::Close, sign)
            }
        };
        // The drift is the clearance exactly, wherever the base was: the stop has no force, and its next end is here.
        self.spring.rebase_to(x, side.factor() * self.clearance);
        Crossing::new(kind, side)
    }

    fn turn(&mut self, x: f64) -> Crossing {
        self.spring.turn(x)
    }

    fn stored(&self, x: f64, geometric: f64) -> f64 {
        let force = self.stop_force(x);
        self.spring.stored(x, geometric) + 0.5 * force * force / self.stiffness
    }

    fn dissipated(&self, x: f64, change: f64) -> f64 {
        self.spring.dissipated(x, change)
    }

    fn state_name(&self) -> &'static str {
        if self.touching.is_some() { "at a stop" } else { self.spring.state_name() }
    }

    fn backbone(&self) -> Backbone {
        let Backbone { mut breaks, last_slope } = self.spring.backbone();
        breaks.push((self.clearance, -self.stiffness));
        breaks.sort_by(|a, b| a.0.total_cmp(&b.0));
        Backbone { breaks, last_slope: last_slope + self.stiffness }
    }

    fn tangents(&self) -> Option<Vec<f64>> {
        let of_spring = self.spring.tangents()?;
        Some(of_spring.into_iter().flat_map(|tangent| [tangent, tangent + self.stiffness]).collect())
    }

    fn largest_tangent(&self) -> f64 {
        self.spring.largest_tangent() + self.stiffness
    }

    fn can_yield(&self) -> bool {
        true
    }

    fn parameters(&self) -> Vec<f64> {
        let mut parameters = self.spring.parameters();
        parameters.extend([self.clearance, self.stiffness]);
        parameters
    }
}
