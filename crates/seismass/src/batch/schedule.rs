//! Who solves what: groups of runs that share regimes, dealt to threads until all are done at the same time.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Runs that no thread has begun. A thread takes a group as a whole, so that what its runs share is formed once; when
/// no group is left, it takes half of what another thread has yet to begin, and at the end no thread waits for longer
/// than one run.
pub(crate) struct Schedule<'a> {
    groups: &'a [Range<usize>],
    /// The group that the next thread takes.
    next: AtomicUsize,
    parts: Vec<Mutex<Part>>,
    /// Number of runs that no thread has begun.
    waiting: AtomicUsize,
}

/// What a thread has yet to begin of its group.
#[derive(Default)]
struct Part {
    group: usize,
    places: Range<usize>,
}

impl<'a> Schedule<'a> {
    /// Groups as ranges of places, for so many threads.
    pub(crate) fn new(groups: &'a [Range<usize>], threads: usize) -> Self {
        Self {
            groups,
            next: AtomicUsize::new(0),
            parts: (0..threads).map(|_| Mutex::default()).collect(),
            waiting: AtomicUsize::new(groups.iter().map(Range::len).sum()),
        }
    }

    /// Group and place of the run that a thread solves next; none when all are begun.
    pub(crate) fn next_of(&self, thread: usize) -> Option<(usize, usize)> {
        loop {
            let mut part = self.part(thread);
            if let Some(place) = part.places.next() {
                self.waiting.fetch_sub(1, Ordering::Relaxed);
                return Some((part.group, place));
            }
            drop(part);
            if self.waiting.load(Ordering::Relaxed) == 0 {
                return None;
            }
            match self.next_group().or_else(|| self.half_of_another()) {
                Some(part) => *self.part(thread) = part,
                // What is left is on its way from one thread to another.
                None => std::thread::yield_now(),
            }
        }
    }

    fn next_group(&self) -> Option<Part> {
        let group = self.next.fetch_add(1, Ordering::Relaxed);
        self.groups.get(group).map(|places| Part { group, places: places.clone() })
    }

    /// The second half of the longest part.
    fn half_of_another(&self) -> Option<Part> {
        let longest = (0..self.parts.len()).max_by_key(|&thread| self.part(thread).places.len())?;
        let mut part = self.part(longest);
        let (group, left) = (part.group, part.places.clone());
        part.places.end = left.start + left.len() / 2;
        (!left.is_empty()).then(|| Part { group, places: part.places.end..left.end })
    }

    /// Nothing panics while a part is locked.
    fn part(&self, thread: usize) -> MutexGuard<'_, Part> {
        self.parts[thread].lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_belongs_to_one_thread_until_none_is_left() {
        let groups = [0..6, 6..8];
        let schedule = Schedule::new(&groups, 2);
        let next = |thread| schedule.next_of(thread);
        assert_eq!([0, 1, 0, 1].map(next), [(0, 0), (1, 6), (0, 1), (1, 7)].map(Some));
        // Four are left of the first group: the second thread takes two of them.
        assert_eq!([1, 0, 1, 0].map(next), [4, 2, 5, 3].map(|place| Some((0, place))));
        assert_eq!([0, 1].map(next), [None, None]);
    }

    #[test]
    fn threads_share_a_single_group_run_by_run() {
        let group = 0..100;
        let schedule = &Schedule::new(std::slice::from_ref(&group), 4);
        let begun = |thread: usize| std::iter::from_fn(move || schedule.next_of(thread)).map(|(_, place)| place);
        let mut places = std::thread::scope(|scope| {
            let threads = [0, 1, 2, 3].map(|thread| scope.spawn(move || begun(thread).collect::<Vec<_>>()));
            threads.into_iter().flat_map(|thread| thread.join().unwrap_or_default()).collect::<Vec<_>>()
        });
        places.sort_unstable();
        assert_eq!(places, group.clone().collect::<Vec<_>>());
    }

    #[test]
    fn nothing_to_do_is_done() {
        assert_eq!(Schedule::new(&[], 1).next_of(0), None);
    }
}
