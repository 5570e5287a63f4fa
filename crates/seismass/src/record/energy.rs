//! Energies of a run.

use crate::response::Energy;
use crate::state::State;

/// Abscissae in [0, 1] and weights of the 12-point Gauss-Legendre rule: exact to degree 23.
pub(crate) const GAUSS: [(f64, f64); 12] = [
    (0.009219682876640375, 0.023587668193255914),
    (0.04794137181476257, 0.05346966299765921),
    (0.11504866290284765, 0.08003916427167311),
    (0.2063410228566913, 0.10158371336153296),
    (0.3160842505009099, 0.1167462682691774),
    (0.43738329574426554, 0.12457352290670139),
    (0.5626167042557345, 0.12457352290670139),
    (0.6839157494990901, 0.1167462682691774),
    (0.7936589771433087, 0.10158371336153296),
    (0.8849513370971523, 0.08003916427167311),
    (0.9520586281852375, 0.05346966299765921),
    (0.9907803171233597, 0.023587668193255914),
];

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
