//! The Taylor series of the solution within one regime: exact to rounding, and dense output for guards and peaks.
//!
//! All coefficients belong to the normalised time s = tau / h in [0, 1].

use crate::lanes::{
    MAX_LANES, OfStorey, Padded, PaddedRows, Plain, Vector, WIDTH, by_width, columns_of, differences, for_each_path,
    lanes, load, store,
};
use crate::machines::model::Model;
use crate::polynomial::bernstein::{MAX_DEGREE, Polynomial, by_length};
use crate::polynomial::orders::{INVERSE, INVERSE_PAIRS, WEIGHTS, Weights, terms};
use crate::regime::{Operator, Regime};
use crate::step::drive::Drive;
use crate::step::drive::Start;
use crate::step::table::Table;

/// Series of the absolute floor accelerations, stored order by order, padded to whole vectors. What drifts and drift
/// rates do follows by integration of their differences.
#[derive(Debug, Default)]
pub(crate) struct Series {
    storeys: usize,
    stride: usize,
    order: usize,
    /// Order beyond which all terms in store are zero.
    highest: usize,
    h: f64,
    /// Drifts and drift rates at the start.
    x: Padded,
    v: Padded,
    /// Terms of the ground acceleration, as of a lowest floor, and zeros beyond.
    ground: [[f64; WIDTH]; MAX_DEGREE + 1],
    a: PaddedRows<{ MAX_DEGREE + 1 }>,
    /// Floor accelerations and their rates at the end of the step.
    end: [Padded; 2],
    /// Place in [0, 1] that changes and integrals go up to.
    place: f64,
    /// Changes of drifts and drift rates.
    changes: [Padded; 2],
    /// First and second integrals over [0, place] of the floor accelerations' terms from the second order on, divided by
    /// the third and fourth power of the place.
    integrals: [Padded; 2],
    load: [Padded; 2],
}

impl Series {
    /// Makes room for the series of so many storeys, in columns of so many numbers.
    #[cold]
    fn resize(&mut self, storeys: usize, stride: usize) {
        let zero = || Padded::new(stride, 0.0);
        (self.storeys, self.stride, self.highest) = (storeys, stride, 0);
        (self.x, self.v, self.a) = (zero(), zero(), PaddedRows::zeros(stride));
        for pair in [&mut self.end, &mut self.changes, &mut self.integrals, &mut self.load] {
            *pair = [zero(), zero()];
        }
    }

    /// Forms the series over a step `h` from its start, whose accelerations must be those of the drive; the drive's loads
    /// are not read where there is a table.
    #[inline(always)]
    pub(crate) fn form<V: Vector, const K: usize>(
        &mut self,
        model: &Model,
        (regime, table): (&Regime, Option<&Table>),
        start: &Start,
        drive: &Drive,
        h: f64,
    ) {
        let (n, stride) = (model.storeys(), model.width);
        let order = match table {
            // Shorter steps need fewer, but the processor foresees loops that always are of one length.
            Some(table) => table.order,
            None => terms::<V>(regime.frequency * h),
        };
        if self.stride != stride || self.storeys != n {
            self.resize(n, stride);
        }
        (self.order, self.h, self.place) = (order, h, 1.0);
        (self.ground[0][0], self.ground[1][0]) = (drive.ground, drive.ground_slope * h);
        if order < self.highest {
            self.a.numbers_mut()[(order + 1) * stride..(self.highest + 1) * stride].fill(0.0);
        }
        self.highest = order;
        match (table, K, n) {
            (Some(table), 1, 1) => self.by_table::<V, K, 1, 2>(model, table, start, drive),
            (Some(table), 1, 2) => self.by_table::<V, K, 2, 4>(model, table, start, drive),
            (Some(table), 1, 3) => self.by_table::<V, K, 3, 6>(model, table, start, drive),
            (Some(table), 1, _) => self.by_table::<V, K, 4, 8>(model, table, start, drive),
            (Some(table), 2, 5) => self.by_table::<V, K, 5, 10>(model, table, start, drive),
            (Some(table), 2, 6) => self.by_table::<V, K, 6, 12>(model, table, start, drive),
            (Some(table), 2, 7) => self.by_table::<V, K, 7, 14>(model, table, start, drive),
            (Some(table), 2, _) => self.by_table::<V, K, 8, 16>(model, table, start, drive),
            _ if n <= MAX_LANES => {
                self.load[0].copy_from_slice(&drive.load);
                for (load, slope) in self.load[1].iter_mut().zip(&drive.load_slope) {
                    *load = slope * h;
                }
                self.by_recursion::<V, K>(model, regime, start);
            }
            _ => form_any(self, model, regime, start, drive),
        }
    }

    /// From tables: floor accelerations from the second order on are products with drift accelerations and their rates.
    /// `S` is the number of storeys and `COLUMNS` its double.
    #[inline(always)]
    fn by_table<V: Vector, const K: usize, const S: usize, const COLUMNS: usize>(
        &mut self,
        model: &Model,
        table: &Table,
        start: &Start,
        drive: &Drive,
    ) {
        let (h, order) = (self.h, self.order);
        let inside: [V; K] = load(&model.lanes.inside);
        let zero = V::splat(0.0);
        let (x, v): ([V; K], [V; K]) = (load(start.x), load(start.v));
        let (a, jerk): ([V; K], [V; K]) = (load(start.a), load(start.jerk));
        let first = differences(&a, V::splat(drive.ground));
        let rate = differences(&jerk, V::splat(drive.ground_slope));
        let mut sums = Sums { value: a, rate: jerk, integrals: [[zero; K]; 2] };
        for k in 0..K {
            sums.rate[k] = V::splat(h).mul(jerk[k]);
            sums.value[k] = a[k].add(sums.rate[k]);
        }
        let linear = sums.rate;
        store(&x, &mut self.x);
        store(&v, &mut self.v);
        let (starts, of_floors) = self.a.vectors_mut::<K>().split_at_mut(2);
        put(&a, &mut starts[0]);
        put(&linear, &mut starts[1]);
        // Powers of the step over that of the table.
        let ratio = h / table.h;
        let terms = columns_of::<K>(&table.terms);
        let ratio = V::splat(ratio);
        let mut power = ratio;
        let (mut firsts, mut rates) = ([zero; S], [zero; S]);
        for c in 0..S {
            firsts[c] = first[c / WIDTH].broadcast(c % WIDTH);
            rates[c] = rate[c / WIDTH].broadcast(c % WIDTH);
        }
        let terms = terms[..(order - 1) * COLUMNS].as_chunks::<COLUMNS>().0;
        for ((columns, out), weights) in terms.iter().zip(of_floors).zip(&WEIGHTS[2..]) {
            power = power.mul(ratio);
            let mut term = [zero; K];
            for k in 0..K {
                let mut of_first = V::load(&columns[0][k]).mul(firsts[0]);
                let mut of_rate = V::load(&columns[S][k]).mul(rates[0]);
                for c in 1..S {
                    of_first = V::load(&columns[c][k]).mul_add(firsts[c], of_first);
                    of_rate = V::load(&columns[S + c][k]).mul_add(rates[c], of_rate);
                }
                term[k] = of_first.add(of_rate).mul(power);
            }
            put(&term, out);
            sums.add(&term, weights);
        }
        self.put_sums(&sums, &v, &a, &linear, &inside);
    }

    /// Keeps what the sums give at the end of the step: `a` and `linear` are the first two terms.
    #[inline(always)]
    fn put_sums<V: Vector, const K: usize>(
        &mut self,
        sums: &Sums<V, K>,
        v: &[V; K],
        a: &[V; K],
        linear: &[V; K],
        inside: &[V; K],
    ) {
        let (h, [ground, change]) = (self.h, self.ground_terms());
        let (mut once, mut twice, mut jerk) = (*a, *a, *a);
        for k in 0..K {
            once[k] = V::splat(0.5).mul_add(linear[k], sums.integrals[0][k]).add(a[k]);
            let from_first = V::splat(1.0 / 6.0).mul_add(linear[k], sums.integrals[1][k]);
            twice[k] = V::splat(0.5).mul_add(a[k], from_first);
            jerk[k] = V::splat(1.0 / h).mul(sums.rate[k]);
        }
        let of_rate = differences(&once, V::splat(ground + 0.5 * change));
        let of_drift = differences(&twice, V::splat(0.5 * ground + (1.0 / 6.0) * change));
        let (mut dx, mut dv) = (*v, *v);
        for k in 0..K {
            let length = V::splat(h);
            dv[k] = length.mul(of_rate[k]).mul(inside[k]);
            dx[k] = length.mul_add(of_drift[k], v[k]).mul(length).mul(inside[k]);
        }
        store(&dx, &mut self.changes[0]);
        store(&dv, &mut self.changes[1]);
        store(&sums.value, &mut self.end[0]);
        store(&jerk, &mut self.end[1]);
        store(&sums.integrals[0], &mut self.integrals[0]);
        store(&sums.integrals[1], &mut self.integrals[1]);
    }

    /// By the recursion from order to order.
    #[inline(always)]
    fn by_recursion<V: Vector, const K: usize>(&mut self, model: &Model, regime: &Regime, start: &Start) {
        let operator = Operator::<V, K>::new(model, regime);
        let inside: [V; K] = load(&model.lanes.inside);
        let (zero, h) = (V::splat(0.0), self.h);
        let (mut x, mut v): ([V; K], [V; K]) = (load(start.x), load(start.v));
        let (rates, mut floors) = (v, operator.floor_velocities(&v));
        store(&x, &mut self.x);
        store(&v, &mut self.v);
        let mut first = [[zero; K]; 2];
        let mut sums = Sums { value: [zero; K], rate: [zero; K], integrals: [[zero; K]; 2] };
        let terms = self.a.vectors_mut::<K>()[..=self.order].iter_mut();
        for ((order, out), weights) in terms.enumerate().zip(WEIGHTS.iter()) {
            let forces = if order < 2 { load(&self.load[order]) } else { [zero; K] };
            let a = operator.accelerations(&x, &v, &floors, forces);
            put(&a, out);
            sums.add(&a, weights);
            if order < 2 {
                first[order] = a;
            }
            let factor = V::splat(h * INVERSE[order + 1]);
            // What is beyond the last storey meets zeros alone.
            let ground = V::splat(self.ground[order][0]);
            let drift_acceleration = differences(&a, ground);
            for k in 0..K {
                x[k] = factor.mul(v[k]);
                v[k] = factor.mul(drift_acceleration[k]);
            }
            if operator.damps_floors() {
                for k in 0..K {
                    floors[k] = factor.mul(a[k].sub(ground));
                }
            }
        }
        self.put_sums(&sums, &rates, &first[0], &first[1], &inside);
    }

    /// By the recursion, for more storeys than vectors hold.
    #[inline(always)]
    fn form_any(&mut self, model: &Model, regime: &Regime, start: &Start, drive: &Drive) {
        let (n, stride) = (self.storeys, self.stride);
        self.x.copy_from_slice(start.x);
        self.v.copy_from_slice(start.v);
        let (mut x, mut v) = (start.x[..n].to_vec(), start.v[..n].to_vec());
        let zero = vec![0.0; n];
        let slope: Vec<f64> = drive.load_slope.iter().map(|slope| slope * self.h).collect();
        let [end, jerk_at_end] = self.end.each_mut().map(|sums| &mut sums[..n]);
        let [once_of, twice_of] = self.integrals.each_mut().map(|sums| &mut sums[..n]);
        for sums in [&mut *end, jerk_at_end, once_of, twice_of] {
            sums.fill(0.0);
        }
        for (k, &[[order, ..], [once, ..], [twice, ..]]) in WEIGHTS.iter().enumerate().take(self.order + 1) {
            let load: &[f64] = [&drive.load[..], &slope, &zero][k.min(2)];
            let a = &mut self.a.numbers_mut()[k * stride..k * stride + n];
            regime.accelerations(model, &x, &v, load, a);
            let factor = self.h * INVERSE[k + 1];
            let mut below = self.ground[k][0];
            for (i, &a) in a.iter().enumerate() {
                end[i] += a;
                jerk_at_end[i] += order * a;
                once_of[i] += once * a;
                twice_of[i] += twice * a;
                x[i] = factor * v[i];
                v[i] = factor * (a - below);
                below = a;
            }
        }
        jerk_at_end.iter_mut().for_each(|jerk| *jerk /= self.h);
        self.integrate_differences();
    }

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
    fn integrate_differences(&mut self) {
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

    /// Length of the step (s).
    #[inline]
    pub(crate) fn h(&self) -> f64 {
        self.h
    }

    /// Place in [0, 1] that changes and integrals go up to.
    #[inline]
    pub(crate) fn place(&self) -> f64 {
        self.place
    }

    /// The first two terms of the ground acceleration: it has no more.
    #[inline(always)]
    fn ground_terms(&self) -> [f64; 2] {
        [self.ground[0][0], self.ground[1][0]]
    }

    /// Terms of the absolute acceleration of a floor, or of the ground (0).
    #[inline(always)]
    fn terms_of<const K: usize>(&self, floor: usize) -> OfStorey<'_, K> {
        match floor.checked_sub(1) {
            Some(i) => self.a.storey(i),
            None => OfStorey::of_few(&self.ground, 0),
        }
    }

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

    /// The first two terms of the absolute acceleration of floor `i`, and the first and second integrals of the others up
    /// to the place s, divided by s^3 and s^4.
    #[inline]
    pub(crate) fn terms_and_integrals<const K: usize>(&self, i: usize) -> ([f64; 2], [f64; 2]) {
        let terms = self.a.storey::<K>(i);
        ([terms.at(0), terms.at(1)], [0, 1].map(|which| self.integrals[which].numbers::<K>()[i]))
    }

    /// Changes of drifts and drift rates up to the place, padded.
    #[inline]
    pub(crate) fn changes(&self) -> [&Padded; 2] {
        [&self.changes[0], &self.changes[1]]
    }

    /// Floor accelerations and their rates at the end of the step, padded.
    #[inline]
    pub(crate) fn accelerations_at_end(&self) -> [&Padded; 2] {
        [&self.end[0], &self.end[1]]
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

/// Sums of terms: value and rate at the end of a step of unit length, first and second integrals from the second order on.
struct Sums<V, const K: usize> {
    value: [V; K],
    rate: [V; K],
    integrals: [[V; K]; 2],
}

impl<V: Vector, const K: usize> Sums<V, K> {
    #[inline(always)]
    fn add(&mut self, term: &[V; K], [order, once, twice]: &[[f64; WIDTH]; 3]) {
        for k in 0..K {
            self.value[k] = self.value[k].add(term[k]);
            self.rate[k] = V::load(order).mul_add(term[k], self.rate[k]);
            self.integrals[0][k] = V::load(once).mul_add(term[k], self.integrals[0][k]);
            self.integrals[1][k] = V::load(twice).mul_add(term[k], self.integrals[1][k]);
        }
    }
}

#[inline(always)]
fn put<V: Vector, const K: usize>(vectors: &[V; K], term: &mut [[f64; WIDTH]; K]) {
    for k in 0..K {
        vectors[k].store(&mut term[k]);
    }
}

for_each_path! {
    fn form_any(series: &mut Series, model: &Model, regime: &Regime, start: &Start, drive: &Drive) = any_by_path
}

/// The compiler makes vectors of the path's width.
#[inline(always)]
fn any_by_path<V: Vector>(series: &mut Series, model: &Model, regime: &Regime, start: &Start, drive: &Drive) {
    series.form_any(model, regime, start, drive);
}
