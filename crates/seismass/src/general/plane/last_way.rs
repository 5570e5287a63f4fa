//! The last way to a stop on the circle, in closed form (`numerics`, section 9.7).
//!
//! As a relative velocity r falls to zero its direction d turns into that of what drives it: r' = A - beta d, with A the
//! relative acceleration without its own friction. Where A hardly changes until the stop, that is a pursuit curve.

use crate::general::plane::series::PlaneSeries;
use crate::general::plane::slide_series::{Beginning, LastWay, SlideSeries};
use crate::general::plane::state::PlaneState;
use crate::general::plane::vector::{Vector2, length, minus, plus, times, unit};

/// What may be neglected of a velocity on the way to a stop, as a part of the largest velocity so far.
const NEGLECTED: f64 = 0.25 * f64::EPSILON;

/// What the time of a last way may be, times the fastest rate of what drives the blocks: few terms serve.
const SHORT: f64 = 1e-3;

impl PlaneSeries {
    /// The blocks that come to their stop next, if what drives them hardly changes until then: their last way is a step.
    pub(super) fn last_way(&self, state: &PlaneState, frequency: f64, longest: f64) -> Option<(Vec<usize>, LastWay)> {
        let least = state.fastest * f64::EPSILON.sqrt();
        let is_slow = |slide: &SlideSeries| slide.beginning == Beginning::Moving && slide.length[0] < least;
        let slow = (0..self.slides.len()).filter(|&i| is_slow(&self.slides[i]));
        let found = slow.filter_map(|i| self.last_way_of(i, state, (frequency, longest)));
        found.min_by(|one, other| one.1.time.total_cmp(&other.1.time))
    }

    fn last_way_of(
        &self,
        i: usize,
        state: &PlaneState,
        (frequency, longest): (f64, f64),
    ) -> Option<(Vec<usize>, LastWay)> {
        let (slide, blocks, h) = (&self.slides[i], &state.system().blocks, self.terms.h);
        let (node, inverse) = (blocks[slide.block].floor, state.axes[0].regime.inverse_mass[blocks[slide.block].floor]);
        let contact = state.axes[0].contact_at(self.terms.tau);
        let velocity = state.velocity(slide.block);
        let friction = |j: usize| state.friction(j).1 * contact;
        let moves_alike =
            |j: usize| state.velocity(j) == velocity && state.friction(j).1 == state.friction(slide.block).1;
        let (mut own, mut rate) = (friction(slide.block), frequency);
        rate += (state.axes[0].interval.contact_slope / contact).abs();
        let mut alike = Vec::new();
        for other in self.slides.iter().filter(|other| blocks[other.block].floor == node) {
            let on_node = friction(other.block) * blocks[other.block].mass * inverse;
            if moves_alike(other.block) {
                own += on_node;
                alike.push(other.block);
            } else if other.beginning == Beginning::Moving {
                rate += (friction(other.block) + on_node) / other.length[0];
            } else {
                return None;
            }
        }
        let drive = plus(times(1.0 / h, self.term(i, 1)), times(own, slide.direction[0]));
        let change = plus(times(2.0 / (h * h), self.term(i, 2)), times(own / h, slide.direction[1]));
        let at_start = LastWay::new(velocity, drive, own)?;
        let way = LastWay::new(velocity, plus(drive, times(0.5 * at_start.time, change)), own)?;
        // By a change of what drives it the time changes by as much over what slows it down, and the velocity with it.
        let slowing = own - length(drive);
        let neglected = own * way.time * rate * way.time * own / slowing;
        let is_short = slowing > 0.0 && way.time < longest && rate * way.time < SHORT;
        (is_short && neglected < NEGLECTED * state.fastest).then_some((alike, way))
    }
}

impl PlaneState<'_> {
    /// The limit of the acceleration of a node as blocks come to rest on it, with these directions so far: their friction turns
    /// into the direction of what drives them. What friction does not stop comes to zero along a line, without a turn.
    pub(super) fn acceleration_at_stop(&self, node: usize, arriving: &[(usize, Vector2)], tau: f64) -> Option<Vector2> {
        let (system, inverse) = (self.system(), self.axes[0].regime.inverse_mass[node]);
        let contact = self.axes[0].contact_at(tau);
        let friction = |j: usize| self.friction(j).1 * contact * system.blocks[j].mass * inverse;
        let mut force = self.node_force(node).0;
        for &j in system.on_node[node].iter().filter(|&&j| !self.is_stuck(j)) {
            let arrives = arriving.iter().any(|(block, _)| *block == j);
            let drive = times(-system.blocks[j].mass, self.drive(j));
            force = plus(force, if arrives { drive } else { self.force_on_node(j, tau) });
        }
        let without = times(inverse, force);
        let first = arriving.first()?.0;
        let drive = self.drive(first);
        if arriving.iter().any(|(j, _)| self.drive(*j) != drive) {
            // Each turns by itself, beside the others as they are.
            let now = arriving.iter().fold(without, |a, (j, d)| plus(a, times(friction(*j), *d)));
            let limit = arriving.iter().fold(now, |a, (j, d)| {
                let driven = plus(minus(self.drive(*j), now), times(friction(*j), *d));
                let stops = length(driven) < self.friction(*j).1 * contact + friction(*j);
                let turned = unit(driven).filter(|_| stops).map_or([0.0; 2], |to| minus(to, *d));
                plus(a, times(friction(*j), turned))
            });
            return Some(limit);
        }
        let size: f64 = arriving.iter().map(|(j, _)| friction(*j)).sum();
        let driven = minus(drive, without);
        let stops = length(driven) < self.friction(first).1 * contact + size;
        unit(driven).filter(|_| stops).map(|to| plus(without, times(size, to)))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Against the curve in many small steps, at angles all around and drives up to nine tenths of friction.
    #[test]
    fn a_last_way_is_a_pursuit_curve() {
        for step in 0..60 {
            let (angle, size) = (0.1 + 0.1 * f64::from(step), 0.9 * f64::from(step % 7) / 6.0);
            let (r, drive, friction) = ([0.7 * angle.cos(), 0.7 * angle.sin()], [2.0 * size, 0.0], 2.0);
            let way = LastWay::new(r, drive, friction).unwrap();
            let rate = |r: Vector2| minus(drive, times(friction, unit(r).unwrap()));
            let (mut v, mut time) = (r, 0.0);
            while length(v) > 1e-7 {
                let h = 2e-4 * length(v);
                let middle = plus(v, times(0.5 * h, rate(v)));
                (v, time) = (plus(v, times(h, rate(middle))), time + h);
            }
            assert!((way.time - time).abs() < 1e-6, "{step}: {} for {time}", way.time);
            let end = plus(r, times(way.time, minus(drive, times(friction, way.mean))));
            assert!(length(end) < 1e-15, "{step}: {end:?}");
        }
        assert!(LastWay::new([0.1, 0.0], [3.0, 0.0], 2.0).is_none());
    }
}
