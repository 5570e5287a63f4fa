//! Guards of springs, nodes and contact as polynomials, and the first of all guards that falls
//! (`numerics`, sections 5 and 9.4).

use std::cell::OnceCell;

use crate::general::series::{Quantity, Series};
use crate::general::state::GeneralState;
use crate::lanes::Plain;
use crate::machines::sign::Sign;
use crate::polynomial::power::Polynomial;
use crate::tolerances::{FALL_ROUNDING, NO_CONTACT, SAME_DRIFT};
use crate::units::STANDARD_GRAVITY;

/// What happens when a guard falls. Nodes count from 1, blocks from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Guard {
    /// A spring comes to an end of its segment.
    SegmentEnd { node: usize, sign: Sign },
    /// A storey reaches its collapse drift.
    Collapse { node: usize },
    /// A drift rate turns where the segment does not allow it.
    Turn { node: usize },
    /// The weakest of the blocks stuck to a node without touching a stop breaks away, with this sign of the node's
    /// acceleration.
    Breakaway { node: usize, sign: Sign },
    /// A block stuck at its stop breaks away, with this sign of what drives it back.
    BreakawayAtStop { block: usize, sign: Sign },
    /// The base breaks away, with this sign of the force that holds it.
    BaseBreakaway { sign: Sign },
    /// The sliding base comes to rest.
    BaseArrival,
    /// A sliding block comes to rest.
    Arrival { block: usize },
    /// The friction coefficients of a sliding block change.
    Wear { block: usize },
    /// The contact force of all blocks vanishes or returns.
    Contact,
    /// A block comes to the stop of a side.
    Touch { block: usize, side: Sign },
    /// The force of a stop vanishes.
    Leave { block: usize },
    /// A parted block comes back within its clearance.
    Clear { block: usize },
    /// A parted block presses on its stop again.
    TouchAgain { block: usize },
}

/// The guards of a step, and the first that falls.
pub(super) struct Search<'a, 'b> {
    pub(super) state: &'b GeneralState<'a>,
    pub(super) series: &'b Series,
    sizes: OnceCell<Vec<f64>>,
    /// Guards that could not be cleared by a bound.
    pub(super) isolated: usize,
    first: Option<(f64, Guard)>,
}

impl<'a, 'b> Search<'a, 'b> {
    /// A search that has looked at no guard yet.
    pub(super) fn new(state: &'b GeneralState<'a>, series: &'b Series) -> Self {
        Self { state, series, sizes: OnceCell::new(), isolated: 0, first: None }
    }

    /// The first of the guards looked at that falls, with its place, and how many were isolated.
    pub(super) fn found(self) -> (Option<(f64, Guard)>, usize) {
        (self.first, self.isolated)
    }

    /// The first guard that falls within a series with its place, and how many were isolated.
    pub(super) fn first(state: &'b GeneralState<'a>, series: &'b Series) -> (Option<(f64, Guard)>, usize) {
        let mut search = Self::new(state, series);
        search.springs();
        if state.base.is_some() || !state.motions.is_empty() {
            if state.vertical || state.airborne {
                search.contact();
            }
            // First of what happens at one instant, as the forces of stops may jump.
            search.stops_of_blocks();
            if !state.airborne {
                search.breakaways();
            }
            search.base();
            search.moving_blocks();
            search.lift_before_breakaway();
        }
        search.found()
    }

    /// Takes a guard whose polynomial falls before all others.
    pub(super) fn consider(&mut self, guard: Guard, polynomial: &Polynomial, tolerance: f64) {
        self.isolated += 1;
        if let Some(place) = polynomial.first_fall::<Plain>(tolerance)
            && self.first.is_none_or(|(first, _)| place < first)
        {
            self.first = Some((place, guard));
        }
    }

    /// Size of the terms of a node's acceleration at the start of the step. Where a mode has decayed they are corrected by
    /// the ground's acceleration and its slope.
    pub(super) fn size(&self, node: usize) -> f64 {
        let sizes = self.sizes.get_or_init(|| self.state.acceleration_sizes(self.series.tau));
        sizes[node] + self.series.of_ground
    }

    /// Ends of segments, turns and collapses of all springs.
    pub(super) fn springs(&mut self) {
        for node in 1..=self.state.system.nodes {
            self.drift_guards(node);
            let Some(sign) = self.state.springs[node - 1].rate_sign() else { continue };
            let (low, high) = self.series.range(Quantity::Rate, node);
            if if sign == Sign::Positive { low > 0.0 } else { high < 0.0 } {
                continue;
            }
            let (polynomial, size) = self.series.polynomial(Quantity::Rate, node, sign.factor(), 0.0);
            let of_nodes = self.size(node) + self.size(self.state.system.parent[node]);
            self.consider(Guard::Turn { node }, &polynomial, FALL_ROUNDING * (size + self.series.h * of_nodes));
        }
    }

    fn drift_guards(&mut self, node: usize) {
        let spring = &self.state.springs[node - 1];
        let (range, ends) = (spring.segment().range, spring.segment().ends);
        let collapse = self.state.system.laws[node - 1].collapse_drift;
        let (low, high) = self.series.range(Quantity::Drift, node);
        let base = self.state.base_drift[node];
        for (sign, reached, of_segment, of_collapse) in
            [(Sign::Positive, high, ends.1, collapse - base), (Sign::Negative, -low, -ends.0, collapse + base)]
        {
            let rounding = SAME_DRIFT * (of_collapse.abs() + range);
            if reached >= of_segment && (of_collapse == f64::INFINITY || of_segment < of_collapse - rounding) {
                self.drift_guard(Guard::SegmentEnd { node, sign }, (node, sign), of_segment, range);
            }
            if reached >= of_collapse {
                self.drift_guard(Guard::Collapse { node }, (node, sign), of_collapse, range);
            }
        }
    }

    fn drift_guard(&mut self, guard: Guard, (node, sign): (usize, Sign), limit: f64, range: f64) {
        let (polynomial, size) = self.series.polynomial(Quantity::Drift, node, -sign.factor(), limit);
        self.consider(guard, &polynomial, FALL_ROUNDING * (limit.abs() + size + range));
    }

    /// The contact force per unit mass while there is contact, its negative while there is none. Contact that is none all
    /// along the step has been lost at its start, though the force never falls below zero.
    pub(super) fn contact_polynomial(&self) -> Polynomial {
        let sign = if self.state.airborne { -1.0 } else { 1.0 };
        let start = self.state.interval.contact_at(self.series.tau);
        let change = self.state.interval.contact_slope * self.series.h;
        if !self.state.airborne && start <= NO_CONTACT && start + change <= NO_CONTACT {
            return Polynomial::new([-STANDARD_GRAVITY]);
        }
        Polynomial::new([sign * start, sign * change])
    }

    /// Loss and return of contact.
    pub(super) fn contact(&mut self) {
        let polynomial = self.contact_polynomial();
        self.consider(Guard::Contact, &polynomial, NO_CONTACT);
    }

    /// A block whose node's acceleration is below rounding lifts off stuck.
    fn lift_before_breakaway(&mut self) {
        if self.state.vertical
            && let Some((place, guard)) = self.first
            && matches!(guard, Guard::Breakaway { .. } | Guard::BreakawayAtStop { .. } | Guard::BaseBreakaway { .. })
            && let Some(lift) = self.contact_polynomial().first_fall::<Plain>(NO_CONTACT)
            && self.state.interval.contact_at(self.series.tau + place * self.series.h) <= NO_CONTACT
        {
            self.first = Some((lift, Guard::Contact));
        }
    }
}
