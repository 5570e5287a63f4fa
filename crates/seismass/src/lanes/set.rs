//! Storeys or floors as bits.

/// Storeys or floors as bits.
pub(crate) type Set = u64;

/// The set of the first so many storeys, or of all that a set holds.
#[inline]
pub(crate) fn first_members(storeys: usize) -> Set {
    if storeys < Set::BITS as usize { (1 << storeys) - 1 } else { Set::MAX }
}

/// The members of a set, in order.
#[inline(always)]
pub(crate) fn members(mut set: Set) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (set != 0).then(|| set.trailing_zeros() as usize);
        set &= set.wrapping_sub(1);
        lowest
    })
}

/// Four bits, each followed by a zero.
#[inline(always)]
pub(crate) fn spread(bits: u32) -> Set {
    Set::from(bits & 1 | (bits & 2) << 1 | (bits & 4) << 2 | (bits & 8) << 3)
}
