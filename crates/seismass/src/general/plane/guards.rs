//! Guards in the plane: those of each direction, and those of vectors (`numerics`, section 9.7).

use crate::general::guards::{Guard, Search};
use crate::general::plane::products::{add_product, constant, reach};
use crate::general::plane::series::PlaneSeries;
use crate::general::plane::state::PlaneState;
use crate::general::plane::vector::length;
use crate::general::series::Quantity;
use crate::general::stops::Contact;
use crate::lanes::Plain;
use crate::polynomial::power::Polynomial;
use crate::tolerances::{AT_STOPS_ROUNDING, FALL_ROUNDING, NO_CONTACT};
use crate::units::STANDARD_GRAVITY;

/// What happens when a guard falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PlaneGuard {
    /// A guard of one direction; contact is one of the first.
    Along { axis: usize, guard: Guard },
    /// A block breaks away, and with it those of its node that are equal.
    Breakaway { block: usize },
    /// The friction coefficients of a sliding block change.
    Wear { block: usize },
    /// The drift vector of a storey reaches its collapse drift.
    Collapse { node: usize },
}

/// A search for the first guard.
pub(super) struct PlaneSearch<'a, 'b> {
    state: &'b PlaneState<'a>,
    series: &'b PlaneSeries,
    isolated: usize,
    first: Option<(f64, PlaneGuard)>,
}

impl<'a, 'b> PlaneSearch<'a, 'b> {
    /// The first guard that falls within a series with its place, and how many were isolated.
    pub(super) fn first(state: &'b PlaneState<'a>, series: &'b PlaneSeries) -> (Option<(f64, PlaneGuard)>, usize) {
        let mut search = Self { state, series, isolated: 0, first: None };
        for axis in 0..2 {
            search.along(axis);
        }
        search.collapses();
        if !state.axes[0].airborne {
            search.breakaways();
            search.wears();
            search.lift_before_breakaway();
        }
        (search.first, search.isolated)
    }

    fn take(&mut self, found: Option<(f64, PlaneGuard)>) {
        if let Some((place, _)) = found
            && self.first.is_none_or(|(first, _)| place < first)
        {
            self.first = found;
        }
    }

    fn consider(&mut self, guard: PlaneGuard, polynomial: &Polynomial, tolerance: f64) {
        self.isolated += 1;
        self.take(polynomial.first_fall::<Plain>(tolerance).map(|place| (place, guard)));
    }

    /// Springs and stops of a direction, and contact.
    fn along(&mut self, a: usize) {
        let axis = &self.state.axes[a];
        let mut search = Search::new(axis, &self.series.axes[a]);
        search.springs();
        if a == 0 && !axis.motions.is_empty() && (axis.vertical || axis.airborne) {
            search.contact();
        }
        for (position, &block) in axis.moving.iter().enumerate() {
            let Some(stops) = &axis.system.stops[block] else { continue };
            match axis.stops[block].contact {
                // Its velocity counts as zero still, at which what is left of the penetration would press it at once.
                Contact::Parted(side) if self.state.starts_from(block, a, side) => {
                    search.parted(position, (block, 0.0), stops, side);
                }
                _ => search.stops(position, block, stops),
            }
        }
        let (found, isolated) = search.found();
        self.isolated += isolated;
        self.take(found.map(|(place, guard)| (place, PlaneGuard::Along { axis: a, guard })));
    }

    /// 1 - (d_x / c_x)^2 - (d_y / c_y)^2. Where it falls by one drift alone, the guard of that direction does too, and keeps
    /// the end of a branch of the spring from coming first by rounding.
    fn collapses(&mut self) {
        for node in 1..=self.state.system().nodes {
            let limit = self.state.axes.each_ref().map(|axis| axis.system.laws[node - 1].collapse_drift);
            if limit == [f64::INFINITY; 2] {
                continue;
            }
            let (mut p, mut least) = (constant(1.0), 1.0);
            for a in 0..2 {
                let base = self.state.axes[a].base_drift[node];
                let (drift, size) = self.series.axes[a].polynomial(Quantity::Drift, node, 1.0, base);
                let reached = (size + base.abs()) / limit[a];
                least -= reached * reached;
                add_product(&mut p, -1.0 / (limit[a] * limit[a]), &drift, &drift);
            }
            if least <= 0.0 {
                self.consider(PlaneGuard::Collapse { node }, &p, FALL_ROUNDING * 4.0);
            }
        }
    }

    /// (mu_s N)^2 - |A - drive|^2 of stuck blocks: of those away from stops for the weakest of a node.
    fn breakaways(&mut self) {
        let state = self.state;
        for blocks in &state.system().on_node {
            let mut weakest: Option<usize> = None;
            for &j in blocks.iter().filter(|&&j| state.is_stuck(j)) {
                if state.drive(j) != [0.0; 2] {
                    self.breakaway(j);
                } else if weakest.is_none_or(|w| state.friction(j).0 < state.friction(w).0) {
                    weakest = Some(j);
                }
            }
            if let Some(block) = weakest {
                self.breakaway(block);
            }
        }
    }

    fn breakaway(&mut self, block: usize) {
        let (state, axes) = (self.state, &self.series.axes);
        let (node, mu, drive) = (state.system().blocks[block].floor, state.friction(block).0, state.drive(block));
        let contact = state.axes[0].contact_at(self.series.tau());
        let change = state.axes[0].interval.contact_slope * self.series.h();
        let least = mu * contact.min(contact + change);
        let reached = reach(axes, Quantity::Acceleration, node, [-drive[0], -drive[1]]);
        if reached < least {
            return;
        }
        let limit = Polynomial::new([mu * contact, mu * change]);
        let mut p = constant(0.0);
        add_product(&mut p, 1.0, &limit, &limit);
        let mut of_terms = 0.0;
        for a in 0..2 {
            let (y, size) = axes[a].polynomial(Quantity::Acceleration, node, 1.0, -drive[a]);
            add_product(&mut p, -1.0, &y, &y);
            of_terms += size + state.axes[a].acceleration_sizes(self.series.tau())[node];
        }
        let largest = mu * contact.max(contact + change).max(STANDARD_GRAVITY);
        let tolerance = AT_STOPS_ROUNDING * (largest + of_terms + length(drive)) * self.heavier(node);
        self.consider(PlaneGuard::Breakaway { block }, &p, 2.0 * largest.max(reached) * tolerance);
    }

    /// How much heavier a node is with its goods than without.
    fn heavier(&self, node: usize) -> f64 {
        let system = self.state.system();
        let goods: f64 = system.on_node[node].iter().map(|&j| system.blocks[j].mass).sum();
        if node == 0 { 1.0 } else { (system.mass[node] + goods) / system.mass[node] }
    }

    fn wears(&mut self) {
        for (i, slide) in self.series.slides.iter().enumerate() {
            let rest = self.state.slides[slide.block].path_to_wear();
            if rest == f64::INFINITY {
                continue;
            }
            let (speed, h) = (self.series.speed_of(i), self.series.h());
            let terms = speed.coefficients().iter().enumerate().map(|(k, term)| -h * term / (k + 1) as f64);
            let p = Polynomial::new(std::iter::once(rest).chain(terms));
            let size: f64 = p.coefficients().iter().map(|c| c.abs()).sum();
            if rest <= size - rest.abs() {
                let size = size + self.state.slides[slide.block].path;
                self.consider(PlaneGuard::Wear { block: slide.block }, &p, FALL_ROUNDING * size);
            }
        }
    }

    /// A block whose node's acceleration is below rounding lifts off stuck.
    fn lift_before_breakaway(&mut self) {
        let axis = &self.state.axes[0];
        if axis.vertical
            && let Some((place, PlaneGuard::Breakaway { .. })) = self.first
            && let search = Search::new(axis, &self.series.axes[0])
            && let Some(lift) = search.contact_polynomial().first_fall::<Plain>(NO_CONTACT)
            && axis.interval.contact_at(self.series.tau() + place * self.series.h()) <= NO_CONTACT
        {
            self.first = Some((lift, PlaneGuard::Along { axis: 0, guard: Guard::Contact }));
        }
    }
}
