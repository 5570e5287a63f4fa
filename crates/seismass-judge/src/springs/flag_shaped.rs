//! The flag-shaped law of self-centring storeys: two parallel lines on each side, elastic between them.

use seismass::{EventKind, Storey};

use crate::real::Real;
use crate::sign::Sign;
use crate::springs::contract::{Course, Crossing, Limit, Part, Slope, Spring, SpringGuard};

/// A line of the second slope through a place of the elastic one, in the direction of a side.
#[derive(Debug, Clone, Copy)]
struct Line<R> {
    drift: R,
    force: R,
    slope: R,
}

impl<R: Real> Line<R> {
    fn force(&self, drift: R) -> R {
        self.force + self.slope * (drift - self.drift)
    }
}

#[derive(Debug, Clone, Copy)]
enum Mode {
    /// On the line through the origin.
    Elastic,
    /// On the upper line of a side, outwards; in either direction where the lower one is the same.
    Upper(Sign),
    /// On the lower line of a side, inwards.
    Lower(Sign),
    /// Between both lines of a side.
    Between(Sign),
}

#[derive(Debug, Clone)]
pub(super) struct FlagShaped<R> {
    stiffness: R,
    upper: Line<R>,
    lower: Line<R>,
    /// Whether it leaves the elastic line ever.
    yields: bool,
    /// Whether both lines are the same.
    flat: bool,
    mode: Mode,
    force: R,
    dissipated: R,
}

impl<R: Real> FlagShaped<R> {
    pub(super) fn new(storey: &Storey, height: f64) -> Self {
        let k = R::of(storey.stiffness);
        let yields = storey.yield_shear.is_finite() && storey.second_slope < 1.0;
        let yield_force = if yields { R::of(storey.yield_shear) } else { R::zero() };
        let line = |force: R| Line { drift: force / k, force, slope: R::of(storey.second_slope) * k };
        Self {
            stiffness: k,
            upper: line(yield_force),
            lower: line((R::of(1.0) - R::of(height)) * yield_force),
            yields,
            flat: height == 0.0,
            mode: Mode::Elastic,
            force: R::zero(),
            dissipated: R::zero(),
        }
    }

    /// Energy given back on the way to zero force from a drift and a force in the direction of the side: along k down to
    /// the lower line, along that to the elastic one, and to the origin.
    fn returned(&self, drift: R, force: R) -> R {
        let Line { drift: end, force: least, slope } = self.lower;
        let down = (force - self.lower.force(drift)) / (self.stiffness - slope);
        let (foot, met) = (drift - down, force - self.stiffness * down);
        R::of(0.5) * (down * (force + met) + (foot - end) * (met + least) + end * least)
    }
}

impl<R: Real + 'static> Spring<R> for FlagShaped<R> {
    fn copied(&self) -> Box<dyn Spring<R>> {
        Box::new(self.clone())
    }

    fn start(&mut self, drift: R) {
        self.force = self.stiffness * drift;
    }

    fn parts(&self) -> Vec<Part<R>> {
        let tangent = match self.mode {
            Mode::Elastic | Mode::Between(_) => self.stiffness,
            Mode::Upper(_) | Mode::Lower(_) => self.upper.slope,
        };
        vec![Part { force: self.force, tangent }]
    }

    fn linear(&self) -> R {
        R::zero()
    }

    fn largest_stiffness(&self) -> R {
        self.stiffness
    }

    fn backbone(&self) -> Vec<Slope<R>> {
        let elastic = Slope { from: R::zero(), slope: self.stiffness };
        let upper = Slope { from: self.upper.drift, slope: self.upper.slope };
        if self.yields { vec![elastic, upper] } else { vec![elastic] }
    }

    fn limits(&self, course: &Course<R>, rate_size: R) -> Vec<Limit<R>> {
        let force = &course.forces[0];
        let leaves = |line: &Line<R>, side: Sign| Limit::above(SpringGuard::BranchEnd, line.drift, side, course.drift);
        match self.mode {
            Mode::Elastic if !self.yields => Vec::new(),
            Mode::Elastic => [Sign::Positive, Sign::Negative]
                .map(|sign| Limit::below(SpringGuard::Yield { element: 0, sign }, self.upper.force, sign, force))
                .to_vec(),
            Mode::Upper(side) if self.flat => vec![leaves(&self.upper, side)],
            Mode::Upper(side) => vec![Limit::no_turn(side, course.rate, rate_size)],
            Mode::Lower(side) => {
                vec![Limit::no_turn(side.opposite(), course.rate, rate_size), leaves(&self.lower, side)]
            }
            // Along k the force less that of a line falls by k less its slope.
            Mode::Between(side) => {
                let of_slope = course.drift.scaled(-self.upper.slope);
                let less_slope = force.plus(&of_slope);
                let at_zero = |line: &Line<R>| line.force(R::zero());
                let guard = |element: usize, sign: Sign| SpringGuard::Yield { element, sign };
                let mut limits = vec![
                    Limit::below(guard(0, side), at_zero(&self.upper), side, &less_slope),
                    Limit::above(guard(1, side), at_zero(&self.lower), side, &less_slope),
                ];
                // Both terms are rounded, however small their difference is.
                limits.iter_mut().for_each(|limit| limit.size = limit.size + force.size() + of_slope.size());
                limits
            }
        }
    }

    /// The upper line alone dissipates: the work there less what the way back returns.
    fn advance(&mut self, course: &Course<R>) {
        let (before, drift) = (self.force, course.drift.start());
        self.force = course.forces[0].end();
        if let (Mode::Upper(side), false) = (self.mode, self.flat) {
            let work = R::of(0.5) * (before + self.force) * course.advance();
            let returned = |drift: R, force: R| self.returned(side.times(drift), side.times(force));
            let change = returned(course.drift.end(), self.force) - returned(drift, before);
            self.dissipated = self.dissipated + work - change;
        }
    }

    fn cross(&mut self, guard: SpringGuard, drift: R) -> Vec<Crossing> {
        let (mode, crossing) = match (guard, self.mode) {
            (SpringGuard::Yield { sign, .. }, Mode::Elastic) => {
                (Mode::Upper(sign), Crossing::new(EventKind::Yield, sign, 1))
            }
            (SpringGuard::Yield { element, .. }, Mode::Between(side)) => {
                let mode = if element == 0 { Mode::Upper(side) } else { Mode::Lower(side) };
                (mode, Crossing::new(EventKind::Yield, side, element + 1))
            }
            (SpringGuard::Turn(_), Mode::Upper(side)) => {
                (Mode::Between(side), Crossing::new(EventKind::Unload, side, 0))
            }
            (SpringGuard::Turn(_), Mode::Lower(side)) => {
                (Mode::Between(side), Crossing::new(EventKind::Reload, side, 0))
            }
            (SpringGuard::BranchEnd, Mode::Upper(side) | Mode::Lower(side)) => {
                (Mode::Elastic, Crossing::new(EventKind::Unload, side, 0))
            }
            _ => return Vec::new(),
        };
        // The force is that of the line that it comes to or leaves: not on either side of it, by what has been rounded.
        let line = if let Mode::Between(_) = mode { self.mode } else { mode };
        match line {
            Mode::Elastic => self.force = self.stiffness * drift,
            Mode::Upper(side) => self.force = side.times(self.upper.force(side.times(drift))),
            Mode::Lower(side) => self.force = side.times(self.lower.force(side.times(drift))),
            Mode::Between(_) => {}
        }
        self.mode = mode;
        vec![crossing]
    }

    fn stored(&self, drift: R) -> R {
        match self.mode {
            Mode::Elastic => R::of(0.5) * self.force * self.force / self.stiffness,
            Mode::Upper(side) | Mode::Lower(side) | Mode::Between(side) => {
                self.returned(side.times(drift), side.times(self.force))
            }
        }
    }

    fn dissipated(&self) -> R {
        self.dissipated
    }

    fn scale(&mut self, factor: &mut dyn FnMut() -> R) {
        self.force = self.force * factor();
    }
}

#[cfg(test)]
mod tests {
    use seismass::EventKind::{Reload, Unload, Yield};
    use seismass::SpringLaw;

    use super::*;
    use crate::real::DoubleDouble;
    use crate::springs::loops::Loop;

    /// 200 N/m up to 10 N at 0.05 m, 20 N/m beyond; the lower line begins at (0.02, 4) with beta = 0.6.
    fn storey(flag_height: f64) -> Storey {
        Storey { second_slope: 0.1, law: SpringLaw::FlagShaped { flag_height }, ..Storey::yielding(200.0, 10.0) }
    }

    /// 6 N and 0.03 m lie between the lines along k; 5.4 N at one drift, which times the way on the upper line is lost.
    fn flag_loop<R: Real>() {
        let mut spring = Loop::<R>::new(&storey(0.6));
        spring.follow(&[
            [0.05, 10.0],
            [0.25, 14.0],
            [0.24, 12.0],
            [0.22, 8.0],
            [0.12, 6.0],
            [0.14, 10.0],
            [0.15, 12.0],
        ]);
        spring.follow(&[[0.35, 16.0], [0.32, 10.0], [0.02, 4.0], [0.0, 0.0], [-0.05, -10.0], [-0.1, -11.0]]);
        spring.follow(&[[-0.07, -5.0], [-0.02, -4.0], [0.04, 8.0]]);
        spring.logged(&[
            (Yield, 1, 1, 0.05, 10.0),
            (Unload, 1, 0, 0.25, 14.0),
            (Yield, 1, 2, 0.22, 8.0),
            (Reload, 1, 0, 0.12, 6.0),
            (Yield, 1, 1, 0.15, 12.0),
            (Unload, 1, 0, 0.35, 16.0),
            (Yield, 1, 2, 0.32, 10.0),
            (Unload, 1, 0, 0.02, 4.0),
            (Yield, -1, 1, -0.05, -10.0),
            (Unload, -1, 0, -0.1, -11.0),
            (Yield, -1, 2, -0.07, -5.0),
            (Unload, -1, 0, -0.02, -4.0),
        ]);
        spring.close(spring.spring.dissipated(), 5.4 * (0.2 + 0.2 + 0.05));
    }

    /// Without height nothing is lost, and the rate may turn on the second slope.
    fn line_loop<R: Real>() {
        let mut spring = Loop::<R>::new(&storey(0.0));
        spring.follow(&[[0.25, 14.0], [0.15, 12.0], [0.35, 16.0], [0.0, 0.0], [-0.25, -14.0], [0.0, 0.0]]);
        let kinds: Vec<_> = spring.log.iter().map(|&(kind, sign, ..)| (kind, sign)).collect();
        assert_eq!(kinds, [(Yield, 1), (Unload, 1), (Yield, -1), (Unload, -1)]);
        spring.close(spring.spring.dissipated(), 0.0);
    }

    #[test]
    fn loops_in_both_precisions() {
        flag_loop::<f64>();
        flag_loop::<DoubleDouble>();
        line_loop::<f64>();
        line_loop::<DoubleDouble>();
    }

    #[test]
    fn one_slope_is_elastic() {
        let mut spring = Loop::<f64>::new(&Storey { second_slope: 1.0, ..storey(0.5) });
        spring.follow(&[[1.0, 200.0], [-1.0, -200.0]]);
        assert!(spring.log.is_empty());
    }
}
