//! Guards, and the first that falls (`numerics`, sections 5 and 9.3).

use super::arrangement::Machines;
use super::series::{Series, place};
use super::state::{State, Stopped};
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::sign::Sign;
use crate::springs::SpringGuard;
use crate::state::Contact;

/// Rounding of a guard, in units of the number type's epsilon times the size of its terms.
pub(super) const ROUNDING: f64 = 64.0;
/// Places of roots at one drift differ by at most so much rounding: what it is over the drift that is left.
const SAME_PLACE: f64 = 1024.0;

/// A state machine's condition for staying as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Guard {
    /// g + a_v keeps its sign.
    Contact,
    /// A spring stays in its state.
    Spring { node: usize, guard: SpringGuard },
    /// A spring stays below its collapse drift.
    Collapse { node: usize },
    /// A stuck block stays below its limit, with this sign of what drives it.
    Breakaway { block: usize, sign: Sign },
    /// A sliding block's relative velocity keeps its sign.
    Arrival { block: usize },
    /// A sliding block's path stays below that of its next stage of wear.
    Wear { block: usize },
    /// A stuck slab stays below its limit, with this sign of the force that holds it.
    BaseBreakaway { sign: Sign },
    /// The velocity of a sliding slab keeps its sign.
    BaseArrival,
    /// A moving block stays within its clearance on this side.
    Touch { block: usize, side: Sign },
    /// The force of a stop stays above zero.
    Leave { block: usize },
    /// A block that has parted from its stop stays beyond its clearance.
    Within { block: usize },
    /// What the force of a stop would be stays below zero where its block has parted from it.
    Again { block: usize, side: Sign },
}

/// The first fall of the guards looked at so far.
pub(super) struct First<R> {
    /// Place on the stretch, direction and guard.
    pub(super) found: Option<(R, usize, Guard)>,
    pub(super) rounding: R,
    /// Direction of the guards looked at: 0 where there is but one.
    pub(super) direction: usize,
}

impl<R: Real> First<R> {
    pub(super) fn new() -> Self {
        Self { found: None, rounding: R::of(ROUNDING) * R::epsilon(), direction: 0 }
    }

    pub(super) fn consider(&mut self, guard: Guard, polynomial: &Polynomial<R>, size: R) {
        let rounding = self.rounding;
        let Some(place) = polynomial.first_fall(rounding * size) else { return };
        // At A = 0 a stuck block's limit and the contact force vanish together: contact comes first. A backbone may end
        // where the storey collapses: collapse comes first.
        let earlier = |(other, _, before): (R, usize, Guard)| {
            place
                < match (guard, before) {
                    (_, Guard::Contact) => other - rounding * other,
                    (Guard::Collapse { node }, Guard::Spring { node: ends, .. }) if node == ends => {
                        other + R::of(SAME_PLACE) * rounding
                    }
                    _ => other,
                }
        };
        if self.found.is_none_or(earlier) {
            self.found = Some((place, self.direction, guard));
        }
    }
}

impl<R: Real> Machines<'_, R> {
    /// The first guard that falls on a stretch, and its place on it in [0, 1].
    pub(super) fn first_event(&self, series: &Series<R>) -> Option<(R, usize, Guard)> {
        let sizes = series.acceleration_sizes(self.model, self.state);
        let mut first = First::new();
        self.contact_and_springs(series, &sizes, &mut first);
        // Of what happens at one instant stops come first, as their forces may jump.
        let goods = 0..self.model.goods.len();
        goods.clone().filter(|&j| !self.is_stuck(j)).for_each(|j| self.stops((j, false), series, &sizes, &mut first));
        for j in goods {
            match self.state.blocks[j].contact {
                Contact::Stuck => self.breakaway(j, series, &sizes, &mut first),
                Contact::Sliding(sign) => self.sliding(j, sign, series, &sizes, &mut first),
                Contact::Airborne => {}
            }
        }
        self.base(series, &mut first);
        first.found
    }

    pub(super) fn contact_and_springs(&self, series: &Series<R>, sizes: &[R], first: &mut First<R>) {
        let (model, state) = (self.model, &*self.state);
        if !state.blocks.is_empty() || state.base.is_some() {
            let gravity = model.gravity + series.contact.size();
            let rounding = first.rounding * gravity;
            let mut contact = series.contact.clone();
            if *self.airborne {
                contact = contact.scaled(R::of(-1.0));
            } else if contact.start() <= rounding && contact.end() <= rounding && self.drive.contact[1] <= R::zero() {
                // No contact force all along the stretch, though never below zero; one that grows is too short.
                contact = Polynomial::constant(-gravity);
            }
            first.consider(Guard::Contact, &contact, gravity);
        }
        for (node, data) in model.springs.iter().enumerate() {
            let rate_size = self.piece * (sizes[place(model.parent[node])] + sizes[node + 1]);
            for limit in state.springs[node].limits(&series.course(node), rate_size) {
                first.consider(Guard::Spring { node, guard: limit.guard }, &limit.polynomial, limit.size);
            }
            let Some(limit) = data.collapse_drift else { continue };
            for sign in [Sign::Positive, Sign::Negative] {
                let guard = Polynomial::constant(limit).plus(&series.drift[node].scaled(sign.times(R::of(-1.0))));
                first.consider(Guard::Collapse { node }, &guard, limit + series.drift[node].size());
            }
        }
    }

    fn breakaway(&self, block: usize, series: &Series<R>, sizes: &[R], first: &mut First<R>) {
        let data = &self.model.goods[block];
        let mu = self.state.blocks[block].mu_s;
        let on_stop = self.state.push(self.model, block) / data.mass;
        let driven = series.acceleration[place(data.node)].plus(&Polynomial::constant(on_stop));
        let size = mu * (self.model.gravity + series.contact.size()) + sizes[place(data.node)] + on_stop.abs();
        for sign in [Sign::Positive, Sign::Negative] {
            let guard = series.contact.scaled(mu).plus(&driven.scaled(sign.times(R::of(-1.0))));
            first.consider(Guard::Breakaway { block, sign }, &guard, size);
        }
    }

    fn sliding(&self, block: usize, sign: Sign, series: &Series<R>, sizes: &[R], first: &mut First<R>) {
        let (data, state) = (&self.model.goods[block], &self.state.blocks[block]);
        let guard = series.velocity[block].scaled(sign.times(R::of(1.0)));
        let size = guard.size() + self.piece * self.relative_size(block, series, sizes);
        first.consider(Guard::Arrival { block }, &guard, size);
        if let Some(next) = data.stages.get(state.stage + 1) {
            let slipped = series.slipped(block).scaled(sign.times(R::of(-1.0)));
            let size = next.path + slipped.size();
            let left = Polynomial::constant(next.path - state.path).plus(&slipped);
            first.consider(Guard::Wear { block }, &left, size);
        }
    }

    /// Size of the terms of a block's acceleration relative to its node.
    fn relative_size(&self, block: usize, series: &Series<R>, sizes: &[R]) -> R {
        let data = &self.model.goods[block];
        let gravity = self.model.gravity + series.contact.size();
        let stop = if self.presses(block) { series.push_size(self.model, block) / data.mass } else { R::zero() };
        sizes[place(data.node)] + self.state.blocks[block].mu_k * gravity + stop
    }

    /// Whatever the stops of a block may do. One that starts away from them at rest is pressed again by its motion from then
    /// on alone.
    pub(super) fn stops(
        &self,
        (block, starts_away): (usize, bool),
        series: &Series<R>,
        sizes: &[R],
        first: &mut First<R>,
    ) {
        let Some(stops) = &self.model.goods[block].stops else { return };
        // Slip beyond the stop of a side.
        let beyond = |side: Sign| {
            let place = State::place_of_stop(self.model, block, side)?;
            let slip = series.slip[block].plus(&Polynomial::constant(-place));
            Some((slip.scaled(side.times(R::of(1.0))), series.slip[block].size() + place.abs()))
        };
        let opposite = R::of(-1.0);
        match self.state.stopped[block] {
            Stopped::Free => {
                for side in [Sign::Positive, Sign::Negative] {
                    if let Some((slip, size)) = beyond(side) {
                        first.consider(Guard::Touch { block, side }, &slip.scaled(opposite), size);
                    }
                }
            }
            Stopped::Pressing(side) => {
                let force = series.push[block].scaled(side.times(R::of(1.0)));
                let velocity = self.piece * self.relative_size(block, series, sizes);
                let size = series.push_size(self.model, block) + stops.damping * velocity;
                first.consider(Guard::Leave { block }, &force, size);
            }
            Stopped::Parted(side) => {
                let Some((slip, size)) = beyond(side) else { return };
                first.consider(Guard::Within { block }, &slip, size);
                let velocity = series.velocity[block].scaled(side.times(stops.damping));
                let counted = if starts_away { slip.plus(&Polynomial::constant(-slip.start())) } else { slip };
                let force = counted.scaled(stops.stiffness).plus(&velocity).scaled(opposite);
                let rounding = stops.damping * self.piece * self.relative_size(block, series, sizes);
                let size = stops.stiffness * size + velocity.size() + rounding;
                first.consider(Guard::Again { block, side }, &force, size);
            }
        }
    }
}
