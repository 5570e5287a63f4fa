//! The exact step of a regime over one whole sample interval, and the cache of regimes.
//!
//! The step is affine in the state, the floor loads and the motion. Its columns are series of unit vectors; an interval
//! too long for one series is halved until it is short enough, and the step composed with itself.

use std::collections::HashMap;

use nalgebra::{DMatrix, DVector};

use crate::lanes::{MAX_LANES, padded};
use crate::model::Model;
use crate::regime::Regime;
use crate::taylor::{Drive, MAX_PHASE, Series};

/// Memory one cache may take before it starts afresh (bytes).
const CACHE_BYTES: usize = 64 << 20;

/// The step of a regime over one sample interval, acting on rows (dx, dv, a, j): changes of drifts and drift rates,
/// floor accelerations and their rates at the end, each padded to whole vectors. Columns are stored one after the other.
pub(crate) struct Propagator {
    rows: usize,
    /// Columns of the state (x, v).
    state: Vec<f64>,
    /// Columns of constant floor loads.
    load: Vec<f64>,
    /// Columns of floor loads that grow from zero by one per interval.
    ramp: Vec<f64>,
    /// Column of a constant ground acceleration.
    ground: Vec<f64>,
    /// Column of a ground acceleration that grows from zero by one per interval.
    ground_ramp: Vec<f64>,
}

/// Changes of the state (x, v) over a step as an affine map; slopes are per second.
struct Step {
    state: DMatrix<f64>,
    load: DMatrix<f64>,
    ramp: DMatrix<f64>,
    ground: DVector<f64>,
    ground_ramp: DVector<f64>,
}

impl Step {
    fn by_series(model: &Model, regime: &Regime, h: f64) -> Self {
        let n = model.storeys();
        let mut series = Series::default();
        let zero = vec![0.0; n];
        let mut column = |x: &[f64], v: &[f64], drive: &Drive| {
            series.form(model, regime, x, v, drive, h);
            let mut out = vec![0.0; 2 * n];
            let (dx, dv) = out.split_at_mut(n);
            series.drift_changes(1.0, dx);
            series.rate_changes(1.0, dv);
            DVector::from_vec(out)
        };
        let unit = |i: usize| {
            let mut e = zero.clone();
            e[i] = 1.0;
            e
        };
        let rest = Drive { load: zero.clone(), load_slope: zero.clone(), ..Drive::default() };
        let columns = |vectors: Vec<DVector<f64>>| {
            if vectors.is_empty() { DMatrix::zeros(2 * n, 0) } else { DMatrix::from_columns(&vectors) }
        };
        let mut state: Vec<_> = (0..n).map(|i| column(&unit(i), &zero, &rest)).collect();
        state.extend((0..n).map(|i| column(&zero, &unit(i), &rest)));
        let load = (0..n).map(|i| column(&zero, &zero, &Drive { load: unit(i), ..rest.clone() })).collect();
        let ramp = (0..n).map(|i| column(&zero, &zero, &Drive { load_slope: unit(i), ..rest.clone() })).collect();
        let ground = column(&zero, &zero, &Drive { ground: 1.0, ..rest.clone() });
        let ground_ramp = column(&zero, &zero, &Drive { ground_slope: 1.0, ..rest.clone() });
        Self { state: columns(state), load: columns(load), ramp: columns(ramp), ground, ground_ramp }
    }

    /// The step taken twice; `h` is its length.
    fn doubled(&self, h: f64) -> Self {
        let state = &self.state;
        Self {
            state: state * 2.0 + state * state,
            load: &self.load * 2.0 + state * &self.load,
            ramp: &self.ramp * 2.0 + state * &self.ramp + &self.load * h,
            ground: &self.ground * 2.0 + state * &self.ground,
            ground_ramp: &self.ground_ramp * 2.0 + state * &self.ground_ramp + &self.ground * h,
        }
    }
}

impl Propagator {
    fn new(model: &Model, regime: &Regime, dt: f64) -> Self {
        let n = model.storeys();
        let mut halvings = 0;
        while regime.frequency * dt > MAX_PHASE * f64::powi(2.0, halvings) {
            halvings += 1;
        }
        let mut h = dt * f64::powi(2.0, -halvings);
        let mut step = Step::by_series(model, regime, h);
        for _ in 0..halvings {
            step = step.doubled(h);
            h *= 2.0;
        }
        let lanes = padded(n);
        let rows = 4 * lanes;
        let zero = vec![0.0; n];
        // Rows a and j of a column from the state at the end of the interval and the loads there.
        let finish = |change: &[f64], start: &[f64], load: &[f64], slope: &[f64], ground: f64, out: &mut Vec<f64>| {
            let end: Vec<f64> = change.iter().zip(start).map(|(c, s)| c + s).collect();
            let (x, v) = end.split_at(n);
            let (mut a, mut drift_acceleration, mut jerk) = (zero.clone(), zero.clone(), zero.clone());
            regime.accelerations(model, x, v, load, &mut a);
            let mut below = ground;
            for i in 0..n {
                drift_acceleration[i] = a[i] - below;
                below = a[i];
            }
            regime.accelerations(model, v, &drift_acceleration, slope, &mut jerk);
            for part in [&change[..n], &change[n..], &a, &jerk] {
                out.extend_from_slice(part);
                out.extend(std::iter::repeat_n(0.0, lanes - n));
            }
        };
        let at_rest = vec![0.0; 2 * n];
        let unit = |length: usize, i: usize, value: f64| {
            let mut e = vec![0.0; length];
            e[i] = value;
            e
        };
        let (mut state, mut load, mut ramp) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..2 * n {
            finish(step.state.column(i).as_slice(), &unit(2 * n, i, 1.0), &zero, &zero, 0.0, &mut state);
        }
        for i in 0..n {
            finish(step.load.column(i).as_slice(), &at_rest, &unit(n, i, 1.0), &zero, 0.0, &mut load);
            let change: Vec<f64> = step.ramp.column(i).iter().map(|c| c / dt).collect();
            finish(&change, &at_rest, &unit(n, i, 1.0), &unit(n, i, 1.0 / dt), 0.0, &mut ramp);
        }
        let (mut ground, mut ground_ramp) = (Vec::new(), Vec::new());
        finish(step.ground.as_slice(), &at_rest, &zero, &zero, 1.0, &mut ground);
        let change: Vec<f64> = step.ground_ramp.iter().map(|c| c / dt).collect();
        finish(&change, &at_rest, &zero, &zero, 1.0, &mut ground_ramp);
        Self { rows, state, load, ramp, ground, ground_ramp }
    }

    fn bytes(&self) -> usize {
        8 * (self.state.len() + self.load.len() + self.ramp.len() + 2 * self.rows)
    }

    /// out = columns * weights.
    fn combine(&self, columns: &[f64], weights: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (column, &weight) in columns.chunks_exact(self.rows).zip(weights) {
            for (o, c) in out.iter_mut().zip(column) {
                *o += c * weight;
            }
        }
    }

    /// Effect of constant floor loads (N) over the interval.
    pub(crate) fn of_load(&self, load: &[f64], out: &mut [f64]) {
        self.combine(&self.load, load, out);
    }

    /// Effect of floor loads that grow from zero to `load` (N) over the interval.
    pub(crate) fn of_ramp(&self, load: &[f64], out: &mut [f64]) {
        self.combine(&self.ramp, load, out);
    }

    /// Columns of the state (x, v), one after the other.
    #[inline]
    pub(crate) fn state_columns(&self) -> &[f64] {
        &self.state
    }

    /// Columns of a constant ground acceleration, and of one that grows from zero by one.
    #[inline]
    pub(crate) fn motion_columns(&self) -> (&[f64], &[f64]) {
        (&self.ground, &self.ground_ramp)
    }
}

/// An entry of the cache: a regime, and how often the present run took a whole interval in it.
struct Entry {
    regime: Regime,
    run: u64,
    visits: u32,
}

/// The regimes met so far by scenes of equal structure at one time step.
///
/// What a run computes never depends on what is cached: a run takes its first [`RegimeCache::SERIES_VISITS`] intervals
/// of a regime by series whether or not another run has already paid for the propagator.
pub(crate) struct RegimeCache {
    dt: f64,
    entries: Vec<Entry>,
    index: HashMap<Vec<u8>, usize>,
    run: u64,
    /// Memory taken by all entries.
    bytes: usize,
    /// Memory taken by what the present run has met.
    run_bytes: usize,
}

impl RegimeCache {
    /// Whole intervals of a regime that a run solves by series before a propagator is formed.
    const SERIES_VISITS: u32 = 3;
    /// Storeys above which a series is cheaper than the dense step: with full damping matrices, and with others.
    const DENSE_LIMITS: (usize, usize) = (MAX_LANES, 16);

    pub(crate) fn new(dt: f64) -> Self {
        Self { dt, entries: Vec::new(), index: HashMap::new(), run: 0, bytes: 0, run_bytes: 0 }
    }

    /// Time step of the propagators (s).
    pub(crate) fn dt(&self) -> f64 {
        self.dt
    }

    /// Begins a run: counts of visits start afresh.
    pub(crate) fn begin_run(&mut self) {
        self.run += 1;
        self.run_bytes = 0;
        if self.bytes > CACHE_BYTES {
            self.clear();
        }
    }

    fn clear(&mut self) {
        *self = Self { run: self.run, ..Self::new(self.dt) };
    }

    /// The regime of a key, formed by `form` when it is new. Returns its index and whether this run knew it.
    pub(crate) fn enter(&mut self, key: &[u8], form: impl FnOnce() -> Regime) -> (usize, bool) {
        if self.run_bytes > CACHE_BYTES {
            self.clear();
        }
        let index = match self.index.get(key) {
            Some(&index) => index,
            None => {
                let regime = form();
                self.bytes += Self::entry_bytes(&regime, key);
                self.entries.push(Entry { regime, run: 0, visits: 0 });
                self.index.insert(key.to_vec(), self.entries.len() - 1);
                self.entries.len() - 1
            }
        };
        let entry = &mut self.entries[index];
        let known = entry.run == self.run;
        if !known {
            entry.run = self.run;
            entry.visits = 0;
            self.run_bytes += Self::entry_bytes(&entry.regime, key);
        }
        (index, known)
    }

    fn entry_bytes(regime: &Regime, key: &[u8]) -> usize {
        8 * 16 * regime.mass.len() + 2 * key.len() + 256
    }

    /// The regime at an index.
    #[inline]
    pub(crate) fn regime(&self, index: usize) -> &Regime {
        &self.entries[index].regime
    }

    /// Counts a whole interval in a regime; true once its propagator is to be used, which then exists.
    pub(crate) fn visit(&mut self, index: usize, model: &Model, full_damping: bool) -> bool {
        let entry = &mut self.entries[index];
        let n = model.storeys();
        let limit = if full_damping { Self::DENSE_LIMITS.0 } else { Self::DENSE_LIMITS.1 };
        if n == 0 || n > limit {
            return false;
        }
        entry.visits = entry.visits.saturating_add(1);
        if entry.visits <= Self::SERIES_VISITS {
            return false;
        }
        if entry.regime.propagator.is_none() {
            let propagator = Propagator::new(model, &entry.regime, self.dt);
            self.bytes += propagator.bytes();
            entry.regime.propagator = Some(Box::new(propagator));
        }
        if entry.visits == Self::SERIES_VISITS + 1 {
            self.run_bytes += entry.regime.propagator.as_ref().map_or(0, |p| p.bytes());
        }
        true
    }
}
