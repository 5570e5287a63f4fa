//! What can happen to a machine, and what it leads to.

use crate::machines::sign::Sign;

/// What happens when a guard falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Guard {
    /// A storey comes to an end of its spring's segment.
    SegmentEnd { storey: usize, sign: Sign },
    /// A storey reaches its collapse drift.
    Collapse { storey: usize },
    /// A storey's velocity turns, where the segment of its spring does not allow it.
    Turn { storey: usize },
    /// A block stuck to a floor (0: the ground) breaks away, with this sign of the floor acceleration.
    Breakaway { floor: usize, sign: Sign },
    /// A sliding block comes to rest.
    Arrival { block: usize },
    /// The friction coefficients of a sliding block change.
    Wear { block: usize },
    /// The contact force of all blocks vanishes or returns.
    Contact,
}

impl Guard {
    /// All of it in one number, not zero: its kind, its sign and what it belongs to.
    #[inline(always)]
    pub(crate) fn packed(self) -> u64 {
        let (kind, sign, number) = match self {
            Self::SegmentEnd { storey, sign } => (1, sign, storey),
            Self::Collapse { storey } => (2, Sign::Positive, storey),
            Self::Turn { storey } => (3, Sign::Positive, storey),
            Self::Breakaway { floor, sign } => (4, sign, floor),
            Self::Arrival { block } => (5, Sign::Positive, block),
            Self::Wear { block } => (6, Sign::Positive, block),
            Self::Contact => (7, Sign::Positive, 0),
        };
        kind | u64::from(sign == Sign::Negative) << 8 | (number as u64) << 16
    }

    /// The guard that is packed like this; none for zero.
    #[inline(always)]
    pub(crate) fn unpacked(packed: u64) -> Option<Self> {
        let sign = if packed >> 8 & 1 == 0 { Sign::Positive } else { Sign::Negative };
        let number = (packed >> 16) as usize;
        match packed & 0xff {
            1 => Some(Self::SegmentEnd { storey: number, sign }),
            2 => Some(Self::Collapse { storey: number }),
            3 => Some(Self::Turn { storey: number }),
            4 => Some(Self::Breakaway { floor: number, sign }),
            5 => Some(Self::Arrival { block: number }),
            6 => Some(Self::Wear { block: number }),
            7 => Some(Self::Contact),
            _ => None,
        }
    }

    /// Whether nothing jumps at its event: forces and accelerations go on from where they are.
    pub(crate) fn is_smooth(self) -> bool {
        matches!(self, Self::SegmentEnd { .. } | Self::Turn { .. })
    }
}

/// What an event leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Outcome {
    /// The run goes on.
    Continue,
    /// A storey (from 0) has collapsed.
    Collapse(usize),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guards_are_packed_without_loss() {
        let mut guards = vec![Guard::Contact];
        for number in [0, 1, 65_536, 1 << 40] {
            guards.extend([Guard::Collapse { storey: number }, Guard::Turn { storey: number }]);
            guards.extend([Guard::Arrival { block: number }, Guard::Wear { block: number }]);
            for sign in [Sign::Positive, Sign::Negative] {
                guards.extend([Guard::SegmentEnd { storey: number, sign }, Guard::Breakaway { floor: number, sign }]);
            }
        }
        for guard in guards {
            assert_eq!(Guard::unpacked(guard.packed()), Some(guard));
        }
        assert_eq!(Guard::unpacked(0), None);
    }
}
