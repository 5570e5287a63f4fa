//! Implicit steps of blocks whose direction is stiff (`numerics`, section 9.7).
//!
//! A direction follows what drives it within rho/(mu_k N m_j/m). Where that is far shorter than the time in which what
//! drives it changes, Taylor steps are as short, though the direction is smooth. There the directions at the Radau points of
//! Chebyshev polynomials are the unknowns: friction is the polynomial through them, all else follows from it by the same
//! series, and at each point the relative velocity must have the direction of its friction. The start of the step is no such
//! point: a block may begin to slide there beside one whose direction is stiff.

use std::sync::LazyLock;

use crate::general::plane::series::PlaneSeries;
use crate::general::plane::slide_series::{Beginning, ORDER, SlideSeries};
use crate::general::plane::state::PlaneState;
use crate::general::plane::stiff::MIDDLE;
use crate::general::plane::vector::{Vector2, across, dot, length, minus, plus, times, unit};

/// Points of a step. Twelve: at the length at which products of the series lose nothing above their highest degree, the
/// terms of the directions fall by 25 from one to the next.
const POINTS: usize = 12;

/// Most iterations.
const ITERATIONS: usize = 25;

/// Largest correction of an angle after which directions are known (rad), and the one below which corrections that do not
/// fall further are rounding.
const KNOWN: f64 = 8.0 * f64::EPSILON;
const ROUNDING: f64 = 1000.0 * f64::EPSILON;

/// What the last terms of a direction may be, which rounding reaches.
const LAST: f64 = 1e-13;
/// After so many iterations the terms in the middle are those of the solution, but for small corrections; where they are above
/// this, ten times what they must be below, further iterations are for nothing.
const SETTLED: usize = 2;
const TOO_ROUGH: f64 = 10.0 * MIDDLE;

/// How far relative velocities may be from the directions they begin with, as a part of the largest velocity so far: some
/// rounding of the fastest block, and less than what has come to rest.
const BEGINS_AS: f64 = 8.0 * f64::EPSILON;

/// The order from which the size of what relaxes in a direction is read, and its factorial.
const RELAXING: usize = 20;
const FACTORIAL: f64 = 2_432_902_008_176_640_000.0;

type AtPoints<T> = [T; POINTS];

/// The points, and polynomials through values at them.
struct Points {
    places: AtPoints<f64>,
    /// Coefficients of Chebyshev polynomials on [0, 1] by values: row by polynomial.
    coefficients: AtPoints<AtPoints<f64>>,
    /// Powers in each Chebyshev polynomial: whole numbers.
    powers: AtPoints<AtPoints<f64>>,
    /// Integrals from 0 to each point by values.
    integrals: AtPoints<AtPoints<f64>>,
}

impl Points {
    fn new() -> Self {
        let angle = |i: usize| 2.0 * std::f64::consts::PI * (POINTS - 1 - i) as f64 / (2 * POINTS - 1) as f64;
        let places: AtPoints<f64> = std::array::from_fn(|i| 0.5 * (1.0 + libm::cos(angle(i))));
        let mut powers = [[0.0; POINTS]; POINTS];
        powers[0][0] = 1.0;
        (powers[1][0], powers[1][1]) = (-1.0, 2.0);
        for m in 2..POINTS {
            for k in 0..=m {
                let risen = if k > 0 { 4.0 * powers[m - 1][k - 1] } else { 0.0 };
                powers[m][k] = risen - 2.0 * powers[m - 1][k] - powers[m - 2][k];
            }
        }
        let value = |m: usize, i: usize| libm::cos(m as f64 * angle(i));
        let values = nalgebra::DMatrix::from_fn(POINTS, POINTS, |i, m| value(m, i));
        let inverse = values.try_inverse().unwrap_or_else(|| nalgebra::DMatrix::zeros(POINTS, POINTS));
        let integral = |m: usize, s: f64| {
            powers[m].iter().enumerate().rev().fold(0.0, |sum, (k, power)| sum * s + power / (k + 1) as f64) * s
        };
        let of_polynomials: AtPoints<AtPoints<f64>> =
            std::array::from_fn(|i| std::array::from_fn(|m| integral(m, places[i])));
        Self {
            places,
            coefficients: std::array::from_fn(|m| std::array::from_fn(|i| inverse[(m, i)])),
            powers,
            integrals: std::array::from_fn(|i| {
                std::array::from_fn(|l| (0..POINTS).map(|m| of_polynomials[i][m] * inverse[(m, l)]).sum())
            }),
        }
    }

    /// Coefficients of Chebyshev polynomials through values.
    fn through(&self, values: &AtPoints<Vector2>) -> AtPoints<Vector2> {
        self.coefficients
            .each_ref()
            .map(|row| row.iter().zip(values).fold([0.0; 2], |sum, (factor, value)| plus(sum, times(*factor, *value))))
    }
}

static AT: LazyLock<Points> = LazyLock::new(Points::new);

impl PlaneSeries {
    /// Forms the series of a step of `h` with directions by collocation. Tells whether they are smooth enough, and the largest
    /// terms in the middle of directions.
    pub(super) fn collocate(&mut self, state: &PlaneState, tau: f64, h: f64) -> (bool, f64) {
        let mut directions: Vec<AtPoints<Vector2>> =
            self.slides.iter().map(|slide| [slide.direction[0]; POINTS]).collect();
        let beginnings: Vec<Beginning> = self.slides.iter().map(|slide| slide.beginning).collect();
        let mut before = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            let [middle, _] = self.form_through(state, (tau, h), &beginnings, &directions);
            if iteration >= SETTLED && middle > TOO_ROUGH {
                return (false, middle);
            }
            let Some(largest) = self.correct(state, tau, h, &mut directions) else { break };
            if largest <= KNOWN || largest <= ROUNDING && largest > 0.5 * before {
                let [middle, last] = self.form_through(state, (tau, h), &beginnings, &directions);
                return (middle <= MIDDLE && last <= LAST && self.begin_as(state), middle);
            }
            if largest > 4.0 * before {
                break;
            }
            before = largest;
        }
        (false, f64::INFINITY)
    }

    /// Forms the series with directions through these; returns the largest terms in the middle of directions, and at the end.
    fn form_through(
        &mut self,
        state: &PlaneState,
        (tau, h): (f64, f64),
        beginnings: &[Beginning],
        directions: &[AtPoints<Vector2>],
    ) -> [f64; 2] {
        self.begin(state);
        let (mut middle, mut last): (f64, f64) = (0.0, 0.0);
        for ((slide, beginning), directions) in self.slides.iter_mut().zip(beginnings).zip(directions) {
            // The first direction of a start is that of the polynomial, as all others are.
            (slide.beginning, slide.direction[0]) = (*beginning, [0.0; 2]);
            let terms = AT.through(directions);
            let largest = |range: std::ops::Range<usize>| range.fold(0.0, |sum: f64, m| sum.max(length(terms[m])));
            middle = middle.max(largest(POINTS / 2..POINTS / 2 + 2));
            last = last.max(largest(POINTS - 2..POINTS));
            for (term, powers) in terms.into_iter().zip(&AT.powers) {
                for (direction, power) in slide.direction.iter_mut().zip(powers) {
                    *direction = plus(*direction, times(*power, term));
                }
            }
        }
        let contact = [state.axes[0].contact_at(tau), state.axes[0].interval.contact_slope * h];
        self.terms.begin(state.axes.each_ref(), tau, h, ORDER);
        for k in 0..=ORDER {
            for i in 0..self.slides.len() {
                self.set_friction(state, i, k, contact);
            }
            self.terms.form_order(state.axes.each_ref(), k);
        }
        for i in 0..self.slides.len() {
            let power = self.slides[i].beginning.power();
            let terms: Vec<Vector2> = (0..=ORDER + 1 - power.max(1)).map(|k| self.term(i, k + power)).collect();
            self.slides[i].take_length(&terms);
        }
        [middle, last]
    }

    /// Whether directions have relaxed as far as [`Self::begin_as`] asks, by an explicit series: in the unit of time of the
    /// stiffest, what relaxes has terms of 1/k! of its size.
    pub(super) fn is_relaxed(&self, state: &PlaneState) -> bool {
        let relaxes = |slide: &SlideSeries| slide.length[0] * length(slide.direction[RELAXING]) * FACTORIAL;
        let mut moving = self.slides.iter().filter(|slide| !slide.beginning.is_implicit());
        moving.all(|slide| relaxes(slide) <= BEGINS_AS * state.fastest)
    }

    /// Whether the directions begin as the relative velocities do, but for what does not show in them.
    fn begin_as(&self, state: &PlaneState) -> bool {
        self.slides.iter().all(|slide| {
            let velocity = state.velocity(slide.block);
            let apart = minus(velocity, times(length(velocity), slide.direction[0]));
            length(apart) <= BEGINS_AS * state.fastest
        })
    }

    /// Corrects the directions by one step of Newton's method, in which blocks of a node act on each other at once, and by
    /// springs not at all; returns the largest angle.
    fn correct(&self, state: &PlaneState, tau: f64, h: f64, directions: &mut [AtPoints<Vector2>]) -> Option<f64> {
        let (system, inverse_mass) = (state.system(), &state.axes[0].regime.inverse_mass);
        let contact = AT.places.map(|s| state.axes[0].contact_at(tau + s * h));
        let node = |i: usize| system.blocks[self.slides[i].block].floor;
        let mut largest: f64 = 0.0;
        for first in 0..self.slides.len() {
            if (0..first).any(|i| node(i) == node(first)) {
                continue;
            }
            let group: Vec<usize> = (first..self.slides.len()).filter(|&i| node(i) == node(first)).collect();
            let size = POINTS * group.len();
            let mut matrix = nalgebra::DMatrix::<f64>::zeros(size, size);
            let mut right = nalgebra::DVector::<f64>::zeros(size);
            for (row, &i) in group.iter().enumerate() {
                for (point, &s) in AT.places.iter().enumerate() {
                    let (at, d) = (row * POINTS + point, directions[i][point]);
                    let r = self.terms.velocity_at(self.slides[i].position, s);
                    right[at] = dot(across(d), r);
                    matrix[(at, at)] += dot(d, r);
                    for (column, &j) in group.iter().enumerate() {
                        let block = state.system().blocks[self.slides[j].block].mass * inverse_mass[node(i)];
                        let factor = h * state.friction(self.slides[j].block).1 * (block + f64::from(i == j));
                        for (l, other) in directions[j].iter().enumerate() {
                            matrix[(at, column * POINTS + l)] +=
                                factor * contact[l] * AT.integrals[point][l] * dot(d, *other);
                        }
                    }
                }
            }
            let angles = matrix.lu().solve(&right)?;
            for (row, &i) in group.iter().enumerate() {
                for (point, d) in directions[i].iter_mut().enumerate() {
                    let angle = angles[row * POINTS + point];
                    largest = largest.max(angle.abs());
                    *d = unit(plus(*d, times(angle.clamp(-0.5, 0.5), across(*d))))?;
                }
            }
        }
        largest.is_finite().then_some(largest)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::general::system::System;
    use crate::lanes::Plain;
    use crate::scene::{
        Block, Damping, GeneralBuilding, GeneralScene, GravityEffect, Motion, PlaneMotion, PlaneScene, Storey,
    };
    use crate::state::interval::interval;

    /// On a step of the explicit series the implicit one is the same: two blocks on a light floor, one on the other, with
    /// vertical motion.
    #[test]
    fn an_implicit_step_is_the_explicit_one() {
        let storeys = vec![Storey::elastic(1e5); 2];
        let damping = Damping::Modal { ratio: 0.05 };
        let building = GeneralBuilding::new(vec![200.0, 400.0], storeys, None, &damping, GravityEffect::None).unwrap();
        let building = Arc::new(building);
        let of = |velocities: [f64; 3]| {
            let goods = [(1, 1500.0, 0.2), (1, 300.0, 0.3), (2, 500.0, 0.25)].into_iter().zip(velocities);
            let goods = goods.map(|((floor, mass, mu), velocity)| {
                Block { velocity: Some(velocity), ..Block::new(floor, mass, mu) }.into()
            });
            GeneralScene::new(Some(building.clone()), goods.collect(), Vec::new()).unwrap()
        };
        let scene = PlaneScene::new(of([0.3, -0.4, 0.5]), of([0.1, 0.2, -0.1])).unwrap();
        let x = Motion::new(vec![1.0, 2.0], 0.01, Some(vec![0.5, -0.8].into())).unwrap();
        let motion = PlaneMotion::new(x, vec![-0.5, 0.7]).unwrap();
        let ([x, y], [of_x, of_y]) = (scene.directions(), motion.directions());
        let systems = [System::new(x, of_x).unwrap(), System::new(y, of_y).unwrap()];
        let mut state = PlaneState::new(&scene, systems.each_ref(), true);
        for (axis, motion) in state.axes.iter_mut().zip([of_x, of_y]) {
            axis.interval = interval(motion, motion.vertical(), 0);
        }
        state.follow();
        let mut series = PlaneSeries::default();
        assert_eq!(series.form(&state, 0.0, 0.01, true), None);
        let places = [0.1, 0.35, 0.6, 1.0];
        let velocities = |series: &PlaneSeries| -> Vec<f64> {
            let of = |a: usize, i: usize| series.axes[a].velocity_of(series.slides[i].position);
            let of_slide = |i: usize| places.map(|s| [0, 1].map(|a| of(a, i).at::<Plain>(s))).concat();
            (0..3)
                .flat_map(of_slide)
                .chain((0..3).flat_map(|i| places.map(|s| series.speed_of(i).at::<Plain>(s))))
                .collect()
        };
        let (explicit, h) = (velocities(&series), series.h());
        assert!(series.collocate(&state, 0.0, h).0, "the step of {h} s is smooth");
        series.close(1.0, ORDER, h);
        for (found, expected) in velocities(&series).into_iter().zip(explicit) {
            assert!((found - expected).abs() < 8.0 * f64::EPSILON, "{found} for {expected}");
        }
    }
}
