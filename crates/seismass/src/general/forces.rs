//! Forces and accelerations at an instant, and the sizes of their terms.

use crate::general::state::GeneralState;
use crate::machines::block::BlockState;
use crate::machines::settle::Demand;

/// Forces of springs, matrix and dampers on the nodes at an instant, without friction and stops (N).
pub(super) struct NodeForces {
    pub(super) force: Vec<f64>,
    /// Sums of the sizes of their terms.
    pub(super) size: Vec<f64>,
}

impl GeneralState<'_> {
    /// Forces on the nodes now.
    pub(super) fn node_forces(&self) -> NodeForces {
        let system = self.system;
        let width = system.nodes + 1;
        let (mut shear, mut shear_size) = (vec![0.0; width], vec![0.0; width]);
        for p in 1..width {
            let elastic = self.regime.tangent[p] * self.x[p];
            shear[p] = self.base_load[p] + elastic;
            shear_size[p] = self.base_load[p].abs() + elastic.abs();
        }
        for part in &system.parts {
            let nodes = part.first..part.first + part.count;
            for (matrix, values) in [(&part.damping, &self.v), (&part.elastic, &self.x)] {
                for (column, value) in matrix.chunks_exact(part.count).zip(&values[nodes.clone()]) {
                    let rows = shear[nodes.clone()].iter_mut().zip(&mut shear_size[nodes.clone()]);
                    for ((shear, size), entry) in rows.zip(column) {
                        *shear += entry * value;
                        *size += (entry * value).abs();
                    }
                }
            }
        }
        let (mut force, mut size) = (vec![0.0; width], vec![0.0; width]);
        for p in (1..width).rev() {
            force[p] -= shear[p];
            size[p] += shear_size[p];
            force[system.parent[p]] += shear[p];
            size[system.parent[p]] += shear_size[p];
        }
        NodeForces { force, size }
    }

    /// Friction and stops of the blocks that move on a node, as forces on the node, and their size (N).
    pub(super) fn block_forces(&self, node: usize, tau: f64) -> (f64, f64) {
        let contact = self.contact_at(tau);
        let (mut force, mut size) = (0.0, 0.0);
        for &j in &self.system.on_node[node] {
            if self.motions[j].is_stuck() {
                continue;
            }
            let of_stop = -self.stop_force(j);
            let friction = self.friction_coefficient(j) * self.system.blocks[j].mass * contact;
            force += friction + of_stop;
            size += friction.abs() + of_stop.abs();
        }
        (force, size)
    }

    /// Force of its stop on a block now (N).
    pub(super) fn stop_force(&self, block: usize) -> f64 {
        self.stops[block].force(self.system.stops[block].as_ref(), self.motions[block].velocity)
    }

    /// mu_k with the sign of the relative velocity; zero where the block does not slide.
    pub(super) fn friction_coefficient(&self, block: usize) -> f64 {
        match self.motions[block].state {
            BlockState::Sliding(sign) => sign.factor() * self.motions[block].mu_k,
            _ => 0.0,
        }
    }

    /// Absolute accelerations of the nodes, that of the ground first (m/s2).
    pub(super) fn accelerations(&self, tau: f64) -> Vec<f64> {
        let NodeForces { mut force, .. } = self.node_forces();
        force[0] += self.base_forces(tau).0;
        for (p, value) in force.iter_mut().enumerate() {
            *value = (*value + self.block_forces(p, tau).0) * self.regime.inverse_mass[p];
        }
        if !self.base_moves() {
            force[0] = self.interval.ground_at(tau);
        }
        force
    }

    /// Sums of the sizes of the terms of the nodes' absolute accelerations: times rounding, their errors.
    pub(super) fn acceleration_sizes(&self, tau: f64) -> Vec<f64> {
        let NodeForces { mut size, .. } = self.node_forces();
        size[0] += self.base_forces(tau).1;
        for (p, value) in size.iter_mut().enumerate() {
            *value = (*value + self.block_forces(p, tau).1) * self.regime.inverse_mass[p];
        }
        if !self.base_moves() {
            size[0] = self.interval.ground_at(tau).abs();
        }
        size
    }

    /// What a node asks of its blocks, with the forces of stops that touch blocks in motion.
    pub(super) fn demand(&self, node: usize, tau: f64) -> Demand {
        if node == 0 && !self.base_moves() {
            return Demand::Ground { acceleration: self.interval.ground_at(tau) };
        }
        let NodeForces { mut force, mut size } = self.node_forces();
        let (of_base, base_size) = self.base_forces(tau);
        (force[0], size[0]) = (force[0] + of_base, size[0] + base_size);
        let moving = self.system.on_node[node].iter().filter(|&&j| self.motions[j].velocity != 0.0);
        let of_stops: Vec<f64> = moving.map(|&j| -self.stop_force(j)).collect();
        Demand::Floor {
            force: force[node] + of_stops.iter().sum::<f64>(),
            size: size[node] + of_stops.iter().map(|force| force.abs()).sum::<f64>(),
            mass: self.system.mass[node],
        }
    }
}
