//! A storey's spring in a run: its law, the segment that it is on, and when the storey collapses (`numerics`, section 3).

use crate::machines::segment::{Crossing, Segment};
use crate::machines::sign::Sign;
use crate::machines::springs::Spring;
use crate::scene::Storey;

/// The constant data of a storey spring.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StoreyLaw {
    /// The virgin spring.
    pub(crate) spring: Spring,
    /// P/h, subtracted from the tangent always.
    pub(crate) geometric: f64,
    /// Drift at which the storey collapses; infinite: never.
    pub(crate) collapse_drift: f64,
}

impl StoreyLaw {
    pub(crate) fn new(storey: &Storey, geometric: f64, collapse_drift: Option<f64>) -> Self {
        let spring = Spring::new(storey);
        let collapse_drift = collapse_drift.unwrap_or_else(|| spring.law().backbone().collapse_drift(geometric));
        Self { spring, geometric, collapse_drift }
    }

    /// Slope of the backbone beyond all its breaks, without P-Delta.
    pub(crate) fn last_slope(&self) -> f64 {
        self.spring.law().backbone().last_slope
    }
}

/// A storey spring in motion.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StoreySpring {
    spring: Spring,
    segment: Segment,
}

impl StoreySpring {
    /// A virgin spring.
    pub(crate) fn new(law: &StoreyLaw) -> Self {
        Self { segment: law.spring.law().segment(), spring: law.spring.clone() }
    }

    /// The segment that it is on.
    #[inline]
    pub(crate) fn segment(&self) -> &Segment {
        &self.segment
    }

    /// Sign that the drift rate must keep, if there is one.
    #[inline]
    pub(crate) fn rate_sign(&self) -> Option<Sign> {
        self.segment.rate_sign
    }

    /// Name of the state, for errors.
    pub(crate) fn state_name(&self) -> &'static str {
        self.spring.law().state_name()
    }

    /// Drift at coordinate `x`.
    #[inline]
    pub(crate) fn drift(&self, x: f64) -> f64 {
        self.segment.base_drift + x
    }

    /// Spring force at the base less P-Delta.
    pub(crate) fn base_load(&self, law: &StoreyLaw) -> f64 {
        self.segment.base_force - law.geometric * self.segment.base_drift
    }

    /// The segment ends at coordinate `x`, which becomes the new base.
    pub(crate) fn end(&mut self, x: f64, sign: Sign) -> Crossing {
        let crossing = self.spring.law_mut().end(x, sign);
        self.segment = self.spring.law().segment();
        crossing
    }

    /// The drift rate turns at coordinate `x`, which becomes the new base.
    pub(crate) fn turn(&mut self, x: f64) -> Crossing {
        let crossing = self.spring.law_mut().turn(x);
        self.segment = self.spring.law().segment();
        crossing
    }

    /// Energy stored at coordinate `x`, less the work of P-Delta.
    pub(crate) fn stored(&self, law: &StoreyLaw, x: f64) -> f64 {
        self.spring.law().stored(x, law.geometric)
    }

    /// Energy dissipated on the way from coordinate `x` by `change`.
    pub(crate) fn dissipated(&self, x: f64, change: f64) -> f64 {
        self.spring.law().dissipated(x, change)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{self, PeakOriented};

    /// V(d) = 20 beyond 1.1 m (r2 = 0.1, r3 = 0, Omega = 2) meets 4 d at 5 m.
    #[test]
    fn collapse_drift_is_where_the_backbone_meets_p_delta() {
        let storey = Storey { overstrength: 2.0, second_slope: 0.1, ..Storey::yielding(100.0, 10.0) };
        let drift = |storey: &Storey, geometric: f64| StoreyLaw::new(storey, geometric, None).collapse_drift;
        assert!((drift(&storey, 4.0) - 5.0).abs() < 1e-12);
        // 10 + 10 (d - 0.1) = 40 d on the second slope.
        assert!((drift(&storey, 40.0) - 0.3).abs() < 1e-12);
        assert_eq!(drift(&storey, 0.0), f64::INFINITY);
        assert_eq!(StoreyLaw::new(&storey, 4.0, Some(2.5)).collapse_drift, 2.5);
    }

    /// A stop of 50 N/m from 0.2 m on carries what P-Delta of 30 N/m takes, but not where the spring is met before.
    #[test]
    fn a_stop_may_come_too_late() {
        let of_clearance = |clearance: f64| {
            let law = scene::SpringLaw::Gap { clearance, stop_stiffness: 50.0 };
            let storey = Storey { second_slope: 0.0, third_slope: 0.0, law, ..Storey::yielding(100.0, 10.0) };
            StoreyLaw::new(&storey, 30.0, None).collapse_drift
        };
        assert_eq!(of_clearance(0.2), f64::INFINITY);
        // 10 = 30 d before the stop touches.
        assert!((of_clearance(0.5) - 1.0 / 3.0).abs() < 1e-15);
    }

    /// Slopes 100, 10 to 20 N at 1.1 m, then -20 N/m: zero at 2.1 m; with 25 % residual, 2.5 N, flat from 1.975 m on.
    #[test]
    fn a_softening_storey_collapses_where_its_force_is_gone_or_p_delta_meets_it() {
        let of = |residual_strength: f64, geometric: f64| {
            let law = scene::SpringLaw::PeakOriented(PeakOriented { residual_strength, ..PeakOriented::default() });
            let storey = Storey { second_slope: 0.1, third_slope: -0.2, law, ..Storey::yielding(100.0, 10.0) };
            StoreyLaw::new(&storey, geometric, None).collapse_drift
        };
        assert!((of(0.0, 0.0) - 2.1).abs() < 1e-12);
        assert_eq!(of(0.25, 0.0), f64::INFINITY);
        // 2.5 = d on the residual strength; 20 - 20 (d - 1.1) = 10 d before it.
        assert!((of(0.25, 1.0) - 2.5).abs() < 1e-12);
        assert!((of(0.25, 10.0) - 1.4).abs() < 1e-12);
    }
}
