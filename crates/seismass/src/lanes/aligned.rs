//! Numbers that begin at a cache line.

use std::cell::RefCell;
use std::ops::{Deref, DerefMut};

/// Numbers that begin at a cache line: no vector of them lies across two.
///
/// Their memory is kept by the thread for the next ones: regimes come and go by the thousand, and memory that goes back
/// to the system returns page by page, each page at the cost of an event.
#[derive(Debug, Default)]
pub(crate) struct Aligned {
    values: Vec<f64>,
    offset: usize,
}

/// Most numbers that a thread keeps memory for; beyond that it lets all of it go.
const MOST_SPARE: usize = 1 << 20;

/// Memory kept by a thread, by class of its capacity.
#[derive(Default)]
struct Spare {
    by_class: Vec<Vec<Vec<f64>>>,
    numbers: usize,
}

thread_local! {
    static SPARE: RefCell<Spare> = RefCell::default();
}

impl Spare {
    /// The class of so many numbers, and its capacity: there are four within each power of two.
    fn class(length: usize) -> (usize, usize) {
        let step = (length.next_power_of_two() / 8).max(1);
        let steps = length.div_ceil(step);
        (4 * step.ilog2() as usize + steps, steps * step)
    }

    fn take(&mut self, class: usize) -> Option<Vec<f64>> {
        let values = self.by_class.get_mut(class)?.pop()?;
        self.numbers -= values.capacity();
        Some(values)
    }

    fn keep(&mut self, values: Vec<f64>) {
        let capacity = values.capacity();
        if capacity > MOST_SPARE {
            return;
        }
        if self.numbers + capacity > MOST_SPARE {
            *self = Self::default();
        }
        self.numbers += capacity;
        let (class, _) = Self::class(capacity);
        if self.by_class.len() <= class {
            self.by_class.resize_with(class + 1, Vec::new);
        }
        self.by_class[class].push(values);
    }
}

impl Aligned {
    /// So many zeros.
    pub(crate) fn zeros(length: usize) -> Self {
        let mut zeros = Self::unset(length);
        zeros.fill(0.0);
        zeros
    }

    /// So many numbers, any, each of which is to be set.
    pub(crate) fn unset(length: usize) -> Self {
        const LINE: usize = 64;
        let slack = LINE / size_of::<f64>() - 1;
        if length == 0 {
            return Self::default();
        }
        let (class, capacity) = Spare::class(length + slack);
        let kept = SPARE.try_with(|spare| spare.borrow_mut().take(class)).ok().flatten();
        let mut values = kept.unwrap_or_else(|| Vec::with_capacity(capacity));
        let offset = values.as_ptr().align_offset(LINE).min(slack);
        values.resize(offset + length, 0.0);
        if cfg!(debug_assertions) {
            // What is read before it is set shows.
            values.fill(f64::NAN);
        }
        Self { values, offset }
    }
}

impl Drop for Aligned {
    fn drop(&mut self) {
        if self.values.capacity() > 0 {
            let values = std::mem::take(&mut self.values);
            // Without the thread's store, at its end, memory is simply freed.
            let _ = SPARE.try_with(|spare| spare.borrow_mut().keep(values));
        }
    }
}

impl Deref for Aligned {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        &self.values[self.offset..]
    }
}

impl DerefMut for Aligned {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.offset..]
    }
}

/// At the start of a cache line: no vector of it lies across two.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct OnLine<T>(pub(crate) T);

impl<T> Deref for OnLine<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}
