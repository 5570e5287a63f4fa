//! Polynomials of a series: drifts, drift rates, velocities and accelerations over the step.

use crate::lanes::{OfStorey, Plain, Vector, WIDTH, by_width};
use crate::polynomial::orders::{INVERSE, INVERSE_PAIRS, Weights};
use crate::polynomial::power::{Polynomial, by_length};
use crate::step::series::Series;

impl Series {
    /// Accelerations of storey `i`'s floor less those of what it stands on.
    #[inline(always)]
    fn difference<const K: usize>(&self, i: usize) -> Difference<'_, K> {
        Difference { above: self.terms_of(i + 1), below: self.terms_of(i) }
    }

    /// Zeros as long as the polynomials of the series, which are formed in place: to return one would copy it before it is
    /// out of the processor's stores, and wait for that.
    #[inline(always)]
    pub(crate) fn zeros(&self) -> Polynomial {
        Polynomial::zeros(self.order + 1)
    }

    /// Sets the first four coefficients, to the sums of two vectors, and the others to terms so many orders lower, times
    /// their weights and a factor. Returns the sum of the sizes of all but the second: a bound on [0, 1].
    ///
    /// To add it here is not to wait for what has just been stored.
    #[inline(always)]
    fn integrate<V: Vector, const F: usize>(
        [first, more]: [V; 2],
        terms: &impl TermByOrder,
        orders: usize,
        weights: &Weights,
        factor: f64,
        p: &mut Polynomial,
    ) -> f64 {
        let Some(fours) = p.fours_mut::<F>() else { return 0.0 };
        let mut sizes = first.abs();
        first.add(more).store(&mut fours[0]);
        for f in 1..F {
            let weights = V::load(&weights.as_chunks().0[f]);
            let coefficients = terms.four::<V>(WIDTH * f - orders).mul(V::splat(factor)).mul(weights);
            coefficients.store(&mut fours[f]);
            sizes = sizes.add(coefficients.abs());
        }
        sizes.sum()
    }

    /// `p` becomes the terms times a factor, and `more` is added to the first four; returns the sum of the terms' sizes.
    #[inline(always)]
    fn multiply<V: Vector, const F: usize>(terms: &impl TermByOrder, factor: f64, more: V, p: &mut Polynomial) -> f64 {
        let Some(fours) = p.fours_mut::<F>() else { return 0.0 };
        let first = terms.four::<V>(0).mul(V::splat(factor));
        let mut sizes = first.abs();
        first.add(more).store(&mut fours[0]);
        for f in 1..F {
            let coefficients = terms.four::<V>(WIDTH * f).mul(V::splat(factor));
            coefficients.store(&mut fours[f]);
            sizes = sizes.add(coefficients.abs());
        }
        sizes.sum()
    }

    /// `p`, of [`Series::zeros`], becomes `limit` and `factor` times the drift coordinate of storey `i`; returns a bound of
    /// the size of the latter.
    #[inline(always)]
    pub(crate) fn drift<V: Vector, const K: usize>(
        &self,
        i: usize,
        factor: f64,
        limit: f64,
        p: &mut Polynomial,
    ) -> f64 {
        let difference = self.difference::<K>(i);
        let once = factor * self.h;
        let twice = once * self.h;
        let terms = [0, 1].map(|k| twice * INVERSE_PAIRS[k + 2] * difference.term(k));
        let first = V::of([factor * self.x.numbers::<K>()[i], once * self.v.numbers::<K>()[i], terms[0], terms[1]]);
        let first = [first, V::of([limit, 0.0, 0.0, 0.0])];
        by_length!(p, F => Self::integrate::<V, F>(first, &difference, 2, &INVERSE_PAIRS, twice, p))
    }

    /// `p`, of [`Series::zeros`], becomes `factor` times the drift rate of storey `i`; returns a bound of its size.
    #[inline(always)]
    pub(crate) fn drift_rate<V: Vector, const K: usize>(&self, i: usize, factor: f64, p: &mut Polynomial) -> f64 {
        let difference = self.difference::<K>(i);
        let once = factor * self.h;
        let terms = [0, 1, 2].map(|k| once * INVERSE[k + 1] * difference.term(k));
        let first = V::of([factor * self.v.numbers::<K>()[i], terms[0], terms[1], terms[2]]);
        by_length!(p, F => Self::integrate::<V, F>([first, V::splat(0.0)], &difference, 1, &INVERSE, once, p))
    }

    /// `p`, of [`Series::zeros`], becomes the velocity that starts from `velocity`, whose rate is -`factor` times the absolute
    /// acceleration of a floor, or of the ground (0), and two more terms; returns a bound of its size.
    #[inline(always)]
    pub(crate) fn velocity_against<V: Vector, const K: usize>(
        &self,
        floor: usize,
        velocity: f64,
        factor: f64,
        more: [f64; 2],
        p: &mut Polynomial,
    ) -> f64 {
        let acceleration = self.terms_of::<K>(floor);
        let once = -factor * self.h;
        // Added before they are multiplied, so that small sums keep their digits.
        let [first, second] = [0, 1].map(|k| once * INVERSE[k + 1] * (acceleration.term(k) + more[k]));
        let first = V::of([velocity, first, second, once * INVERSE[3] * acceleration.term(2)]);
        by_length!(p, F => Self::integrate::<V, F>([first, V::splat(0.0)], &acceleration, 1, &INVERSE, once, p))
    }

    /// `p`, of [`Series::zeros`], becomes a limit that changes linearly (its start and its change over the step) and `factor`
    /// times the absolute acceleration of a floor, or of the ground (0); returns a bound of the size of the latter.
    #[inline(always)]
    pub(crate) fn acceleration<V: Vector, const K: usize>(
        &self,
        floor: usize,
        factor: f64,
        [limit, change]: [f64; 2],
        p: &mut Polynomial,
    ) -> f64 {
        let terms = self.terms_of::<K>(floor);
        by_length!(p, F => Self::multiply::<V, F>(&terms, factor, V::of([limit, change, 0.0, 0.0]), p))
    }

    /// Drift rates at `s`.
    pub(crate) fn rates_at(&self, s: f64, out: &mut [f64]) {
        for (i, out) in out.iter_mut().enumerate() {
            let mut rate = self.zeros();
            by_width!(self.stride, K => self.drift_rate::<Plain, K>(i, 1.0, &mut rate));
            *out = rate.at::<Plain>(s);
        }
    }
}

/// Terms of a series by order.
trait TermByOrder {
    fn term(&self, k: usize) -> f64;

    /// Four terms from order `k` on.
    fn four<V: Vector>(&self, k: usize) -> V;
}

impl<const K: usize> TermByOrder for OfStorey<'_, K> {
    #[inline(always)]
    fn term(&self, k: usize) -> f64 {
        self.at(k)
    }

    #[inline(always)]
    fn four<V: Vector>(&self, k: usize) -> V {
        V::of([self.at(k), self.at(k + 1), self.at(k + 2), self.at(k + 3)])
    }
}

/// Terms of one floor less those of another.
struct Difference<'a, const K: usize> {
    above: OfStorey<'a, K>,
    below: OfStorey<'a, K>,
}

impl<const K: usize> TermByOrder for Difference<'_, K> {
    #[inline(always)]
    fn term(&self, k: usize) -> f64 {
        self.above.term(k) - self.below.term(k)
    }

    #[inline(always)]
    fn four<V: Vector>(&self, k: usize) -> V {
        self.above.four::<V>(k).sub(self.below.four(k))
    }
}
