//! Guards of all state machines as polynomials, the first that falls, and what it does (`numerics`, section 5).

use crate::STANDARD_GRAVITY;
use crate::lanes::{FAR, Plain, Set, Vector, WIDTH, by_width, for_each_path, members, spread};
use crate::machines::block;
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::guard::{Guard, Outcome};
use crate::machines::segment::Crossing;
use crate::machines::settle::Cause;
use crate::machines::settle::settle;
use crate::machines::sign::Sign;
use crate::polynomial::bernstein::Polynomial;
use crate::polynomial::enclosure::{THIRD, stays_above_zero};
use crate::regime::Row;
use crate::response::{Event, EventKind};
use crate::state::State;

/// A guard falls when it is below zero by more than this fraction of its terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Contact forces per unit mass up to this are none (m/s2).
pub(crate) const NO_CONTACT: f64 = ROUNDING * STANDARD_GRAVITY;
/// Relative velocities below this fraction of their terms, which nothing but rounding drives on, have arrived.
const ARRIVED: f64 = 64.0 * f64::EPSILON;

/// The entry of the log for an event of a storey, counted from 0.
fn of_storey(crossing: Crossing, storey: usize, time: f64) -> Event {
    let Crossing { kind, sign, element } = crossing;
    Event { time, kind, number: storey + 1, sign, element }
}

for_each_path! {
    /// The place of [`Polynomial::first_fall`]; infinite where there is none.
    fn first_fall(polynomial: &Polynomial, tolerance: f64) -> f64 = first_fall_by_path
}

#[inline(always)]
fn first_fall_by_path<V: Vector>(polynomial: &Polynomial, tolerance: f64) -> f64 {
    polynomial.first_fall::<V>(tolerance).unwrap_or(f64::INFINITY)
}

/// The first fall within a series, or none.
///
/// Its guard is packed: a copy of parts that have just been written, each by itself, would wait until they are in memory.
#[derive(Clone, Copy)]
pub(crate) struct First {
    place: f64,
    guard: u64,
}

impl First {
    #[inline(always)]
    fn none() -> Self {
        Self { place: f64::INFINITY, guard: 0 }
    }

    #[inline(always)]
    pub(crate) fn is_none(self) -> bool {
        self.guard == 0
    }

    /// Where it is in [0, 1]; the end, 1, where there is none.
    #[inline(always)]
    pub(crate) fn place(self) -> f64 {
        if self.is_none() { 1.0 } else { self.place }
    }

    #[inline(always)]
    pub(crate) fn guard(self) -> Option<Guard> {
        Guard::unpacked(self.guard)
    }

    #[inline(always)]
    fn consider(&mut self, guard: Guard, polynomial: &Polynomial, tolerance: f64) {
        let place = first_fall(polynomial, tolerance);
        if place < self.place {
            *self = Self { place, guard: guard.packed() };
        }
    }
}

for_each_path! {
    /// [`State::carry_out`] for what is not compiled for a path.
    pub(crate) fn carry_out[K: usize](state: &mut State, guard: Guard, tau: f64, log: &mut Vec<Event>) -> Outcome
        = carry_out_by_path
}

#[inline(always)]
fn carry_out_by_path<V: Vector, const K: usize>(
    state: &mut State,
    guard: Guard,
    tau: f64,
    log: &mut Vec<Event>,
) -> Outcome {
    state.carry_out::<V, K>(guard, tau, log)
}

impl State<'_> {
    /// `p`, of [`Series::zeros`](crate::step::series::Series::zeros), becomes `factor`, 1 or -1, times the relative velocity of a
    /// block over the present series; returns a bound of its size.
    #[inline(always)]
    pub(crate) fn relative_velocity<V: Vector, const K: usize>(
        &self,
        block: usize,
        factor: f64,
        p: &mut Polynomial,
    ) -> f64 {
        let (motion, law) = (&self.motions[block], &self.model.blocks[block]);
        let friction = motion.sliding().map_or(0.0, |sign| sign.factor() * motion.mu_k);
        let of_friction = [friction * self.drive.contact, friction * (self.drive.contact_slope * self.series.h())];
        self.series.velocity_against::<V, K>(law.floor, factor * motion.velocity, factor, of_friction, p)
    }

    /// The relative velocity of a block over the present series, for what is not in a hot loop.
    pub(crate) fn velocity_of_block(&self, block: usize) -> Polynomial {
        let mut p = self.series.zeros();
        by_width!(self.model.width, K => self.relative_velocity::<Plain, K>(block, 1.0, &mut p));
        p
    }

    /// The first guard that falls within the present series, which starts at `tau` and whose ranges are formed.
    ///
    /// `isolated` counts the guards that could not be cleared by a bound.
    #[inline(always)]
    pub(crate) fn first_event<V: Vector, const K: usize>(&self, tau: f64, isolated: &mut usize) -> First {
        let mut first = First::none();
        let h = self.series.h();
        self.storey_guards::<V, K>(&mut first, isolated);
        if !self.motions.is_empty() {
            if self.vertical || self.airborne {
                first.consider(Guard::Contact, &self.contact_guard(tau), NO_CONTACT);
            }
            if !self.airborne && (self.ranges.suspects[2] != 0 || self.stuck_mu[0] < f64::INFINITY) {
                self.breakaway_guards::<V, K>(&mut first, isolated);
            }
            if self.is_sliding {
                self.arrival_guards::<V, K>(&mut first, isolated);
                if self.model.wears {
                    self.wear_guards::<K>(&mut first, isolated);
                }
            }
        }
        // A block whose floor's acceleration is below rounding lifts off stuck.
        if self.vertical
            && let Some(Guard::Breakaway { .. }) = first.guard()
            && let Some(lift) = self.contact_guard(tau).first_fall::<V>(NO_CONTACT)
            && self.interval.contact_at(tau + first.place * h) <= NO_CONTACT
        {
            return First { place: lift, guard: Guard::Contact.packed() };
        }
        first
    }

    /// The contact force per unit mass while there is contact, its negative while there is none. Contact that is none all
    /// along the series has been lost at its start, though the force never falls below zero.
    fn contact_guard(&self, tau: f64) -> Polynomial {
        let sign = if self.airborne { -1.0 } else { 1.0 };
        let change = self.interval.contact_slope * self.series.h();
        let start = self.interval.contact_at(tau);
        if !self.airborne && start <= NO_CONTACT && start + change <= NO_CONTACT {
            return Polynomial::new([-STANDARD_GRAVITY]);
        }
        Polynomial::new([sign * start, sign * change])
    }

    #[inline(always)]
    fn storey_guards<V: Vector, const K: usize>(&self, first: &mut First, isolated: &mut usize) {
        let [drifts, rates, _] = self.ranges.suspects;
        if drifts | rates == 0 {
            return;
        }
        for k in 0..self.vectors::<K>() {
            if self.ranges.suspects_in::<K>(0, k) != 0 {
                for side in members(self.drifts_at_guards::<V, K>(k)) {
                    self.drift_guards::<V, K>(WIDTH * k + side / 2, side % 2 == 0, first, isolated);
                }
            }
            for lane in members(self.ranges.suspects_in::<K>(1, k)) {
                self.rate_guard::<V, K>(WIDTH * k + lane, first, isolated);
            }
        }
    }

    /// Considers the guards of a storey's drift on one side.
    #[inline(always)]
    fn drift_guards<V: Vector, const K: usize>(
        &self,
        i: usize,
        is_positive: bool,
        first: &mut First,
        isolated: &mut usize,
    ) {
        let (low, high) = self.ranges.drift::<K>(i);
        let (yields, collapses) = (self.segment_ends[i], self.collapse_bounds[i]);
        let (sign, reached, of_yield, of_collapse) = match is_positive {
            true => (Sign::Positive, high, yields.1, collapses.1),
            false => (Sign::Negative, -low, -yields.0, -collapses.0),
        };
        let yields = Guard::SegmentEnd { storey: i, sign };
        self.drift_guard::<V, K>(yields, (i, sign), reached, of_yield, first, isolated);
        self.drift_guard::<V, K>(Guard::Collapse { storey: i }, (i, sign), reached, of_collapse, first, isolated);
    }

    /// Considers the turn of a storey's rate, if its segment does not allow it.
    #[inline(always)]
    fn rate_guard<V: Vector, const K: usize>(&self, i: usize, first: &mut First, isolated: &mut usize) {
        let Some(sign) = self.springs[i].rate_sign() else { return };
        let (low, high) = self.ranges.rate::<K>(i);
        if if sign == Sign::Positive { low > 0.0 } else { high < 0.0 } {
            return;
        }
        *isolated += 1;
        let mut p = self.series.zeros();
        let size = self.series.drift_rate::<V, K>(i, sign.factor(), &mut p);
        let contact = self.drive.contact;
        let sizes = self.size_in_lanes::<V, K>(i + 1, contact) + self.size_in_lanes::<V, K>(i, contact);
        let tolerance = ROUNDING * (size + self.series.h() * sizes);
        first.consider(Guard::Turn { storey: i }, &p, tolerance);
    }

    /// Storeys of vector `k` whose drifts may come to a guard over the present series: each storey has two bits, of its
    /// positive and of its negative side.
    #[inline(always)]
    fn drifts_at_guards<V: Vector, const K: usize>(&self, k: usize) -> Set {
        let [lowest, highest] = &self.bounds.guarded;
        let (low, high) = self.ranges.drifts::<V, K>(k);
        spread(high.not_below(highest.vector::<V, K>(k))) | spread(lowest.vector::<V, K>(k).not_below(low)) << 1
    }

    /// Whether a drift coordinate, times `sign`, stays below a limit over the present series, but for its start.
    #[inline(always)]
    fn stays_below<const K: usize>(&self, i: usize, limit: f64, sign: Sign) -> bool {
        let (factor, third) = (sign.factor(), self.series.h() * THIRD);
        let [dx, dv] = self.series.changes().map(|changes| changes.numbers::<K>()[i]);
        let (x, v) = (self.x.numbers::<K>()[i], self.v.numbers::<K>()[i]);
        let margin = self.ranges.remainder * self.regime.row(Row::FourthOfDrift)[i];
        let of = |x: f64, v: f64| [limit - factor * x, -factor * v];
        stays_above_zero(of(x, v), of(x + dx, v + dv), third, margin, 0.0)
    }

    /// Considers the guard of a storey's drift coordinate that, times `sign`, must stay below `limit`, if it may have
    /// reached that.
    #[inline(always)]
    fn drift_guard<V: Vector, const K: usize>(
        &self,
        guard: Guard,
        (i, sign): (usize, Sign),
        reached: f64,
        limit: f64,
        first: &mut First,
        isolated: &mut usize,
    ) {
        if reached < limit || limit == f64::INFINITY || self.stays_below::<K>(i, limit, sign) {
            return;
        }
        *isolated += 1;
        let mut p = self.series.zeros();
        let size = self.series.drift::<V, K>(i, -sign.factor(), limit, &mut p);
        let range = self.springs[i].segment().range;
        first.consider(guard, &p, ROUNDING * (limit.abs() + size + range));
    }

    #[inline(always)]
    fn breakaway_guards<V: Vector, const K: usize>(&self, first: &mut First, isolated: &mut usize) {
        let least_contact = self.drive.least_contact(self.series.h());
        if self.stuck_mu[0] < f64::INFINITY {
            self.breakaway_guard::<V, K>(0, least_contact, first, isolated);
        }
        for k in 0..self.vectors::<K>() {
            for lane in members(self.accelerations_at_guards::<V, K>(k, least_contact)) {
                self.breakaway_guard::<V, K>(WIDTH * k + lane + 1, least_contact, first, isolated);
            }
        }
    }

    /// Considers the limits of the blocks stuck to a floor, or to the ground (0), if its acceleration may come to them.
    #[inline(always)]
    fn breakaway_guard<V: Vector, const K: usize>(
        &self,
        floor: usize,
        least_contact: f64,
        first: &mut First,
        isolated: &mut usize,
    ) {
        let contact_change = self.drive.contact_slope * self.series.h();
        let (contact, mu) = (self.drive.contact, self.stuck_mu[floor]);
        let (low, high) = self.acceleration_range::<K>(floor);
        let reached = [(Sign::Positive, high), (Sign::Negative, -low)];
        if reached.iter().all(|&(_, size)| size < mu * least_contact) {
            return;
        }
        *isolated += 1;
        let limit = mu * contact;
        let sizes = (mu * contact_change).abs() + self.size_in_lanes::<V, K>(floor, contact);
        for (sign, size) in reached {
            if size < mu * least_contact {
                continue;
            }
            let mut p = self.series.zeros();
            let size = self.series.acceleration::<V, K>(floor, -sign.factor(), [limit, mu * contact_change], &mut p);
            // Not below what a decision takes as equal: what has just stuck must not break away for that.
            let tolerance = block::ROUNDING * (limit.max(mu * STANDARD_GRAVITY) + size + sizes);
            first.consider(Guard::Breakaway { floor, sign }, &p, tolerance);
        }
    }

    /// Floors of vector `k`, as bits, whose accelerations may come to the limit of blocks stuck to them over the present
    /// series.
    #[inline(always)]
    fn accelerations_at_guards<V: Vector, const K: usize>(&self, k: usize, least_contact: f64) -> Set {
        let (low, high) = self.ranges.accelerations::<V, K>(k);
        let mu: V = self.bounds.stuck_mu.vector::<V, K>(k);
        let reached = high.max(V::splat(0.0).sub(low)).not_below(mu.mul(V::splat(least_contact)));
        Set::from(reached & !mu.not_below(V::splat(FAR)))
    }

    #[inline(always)]
    fn arrival_guards<V: Vector, const K: usize>(&self, first: &mut First, isolated: &mut usize) {
        for (j, motion) in self.motions.iter().enumerate() {
            let Some(sign) = motion.sliding() else { continue };
            if self.keeps_sliding::<K>(j, sign.factor()) {
                continue;
            }
            *isolated += 1;
            let mut p = self.series.zeros();
            let size = self.relative_velocity::<V, K>(j, sign.factor(), &mut p);
            let law = &self.model.blocks[j];
            let rates = self.size_in_lanes::<V, K>(law.floor, self.drive.contact) + motion.mu_k * STANDARD_GRAVITY;
            first.consider(Guard::Arrival { block: j }, &p, ROUNDING * (size + self.series.h() * rates));
        }
    }

    /// Considers the changes of the friction coefficients of sliding blocks: slips grow until a block arrives.
    #[inline(never)]
    fn wear_guards<const K: usize>(&self, first: &mut First, isolated: &mut usize) {
        for (j, motion) in self.motions.iter().enumerate() {
            let Some(sign) = motion.sliding().map(Sign::factor) else { continue };
            let rest = motion.path_to_wear();
            if rest == f64::INFINITY {
                continue;
            }
            let change = sign * self.block_change::<K>(j).1;
            let size = motion.wear_limit(1.0).abs() + motion.path() + rest.abs() + change.abs();
            let tolerance = ROUNDING * size;
            if rest - change > tolerance && self.keeps_sliding::<K>(j, sign) {
                continue;
            }
            *isolated += 1;
            let slip = self.slip_change(j);
            let terms = slip.coefficients().iter().skip(1).map(|c| -sign * c);
            first.consider(Guard::Wear { block: j }, &Polynomial::new(std::iter::once(rest).chain(terms)), tolerance);
        }
    }

    /// Slip of a block since the start of the present series.
    pub(crate) fn slip_change(&self, block: usize) -> Polynomial {
        let velocity = self.velocity_of_block(block);
        let h = self.series.h();
        let terms = velocity.coefficients().iter().enumerate().map(|(k, c)| h * c / (k + 1) as f64);
        Polynomial::new(std::iter::once(0.0).chain(terms))
    }

    /// Range of the absolute acceleration of a floor, or of the ground (0), over the present series.
    fn acceleration_range<const K: usize>(&self, floor: usize) -> (f64, f64) {
        match floor.checked_sub(1) {
            Some(i) => self.ranges.acceleration::<K>(i),
            None => {
                let (start, end) = (self.drive.ground, self.drive.ground + self.drive.ground_slope * self.series.h());
                (start.min(end), start.max(end))
            }
        }
    }

    /// Whether the relative velocity of a sliding block keeps its sign over the present series.
    #[inline(always)]
    fn keeps_sliding<const K: usize>(&self, block: usize, sign: f64) -> bool {
        let (motion, law) = (&self.motions[block], &self.model.blocks[block]);
        let h = self.series.h();
        let friction = sign * motion.mu_k;
        // Linear up to the end, also where contact is lost before: as the change below is.
        let contact = (self.drive.contact, self.drive.contact + self.drive.contact_slope * h);
        let (a, margin) = match law.floor.checked_sub(1) {
            Some(i) => {
                let margin = self.ranges.remainder * self.regime.row(Row::ThirdOfAcceleration)[i];
                ((self.a.numbers::<K>()[i], self.series.accelerations_at_end()[0].numbers::<K>()[i]), margin)
            }
            None => ((self.drive.ground, self.drive.ground + self.drive.ground_slope * h), 0.0),
        };
        let (velocity, _) = self.block_change::<K>(block);
        let rates = (-friction * contact.0 - a.0, -friction * contact.1 - a.1);
        let (start, end) = ([motion.velocity, rates.0], [motion.velocity + velocity, rates.1]);
        // A block that breaks away where both coefficients are the same starts without relative acceleration.
        let least = ROUNDING * motion.mu_k * STANDARD_GRAVITY;
        stays_above_zero(start.map(|value| sign * value), end.map(|value| sign * value), h * THIRD, margin, least)
    }

    /// Changes of relative velocity and slip of a block over the present series up to its place: integrals of its floor's absolute acceleration and its own, added term by term so that small ones keep their digits.
    #[inline(always)]
    pub(crate) fn block_change<const K: usize>(&self, block: usize) -> (f64, f64) {
        let (motion, law) = (&self.motions[block], &self.model.blocks[block]);
        let (s, h) = (self.series.place(), self.series.h());
        let friction = motion.sliding().map_or(0.0, |sign| sign.factor() * motion.mu_k);
        let (terms, integrals) = match law.floor.checked_sub(1) {
            Some(i) => self.series.terms_and_integrals::<K>(i),
            None => ([self.drive.ground, self.drive.ground_slope * h], [0.0; 2]),
        };
        let start = terms[0] + friction * self.drive.contact;
        let change = terms[1] + friction * self.drive.contact_slope * h;
        let velocity = (integrals[0] * s + 0.5 * change) * s + start;
        let slip = (integrals[1] * s + (1.0 / 6.0) * change) * s + 0.5 * start;
        let h = h * s;
        (-h * velocity, h * motion.velocity - h * h * slip)
    }

    /// Carries out an event at `tau`, to which the state has been advanced, accelerations included where blocks decide.
    /// What happened is appended to `log`; accelerations are those before it.
    #[inline(always)]
    pub(crate) fn carry_out<V: Vector, const K: usize>(
        &mut self,
        guard: Guard,
        tau: f64,
        log: &mut Vec<Event>,
    ) -> Outcome {
        let time = self.interval.start + tau;
        match guard {
            Guard::Collapse { storey } => return Outcome::Collapse(storey),
            Guard::SegmentEnd { storey, sign } => {
                let x = self.x.take_lane::<V, K>(storey);
                let crossing = self.springs[storey].end(x, sign);
                log.push(of_storey(crossing, storey, time));
            }
            Guard::Turn { storey } => {
                let x = self.x.take_lane::<V, K>(storey);
                let crossing = self.springs[storey].turn(x);
                self.v.set_lane::<V, K>(storey, 0.0);
                log.push(of_storey(crossing, storey, time));
            }
            Guard::Breakaway { floor, sign } => self.break_away::<K>(floor, sign, tau, log),
            Guard::Arrival { block } => {
                self.arrive_with::<K>(block, tau);
                self.settle_floor::<K>(self.model.blocks[block].floor, tau, Cause::Other, log);
            }
            Guard::Wear { block } => {
                let law = &self.model.blocks[block];
                let motion = &mut self.motions[block];
                let (sign, element) = (motion.velocity_sign(), motion.wear(law));
                log.push(Event { time, kind: EventKind::Wear, number: block + 1, sign, element });
                self.settle_floor::<K>(law.floor, tau, Cause::Other, log);
            }
            Guard::Contact => self.change_contact(tau, log),
        }
        match guard {
            Guard::SegmentEnd { storey, .. } | Guard::Turn { storey } => self.enter_regime_of_spring::<V, K>(storey),
            _ => self.enter_regime_of_blocks::<V, K>(),
        }
        Outcome::Continue
    }

    /// Has the weakest block stuck to a floor break away, and lets the floor decide.
    fn break_away<const K: usize>(&mut self, floor: usize, sign: Sign, tau: f64, log: &mut Vec<Event>) {
        let weakest = self.model.on_floor[floor]
            .iter()
            .copied()
            .filter(|&j| self.motions[j].is_stuck())
            .min_by(|&i, &j| self.motions[i].mu_s.total_cmp(&self.motions[j].mu_s));
        if let Some(weakest) = weakest {
            self.settle_floor::<K>(floor, tau, Cause::Breakaway(weakest, sign), log);
        }
    }

    /// Brings a block to rest, and those on its floor that arrive at the same instant: within rounding, or because they
    /// have moved as it does.
    fn arrive_with<const K: usize>(&mut self, block: usize, tau: f64) {
        let arriving = self.motions[block];
        let (floor, mu_k) = (self.model.blocks[block].floor, arriving.mu_k);
        let contact = self.contact_at(tau);
        let a = if floor > 0 { self.a.numbers::<K>()[floor - 1] } else { self.interval.ground_at(tau) };
        for position in 0..self.model.on_floor[floor].len() {
            let j = self.model.on_floor[floor][position];
            let BlockMotion { state, velocity, mu_k: friction, .. } = self.motions[j];
            let BlockState::Sliding(sign) = state else { continue };
            let alike = velocity == arriving.velocity && state == arriving.state && friction == mu_k;
            let slowing = sign.factor() * a + friction * contact;
            let size = a.abs() + friction * contact.max(STANDARD_GRAVITY);
            let arrives = slowing >= -ARRIVED * size && velocity.abs() <= ARRIVED * size * self.interval.h;
            if j == block || alike || velocity != 0.0 && arrives {
                self.motions[j].velocity = 0.0;
            }
        }
    }

    fn settle_floor<const K: usize>(&mut self, floor: usize, tau: f64, cause: Cause, log: &mut Vec<Event>) {
        let (demand, contact, model) = (self.demand::<K>(floor, tau), self.contact_at(tau), self.model);
        let transitions = &mut self.transitions;
        transitions.clear();
        settle(demand, &model.blocks, &mut self.motions, &model.on_floor[floor], contact, cause, transitions);
        let time = self.interval.start + tau;
        log.extend(transitions.iter().map(|t| Event {
            time,
            kind: t.kind,
            number: t.block + 1,
            sign: t.sign,
            element: 0,
        }));
    }

    /// All blocks leave or regain contact.
    fn change_contact(&mut self, tau: f64, log: &mut Vec<Event>) {
        let time = self.interval.start + tau;
        let kind = if self.airborne { EventKind::Land } else { EventKind::Lift };
        for (j, motion) in self.motions.iter_mut().enumerate() {
            // An arrival that a lift forestalls, by rounding of time.
            if motion.sliding().is_some_and(|sign| sign.factor() * motion.velocity < 0.0) {
                motion.velocity = 0.0;
            }
            log.push(Event { time, kind, number: j + 1, sign: motion.velocity_sign(), element: 0 });
            if kind == EventKind::Lift { motion.lift() } else { motion.land() }
        }
        self.airborne = !self.airborne;
        if kind == EventKind::Land {
            // Contact has only just returned: the accelerations decide, with no friction yet.
            self.enter_regime();
            self.refresh_accelerations(tau);
            self.settle_all(tau, log);
        }
    }

    /// Lets every floor decide, at the start of a run or at a landing.
    pub(crate) fn settle_all(&mut self, tau: f64, log: &mut Vec<Event>) {
        for floor in 0..self.model.on_floor.len() {
            if self.model.on_floor[floor].iter().any(|&j| self.motions[j].is_stuck()) {
                by_width!(self.model.width, K => self.settle_floor::<K>(floor, tau, Cause::Other, log));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guards_are_packed_without_loss() {
        let mut guards = vec![Guard::Contact];
        for number in [0, 1, 65_536, 1 << 40] {
            guards.extend([Guard::Collapse { storey: number }, Guard::Turn { storey: number }]);
            guards.extend([Guard::Arrival { block: number }, Guard::Wear { block: number }]);
            for sign in [Sign::Positive, Sign::Negative] {
                guards.extend([Guard::SegmentEnd { storey: number, sign }, Guard::Breakaway { floor: number, sign }]);
            }
        }
        for guard in guards {
            assert_eq!(Guard::unpacked(guard.packed()), Some(guard));
        }
        assert!(First::none().is_none() && First::none().guard().is_none());
    }
}
