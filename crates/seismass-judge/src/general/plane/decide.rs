//! A node decides which of its blocks stick, in the plane (`numerics`, section 9).
//!
//! A block without relative velocity is driven by y = A + P / m, where P is the force of its stops on the node. Where none
//! presses, all of them are driven by A, which is parallel to the load whatever sticks: the decision is that of one
//! direction. Where one does, A is the minimum of a convex function for every set of blocks that slide.

use seismass::EventKind;

use super::guards::AT_REST;
use super::series::heavier;
use super::state::Plane;
use crate::general::decide::{AT_STOPS, CHANGES, Cause};
use crate::general::guards::ROUNDING;
use crate::model::Terms;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::{BlockState, Contact};

/// Steps of Newton's method.
const MAX_STEPS: usize = 200;
/// A step that does not shorten the gradient is shortened so often.
const MAX_HALVINGS: usize = 40;

/// A node at an instant, and its blocks without relative velocity.
struct Node<R> {
    /// Force on the node, but from these blocks; on the ground its acceleration.
    load: [R; 2],
    /// Of the terms of the load.
    size: R,
    /// Without these blocks; none: the ground, which moves as it is told.
    mass: Option<R>,
    contact: R,
    gravity: R,
    heavier: R,
    blocks: Vec<Candidate<R>>,
}

#[derive(Clone)]
struct Candidate<R> {
    block: usize,
    mass: R,
    mu_s: R,
    mu_k: R,
    push: [R; 2],
    slides: bool,
    /// Has reached its limit, or goes on.
    gone: bool,
}

fn length<R: Real>([x, y]: [R; 2]) -> R {
    (x * x + y * y).sqrt()
}

impl<R: Real> Plane<R> {
    /// Every node decides.
    pub(super) fn settle_all(&mut self, tau: R) {
        self.settle(None, tau, Cause::Contact);
        for node in 0..self.directions[0].model.mass.len() {
            self.settle(Some(node), tau, Cause::Contact);
        }
    }

    /// The node decides which of its blocks without relative velocity stick, and where the others go.
    pub(super) fn settle(&mut self, node: Option<usize>, tau: R, cause: Cause) {
        let follows = matches!(cause, Cause::Breakaway(..) | Cause::Wear(_));
        let state = |j: usize| self.directions[0].state.blocks[j];
        let goes_on = |j: usize| follows && !state(j).moved && matches!(state(j).contact, Contact::Sliding(_));
        let still: Vec<usize> = (0..self.heads.len())
            .filter(|&j| self.directions[0].model.goods[j].node == node && self.is_still(j))
            .collect();
        let first = if let Cause::Breakaway(first, _) = cause { Some(first) } else { None };
        let alike = |j: usize| {
            first.is_some_and(|i| state(i).mu_s == state(j).mu_s && !goes_on(j) && self.offset(i) == self.offset(j))
        };
        let candidates = still.iter().map(|&j| {
            let gone = alike(j) || goes_on(j) || cause == Cause::Young && self.young[j];
            Candidate {
                block: j,
                mass: self.directions[0].model.goods[j].mass,
                mu_s: state(j).mu_s,
                mu_k: state(j).mu_k,
                push: [0, 1].map(|a| self.directions[a].state.push(&self.directions[a].model, j)),
                slides: gone,
                gone,
            }
        });
        let candidates: Vec<Candidate<R>> = candidates.collect();
        if candidates.is_empty() {
            return;
        }
        let before: Vec<(BlockState<R>, bool)> = still.iter().map(|&j| (state(j), goes_on(j))).collect();
        let mut decided = self.node(node, tau, candidates);
        decided.decide();
        let a = decided.acceleration();
        for (candidate, (before, goes_on)) in decided.blocks.iter().zip(before) {
            let j = candidate.block;
            let driven = decided.driven(candidate, a);
            let contact = if candidate.slides { Contact::Sliding(Sign::Positive) } else { Contact::Stuck };
            self.set_contact(j, contact);
            self.young[j] = candidate.slides;
            let arrived = matches!(before.contact, Contact::Sliding(_)) && before.moved;
            if candidate.slides {
                let size = length(driven);
                self.heads[j] = driven.map(|y| -(y / size));
                self.directions.iter_mut().for_each(|direction| direction.state.blocks[j].moved = false);
            }
            let was_stuck = before.contact == Contact::Stuck;
            match candidate.slides {
                true if arrived => self.note(tau, EventKind::Reverse, j, self.heads[j], 0),
                true if was_stuck => self.note(tau, EventKind::Slip, j, self.heads[j], 0),
                false if arrived || !was_stuck && !goes_on => self.note(tau, EventKind::Stick, j, [R::zero(); 2], 0),
                _ => {}
            }
        }
    }

    /// A block that has started and is not yet faster than what counts as rest is at rest, and starts with whatever starts on
    /// its node until it is: the direction of its velocity would be rounding.
    pub(super) fn keep_young(&mut self) {
        let least = R::of(AT_REST) * R::epsilon() * self.fastest;
        for j in 0..self.young.len() {
            self.young[j] &= length(self.velocity(j)) <= least;
            if self.young[j] {
                for direction in &mut self.directions {
                    let block = &mut direction.state.blocks[j];
                    (block.velocity, block.moved) = (R::zero(), false);
                }
            }
        }
    }

    /// The nodes of such blocks decide.
    pub(super) fn settle_young(&mut self, tau: R) {
        for node in std::iter::once(None).chain((0..self.directions[0].model.mass.len()).map(Some)) {
            if (0..self.young.len()).any(|j| self.young[j] && self.directions[0].model.goods[j].node == node) {
                self.settle(node, tau, Cause::Young);
            }
        }
    }

    /// The limit of the acceleration of a node as these blocks come to rest: their friction turns into the direction of what
    /// drives them.
    pub(super) fn at_stop(&self, arriving: &[usize], tau: R) -> Option<[R; 2]> {
        let first = arriving[0];
        let node = self.directions[0].model.goods[first].node;
        let state = |j: usize| self.directions[0].state.blocks[j];
        let blocks: Vec<Candidate<R>> = (0..self.heads.len())
            .filter(|&j| self.directions[0].model.goods[j].node == node)
            .filter(|&j| arriving.contains(&j) || state(j).contact == Contact::Stuck)
            .map(|j| Candidate {
                block: j,
                mass: self.directions[0].model.goods[j].mass,
                mu_s: state(j).mu_s,
                mu_k: state(j).mu_k,
                push: [0, 1].map(|a| self.directions[a].state.push(&self.directions[a].model, j)),
                slides: arriving.contains(&j),
                gone: false,
            })
            .collect();
        let decided = self.node(node, tau, blocks);
        let mass = decided.mass_with_stuck()?;
        let sum = |a: [R; 2], b: [R; 2], factor: R| [0, 1].map(|i| a[i] + factor * b[i]);
        let unit = |a: [R; 2]| a.map(|x| x / length(a));
        let friction = |block: &Candidate<R>| block.mu_k * block.mass * decided.contact / mass;
        let own = |block: &Candidate<R>| unit(self.velocity(block.block));
        // Without friction of those that arrive, whose stops press on the node.
        let one = R::of(1.0);
        let bare = decided.sliding().fold(decided.load.map(|q| q / mass), |a, block| sum(a, block.push, one / mass));
        let now = decided.sliding().fold(bare, |a, block| sum(a, own(block), friction(block)));
        let driven_alike = decided.sliding().all(|block| self.offset(block.block) == self.offset(first));
        if !driven_alike {
            return Some(decided.sliding().fold(now, |a, block| {
                let without = sum(now, own(block), -friction(block));
                let driven = decided.driven(block, without);
                if length(driven) >= block.mu_k * decided.contact + friction(block) {
                    return a;
                }
                let to = unit(driven).map(|y| -y);
                sum(sum(a, to, friction(block)), own(block), -friction(block))
            }));
        }
        let driven = sum(bare, self.offset(first), one);
        let to = unit(driven).map(|y| -y);
        let size = decided.sliding().fold(R::zero(), |size, block| size + friction(block));
        if length(driven) >= state(first).mu_k * decided.contact + size {
            return None;
        }
        Some(sum(bare, to, size))
    }

    /// Whether a block has no relative velocity, and friction that may hold it.
    pub(super) fn is_still(&self, j: usize) -> bool {
        let [x, y] = self.velocity(j);
        self.directions[0].state.blocks[j].mu_s > R::zero() && x == R::zero() && y == R::zero()
    }

    /// P / m.
    fn offset(&self, j: usize) -> [R; 2] {
        [0, 1].map(|a| {
            self.directions[a].state.push(&self.directions[a].model, j) / self.directions[a].model.goods[j].mass
        })
    }

    fn node(&self, node: Option<usize>, tau: R, blocks: Vec<Candidate<R>>) -> Node<R> {
        let (model, state) = (&self.directions[0].model, &self.directions[0].state);
        let contact = self.directions[0].drive.contact_at(tau);
        let (mut load, mut size) = ([R::zero(); 2], R::zero());
        for a in 0..2 {
            let of = &self.directions[a];
            match node {
                None => load[a] = of.drive.ground_at(tau),
                Some(p) => {
                    let pull =
                        |terms| of.model.pull(&of.state.spring_forces(terms), &of.state.drift, &of.state.rate, terms);
                    load[a] = pull(Terms::Signed)[p];
                    size = size + pull(Terms::Sizes)[p];
                }
            }
            if node.is_none() {
                size = size + load[a].abs();
            }
        }
        let moves = |j: usize| model.goods[j].node == node && blocks.iter().all(|candidate| candidate.block != j);
        for j in (0..model.goods.len()).filter(|&j| node.is_some() && moves(j)) {
            let velocity = self.velocity(j);
            let speed = length(velocity);
            for a in 0..2 {
                let push = self.directions[a].state.push(&self.directions[a].model, j);
                let friction = match state.blocks[j].contact {
                    Contact::Sliding(_) if speed > R::zero() => {
                        state.blocks[j].mu_k * model.goods[j].mass * contact * velocity[a] / speed
                    }
                    _ => R::zero(),
                };
                load[a] = load[a] + push + friction;
                size = size + push.abs() + friction.abs();
            }
        }
        let mass = node.map(|p| model.mass[p]);
        Node { load, size, mass, contact, gravity: model.gravity, heavier: heavier(model, node), blocks }
    }
}

impl<R: Real> Node<R> {
    fn decide(&mut self) {
        if self.blocks.iter().all(|block| block.push == [R::zero(); 2]) {
            self.decide_along_load();
        } else {
            self.decide_at_stops();
        }
    }

    /// Without stops: all stick but those that have gone; those whose limit is exceeded are released until there is none.
    fn decide_along_load(&mut self) {
        loop {
            let a = self.along_load();
            let size = self.mass_with_stuck().map_or(self.size, |mass| self.size / mass);
            let rounding = R::of(ROUNDING) * R::epsilon();
            let mut released = false;
            for block in self.blocks.iter_mut().filter(|block| !block.slides) {
                let limit = block.mu_s * self.contact + rounding * (block.mu_s * self.gravity + size);
                if a > limit {
                    (block.slides, released) = (true, true);
                }
            }
            if !released {
                return;
            }
        }
    }

    /// |A| where no stop presses.
    fn along_load(&self) -> R {
        let load = length(self.load);
        let Some(mass) = self.mass_with_stuck() else { return load };
        let friction = self.sliding().fold(R::zero(), |sum, block| sum + block.mu_k * block.mass * self.contact);
        (load - friction) / mass
    }

    fn sliding(&self) -> impl Iterator<Item = &Candidate<R>> {
        self.blocks.iter().filter(|block| block.slides)
    }

    fn mass_with_stuck(&self) -> Option<R> {
        let stuck = self.blocks.iter().filter(|block| !block.slides);
        Some(stuck.fold(self.mass?, |sum, block| sum + block.mass))
    }

    /// With stops: the block that exceeds its limit the most is released, what is driven by less than kinetic friction sticks
    /// again. Where this does not end, the consistent state of the fewest sliding blocks.
    fn decide_at_stops(&mut self) {
        for _ in 0..CHANGES * self.blocks.len() {
            let a = self.acceleration();
            let others_slide = self.blocks.iter().any(|block| block.slides && !block.gone);
            let lost = |block: &Candidate<R>| block.slides && !self.is_consistent(block, a);
            let sticks = self.blocks.iter().position(|block| (others_slide || !block.gone) && lost(block));
            if let Some(i) = sticks {
                self.blocks[i].slides = false;
                continue;
            }
            let excess = |block: &Candidate<R>| length(self.driven(block, a)) - block.mu_s * self.contact;
            let mut worst: Option<(R, usize)> = None;
            for (i, block) in self.blocks.iter().enumerate() {
                let exceeds = !block.slides && !self.is_consistent(block, a);
                if exceeds && worst.is_none_or(|(most, _)| excess(block) > most) {
                    worst = Some((excess(block), i));
                }
            }
            let Some((_, i)) = worst else { return };
            self.blocks[i].slides = true;
        }
        let any_gone = self.blocks.iter().any(|block| block.gone);
        let mut codes: Vec<u32> = (0..1u32 << self.blocks.len()).collect();
        codes.sort_by_key(|code| code.count_ones());
        for code in codes.into_iter().filter(|&code| code > 0 || !any_gone) {
            self.blocks.iter_mut().enumerate().for_each(|(i, block)| block.slides = code >> i & 1 == 1);
            let a = self.acceleration();
            if self.blocks.iter().all(|block| self.is_consistent(block, a)) {
                return;
            }
        }
    }

    /// y.
    fn driven(&self, block: &Candidate<R>, a: [R; 2]) -> [R; 2] {
        [0, 1].map(|i| a[i] + block.push[i] / block.mass)
    }

    fn is_consistent(&self, block: &Candidate<R>, a: [R; 2]) -> bool {
        let driven = length(self.driven(block, a));
        let size = length(a) + length(block.push) / block.mass;
        let tolerance = R::of(AT_STOPS) * R::epsilon() * (block.mu_s * self.contact + size) * self.heavier;
        if block.slides {
            driven >= block.mu_k * self.contact - tolerance
        } else {
            driven <= block.mu_s * self.contact + tolerance
        }
    }

    /// A for the blocks that slide: parallel to the load where no stop presses, else by Newton's method.
    fn acceleration(&self) -> [R; 2] {
        let Some(mass) = self.mass_with_stuck() else { return self.load };
        if self.blocks.iter().all(|block| block.push == [R::zero(); 2]) {
            let (size, a) = (length(self.load), self.along_load());
            return self.load.map(|q| if size > R::zero() { q / size * a } else { R::zero() });
        }
        let load = self.sliding().fold(self.load, |sum, block| [0, 1].map(|i| sum[i] + block.push[i]));
        let gradient = |a: [R; 2]| {
            let mut sum = [0, 1].map(|i| mass * a[i] - load[i]);
            for block in self.sliding() {
                let y = self.driven(block, a);
                let size = length(y);
                if size > R::zero() {
                    let friction = block.mu_k * block.mass * self.contact / size;
                    sum = [0, 1].map(|i| sum[i] + friction * y[i]);
                }
            }
            sum
        };
        let mut a = load.map(|q| q / mass);
        for _ in 0..MAX_STEPS {
            let g = gradient(a);
            let [mut xx, mut xy, mut yy] = [mass, R::zero(), mass];
            for block in self.sliding() {
                let y = self.driven(block, a);
                let square = y[0] * y[0] + y[1] * y[1];
                if square > R::zero() {
                    let friction = block.mu_k * block.mass * self.contact / (square * square.sqrt());
                    xx = xx + friction * y[1] * y[1];
                    xy = xy - friction * y[0] * y[1];
                    yy = yy + friction * y[0] * y[0];
                }
            }
            let determinant = xx * yy - xy * xy;
            let step = [(xy * g[1] - yy * g[0]) / determinant, (xy * g[0] - xx * g[1]) / determinant];
            let mut part = R::of(1.0);
            let mut shorter = None;
            for _ in 0..MAX_HALVINGS {
                let next = [0, 1].map(|i| a[i] + part * step[i]);
                if length(gradient(next)) < length(g) {
                    shorter = Some(next);
                    break;
                }
                part = part * R::of(0.5);
            }
            let Some(next) = shorter else { break };
            a = next;
        }
        a
    }
}
