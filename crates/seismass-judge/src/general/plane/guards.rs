//! Guards of both directions and of vectors, and the first that falls.

use super::path;
use super::series::PlaneSeries;
use super::state::Plane;
use crate::general::guards::{First, Guard};
use crate::general::series::{Series, place};
use crate::general::state::Stopped;
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::Contact;

/// A relative velocity that falls below this, in units of the number type's epsilon times the largest velocity so far, is
/// none.
pub(super) const AT_REST: f64 = 40.0;
/// Bisections of a stretch, to find where a block without friction wears.
const BISECTIONS: usize = 60;

impl<R: Real> Plane<R> {
    /// A block that has come to rest at the start of a stretch.
    pub(super) fn arrival(&self, series: &PlaneSeries<R>) -> Option<usize> {
        let least = R::of(AT_REST) * R::epsilon() * self.fastest;
        let at_rest = |j: usize| {
            let Some(sliding) = &series.sliding[j] else { return false };
            sliding.power == 0 && sliding.speed[0] < least && sliding.speed[1] < R::zero()
        };
        (0..series.sliding.len()).find(|&j| at_rest(j))
    }

    /// Blocks of a node that come to rest with one of them.
    pub(super) fn arrive_with(&self, block: usize) -> Vec<usize> {
        let least = R::of(4.0 * AT_REST) * R::epsilon() * self.fastest;
        let goods = &self.directions[0].model.goods;
        let comes = |j: usize| {
            let [x, y] = self.velocity(j);
            let speed = (x * x + y * y).sqrt();
            j == block
                || goods[j].node == goods[block].node && self.has_friction(j) && speed > R::zero() && speed < least
        };
        (0..goods.len()).filter(|&j| comes(j)).collect()
    }

    /// A block starts away from a stop that does not press any more, and counts as at rest.
    fn starts_away(&self, block: usize, a: usize) -> bool {
        let Stopped::Parted(side) = self.directions[a].state.stopped[block] else { return false };
        self.young[block] && side.times(self.heads[block][a]) < R::zero()
    }

    /// The first guard that falls on a stretch, its place on it in [0, 1], and its direction.
    pub(super) fn first_event(&mut self, series: &PlaneSeries<R>) -> Option<(R, usize, Guard)> {
        let mut first = First::new();
        let of =
            |a: usize| series.directions[a].acceleration_sizes(&self.directions[a].model, &self.directions[a].state);
        let sizes = [of(0), of(1)];
        for a in 0..2 {
            first.direction = a;
            let start_away: Vec<bool> = (0..self.heads.len()).map(|j| self.starts_away(j, a)).collect();
            let machines = self.machines(a);
            machines.contact_and_springs(&series.directions[a], &sizes[a], &mut first);
            for (j, &starts_away) in start_away.iter().enumerate() {
                if !machines.is_stuck(j) {
                    machines.stops((j, starts_away), &series.directions[a], &sizes[a], &mut first);
                }
            }
        }
        first.direction = 0;
        self.collapse(series, &mut first);
        for j in 0..self.heads.len() {
            match self.directions[0].state.blocks[j].contact {
                Contact::Stuck => self.breakaway(j, series, &sizes, &mut first),
                Contact::Sliding(_) => self.wear_guard(j, series, &mut first),
                Contact::Airborne => {}
            }
        }
        first.found
    }

    fn collapse(&self, series: &PlaneSeries<R>, first: &mut First<R>) {
        for (node, limits) in self.collapse.iter().enumerate() {
            let one = R::of(1.0);
            let (mut guard, mut size) = (Polynomial::constant(one), one);
            for (limit, series) in limits.iter().zip(&series.directions) {
                let Some(limit) = limit else { continue };
                let drift = series.drift[node].scaled(one / *limit);
                guard = guard.plus(&drift.times(&drift).scaled(-one));
                size = size + drift.size() * drift.size();
            }
            first.consider(Guard::Collapse { node }, &guard, size);
        }
    }

    /// (mu_s N)^2 - |y|^2.
    fn breakaway(&self, block: usize, series: &PlaneSeries<R>, sizes: &[Vec<R>; 2], first: &mut First<R>) {
        let data = &self.directions[0].model.goods[block];
        let mu = self.directions[0].state.blocks[block].mu_s;
        let contact = series.directions[0].contact.scaled(mu);
        let (mut guard, mut size) = (contact.times(&contact), mu * (self.directions[0].model.gravity + contact.size()));
        let mut reach = R::zero();
        for a in 0..2 {
            let of = &self.directions[a];
            let on_stop = of.state.push(&of.model, block) / data.mass;
            let driven = series.directions[a].acceleration[place(data.node)].plus(&Polynomial::constant(on_stop));
            reach = reach + driven.size() * driven.size();
            size = size + sizes[a][place(data.node)] + on_stop.abs();
            guard = guard.plus(&driven.times(&driven).scaled(R::of(-1.0)));
        }
        let least = contact.start().abs() - (contact.size() - contact.start().abs());
        if least <= R::zero() || reach > R::of(0.99) * least * least {
            first.consider(Guard::Breakaway { block, sign: Sign::Positive }, &guard, size * size);
        }
    }

    fn wear_guard(&self, block: usize, series: &PlaneSeries<R>, first: &mut First<R>) {
        let state = &self.directions[0].state.blocks[block];
        let Some(next) = self.directions[0].model.goods[block].stages.get(state.stage + 1) else { return };
        let left = next.path - state.path;
        if let Some(slipped) = series.slipped(block) {
            let guard = Polynomial::constant(left).plus(&slipped.scaled(R::of(-1.0)));
            first.consider(Guard::Wear { block }, &guard, next.path + slipped.size());
            return;
        }
        // Without friction: a straight guard that falls where the path is long enough.
        let (length, left) = (series.length().to_f64(), left.to_f64());
        let velocity = series.directions.each_ref().map(|series| &series.velocity[block]);
        let path = |end: f64| length * path::length(velocity, end);
        if path(1.0) < left {
            return;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if path(middle) < left {
                low = middle;
            } else {
                high = middle;
            }
        }
        let guard = Polynomial(vec![R::of(high), R::of(-1.0)]);
        first.consider(Guard::Wear { block }, &guard, R::of(high));
    }

    /// Adds what has been slipped over a stretch to the paths of blocks that slide.
    pub(super) fn add_paths(&mut self, series: &PlaneSeries<R>) {
        for j in 0..self.heads.len() {
            if let Contact::Sliding(_) = self.directions[0].state.blocks[j].contact {
                let path = self.path_over(j, series);
                self.directions[0].state.blocks[j].path = self.directions[0].state.blocks[j].path + path;
            }
        }
    }

    /// Path of a sliding block over a stretch.
    pub(super) fn path_over(&self, j: usize, series: &PlaneSeries<R>) -> R {
        let without_friction = || {
            let velocity = series.directions.each_ref().map(|series: &Series<R>| &series.velocity[j]);
            series.length() * R::of(path::length(velocity, 1.0))
        };
        series.slipped(j).map_or_else(without_friction, |slipped| slipped.end())
    }
}
