//! Arrays of vectors.

use crate::lanes::vector::{Vector, WIDTH};
use crate::lanes::width::MAX_LANES;

/// What vectors are read from and written to.
pub(crate) trait Lanes {
    /// The first `K` vectors; none where there are fewer.
    fn vectors<const K: usize>(&self) -> Option<&[[f64; WIDTH]; K]>;
    /// The same to be changed.
    fn vectors_mut<const K: usize>(&mut self) -> Option<&mut [[f64; WIDTH]; K]>;
}

impl Lanes for [f64] {
    #[inline(always)]
    fn vectors<const K: usize>(&self) -> Option<&[[f64; WIDTH]; K]> {
        lanes(self).first_chunk()
    }

    #[inline(always)]
    fn vectors_mut<const K: usize>(&mut self) -> Option<&mut [[f64; WIDTH]; K]> {
        lanes_mut(self).first_chunk_mut()
    }
}

/// Vectors of padded values.
#[inline(always)]
pub(crate) fn lanes(values: &[f64]) -> &[[f64; WIDTH]] {
    values.as_chunks::<WIDTH>().0
}

#[inline(always)]
pub(crate) fn lanes_mut(values: &mut [f64]) -> &mut [[f64; WIDTH]] {
    values.as_chunks_mut::<WIDTH>().0
}

/// Vector `k` of padded values.
#[inline(always)]
pub(crate) fn at<V: Vector>(values: &[f64], k: usize) -> V {
    V::load(&lanes(values)[k])
}

/// The first `K` vectors of padded values; zeros where there are fewer.
#[inline(always)]
pub(crate) fn load<V: Vector, const K: usize>(values: &(impl Lanes + ?Sized)) -> [V; K] {
    let mut vectors = [V::splat(0.0); K];
    if let Some(lanes) = values.vectors::<K>() {
        for k in 0..K {
            vectors[k] = V::load(&lanes[k]);
        }
    }
    vectors
}

/// The vectors of storey `i`, of at most [`MAX_LANES`], alone: 1 in its lane, 0 elsewhere. They are read from one place for
/// all: a vector read where a number has just been written waits for it to arrive in memory.
#[inline(always)]
pub(crate) fn unit<V: Vector, const K: usize>(i: usize) -> [V; K] {
    static UNIT: [f64; 2 * MAX_LANES] = {
        let mut values = [0.0; 2 * MAX_LANES];
        values[MAX_LANES] = 1.0;
        values
    };
    load(&UNIT[MAX_LANES - i..])
}

/// Puts vectors into padded values, if these hold as many.
#[inline(always)]
pub(crate) fn store<V: Vector, const K: usize>(vectors: &[V; K], values: &mut (impl Lanes + ?Sized)) {
    if let Some(lanes) = values.vectors_mut::<K>() {
        for k in 0..K {
            vectors[k].store(&mut lanes[k]);
        }
    }
}

/// Vectors as numbers.
#[inline(always)]
pub(crate) fn numbers<V: Vector, const K: usize>(vectors: &[V; K]) -> [[f64; WIDTH]; K] {
    let mut out = [[0.0; WIDTH]; K];
    for k in 0..K {
        vectors[k].store(&mut out[k]);
    }
    out
}

/// Padded columns, one after the other.
#[inline(always)]
pub(crate) fn columns_of<const K: usize>(values: &[f64]) -> &[[[f64; WIDTH]; K]] {
    values.as_chunks::<WIDTH>().0.as_chunks::<K>().0
}

/// Differences between each lane and that below it; the lowest keeps `bottom` below it.
#[inline(always)]
pub(crate) fn differences<V: Vector, const K: usize>(values: &[V; K], bottom: V) -> [V; K] {
    let mut out = *values;
    for k in 0..K {
        let before = if k > 0 { values[k - 1] } else { bottom };
        out[k] = values[k].sub(values[k].shifted_up(before));
    }
    out
}

/// Sums of each lane and all below it.
#[inline(always)]
pub(crate) fn prefix_sums<V: Vector, const K: usize>(values: &[V; K]) -> [V; K] {
    let zero = V::splat(0.0);
    let mut out = *values;
    for k in 0..K {
        let pairs = values[k].add(values[k].shifted_up(zero));
        out[k] = pairs.add(pairs.shifted_up(zero).shifted_up(zero));
        if k > 0 {
            out[k] = out[k].add(out[k - 1].broadcast(WIDTH - 1));
        }
    }
    out
}
