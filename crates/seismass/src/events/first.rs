//! The first fall of a guard within a series.

use crate::lanes::{Vector, for_each_path};
use crate::machines::guard::Guard;
use crate::polynomial::power::Polynomial;

for_each_path! {
    /// The place of [`Polynomial::first_fall`]; infinite where there is none.
    fn first_fall(polynomial: &Polynomial, tolerance: f64) -> f64 = first_fall_by_path
}

#[inline(always)]
fn first_fall_by_path<V: Vector>(polynomial: &Polynomial, tolerance: f64) -> f64 {
    polynomial.first_fall::<V>(tolerance).unwrap_or(f64::INFINITY)
}

/// The first fall within a series, or none.
///
/// Its guard is packed: a copy of parts that have just been written, each by itself, would wait until they are in memory.
#[derive(Clone, Copy)]
pub(crate) struct First {
    pub(crate) place: f64,
    guard: u64,
}

impl First {
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self { place: f64::INFINITY, guard: 0 }
    }

    #[inline(always)]
    pub(crate) fn at(place: f64, guard: Guard) -> Self {
        Self { place, guard: guard.packed() }
    }

    #[inline(always)]
    pub(crate) fn is_none(self) -> bool {
        self.guard == 0
    }

    /// Where it is in [0, 1]; the end, 1, where there is none.
    #[inline(always)]
    pub(crate) fn place(self) -> f64 {
        if self.is_none() { 1.0 } else { self.place }
    }

    #[inline(always)]
    pub(crate) fn guard(self) -> Option<Guard> {
        Guard::unpacked(self.guard)
    }

    #[inline(always)]
    pub(crate) fn consider(&mut self, guard: Guard, polynomial: &Polynomial, tolerance: f64) {
        let place = first_fall(polynomial, tolerance);
        if place < self.place {
            *self = Self::at(place, guard);
        }
    }
}
