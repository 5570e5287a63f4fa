//! The spring laws, one file each, and the choice among them.

mod flag_shaped;
mod gap;
mod masing;
mod peak_oriented;

use crate::machines::segment::SpringMachine;
use crate::scene::{self, Storey};

use flag_shaped::FlagShaped;
use gap::Gap;
use masing::Masing;
use peak_oriented::PeakOriented;

pub(crate) use masing::Element;

/// A spring of any law.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Spring {
    Masing(Masing),
    Gap(Gap),
    PeakOriented(PeakOriented),
    FlagShaped(FlagShaped),
}

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
            &scene::SpringLaw::FlagShaped { flag_height } => Self::FlagShaped(FlagShaped::new(storey, flag_height)),
            _ => Self::Masing(Masing::trilinear(storey)),
        }
    }

    /// Its law: all that the run knows of it.
    pub(crate) fn law(&self) -> &dyn SpringMachine {
        match self {
            Self::Masing(law) => law,
            Self::Gap(law) => law,
            Self::PeakOriented(law) => law,
            Self::FlagShaped(law) => law,
        }
    }

    pub(crate) fn law_mut(&mut self) -> &mut dyn SpringMachine {
        match self {
            Self::Masing(law) => law,
            Self::Gap(law) => law,
            Self::PeakOriented(law) => law,
            Self::FlagShaped(law) => law,
        }
    }

    /// The elements of a spring that consists of nothing else.
    pub(crate) fn elements(&self) -> &[Element] {
        if let Self::Masing(law) = self { law.elements() } else { &[] }
    }
}
