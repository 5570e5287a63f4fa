//! Orders of series: how many terms they need, and the weights of these.

use crate::lanes::{OnLine, Vector, WIDTH};
use crate::polynomial::power::MAX_DEGREE;

/// Largest phase at which the term of order 3, 4, ... is below 2^-60: phase^k / k! rounded down.
static PHASE_LIMITS: OnLine<[[f64; WIDTH]; 5]> = OnLine([
    [0.0000, 0.0000, 0.0006, 0.0029],
    [0.0088, 0.0207, 0.0408, 0.0707],
    [0.1119, 0.1652, 0.2312, 0.3099],
    [0.4014, 0.5054, 0.6215, 0.7493],
    [0.8883, 1.0380, f64::INFINITY, f64::INFINITY],
]);

/// What longer phases have too.
const MOST_TERMS: usize = 21;

/// Order of the first term that is below rounding.
#[inline(always)]
pub(crate) fn terms<V: Vector>(phase: f64) -> usize {
    let mut reached = 0;
    for limits in PHASE_LIMITS.iter() {
        reached = reached << WIDTH | V::splat(phase).not_below(V::load(limits));
    }
    (3 + reached.count_ones() as usize).min(MOST_TERMS)
}

/// Numbers by order.
pub(crate) type Weights = [f64; MAX_DEGREE + 1];

/// Orders k, and from the second on the first and second integrals of s^k over [0, 1], each in all lanes.
pub(crate) static WEIGHTS: OnLine<[[[f64; WIDTH]; 3]; MAX_DEGREE + 1]> = {
    let mut table = [[[0.0; WIDTH]; 3]; MAX_DEGREE + 1];
    let mut k = 1;
    while k <= MAX_DEGREE {
        let once = if k > 1 { 1.0 / (k + 1) as f64 } else { 0.0 };
        table[k] = [[k as f64; WIDTH], [once; WIDTH], [once / (k + 2) as f64; WIDTH]];
        k += 1;
    }
    OnLine(table)
};

/// 1 / k.
pub(crate) static INVERSE: OnLine<Weights> = {
    let mut table = [0.0; MAX_DEGREE + 1];
    let mut k = 1;
    while k <= MAX_DEGREE {
        table[k] = 1.0 / k as f64;
        k += 1;
    }
    OnLine(table)
};

/// 1 / (k (k - 1)).
pub(crate) static INVERSE_PAIRS: OnLine<Weights> = {
    let mut table = [0.0; MAX_DEGREE + 1];
    let mut k = 2;
    while k <= MAX_DEGREE {
        table[k] = 1.0 / (k * (k - 1)) as f64;
        k += 1;
    }
    OnLine(table)
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Plain;
    use crate::tolerances::SERIES_PHASE;

    /// The neglected term is below 2^-60, and the next guard polynomials still fit.
    #[test]
    fn series_are_long_enough() {
        for phase in [1e-9, 1e-3, 0.1, 0.3, 0.7, SERIES_PHASE] {
            let order = terms::<Plain>(phase);
            let term = (1..=order).fold(1.0, |term, k| term * phase / k as f64);
            assert!(term <= (-60f64).exp2(), "phase {phase}: {term:e}");
        }
        assert!(2 + terms::<Plain>(f64::INFINITY) <= MAX_DEGREE);
    }
}
