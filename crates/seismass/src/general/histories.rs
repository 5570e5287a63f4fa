//! Histories while a run writes them, row by row.

use std::num::NonZeroUsize;

use crate::error::{Domain, Error, Result};
use crate::general::state::GeneralState;
use crate::general::system::System;
use crate::memory::is_there_memory;
use crate::response::Histories;
use crate::scene::Options;

/// Writes histories.
pub(super) struct Recorder {
    histories: Histories,
    /// Slip, velocity and acceleration of a sliding base.
    base: Option<[Vec<f64>; 3]>,
    displacements_only: bool,
    nodes: usize,
    goods: usize,
}

impl Recorder {
    /// # Errors
    /// [`Error::Invalid`] when the histories do not fit into memory.
    pub(super) fn new(system: &System, options: &Options, samples: usize, every: NonZeroUsize) -> Result<Self> {
        let (rows, nodes, goods) = ((samples - 1) / every + 1, system.nodes, system.blocks.len());
        let per_row = if options.displacements_only { nodes + goods } else { 4 * nodes + 2 * goods };
        let numbers = rows.saturating_mul(per_row);
        if !is_there_memory(numbers) {
            let requirement = "small enough for memory; take a larger decimation";
            let value = format!("{rows} rows of {per_row} numbers");
            return Err(Error::invalid(Domain::Options, "histories", "run", requirement, value));
        }
        let histories = Histories { every: every.get(), rows, ..Histories::default() };
        let base = system.base.is_some().then(Default::default);
        Ok(Self { histories, base, displacements_only: options.displacements_only, nodes, goods })
    }

    /// Appends the state, with accelerations of all nodes, if there is a row at the sample.
    pub(super) fn append(&mut self, state: &GeneralState, sample: usize, accelerations: impl FnOnce() -> Vec<f64>) {
        let histories = &mut self.histories;
        if !sample.is_multiple_of(histories.every) {
            return;
        }
        histories.drift.extend((1..=self.nodes).map(|p| state.drift(p)));
        histories.slip.extend(state.motions.iter().map(|motion| motion.slip));
        if let Some([slip, ..]) = &mut self.base {
            slip.push(state.x[0]);
        }
        if self.displacements_only {
            return;
        }
        let (velocities, accelerations) = (state.node_velocities(&state.v), accelerations());
        if let Some([_, velocity, acceleration]) = &mut self.base {
            velocity.push(velocities[0]);
            acceleration.push(accelerations[0]);
        }
        histories.floor_velocity.extend(&velocities[1..]);
        let of_goods = state.motions.iter().zip(&state.system.blocks);
        histories.block_velocity.extend(of_goods.map(|(motion, law)| motion.velocity + velocities[law.floor]));
        histories.floor_acceleration.extend(&accelerations[1..]);
        histories.storey_force.extend((1..=self.nodes).map(|p| state.spring_force(p)));
    }

    /// The histories, and those of a sliding base, with NaN in rows that were not reached.
    pub(super) fn finish(mut self) -> (Histories, [Vec<f64>; 3]) {
        let (rows, histories) = (self.histories.rows, &mut self.histories);
        let complete = |values: &mut Vec<f64>, width: usize| values.resize(rows * width, f64::NAN);
        complete(&mut histories.drift, self.nodes);
        complete(&mut histories.slip, self.goods);
        if !self.displacements_only {
            complete(&mut histories.floor_velocity, self.nodes);
            complete(&mut histories.block_velocity, self.goods);
            complete(&mut histories.floor_acceleration, self.nodes);
            complete(&mut histories.storey_force, self.nodes);
        }
        if let Some([slip, others @ ..]) = &mut self.base {
            complete(slip, 1);
            if !self.displacements_only {
                others.iter_mut().for_each(|values| complete(values, 1));
            }
        }
        (self.histories, self.base.unwrap_or_default())
    }
}
