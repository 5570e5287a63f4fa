//! Whether there is memory for what a run keeps.

use std::hint::black_box;

/// Whether there is memory for so many numbers. To ask has glibc keep it from run to run: it does so once it has seen as
/// much in one piece (`mallopt`, `M_TRIM_THRESHOLD`), up to 32 MB, and gives several smaller pieces back to the system each
/// time. New pages cost more than the run.
pub(crate) fn is_there_memory(numbers: usize) -> bool {
    let mut room = Vec::<f64>::new();
    let is_there = room.try_reserve_exact(numbers).is_ok();
    // Room that nobody sees may be left out by the compiler, and taken for granted.
    black_box(&mut room);
    is_there
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_asked_for_before_it_is_taken() {
        assert!(is_there_memory(0) && is_there_memory(1000) && !is_there_memory(1 << 58));
    }
}
