//! Elastic-perfectly-plastic elements in parallel with a linear spring: Masing unloading (`numerics`, section 3).

use seismass::EventKind;

use crate::real::Real;
use crate::sign::Sign;
use crate::springs::contract::{Course, Crossing, Limit, Part, Slope, Spring, SpringGuard};

/// An elastic-perfectly-plastic element.
#[derive(Debug, Clone, Copy)]
struct Element<R> {
    stiffness: R,
    yield_drift: R,
    yield_force: R,
    /// While plastic it is exact.
    force: R,
    /// Sign of the yield force while plastic.
    plastic: Option<Sign>,
}

/// Elements in the order in which they yield, beside a linear spring.
#[derive(Debug, Clone)]
pub(super) struct Masing<R> {
    elements: Vec<Element<R>>,
    linear: R,
    dissipated: R,
}

impl<R: Real> Masing<R> {
    /// A virgin spring of elements with this stiffness and yield drift, by yield drift.
    pub(super) fn new(elements: impl IntoIterator<Item = (R, R)>, linear: R) -> Self {
        let element = |(stiffness, yield_drift): (R, R)| Element {
            stiffness,
            yield_drift,
            yield_force: stiffness * yield_drift,
            force: R::zero(),
            plastic: None,
        };
        Self { elements: elements.into_iter().map(element).collect(), linear, dissipated: R::zero() }
    }
}

impl<R: Real + 'static> Spring<R> for Masing<R> {
    fn copied(&self) -> Box<dyn Spring<R>> {
        Box::new(self.clone())
    }

    fn start(&mut self, drift: R) {
        self.elements.iter_mut().for_each(|e| e.force = e.stiffness * drift);
    }

    fn parts(&self) -> Vec<Part<R>> {
        let tangent = |e: &Element<R>| if e.plastic.is_some() { R::zero() } else { e.stiffness };
        self.elements.iter().map(|e| Part { force: e.force, tangent: tangent(e) }).collect()
    }

    fn linear(&self) -> R {
        self.linear
    }

    fn largest_stiffness(&self) -> R {
        self.elements.iter().fold(self.linear, |k, e| k + e.stiffness)
    }

    fn backbone(&self) -> Vec<Slope<R>> {
        let mut from = R::zero();
        let mut slopes = Vec::new();
        for yielded in 0..=self.elements.len() {
            let slope = self.elements[yielded..].iter().fold(self.linear, |k, e| k + e.stiffness);
            slopes.push(Slope { from, slope });
            from = self.elements.get(yielded).map_or(from, |e| e.yield_drift);
        }
        slopes
    }

    fn limits(&self, course: &Course<R>, rate_size: R) -> Vec<Limit<R>> {
        let mut limits = Vec::new();
        for (index, (element, force)) in self.elements.iter().zip(course.forces).enumerate() {
            match element.plastic {
                None => {
                    for sign in [Sign::Positive, Sign::Negative] {
                        let guard = SpringGuard::Yield { element: index, sign };
                        limits.push(Limit::below(guard, element.yield_force, sign, force));
                    }
                }
                Some(sign) => limits.push(Limit::no_turn(sign, course.rate, rate_size)),
            }
        }
        limits
    }

    fn advance(&mut self, course: &Course<R>) {
        for (element, force) in self.elements.iter_mut().zip(course.forces) {
            if element.plastic.is_some() {
                self.dissipated = self.dissipated + element.force * course.advance();
            }
            element.force = force.end();
        }
    }

    fn cross(&mut self, guard: SpringGuard, _drift: R) -> Vec<Crossing> {
        match guard {
            SpringGuard::Yield { element, sign } => {
                let yields = &mut self.elements[element];
                yields.force = sign.times(yields.yield_force);
                yields.plastic = Some(sign);
                vec![Crossing::new(EventKind::Yield, sign, element + 1)]
            }
            SpringGuard::Turn(sign) => {
                self.elements.iter_mut().for_each(|e| e.plastic = None);
                vec![Crossing::new(EventKind::Unload, sign, 0)]
            }
            _ => Vec::new(),
        }
    }

    fn stored(&self, drift: R) -> R {
        let linear = self.linear * drift * drift;
        R::of(0.5) * self.elements.iter().fold(linear, |twice, e| twice + e.force * e.force / e.stiffness)
    }

    fn dissipated(&self) -> R {
        self.dissipated
    }

    fn scale(&mut self, factor: &mut dyn FnMut() -> R) {
        for element in self.elements.iter_mut().filter(|e| e.plastic.is_none()) {
            element.force = element.force * factor();
        }
    }
}

#[cfg(test)]
mod tests {
    use seismass::{EventKind, Storey};

    use super::*;
    use crate::real::DoubleDouble;
    use crate::springs::loops::Loop;

    /// k = 100 N/m, V_y = 10 N, Omega = 1.5, r2 = 0.5, r3 = 0.1: elements of 50 and 40 N/m yield at 0.1 and 0.2 m, beside
    /// 10 N/m. From 0.3 m, 5 + 8 + 3 = 16 N, unloading has the backbone at twice its size: 2 x 10 N less after 0.2 m, to
    /// -4 N; 2 x 15 N less after 0.4 m, to -14 N; and -15 N at -0.2 m, which is the backbone's force there.
    fn masing_loop<R: Real>() {
        let storey = Storey { overstrength: 1.5, second_slope: 0.5, third_slope: 0.1, ..Storey::yielding(100.0, 10.0) };
        let mut spring = Loop::<R>::new(&storey);
        spring.follow(&[[0.1, 10.0], [0.2, 15.0], [0.3, 16.0], [0.1, -4.0], [-0.1, -14.0], [-0.2, -15.0], [0.3, 16.0]]);
        let (yields, unloads) = (EventKind::Yield, EventKind::Unload);
        spring.logged(&[
            (yields, 1, 1, 0.1, 10.0),
            (yields, 1, 2, 0.2, 15.0),
            (unloads, 1, 0, 0.3, 16.0),
            (yields, -1, 1, 0.1, -4.0),
            (yields, -1, 2, -0.1, -14.0),
            (unloads, -1, 0, -0.2, -15.0),
            (yields, 1, 1, 0.0, 5.0),
            (yields, 1, 2, 0.2, 15.0),
        ]);
        // Element 1: 5 N over 0.2, 0.3 and 0.3 m; element 2: 8 N over 0.1, 0.1 and 0.1 m.
        spring.close(spring.spring.dissipated(), 5.0 * 0.8 + 8.0 * 0.3);
    }

    #[test]
    fn a_loop_in_both_precisions() {
        masing_loop::<f64>();
        masing_loop::<DoubleDouble>();
    }
}
