//! Energies of a run, relative to the moving ground (`numerics`, section 5.8).

use crate::general::response::GeneralEnergy;
use crate::general::series::{Quantity, Series};
use crate::general::state::GeneralState;
use crate::lanes::Plain;
use crate::polynomial::quadrature::GAUSS;
use crate::units::STANDARD_GRAVITY;

/// Running energy integrals.
#[derive(Default)]
pub(super) struct Balance {
    energy: GeneralEnergy,
    largest_input: f64,
}

impl Balance {
    /// Notes the energy at the start.
    pub(super) fn begin(state: &GeneralState) -> Self {
        let energy = GeneralEnergy { initial: kinetic(state) + elastic(state), ..GeneralEnergy::default() };
        Self { energy, largest_input: 0.0 }
    }

    /// Adds the energies of a series up to its place `end`, before the state is advanced.
    pub(super) fn add(&mut self, state: &GeneralState, series: &Series, end: f64) {
        let (system, length) = (state.system, series.h * end);
        let blocks =
            (0..state.moving.len()).map(|position| (series.velocity_of(position), series.friction_of(position)));
        let blocks: Vec<_> = blocks.collect();
        let (mut rates, mut drifts) = (Vec::new(), Vec::new());
        for (node, weight) in GAUSS {
            let s = node * end;
            let (tau, weight) = (series.tau + s * series.h, weight * length);
            series.values(Quantity::Rate, s, &mut rates);
            for part in &system.parts {
                let rates = &rates[part.first..part.first + part.count];
                for (column, rate) in part.damping.chunks_exact(part.count).zip(rates) {
                    let of_column: f64 = column.iter().zip(rates).map(|(d, v)| d * v).sum();
                    self.energy.viscous += weight * of_column * rate;
                }
            }
            let nodes = state.node_velocities(&rates);
            if let Some(base) = &system.base {
                let contact = state.contact_at(tau);
                self.energy.friction += weight * state.base_friction() * base.carried * contact * rates[0];
                series.values(Quantity::Drift, s, &mut drifts);
                self.energy.input -= weight * base.restoring * (contact - STANDARD_GRAVITY) * drifts[0] * rates[0];
            }
            let mut momentum: f64 = system.mass.iter().zip(&nodes).map(|(m, v)| m * v).sum();
            momentum += system.blocks.iter().map(|law| law.mass * nodes[law.floor]).sum::<f64>();
            for ((velocity, friction), &j) in blocks.iter().zip(&state.moving) {
                let (mass, relative) = (system.blocks[j].mass, velocity.at::<Plain>(s));
                momentum += mass * relative;
                self.energy.friction += weight * mass * friction.at::<Plain>(s) * relative;
                if let (Some(_), Some(stops)) = (state.stops[j].touching(), &system.stops[j]) {
                    self.energy.contact += weight * stops.damping * relative * relative;
                }
            }
            self.energy.input -= weight * momentum * state.interval.ground_at(tau);
        }
        series.changes(Quantity::Drift, end, &mut drifts);
        for p in 1..=system.nodes {
            self.energy.hysteretic += state.springs[p - 1].dissipated(state.x[p], drifts[p]);
        }
        self.largest_input = self.largest_input.max(self.energy.input);
    }

    /// The energies at the end, with their residual; `lost` is what was left in stops that parted.
    pub(super) fn finish(&self, state: &GeneralState, lost: f64) -> GeneralEnergy {
        let mut energy = self.energy;
        energy.contact += lost;
        (energy.kinetic, energy.elastic) = (kinetic(state), elastic(state));
        let dissipated = energy.viscous + energy.hysteretic + energy.friction + energy.contact;
        let residual = energy.initial + energy.input - (energy.kinetic + energy.elastic + dissipated);
        energy.relative_residual = if residual == 0.0 { 0.0 } else { residual / self.scale() };
        energy
    }

    /// What residuals are relative to: the initial energy plus the largest input so far (J).
    pub(super) fn scale(&self) -> f64 {
        self.energy.initial + self.largest_input
    }
}

fn kinetic(state: &GeneralState) -> f64 {
    let nodes = state.node_velocities(&state.v);
    let of_nodes: f64 = state.system.mass.iter().zip(&nodes).map(|(m, v)| 0.5 * m * v * v).sum();
    let of_goods = state.motions.iter().zip(&state.system.blocks).map(|(motion, law)| {
        let velocity = motion.velocity + nodes[law.floor];
        0.5 * law.mass * velocity * velocity
    });
    of_nodes + of_goods.sum::<f64>()
}

fn elastic(state: &GeneralState) -> f64 {
    let system = state.system;
    let springs = state.springs.iter().zip(&system.laws).zip(&state.x[1..]);
    let of_springs: f64 = springs.map(|((spring, law), &x)| spring.stored(law, x)).sum();
    let of_matrix = system.parts.iter().filter(|part| !part.elastic.is_empty()).map(|part| {
        let drifts: Vec<f64> = (part.first..part.first + part.count).map(|p| state.drift(p)).collect();
        let of_column = |column: &[f64]| column.iter().zip(&drifts).map(|(k, d)| k * d).sum::<f64>();
        0.5 * part.elastic.chunks_exact(part.count).zip(&drifts).map(|(column, d)| of_column(column) * d).sum::<f64>()
    });
    let of_stops = state.stops.iter().zip(&system.stops).map(|(stop, stops)| stop.stored(stops.as_ref()));
    let of_base =
        system.base.as_ref().map_or(0.0, |base| 0.5 * base.restoring * STANDARD_GRAVITY * state.x[0] * state.x[0]);
    of_springs + of_base + of_matrix.sum::<f64>() + of_stops.sum::<f64>()
}
