//! Guards of blocks: friction, wear and stops.

use crate::general::guards::{Guard, Search};
use crate::general::series::Quantity;
use crate::general::stops::{Contact, place_of};
use crate::machines::sign::Sign;
use crate::polynomial::power::Polynomial;
use crate::scene::Stops;
use crate::tolerances::{DECISION_ROUNDING, FALL_ROUNDING};
use crate::units::STANDARD_GRAVITY;

impl Search<'_, '_> {
    /// The limits of stuck blocks: those away from stops by the weakest of a node, others each by itself.
    pub(super) fn breakaways(&mut self) {
        let state = self.state;
        for (node, blocks) in state.system.on_node.iter().enumerate() {
            let mut weakest = f64::INFINITY;
            for &j in blocks.iter().filter(|&&j| state.motions[j].is_stuck()) {
                let force = state.stop_force(j);
                if force == 0.0 {
                    weakest = weakest.min(state.motions[j].mu_s);
                    continue;
                }
                let drive = force / state.system.blocks[j].mass;
                self.breakaway(node, state.motions[j].mu_s, drive, |sign| Guard::BreakawayAtStop { block: j, sign });
            }
            if weakest < f64::INFINITY {
                self.breakaway(node, weakest, 0.0, |sign| Guard::Breakaway { node, sign });
            }
        }
    }

    /// The limit mu N of the acceleration of a node less the acceleration `drive` that a stop gives a block.
    fn breakaway(&mut self, node: usize, mu: f64, drive: f64, guard: impl Fn(Sign) -> Guard) {
        let (state, series) = (self.state, self.series);
        let contact = state.interval.contact_at(series.tau);
        let change = state.interval.contact_slope * series.h;
        let least = mu * contact.min(contact + change);
        let (low, high) = series.range(Quantity::Acceleration, node);
        for (sign, reached) in [(Sign::Positive, high - drive), (Sign::Negative, drive - low)] {
            if reached < least {
                continue;
            }
            let limit = mu * contact;
            let constant = limit + sign.factor() * drive;
            let (mut p, size) = series.polynomial(Quantity::Acceleration, node, -sign.factor(), constant);
            p.coefficients[1] += mu * change;
            p.length = p.length.max(2);
            let sizes = (mu * change).abs() + drive.abs() + size + self.size(node);
            // Not below what a decision takes as equal: what has just stuck must not break away for that.
            let tolerance = DECISION_ROUNDING * (limit.max(mu * STANDARD_GRAVITY) + sizes);
            self.consider(guard(sign), &p, tolerance);
        }
    }

    /// Stops of the blocks that move.
    pub(super) fn stops_of_blocks(&mut self) {
        let state = self.state;
        for (position, &block) in state.moving.iter().enumerate() {
            if let Some(stops) = &state.system.stops[block] {
                self.stops(position, block, stops);
            }
        }
    }

    /// Arrivals and wear of the blocks that move.
    pub(super) fn moving_blocks(&mut self) {
        let state = self.state;
        for (position, &block) in state.moving.iter().enumerate() {
            if let Some(sign) = state.motions[block].sliding() {
                self.arrival(position, block, sign);
                if state.system.wears {
                    self.wear(position, block, sign);
                }
            }
        }
    }

    /// Size of what a block's relative velocity is integrated from.
    fn rates(&self, block: usize) -> f64 {
        let (state, law) = (self.state, &self.state.system.blocks[block]);
        let of_stop = state.stop_force(block).abs() / law.mass;
        self.size(law.floor) + state.motions[block].mu_k * STANDARD_GRAVITY + of_stop
    }

    fn arrival(&mut self, position: usize, block: usize, sign: Sign) {
        let terms = &self.series.blocks[position];
        if sign.factor() * terms.velocity[0] > terms.velocity_change {
            return;
        }
        let velocity = self.series.velocity_of(position);
        let p = Polynomial::new(velocity.coefficients().iter().map(|c| sign.factor() * c));
        let size = terms.velocity[0].abs() + terms.velocity_change;
        let tolerance = FALL_ROUNDING * (size + self.series.h * self.rates(block));
        self.consider(Guard::Arrival { block }, &p, tolerance);
    }

    fn wear(&mut self, position: usize, block: usize, sign: Sign) {
        let motion = &self.state.motions[block];
        let rest = motion.path_to_wear();
        let change = self.series.blocks[position].slip_change;
        if rest > change {
            return;
        }
        let slip = self.series.slip_of(position);
        let terms = slip.coefficients().iter().skip(1).map(|c| -sign.factor() * c);
        let size = motion.slip.abs() + motion.path() + rest.abs() + change;
        self.consider(
            Guard::Wear { block },
            &Polynomial::new(std::iter::once(rest).chain(terms)),
            FALL_ROUNDING * size,
        );
    }

    /// What the stops of a block may do.
    pub(super) fn stops(&mut self, position: usize, block: usize, stops: &Stops) {
        match self.state.stops[block].contact {
            Contact::Free => self.touch(position, block, stops),
            Contact::Touching(side) => {
                let beyond = self.state.stops[block].beyond;
                let (p, size) = self.pressure(position, beyond, stops, side.factor());
                self.consider_pressure(Guard::Leave { block }, &p, size, block, stops);
            }
            Contact::Parted(side) => self.parted(position, (block, self.state.stops[block].beyond), stops, side),
        }
    }

    /// What a stop may do from which a block has parted, of whose slip beyond the clearance so much counts as the step begins.
    pub(super) fn parted(&mut self, position: usize, (block, beyond): (usize, f64), stops: &Stops, side: Sign) {
        let (p, size) = self.pressure(position, beyond, stops, -side.factor());
        self.consider_pressure(Guard::TouchAgain { block }, &p, size, block, stops);
        self.clear(position, block, side);
    }

    /// `factor` times k z + c z', where z is the slip beyond the clearance, so much as the step begins, and the size of its
    /// terms.
    fn pressure(&self, position: usize, beyond: f64, stops: &Stops, factor: f64) -> (Polynomial, f64) {
        let terms = &self.series.blocks[position];
        let (k, c) = (factor * stops.stiffness, factor * stops.damping);
        let slip = self.series.slip_of(position);
        let of_order =
            |(order, slip): (usize, &f64)| k * if order == 0 { beyond } else { *slip } + c * terms.velocity[order];
        let p = Polynomial::new(slip.coefficients().iter().enumerate().map(of_order));
        let velocity = terms.velocity[0].abs() + terms.velocity_change;
        (p, stops.stiffness * (beyond.abs() + terms.slip_change) + stops.damping * velocity)
    }

    fn consider_pressure(&mut self, guard: Guard, p: &Polynomial, size: f64, block: usize, stops: &Stops) {
        let changes: f64 = p.coefficients().iter().skip(1).map(|c| c.abs()).sum();
        if p.coefficients[0] > changes {
            return;
        }
        let h = self.series.h;
        let of_rates = (stops.damping + h * stops.stiffness) * h * self.rates(block);
        self.consider(guard, p, FALL_ROUNDING * (size + of_rates));
    }

    /// A free block comes to a stop.
    fn touch(&mut self, position: usize, block: usize, stops: &Stops) {
        let (slip, terms) = (self.state.motions[block].slip, &self.series.blocks[position]);
        for side in [Sign::Positive, Sign::Negative] {
            let factor = side.factor();
            let rest = factor * (place_of(stops, side) - slip);
            if rest > terms.slip_change {
                continue;
            }
            let change = self.series.slip_of(position);
            let of_slip = change.coefficients().iter().skip(1).map(|c| -factor * c);
            let p = Polynomial::new(std::iter::once(rest).chain(of_slip));
            let size = slip.abs() + place_of(stops, side).abs() + terms.slip_change;
            self.consider(Guard::Touch { block, side }, &p, FALL_ROUNDING * size);
        }
    }

    /// A parted block comes back to the place of its stop.
    fn clear(&mut self, position: usize, block: usize, side: Sign) {
        let (beyond, change) = (self.state.stops[block].beyond, self.series.blocks[position].slip_change);
        if side.factor() * beyond > change {
            return;
        }
        let slip = self.series.slip_of(position);
        let terms = std::iter::once(beyond).chain(slip.coefficients().iter().skip(1).copied());
        let p = Polynomial::new(terms.map(|c| side.factor() * c));
        let size = beyond.abs() + change + self.state.motions[block].slip.abs();
        self.consider(Guard::Clear { block }, &p, FALL_ROUNDING * size);
    }
}
