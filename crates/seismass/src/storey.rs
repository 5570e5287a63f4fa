//! The storey spring as a state machine: elastic, first yield, second yield (`numerics`, section 3).
//!
//! Elastic-perfectly-plastic elements in parallel with a linear one give the trilinear backbone with Masing
//! unloading. Forces are kept at a base drift, the drift of the last transition, and the run counts the drift from
//! there: however far the storey has yielded, a force never comes from the difference of two large drifts.

use crate::response::EventKind;
use crate::scene::Storey;

/// Direction of a force or a velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sign {
    Positive,
    Negative,
}

impl Sign {
    /// Sign of a value; zero counts as positive.
    pub(crate) fn of(value: f64) -> Self {
        if value < 0.0 { Self::Negative } else { Self::Positive }
    }

    /// +1 or -1.
    #[inline]
    pub(crate) fn factor(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }

    /// +1 or -1, for event logs.
    pub(crate) fn as_i8(self) -> i8 {
        match self {
            Self::Positive => 1,
            Self::Negative => -1,
        }
    }

    pub(crate) fn opposite(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }
}

/// An elastic-perfectly-plastic element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Element {
    pub(crate) stiffness: f64,
    pub(crate) yield_force: f64,
}

/// The constant data of a storey spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StoreyLaw {
    elements: [Element; 2],
    count: u8,
    /// Stiffness of the linear element r3 k, or k for an elastic storey.
    linear: f64,
    /// P/h, subtracted from the tangent always.
    pub(crate) geometric: f64,
    /// Drift at which the storey collapses; infinite: never.
    pub(crate) collapse_drift: f64,
}

impl StoreyLaw {
    /// The elements of a storey; those without stiffness, and those that never yield, do not exist.
    pub(crate) fn new(storey: &Storey, geometric: f64, collapse_drift: Option<f64>) -> Self {
        let &Storey { stiffness: k, yield_shear: vy, overstrength, second_slope: r2, third_slope: r3, .. } = storey;
        let mut law =
            Self { elements: [Element::default(); 2], count: 0, linear: k, geometric, collapse_drift: f64::INFINITY };
        if vy.is_finite() {
            let first = vy / k;
            law.linear = r3 * k;
            if overstrength == 1.0 {
                law.push((1.0 - r3) * k, first);
            } else {
                law.push((1.0 - r2) * k, first);
                if r2 > 0.0 {
                    law.push((r2 - r3) * k, first + (overstrength - 1.0) * vy / (r2 * k));
                }
            }
        }
        law.collapse_drift = collapse_drift.unwrap_or_else(|| law.backbone_collapse_drift());
        law
    }

    fn push(&mut self, stiffness: f64, yield_drift: f64) {
        if stiffness > 0.0 {
            self.elements[self.count as usize] = Element { stiffness, yield_force: stiffness * yield_drift };
            self.count += 1;
        }
    }

    /// The drift where the monotonic backbone V(d) meets (P/h) d; infinite if it never does.
    fn backbone_collapse_drift(&self) -> f64 {
        if self.linear >= self.geometric {
            return f64::INFINITY;
        }
        let mut slope = self.linear - self.geometric + self.elements().iter().map(|e| e.stiffness).sum::<f64>();
        let (mut drift, mut margin) = (0.0, 0.0);
        for element in self.elements() {
            let yield_drift = element.yield_force / element.stiffness;
            let next = margin + slope * (yield_drift - drift);
            if next <= 0.0 {
                break;
            }
            (drift, margin) = (yield_drift, next);
            slope -= element.stiffness;
        }
        drift - margin / slope
    }

    /// The elements that exist, in the order in which they yield.
    pub(crate) fn elements(&self) -> &[Element] {
        &self.elements[..self.count as usize]
    }

    /// Yield drift of the element that yields after `yielded` others: the size of the numbers that its bound comes
    /// from; 0 if there is none.
    pub(crate) fn yield_range(&self, yielded: u8) -> f64 {
        self.elements().get(yielded as usize).map_or(0.0, |e| e.yield_force / e.stiffness)
    }

    /// Whether the storey can yield at all.
    pub(crate) fn can_yield(&self) -> bool {
        self.count > 0
    }

    /// Spring tangent with `yielded` plastic elements, without P-Delta.
    pub(crate) fn tangent(&self, yielded: u8) -> f64 {
        self.elements().iter().skip(yielded as usize).map(|e| e.stiffness).sum::<f64>() + self.linear
    }
}

/// A storey spring in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StoreySpring {
    /// Drift at the last transition; the run's drift coordinate counts from here.
    base_drift: f64,
    /// Element forces at the base.
    force: [f64; 2],
    /// How many elements are plastic.
    yielded: u8,
    /// Sign of the plastic forces.
    sign: Sign,
}

impl StoreySpring {
    /// A virgin spring.
    pub(crate) fn new() -> Self {
        Self { base_drift: 0.0, force: [0.0; 2], yielded: 0, sign: Sign::Positive }
    }

    /// Number of plastic elements.
    #[inline]
    pub(crate) fn yielded(&self) -> u8 {
        self.yielded
    }

    /// Sign of the plastic forces, if there are any.
    #[inline]
    pub(crate) fn plastic(&self) -> Option<Sign> {
        (self.yielded > 0).then_some(self.sign)
    }

    /// Name of the state, for errors.
    pub(crate) fn state_name(&self) -> &'static str {
        match self.yielded {
            0 => "elastic",
            1 => "first yield",
            _ => "second yield",
        }
    }

    /// Drift at coordinate `x`.
    #[inline]
    pub(crate) fn drift(&self, x: f64) -> f64 {
        self.base_drift + x
    }

    /// Spring force at the base, without P-Delta.
    pub(crate) fn base_force(&self, law: &StoreyLaw) -> f64 {
        self.force[0] + self.force[1] + law.linear * self.base_drift
    }

    /// Spring force at the base less P-Delta.
    pub(crate) fn base_load(&self, law: &StoreyLaw) -> f64 {
        self.base_force(law) - law.geometric * self.base_drift
    }

    /// Element forces at coordinate `x`.
    fn forces(&self, law: &StoreyLaw, x: f64) -> [f64; 2] {
        // Each place by itself: an index known only at run time would keep all of them in memory.
        [0, 1].map(|e| {
            let (force, Element { stiffness, yield_force: limit }) = (self.force[e], law.elements[e]);
            let moves = (self.yielded..law.count).contains(&(e as u8));
            if moves { (force + stiffness * x).clamp(-limit, limit) } else { force }
        })
    }

    /// Coordinates at which the next element yields, (lower, upper); infinite where there is no such guard.
    pub(crate) fn yield_bounds(&self, law: &StoreyLaw) -> (f64, f64) {
        let Some(element) = law.elements().get(self.yielded as usize) else {
            return (f64::NEG_INFINITY, f64::INFINITY);
        };
        let force = self.force[self.yielded as usize];
        let upper = (element.yield_force - force) / element.stiffness;
        let lower = (-element.yield_force - force) / element.stiffness;
        match self.plastic() {
            None => (lower, upper),
            Some(Sign::Positive) => (f64::NEG_INFINITY, upper),
            Some(Sign::Negative) => (lower, f64::INFINITY),
        }
    }

    fn rebase(&mut self, law: &StoreyLaw, x: f64) {
        self.force = self.forces(law, x);
        self.base_drift += x;
    }

    /// Transition *yield* of the next element at coordinate `x`, which becomes the new base.
    pub(crate) fn yield_next(&mut self, law: &StoreyLaw, x: f64, sign: Sign) -> EventKind {
        self.rebase(law, x);
        let (force, next) = (self.force, self.yielded as usize);
        self.force = [0, 1].map(|e| if e == next { sign.factor() * law.elements[e].yield_force } else { force[e] });
        self.yielded += 1;
        self.sign = sign;
        EventKind::Yield
    }

    /// Transition *unload* at coordinate `x`, which becomes the new base: all plastic elements become elastic.
    pub(crate) fn unload(&mut self, law: &StoreyLaw, x: f64) -> EventKind {
        self.rebase(law, x);
        self.yielded = 0;
        EventKind::Unload
    }

    /// Energy stored in the elements at coordinate `x`, less the work of P-Delta.
    pub(crate) fn elastic_energy(&self, law: &StoreyLaw, x: f64) -> f64 {
        let force = self.forces(law, x);
        let drift = self.drift(x);
        let stored: f64 = law.elements().iter().zip(force).map(|(e, f)| 0.5 * f * f / e.stiffness).sum();
        stored + 0.5 * (law.linear - law.geometric) * drift * drift
    }

    /// Sum of the forces of the plastic elements: their power per drift rate is dissipated.
    pub(crate) fn plastic_force(&self) -> f64 {
        self.force[..self.yielded as usize].iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(overstrength: f64, r2: f64, r3: f64) -> StoreyLaw {
        let storey = Storey {
            stiffness: 100.0,
            yield_shear: 10.0,
            overstrength,
            second_slope: r2,
            third_slope: r3,
            law: Default::default(),
        };
        StoreyLaw::new(&storey, 0.0, None)
    }

    /// Drives a spring to `target` drift in small steps of its own machine.
    fn drive(law: &StoreyLaw, spring: &mut StoreySpring, target: f64) -> f64 {
        let mut x = 0.0;
        let direction = Sign::of(target - spring.drift(0.0));
        if spring.plastic().is_some_and(|s| s != direction) {
            spring.unload(law, x);
        }
        loop {
            let (lower, upper) = spring.yield_bounds(law);
            let bound = if direction == Sign::Positive { upper } else { lower };
            let goal = target - spring.drift(0.0);
            if (goal - bound) * direction.factor() <= 0.0 {
                x = goal;
                return spring.base_force(law) + law.tangent(spring.yielded()) * x;
            }
            spring.yield_next(law, bound, direction);
            x = 0.0;
            assert!(x == 0.0);
        }
    }

    /// Backbone of `numerics`, section 3: slopes k, r2 k, r3 k, breaks at V_y and Omega V_y.
    #[test]
    fn backbone_is_trilinear() {
        let law = law(2.0, 0.1, 0.02);
        let at = |d: f64| drive(&law, &mut StoreySpring::new(), d);
        assert!((at(0.1) - 10.0).abs() < 1e-12);
        assert!((at(0.6) - 15.0).abs() < 1e-12);
        assert!((at(1.1) - 20.0).abs() < 1e-12);
        assert!((at(2.1) - 22.0).abs() < 1e-12);
        assert!((at(-2.1) + 22.0).abs() < 1e-12);
    }

    /// Masing: the unloading branch is the backbone doubled, and it comes back to the point where it left.
    #[test]
    fn unloading_follows_masing() {
        let law = law(2.0, 0.1, 0.0);
        let mut spring = StoreySpring::new();
        let peak = drive(&law, &mut spring, 2.0);
        spring.rebase(&law, 2.0 - spring.drift(0.0));
        let half = drive(&law, &mut spring, 2.0 - 0.2);
        assert!((half - (peak - 20.0)).abs() < 1e-12);
        let lower = drive(&law, &mut spring, 2.0 - 2.2);
        assert!((lower - (peak - 40.0)).abs() < 1e-12);
    }

    #[test]
    fn special_cases_have_the_elements_of_the_specification() {
        assert_eq!(law(1.0, 0.5, 0.1).elements().len(), 1);
        assert_eq!(law(2.0, 0.0, 0.0).elements().len(), 1);
        assert_eq!(law(2.0, 0.3, 0.3).elements().len(), 1);
        let single = law(2.0, 1.0, 0.0);
        assert_eq!(single.elements().len(), 1);
        assert!((single.elements()[0].yield_force - 20.0).abs() < 1e-12);
        assert!(!StoreyLaw::new(&Storey::elastic(5.0), 0.0, None).can_yield());
    }

    /// V(d) = 20 beyond 1.1 m (r2 = 0.1, r3 = 0, Omega = 2) meets 4 d at 5 m.
    #[test]
    fn collapse_drift_is_where_the_backbone_meets_p_delta() {
        let storey = Storey {
            stiffness: 100.0,
            yield_shear: 10.0,
            overstrength: 2.0,
            second_slope: 0.1,
            third_slope: 0.0,
            law: Default::default(),
        };
        assert!((StoreyLaw::new(&storey, 4.0, None).collapse_drift - 5.0).abs() < 1e-12);
        // 10 + 10 (d - 0.1) = 40 d on the second slope.
        assert!((StoreyLaw::new(&storey, 40.0, None).collapse_drift - 0.3).abs() < 1e-12);
        assert_eq!(StoreyLaw::new(&storey, 0.0, None).collapse_drift, f64::INFINITY);
        assert_eq!(StoreyLaw::new(&storey, 4.0, Some(2.5)).collapse_drift, 2.5);
    }
}
