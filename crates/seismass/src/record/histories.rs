//! Histories while a run writes them, row by row.

use std::mem::take;

use crate::error::{Domain, Error, Result};
use crate::lanes::{MAX_LANES, Padded, Vector, WIDTH, by_width, for_each_path, load, store};
use crate::machines::block::BlockMotion;
use crate::machines::model::Model;
use crate::memory::is_there_memory;
use crate::regime::Row;
use crate::response::Histories;
use crate::scene::Options;
use crate::state::State;

/// Rows of a quantity one after the other. A row is written in whole vectors: what is beyond it belongs to the next, which
/// overwrites it.
pub(crate) struct HistoryTable {
    values: Vec<f64>,
    width: usize,
}

impl HistoryTable {
    /// Room for so many rows, of `width` numbers, written in `written` numbers.
    fn new(rows: usize, width: usize, written: usize) -> Self {
        let length = if width > 0 { rows * width + written - width } else { 0 };
        Self { values: vec![0.0; length], width }
    }

    /// Writes a row in vectors, from number `first` on.
    #[inline(always)]
    fn put<V: Vector, const K: usize>(&mut self, first: usize, values: &[V; K]) {
        if let Some(numbers) = self.values.get_mut(first..) {
            store(values, numbers);
        }
    }

    /// Writes a row, from number `first` on.
    #[inline(always)]
    fn put_row(&mut self, first: usize, values: impl Iterator<Item = f64>) {
        if let Some(numbers) = self.values.get_mut(first..) {
            numbers.iter_mut().zip(values).for_each(|(out, value)| *out = value);
        }
    }

    /// The rows, with NaN in those from `written` on.
    fn finish(mut self, rows: usize, written: usize) -> Vec<f64> {
        self.values.truncate(rows * self.width);
        self.values[written * self.width..].fill(f64::NAN);
        self.values
    }
}

/// Where a row begins in the tables of storeys and in those of blocks.
#[derive(Clone, Copy)]
struct Place {
    storeys: usize,
    blocks: usize,
}

/// Sums of each lane and all below it, each added to the sum below it, as those of numbers are formed.
#[inline(always)]
fn running_sums<V: Vector, const K: usize>(values: &[V; K]) -> [V; K] {
    let (mut below, mut sums) = (V::splat(0.0), *values);
    for k in 0..K {
        // Each turn makes one lane more right; below the lowest of all is zero.
        for _ in usize::from(k == 0)..WIDTH {
            sums[k] = values[k].add(sums[k].shifted_up(below));
        }
        below = sums[k];
    }
    sums
}

/// Drift coordinates, drift rates and floor accelerations of a row, in vectors.
pub(crate) struct RowInLanes<'a, V, const K: usize> {
    pub(crate) x: &'a [V; K],
    pub(crate) v: &'a [V; K],
    pub(crate) a: &'a [V; K],
}

/// Relative velocities and slips of blocks that stand one on each floor, in the lanes of these.
#[derive(Clone, Copy)]
pub(crate) struct BlocksInLanes<V, const K: usize> {
    velocity: [V; K],
    slip: [V; K],
}

impl<V: Vector, const K: usize> BlocksInLanes<V, K> {
    /// Of a state: read one by one, for to read as vectors what has just been written in numbers would be to wait for it.
    #[inline(always)]
    fn of(motions: &[BlockMotion]) -> Self {
        let zero = [V::splat(0.0); K];
        let mut blocks = Self { velocity: zero, slip: zero };
        for k in 0..K {
            let (mut velocity, mut slip) = ([0.0; WIDTH], [0.0; WIDTH]);
            for lane in 0..WIDTH {
                if let Some(motion) = motions.get(WIDTH * k + lane) {
                    (velocity[lane], slip[lane]) = (motion.velocity, motion.slip);
                }
            }
            (blocks.velocity[k], blocks.slip[k]) = (V::of(velocity), V::of(slip));
        }
        blocks
    }
}

/// Writes histories.
pub(crate) struct Recorder {
    every: usize,
    rows: usize,
    displacements_only: bool,
    /// Samples of the run from row to row.
    stride: usize,
    /// Rows written so far.
    written: usize,
    /// Whether block after block stands on floor after floor, one on each: then what blocks do is in the lanes of floors.
    one_on_each: bool,
    drift: HistoryTable,
    slip: HistoryTable,
    floor_velocity: HistoryTable,
    block_velocity: HistoryTable,
    floor_acceleration: HistoryTable,
    storey_force: HistoryTable,
    /// In the present regime, by storey, padded: drift and force at the springs' bases, and spring tangents.
    base_drift: Padded,
    base_force: Padded,
    tangent: Padded,
    /// By block, padded: slip and relative velocity as the next row has them.
    slips: Padded,
    velocities: Padded,
    /// Of the ground and of the floors, padded: velocity in the row that is written.
    floor_velocities: Vec<f64>,
    /// Whether springs and blocks are taken up as they are now.
    is_taken_up: bool,
}

impl Recorder {
    /// A recorder of a run over so many samples, a row every so many of the caller's, which every `substeps`-th is.
    ///
    /// # Errors
    /// [`Error::Invalid`] where there is no memory for as many rows.
    pub(crate) fn new(model: &Model, options: &Options, samples: usize, every: usize, substeps: usize) -> Result<Self> {
        let (n, blocks) = (model.storeys(), model.blocks.len());
        let stride = every.saturating_mul(substeps);
        let rows = samples.div_ceil(stride);
        let one_on_each = blocks == n && model.blocks.iter().enumerate().all(|(i, law)| law.floor == i + 1);
        let storeys = model.width;
        let blocks_written = if one_on_each { storeys } else { blocks.next_multiple_of(WIDTH) };
        let all = !options.displacements_only;
        let of_storeys = |is_kept: bool| HistoryTable::new(rows, if is_kept { n } else { 0 }, storeys);
        let of_blocks = |is_kept: bool| HistoryTable::new(rows, if is_kept { blocks } else { 0 }, blocks_written);
        let of_row = if all { 4 * storeys + 2 * blocks_written } else { storeys + blocks_written };
        if !is_there_memory(rows.saturating_mul(of_row)) {
            let (requirement, value) =
                ("of so few samples that they fit into memory", format!("{rows} rows of {of_row} numbers"));
            return Err(Error::invalid(Domain::Options, "histories", "run", requirement, value));
        }
        Ok(Self {
            every,
            rows,
            displacements_only: options.displacements_only,
            stride,
            written: 0,
            one_on_each,
            drift: of_storeys(true),
            slip: of_blocks(true),
            floor_velocity: of_storeys(all),
            block_velocity: of_blocks(all),
            floor_acceleration: of_storeys(all),
            storey_force: of_storeys(all),
            base_drift: Padded::new(storeys, 0.0),
            base_force: Padded::new(storeys, 0.0),
            tangent: Padded::new(storeys, 0.0),
            slips: Padded::new(blocks_written, 0.0),
            velocities: Padded::new(blocks_written, 0.0),
            floor_velocities: vec![0.0; 1 + storeys],
            is_taken_up: false,
        })
    }

    /// Where the next row is to be written.
    #[inline(always)]
    fn place(&self) -> Place {
        Place { storeys: self.written * self.drift.width, blocks: self.written * self.slip.width }
    }

    /// The same; the row counts as written.
    #[inline(always)]
    fn next_row(&mut self) -> Place {
        let at = self.place();
        self.written += 1;
        at
    }

    /// The next sample of which a row is kept.
    #[inline]
    pub(crate) fn next_sample(&self) -> usize {
        self.written * self.stride
    }

    /// Takes the last row back, if it is that of a sample: it is then the next to be written.
    pub(crate) fn take_back(&mut self, sample: usize) -> bool {
        let last = self.written.checked_sub(1).filter(|last| last * self.stride == sample);
        self.written = last.unwrap_or(self.written);
        last.is_some()
    }

    /// Takes up the springs and blocks of the present state, for rows in vectors, unless its own row has just been written.
    pub(crate) fn take_up(&mut self, state: &State) {
        if !take(&mut self.is_taken_up) {
            by_width!(state.model.width, K => take_up::<K>(self, state));
        }
    }

    /// The same within the code of a path; returns the blocks where one stands on each floor.
    #[inline(always)]
    fn take_up_in_lanes<V: Vector, const K: usize>(&mut self, state: &State) -> Option<BlocksInLanes<V, K>> {
        store::<V, K>(&load(&state.springs.base_drift), &mut self.base_drift);
        store::<V, K>(&load(&state.springs.base_force), &mut self.base_force);
        store::<V, K>(&state.regime.lanes(Row::SpringTangent), &mut self.tangent);
        if self.one_on_each {
            let blocks = BlocksInLanes::of(&state.blocks.motions);
            store(&blocks.velocity, &mut self.velocities);
            store(&blocks.slip, &mut self.slips);
            return Some(blocks);
        }
        let (velocities, slips) = (&mut self.velocities[..], &mut self.slips[..]);
        for ((velocity, slip), motion) in velocities.iter_mut().zip(slips).zip(&state.blocks.motions) {
            (*velocity, *slip) = (motion.velocity, motion.slip);
        }
        None
    }

    /// The blocks taken up where one stands on each floor, but those that have moved since in some lanes, as bits.
    #[inline(always)]
    pub(crate) fn blocks<V: Vector, const K: usize>(
        &self,
        lanes: &[u32; K],
        velocity: &[V; K],
        slip: &[V; K],
    ) -> BlocksInLanes<V, K> {
        let mut blocks = BlocksInLanes::<V, K> { velocity: load(&self.velocities), slip: load(&self.slips) };
        for k in 0..K {
            blocks.velocity[k] = blocks.velocity[k].with(lanes[k], velocity[k]);
            blocks.slip[k] = blocks.slip[k].with(lanes[k], slip[k]);
        }
        blocks
    }

    /// Notes relative velocity and slip of a block, for rows in vectors.
    #[inline(always)]
    pub(crate) fn move_block(&mut self, block: usize, velocity: f64, slip: f64) {
        (self.velocities[block], self.slips[block]) = (velocity, slip);
    }

    /// Whether one block stands on each floor, in their order.
    #[inline]
    pub(crate) fn has_one_on_each(&self) -> bool {
        self.one_on_each
    }

    /// Writes a row with the springs taken up, and these blocks, or those taken up.
    #[inline(always)]
    fn put<V: Vector, const K: usize>(
        &mut self,
        at: Place,
        model: &Model,
        row: &RowInLanes<V, K>,
        blocks: Option<BlocksInLanes<V, K>>,
    ) {
        let base: [V; K] = load(&self.base_drift);
        let mut drift = base;
        for k in 0..K {
            drift[k] = base[k].add(row.x[k]);
        }
        self.drift.put(at.storeys, &drift);
        if self.one_on_each {
            let slips = match &blocks {
                Some(blocks) => blocks.slip,
                None => load(&self.slips),
            };
            self.slip.put(at.blocks, &slips);
        } else {
            self.slip.put_row(at.blocks, self.slips.iter().copied());
        }
        if self.displacements_only {
            return;
        }
        let velocity = running_sums(row.v);
        let (force, tangent): ([V; K], [V; K]) = (load(&self.base_force), load(&self.tangent));
        let mut storey_force = force;
        for k in 0..K {
            storey_force[k] = tangent[k].mul(row.x[k]).add(force[k]);
        }
        self.storey_force.put(at.storeys, &storey_force);
        self.floor_velocity.put(at.storeys, &velocity);
        self.floor_acceleration.put(at.storeys, row.a);
        if self.one_on_each {
            let mut of_blocks = match &blocks {
                Some(blocks) => blocks.velocity,
                None => load(&self.velocities),
            };
            for k in 0..K {
                of_blocks[k] = velocity[k].add(of_blocks[k]);
            }
            self.block_velocity.put(at.blocks, &of_blocks);
        } else {
            store(&velocity, &mut self.floor_velocities[1..]);
            self.put_block_velocities(at, model);
        }
    }

    /// Writes the velocities of the blocks of a row.
    #[inline(always)]
    fn put_block_velocities(&mut self, at: Place, model: &Model) {
        let velocities = model.blocks.iter().zip(&self.velocities);
        let velocities = velocities.map(|(law, relative)| self.floor_velocities[law.floor] + relative);
        self.block_velocity.put_row(at.blocks, velocities);
    }

    /// Appends the present state, if it has a row.
    pub(crate) fn append_state(&mut self, state: &State, sample: usize) {
        by_width!(state.model.width, K => append_state::<K>(self, state, sample));
    }

    /// [`Recorder::append_state`] within the code of a path.
    #[inline(always)]
    pub(crate) fn append_state_in_lanes<V: Vector, const K: usize>(&mut self, state: &State, sample: usize) {
        self.is_taken_up = false;
        if self.next_sample() != sample {
            return;
        }
        if state.storeys() <= MAX_LANES {
            let at = self.next_row();
            let blocks = self.take_up_in_lanes::<V, K>(state);
            let (x, v, a): ([V; K], [V; K], [V; K]) =
                (load(&state.kinematics.x), load(&state.kinematics.v), load(&state.kinematics.a));
            self.put(at, state.model, &RowInLanes { x: &x, v: &v, a: &a }, blocks);
            self.is_taken_up = true;
        } else {
            let blocks = state.blocks.motions.iter().map(|m| (m.velocity, m.slip));
            self.append_row(state, &state.kinematics.x, &state.kinematics.v, &state.kinematics.a, blocks);
        }
    }

    /// Appends a row: drift coordinates, drift rates, floor accelerations, and (velocity, slip) of the blocks, in the
    /// regime of `state`.
    pub(crate) fn append_row(
        &mut self,
        state: &State,
        x: &[f64],
        v: &[f64],
        a: &[f64],
        blocks: impl Iterator<Item = (f64, f64)>,
    ) {
        let at = self.next_row();
        for (block, (velocity, slip)) in blocks.enumerate() {
            self.move_block(block, velocity, slip);
        }
        self.drift.put_row(at.storeys, state.springs.machines.iter().zip(x).map(|(spring, &x)| spring.drift(x)));
        self.slip.put_row(at.blocks, self.slips.iter().copied());
        if self.displacements_only {
            return;
        }
        let n = state.storeys();
        let tangent = state.regime.row(Row::SpringTangent);
        let forces = state.springs.base_force.iter().zip(tangent).zip(x).map(|((base, tangent), x)| tangent * x + base);
        self.storey_force.put_row(at.storeys, forces);
        let mut velocity = 0.0;
        for (out, rate) in self.floor_velocities[1..].iter_mut().zip(&v[..n]) {
            velocity += rate;
            *out = velocity;
        }
        self.floor_velocity.put_row(at.storeys, self.floor_velocities[1..=n].iter().copied());
        self.floor_acceleration.put_row(at.storeys, a[..n].iter().copied());
        self.put_block_velocities(at, state.model);
    }

    /// The histories; NaN fills what a collapsed run did not reach.
    pub(crate) fn finish(self) -> Histories {
        let (rows, written) = (self.rows, self.written);
        Histories {
            every: self.every,
            rows,
            drift: self.drift.finish(rows, written),
            slip: self.slip.finish(rows, written),
            floor_velocity: self.floor_velocity.finish(rows, written),
            block_velocity: self.block_velocity.finish(rows, written),
            floor_acceleration: self.floor_acceleration.finish(rows, written),
            storey_force: self.storey_force.finish(rows, written),
        }
    }
}

for_each_path! {
    /// See [`Recorder::take_up`].
    fn take_up[K: usize](recorder: &mut Recorder, state: &State) = take_up_by_path
}

#[inline(always)]
fn take_up_by_path<V: Vector, const K: usize>(recorder: &mut Recorder, state: &State) {
    recorder.take_up_in_lanes::<V, K>(state);
}

for_each_path! {
    /// See [`Recorder::append_state`].
    fn append_state[K: usize](recorder: &mut Recorder, state: &State, sample: usize) = append_by_path
}

#[inline(always)]
fn append_by_path<V: Vector, const K: usize>(recorder: &mut Recorder, state: &State, sample: usize) {
    recorder.append_state_in_lanes::<V, K>(state, sample);
}

/// Appends rows within a run of plain steps, with the springs and blocks taken up.
pub(crate) struct HistoryWriter<'a> {
    recorder: &'a mut Recorder,
    /// Of the next row: its number, its place, and its sample.
    row: usize,
    at: Place,
    sample: usize,
}

impl<'a> HistoryWriter<'a> {
    #[inline(always)]
    pub(crate) fn new(recorder: &'a mut Recorder) -> Self {
        let (row, at, sample) = (recorder.written, recorder.place(), recorder.next_sample());
        Self { recorder, row, at, sample }
    }

    /// The sample of the next row.
    #[inline(always)]
    pub(crate) fn sample(&self) -> usize {
        self.sample
    }

    #[inline(always)]
    pub(crate) fn recorder(&mut self) -> &mut Recorder {
        self.recorder
    }

    /// Appends a row with these blocks where one stands on each floor, or with those taken up.
    #[inline(always)]
    pub(crate) fn append<V: Vector, const K: usize>(
        &mut self,
        model: &Model,
        row: &RowInLanes<V, K>,
        blocks: Option<BlocksInLanes<V, K>>,
    ) {
        self.recorder.put(self.at, model, row, blocks);
        self.row += 1;
        self.at.storeys += self.recorder.drift.width;
        self.at.blocks += self.recorder.slip.width;
        self.sample += self.recorder.stride;
    }

    /// Has the rows count as written.
    #[inline(always)]
    pub(crate) fn lay_down(self) {
        self.recorder.written = self.row;
    }
}
