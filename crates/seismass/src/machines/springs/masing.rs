//! Elastic-perfectly-plastic elements in parallel with a linear one (Iwan 1966): a concave piecewise-linear backbone with
//! Masing unloading, of which the trilinear one is the paper's (Fig. 3; `numerics`, section 3).

use std::sync::Arc;

use crate::machines::segment::{Backbone, Crossing, Segment, SpringMachine};
use crate::machines::sign::Sign;
use crate::response::EventKind;
use crate::scene::Storey;
use crate::tolerances::SAME_SLOPE;

/// An elastic-perfectly-plastic element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Element {
    pub(crate) stiffness: f64,
    pub(crate) yield_force: f64,
}

/// The elements, in the order in which they yield, their forces at the base, and how many are plastic.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Masing {
    elements: Arc<[Element]>,
    /// Stiffness of the linear element.
    linear: f64,
    base_drift: f64,
    forces: Vec<f64>,
    yielded: usize,
    /// Sign of the plastic forces.
    sign: Sign,
}

impl Masing {
    /// The trilinear spring of a storey; elements without stiffness, and those that never yield, do not exist.
    pub(crate) fn trilinear(storey: &Storey) -> Self {
        let &Storey { stiffness: k, yield_shear: vy, overstrength, second_slope: r2, third_slope: r3, .. } = storey;
        if !vy.is_finite() {
            return Self::new(&[], k);
        }
        let first = vy / k;
        if overstrength == 1.0 {
            return Self::new(&[((1.0 - r3) * k, first)], r3 * k);
        }
        let second = if r2 > 0.0 { first + (overstrength - 1.0) * vy / (r2 * k) } else { f64::INFINITY };
        let stiffness_of_second = if r2 > 0.0 { (r2 - r3) * k } else { 0.0 };
        Self::new(&[((1.0 - r2) * k, first), (stiffness_of_second, second)], r3 * k)
    }

    /// The spring whose backbone goes through points of drift and force.
    pub(crate) fn multilinear(points: &[[f64; 2]]) -> Self {
        let before = std::iter::once(&[0.0; 2]).chain(points);
        let slopes: Vec<f64> = before.zip(points).map(|(a, b)| (b[1] - a[1]) / (b[0] - a[0])).collect();
        let falls = slopes.windows(2).zip(points).map(|(pair, point)| {
            let fall = pair[0] - pair[1];
            (if fall > SAME_SLOPE * pair[0] { fall } else { 0.0 }, point[0])
        });
        Self::new(&falls.collect::<Vec<_>>(), slopes.last().copied().unwrap_or(0.0))
    }

    /// Elements of stiffness and yield drift beside a linear one.
    fn new(elements: &[(f64, f64)], linear: f64) -> Self {
        let element = |&(stiffness, drift): &(f64, f64)| {
            (stiffness > 0.0).then_some(Element { stiffness, yield_force: stiffness * drift })
        };
        let elements: Arc<[Element]> = elements.iter().filter_map(element).collect();
        let forces = vec![0.0; elements.len()];
        Self { elements, linear, base_drift: 0.0, forces, yielded: 0, sign: Sign::Positive }
    }

    /// The elements that exist, in the order in which they yield.
    pub(crate) fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// Force of element `e` at coordinate `x`.
    #[inline]
    fn force(&self, e: usize, x: f64) -> f64 {
        let (force, Element { stiffness, yield_force: limit }) = (self.forces[e], self.elements[e]);
        if e >= self.yielded { (force + stiffness * x).clamp(-limit, limit) } else { force }
    }

    /// Drift at the base.
    pub(crate) fn base_drift(&self) -> f64 {
        self.base_drift
    }

    /// The base moves to coordinate `x`.
    fn rebase(&mut self, x: f64) {
        for e in self.yielded..self.elements.len() {
            self.forces[e] = self.force(e, x);
        }
        self.base_drift += x;
    }

    /// The base moves to coordinate `x`, where the drift is known.
    pub(crate) fn rebase_to(&mut self, x: f64, drift: f64) {
        self.rebase(x);
        self.base_drift = drift;
    }

    /// Tangent with so many plastic elements.
    fn tangent(&self, yielded: usize) -> f64 {
        self.elements[yielded..].iter().map(|e| e.stiffness).sum::<f64>() + self.linear
    }

    /// Coordinates at which the next element yields.
    fn ends(&self) -> (f64, f64) {
        let Some(element) = self.elements.get(self.yielded) else { return (f64::NEG_INFINITY, f64::INFINITY) };
        let force = self.forces[self.yielded];
        let upper = (element.yield_force - force) / element.stiffness;
        let lower = (-element.yield_force - force) / element.stiffness;
        match (self.yielded, self.sign) {
            (0, _) => (lower, upper),
            (_, Sign::Positive) => (f64::NEG_INFINITY, upper),
            (_, Sign::Negative) => (lower, f64::INFINITY),
        }
    }
}

impl SpringMachine for Masing {
    fn segment(&self) -> Segment {
        let next = self.elements.get(self.yielded);
        Segment {
            base_drift: self.base_drift,
            base_force: self.forces.iter().sum::<f64>() + self.linear * self.base_drift,
            tangent: self.tangent(self.yielded),
            ends: self.ends(),
            range: next.map_or(0.0, |e| e.yield_force / e.stiffness),
            rate_sign: (self.yielded > 0).then_some(self.sign),
            class: self.yielded as u8,
        }
    }

    fn end(&mut self, x: f64, sign: Sign) -> Crossing {
        self.rebase(x);
        if let Some(element) = self.elements.get(self.yielded) {
            self.forces[self.yielded] = sign.factor() * element.yield_force;
            self.yielded += 1;
        }
        self.sign = sign;
        Crossing::of_yield(sign, self.yielded)
    }

    /// All plastic elements become elastic.
    fn turn(&mut self, x: f64) -> Crossing {
        self.rebase(x);
        self.yielded = 0;
        Crossing::new(EventKind::Unload, self.sign)
    }

    fn stored(&self, x: f64, geometric: f64) -> f64 {
        let drift = self.base_drift + x;
        let of_element = |(e, element): (usize, &Element)| 0.5 * self.force(e, x).powi(2) / element.stiffness;
        let stored: f64 = self.elements.iter().enumerate().map(of_element).sum();
        stored + 0.5 * (self.linear - geometric) * drift * drift
    }

    /// The plastic forces are constant.
    fn dissipated(&self, _: f64, change: f64) -> f64 {
        self.forces[..self.yielded].iter().sum::<f64>() * change
    }

    fn state_name(&self) -> &'static str {
        match self.yielded {
            0 => "elastic",
            1 => "first yield",
            2 => "second yield",
            _ => "yielding",
        }
    }

    fn backbone(&self) -> Backbone {
        let breaks = self.elements.iter().map(|e| (e.yield_force / e.stiffness, e.stiffness)).collect();
        Backbone { breaks, last_slope: self.linear }
    }

    fn tangents(&self) -> Option<Vec<f64>> {
        Some((0..=self.elements.len()).map(|yielded| self.tangent(yielded)).collect())
    }

    fn largest_tangent(&self) -> f64 {
        self.tangent(0)
    }

    fn can_yield(&self) -> bool {
        !self.elements.is_empty()
    }

    fn parameters(&self) -> Vec<f64> {
        self.elements.iter().flat_map(|e| [e.stiffness, e.yield_force]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spring(overstrength: f64, r2: f64, r3: f64) -> Masing {
        let storey = Storey { overstrength, second_slope: r2, third_slope: r3, ..Storey::yielding(100.0, 10.0) };
        Masing::trilinear(&storey)
    }

    #[test]
    fn special_cases_have_the_elements_of_the_specification() {
        assert_eq!(spring(1.0, 0.5, 0.1).elements().len(), 1);
        assert_eq!(spring(2.0, 0.0, 0.0).elements().len(), 1);
        assert_eq!(spring(2.0, 0.3, 0.3).elements().len(), 1);
        let single = spring(2.0, 1.0, 0.0);
        assert_eq!(single.elements().len(), 1);
        assert!((single.elements()[0].yield_force - 20.0).abs() < 1e-12);
        assert!(!Masing::trilinear(&Storey::elastic(5.0)).can_yield());
    }

    /// A line through three points has no element; the trilinear backbone as points has the elements of the trilinear law.
    #[test]
    fn points_give_the_elements_of_their_slopes() {
        assert!(Masing::multilinear(&[[0.1, 10.0], [0.2, 20.0], [0.3, 30.0]]).elements().is_empty());
        let of_points = Masing::multilinear(&[[0.1, 10.0], [1.1, 20.0], [2.1, 22.0]]);
        for (one, other) in of_points.elements().iter().zip(spring(2.0, 0.1, 0.02).elements()) {
            assert!((one.stiffness - other.stiffness).abs() < 1e-12 * other.stiffness);
            assert!((one.yield_force - other.yield_force).abs() < 1e-12 * other.yield_force);
        }
        assert_eq!(of_points.elements().len(), 2);
    }
}
