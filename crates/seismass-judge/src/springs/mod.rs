//! Storey springs as state machines that are linear between events: what a law tells the run, and one file per law.

mod contract;
mod flag_shaped;
mod gap;
#[cfg(test)]
mod loops;
mod masing;
mod multilinear;
mod peak_oriented;
mod trilinear;

use seismass::{SpringLaw, Storey};

use crate::real::Real;

use flag_shaped::FlagShaped;
use gap::Gap;
use peak_oriented::PeakOriented;

pub(crate) use contract::{Course, Part, Slope, Spring, SpringGuard};

/// The virgin spring of a storey.
pub(crate) fn spring<R: Real>(storey: &Storey) -> Box<dyn Spring<R>> {
    match &storey.law {
        SpringLaw::Trilinear => Box::new(trilinear::spring::<R>(storey)),
        SpringLaw::Multilinear { backbone } => Box::new(multilinear::spring::<R>(backbone)),
        &SpringLaw::Gap { clearance, stop_stiffness } => {
            Box::new(Gap::new(trilinear::spring(storey), R::of(clearance), R::of(stop_stiffness)))
        }
        SpringLaw::PeakOriented(_) if storey.yield_shear.is_infinite() => Box::new(trilinear::spring::<R>(storey)),
        SpringLaw::PeakOriented(law) => Box::new(PeakOriented::<R>::new(storey, law)),
        &SpringLaw::FlagShaped { flag_height } => Box::new(FlagShaped::<R>::new(storey, flag_height)),
    }
}

/// The drift d > 0 at which a monotonic backbone V(d) first meets (P/h) d; none if it never does.
pub(crate) fn collapse_drift<R: Real>(backbone: &[Slope<R>], geometric: R) -> Option<R> {
    // What V(d) - (P/h) d is at the beginning of the slope.
    let mut excess = R::zero();
    for (i, &Slope { from, slope }) in backbone.iter().enumerate() {
        let tangent = slope - geometric;
        let end = backbone.get(i + 1).map(|next| next.from);
        if tangent < R::zero() {
            let drift = from - excess / tangent;
            if end.is_none_or(|end| drift <= end) {
                return Some(drift);
            }
        }
        if let Some(end) = end {
            excess = excess + tangent * (end - from);
        }
    }
    None
}
