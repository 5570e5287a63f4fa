//! The trilinear law: at most two plastic elements (`numerics`, section 3).

use seismass::Storey;

use super::masing::Masing;
use crate::real::Real;

/// The virgin spring of a storey's numbers, whatever its law.
pub(super) fn spring<R: Real>(storey: &Storey) -> Masing<R> {
    let (one, k) = (R::of(1.0), R::of(storey.stiffness));
    if storey.yield_shear.is_infinite() {
        return Masing::new([], k);
    }
    let (vy, omega) = (R::of(storey.yield_shear), R::of(storey.overstrength));
    let (r2, r3) = (R::of(storey.second_slope), R::of(storey.third_slope));
    let first = vy / k;
    let elements = if omega == one {
        vec![((one - r3) * k, first)]
    } else if r2 == R::zero() {
        vec![(k, first)]
    } else {
        vec![((one - r2) * k, first), ((r2 - r3) * k, first + (omega - one) * vy / (r2 * k))]
    };
    Masing::new(elements.into_iter().filter(|&(stiffness, _)| stiffness > R::zero()), r3 * k)
}
