//! When a step with stiff directions is tried as an implicit one, and how long it is.

use crate::general::plane::slide_series::{Beginning, SlideSeries};

/// Steps of an explicit series that an implicit one must replace to be tried: its iterations, each with a series of its own and
/// a linear system, cost about half as much.
const PAYS: f64 = 8.0;

/// What the terms in the middle of a direction may be, so that those left out, twice as high, are below rounding.
pub(super) const MIDDLE: f64 = 4e-9;

/// Power of the length of a step with which the terms in the middle of directions grow, the highest of them the degree 7; part
/// of the length by it that is tried; and the smallest and largest change from one attempt to the next.
const POWER: f64 = 6.5;
const CAUTION: f64 = 0.85;
const CHANGES: [f64; 2] = [0.1, 4.0];

/// How long implicit steps have been.
#[derive(Default)]
pub(super) struct Stiff {
    /// The length to be tried next (s); none: as long as may be.
    next: Option<f64>,
}

impl Stiff {
    /// The length of an implicit step worth trying in place of an explicit one that ends at `end` of `h`.
    pub(super) fn longer(&mut self, slides: &[SlideSeries], h: f64, end: f64, longest: f64) -> Option<f64> {
        let starts = |slide: &SlideSeries| slide.beginning.is_implicit();
        if slides.iter().any(|slide| slide.beginning != Beginning::Moving && !starts(slide))
            || slides.iter().all(starts)
        {
            return None;
        }
        let before_stop = |slide: &SlideSeries| {
            let fall = -slide.length[1] / (h * slide.length[0]);
            if fall > 0.0 && !starts(slide) { 0.75 / fall } else { f64::INFINITY }
        };
        let limit = slides.iter().fold(longest, |limit, slide| limit.min(before_stop(slide)));
        let longer = self.next.map_or(limit, |next| limit.min(next));
        let pays = longer > PAYS * h * end;
        if !pays {
            self.next = self.next.map(|next| 1.1 * next);
        }
        pays.then_some(longer)
    }

    /// Notes whether a step of a length was formed, and the largest terms in the middle of its directions.
    pub(super) fn note(&mut self, h: f64, (formed, middle): (bool, f64)) {
        let change = CAUTION * libm::pow(MIDDLE / middle, 1.0 / POWER);
        let [least, most] = CHANGES;
        self.next = Some(h * change.clamp(least, if formed { most } else { 0.5 }));
    }
}
