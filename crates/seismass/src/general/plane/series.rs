//! The Taylor series of both directions over a step, coupled by friction on the circle (`numerics`, section 9.7).

use crate::general::plane::slide_series::{Beginning, LastWay, ORDER, SlideSeries};
use crate::general::plane::state::PlaneState;
use crate::general::plane::stiff::Stiff;
use crate::general::plane::vector::{Vector2, dot, length, plus, times};
use crate::general::series::Series;
use crate::general::terms::Terms;
use crate::lanes::Plain;
use crate::polynomial::orders::terms;
use crate::polynomial::power::Polynomial;
use crate::tolerances::{ARRIVED_ON_CIRCLE, AT_STOPS_ROUNDING, SERIES_PHASE};
use crate::units::STANDARD_GRAVITY;

/// What the last two terms of a direction are at most: they fall by five from one to the next, so that what is left out is half
/// of rounding.
const DIRECTION_ROUNDING: f64 = 2.0 * f64::EPSILON;

/// What the last term of a direction must be below: rounding over a larger one is no number.
const LARGEST: f64 = 1e280;
/// Where it is not, the series is formed anew over this part of its length.
const SHORTER: f64 = 1e-3;

/// What the turn of a velocity on the way to its stop may be, as a part of the largest velocity so far.
const STRAIGHT: f64 = 0.25 * f64::EPSILON;

/// Most units of time in a step: their powers up to the highest degree are far within the range of numbers.
const MOST_UNITS: f64 = 1e3;

/// Order of the series of the last way to a stop: frequencies times its length are 1e-3 at most.
const LAST_WAY_ORDER: usize = 4;

/// The lowest order at which an asymptotic series is ended.
const LEAST_ORDER: usize = 6;

/// The series in s = t / h on [0, 1].
#[derive(Default)]
pub(super) struct PlaneSeries {
    pub(super) axes: [Series; 2],
    /// Working space of these where nothing slides.
    own: [Terms<1>; 2],
    /// Of which a step with sliding blocks is formed.
    pub(super) terms: Terms<2>,
    /// Of the blocks that slide.
    pub(super) slides: Vec<SlideSeries>,
    /// Blocks on the straight line to their stops.
    straight: Vec<usize>,
    /// Blocks on the last way to their stop, if the step is one.
    last_way: Option<(Vec<usize>, LastWay)>,
    stiff: Stiff,
    order: usize,
    /// The order to which terms are formed.
    highest: usize,
}

impl PlaneSeries {
    /// Length of the step (s).
    pub(super) fn h(&self) -> f64 {
        self.axes[0].h
    }

    /// Start of the step in its sample interval (s).
    pub(super) fn tau(&self) -> f64 {
        self.axes[0].tau
    }

    /// Forms the series from `tau` over at most `remaining`; None, or a block that has broken away though its relative
    /// acceleration does not rise: it grazes its limit.
    ///
    /// `to_stops` allows the last way to a stop as a step.
    pub(super) fn form(&mut self, state: &PlaneState, tau: f64, remaining: f64, to_stops: bool) -> Option<usize> {
        let frequency = state.axes[0].regime.frequency.max(state.axes[1].regime.frequency);
        let longest = remaining / (frequency * remaining / SERIES_PHASE).ceil().max(1.0);
        self.straight.clear();
        (self.last_way, self.highest) = (None, ORDER);
        self.begin(state);
        if self.slides.is_empty() {
            for ((series, own), axis) in self.axes.iter_mut().zip(&mut self.own).zip(&state.axes) {
                series.form(own, axis, tau, (longest, axis.regime.frequency * longest), 0, false);
            }
            return None;
        }
        let grazes = self.form_slides(state, tau, longest);
        if grazes.is_some() {
            return grazes;
        }
        if to_stops && let Some(way) = self.last_way(state, frequency, longest) {
            let time = way.1.time;
            (self.last_way, self.highest) = (Some(way), LAST_WAY_ORDER);
            self.form_slides(state, tau, time);
            self.highest = ORDER;
            if self.terms.h == time {
                self.close(1.0, LAST_WAY_ORDER, time);
                return None;
            }
            self.last_way = None;
            self.form_slides(state, tau, longest);
        }
        let (h, least) = (self.terms.h, STRAIGHT * state.fastest);
        let is_straight = |slide: &&SlideSeries| slide.is_straight(longest / h, least);
        self.straight = self.slides.iter().filter(is_straight).map(|slide| slide.block).collect();
        if !self.straight.is_empty() {
            self.form_slides(state, tau, longest);
        }
        let (mut end, mut order) = self.end(frequency, longest);
        if self.is_relaxed(state)
            && let Some(longer) = self.stiff.longer(&self.slides, self.terms.h, end, longest)
        {
            // Ends well before any stop: a straight way to one is as any other.
            let straight = std::mem::take(&mut self.straight);
            let outcome = self.collocate(state, tau, longer);
            self.stiff.note(longer, outcome);
            if outcome.0 {
                (end, order) = (self.before_stops(1.0, ORDER), ORDER);
            } else {
                self.straight = straight;
                self.form_slides(state, tau, longest);
            }
        }
        self.close(end, order, longest);
        None
    }

    /// Ends the step at its place `end` and after an order.
    pub(super) fn close(&mut self, end: f64, order: usize, longest: f64) {
        self.order = order;
        // Rounding may leave their product just below.
        let is_longest = end == longest / self.terms.h;
        for (d, series) in self.axes.iter_mut().enumerate() {
            series.take(&self.terms, d, end, order);
            if is_longest {
                series.h = longest;
            }
        }
        self.slides.iter_mut().for_each(|slide| slide.shorten(end));
    }

    /// Whether the step is the last way to a stop.
    pub(super) fn is_last_way(&self) -> bool {
        self.last_way.is_some()
    }

    /// Forms all terms in a time unit of at most `longest`; None, or a block that grazes its limit.
    fn form_slides(&mut self, state: &PlaneState, tau: f64, longest: f64) -> Option<usize> {
        let (system, inverse_mass) = (state.system(), &state.axes[0].regime.inverse_mass);
        // At a landing it is zero, and rounding may leave it below.
        let contact = state.axes[0].contact_at(tau).max(0.0);
        let mut h = longest;
        self.begin(state);
        let turns = |slide: &&SlideSeries| {
            slide.beginning == Beginning::Moving && slide.straight_to.is_none() && slide.mean.is_none()
        };
        for slide in self.slides.iter().filter(turns) {
            let law = &system.blocks[slide.block];
            let slowing = state.friction(slide.block).1 * contact * (1.0 + law.mass * inverse_mass[law.floor]);
            h = h.min(length(state.velocity(slide.block)) / slowing);
        }
        loop {
            self.form_terms(state, tau, h);
            if let Some(slide) = self.slides.iter().find(|slide| slide.length[0] <= 0.0) {
                return Some(slide.block);
            }
            let is_within = self.slides.iter().all(|slide| length(slide.direction[self.highest]) < LARGEST);
            if is_within || h < f64::MIN_POSITIVE / SHORTER {
                return None;
            }
            h *= SHORTER;
            self.begin(state);
        }
    }

    /// The blocks that slide.
    pub(super) fn begin(&mut self, state: &PlaneState) {
        let mut count = 0;
        for (position, &block) in state.axes[0].moving.iter().enumerate().filter(|(_, block)| state.slides(**block)) {
            let beginning = match (state.velocity(block) == [0.0; 2], state.friction(block).1 == 0.0) {
                (true, true) => Beginning::Free(0),
                (true, false) => Beginning::Jump,
                (false, _) => Beginning::Moving,
            };
            if self.slides.len() == count {
                self.slides.push(SlideSeries::none());
            }
            let slide = &mut self.slides[count];
            slide.begin((position, block), beginning, state.slides[block].start.unwrap_or_default());
            slide.straight_to = self.straight.contains(&block).then_some(0.25 * ARRIVED_ON_CIRCLE * state.fastest);
            let way = self.last_way.as_ref().filter(|(blocks, _)| blocks.contains(&block));
            slide.mean = way.map(|(_, way)| way.mean);
            count += 1;
        }
        self.slides.truncate(count);
    }

    fn form_terms(&mut self, state: &PlaneState, tau: f64, h: f64) {
        let contact = [state.axes[0].contact_at(tau), state.axes[0].interval.contact_slope * h];
        self.terms.begin(state.axes.each_ref(), tau, h, self.highest);
        let starts = self.slides.iter().any(|slide| slide.beginning.is_implicit());
        for k in 0..=self.highest {
            for i in 0..self.slides.len() {
                match self.slides[i].beginning {
                    Beginning::Moving => {
                        let r = self.term(i, k);
                        self.slides[i].divide(k, r);
                    }
                    Beginning::Jump | Beginning::Smooth => self.slides[i].along(k),
                    Beginning::Free(_) => continue,
                }
                self.set_friction(state, i, k, contact);
            }
            self.terms.form_order(state.axes.each_ref(), k);
            if !starts {
                continue;
            }
            if k == 0 {
                self.classify(state, tau);
            } else {
                self.solve_across(state, k, contact);
                self.terms.form_order(state.axes.each_ref(), k);
            }
            self.take_starts(k);
        }
        self.divide_free(state, tau);
    }

    /// Directions of the blocks that start without friction; those that stay at rest are left out.
    fn divide_free(&mut self, state: &PlaneState, tau: f64) {
        if self.slides.iter().all(|slide| slide.beginning != Beginning::Free(0)) {
            return;
        }
        let sizes = state.axes.each_ref().map(|axis| axis.acceleration_sizes(tau));
        let (terms, highest) = (&self.terms, self.highest);
        self.slides.retain_mut(|slide| {
            let (position, node) = (slide.position, state.system().blocks[slide.block].floor);
            let size = sizes[0][node] + sizes[1][node] + length(state.drive(slide.block));
            let term = |k: usize| terms.blocks[position].velocity[k];
            slide.beginning != Beginning::Free(0)
                || slide.divide_free(highest, AT_STOPS_ROUNDING * size * terms.h, term)
        });
    }

    /// Term of order k of the relative velocity of a sliding block.
    pub(super) fn term(&self, slide: usize, k: usize) -> Vector2 {
        self.terms.blocks[self.slides[slide].position].velocity[k]
    }

    /// Friction of order k over mass: mu_k (N_0 d_k + N_1 d_(k-1)).
    pub(super) fn set_friction(&mut self, state: &PlaneState, i: usize, k: usize, contact: [f64; 2]) {
        let slide = &self.slides[i];
        let before = if k > 0 { slide.direction[k - 1] } else { [0.0; 2] };
        let of_order = plus(times(contact[0], slide.direction[k]), times(contact[1], before));
        self.terms.blocks[slide.position].friction[k] = times(state.friction(slide.block).1, of_order);
    }

    /// Whether blocks start with an acceleration: it vanishes where mu_s = mu_k.
    fn classify(&mut self, state: &PlaneState, tau: f64) {
        let sizes = state.axes.each_ref().map(|axis| axis.acceleration_sizes(tau));
        let (contact, h) = (state.axes[0].contact_at(tau), self.terms.h);
        for i in 0..self.slides.len() {
            let SlideSeries { position, block, beginning, direction, .. } = self.slides[i];
            if !beginning.is_implicit() {
                continue;
            }
            let (node, first) = (state.system().blocks[block].floor, direction[0]);
            let limit = state.friction(block).0 * contact.max(STANDARD_GRAVITY);
            let size = limit + sizes[0][node] + sizes[1][node] + length(state.drive(block));
            let change = dot(self.term(i, 1), first);
            let jumps = change > AT_STOPS_ROUNDING * size * h;
            self.slides[i].beginning = if jumps { Beginning::Jump } else { Beginning::Smooth };
            let term = times(if jumps { change } else { 0.0 }, first);
            let block = &mut self.terms.blocks[position];
            (block.velocity[1], block.slip[2]) = (term, times(0.5 * h, term));
        }
    }

    /// Parts of order k across the first direction of the blocks that start, coupled by the acceleration of their node.
    fn solve_across(&mut self, state: &PlaneState, k: usize, contact: [f64; 2]) {
        let system = state.system();
        let per_time = (k + 1) as f64 / self.terms.h;
        let starts: Vec<usize> = (0..self.slides.len()).filter(|&i| self.slides[i].beginning.is_implicit()).collect();
        let friction = |i: usize| state.friction(self.slides[i].block).1 * contact[0];
        let law = |i: usize| &system.blocks[self.slides[i].block];
        let n = starts.len();
        let mut matrix = nalgebra::DMatrix::<f64>::zeros(n, n);
        let mut right = nalgebra::DVector::<f64>::zeros(n);
        for (row, &i) in starts.iter().enumerate() {
            let (slide, normal) = (&self.slides[i], self.slides[i].normal());
            right[row] = per_time * (dot(self.term(i, k + 1), normal) - slide.known_across(k));
            matrix[(row, row)] = friction(i);
            if slide.beginning == Beginning::Jump {
                matrix[(row, row)] += per_time * slide.length[0];
            }
            for (column, &other) in starts.iter().enumerate().filter(|(_, other)| law(**other).floor == law(i).floor) {
                let of_node = state.axes[0].regime.inverse_mass[law(i).floor];
                let turned = dot(normal, self.slides[other].normal());
                matrix[(row, column)] += of_node * law(other).mass * friction(other) * turned;
            }
        }
        let parts = matrix.lu().solve(&right).unwrap_or_else(|| nalgebra::DVector::from_element(n, f64::NAN));
        for (&i, &part) in starts.iter().zip(parts.iter()) {
            self.slides[i].add_across(k, part);
            self.set_friction(state, i, k, contact);
        }
    }

    fn take_starts(&mut self, k: usize) {
        for i in 0..self.slides.len() {
            let term = self.term(i, k + 1);
            match self.slides[i].beginning {
                Beginning::Jump => self.slides[i].take(k, term),
                Beginning::Smooth if k > 0 => self.slides[i].take(k - 1, term),
                _ => {}
            }
        }
    }

    /// The place where the series is to end, and the order after which: the last terms of all directions are below rounding
    /// there, and no relative velocity comes to zero. In units of time, which may be many until `longest`.
    fn end(&self, frequency: f64, longest: f64) -> (f64, usize) {
        let (phase, most) = (frequency * self.terms.h, (longest / self.terms.h).min(MOST_UNITS));
        let is_asymptotic = self.slides.iter().any(|slide| slide.beginning == Beginning::Smooth);
        let highest = self.highest;
        let orders = if is_asymptotic { LEAST_ORDER..=highest } else { highest..=highest };
        let (mut best, mut best_order) = (0.0, highest);
        for order in orders {
            let mut end = self.slides.iter().fold(most, |end: f64, s| s.reach(order, end, DIRECTION_ROUNDING));
            while terms::<Plain>(phase * end) > order {
                end *= 0.8;
            }
            if end > best {
                (best, best_order) = (end, order);
            }
        }
        (self.before_stops(best, best_order), best_order)
    }

    /// The part of a series up to its place `end` in which no relative velocity comes to zero.
    fn before_stops(&self, end: f64, order: usize) -> f64 {
        self.slides.iter().fold(end, |end, slide| slide.before_stop(order, end))
    }

    /// Path of a block that slides up to the place `s`, and the sign of the rate of its velocity there.
    pub(super) fn path_and_rate(&self, slide: &SlideSeries, s: f64) -> (f64, f64) {
        let (path, rate) = slide.path_and_rate(self.order, s);
        (self.h() * path, rate)
    }

    /// Lengths of the relative velocities of the blocks that slide, as polynomials.
    pub(super) fn speed_of(&self, slide: usize) -> Polynomial {
        self.slides[slide].speed(self.order)
    }
}
