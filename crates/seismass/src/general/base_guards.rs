//! Guards of the sliding base.

use crate::general::guards::{Guard, Search};
use crate::general::series::Quantity;
use crate::machines::block::BlockState;
use crate::machines::sign::Sign;
use crate::tolerances::{DECISION_ROUNDING, FALL_ROUNDING};
use crate::units::STANDARD_GRAVITY;

impl Search<'_, '_> {
    /// The limit of a stuck base, or the arrival of a sliding one.
    pub(super) fn base(&mut self) {
        match self.state.base.map(|motion| motion.state) {
            Some(BlockState::Stuck) => self.base_breakaway(),
            Some(BlockState::Sliding(sign)) => self.base_arrival(sign),
            _ => {}
        }
    }

    fn base_breakaway(&mut self) {
        let (Some(base), Some(motion)) = (&self.state.system.base, &self.state.base) else { return };
        let (contact, change) =
            (self.state.interval.contact_at(self.series.tau), self.state.interval.contact_slope * self.series.h);
        let per_contact = motion.mu_s * base.carried;
        let least = per_contact * contact.min(contact + change);
        for sign in [Sign::Positive, Sign::Negative] {
            let (mut p, size) = self.series.holding_polynomial(-sign.factor(), per_contact * contact);
            if size < least {
                return;
            }
            p.coefficients[1] += per_contact * change;
            p.length = p.length.max(2);
            let of_terms = size + (per_contact * change).abs() + self.holding_size();
            let tolerance = DECISION_ROUNDING * (per_contact * contact.max(STANDARD_GRAVITY) + of_terms);
            self.consider(Guard::BaseBreakaway { sign }, &p, tolerance);
        }
    }

    /// Size of the terms of the holding force at the start of the step.
    fn holding_size(&self) -> f64 {
        self.state.holding_force(self.series.tau).1
    }

    fn base_arrival(&mut self, sign: Sign) {
        let (low, high) = self.series.range(Quantity::Rate, 0);
        if if sign == Sign::Positive { low > 0.0 } else { high < 0.0 } {
            return;
        }
        let (p, size) = self.series.polynomial(Quantity::Rate, 0, sign.factor(), 0.0);
        let of_accelerations = self.size(0) + self.state.interval.ground_at(self.series.tau).abs();
        self.consider(Guard::BaseArrival, &p, FALL_ROUNDING * (size + self.series.h * of_accelerations));
    }
}
