//! The direction of a force or a velocity.

use crate::real::Real;

/// Direction of a force or a velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sign {
    Positive,
    Negative,
}

impl Sign {
    /// Sign of a value; zero counts as positive.
    pub(crate) fn of<R: Real>(value: R) -> Self {
        if value < R::zero() { Self::Negative } else { Self::Positive }
    }

    pub(crate) fn times<R: Real>(self, value: R) -> R {
        match self {
            Self::Positive => value,
            Self::Negative => -value,
        }
    }

    pub(crate) fn opposite(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }

    pub(crate) fn as_i8(self) -> i8 {
        match self {
            Self::Positive => 1,
            Self::Negative => -1,
        }
    }
}
