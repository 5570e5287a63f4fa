//! Guards, the first that falls, and what follows from it (`numerics`, sections 2 and 5).

use seismass::{Event, EventKind};

use crate::model::{Model, Stage, Terms};
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::series::Series;
use crate::sign::Sign;
use crate::springs::SpringGuard;
use crate::state::{BlockState, Contact, Drive, State};

/// Rounding of a guard, in units of the number type's epsilon times the size of its terms.
const ROUNDING: f64 = 64.0;
/// Places of roots at one drift differ by at most so much rounding: what it is over the drift that is left.
const SAME_PLACE: f64 = 1024.0;

/// A state machine's condition for staying as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Guard {
    /// g + a_v keeps its sign.
    Contact,
    /// A storey's spring stays in its state.
    Spring { storey: usize, guard: SpringGuard },
    /// A storey stays below its collapse drift.
    Collapse { storey: usize },
    /// The weakest stuck block of a floor stays below its limit, with this sign of the floor acceleration.
    Breakaway { floor: usize, weakest: usize, sign: Sign },
    /// A sliding block's relative velocity keeps its sign.
    Arrival { block: usize },
    /// A sliding block's path stays below that of its next stage of wear.
    Wear { block: usize },
}

/// Why a floor decides which of its blocks stick.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Cause {
    /// This stuck block, and those of equal mu_s, have reached their limit with this sign of the floor acceleration.
    Breakaway(usize, Sign),
    /// A block has arrived.
    Arrival,
    /// The friction coefficients of this block have changed.
    Wear(usize),
    /// Contact begins: the start of a run, or a landing.
    Contact,
}

/// A run's machines at an instant.
pub(crate) struct Machines<'a, R> {
    pub(crate) model: &'a Model<R>,
    pub(crate) state: &'a mut State<R>,
    pub(crate) drive: Drive<R>,
    pub(crate) airborne: &'a mut bool,
    /// Length of a whole piece: velocities carry the rounding of accelerations over this time.
    pub(crate) piece: R,
    /// Beginning of the sample interval (s).
    pub(crate) start: R,
    pub(crate) log: &'a mut Vec<Event>,
}

impl<R: Real> Machines<'_, R> {
    /// The first guard that falls on a stretch, and its place on it in [0, 1].
    pub(crate) fn first_event(&self, series: &Series<R>) -> Option<(R, Guard)> {
        let (model, state) = (self.model, &*self.state);
        let sizes = series.acceleration_sizes(model, state);
        let gravity = model.gravity + series.contact.size();
        let mut first: Option<(R, Guard)> = None;
        let mut consider = |guard: Guard, polynomial: Polynomial<R>, size: R| {
            let rounding = R::of(ROUNDING) * R::epsilon();
            let Some(place) = polynomial.first_fall(rounding * size) else { return };
            // At A = 0 a stuck block's limit and the contact force vanish together: contact comes first. A backbone may
            // end where the storey collapses: collapse comes first.
            let earlier = |(other, before): (R, Guard)| {
                place
                    < match (guard, before) {
                        (_, Guard::Contact) => other - rounding * other,
                        (Guard::Collapse { storey }, Guard::Spring { storey: ends, .. }) if storey == ends => {
                            other + R::of(SAME_PLACE) * rounding
                        }
                        _ => other,
                    }
            };
            if first.is_none_or(earlier) {
                first = Some((place, guard));
            }
        };
        if !state.blocks.is_empty() {
            let mut contact = series.contact.clone();
            let rounding = R::of(ROUNDING) * R::epsilon() * gravity;
            if *self.airborne {
                contact = contact.scaled(R::of(-1.0));
            } else if contact.start() <= rounding && contact.end() <= rounding {
                // No contact force all along the stretch, though never below zero.
                contact = Polynomial::constant(-gravity);
            }
            consider(Guard::Contact, contact, gravity);
        }
        for (i, storey) in model.storeys.iter().enumerate() {
            let rate_size = self.piece * (sizes[i] + sizes[i + 1]);
            for limit in state.springs[i].limits(&series.course(i), rate_size) {
                consider(Guard::Spring { storey: i, guard: limit.guard }, limit.polynomial, limit.size);
            }
            if let Some(limit) = storey.collapse_drift {
                for sign in [Sign::Positive, Sign::Negative] {
                    let guard = Polynomial::constant(limit).plus(&series.drift[i].scaled(sign.times(R::of(-1.0))));
                    consider(Guard::Collapse { storey: i }, guard, limit + series.drift[i].size());
                }
            }
        }
        for (floor, &size) in sizes.iter().enumerate() {
            let Some(weakest) = self.weakest_stuck(floor) else { continue };
            let mu = state.blocks[weakest].mu_s;
            for sign in [Sign::Positive, Sign::Negative] {
                let demand = series.acceleration[floor].scaled(sign.times(R::of(-1.0)));
                let guard = series.contact.scaled(mu).plus(&demand);
                consider(Guard::Breakaway { floor, weakest, sign }, guard, mu * gravity + size);
            }
        }
        for (j, block) in state.blocks.iter().enumerate() {
            let Contact::Sliding(sign) = block.contact else { continue };
            let guard = series.velocity[j].scaled(sign.times(R::of(1.0)));
            let data = &model.blocks[j];
            let size = guard.size() + self.piece * (sizes[data.floor] + block.mu_k * gravity);
            consider(Guard::Arrival { block: j }, guard, size);
            if let Some(next) = data.stages.get(block.stage + 1) {
                let slipped = series.slipped(j).scaled(sign.times(R::of(-1.0)));
                let size = next.path + slipped.size();
                consider(Guard::Wear { block: j }, Polynomial::constant(next.path - block.path).plus(&slipped), size);
            }
        }
        first
    }

    fn on_floor(&self, floor: usize) -> Vec<usize> {
        (0..self.model.blocks.len()).filter(|&j| self.model.blocks[j].floor == floor).collect()
    }

    fn weakest_stuck(&self, floor: usize) -> Option<usize> {
        let stuck = self.on_floor(floor).into_iter().filter(|&j| self.state.blocks[j].contact == Contact::Stuck);
        stuck.reduce(|a, b| if self.state.blocks[b].mu_s < self.state.blocks[a].mu_s { b } else { a })
    }

    fn note(&mut self, tau: R, kind: EventKind, index: usize, sign: i8, element: u8) {
        let time = (self.start + tau).to_f64();
        self.log.push(Event { time, kind, number: index + 1, sign, element });
    }

    /// Carries out an event at `tau`, which the state has reached at the end of `series`. Collapse ends a run and is
    /// not for here.
    pub(crate) fn carry_out(&mut self, guard: Guard, series: &Series<R>, tau: R) {
        match guard {
            Guard::Collapse { .. } => {}
            Guard::Contact => self.change_contact(tau),
            Guard::Spring { storey, guard } => {
                if let SpringGuard::Turn(_) = guard {
                    self.state.rate[storey] = R::zero();
                }
                for crossing in self.state.springs[storey].cross(guard, self.state.drift[storey]) {
                    self.note(tau, crossing.kind, storey, crossing.sign.as_i8(), crossing.element);
                }
            }
            Guard::Breakaway { floor, weakest, sign } => self.settle(floor, tau, Cause::Breakaway(weakest, sign)),
            Guard::Arrival { block } => {
                let floor = self.model.blocks[block].floor;
                self.arrive_together(block, series, tau);
                self.settle(floor, tau, Cause::Arrival);
            }
            Guard::Wear { block } => self.wear(block, tau),
        }
    }

    /// The block, and those on its floor that do so at this instant, have come to their next stage of wear: they slide
    /// on, and the floor decides about the others.
    fn wear(&mut self, block: usize, tau: R) {
        let floor = self.model.blocks[block].floor;
        for j in self.on_floor(floor) {
            let (data, state) = (&self.model.blocks[j], &mut self.state.blocks[j]);
            let Some(&Stage { path, mu_s, mu_k }) = data.stages.get(state.stage + 1) else { continue };
            let slides = matches!(state.contact, Contact::Sliding(_));
            let comes = slides && path - state.path <= R::of(ROUNDING) * R::epsilon() * path;
            if j == block || comes {
                state.stage += 1;
                (state.path, state.mu_s, state.mu_k) = (path, mu_s, mu_k);
                let (sign, stage) = (state.velocity_sign(), state.stage);
                self.note(tau, EventKind::Wear, j, sign, stage as u8);
            }
        }
        self.settle(floor, tau, Cause::Wear(block));
    }

    /// Sets the relative velocity to exactly zero: of `block`, and of all on its floor that arrive at this instant.
    fn arrive_together(&mut self, block: usize, series: &Series<R>, tau: R) {
        let floor = self.model.blocks[block].floor;
        let size = self.state.acceleration(self.model, floor, &self.drive, tau, Terms::Sizes);
        let BlockState { velocity, mu_k, .. } = self.state.blocks[block];
        for j in self.on_floor(floor) {
            let Contact::Sliding(sign) = self.state.blocks[j].contact else { continue };
            let limit = size + self.state.blocks[j].mu_k * self.model.gravity;
            let rounding = R::of(ROUNDING) * R::epsilon() * self.piece * limit;
            let approaching = sign.times(series.velocity[j].derivative().end()) <= R::zero();
            let moves_alike = self.state.blocks[j].mu_k == mu_k && self.state.blocks[j].velocity == velocity;
            let state = &mut self.state.blocks[j];
            if j == block || state.moved && (moves_alike || approaching && state.velocity.abs() <= rounding) {
                state.velocity = R::zero();
                state.moved = true;
            }
        }
    }

    /// The floor decides which of its blocks without relative velocity stick: all are taken as stuck, those whose
    /// limit is exceeded are released until there is none. What has broken away at this instant goes on when another
    /// block follows it: without contact force and acceleration all limits are reached at once, and only rates tell.
    fn settle(&mut self, floor: usize, tau: R, cause: Cause) {
        let mut still = self.on_floor(floor);
        let follows = matches!(cause, Cause::Breakaway(..) | Cause::Wear(_));
        still.retain(|&j| {
            let block = &self.state.blocks[j];
            let goes_on = follows && !block.moved && matches!(block.contact, Contact::Sliding(_));
            block.velocity == R::zero() && !goes_on && cause != Cause::Wear(j)
        });
        let before: Vec<_> = still.iter().map(|&j| self.state.blocks[j]).collect();
        still.iter().for_each(|&j| self.state.blocks[j].contact = Contact::Stuck);
        let contact = self.drive.contact_at(tau);
        let rounding = R::of(ROUNDING) * R::epsilon();
        if let Cause::Breakaway(weakest, sign) = cause {
            let limit = self.state.blocks[weakest].mu_s;
            for &j in &still {
                let block = &mut self.state.blocks[j];
                if block.mu_s == limit {
                    block.contact = Contact::Sliding(sign.opposite());
                }
            }
        }
        loop {
            let a = self.state.acceleration(self.model, floor, &self.drive, tau, Terms::Signed);
            let size = self.state.acceleration(self.model, floor, &self.drive, tau, Terms::Sizes);
            let exceeded = |j: usize| {
                let mu = self.state.blocks[j].mu_s;
                a.abs() > mu * contact + rounding * (mu * self.model.gravity + size)
            };
            let stuck = |j: usize| self.state.blocks[j].contact == Contact::Stuck;
            let released: Vec<usize> = still.iter().copied().filter(|&j| stuck(j) && exceeded(j)).collect();
            if released.is_empty() {
                break;
            }
            released.iter().for_each(|&j| self.state.blocks[j].contact = Contact::Sliding(Sign::of(a).opposite()));
        }
        for (&j, before) in still.iter().zip(before) {
            let after = self.state.blocks[j].contact;
            let event = match (before.contact, after) {
                (Contact::Sliding(_), Contact::Sliding(_)) if !before.moved => None,
                (Contact::Sliding(old), Contact::Sliding(new)) if old == new => Some((EventKind::Touch, new)),
                (Contact::Sliding(_), Contact::Sliding(new)) => Some((EventKind::Reverse, new)),
                (Contact::Sliding(old), _) => Some((EventKind::Stick, old)),
                (_, Contact::Sliding(new)) => Some((EventKind::Slip, new)),
                _ => None,
            };
            if after != Contact::Stuck {
                self.state.blocks[j].moved = false;
            }
            if let Some((kind, sign)) = event {
                self.note(tau, kind, j, sign.as_i8(), 0);
            }
        }
    }

    /// All blocks leave the ground and the floors, or come back.
    fn change_contact(&mut self, tau: R) {
        *self.airborne = !*self.airborne;
        let kind = if *self.airborne { EventKind::Lift } else { EventKind::Land };
        for j in 0..self.state.blocks.len() {
            let block = &mut self.state.blocks[j];
            block.contact = match kind {
                EventKind::Lift => Contact::Airborne,
                _ if block.velocity == R::zero() => Contact::Stuck,
                _ => Contact::Sliding(Sign::of(block.velocity)),
            };
            let sign = block.velocity_sign();
            self.note(tau, kind, j, sign, 0);
        }
        if kind == EventKind::Land {
            self.settle_all(tau);
        }
    }

    /// Every floor decides.
    pub(crate) fn settle_all(&mut self, tau: R) {
        for floor in 0..=self.model.mass.len() {
            self.settle(floor, tau, Cause::Contact);
        }
    }
}
