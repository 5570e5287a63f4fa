//! Changes and integrals of a series up to a place inside the step.

use crate::lanes::{MAX_LANES, Vector, WIDTH, differences, lanes, load, store};
use crate::machines::model::Model;
use crate::polynomial::orders::WEIGHTS;
use crate::step::series::Series;

impl Series {
    /// Takes changes and integrals up to place `s` only.
    #[inline(always)]
    pub(crate) fn stop_at<V: Vector, const K: usize>(&mut self, model: &Model, s: f64) {
        self.place = s;
        if self.storeys <= MAX_LANES {
            self.stop_in_lanes::<V, K>(model, s);
        } else {
            self.integrate_up_to::<V>(s);
            self.integrate_differences();
        }
    }

    #[inline(always)]
    fn stop_in_lanes<V: Vector, const K: usize>(&mut self, model: &Model, s: f64) {
        let inside: [V; K] = load(&model.lanes.inside);
        let (place, length) = (V::splat(s), V::splat(s * self.h));
        let pairs = self.a.vectors::<K>().as_chunks::<2>().0;
        let Some([[a, linear], pairs @ ..]) = pairs.get(..=self.order / 2) else { return };
        // Even and odd terms apart: half the latency of one chain.
        let squared = V::splat(s * s);
        // Of even and odd orders: half the latency of one chain.
        let mut sums = [[[V::splat(0.0); K]; 2]; 2];
        for (pair, weights) in pairs.iter().zip(&WEIGHTS.as_chunks::<2>().0[1..]).rev() {
            for parity in 0..2 {
                for which in 0..2 {
                    let weight = V::load(&weights[parity][1 + which]);
                    for k in 0..K {
                        let sum = &mut sums[which][parity][k];
                        *sum = sum.mul_add(squared, V::load(&pair[parity][k]).mul(weight));
                    }
                }
            }
        }
        let [mut once, mut twice] = [[V::splat(0.0); K]; 2];
        for k in 0..K {
            once[k] = sums[0][1][k].mul_add(place, sums[0][0][k]);
            twice[k] = sums[1][1][k].mul_add(place, sums[1][0][k]);
        }
        store(&once, &mut self.integrals[0]);
        store(&twice, &mut self.integrals[1]);
        for k in 0..K {
            let (a, linear) = (V::load(&a[k]), V::load(&linear[k]));
            once[k] = once[k].mul_add(place, V::splat(0.5).mul(linear)).mul_add(place, a);
            twice[k] = twice[k].mul_add(place, V::splat(1.0 / 6.0).mul(linear)).mul_add(place, V::splat(0.5).mul(a));
        }
        let [ground, change] = self.ground_terms();
        let of_rate = differences(&once, V::splat(ground + 0.5 * s * change));
        let of_drift = differences(&twice, V::splat(0.5 * ground + (1.0 / 6.0) * s * change));
        let v: [V; K] = load(&self.v);
        for k in 0..K {
            once[k] = length.mul(of_rate[k]).mul(inside[k]);
            twice[k] = length.mul_add(of_drift[k], v[k]).mul(length).mul(inside[k]);
        }
        store(&twice, &mut self.changes[0]);
        store(&once, &mut self.changes[1]);
    }

    /// The integrals of [`Series::stop_at`] for more storeys than vectors hold.
    #[inline(always)]
    fn integrate_up_to<V: Vector>(&mut self, s: f64) {
        let place = V::splat(s);
        let stride = self.stride / WIDTH;
        let terms = &lanes(self.a.numbers())[..(self.order + 1) * stride];
        let [once, twice] = &mut self.integrals;
        let integrals = once.as_chunks_mut::<WIDTH>().0.iter_mut().zip(twice.as_chunks_mut::<WIDTH>().0);
        for (lane, (once, twice)) in integrals.enumerate() {
            let mut sums = [V::splat(0.0); 2];
            for (column, weights) in terms.chunks_exact(stride).zip(WEIGHTS.iter()).skip(2).rev() {
                let term = V::load(&column[lane]);
                sums[0] = sums[0].mul_add(place, term.mul(V::load(&weights[1])));
                sums[1] = sums[1].mul_add(place, term.mul(V::load(&weights[2])));
            }
            sums[0].store(once);
            sums[1].store(twice);
        }
    }

    /// Forms the changes of drifts and drift rates up to the place from the integrals of floor accelerations.
    pub(crate) fn integrate_differences(&mut self) {
        let (s, h) = (self.place, self.place * self.h);
        let [ground, change] = self.ground_terms();
        let mut below = (ground + 0.5 * s * change, 0.5 * ground + (1.0 / 6.0) * s * change);
        let n = self.storeys;
        let (a, linear, v) = (&self.a.row(0)[..n], &self.a.row(1)[..n], &self.v[..n]);
        let [once_of, twice_of] = self.integrals.each_ref().map(|sums| &sums[..n]);
        let [dx, dv] = self.changes.each_mut().map(|changes| &mut changes[..n]);
        for i in 0..n {
            let once = (once_of[i] * s + 0.5 * linear[i]) * s + a[i];
            let twice = (twice_of[i] * s + (1.0 / 6.0) * linear[i]) * s + 0.5 * a[i];
            dx[i] = h * (v[i] + h * (twice - below.1));
            dv[i] = h * (once - below.0);
            below = (once, twice);
        }
    }
}
