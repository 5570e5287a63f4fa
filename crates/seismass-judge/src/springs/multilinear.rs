//! The multilinear law: one plastic element for each point of the backbone but the last, beside the last slope.

use super::masing::Masing;
use crate::real::Real;

/// Slopes that differ by less than this fraction are one.
const EQUAL_SLOPES: f64 = 1e-9;

/// The virgin spring of a backbone through points of drift and force.
pub(super) fn spring<R: Real>(backbone: &[[f64; 2]]) -> Masing<R> {
    let mut before = [R::zero(); 2];
    let mut segments = Vec::new();
    for point in backbone {
        let [drift, force] = point.map(R::of);
        segments.push((drift, (force - before[1]) / (drift - before[0])));
        before = [drift, force];
    }
    let element = |pair: &[(R, R)]| {
        let [(end, slope), (_, next)] = [pair[0], pair[1]];
        (slope - next > R::of(EQUAL_SLOPES) * slope).then_some((slope - next, end))
    };
    let last = segments.last().map_or(R::zero(), |&(_, slope)| slope);
    Masing::new(segments.windows(2).filter_map(element), last)
}

#[cfg(test)]
mod tests {
    use seismass::{EventKind, Storey};

    use super::*;
    use crate::real::DoubleDouble;
    use crate::springs::loops::Loop;
    use crate::springs::{Slope, Spring};

    /// Slopes of 100, 100 (no element), 50, 20, 5 N/m; the first four points but one are yields at 0.2, 0.4, 0.9 m.
    const BACKBONE: [[f64; 2]; 5] = [[0.1, 10.0], [0.2, 20.0], [0.4, 30.0], [0.9, 40.0], [1.9, 45.0]];

    #[test]
    fn points_on_a_line_make_no_element() {
        let spring = spring::<DoubleDouble>(&BACKBONE);
        assert_eq!(spring.parts().len(), 3);
        let slopes = spring.backbone();
        for (Slope { from, slope }, expected) in slopes.iter().zip([[0.0, 100.0], [0.2, 50.0], [0.4, 20.0], [0.9, 5.0]])
        {
            assert!((from.to_f64() - expected[0]).abs() < 1e-15 && (slope.to_f64() / expected[1] - 1.0).abs() < 1e-14);
        }
        assert_eq!(super::spring::<f64>(&BACKBONE[..1]).parts().len(), 0);
    }

    /// The backbone goes on with the last slope, 47.5 N at 2.4 m. From there the doubled one goes down: by 40 N after
    /// 0.4 m, by 60 N after 0.8 m, by 80 N after 1.8 m, and by 5 N/m after that.
    fn backbone_loop<R: Real>() {
        let mut spring = Loop::<R>::new(&Storey::multilinear(&BACKBONE[..]));
        spring.follow(&BACKBONE);
        spring.follow(&[[2.4, 47.5], [2.0, 7.5], [1.6, -12.5], [0.6, -32.5], [0.0, -35.5]]);
        // From 0.0 m, up by 40, 60 and 80 N at the same distances, where the loop through 2.4 m is met.
        spring.follow(&[[0.4, 4.5], [0.8, 24.5], [1.8, 44.5], [2.4, 47.5], [2.6, 48.5]]);
        let elements: Vec<_> =
            spring.log.iter().map(|&(kind, sign, element, ..)| (kind as usize, sign, element)).collect();
        let (yields, unloads) = (EventKind::Yield as usize, EventKind::Unload as usize);
        let half = |sign| [(yields, sign, 1), (yields, sign, 2), (yields, sign, 3), (unloads, sign, 0)];
        assert_eq!(elements, [&half(1)[..], &half(-1), &half(1)[..3]].concat());
    }

    #[test]
    fn a_loop_in_both_precisions() {
        backbone_loop::<f64>();
        backbone_loop::<DoubleDouble>();
    }
}
