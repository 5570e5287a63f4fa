//! The key of a regime: the tuple of all machines' states.

use crate::machines::model::Model;

/// Bits of a word.
pub(crate) const WORD: usize = u64::BITS as usize;

/// Sets the bits of a mask, from bit `first` on, which do not lie across two words.
#[inline]
fn set_bits(words: &mut [u64], first: usize, mask: u64, bits: u64) {
    let (word, shift) = (&mut words[first / WORD], first % WORD);
    *word = *word & !(mask << shift) | bits << shift;
}

/// The key of the present regime, its place in the cache, and how often it was changed.
#[derive(Debug)]
pub(crate) struct RegimeKey {
    /// Class of each storey's segment, in [`Model::class_bits`] each, and which blocks are stuck.
    pub(crate) words: Vec<u64>,
    /// Index of the regime in the cache.
    pub(crate) entry: usize,
    /// Different regimes entered by this run, and changes into a regime already known to it.
    pub(crate) entered: (usize, usize),
}

impl RegimeKey {
    pub(crate) fn new(model: &Model) -> Self {
        let words = vec![0; (model.class_bits * model.storeys() + model.blocks.len()).div_ceil(WORD)];
        Self { words, entry: 0, entered: (0, 0) }
    }

    /// Notes the class of storey `i`'s segment, or the bits of its tangent where these are the class.
    #[inline(always)]
    pub(crate) fn set_class(&mut self, bits: usize, i: usize, class: u64) {
        set_bits(&mut self.words, bits * i, u64::MAX >> (WORD - bits), class);
    }

    /// Notes whether block `j` is stuck, of a model with so many bits of storeys.
    #[inline(always)]
    pub(crate) fn set_stuck(&mut self, of_storeys: usize, j: usize, is_stuck: bool) {
        set_bits(&mut self.words, of_storeys + j, 1, u64::from(is_stuck));
    }
}
