//! How the slab of a sliding base moves and decides (`numerics`, section 9.6).

use seismass::{Event, EventKind, GeneralEvent};

use super::arrangement::Machines;
use super::base::contact_after;
use super::decide::{AT_STOPS, Cause};
use super::guards::{First, Guard, ROUNDING};
use super::model::{GoodsData, Model};
use super::series::Series;
use super::state::State;
use crate::model::Terms;
use crate::polynomial::{Polynomial, term};
use crate::real::Real;
use crate::series::integrate;
use crate::sign::Sign;
use crate::state::{BlockState, Contact, Drive};

impl<R: Real> State<R> {
    /// Whether the slab has an acceleration of its own.
    pub(super) fn base_moves(&self) -> bool {
        self.base.is_some_and(|base| base.contact != Contact::Stuck)
    }

    /// Velocity of what stands under the nodes, relative to the ground.
    pub(super) fn base_velocity(&self) -> R {
        self.base.map_or(R::zero(), |base| base.velocity)
    }

    /// Number, state and constant data of the goods that stand on the slab.
    fn goods_on_slab<'a>(
        &'a self,
        model: &'a Model<R>,
    ) -> impl Iterator<Item = (usize, &'a BlockState<R>, &'a GoodsData<R>)> {
        let all = self.blocks.iter().zip(&model.goods).enumerate();
        all.filter(|(_, (_, goods))| goods.node.is_none()).map(|(j, (block, goods))| (j, block, goods))
    }

    /// Force of all but the ground's inertia on the slab with the goods that stick to it, and their mass.
    pub(super) fn on_slab(&self, model: &Model<R>, drive: &Drive<R>, tau: R, terms: Terms) -> (R, R) {
        let (Some(data), Some(base)) = (&model.base, &self.base) else { return (R::zero(), R::of(1.0)) };
        let mut force = model.pull_below(&self.spring_forces(terms), &self.drift, &self.rate, terms);
        let (mut mass, contact) = (data.mass, drive.contact_at(tau));
        for (j, block, goods) in self.goods_on_slab(model) {
            match block.contact {
                Contact::Stuck => {
                    mass = mass + goods.mass;
                    continue;
                }
                Contact::Sliding(sign) => force = force + terms.of(sign.times(block.mu_k * goods.mass * contact)),
                Contact::Airborne => {}
            }
            force = force + terms.of(self.push(model, j));
        }
        if base.contact != Contact::Airborne {
            force = force + terms.of(-data.restoring * contact * base.slip);
        }
        if let Contact::Sliding(sign) = base.contact {
            force = force + terms.of(-sign.times(base.mu_k * data.carried * contact));
        }
        (force, mass)
    }
}

impl<R: Real> Series<R> {
    /// Acceleration of this order of the ground, or of the slab that moves on it, which goes on to the next order.
    pub(super) fn below(&mut self, model: &Model<R>, state: &State<R>, order: usize) -> R {
        let ground = term(&self.ground, order);
        let (Some(data), Some(base)) = (&model.base, &state.base) else { return ground };
        let springs = self.spring_terms(state, order);
        let terms = |list: &[Polynomial<R>]| list.iter().map(|p| term(p, order)).collect::<Vec<R>>();
        let mut force = model.pull_below(&springs, &terms(&self.drift), &terms(&self.rate), Terms::Signed);
        let mut mass = data.mass;
        for (j, block, goods) in state.goods_on_slab(model) {
            if block.contact == Contact::Stuck {
                mass = mass + goods.mass;
            } else {
                force = force + term(&self.push[j], order) + term(&self.friction[j], order);
            }
        }
        let (length, contact) = (self.length, &self.contact);
        let Some(own) = &mut self.base else { return ground };
        if base.contact != Contact::Airborne {
            let product = (0..=order).fold(R::zero(), |sum, k| sum + term(contact, k) * term(&own.slip, order - k));
            force = force - data.restoring * product;
        }
        if let Contact::Sliding(sign) = base.contact {
            force = force - sign.times(base.mu_k * data.carried) * term(contact, order);
        }
        own.holding.0.push(mass * ground - force);
        if base.contact == Contact::Stuck {
            return ground;
        }
        own.velocity.0.push(length * (force / mass - ground) / R::of((order + 1) as f64));
        integrate(&own.velocity, R::of(1.0), length, &mut own.slip);
        force / mass
    }

    /// Size of the terms of the force on the slab over the stretch, and the mass that it moves.
    pub(super) fn size_below(&self, model: &Model<R>, state: &State<R>) -> (R, R) {
        let (Some(data), Some(base), Some(own)) = (&model.base, &state.base, &self.base) else {
            return (R::zero(), R::of(1.0));
        };
        let sizes = |list: &[Polynomial<R>]| list.iter().map(Polynomial::size).collect::<Vec<R>>();
        let springs = self.spring_sizes(state);
        let mut force = model.pull_below(&springs, &sizes(&self.drift), &sizes(&self.rate), Terms::Sizes);
        let (mut mass, contact) = (data.mass, self.contact.size());
        for (j, block, goods) in state.goods_on_slab(model) {
            if block.contact == Contact::Stuck {
                mass = mass + goods.mass;
            } else {
                force = force + self.push[j].size() + block.mu_k * goods.mass * contact;
            }
        }
        force = force + (data.restoring * own.slip.size() + base.mu_k * data.carried) * contact;
        (force, mass)
    }
}

impl<R: Real> Machines<'_, R> {
    /// Whether the slab takes part in a decision: it has no velocity, and does not follow from another release.
    pub(super) fn base_decides(&self, follows: bool) -> bool {
        self.state.base.is_some_and(|base| {
            let goes_on = follows && !base.moved && base.contact != Contact::Stuck;
            base.velocity == R::zero() && base.contact != Contact::Airborne && !goes_on && !base.slides_freely()
        })
    }

    /// Slab and goods on it decide: the goods at the acceleration of the ground, then whether the force that holds the slab
    /// there is within its limit, and where it is not the goods beside the released slab.
    pub(super) fn settle_base(&mut self, tau: R, cause: Cause) {
        let fired = if let Cause::Base(sign) = cause { Some(sign) } else { None };
        let (Some(before), Some(data)) = (self.state.base, &self.model.base) else { return };
        let (blocks, logged) = (self.state.blocks.clone(), self.log.len());
        let mut base = BlockState { contact: Contact::Stuck, ..before };
        self.state.base = Some(base);
        self.settle_goods(None, tau, cause);
        let of_terms = |terms| {
            let (force, mass) = self.state.on_slab(self.model, &self.drive, tau, terms);
            (mass * terms.of(self.drive.ground_at(tau)), force)
        };
        let ((inertia, force), (inertia_size, size)) = (of_terms(Terms::Signed), of_terms(Terms::Sizes));
        let holding = inertia - force;
        let limit = base.mu_s * data.carried;
        let rounding = R::of(ROUNDING) * R::epsilon() * (limit * self.model.gravity + inertia_size + size);
        if fired.is_some() || holding.abs() > limit * self.drive.contact_at(tau) + rounding {
            let away = fired.unwrap_or(Sign::of(holding)).opposite();
            base.contact = Contact::Sliding(away);
            self.state.base = Some(base);
            let held = std::mem::replace(&mut self.state.blocks, blocks.clone());
            self.log.truncate(logged);
            self.settle_goods(None, tau, cause);
            let [own, size] = [Terms::Signed, Terms::Sizes]
                .map(|terms| self.state.acceleration(self.model, None, &self.drive, tau, terms));
            let (ground, rounding) = (self.drive.ground_at(tau), R::of(AT_STOPS) * R::epsilon());
            if away.times(own - ground) < -(rounding * (size + ground.abs())) {
                self.state.blocks = blocks;
                self.log.truncate(logged);
                self.leave_ground(tau, cause, away, &held);
            }
        }
        let event = match (before.contact, base.contact) {
            (Contact::Sliding(old), Contact::Sliding(new)) if old == new => {
                before.moved.then_some((EventKind::Touch, new))
            }
            (Contact::Sliding(_), Contact::Sliding(new)) => Some((EventKind::Reverse, new)),
            (Contact::Sliding(old), _) => Some((EventKind::Stick, old)),
            (_, Contact::Sliding(new)) => Some((EventKind::Slip, new)),
            _ => None,
        };
        if let (Some(base), Contact::Sliding(_)) = (&mut self.state.base, base.contact) {
            base.moved = false;
        }
        if let Some((kind, sign)) = event {
            let entry = self.of_base(tau, kind, sign.as_i8(), 0.0);
            self.log.insert(logged, entry);
        }
    }

    /// The acceleration of a released slab goes from that of the ground in the direction `away` until the forces on the slab
    /// suffice for it; goods start from what they `held` at that of the ground. One that sticks passes its limit mu_s N, one
    /// that is driven the other way is held first where mu_k N suffices: with what drives a block known, each place at which it
    /// changes is known too. From place to place the states are given and the acceleration follows from the forces; it is
    /// that of the first interval that it lies in.
    fn leave_ground(&mut self, tau: R, cause: Cause, away: Sign, held: &[BlockState<R>]) {
        let still = self.deciding(None, cause);
        let before: Vec<BlockState<R>> = still.iter().map(|&j| self.state.blocks[j]).collect();
        let contact = self.drive.contact_at(tau);
        let mut places: Vec<(R, usize, Contact)> = Vec::new();
        for &j in &still {
            self.state.blocks[j].contact = held[j].contact;
            let BlockState { mu_s, mu_k, .. } = held[j];
            // Acceleration of the slab, counted in the direction `away`, at which nothing drives the block.
            let undriven = away.times(-self.state.push(self.model, j) / self.model.goods[j].mass);
            let passed = (undriven + mu_s * contact, j, Contact::Sliding(away.opposite()));
            match held[j].contact {
                Contact::Sliding(sign) if sign == away => {
                    places.extend([(undriven - mu_k * contact, j, Contact::Stuck), passed]);
                }
                Contact::Stuck => places.push(passed),
                _ => {}
            }
        }
        // The order of one block's places stays where they are equal.
        places.sort_by(|(one, ..), (other, ..)| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal));
        let rounding = R::of(AT_STOPS) * R::epsilon();
        for (place, j, next) in places {
            let [own, size] = [Terms::Signed, Terms::Sizes]
                .map(|terms| self.state.acceleration(self.model, None, &self.drive, tau, terms));
            if away.times(own) <= place + rounding * size {
                break;
            }
            self.state.blocks[j].contact = next;
        }
        self.note_changes(tau, cause, &still, &before);
    }

    fn of_base(&self, tau: R, kind: EventKind, sign: i8, velocity: f64) -> GeneralEvent {
        let time = (self.start + tau).to_f64();
        GeneralEvent { event: Event { time, kind, number: 0, sign, element: 0 }, velocity }
    }

    /// The slab leaves the ground or comes back.
    pub(super) fn change_contact_of_base(&mut self, kind: EventKind, tau: R) {
        let Some(base) = &mut self.state.base else { return };
        base.contact = contact_after(kind, base.velocity);
        let (sign, velocity) = (base.velocity_sign(), base.velocity.to_f64());
        let entry = self.of_base(tau, kind, sign, velocity);
        self.log.push(entry);
    }

    /// The limit of a slab that sticks, or the arrival of one that slides.
    pub(super) fn base(&self, series: &Series<R>, first: &mut First<R>) {
        let (Some(data), Some(base), Some(own)) = (&self.model.base, &self.state.base, &series.base) else { return };
        let (force, mass) = series.size_below(self.model, self.state);
        match base.contact {
            Contact::Stuck => {
                let limit = base.mu_s * data.carried;
                let size = limit * (self.model.gravity + series.contact.size()) + force + mass * series.ground.size();
                for sign in [Sign::Positive, Sign::Negative] {
                    let guard = series.contact.scaled(limit).plus(&own.holding.scaled(sign.times(R::of(-1.0))));
                    first.consider(Guard::BaseBreakaway { sign }, &guard, size);
                }
            }
            Contact::Sliding(sign) => {
                let guard = own.velocity.scaled(sign.times(R::of(1.0)));
                let size = guard.size() + self.piece * (force / mass + series.ground.size());
                first.consider(Guard::BaseArrival, &guard, size);
            }
            Contact::Airborne => {}
        }
    }
}
