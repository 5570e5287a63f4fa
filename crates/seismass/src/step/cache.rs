//! The regimes that a run or a batch has met, with their steps.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::ops::Deref;
use std::rc::Rc;

use rustc_hash::FxBuildHasher;

use crate::lanes::{MAX_DENSE, WIDTH};
use crate::machines::model::Model;
use crate::regime::{Regime, Row};
use crate::step::steps::{MAX_TABLE, Steps};
use crate::step::tall::TallStep;

/// Memory one cache may take before it starts afresh (bytes).
const CACHE_BYTES: usize = 64 << 20;

/// Storeys less the whole intervals that are solved by series in a regime of two vectors before its steps are formed.
const WITHOUT_VISITS: u32 = 3;

/// Largest ratio of a floor's mass, with blocks, to the smallest mass of a floor at which intervals are solved in substeps.
/// Each plain step repeats the rounding of its matrix, some 1e-15 of the drift rates: with many substeps it sums up to what
/// can be seen in the energy of a floor so heavy.
const MAX_MASS_RATIO: f64 = 1e4;

/// A regime with its steps of one time step, formed once they pay.
#[derive(Default)]
pub(crate) struct KnownRegime {
    regime: Regime,
    /// Without vertical motion, and with it.
    steps: [OnceCell<Steps>; 2],
}

impl KnownRegime {
    /// The steps of the cache's time step, if they are formed, without vertical motion or with it.
    #[inline(always)]
    pub(crate) fn steps(&self, vertical: bool) -> Option<&Steps> {
        self.steps[usize::from(vertical)].get()
    }
}

impl Deref for KnownRegime {
    type Target = Regime;

    #[inline(always)]
    fn deref(&self) -> &Regime {
        &self.regime
    }
}

/// An entry of the cache: a regime, and how often the present run took a whole interval in it.
struct Entry {
    /// Shared with the run that is in it.
    regime: Rc<KnownRegime>,
    run: u64,
    visits: u32,
}

/// Places of entries by key. Most keys are one word.
#[derive(Default)]
struct Index {
    of_words: HashMap<u64, usize, FxBuildHasher>,
    of_longer: HashMap<Vec<u64>, usize, FxBuildHasher>,
}

impl Index {
    #[inline]
    fn get(&self, key: &[u64]) -> Option<usize> {
        match key {
            [word] => self.of_words.get(word),
            _ => self.of_longer.get(key),
        }
        .copied()
    }

    fn insert(&mut self, key: &[u64], index: usize) {
        match key {
            &[word] => self.of_words.insert(word, index),
            _ => self.of_longer.insert(key.to_vec(), index),
        };
    }
}

/// The regimes met so far by scenes of equal structure at one time step.
///
/// What a run computes never depends on what is cached: where the steps of a regime pay only after some time, a run takes
/// its first [`RegimeCache::series_visits`] intervals by series whether or not another run has already paid for them.
pub(crate) struct RegimeCache {
    dt: f64,
    /// See [`RegimeCache::frequency`]; none before it is asked for.
    frequency: Option<f64>,
    entries: Vec<Entry>,
    index: Index,
    run: u64,
    /// Memory taken by all entries.
    bytes: usize,
    /// Memory taken by what the present run has met.
    run_bytes: usize,
    /// Working space of forming steps.
    sums: Vec<f64>,
}

impl RegimeCache {
    /// Whole intervals of a regime that a run solves by series before its steps are formed. To form them costs like
    /// n^3, a series saved like n^2 with full damping matrices and like n with others: about as many series as there are
    /// storeys pay for them. Those of one vector are formed at once, those of two somewhat earlier: they are
    /// formed without shifts.
    fn series_visits(storeys: usize) -> u32 {
        match storeys {
            _ if storeys <= WIDTH => 0,
            _ if storeys <= MAX_TABLE => storeys as u32 - WITHOUT_VISITS,
            _ => storeys as u32,
        }
    }

    /// A cache of steps of `dt`.
    pub(crate) fn new(dt: f64) -> Self {
        let (entries, sums) = (Vec::new(), Vec::new());
        Self { dt, frequency: None, entries, index: Index::default(), run: 0, bytes: 0, run_bytes: 0, sums }
    }

    /// Makes it one of steps of `dt`: what it holds of others is forgotten.
    pub(crate) fn set_time_step(&mut self, dt: f64) {
        if self.dt.to_bits() != dt.to_bits() {
            self.dt = dt;
            self.clear();
        }
    }

    /// The frequency that a step of a run must suit (rad/s): a bound on those of the elastic building, all blocks stuck.
    /// 0, so that any step does, where floors and their blocks differ too much in mass ([`MAX_MASS_RATIO`]).
    pub(crate) fn frequency(&mut self, model: &Model) -> f64 {
        *self.frequency.get_or_insert_with(|| {
            let mut stuck_mass = vec![0.0; model.storeys()];
            for block in model.blocks.iter().filter(|block| block.floor > 0) {
                stuck_mass[block.floor - 1] += block.mass;
            }
            let heaviest = model.mass.iter().zip(&stuck_mass).map(|(floor, stuck)| floor + stuck).fold(0.0, f64::max);
            let lightest = model.mass.iter().copied().fold(f64::INFINITY, f64::min);
            if heaviest > MAX_MASS_RATIO * lightest {
                0.0
            } else {
                Regime::new(model, |i| model.laws[i].spring.law().largest_tangent(), &stuck_mass).frequency
            }
        })
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
        *self = Self { run: self.run, frequency: self.frequency, ..Self::new(self.dt) };
    }

    /// The regime of a key, formed by `form` when it is new. Returns it, its index, and whether this run knew it.
    pub(crate) fn enter(&mut self, key: &[u64], form: impl FnOnce() -> Regime) -> (Rc<KnownRegime>, usize, bool) {
        if self.run_bytes > CACHE_BYTES {
            self.clear();
        }
        let index = match self.index.get(key) {
            Some(index) => index,
            None => {
                let regime = Rc::new(KnownRegime { regime: form(), steps: Default::default() });
                self.bytes += Self::entry_bytes(&regime, key);
                self.entries.push(Entry { regime, run: 0, visits: 0 });
                self.index.insert(key, self.entries.len() - 1);
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
        (Rc::clone(&entry.regime), index, known)
    }

    fn entry_bytes(regime: &Regime, key: &[u64]) -> usize {
        8 * regime.row(Row::Mass).len() * 16 + 16 * key.len() + 256
    }

    /// Whether series of a regime go by its table, which then exists: once the present run has taken as many intervals in
    /// it as are solved without.
    #[inline]
    pub(crate) fn prepare_table(&mut self, index: usize, model: &Model, vertical: bool) -> bool {
        let n = model.storeys();
        let entry = &self.entries[index];
        if n == 0 || n > MAX_TABLE || n > WIDTH && entry.visits <= Self::series_visits(n) {
            return false;
        }
        if entry.regime.steps(vertical).is_none() {
            self.form_steps(index, model, vertical);
        }
        true
    }

    #[cold]
    fn form_steps(&mut self, index: usize, model: &Model, vertical: bool) {
        let regime = &self.entries[index].regime;
        let steps = Steps::new(model, regime, self.dt, vertical, &mut self.sums);
        self.bytes += steps.bytes(vertical);
        regime.steps[usize::from(vertical)].get_or_init(|| steps);
    }

    /// Counts a whole interval in a regime; true once its propagator is to be used, which then exists.
    pub(crate) fn visit(&mut self, index: usize, model: &Model, vertical: bool) -> bool {
        let entry = &mut self.entries[index];
        let n = model.storeys();
        let is_tall = Steps::are_tall(model, &entry.regime, self.dt);
        if n == 0 || n > MAX_DENSE && !is_tall {
            return false;
        }
        let series_visits = if is_tall { TallStep::series_visits(model) } else { Self::series_visits(n) };
        entry.visits = entry.visits.saturating_add(1);
        if entry.visits <= series_visits {
            return false;
        }
        if entry.regime.steps(vertical).is_none() {
            self.form_steps(index, model, vertical);
        }
        let entry = &self.entries[index];
        if entry.visits == series_visits + 1 {
            self.run_bytes += entry.regime.steps(vertical).map_or(0, |steps| steps.bytes(vertical));
        }
        true
    }
}
