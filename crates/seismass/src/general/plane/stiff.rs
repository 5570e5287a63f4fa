//! When a step with stiff directions is tried as an implicit one, and how long it is.

use crate::general::plane::slide_series::{Beginning, SlideSeries};

/// Steps of an explicit series that an implicit one must replace to be tried: its iterations, each with a series of its own and
/// a linear system, cost about as much.
const PAYS: f64 = 16.0;

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

    /// Notes whether a step of a length was formed.
    pub(super) fn note(&mut self, h: f64, formed: bool) {
        self.next = Some(if formed { 2.0 * h } else { 0.25 * h });
    }
}
