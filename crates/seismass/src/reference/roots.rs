//! The root of a guard along the length of a step.

use super::method::Error;

/// How often a step is halved in search of a place before a fallen guard where it still stood.
const MAX_HALVINGS: usize = 12;
/// Trials one root may take.
const MAX_TRIALS: usize = 100;
/// Every so many trials the bracket is bisected, whatever the secant says.
const BISECT_EVERY: usize = 4;

/// The length at which a guard that is `at_end` < 0 at length `h` falls, by the Illinois method (Dowell & Jarratt,
/// BIT 11, 1971) down to a bracket of `width`, on the fallen side; 0 where it stood nowhere.
pub(super) fn first_fall(
    h: f64,
    at_end: f64,
    width: f64,
    mut guard: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<f64, Error> {
    let (mut high, mut at_high) = (h, at_end);
    let (mut low, mut at_low) = (0.0, guard(0.0)?);
    // A guard that starts at zero, rises and falls is bracketed from where it stands.
    for _ in 0..MAX_HALVINGS {
        if at_low > 0.0 {
            break;
        }
        let middle = 0.5 * high;
        let at_middle = guard(middle)?;
        if at_middle > 0.0 {
            (low, at_low) = (middle, at_middle);
        } else {
            (high, at_high) = (middle, at_middle);
        }
    }
    if at_low <= 0.0 {
        return Ok(0.0);
    }
    let mut fell_last = None;
    for trial in 1..=MAX_TRIALS {
        if high - low <= width {
            break;
        }
        let secant = high - at_high * (high - low) / (at_high - at_low);
        let place = if trial % BISECT_EVERY == 0 { 0.5 * (low + high) } else { secant };
        let place = place.clamp(low + 0.4 * width, high - 0.4 * width);
        let at_place = guard(place)?;
        let fell = at_place < 0.0;
        if fell {
            (high, at_high) = (place, at_place);
        } else {
            (low, at_low) = (place, at_place);
        }
        if fell_last == Some(fell) {
            *(if fell { &mut at_low } else { &mut at_high }) *= 0.5;
        }
        fell_last = Some(fell);
    }
    Ok(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(guard: impl Fn(f64) -> f64, h: f64) -> (f64, usize) {
        let mut trials = 0;
        let found = first_fall(h, guard(h), 1e-13, |t| {
            trials += 1;
            Ok(guard(t))
        });
        (found.unwrap(), trials)
    }

    #[test]
    fn the_root_is_found_on_the_fallen_side_within_the_width() {
        let (length, trials) = root(|t| 0.3 - t - t * t * t, 1.0);
        let exact = 0.278_417_990_321_809_9;
        assert!((0.0..=1e-13).contains(&(length - exact)), "{length}");
        assert!(trials <= 16, "{trials}");
    }

    /// t (0.01 - t) starts at zero, rises, and falls at 0.01.
    #[test]
    fn a_guard_that_starts_at_zero_is_found_where_it_falls_later() {
        let (length, _) = root(|t| t * (0.01 - t), 1.0);
        assert!((length - 0.01).abs() <= 1e-13, "{length}");
    }

    #[test]
    fn a_guard_that_never_stood_falls_at_the_start() {
        assert_eq!(root(|t| -t, 1.0).0, 0.0);
    }
}
