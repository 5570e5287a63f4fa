//! Where a model's drift meets the real one as its share of the goods grows: kind, brackets and roots.

use seismass::Result;

/// Drifts that differ by less, relative to themselves, are the same.
pub(crate) const ROUNDING: f64 = 1e-12;
/// To which roots are located.
const TOLERANCE: f64 = 1e-12;
/// Steps of a search that halves the bracket at least every second time: enough for the tolerance, and never reached.
const MOST_STEPS: usize = 200;

/// How an effective fraction came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// No goods slide under any motion.
    Stuck,
    /// The model crosses the real drift once.
    Root,
    /// It crosses it several times.
    Multiple,
    /// It nowhere drifts less than the real building.
    Zero,
    /// It drifts less even with all goods attached.
    One,
}

impl Kind {
    /// Of a curve of which it is known at each share whether the model drifts less.
    pub(crate) fn of(below: &[bool]) -> Self {
        let crossings = below.windows(2).filter(|pair| pair[0] != pair[1]).count();
        match below.last() {
            Some(true) => Self::One,
            _ if !below.contains(&true) => Self::Zero,
            _ if crossings == 1 => Self::Root,
            _ => Self::Multiple,
        }
    }
}

/// Whether the model drifts less than the real building, by more than rounding.
pub(crate) fn is_below(model: f64, real: f64) -> bool {
    model < real * (1.0 - ROUNDING)
}

/// The root of `difference`, relative to the real drift, in a bracket that it changes sign in: regula falsi by Illinois,
/// with a bisection where the bracket did not halve.
pub(crate) fn refined_root(mut difference: impl FnMut(f64) -> Result<f64>, bracket: (f64, f64)) -> Result<f64> {
    let (mut low, mut high) = bracket;
    let (mut at_low, mut at_high) = (difference(low)?, difference(high)?);
    for (share, value) in [(low, at_low), (high, at_high)] {
        if value.abs() <= ROUNDING {
            return Ok(share);
        }
    }
    let mut bisects = false;
    // Which end the last step moved: an end that stays a second time counts half.
    let mut moved_low = None;
    for _ in 0..MOST_STEPS {
        let width = high - low;
        if width <= TOLERANCE {
            break;
        }
        let secant = low - at_low * width / (at_high - at_low);
        // Off the ends by the tolerance, so that the bracket closes from both sides.
        let inside = secant.clamp(low + 0.5 * TOLERANCE, high - 0.5 * TOLERANCE);
        let share = if bisects || inside.is_nan() { 0.5 * (low + high) } else { inside };
        let value = difference(share)?;
        if value == 0.0 {
            return Ok(share);
        }
        let moves_low = (value < 0.0) == (at_low < 0.0);
        let again = if moved_low == Some(moves_low) { 0.5 } else { 1.0 };
        if moves_low {
            (low, at_low, at_high) = (share, value, again * at_high);
        } else {
            (high, at_high, at_low) = (share, value, again * at_low);
        }
        moved_low = Some(moves_low);
        bisects = high - low > 0.5 * width;
    }
    Ok(0.5 * (low + high))
}

/// The smallest share from which on the model never drifts less than the real building, by linear interpolation between
/// those of a grid; 1 where it does at 1.
pub(crate) fn interpolated(shares: &[f64], model: &[f64], real: f64) -> f64 {
    let Some(last) = model.iter().rposition(|&drift| is_below(drift, real)) else {
        return 0.0;
    };
    if last + 1 == shares.len() {
        return 1.0;
    }
    let (low, high) = (model[last] - real, model[last + 1] - real);
    shares[last] - low / (high - low) * (shares[last + 1] - shares[last])
}

/// All crossings of one curve, by linear interpolation.
pub(crate) fn interpolated_roots(shares: &[f64], model: &[f64], real: f64) -> Vec<f64> {
    let crosses = |&k: &usize| is_below(model[k], real) != is_below(model[k + 1], real);
    let root = |k: usize| {
        let (low, high) = (model[k] - real, model[k + 1] - real);
        shares[k] - low / (high - low) * (shares[k + 1] - shares[k])
    };
    (0..shares.len() - 1).filter(crosses).map(root).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_follow_the_signs() {
        assert_eq!(Kind::of(&[true, true, false]), Kind::Root);
        assert_eq!(Kind::of(&[false, true, false]), Kind::Multiple);
        assert_eq!(Kind::of(&[false, false, false]), Kind::Zero);
        assert_eq!(Kind::of(&[true, false, true]), Kind::One);
    }

    #[test]
    fn roots_are_found_to_the_tolerance() {
        type Function = fn(f64) -> f64;
        // x^3 = 0.3, a step, and a function that is flat on one side: the secant alone creeps there.
        let functions: [(Function, f64); 3] = [
            (|x| x * x * x - 0.3, 0.669_432_950_082_169_5),
            (|x| if x < 0.4 { -1.0 } else { 10.0 }, 0.4),
            (|x| (20.0 * (x - 0.9)).exp() - 1e-6, 0.9 - 0.05 * 13.815_510_557_964_274),
        ];
        for (function, root) in functions {
            let mut calls = 0;
            let counted = |x| {
                calls += 1;
                Ok(function(x))
            };
            let found = refined_root(counted, (0.0, 1.0)).unwrap();
            assert!((found - root).abs() < 2.0 * TOLERANCE, "{found} {root}");
            assert!(calls < 90, "{calls}");
        }
        assert_eq!(refined_root(|x| Ok(x - 0.5), (0.5, 1.0)).unwrap(), 0.5);
    }

    #[test]
    fn a_curve_is_read_between_its_points() {
        let shares = [0.0, 0.5, 1.0];
        assert_eq!(interpolated(&shares, &[1.0, 3.0, 5.0], 2.0), 0.25);
        assert_eq!(interpolated(&shares, &[2.0, 3.0, 5.0], 2.0), 0.0);
        assert_eq!(interpolated(&shares, &[2.0, 3.0, 1.0], 2.0), 1.0);
        assert_eq!(interpolated_roots(&shares, &[3.0, 1.0, 3.0], 2.0), [0.25, 0.75]);
    }
}
