//! Energies of a run.

use crate::response::Energy;
use crate::state::State;

/// Running energy integrals.
#[derive(Debug, Default)]
pub(crate) struct EnergyBalance {
    pub(crate) energy: Energy,
    pub(crate) largest_input: f64,
}

pub(crate) fn kinetic_energy(state: &State) -> f64 {
    let floors: Vec<f64> = state.kinematics.floor_velocities().collect();
    let building: f64 = state.model.mass.iter().zip(&floors).map(|(m, v)| 0.5 * m * v * v).sum();
    let blocks = state.blocks.motions.iter().zip(&state.model.blocks).map(|(motion, law)| {
        let velocity = motion.velocity + if law.floor > 0 { floors[law.floor - 1] } else { 0.0 };
        0.5 * law.mass * velocity * velocity
    });
    building + blocks.sum::<f64>()
}

pub(crate) fn elastic_energy(state: &State) -> f64 {
    state
        .springs
        .machines
        .iter()
        .zip(&state.model.laws)
        .zip(&state.kinematics.x)
        .map(|((spring, law), &x)| spring.stored(law, x))
        .sum()
}
