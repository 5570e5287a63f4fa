//! Numbers of equal keys.

use std::collections::HashMap;
use std::hash::Hash;

use rustc_hash::FxHashMap;

/// Numbers equal keys alike, in order of first appearance.
pub(crate) struct Classes<K>(FxHashMap<K, usize>);

impl<K> Default for Classes<K> {
    fn default() -> Self {
        Self(HashMap::default())
    }
}

impl<K: Hash + Eq> Classes<K> {
    pub(crate) fn number_owned(&mut self, key: K) -> usize {
        let next = self.0.len();
        *self.0.entry(key).or_insert(next)
    }
}

impl Classes<Box<[u64]>> {
    pub(crate) fn number(&mut self, key: &[u64]) -> usize {
        match self.0.get(key) {
            Some(&number) => number,
            None => self.number_owned(key.into()),
        }
    }
}
