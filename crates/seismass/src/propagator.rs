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
    /// Columns of floor loads that grow from zero by one per interval; empty where no vertical motion needs them.
    ramp: Vec<f64>,
    /// Column of a constant ground acceleration.
    ground: Vec<f64>,
    /// Column of a ground acceleration that grows from zero by one per interval.
    ground_ramp: Vec<f64>,
}

/// What a column of the step is the effect of, all else being zero.
#[derive(Clone, Copy)]
enum Cause {
    Drift(usize),
    DriftRate(usize),
    Load(usize),
    /// A floor load that grows from zero by one per second.
    Ramp(usize),
    Ground,
    /// A ground acceleration that grows from zero by one per second.
    GroundRamp,
}

/// Forms the series of columns.
struct Columns<'a> {
    model: &'a Model,
    regime: &'a Regime,
    series: Series,
    x: Vec<f64>,
    v: Vec<f64>,
    drive: Drive,
}

impl<'a> Columns<'a> {
    fn new(model: &'a Model, regime: &'a Regime) -> Self {
        let zero = vec![0.0; model.storeys()];
        let drive = Drive { load: zero.clone(), load_slope: zero.clone(), ..Drive::default() };
        Self { model, regime, series: Series::default(), x: zero.clone(), v: zero, drive }
    }

    /// The series of a column over `h`.
    fn form(&mut self, cause: Cause, h: f64) -> &Series {
        self.set(cause, 1.0);
        self.series.form(self.model, self.regime, &self.x, &self.v, &self.drive, h);
        self.set(cause, 0.0);
        &self.series
    }

    fn set(&mut self, cause: Cause, value: f64) {
        match cause {
            Cause::Drift(i) => self.x[i] = value,
            Cause::DriftRate(i) => self.v[i] = value,
            Cause::Load(i) => self.drive.load[i] = value,
            Cause::Ramp(i) => self.drive.load_slope[i] = value,
            Cause::Ground => self.drive.ground = value,
            Cause::GroundRamp => self.drive.ground_slope = value,
        }
    }
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
    fn by_series(columns: &mut Columns, h: f64) -> Self {
        let n = columns.model.storeys();
        let mut column = |cause: Cause| {
            let series = columns.form(cause, h);
            let mut out = DVector::zeros(2 * n);
            let (dx, dv) = out.as_mut_slice().split_at_mut(n);
            series.drift_changes(1.0, dx);
            series.rate_changes(1.0, dv);
            out
        };
        let state: Vec<_> = (0..n).map(Cause::Drift).chain((0..n).map(Cause::DriftRate)).map(&mut column).collect();
        let load: Vec<_> = (0..n).map(|i| column(Cause::Load(i))).collect();
        let ramp: Vec<_> = (0..n).map(|i| column(Cause::Ramp(i))).collect();
        Self {
            state: DMatrix::from_columns(&state),
            load: DMatrix::from_columns(&load),
            ramp: DMatrix::from_columns(&ramp),
            ground: column(Cause::Ground),
            ground_ramp: column(Cause::GroundRamp),
        }
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

    /// Change of the state in the column of a cause.
    fn change(&self, cause: Cause) -> &[f64] {
        let rows = self.ground.len();
        let column = |matrix: &'_ DMatrix<f64>, i: usize| rows * i..rows * (i + 1).min(matrix.ncols());
        match cause {
            Cause::Drift(i) => &self.state.as_slice()[column(&self.state, i)],
            Cause::DriftRate(i) => &self.state.as_slice()[column(&self.state, rows / 2 + i)],
            Cause::Load(i) => &self.load.as_slice()[column(&self.load, i)],
            Cause::Ramp(i) => &self.ramp.as_slice()[column(&self.ramp, i)],
            Cause::Ground => self.ground.as_slice(),
            Cause::GroundRamp => self.ground_ramp.as_slice(),
        }
    }
}

impl Propagator {
    /// The step of a regime over `dt`, by one series where it converges fast enough, else by halving.
    fn new(model: &Model, regime: &Regime, dt: f64, with_ramps: bool) -> Self {
        let n = model.storeys();
        let mut columns = Columns::new(model, regime);
        let composed = (regime.frequency * dt > MAX_PHASE).then(|| {
            let halvings = (regime.frequency * dt / MAX_PHASE).log2().ceil();
            let mut h = dt * (-halvings).exp2();
            let mut step = Step::by_series(&mut columns, h);
            for _ in 0..halvings as usize {
                step = step.doubled(h);
                h *= 2.0;
            }
            step
        });
        let mut gather = |causes: &mut dyn Iterator<Item = Cause>| {
            let mut out = Vec::new();
            for cause in causes {
                match &composed {
                    None => columns.form(cause, dt).push_rows_at_end(&mut out),
                    Some(step) => push_rows_of_change(model, regime, cause, step.change(cause), dt, &mut out),
                }
                if matches!(cause, Cause::Ramp(_) | Cause::GroundRamp) {
                    // Per interval instead of per second.
                    let from = out.len() - 4 * padded(n);
                    out[from..].iter_mut().for_each(|entry| *entry /= dt);
                }
            }
            out
        };
        Self {
            rows: 4 * padded(n),
            state: gather(&mut (0..n).map(Cause::Drift).chain((0..n).map(Cause::DriftRate))),
            load: gather(&mut (0..n).map(Cause::Load)),
            ramp: gather(&mut (0..if with_ramps { n } else { 0 }).map(Cause::Ramp)),
            ground: gather(&mut std::iter::once(Cause::Ground)),
            ground_ramp: gather(&mut std::iter::once(Cause::GroundRamp)),
        }
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

/// Appends the rows (dx, dv, a, j) of a column from the change of the state over `h`.
fn push_rows_of_change(model: &Model, regime: &Regime, cause: Cause, change: &[f64], h: f64, out: &mut Vec<f64>) {
    let n = model.storeys();
    let (mut x, mut v) = (change[..n].to_vec(), change[n..].to_vec());
    let (mut load, mut slope, mut ground) = (vec![0.0; n], vec![0.0; n], 0.0);
    match cause {
        Cause::Drift(i) => x[i] += 1.0,
        Cause::DriftRate(i) => v[i] += 1.0,
        Cause::Load(i) => load[i] = 1.0,
        Cause::Ramp(i) => (load[i], slope[i]) = (h, 1.0),
        Cause::Ground => ground = 1.0,
        Cause::GroundRamp => ground = h,
    }
    let (mut a, mut jerk) = (vec![0.0; n], vec![0.0; n]);
    regime.accelerations(model, &x, &v, &load, &mut a);
    let mut below = ground;
    let drift_acceleration: Vec<f64> = a.iter().map(|&a| a - std::mem::replace(&mut below, a)).collect();
    regime.accelerations(model, &v, &drift_acceleration, &slope, &mut jerk);
    for part in [&change[..n], &change[n..], &a, &jerk] {
        out.extend_from_slice(part);
        out.extend(std::iter::repeat_n(0.0, padded(n) - n));
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
    const SERIES_VISITS: u32 = 2;
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
    pub(crate) fn visit(&mut self, index: usize, model: &Model, full_damping: bool, vertical: bool) -> bool {
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
        if entry.regime.propagator.as_ref().is_none_or(|p| vertical && p.ramp.is_empty()) {
            let propagator = Propagator::new(model, &entry.regime, self.dt, vertical);
            self.bytes += propagator.bytes();
            entry.regime.propagator = Some(Box::new(propagator));
        }
        if entry.visits == Self::SERIES_VISITS + 1 {
            self.run_bytes += entry.regime.propagator.as_ref().map_or(0, |p| p.bytes());
        }
        true
    }
}
