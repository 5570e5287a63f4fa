//! Symmetric matrices for products with vectors: half of each is stored, in tiles that are read once per product, both
//! for their own rows and, transposed, for those of the other half.

use crate::lanes::aligned::Aligned;
use crate::lanes::vector::{Vector, WIDTH};

/// `M` symmetric matrices of one size, read together.
#[derive(Debug)]
pub(crate) struct Symmetric<const M: usize> {
    /// Tiles along the diagonal.
    count: usize,
    /// Tiles on the diagonal and right of it, row of tiles by row of tiles; by row of the tile, by matrix.
    tiles: Aligned,
}

impl<const M: usize> Symmetric<M> {
    /// From the entries on and above the diagonal: `entries(i, j)` with i <= j gives those of all matrices.
    pub(crate) fn new(size: usize, entries: impl Fn(usize, usize) -> [f64; M]) -> Self {
        let count = size.div_ceil(WIDTH);
        let mut tiles = Aligned::zeros(count * (count + 1) / 2 * WIDTH * M * WIDTH);
        let places = (0..count).flat_map(|row| (row..count).map(move |column| (WIDTH * row, WIDTH * column)));
        for (tile, (row, column)) in tiles.chunks_exact_mut(WIDTH * M * WIDTH).zip(places) {
            for (r, lines) in tile.chunks_exact_mut(M * WIDTH).enumerate() {
                for c in (0..WIDTH).filter(|c| row + r < size && column + c < size) {
                    let (i, j) = (row + r, column + c);
                    for (which, entry) in entries(i.min(j), i.max(j)).into_iter().enumerate() {
                        lines[which * WIDTH + c] = entry;
                    }
                }
            }
        }
        Self { count, tiles }
    }

    /// Memory taken (bytes).
    pub(crate) fn bytes(&self) -> usize {
        8 * self.tiles.len()
    }
}

/// Each lane of a vector in all lanes of one.
#[inline(always)]
fn lanes_apart<V: Vector>(values: &[f64; WIDTH]) -> [V; WIDTH] {
    let mut out = [V::splat(0.0); WIDTH];
    for lane in 0..WIDTH {
        out[lane] = V::splat(values[lane]);
    }
    out
}

/// Adds the sum of each vector to its place.
#[inline(always)]
fn add_sums<V: Vector>(sums: &[V; WIDTH], out: &mut [f64; WIDTH]) {
    for r in 0..WIDTH {
        out[r] += sums[r].sum();
    }
}

impl Symmetric<1> {
    /// out = matrix * x, both padded to whole vectors or more, with zeros.
    #[inline(always)]
    pub(crate) fn multiply<V: Vector>(&self, x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        let (x, out) = (&x.as_chunks::<WIDTH>().0[..self.count], &mut out.as_chunks_mut::<WIDTH>().0[..self.count]);
        let mut tiles = self.tiles.as_chunks::<WIDTH>().0.as_chunks::<WIDTH>().0;
        let zero = V::splat(0.0);
        for i in 0..self.count {
            let (row, others) = tiles.split_at(self.count - i);
            tiles = others;
            let own = V::load(&x[i]);
            let own_lanes = lanes_apart::<V>(&x[i]);
            let mut sums = [zero; WIDTH];
            for r in 0..WIDTH {
                sums[r] = V::load(&row[0][r]).mul(own);
            }
            for ((tile, x), out) in row[1..].iter().zip(&x[i + 1..]).zip(&mut out[i + 1..]) {
                let x = V::load(x);
                let mut transposed = [V::load(out), zero];
                for r in 0..WIDTH {
                    let line = V::load(&tile[r]);
                    sums[r] = line.mul_add(x, sums[r]);
                    transposed[r % 2] = line.mul_add(own_lanes[r], transposed[r % 2]);
                }
                transposed[0].add(transposed[1]).store(out);
            }
            add_sums(&sums, &mut out[i]);
        }
    }
}

impl Symmetric<3> {
    /// Of matrices A, B and C: first = A x + B y, second = B x + C y; all padded to whole vectors or more, with zeros.
    #[inline(always)]
    pub(crate) fn multiply_pairs<V: Vector>(&self, x: &[f64], y: &[f64], first: &mut [f64], second: &mut [f64]) {
        first.fill(0.0);
        second.fill(0.0);
        let (x, y) = (&x.as_chunks::<WIDTH>().0[..self.count], &y.as_chunks::<WIDTH>().0[..self.count]);
        let first = &mut first.as_chunks_mut::<WIDTH>().0[..self.count];
        let second = &mut second.as_chunks_mut::<WIDTH>().0[..self.count];
        let mut tiles = self.tiles.as_chunks::<WIDTH>().0.as_chunks::<3>().0.as_chunks::<WIDTH>().0;
        let zero = V::splat(0.0);
        for i in 0..self.count {
            let (row, others) = tiles.split_at(self.count - i);
            tiles = others;
            let (own_x, own_y) = (V::load(&x[i]), V::load(&y[i]));
            let (lanes_x, lanes_y) = (lanes_apart::<V>(&x[i]), lanes_apart::<V>(&y[i]));
            let (mut sums_first, mut sums_second) = ([zero; WIDTH], [zero; WIDTH]);
            for r in 0..WIDTH {
                let [a, b, c] = &row[0][r];
                let (a, b, c) = (V::load(a), V::load(b), V::load(c));
                sums_first[r] = b.mul_add(own_y, a.mul(own_x));
                sums_second[r] = c.mul_add(own_y, b.mul(own_x));
            }
            let others = x[i + 1..].iter().zip(&y[i + 1..]).zip(first[i + 1..].iter_mut().zip(&mut second[i + 1..]));
            for (tile, ((x, y), (first, second))) in row[1..].iter().zip(others) {
                let (x, y) = (V::load(x), V::load(y));
                let (mut of_first, mut of_second) = ([V::load(first), zero], [V::load(second), zero]);
                for r in 0..WIDTH {
                    let [a, b, c] = &tile[r];
                    let (a, b, c) = (V::load(a), V::load(b), V::load(c));
                    sums_first[r] = b.mul_add(y, a.mul_add(x, sums_first[r]));
                    sums_second[r] = c.mul_add(y, b.mul_add(x, sums_second[r]));
                    of_first[0] = a.mul_add(lanes_x[r], of_first[0]);
                    of_first[1] = b.mul_add(lanes_y[r], of_first[1]);
                    of_second[0] = b.mul_add(lanes_x[r], of_second[0]);
                    of_second[1] = c.mul_add(lanes_y[r], of_second[1]);
                }
                of_first[0].add(of_first[1]).store(first);
                of_second[0].add(of_second[1]).store(second);
            }
            add_sums(&sums_first, &mut first[i]);
            add_sums(&sums_second, &mut second[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Plain;

    /// Against sums over whole rows, of sizes that do and do not fill their tiles.
    #[test]
    fn products_are_those_of_whole_matrices() {
        for size in [1usize, 3, 4, 5, 8, 13] {
            let entry =
                |which: usize, i: usize, j: usize| ((7 * i.min(j) + 3 * i.max(j) + 5 * which) % 11) as f64 - 4.0;
            let length = size.next_multiple_of(WIDTH) + WIDTH;
            let vector = |seed: usize| -> Vec<f64> {
                (0..length).map(|i| if i < size { ((i * seed) % 7) as f64 - 3.0 } else { 0.0 }).collect()
            };
            let (x, y) = (vector(3), vector(5));
            let product = |which: usize, x: &[f64]| -> Vec<f64> {
                (0..length)
                    .map(|i| (0..size).map(|j| if i < size { entry(which, i, j) * x[j] } else { 0.0 }).sum())
                    .collect()
            };
            let sum = |a: Vec<f64>, b: Vec<f64>| -> Vec<f64> { a.iter().zip(&b).map(|(a, b)| a + b).collect() };
            let mut out = vec![9.0; length];
            Symmetric::<1>::new(size, |i, j| [entry(0, i, j)]).multiply::<Plain>(&x, &mut out);
            assert_eq!(out, product(0, &x), "{size}");
            let three = Symmetric::<3>::new(size, |i, j| [0, 1, 2].map(|which| entry(which, i, j)));
            let (mut first, mut second) = (vec![9.0; length], vec![9.0; length]);
            three.multiply_pairs::<Plain>(&x, &y, &mut first, &mut second);
            assert_eq!(first, sum(product(0, &x), product(1, &y)), "{size}");
            assert_eq!(second, sum(product(1, &x), product(2, &y)), "{size}");
        }
    }
}
