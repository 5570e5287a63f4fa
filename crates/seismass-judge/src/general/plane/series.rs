//! The Taylor series of both directions over a stretch of time, with friction along the relative velocity.
//!
//! The relative velocity of a block that slides is r = t^p rho d over a stretch, with |d| = 1: p = 0 while it slides, 1 where
//! it begins to with a jump of its relative acceleration, 2 where that begins at zero. All is expressed in the frame of the
//! first direction d_0: along it |d| = 1 gives the coefficients of d, across it they follow from those of r. Where p is not
//! zero the coefficients of d across are unknowns of the node's equation of motion, one per block that begins to slide.

use super::state::Plane;
use crate::general::model::Model;
use crate::general::series::{MAX_PHASE, Series, place};
use crate::general::state::State;
use crate::model::Terms;
use crate::polynomial::{Polynomial, term};
use crate::real::Real;
use crate::series::orders;
use crate::state::Contact;

/// A relative acceleration at the start of sliding below this, in units of the number type's epsilon times its terms and of
/// the masses' ratio, is zero.
const AT_REST: f64 = 1000.0;
/// The last terms of a series are at most this part of its rounding.
const LAST_TERMS: f64 = 0.1;
/// A series that reaches over less than this part of its stretch is made again over a shorter one.
const WELL_WITHIN: f64 = 0.2;
/// No stretch is made shorter than by this factor at once.
const SHORTEST: f64 = 1e-5;
/// How often a stretch is made shorter.
const MAX_TRIALS: usize = 60;
/// A relative velocity may fall to this part of what it was over a stretch: its size is not analytic beyond zero.
const LEAST_SPEED: f64 = 0.25;

/// A block that slides with friction: coefficients along and across the first direction.
pub(super) struct Sliding<R> {
    pub(super) power: usize,
    /// d_0.
    head: [R; 2],
    /// rho.
    pub(super) speed: Vec<R>,
    /// d.
    direction: [Vec<R>; 2],
}

impl<R: Real> Sliding<R> {
    fn along(&self, [x, y]: [R; 2]) -> [R; 2] {
        let [c, s] = self.head;
        [c * x + s * y, c * y - s * x]
    }

    fn back(&self, [along, across]: [R; 2]) -> [R; 2] {
        let [c, s] = self.head;
        [c * along - s * across, s * along + c * across]
    }

    /// Coefficient of d along d_0 from those of lower order: |d| = 1.
    fn next_along(&self) -> R {
        let [along, across] = &self.direction;
        let order = along.len();
        let sum =
            (1..order).fold(R::zero(), |sum, i| sum + along[i] * along[order - i] + across[i] * across[order - i]);
        R::of(-0.5) * sum
    }

    /// Sum of rho_i times the coefficient of d of order k - i, for i from `first` to k - 1: along (0) or across (1).
    fn mixed(&self, which: usize, order: usize, first: usize) -> R {
        (first..order).fold(R::zero(), |sum, i| sum + self.speed[i] * self.direction[which][order - i])
    }

    /// Takes in a coefficient of r / t^p, and with it one of rho.
    fn take_velocity(&mut self, value: [R; 2]) {
        self.speed.push(self.along(value)[0] - self.mixed(0, self.speed.len(), 0));
    }

    /// |r| over the stretch.
    pub(super) fn speed(&self) -> Polynomial<R> {
        Polynomial(vec![R::zero(); self.power].into_iter().chain(self.speed.iter().copied()).collect())
    }

    /// The part of the stretch over which the last terms are below rounding.
    fn reach(&self) -> f64 {
        let mut reach = 1.0f64;
        let [along, across] = &self.direction;
        for (list, scale) in [(along, R::of(1.0)), (across, R::of(1.0)), (&self.speed, self.speed[0])] {
            for (order, last) in list.iter().enumerate().skip(list.len().saturating_sub(2).max(1)) {
                let ratio = (*last / scale).to_f64().abs();
                if !ratio.is_finite() {
                    return 0.0;
                }
                reach = reach.min((LAST_TERMS * R::EPSILON / ratio).powf(1.0 / order as f64));
            }
        }
        reach
    }
}

/// The solution over a stretch, in both directions.
pub(super) struct PlaneSeries<R> {
    pub(super) directions: [Series<R>; 2],
    /// None: stuck, airborne, or without friction.
    pub(super) sliding: Vec<Option<Sliding<R>>>,
}

impl<R: Real> PlaneSeries<R> {
    /// The solution from the state at `tau` over `length`, or over as much of it as the series reaches; none where a block
    /// that begins to slide does not leave its limit.
    pub(super) fn new(plane: &Plane<R>, tau: R, length: R) -> Option<Self> {
        let mut length = length;
        for j in 0..plane.heads.len() {
            if let (true, Some(time)) = (plane.has_friction(j), plane.time_to_rest(j, tau)) {
                length = if time < length { time } else { length };
            }
        }
        for _ in 0..MAX_TRIALS {
            let mut series = Self::build(plane, tau, length);
            let sliding = || series.sliding.iter().flatten();
            let reach = sliding().fold(1.0f64, |reach, block| reach.min(block.reach()));
            if sliding().any(|block| block.power > 0 && block.speed[0] <= R::zero() && reach > 0.0) {
                return None;
            }
            if reach < WELL_WITHIN {
                length = length * R::of(reach.max(SHORTEST));
                continue;
            }
            if reach < 1.0 {
                series.shrink(R::of(reach));
            }
            series.keep_speeds();
            return Some(series);
        }
        None
    }

    fn build(plane: &Plane<R>, tau: R, length: R) -> Self {
        let of = |a: usize| (&plane.directions[a].model, &plane.directions[a].state);
        let directions = [0, 1].map(|a| {
            let (model, state) = of(a);
            Series::at_start(model, state, &plane.directions[a].drive, tau, length)
        });
        let sliding = (0..plane.heads.len()).map(|j| plane.has_friction(j).then(|| first_of(plane, j))).collect();
        let mut series = Self { directions, sliding };
        let mass = of(0).1.mass_with_stuck(of(0).0);
        for order in 0..orders::<R>(MAX_PHASE) {
            series.take_order(plane, tau, order, &mass);
        }
        series
    }

    fn take_order(&mut self, plane: &Plane<R>, tau: R, order: usize, mass: &[R]) {
        let of = |a: usize| (&plane.directions[a].model, &plane.directions[a].state);
        let goods = &of(0).0.goods;
        let mut forces = [0, 1].map(|a| self.directions[a].forces(of(a).0, of(a).1, order));
        let length = self.directions[0].length;
        let contact = [term(&self.directions[0].contact, 0), term(&self.directions[0].contact, 1)];
        for j in 0..goods.len() {
            let velocity = [0, 1].map(|a| term(&self.directions[a].velocity[j], order));
            let Some(block) = &mut self.sliding[j] else { continue };
            if order == 0 {
                continue;
            }
            let along = block.next_along();
            block.direction[0].push(along);
            let [_, of_velocity] = block.along(velocity);
            // Of what begins to slide it is not known yet.
            let across = match block.power {
                0 => (of_velocity - block.mixed(1, order, 1)) / block.speed[0],
                _ => R::zero(),
            };
            block.direction[1].push(across);
            if block.power == 0 {
                block.take_velocity(velocity);
            }
        }
        let mut friction = vec![[R::zero(); 2]; goods.len()];
        for (j, data) in goods.iter().enumerate() {
            let Some(block) = &self.sliding[j] else { continue };
            let coefficient = of(0).1.blocks[j].mu_k * data.mass;
            let before = |which: usize| if order > 0 { block.direction[which][order - 1] } else { R::zero() };
            let value = [0, 1].map(|w| coefficient * (contact[0] * block.direction[w][order] + contact[1] * before(w)));
            friction[j] = block.back(value);
        }
        // Accelerations of the nodes, the ground first.
        let mut acceleration = [0, 1].map(|a| {
            let mut values = vec![term(&self.directions[a].ground, order)];
            values.extend(forces[a].0.iter().zip(mass).map(|(&force, &mass)| force / mass));
            values
        });
        for (j, data) in goods.iter().enumerate() {
            if let Some(node) = data.node {
                for a in 0..2 {
                    acceleration[a][node + 1] = acceleration[a][node + 1] + friction[j][a] / mass[node];
                }
            }
        }
        if order > 0 {
            for node in std::iter::once(None).chain((0..mass.len()).map(Some)) {
                self.starts(plane, order, node, mass, &mut friction, &forces, &mut acceleration);
            }
        }
        for a in 0..2 {
            for j in 0..goods.len() {
                if of(a).1.blocks[j].contact != Contact::Stuck {
                    forces[a].1[j] = forces[a].1[j] - friction[j][a];
                    if let Contact::Sliding(_) = of(a).1.blocks[j].contact {
                        self.directions[a].friction[j].0.push(friction[j][a]);
                    }
                }
            }
            self.directions[a].extend(of(a).0, of(a).1, order, &acceleration[a][1..], &forces[a].1);
        }
        for j in 0..goods.len() {
            let next = [0, 1].map(|a| term(&self.directions[a].velocity[j], order + 1));
            let rest = plane.rest(j, tau) * length;
            let Some(block) = &mut self.sliding[j] else { continue };
            match block.power {
                0 => {}
                _ if order == 0 && block.along(next)[0] <= R::of(AT_REST) * R::epsilon() * rest => {
                    block.power = 2;
                    for series in &mut self.directions {
                        series.velocity[j].0[1] = R::zero();
                        series.slip[j].0[2] = R::zero();
                    }
                }
                1 => block.take_velocity(next),
                _ if order > 0 => block.take_velocity(next),
                _ => {}
            }
        }
    }

    /// The coefficients across of the blocks that begin to slide on a node: a linear system, as each moves the node.
    #[allow(clippy::too_many_arguments)]
    fn starts(
        &mut self,
        plane: &Plane<R>,
        order: usize,
        node: Option<usize>,
        mass: &[R],
        friction: &mut [[R; 2]],
        forces: &[(Vec<R>, Vec<R>); 2],
        acceleration: &mut [Vec<R>; 2],
    ) {
        let (model, state) = (&plane.directions[0].model, &plane.directions[0].state);
        let begins = |j: usize| model.goods[j].node == node && self.sliding[j].as_ref().is_some_and(|b| b.power > 0);
        let blocks: Vec<(usize, &Sliding<R>)> = (0..model.goods.len())
            .filter(|&j| begins(j))
            .filter_map(|j| Some((j, self.sliding[j].as_ref()?)))
            .collect();
        if blocks.is_empty() {
            return;
        }
        let (length, contact) = (self.directions[0].length, term(&self.directions[0].contact, 0));
        let per_order = R::of((order + 1) as f64) / length;
        let normal = |block: &Sliding<R>| block.back([R::zero(), R::of(1.0)]);
        let dot = |a: [R; 2], b: [R; 2]| a[0] * b[0] + a[1] * b[1];
        let mut rows: Vec<Vec<R>> = Vec::new();
        for &(j, block) in &blocks {
            let known =
                [0, 1].map(|a| (forces[a].1[j] - friction[j][a]) / model.goods[j].mass - acceleration[a][place(node)]);
            let (own, sum) = match block.power {
                1 => (block.speed[0] * per_order, block.mixed(1, order, 1)),
                _ => (R::zero(), block.mixed(1, order - 1, 0)),
            };
            let mut row: Vec<R> = blocks
                .iter()
                .map(|&(i, other)| {
                    let moved = node
                        .map_or(R::zero(), |node| state.blocks[i].mu_k * model.goods[i].mass * contact / mass[node]);
                    let coupled = moved * dot(normal(block), normal(other));
                    if i == j { own + state.blocks[j].mu_k * contact + coupled } else { coupled }
                })
                .collect();
            row.push(dot(normal(block), known) - sum * per_order);
            rows.push(row);
        }
        let turns = solved(rows);
        let blocks: Vec<usize> = blocks.into_iter().map(|(j, _)| j).collect();
        for (j, turn) in blocks.into_iter().zip(turns) {
            let Some(block) = &mut self.sliding[j] else { continue };
            block.direction[1][order] = turn;
            let force = block.back([R::zero(), state.blocks[j].mu_k * model.goods[j].mass * contact * turn]);
            for a in 0..2 {
                friction[j][a] = friction[j][a] + force[a];
                if let Some(node) = node {
                    acceleration[a][node + 1] = acceleration[a][node + 1] + force[a] / mass[node];
                }
            }
        }
    }

    /// Ends the stretch where a relative velocity, over the power of time it begins with, has become much smaller: on a
    /// straight line it may come to rest within a stretch, also within the one in which it starts.
    fn keep_speeds(&mut self) {
        let mut first: Option<R> = None;
        for block in self.sliding.iter().flatten() {
            let least = block.speed[0] * R::of(LEAST_SPEED);
            let left = Polynomial(block.speed.clone()).plus(&Polynomial::constant(-least));
            if let Some(place) = left.first_fall(R::of(0.5) * least) {
                first = Some(first.map_or(place, |other| if place < other { place } else { other }));
            }
        }
        if let Some(place) = first {
            self.shrink(place);
        }
    }

    /// Restricts the stretch to its first part, of this fraction.
    pub(super) fn shrink(&mut self, place: R) {
        self.directions.iter_mut().for_each(|series| series.shrink(place));
        for block in self.sliding.iter_mut().flatten() {
            let mut factor = (0..block.power).fold(R::of(1.0), |power, _| power * place);
            for value in &mut block.speed {
                *value = *value * factor;
                factor = factor * place;
            }
        }
    }

    pub(super) fn length(&self) -> R {
        self.directions[0].length
    }

    /// Change of the path of a block that slides with friction, over the stretch.
    pub(super) fn slipped(&self, block: usize) -> Option<Polynomial<R>> {
        let mut path = Polynomial::constant(R::zero());
        crate::series::integrate(&self.sliding[block].as_ref()?.speed(), R::of(1.0), self.length(), &mut path);
        Some(path)
    }
}

/// What is known of a block at the start of a stretch.
fn first_of<R: Real>(plane: &Plane<R>, j: usize) -> Sliding<R> {
    let velocity = plane.velocity(j);
    let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
    let direction = [vec![R::of(1.0)], vec![R::zero()]];
    if speed == R::zero() {
        return Sliding { power: 1, head: plane.heads[j], speed: Vec::new(), direction };
    }
    let head = velocity.map(|v| v / speed);
    Sliding { power: 0, head, speed: vec![speed], direction }
}

impl<R: Real> Plane<R> {
    /// Size of the terms of a block's relative acceleration, as its rounding counts.
    fn rest(&self, j: usize, tau: R) -> R {
        let direction = &self.directions[0];
        let data = &direction.model.goods[j];
        let mut size = direction.state.blocks[j].mu_k * direction.drive.contact_at(tau).abs();
        for a in 0..2 {
            let (model, state, drive) =
                (&self.directions[a].model, &self.directions[a].state, &self.directions[a].drive);
            size = size + state.acceleration(model, data.node, drive, tau, Terms::Sizes);
            size = size + state.push(model, j).abs() / data.mass;
        }
        size * heavier(&direction.model, data.node)
    }

    /// How long friction takes to stop a block that slides; none where it has no relative velocity.
    fn time_to_rest(&self, j: usize, tau: R) -> Option<R> {
        let velocity = self.velocity(j);
        let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
        let (model, state): (&Model<R>, &State<R>) = (&self.directions[0].model, &self.directions[0].state);
        let data = &model.goods[j];
        let ratio = data.node.map_or(R::zero(), |node| data.mass / state.mass_with_stuck(model)[node]);
        let limit = state.blocks[j].mu_k * self.directions[0].drive.contact_at(tau).abs() * (R::of(1.0) + ratio);
        (speed > R::zero() && limit > R::zero()).then(|| speed / limit)
    }
}

/// How much heavier a node is with all of its goods.
pub(super) fn heavier<R: Real>(model: &Model<R>, node: Option<usize>) -> R {
    node.map_or(R::of(1.0), |p| {
        let on_node = model.goods.iter().filter(|data| data.node == node);
        on_node.fold(model.mass[p], |sum, data| sum + data.mass) / model.mass[p]
    })
}

/// Solves a linear system whose rows end with their right-hand sides.
fn solved<R: Real>(mut rows: Vec<Vec<R>>) -> Vec<R> {
    let n = rows.len();
    for k in 0..n {
        let largest = (k..n).fold(k, |best, i| if rows[i][k].abs() > rows[best][k].abs() { i } else { best });
        rows.swap(k, largest);
        for i in k + 1..n {
            let factor = rows[i][k] / rows[k][k];
            for c in k..=n {
                rows[i][c] = rows[i][c] - factor * rows[k][c];
            }
        }
    }
    let mut values = vec![R::zero(); n];
    for k in (0..n).rev() {
        let rest = (k + 1..n).fold(rows[k][n], |rest, c| rest - rows[k][c] * values[c]);
        values[k] = rest / rows[k][k];
    }
    values
}
