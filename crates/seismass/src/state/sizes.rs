//! Sizes of the terms of floor accelerations, whose rounding they bound, and what floors ask of their blocks.

use crate::lanes::{Vector, WIDEST, load, numbers};
use crate::machines::settle::Demand;
use crate::regime::{RegimeOperator, Row};
use crate::scene::StoreyDamping;
use crate::state::State;

impl State<'_> {
    /// [`State::acceleration_size`] within the code of a path.
    #[inline(always)]
    pub(crate) fn size_in_lanes<V: Vector, const K: usize>(&self, floor: usize, contact: f64) -> f64 {
        if K == WIDEST || floor == 0 {
            return self.acceleration_size(floor, contact);
        }
        let operator = RegimeOperator::<V, K>::new(self.model, &self.regime);
        let (mut x, mut v): ([V; K], [V; K]) = (load(&self.kinematics.x), load(&self.kinematics.v));
        let (loads, mut forces): ([V; K], [V; K]) = (load(&self.springs.base_load), load(&self.blocks.friction));
        for k in 0..K {
            (x[k], v[k]) = (x[k].abs(), v[k].abs());
            forces[k] = forces[k].abs().mul(V::splat(contact));
        }
        numbers(&operator.sizes(&x, &v, &loads, forces)).as_flattened()[floor - 1]
    }

    /// Sum of the sizes of the terms of a floor's acceleration: times rounding, its error.
    pub(crate) fn acceleration_size(&self, floor: usize, contact: f64) -> f64 {
        let Some(i) = floor.checked_sub(1) else { return self.step.drive.ground.abs() };
        let above = if i + 1 < self.storeys() { self.shear_size(i + 1) } else { 0.0 };
        (self.shear_size(i) + above + self.blocks.friction[i].abs() * contact) * self.regime.row(Row::InverseMass)[i]
            + self.mass_damping_size(i)
    }

    /// Sum of the sizes of the terms of a storey's force.
    fn shear_size(&self, i: usize) -> f64 {
        let elastic = (self.regime.row(Row::Tangent)[i] * self.kinematics.x[i]).abs() + self.springs.base_load[i].abs();
        let viscous = match self.model.damping() {
            StoreyDamping::None => 0.0,
            StoreyDamping::Rayleigh { stiffness_factor, .. } => {
                (stiffness_factor * self.model.stiffness[i] * self.kinematics.v[i]).abs()
            }
            // The matrix is symmetric: a column is a row.
            StoreyDamping::Dense(d) => {
                let n = self.storeys();
                d.as_slice()[n * i..n * (i + 1)].iter().zip(&self.kinematics.v).map(|(c, rate)| (c * rate).abs()).sum()
            }
        };
        elastic + viscous
    }

    /// Size of the mass-proportional damping in a floor's acceleration.
    fn mass_damping_size(&self, i: usize) -> f64 {
        let StoreyDamping::Rayleigh { mass_factor, .. } = self.model.damping() else { return 0.0 };
        let velocity: f64 = self.kinematics.v[..=i].iter().map(|v| v.abs()).sum();
        velocity * mass_factor * self.model.mass[i] * self.regime.row(Row::InverseMass)[i]
    }

    /// What floor `floor` (0: the ground) asks of its blocks at `tau`, where its acceleration must be that of the state.
    pub(crate) fn demand<const K: usize>(&self, floor: usize, tau: f64) -> Demand {
        if floor == 0 {
            return Demand::Ground { acceleration: self.interval.ground_at(tau) };
        }
        let i = floor - 1;
        let contact = self.contact_at(tau);
        let mass = self.regime.row(Row::Mass)[i];
        Demand::Floor {
            force: self.kinematics.a.numbers::<K>()[i] * mass - self.blocks.friction.numbers::<K>()[i] * contact,
            size: self.acceleration_size(floor, contact) * mass,
            mass: self.model.mass[i],
        }
    }
}
