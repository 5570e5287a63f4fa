//! Numbers of storeys or floors, padded to whole vectors.

use std::ops::{Deref, DerefMut};

use crate::lanes::aligned::Aligned;
use crate::lanes::arrays::{Lanes, at, columns_of, lanes_mut};
use crate::lanes::padded;
use crate::lanes::vector::{Vector, WIDTH};

/// The vector that the number of storey `i` lies in, of a scene of `K` vectors.
#[inline(always)]
pub(crate) fn vector_of<const K: usize>(i: usize) -> usize {
    if K == 1 { 0 } else { i / WIDTH }
}

/// A number of each storey or floor, padded. Those of one vector are kept in place: what reads them as one need not ask how
/// many there are, and a run of a small building allocates nothing for them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Padded {
    few: [f64; WIDTH],
    /// Those of more than one vector; empty where one holds them.
    many: Vec<f64>,
}

impl Padded {
    /// The same number `width` times, padding included.
    pub(crate) fn new(width: usize, value: f64) -> Self {
        if width <= WIDTH {
            Self { few: [value; WIDTH], many: Vec::new() }
        } else {
            Self { few: [0.0; WIDTH], many: vec![value; width] }
        }
    }

    /// Values of so many storeys, and what stands beyond the last.
    pub(crate) fn filled(values: impl IntoIterator<Item = f64>, storeys: usize, padding: f64) -> Self {
        let mut out = Self::new(padded(storeys), padding);
        out.iter_mut().zip(values).for_each(|(out, value)| *out = value);
        out
    }

    /// The numbers of a scene of `K` vectors: where that is known, nothing has to be asked.
    #[inline(always)]
    pub(crate) fn numbers<const K: usize>(&self) -> &[f64] {
        if K == 1 { &self.few } else { &self.many }
    }

    /// The same to be changed.
    #[inline(always)]
    pub(crate) fn numbers_mut<const K: usize>(&mut self) -> &mut [f64] {
        if K == 1 { &mut self.few } else { &mut self.many }
    }

    /// Vector `k` of a scene of `K` vectors.
    #[inline(always)]
    pub(crate) fn vector<V: Vector, const K: usize>(&self, k: usize) -> V {
        if K == 1 { V::load(&self.few) } else { at(&self.many, k) }
    }

    /// Puts the number of storey `i` of a scene of `K` vectors with the others of its vector, which is read as a whole soon:
    /// read after a number alone was written, it would wait until that is in memory.
    #[inline(always)]
    pub(crate) fn set_lane<V: Vector, const K: usize>(&mut self, i: usize, value: f64) {
        let k = vector_of::<K>(i);
        self.set_vector::<V, K>(k, self.vector::<V, K>(k).with_lane(i % WIDTH, value));
    }

    /// The number of storey `i` of a scene of `K` vectors, which becomes 0.
    #[inline(always)]
    pub(crate) fn take_lane<V: Vector, const K: usize>(&mut self, i: usize) -> f64 {
        let value = self.numbers::<K>()[i];
        self.set_lane::<V, K>(i, 0.0);
        value
    }

    /// Puts vector `k` of a scene of `K` vectors.
    #[inline(always)]
    pub(crate) fn set_vector<V: Vector, const K: usize>(&mut self, k: usize, values: V) {
        values.store(if K == 1 { &mut self.few } else { &mut lanes_mut(&mut self.many)[k] });
    }
}

impl Deref for Padded {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        if self.many.is_empty() { &self.few } else { &self.many }
    }
}

impl DerefMut for Padded {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        if self.many.is_empty() { &mut self.few } else { &mut self.many }
    }
}

impl<'a> IntoIterator for &'a Padded {
    type Item = &'a f64;
    type IntoIter = std::slice::Iter<'a, f64>;

    #[inline(always)]
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl Lanes for Padded {
    #[inline(always)]
    fn vectors<const K: usize>(&self) -> Option<&[[f64; WIDTH]; K]> {
        if K == 1 { std::slice::from_ref(&self.few).first_chunk() } else { self.many.vectors() }
    }

    #[inline(always)]
    fn vectors_mut<const K: usize>(&mut self) -> Option<&mut [[f64; WIDTH]; K]> {
        if K == 1 { std::slice::from_mut(&mut self.few).first_chunk_mut() } else { self.many.vectors_mut() }
    }
}

/// `R` rows of numbers of storeys or floors, padded; those of one vector are kept in place, as in [`Padded`].
#[derive(Debug)]
pub(crate) struct PaddedRows<const R: usize> {
    few: [[f64; WIDTH]; R],
    /// Rows of more than one vector, one after the other; empty where one holds them.
    many: Aligned,
    width: usize,
}

impl<const R: usize> PaddedRows<R> {
    /// Zeros.
    pub(crate) fn zeros(width: usize) -> Self {
        let of_many = if width > WIDTH { R * width } else { 0 };
        Self { few: [[0.0; WIDTH]; R], many: Aligned::zeros(of_many), width: width.max(WIDTH) }
    }

    /// A row.
    #[inline(always)]
    pub(crate) fn row(&self, row: usize) -> &[f64] {
        if self.many.is_empty() { &self.few[row] } else { &self.many[row * self.width..][..self.width] }
    }

    /// All rows, one after the other.
    #[inline(always)]
    pub(crate) fn numbers_mut(&mut self) -> &mut [f64] {
        if self.many.is_empty() { self.few.as_flattened_mut() } else { &mut self.many }
    }

    /// The same, not to be changed.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> &[f64] {
        if self.many.is_empty() { self.few.as_flattened() } else { &self.many }
    }

    /// The rows of a scene of `K` vectors.
    #[inline(always)]
    pub(crate) fn vectors<const K: usize>(&self) -> &[[[f64; WIDTH]; K]] {
        if K == 1 { self.few.as_chunks().0 } else { columns_of(&self.many) }
    }

    /// The same to be changed.
    #[inline(always)]
    pub(crate) fn vectors_mut<const K: usize>(&mut self) -> &mut [[[f64; WIDTH]; K]] {
        if K == 1 { self.few.as_chunks_mut().0 } else { lanes_mut(&mut self.many).as_chunks_mut().0 }
    }

    /// One storey's numbers by row, of a scene of `K` vectors.
    #[inline(always)]
    pub(crate) fn storey<const K: usize>(&self, i: usize) -> OfStorey<'_, K> {
        OfStorey { few: &self.few, many: &self.many, width: self.width, storey: i }
    }
}

impl<const R: usize> Default for PaddedRows<R> {
    fn default() -> Self {
        Self::zeros(WIDTH)
    }
}

/// A storey's numbers by row.
#[derive(Clone, Copy)]
pub(crate) struct OfStorey<'a, const K: usize> {
    few: &'a [[f64; WIDTH]],
    many: &'a [f64],
    width: usize,
    storey: usize,
}

impl<'a, const K: usize> OfStorey<'a, K> {
    /// Of rows of one vector, however many others have.
    #[inline(always)]
    pub(crate) fn of_few(few: &'a [[f64; WIDTH]], storey: usize) -> Self {
        Self { few, many: few.as_flattened(), width: WIDTH, storey }
    }

    /// The number in a row.
    #[inline(always)]
    pub(crate) fn at(&self, row: usize) -> f64 {
        if K == 1 { self.few[row][self.storey % WIDTH] } else { self.many[row * self.width + self.storey] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{MAX_LANES, Plain, by_width, for_each_path, load, numbers, store};

    for_each_path! {
        fn set_lane[K: usize](numbers: &mut Padded, i: usize, value: f64) = set_lane_by_path
    }

    #[inline(always)]
    fn set_lane_by_path<V: Vector, const K: usize>(numbers: &mut Padded, i: usize, value: f64) {
        numbers.set_lane::<V, K>(i, value);
    }

    #[test]
    fn a_number_is_put_and_the_others_stay() {
        for storeys in [1, 3, 4, 5, 8, 13, 48] {
            let before = Padded::filled((0..storeys).map(|i| 1.0 + i as f64), storeys, -1.0);
            for i in 0..storeys {
                for value in [-0.0, 0.5, f64::INFINITY, f64::NAN] {
                    let (mut found, mut plain, mut expected) = (before.clone(), before.clone(), before.to_vec());
                    expected[i] = value;
                    by_width!(padded(storeys), K => {
                        set_lane::<K>(&mut found, i, value);
                        plain.set_lane::<Plain, K>(i, value);
                    });
                    let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
                    assert_eq!(bits(&found), bits(&expected), "{storeys} storeys, {i}");
                    assert_eq!(bits(&plain), bits(&expected), "{storeys} storeys, {i}");
                }
            }
        }
    }

    #[test]
    fn numbers_are_the_same_in_place_and_apart() {
        for storeys in [0, 1, 4, 5, 8, 13, 48, 51] {
            let values = (0..storeys).map(|i| 1.0 + i as f64);
            let expected: Vec<f64> = values.clone().chain(std::iter::repeat(-1.0)).take(padded(storeys)).collect();
            let mut found = Padded::filled(values, storeys, -1.0);
            assert_eq!(&found[..], expected, "{storeys} storeys");
            assert_eq!((&found).into_iter().count(), padded(storeys));
            by_width!(padded(storeys), K => {
                let vectors: [Plain; K] = load(&found);
                assert_eq!(numbers(&vectors).as_flattened(), &expected[..WIDTH * K]);
                found.set_vector::<Plain, K>(K - 1, vectors[0]);
                assert_eq!(numbers(&[found.vector::<Plain, K>(K - 1)])[0], expected[..WIDTH]);
                store(&vectors, &mut found);
                assert_eq!(&found[..], expected);
            });
        }
    }

    #[test]
    fn rows_are_the_same_in_place_and_apart() {
        for storeys in [1, 4, 5, 32, 51] {
            let width = padded(storeys);
            let mut rows = PaddedRows::<3>::zeros(width);
            assert_eq!(rows.numbers(), vec![0.0; 3 * width]);
            for (i, value) in rows.numbers_mut().iter_mut().enumerate() {
                *value = i as f64;
            }
            for row in 0..3 {
                assert_eq!(rows.row(row), (row * width..(row + 1) * width).map(|i| i as f64).collect::<Vec<_>>());
                by_width!(width, K => assert_eq!(rows.storey::<K>(storeys - 1).at(row), (row * width + storeys - 1) as f64));
            }
            if width <= MAX_LANES {
                by_width!(width, K => {
                    assert_eq!(rows.vectors::<K>().as_flattened().as_flattened(), rows.numbers());
                    rows.vectors_mut::<K>()[2][0][1] = -1.0;
                });
                assert_eq!(rows.row(2)[1], -1.0);
            }
        }
        let ground = [[2.0, 0.0, 0.0, 0.0], [3.0, 0.0, 0.0, 0.0]];
        assert_eq!((OfStorey::<1>::of_few(&ground, 0).at(1), OfStorey::<2>::of_few(&ground, 0).at(1)), (3.0, 3.0));
    }
}
