//! Histories while a run writes them, row by row.

use crate::lanes::{Vector, WIDTH, load, numbers, store};
use crate::model::Model;
use crate::regime::Row;
use crate::response::Histories;
use crate::scene::Options;
use crate::state::State;

/// Rows of a quantity one after the other. A row is written in whole vectors: what is beyond it belongs to the next, which
/// overwrites it.
struct Table {
    values: Vec<f64>,
    width: usize,
    /// Numbers written so far.
    end: usize,
}

impl Table {
    /// Room for so many rows, of `width` numbers, written in `written` numbers.
    fn new(rows: usize, width: usize, written: usize) -> Self {
        let length = if width > 0 { rows * width + written - width } else { 0 };
        Self { values: vec![0.0; length], width, end: 0 }
    }

    /// The place of the next row, and all after it; the row counts as written.
    #[inline(always)]
    fn next_row(&mut self) -> &mut [f64] {
        let from = self.end;
        self.end += self.width;
        self.values.get_mut(from..).unwrap_or_default()
    }

    /// Appends a row in vectors.
    #[inline(always)]
    fn append<V: Vector, const K: usize>(&mut self, row: &[V; K]) {
        store(row, self.next_row());
    }

    /// Appends a padded row.
    #[inline(always)]
    fn append_padded(&mut self, row: &[f64]) {
        let out = self.next_row().as_chunks_mut::<WIDTH>().0;
        for (out, row) in out.iter_mut().zip(row.as_chunks::<WIDTH>().0) {
            *out = *row;
        }
    }

    /// Appends a row.
    fn append_row(&mut self, row: impl Iterator<Item = f64>) {
        self.next_row().iter_mut().zip(row).for_each(|(out, value)| *out = value);
    }

    /// The rows, with NaN in those that were not written.
    fn finish(mut self, rows: usize) -> Vec<f64> {
        self.values.truncate(rows * self.width);
        if let Some(missing) = self.values.get_mut(self.end..) {
            missing.fill(f64::NAN);
        }
        self.values
    }
}

/// Drift coordinates, drift rates and floor accelerations of a row, in vectors.
pub(crate) struct RowInLanes<'a, V, const K: usize> {
    pub(crate) x: &'a [V; K],
    pub(crate) v: &'a [V; K],
    pub(crate) a: &'a [V; K],
}

/// Writes histories.
pub(crate) struct Recorder {
    every: usize,
    rows: usize,
    displacements_only: bool,
    /// The next sample of which a row is kept.
    next_sample: usize,
    drift: Table,
    slip: Table,
    floor_velocity: Table,
    block_velocity: Table,
    floor_acceleration: Table,
    storey_force: Table,
    /// In the present regime, by storey, padded: drift and force at the springs' bases, and spring tangents.
    base_drift: Vec<f64>,
    base_force: Vec<f64>,
    tangent: Vec<f64>,
    /// By block, padded: slip and relative velocity as the next row has them.
    slips: Vec<f64>,
    velocities: Vec<f64>,
}

impl Recorder {
    /// A recorder of a run over so many samples, a row every so many.
    pub(crate) fn new(model: &Model, options: &Options, samples: usize, every: usize) -> Self {
        let (n, blocks) = (model.storeys(), model.blocks.len());
        let rows = samples.div_ceil(every);
        let (storeys, blocks_written) = (model.width, blocks.next_multiple_of(WIDTH));
        let others = if options.displacements_only { 0 } else { rows };
        let of_storeys = |rows: usize| Table::new(rows, if rows > 0 { n } else { 0 }, storeys);
        let of_blocks = |rows: usize| Table::new(rows, if rows > 0 { blocks } else { 0 }, blocks_written);
        let zero = |length: usize| vec![0.0; length];
        Self {
            every,
            rows,
            displacements_only: options.displacements_only,
            next_sample: 0,
            drift: of_storeys(rows),
            slip: of_blocks(rows),
            floor_velocity: of_storeys(others),
            block_velocity: of_blocks(others),
            floor_acceleration: of_storeys(others),
            storey_force: of_storeys(others),
            base_drift: zero(storeys),
            base_force: zero(storeys),
            tangent: zero(storeys),
            slips: zero(blocks_written),
            velocities: zero(blocks_written),
        }
    }

    /// The next sample of which a row is kept.
    #[inline]
    pub(crate) fn next_sample(&self) -> usize {
        self.next_sample
    }

    /// Takes the last row back, if it is that of a sample: it is then the next to be written.
    pub(crate) fn take_back(&mut self, sample: usize) -> bool {
        let is_last = self.next_sample == sample + self.every;
        if is_last {
            self.next_sample = sample;
            let of_storeys =
                [&mut self.drift, &mut self.floor_velocity, &mut self.floor_acceleration, &mut self.storey_force];
            let of_blocks = [&mut self.slip, &mut self.block_velocity];
            for table in of_storeys.into_iter().chain(of_blocks) {
                table.end -= table.width;
            }
        }
        is_last
    }

    /// Takes up the springs and blocks of the present state, for rows in vectors.
    pub(crate) fn take_up(&mut self, state: &State) {
        for (base, spring) in self.base_drift.iter_mut().zip(&state.springs) {
            *base = spring.drift(0.0);
        }
        for (base, &force) in self.base_force.iter_mut().zip(&state.base_force) {
            *base = force;
        }
        self.tangent.copy_from_slice(state.regime().row(Row::SpringTangent));
        for (block, motion) in state.motions.iter().enumerate() {
            self.move_block(block, motion.velocity, motion.slip);
        }
    }

    /// Notes relative velocity and slip of a block, for rows in vectors.
    #[inline(always)]
    pub(crate) fn move_block(&mut self, block: usize, velocity: f64, slip: f64) {
        (self.velocities[block], self.slips[block]) = (velocity, slip);
    }

    /// Appends a row with the springs and blocks taken up.
    #[inline(always)]
    pub(crate) fn append<V: Vector, const K: usize>(&mut self, model: &Model, row: &RowInLanes<V, K>) {
        self.next_sample += self.every;
        let base: [V; K] = load(&self.base_drift);
        let (force, tangent): ([V; K], [V; K]) = (load(&self.base_force), load(&self.tangent));
        let (mut drift, mut storey_force) = (base, force);
        for k in 0..K {
            drift[k] = base[k].add(row.x[k]);
            storey_force[k] = tangent[k].mul(row.x[k]).add(force[k]);
        }
        self.drift.append(&drift);
        self.slip.append_padded(&self.slips);
        if self.displacements_only {
            return;
        }
        // Summed from the ground upwards, as in any other row.
        let mut velocity = numbers(row.v);
        let mut below = 0.0;
        for velocity in velocity.as_flattened_mut() {
            below += *velocity;
            *velocity = below;
        }
        self.storey_force.append(&storey_force);
        self.floor_velocity.append_padded(velocity.as_flattened());
        self.floor_acceleration.append(row.a);
        let floor = |floor: usize| floor.checked_sub(1).map_or(0.0, |i| velocity.as_flattened()[i]);
        let blocks = model.blocks.iter().zip(&self.velocities);
        self.block_velocity.append_row(blocks.map(|(law, relative)| floor(law.floor) + relative));
    }

    /// Appends a row: drift coordinates, drift rates, floor accelerations, and (velocity, slip) of the blocks, in the
    /// regime of `state`.
    pub(crate) fn append_row(
        &mut self,
        state: &State,
        x: &[f64],
        v: &[f64],
        a: &[f64],
        blocks: impl Iterator<Item = (f64, f64)> + Clone,
    ) {
        self.next_sample += self.every;
        self.drift.append_row(state.springs.iter().zip(x).map(|(spring, &x)| spring.drift(x)));
        self.slip.append_row(blocks.clone().map(|(_, slip)| slip));
        if self.displacements_only {
            return;
        }
        let n = state.storeys();
        let tangent = state.regime().row(Row::SpringTangent);
        let forces = state.base_force.iter().zip(tangent).zip(x).map(|((base, tangent), x)| tangent * x + base);
        self.storey_force.append_row(forces);
        let from = self.floor_velocity.end;
        self.floor_velocity.append_row(v[..n].iter().scan(0.0, |velocity, rate| {
            *velocity += rate;
            Some(*velocity)
        }));
        self.floor_acceleration.append_row(a[..n].iter().copied());
        let floor = |floor: usize| floor.checked_sub(1).map_or(0.0, |i| self.floor_velocity.values[from + i]);
        let velocities = blocks.zip(&state.model.blocks).map(|((relative, _), law)| floor(law.floor) + relative);
        self.block_velocity.append_row(velocities);
    }

    /// The histories; NaN fills what a collapsed run did not reach.
    pub(crate) fn finish(self) -> Histories {
        let rows = self.rows;
        Histories {
            every: self.every,
            rows,
            drift: self.drift.finish(rows),
            slip: self.slip.finish(rows),
            floor_velocity: self.floor_velocity.finish(rows),
            block_velocity: self.block_velocity.finish(rows),
            floor_acceleration: self.floor_acceleration.finish(rows),
            storey_force: self.storey_force.finish(rows),
        }
    }
}
