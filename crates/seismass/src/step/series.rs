//! The Taylor series of the solution within one regime: exact to rounding, and dense output for guards and peaks.
//!
//! All coefficients belong to the normalised time s = tau / h in [0, 1].

use crate::lanes::{
    MAX_LANES, OfStorey, Padded, PaddedRows, Vector, WIDTH, columns_of, differences, for_each_path, load, store,
};
use crate::machines::model::Model;
use crate::polynomial::orders::{INVERSE, WEIGHTS, terms};
use crate::polynomial::power::MAX_DEGREE;
use crate::regime::{Regime, RegimeOperator};
use crate::step::drive::{Drive, StepStart};
use crate::step::table::SeriesTable;

/// Series of the absolute floor accelerations, stored order by order, padded to whole vectors. What drifts and drift
/// rates do follows by integration of their differences.
#[derive(Debug, Default)]
pub(crate) struct Series {
    pub(crate) storeys: usize,
    pub(crate) stride: usize,
    pub(crate) order: usize,
    /// Order beyond which all terms in store are zero.
    highest: usize,
    pub(crate) h: f64,
    /// Drifts and drift rates at the start.
    pub(crate) x: Padded,
    pub(crate) v: Padded,
    /// Terms of the ground acceleration, as of a lowest floor, and zeros beyond.
    ground: [[f64; WIDTH]; MAX_DEGREE + 1],
    pub(crate) a: PaddedRows<{ MAX_DEGREE + 1 }>,
    /// Floor accelerations and their rates at the end of the step.
    end: [Padded; 2],
    /// Place in [0, 1] that changes and integrals go up to.
    pub(crate) place: f64,
    /// Changes of drifts and drift rates.
    pub(crate) changes: [Padded; 2],
    /// First and second integrals over [0, place] of the floor accelerations' terms from the second order on, divided by
    /// the third and fourth power of the place.
    pub(crate) integrals: [Padded; 2],
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
        (regime, table): (&Regime, Option<&SeriesTable>),
        start: &StepStart,
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
        table: &SeriesTable,
        start: &StepStart,
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
    fn by_recursion<V: Vector, const K: usize>(&mut self, model: &Model, regime: &Regime, start: &StepStart) {
        let operator = RegimeOperator::<V, K>::new(model, regime);
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
    fn form_any(&mut self, model: &Model, regime: &Regime, start: &StepStart, drive: &Drive) {
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
    pub(crate) fn ground_terms(&self) -> [f64; 2] {
        [self.ground[0][0], self.ground[1][0]]
    }

    /// Terms of the absolute acceleration of a floor, or of the ground (0).
    #[inline(always)]
    pub(crate) fn terms_of<const K: usize>(&self, floor: usize) -> OfStorey<'_, K> {
        match floor.checked_sub(1) {
            Some(i) => self.a.storey(i),
            None => OfStorey::of_few(&self.ground, 0),
        }
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
    fn form_any(series: &mut Series, model: &Model, regime: &Regime, start: &StepStart, drive: &Drive) = any_by_path
}

/// The compiler makes vectors of the path's width.
#[inline(always)]
fn any_by_path<V: Vector>(series: &mut Series, model: &Model, regime: &Regime, start: &StepStart, drive: &Drive) {
    series.form_any(model, regime, start, drive);
}
