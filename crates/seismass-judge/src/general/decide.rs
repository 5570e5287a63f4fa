//! A node decides which of its blocks stick (`numerics`, sections 2.3 and 9.3).

use seismass::EventKind;

use super::arrangement::Machines;
use super::guards::ROUNDING;
use crate::model::Terms;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::{BlockState, Contact};

/// Rounding of a decision of blocks at stops, in units of the number type's epsilon.
pub(super) const AT_STOPS: f64 = 1000.0;
/// Releases and sticks of one block, before all states are tried.
pub(super) const CHANGES: usize = 8;

/// Why a node decides which of its blocks stick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cause {
    /// This stuck block, and those driven as it is, have reached their limit with this sign of what drives them.
    Breakaway(usize, Sign),
    /// A block has arrived.
    Arrival,
    /// The friction coefficients of this block have changed.
    Wear(usize),
    /// The force of a stop has jumped.
    Jump,
    /// Blocks that began to slide in the plane have not moved yet.
    Young,
    /// Contact begins: the start of a run, or a landing.
    Contact,
    /// The slab has reached its limit, with this sign of the force that holds it.
    Base(Sign),
}

impl Cause {
    /// Whether what has broken away at this instant goes on.
    fn follows(self) -> bool {
        matches!(self, Self::Breakaway(..) | Self::Wear(_) | Self::Base(_))
    }
}

impl<R: Real> Machines<'_, R> {
    /// Every node decides.
    pub(super) fn settle_all(&mut self, tau: R) {
        self.settle(None, tau, Cause::Contact);
        for node in 0..self.model.mass.len() {
            self.settle(Some(node), tau, Cause::Contact);
        }
    }

    /// The node decides which of its blocks without relative velocity stick. What has broken away at this instant goes on
    /// when another block follows it: without contact force and acceleration all limits are reached at once, and only
    /// rates tell.
    pub(super) fn settle(&mut self, node: Option<usize>, tau: R, cause: Cause) {
        if node.is_none() && self.base_decides(cause.follows()) {
            self.settle_base(tau, cause);
        } else {
            self.settle_goods(node, tau, cause);
        }
    }

    /// The same of the goods alone.
    pub(super) fn settle_goods(&mut self, node: Option<usize>, tau: R, cause: Cause) {
        let still = self.deciding(node, cause);
        let before: Vec<BlockState<R>> = still.iter().map(|&j| self.state.blocks[j]).collect();
        still.iter().for_each(|&j| self.state.blocks[j].contact = Contact::Stuck);
        let mut gone = Vec::new();
        if let Cause::Breakaway(first, sign) = cause {
            let offset = |j: usize| self.state.push(self.model, j) / self.model.goods[j].mass;
            let alike =
                |j: usize| self.state.blocks[j].mu_s == self.state.blocks[first].mu_s && offset(j) == offset(first);
            gone = still.iter().copied().filter(|&j| alike(j)).collect();
            gone.iter().for_each(|&j| self.state.blocks[j].contact = Contact::Sliding(sign.opposite()));
        }
        if still.iter().any(|&j| self.presses(j)) {
            self.decide_at_stops(node, tau, &still, &gone);
        } else {
            self.decide(node, tau, &still);
        }
        self.note_changes(tau, cause, &still, &before);
    }

    /// The blocks that take part in a decision.
    pub(super) fn deciding(&self, node: Option<usize>, cause: Cause) -> Vec<usize> {
        let mut still = self.on_node(node);
        still.retain(|&j| {
            let block = &self.state.blocks[j];
            let goes_on = cause.follows() && !block.moved && matches!(block.contact, Contact::Sliding(_));
            block.velocity == R::zero() && !goes_on && !block.slides_freely() && cause != Cause::Wear(j)
        });
        still
    }

    /// Logs what blocks do that have decided, and did something else before.
    pub(super) fn note_changes(&mut self, tau: R, cause: Cause, still: &[usize], before: &[BlockState<R>]) {
        // A force that jumps may turn what has just broken away.
        let jumps = cause == Cause::Jump;
        for (&j, before) in still.iter().zip(before) {
            let after = self.state.blocks[j].contact;
            let event = match (before.contact, after) {
                (Contact::Sliding(old), Contact::Sliding(new)) if !before.moved && (old == new || !jumps) => None,
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

    /// Without stops: all are stuck, those whose limit is exceeded are released until there is none.
    fn decide(&mut self, node: Option<usize>, tau: R, still: &[usize]) {
        let rounding = R::of(ROUNDING) * R::epsilon();
        let contact = self.drive.contact_at(tau);
        loop {
            let a = self.state.acceleration(self.model, node, &self.drive, tau, Terms::Signed);
            let size = self.state.acceleration(self.model, node, &self.drive, tau, Terms::Sizes);
            let exceeded = |j: usize| {
                let mu = self.state.blocks[j].mu_s;
                a.abs() > mu * contact + rounding * (mu * self.model.gravity + size)
            };
            let released: Vec<usize> = still.iter().copied().filter(|&j| self.is_stuck(j) && exceeded(j)).collect();
            if released.is_empty() {
                return;
            }
            let away = Contact::Sliding(Sign::of(a).opposite());
            released.iter().for_each(|&j| self.state.blocks[j].contact = away);
        }
    }

    /// With blocks that press on stops: the one that exceeds its limit the most is released, what is driven by less than
    /// kinetic friction sticks again. Where this does not end, all states by number of sliding blocks.
    fn decide_at_stops(&mut self, node: Option<usize>, tau: R, still: &[usize], gone: &[usize]) {
        for _ in 0..CHANGES * still.len() {
            // How far a block that slides is below kinetic friction.
            let lost = |j: usize| match self.state.blocks[j].contact {
                Contact::Sliding(_) => !self.is_consistent(j, node, tau),
                _ => false,
            };
            // What has just reached its limit sticks again only where another block's release makes it.
            let others_slide = still.iter().any(|&j| !gone.contains(&j) && !self.is_stuck(j));
            let sticks = still.iter().copied().find(|&j| (others_slide || !gone.contains(&j)) && lost(j));
            if let Some(j) = sticks {
                self.state.blocks[j].contact = Contact::Stuck;
                continue;
            }
            let contact = self.drive.contact_at(tau);
            let mut worst: Option<(R, usize, Sign)> = None;
            for &j in still.iter().filter(|&&j| self.is_stuck(j) && !self.is_consistent(j, node, tau)) {
                let (driven, _) = self.driven(j, node, tau);
                let excess = driven.abs() - self.state.blocks[j].mu_s * contact;
                if worst.is_none_or(|(most, ..)| excess > most) {
                    worst = Some((excess, j, Sign::of(driven)));
                }
            }
            let Some((_, j, sign)) = worst else { return };
            self.state.blocks[j].contact = Contact::Sliding(sign.opposite());
        }
        self.try_all(node, tau, still, gone);
    }

    /// The consistent state with the fewest sliding blocks, other than that all blocks stick which have reached their limit.
    fn try_all(&mut self, node: Option<usize>, tau: R, still: &[usize], gone: &[usize]) {
        let states = [Contact::Stuck, Contact::Sliding(Sign::Positive), Contact::Sliding(Sign::Negative)];
        let mut best: Option<(usize, usize)> = None;
        let set = |machines: &mut Self, mut code: usize| {
            for &j in still {
                machines.state.blocks[j].contact = states[code % 3];
                code /= 3;
            }
        };
        for code in 0..3usize.pow(still.len() as u32) {
            set(self, code);
            let sliding = still.iter().filter(|&&j| !self.is_stuck(j)).count();
            let moves_on = gone.is_empty() || sliding > 0;
            let fewer = best.is_none_or(|(least, _)| sliding < least);
            if fewer && moves_on && still.iter().all(|&j| self.is_consistent(j, node, tau)) {
                best = Some((sliding, code));
            }
        }
        set(self, best.map_or(0, |(_, code)| code));
    }

    /// y: the acceleration by which a block would move away from its node without friction, and the size of its terms.
    fn driven(&self, block: usize, node: Option<usize>, tau: R) -> (R, R) {
        let stop = self.state.push(self.model, block) / self.model.goods[block].mass;
        let a = self.state.acceleration(self.model, node, &self.drive, tau, Terms::Signed);
        (a + stop, a.abs() + stop.abs())
    }

    /// Whether a block that sticks is within its limit, or one that slides is driven by kinetic friction at least.
    fn is_consistent(&self, block: usize, node: Option<usize>, tau: R) -> bool {
        let (driven, size) = self.driven(block, node, tau);
        let state = &self.state.blocks[block];
        let contact = self.drive.contact_at(tau);
        let slab = self.model.base.as_ref().filter(|_| self.state.base_moves()).map(|base| base.mass);
        let heavier = node.map_or(slab, |p| Some(self.model.mass[p])).map_or(R::of(1.0), |mass| {
            let goods = self.on_node(node).into_iter().fold(R::zero(), |sum, j| sum + self.model.goods[j].mass);
            (mass + goods) / mass
        });
        let tolerance = R::of(AT_STOPS) * R::epsilon() * (state.mu_s * contact + size) * heavier;
        match state.contact {
            Contact::Sliding(sign) => -sign.times(driven) >= state.mu_k * contact - tolerance,
            _ => driven.abs() <= state.mu_s * contact + tolerance,
        }
    }
}
