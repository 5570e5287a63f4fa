//! Flag-shaped hysteresis of self-centring storeys (Christopoulos, Filiatrault and Folz 2002; `numerics`, section 3.7).

use crate::machines::segment::{Backbone, Crossing, Segment, SpringMachine};
use crate::machines::sign::Sign;
use crate::response::EventKind;
use crate::scene::Storey;

/// A line of the second slope: on the upper one the spring is loaded, on the lower one it comes back.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Line {
    Upper,
    Lower,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    /// On the line through the origin.
    Elastic,
    /// On a line of the side of this sign.
    On(Sign, Line),
    /// Between the lines of a side, elastic, since this one was left.
    Between(Sign, Line),
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FlagShaped {
    stiffness: f64,
    /// Slope of both lines.
    second: f64,
    yield_force: f64,
    yield_drift: f64,
    /// Height of the flag over the yield force, beta.
    height: f64,
    mode: Mode,
    base_drift: f64,
}

impl FlagShaped {
    /// The virgin spring of a storey; elastic where its strength is infinite or its second slope the first.
    pub(crate) fn new(storey: &Storey, height: f64) -> Self {
        let &Storey { stiffness, yield_shear, second_slope, .. } = storey;
        let yield_force = if second_slope < 1.0 { yield_shear } else { f64::INFINITY };
        let (second, yield_drift) = (second_slope * stiffness, yield_force / stiffness);
        Self { stiffness, second, yield_force, yield_drift, height, mode: Mode::Elastic, base_drift: 0.0 }
    }

    /// Drift between the lines along the elastic slope.
    fn width(&self) -> f64 {
        self.height * self.yield_drift
    }

    /// Drift at which a line leaves the elastic one, in the direction of its side.
    fn corner(&self, line: Line) -> f64 {
        self.part(line) * self.yield_drift
    }

    /// Drift and force of that place over those at yield.
    fn part(&self, line: Line) -> f64 {
        match line {
            Line::Upper => 1.0,
            Line::Lower => 1.0 - self.height,
        }
    }

    /// Force of a line at a drift, both in the direction of its side.
    fn force_on(&self, line: Line, drift: f64) -> f64 {
        self.part(line) * self.yield_force + self.second * (drift - self.corner(line))
    }

    fn base_force(&self) -> f64 {
        match self.mode {
            Mode::Elastic => self.stiffness * self.base_drift,
            Mode::On(sign, line) | Mode::Between(sign, line) => {
                sign.factor() * self.force_on(line, sign.factor() * self.base_drift)
            }
        }
    }

    fn tangent(&self) -> f64 {
        if matches!(self.mode, Mode::On(..)) { self.second } else { self.stiffness }
    }

    /// The spring comes to a line at a drift.
    fn enter(&mut self, sign: Sign, line: Line, drift: f64) -> Crossing {
        (self.mode, self.base_drift) = (Mode::On(sign, line), drift);
        Crossing::of_yield(sign, if line == Line::Upper { 1 } else { 2 })
    }
}

impl SpringMachine for FlagShaped {
    fn segment(&self) -> Segment {
        let line = Segment::line(self.base_drift, self.base_force(), self.tangent());
        if !self.can_yield() {
            return line;
        }
        let range = self.yield_drift.max(self.base_drift.abs());
        let of_line = Segment { range, class: 1, ..line };
        // From the base inwards to the place where a line leaves the elastic one.
        let inwards =
            |sign: Sign, line: Line| -sign.factor() * (sign.factor() * self.base_drift - self.corner(line)).max(0.0);
        match self.mode {
            Mode::Elastic => {
                let ends = (-self.yield_drift - self.base_drift, self.yield_drift - self.base_drift);
                Segment { ends, range, ..line }
            }
            // The two lines are one.
            Mode::On(sign, line) if self.height == 0.0 => {
                Segment { rate_sign: None, ..of_line.towards(sign.opposite(), inwards(sign, line)) }
            }
            Mode::On(sign, Line::Upper) => of_line.towards(sign, sign.factor() * f64::INFINITY),
            Mode::On(sign, Line::Lower) => of_line.towards(sign.opposite(), inwards(sign, Line::Lower)),
            Mode::Between(sign, left) => {
                let ends = match (sign, left) {
                    (Sign::Positive, Line::Upper) | (Sign::Negative, Line::Lower) => (-self.width(), 0.0),
                    (Sign::Positive, Line::Lower) | (Sign::Negative, Line::Upper) => (0.0, self.width()),
                };
                Segment { ends, range: self.yield_drift, ..line }
            }
        }
    }

    fn end(&mut self, x: f64, sign: Sign) -> Crossing {
        match self.mode {
            Mode::Elastic => self.enter(sign, Line::Upper, sign.factor() * self.yield_drift),
            Mode::On(side, line) => {
                (self.mode, self.base_drift) = (Mode::Elastic, side.factor() * self.corner(line));
                Crossing::new(EventKind::Unload, side)
            }
            Mode::Between(side, _) => {
                let line = if sign == side { Line::Upper } else { Line::Lower };
                self.enter(side, line, self.base_drift + x)
            }
        }
    }

    fn turn(&mut self, x: f64) -> Crossing {
        let Mode::On(side, line) = self.mode else {
            return Crossing::new(EventKind::Unload, Sign::of(self.base_force()));
        };
        (self.mode, self.base_drift) = (Mode::Between(side, line), self.base_drift + x);
        Crossing::new(if line == Line::Upper { EventKind::Unload } else { EventKind::Reload }, side)
    }

    /// What the way back to zero drift returns: along the elastic slope to the lower line, and down that.
    fn stored(&self, x: f64, geometric: f64) -> f64 {
        let (drift, force) = (self.base_drift + x, self.base_force() + self.tangent() * x);
        let (side, above) = match self.mode {
            Mode::Elastic => return 0.5 * force * force / self.stiffness - 0.5 * geometric * drift * drift,
            Mode::On(side, Line::Upper) => (side, self.width()),
            Mode::On(side, Line::Lower) => (side, 0.0),
            Mode::Between(side, Line::Upper) => (side, self.width() + side.factor() * x),
            Mode::Between(side, Line::Lower) => (side, side.factor() * x),
        };
        let corner = self.corner(Line::Lower);
        let foot = side.factor() * drift - above;
        let (low, middle) = (self.stiffness * corner, self.force_on(Line::Lower, foot));
        let areas = low * corner + (low + middle) * (foot - corner) + (middle + side.factor() * force) * above;
        0.5 * areas - 0.5 * geometric * drift * drift
    }

    /// Loading along the upper line stores what the way back at the lower one returns.
    fn dissipated(&self, _: f64, change: f64) -> f64 {
        let Mode::On(side, Line::Upper) = self.mode else { return 0.0 };
        self.height * (self.yield_force - self.second * self.yield_drift) * side.factor() * change
    }

    fn state_name(&self) -> &'static str {
        match self.mode {
            Mode::Elastic => "elastic",
            Mode::On(_, Line::Upper) => "on the upper line of its flag",
            Mode::On(_, Line::Lower) => "on the lower line of its flag",
            Mode::Between(..) => "inside its flag",
        }
    }

    fn backbone(&self) -> Backbone {
        if self.can_yield() {
            Backbone { breaks: vec![(self.yield_drift, self.stiffness - self.second)], last_slope: self.second }
        } else {
            Backbone { breaks: Vec::new(), last_slope: self.stiffness }
        }
    }

    fn tangents(&self) -> Option<Vec<f64>> {
        Some(vec![self.stiffness, self.second])
    }

    fn largest_tangent(&self) -> f64 {
        self.stiffness
    }

    fn can_yield(&self) -> bool {
        self.yield_force.is_finite()
    }

    fn parameters(&self) -> Vec<f64> {
        vec![self.yield_force, self.height]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 100 N/m up to 10 N at 0.1 m, 10 N/m beyond. With beta = 0.8 the lower line begins at (0.02, 2) and lies 0.08 m and
    /// 8 N from the upper one along the elastic slope.
    fn spring(height: f64) -> FlagShaped {
        FlagShaped::new(&Storey { second_slope: 0.1, ..Storey::yielding(100.0, 10.0) }, height)
    }

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-14 * (1.0 + expected.abs()), "{found} for {expected}");
    }

    /// Asserts base drift, base force, slope and ends of the present segment.
    fn is_at(spring: &FlagShaped, drift: f64, force: f64, tangent: f64, ends: (f64, f64), rate_sign: Option<Sign>) {
        let segment = spring.segment();
        let expected = [drift, force, tangent];
        for (found, expected) in [segment.base_drift, segment.base_force, segment.tangent].into_iter().zip(expected) {
            close(found, expected);
        }
        for (found, expected) in [(segment.ends.0, ends.0), (segment.ends.1, ends.1)] {
            assert!(found == expected || (found - expected).abs() < 1e-14, "{found} for {expected}");
        }
        assert_eq!(segment.rate_sign, rate_sign);
    }

    /// Moves to the end that the present segment has in the direction of this sign.
    fn end(spring: &mut FlagShaped, sign: Sign) -> Crossing {
        let ends = spring.segment().ends;
        spring.end(if sign == Sign::Positive { ends.1 } else { ends.0 }, sign)
    }

    const FAR: f64 = f64::INFINITY;

    /// To (0.6, 15), back to the lower line at (0.52, 7), down it to (0.32, 5), up to the upper line at (0.4, 13), back, and
    /// out of the flag at (0.02, 2) to the other side: there the same, with the signs turned.
    fn flag(sign: Sign) {
        let (s, back) = (sign.factor(), sign.opposite());
        let ends = |low: f64, high: f64| if sign == Sign::Positive { (low, high) } else { (-high, -low) };
        let mut spring = spring(0.8);
        is_at(&spring, 0.0, 0.0, 100.0, (-0.1, 0.1), None);
        assert_eq!(end(&mut spring, sign), Crossing::of_yield(sign, 1));
        is_at(&spring, s * 0.1, s * 10.0, 10.0, (-FAR, FAR), Some(sign));
        // beta (1 - r) V_y = 7.2 N over 0.5 m; 0.5 + 6.25 J less that: 0.88 + 2.25 + 0.02 J come back.
        close(spring.dissipated(0.0, s * 0.5), 3.6);
        close(spring.stored(s * 0.5, 0.0), 3.15);
        assert_eq!(spring.turn(s * 0.5), Crossing::new(EventKind::Unload, sign));
        is_at(&spring, s * 0.6, s * 15.0, 100.0, ends(-0.08, 0.0), None);
        close(spring.stored(0.0, 0.0), 3.15);
        close(spring.stored(s * -0.08, 0.0), 2.27);
        assert_eq!(end(&mut spring, back), Crossing::of_yield(sign, 2));
        is_at(&spring, s * 0.52, s * 7.0, 10.0, ends(-0.5, FAR), Some(back));
        close(spring.stored(0.0, 0.0), 2.27);
        assert_eq!(spring.turn(s * -0.2), Crossing::new(EventKind::Reload, sign));
        is_at(&spring, s * 0.32, s * 5.0, 100.0, ends(0.0, 0.08), None);
        assert_eq!(end(&mut spring, sign), Crossing::of_yield(sign, 1));
        is_at(&spring, s * 0.4, s * 13.0, 10.0, (-FAR, FAR), Some(sign));
        assert_eq!(spring.turn(0.0).kind, EventKind::Unload);
        assert_eq!(end(&mut spring, back), Crossing::of_yield(sign, 2));
        assert_eq!(end(&mut spring, back), Crossing::new(EventKind::Unload, sign));
        is_at(&spring, s * 0.02, s * 2.0, 100.0, ends(-0.12, 0.08), None);
        close(spring.stored(0.0, 0.0), 0.02);
        assert_eq!(end(&mut spring, back), Crossing::of_yield(back, 1));
        is_at(&spring, s * -0.1, s * -10.0, 10.0, (-FAR, FAR), Some(back));
    }

    #[test]
    fn a_flag_on_either_side() {
        flag(Sign::Positive);
        flag(Sign::Negative);
    }

    /// With beta = 1 the lower line begins at the origin.
    #[test]
    fn the_full_flag_ends_at_the_origin() {
        let mut spring = spring(1.0);
        end(&mut spring, Sign::Positive);
        spring.turn(0.5);
        end(&mut spring, Sign::Negative);
        is_at(&spring, 0.5, 5.0, 10.0, (-0.5, FAR), Some(Sign::Negative));
        end(&mut spring, Sign::Negative);
        is_at(&spring, 0.0, 0.0, 100.0, (-0.1, 0.1), None);
    }

    /// With beta = 0 the spring is elastic on two slopes: its rate may turn on the second one.
    #[test]
    fn without_height_both_lines_are_one() {
        let mut spring = spring(0.0);
        assert_eq!(end(&mut spring, Sign::Negative), Crossing::of_yield(Sign::Negative, 1));
        is_at(&spring, -0.1, -10.0, 10.0, (-FAR, 0.0), None);
        assert_eq!(spring.dissipated(0.0, -0.5), 0.0);
        close(spring.stored(-0.5, 0.0), 6.75);
        assert_eq!(end(&mut spring, Sign::Positive), Crossing::new(EventKind::Unload, Sign::Negative));
        is_at(&spring, -0.1, -10.0, 100.0, (0.0, 0.2), None);
    }

    #[test]
    fn one_slope_is_elastic() {
        let storey = Storey { second_slope: 1.0, ..Storey::yielding(100.0, 10.0) };
        for storey in [storey, Storey::elastic(100.0)] {
            let spring = FlagShaped::new(&storey, 0.5);
            assert!(!spring.can_yield());
            assert_eq!(spring.segment(), Segment::line(0.0, 0.0, 100.0));
            assert_eq!(spring.backbone().collapse_drift(50.0), f64::INFINITY);
        }
    }
}
