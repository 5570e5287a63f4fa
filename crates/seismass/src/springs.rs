//! The spring laws, one file each, and the choice among them.

mod gap;
mod masing;
mod peak_oriented;

use gap::Gap;
pub(crate) use masing::Element;
use masing::Masing;
use peak_oriented::PeakOriented;

use crate::scene::{self, Storey};
use crate::segment::{Backbone, Crossing, Segment, SpringMachine};
use crate::sign::Sign;

/// The laws: an enum of them that is one itself.
macro_rules! laws {
    ($($law:ident),*) => {
        /// A spring of any law.
        #[derive(Debug, Clone, PartialEq)]
        pub(crate) enum Spring {
            $($law($law),)*
        }

        impl SpringMachine for Spring {
            laws! { @by_law [$($law)*]
                segment(&self) -> Segment;
                end(&mut self, x: f64, sign: Sign) -> Crossing;
                turn(&mut self, x: f64) -> Crossing;
                stored(&self, x: f64, geometric: f64) -> f64;
                dissipated(&self, x: f64, change: f64) -> f64;
                state_name(&self) -> &'static str;
                backbone(&self) -> Backbone;
                tangents(&self) -> Option<Vec<f64>>;
                largest_tangent(&self) -> f64;
                can_yield(&self) -> bool;
                parameters(&self) -> Vec<f64>;
            }
        }
    };
    (@by_law $laws:tt $($name:ident($($of:tt)*) -> $result:ty;)*) => {
        $(laws! { @method $laws $name [$($of)*] $result })*
    };
    (@method $laws:tt $name:ident [&self $(, $value:ident: $type:ty)*] $result:ty) => {
        fn $name(&self $(, $value: $type)*) -> $result {
            laws! { @match $laws self $name ($($value),*) }
        }
    };
    (@method $laws:tt $name:ident [&mut self $(, $value:ident: $type:ty)*] $result:ty) => {
        fn $name(&mut self $(, $value: $type)*) -> $result {
            laws! { @match $laws self $name ($($value),*) }
        }
    };
    (@match [$($law:ident)*] $of:ident $name:ident $values:tt) => {
        match $of {
            $(Self::$law(law) => law.$name $values,)*
        }
    };
}

laws!(Masing, Gap, PeakOriented);

impl Spring {
    /// The virgin spring of a storey.
    pub(crate) fn new(storey: &Storey) -> Self {
        match &storey.law {
            scene::SpringLaw::Multilinear { backbone } => Self::Masing(Masing::multilinear(backbone)),
            &scene::SpringLaw::Gap { clearance, stop_stiffness } => {
                Self::Gap(Gap::new(Masing::trilinear(storey), clearance, stop_stiffness))
            }
            scene::SpringLaw::PeakOriented(law) if storey.yield_shear.is_finite() => {
                Self::PeakOriented(PeakOriented::new(storey, law))
            }
            _ => Self::Masing(Masing::trilinear(storey)),
        }
    }

    /// The elements of a spring that consists of nothing else.
    pub(crate) fn elements(&self) -> &[Element] {
        if let Self::Masing(law) = self { law.elements() } else { &[] }
    }
}
