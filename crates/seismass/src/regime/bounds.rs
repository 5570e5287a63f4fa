//! What follows from the tangents and masses of a regime: bounds of its frequency, its growth and its derivatives.
//!
//! Padding is zero, and so is what lies below the lowest storey: sums over neighbours need not know where a building ends.

use crate::lanes::{Vector, WIDTH, at, for_each_path, lanes, lanes_mut, numbers};
use crate::machines::model::Model;
use crate::regime::{ROWS, Row};

/// Fills the rows of a regime of which tangents, of springs too, and masses are given; returns its frequency and the
/// exponent of growth: see [`crate::regime::Regime`].
pub(crate) fn form(model: &Model, rows: &mut [f64]) -> (f64, f64) {
    let [stiffness, damping] = form_rows(model, rows);
    let mut growth = if model.damping_may_feed() { damping } else { 0.0 };
    let rows = Rows { numbers: rows, width: model.width };
    let tangents = rows.row(Row::Tangent).iter().zip(rows.row(Row::RootTangent));
    let mut below = 0.0;
    for ((&tangent, &root), &inverse_root) in tangents.zip(rows.row(Row::InverseRootMass)) {
        if tangent < 0.0 {
            growth += 2.0 * root * (inverse_root + below);
        }
        below = inverse_root;
    }
    (0.5 * damping + (0.25 * damping * damping + stiffness).sqrt(), growth)
}

for_each_path! {
    /// Fills the rows; returns bounds by Gershgorin on the symmetric forms M^(-1/2) K M^(-1/2) and M^(-1/2) C M^(-1/2),
    /// infinite where a number is.
    fn form_rows(model: &Model, rows: &mut [f64]) -> [f64; 2] = rows_by_path
}

#[inline(always)]
fn rows_by_path<V: Vector>(model: &Model, rows: &mut [f64]) -> [f64; 2] {
    // What one vector holds needs no loops.
    match rows.first_chunk_mut::<{ ROWS * WIDTH }>() {
        Some(rows) if model.width == WIDTH => fill::<V>(model, Rows { numbers: rows, width: WIDTH }),
        _ => fill::<V>(model, Rows { numbers: rows, width: model.width }),
    }
}

#[inline(always)]
fn fill<V: Vector>(model: &Model, mut rows: Rows) -> [f64; 2] {
    let (zero, one) = (V::splat(0.0), V::splat(1.0));
    let vectors = rows.width / WIDTH;
    for k in 0..vectors {
        let (spring, mass): (V, V) = (rows.at(Row::SpringTangent, k), rows.at(Row::Mass, k));
        rows.set(Row::SpringFlexibility, k, one.div(spring).with(zero.not_below(spring), zero));
        let inverse = one.div(mass).with(zero.not_below(mass), zero);
        rows.set(Row::InverseMass, k, inverse);
        rows.set(Row::RootMass, k, mass.sqrt());
        rows.set(Row::InverseRootMass, k, inverse.mul(mass.sqrt()));
        rows.set(Row::RootTangent, k, rows.at::<V>(Row::Tangent, k).abs().sqrt());
    }
    let (mut largest, mut zeros) = ([zero; 2], zero);
    for k in 0..vectors {
        let (inverse_mass, inverse_root): (V, V) = (rows.at(Row::InverseMass, k), rows.at(Row::InverseRootMass, k));
        let (tangent, above) = (rows.at::<V>(Row::Tangent, k).abs(), rows.above::<V>(Row::Tangent, k).abs());
        let own = inverse_root.mul_add(rows.below(Row::InverseRootMass, k), inverse_mass);
        let of_above = inverse_root.mul_add(rows.above(Row::InverseRootMass, k), inverse_mass);
        let stiffness = tangent.mul(own).add(above.mul(of_above));
        let damping = rows.damped::<V>(model, Row::InverseRootMass, k, false).mul(inverse_root);
        (largest[0], largest[1]) = (largest[0].max(stiffness), largest[1].max(damping));
        // No number times zero is zero but a finite one.
        zeros = stiffness.add(damping).mul_add(zero, zeros);
        // With energy norm e, |v''| <= e / sqrt(mass) and |v'| <= e / sqrt(tangent).
        let roots = rows.at::<V>(Row::RootTangent, k).add(rows.above(Row::RootTangent, k));
        let damping = rows.damped::<V>(model, Row::InverseMass, k, true).sqrt();
        rows.set(Row::SecondOfAcceleration, k, roots.add(damping).mul(inverse_mass));
    }
    // The floor accelerations' derivative of one order comes from relative velocities two orders below.
    for (two_below, one_below, out) in [
        (Row::InverseRootMass, Row::SecondOfAcceleration, Row::ThirdOfAcceleration),
        (Row::SecondOfAcceleration, Row::ThirdOfAcceleration, Row::FourthOfAcceleration),
    ] {
        for k in 0..vectors {
            let (tangent, above) = (rows.at::<V>(Row::Tangent, k).abs(), rows.above::<V>(Row::Tangent, k).abs());
            let velocity: V = rows.at(two_below, k);
            let own = tangent.mul(velocity.add(rows.below(two_below, k)));
            let forces = above.mul_add(velocity.add(rows.above(two_below, k)), own);
            let forces = forces.add(rows.damped(model, one_below, k, false));
            rows.set(out, k, forces.mul(rows.at(Row::InverseMass, k)));
        }
    }
    for (of_acceleration, out) in
        [(Row::SecondOfAcceleration, Row::FourthOfDrift), (Row::ThirdOfAcceleration, Row::FourthOfRate)]
    {
        for k in 0..vectors {
            let difference = rows.at::<V>(of_acceleration, k).add(rows.below(of_acceleration, k));
            rows.set(out, k, difference.mul(at(&model.lanes.inside, k)));
        }
    }
    if zeros.sum() != 0.0 {
        return [f64::INFINITY; 2];
    }
    let mut out = [0.0f64; 2];
    for (out, of_lanes) in out.iter_mut().zip(numbers(&largest)) {
        for value in of_lanes {
            *out = out.max(value);
        }
    }
    out
}

/// All rows of a regime.
pub(crate) struct Rows<'a> {
    numbers: &'a mut [f64],
    width: usize,
}

impl Rows<'_> {
    #[inline(always)]
    fn row(&self, row: Row) -> &[f64] {
        &self.numbers[row as usize * self.width..][..self.width]
    }

    #[inline(always)]
    fn at<V: Vector>(&self, row: Row, k: usize) -> V {
        at(self.row(row), k)
    }

    /// Each lane takes what is below it.
    #[inline(always)]
    fn below<V: Vector>(&self, row: Row, k: usize) -> V {
        self.at::<V>(row, k).shifted_up(if k > 0 { self.at(row, k - 1) } else { V::splat(0.0) })
    }

    /// Each lane takes what is above it.
    #[inline(always)]
    fn above<V: Vector>(&self, row: Row, k: usize) -> V {
        above(self.row(row), k)
    }

    #[inline(always)]
    fn set<V: Vector>(&mut self, row: Row, k: usize, values: V) {
        values.store(&mut lanes_mut(&mut self.numbers[row as usize * self.width..][..self.width])[k]);
    }

    /// Vector `k` of the product of a row with the absolute values of the damping matrix in floor coordinates, or with
    /// their squares.
    #[inline(always)]
    fn damped<V: Vector>(&self, model: &Model, row: Row, k: usize, squared: bool) -> V {
        let of = &model.lanes;
        let mut sum = V::splat(0.0);
        if !of.damping_sizes.is_empty() {
            let columns = of.damping_sizes.chunks_exact(self.width);
            for (column, &value) in columns.zip(self.row(row)) {
                let sizes: V = at(column, k);
                sum = if squared { sizes.mul(sizes) } else { sizes }.mul_add(V::splat(value), sum);
            }
        } else if !of.storey_damping.is_empty() {
            let (own, of_above): (V, V) = (at(&of.storey_damping, k), above(&of.storey_damping, k));
            let entries = [own, at::<V>(&of.floor_damping, k).add(own).add(of_above), of_above];
            let values: [V; 3] = [self.below(row, k), self.at(row, k), self.above(row, k)];
            for which in 0..3 {
                let entry = entries[which];
                sum = if squared { entry.mul(entry) } else { entry }.mul_add(values[which], sum);
            }
        }
        sum
    }
}

/// Vector `k` of padded values, each lane taking that above it.
#[inline(always)]
fn above<V: Vector>(values: &[f64], k: usize) -> V {
    at::<V>(values, k).shifted_down(if k + 1 < lanes(values).len() { at(values, k + 1) } else { V::splat(0.0) })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::sync::Arc;

    use nalgebra::DMatrix;

    use super::*;
    use crate::regime::Regime;
    use crate::scene::StoreyDamping;
    use crate::scene::{Building, Damping, GravityEffect, Scene, Storey};

    /// A building of uneven floors and storeys, with P-Delta.
    fn uneven(n: usize, damping: Damping) -> Model {
        let wave = |i: usize, step: f64| 1.0 + 0.8 * (step * (i + 1) as f64).sin();
        let mass: Vec<f64> = (0..n).map(|i| 1000.0 * wave(i, 2.1)).collect();
        let yielding = Storey { second_slope: 0.1, third_slope: 0.0, ..Storey::yielding(1e5, 1e3) };
        let storeys = (0..n).map(|i| Storey { stiffness: 1e5 * wave(i, 1.3), ..yielding.clone() }).collect();
        let geometric = (0..n).map(|i| 3e3 * wave(i, 0.9)).collect();
        let building = Building::new(mass, storeys, damping).unwrap();
        let building = building.with_gravity(GravityEffect::GeometricStiffness(geometric)).unwrap();
        Model::new(&Scene::new(Some(Arc::new(building)), Vec::new()).unwrap())
    }

    /// |C| in floor coordinates, entry by entry.
    fn damping_sizes(model: &Model) -> DMatrix<f64> {
        let n = model.storeys();
        let of_storeys = match model.damping() {
            StoreyDamping::Dense(d) => d.clone(),
            StoreyDamping::Rayleigh { stiffness_factor, .. } => {
                DMatrix::from_fn(n, n, |i, j| if i == j { stiffness_factor * model.stiffness[i] } else { 0.0 })
            }
            StoreyDamping::None => DMatrix::zeros(n, n),
        };
        // Drift rates from floor velocities; forces on floors from those of storeys are its transpose.
        let rates = DMatrix::from_fn(n, n, |i, j| f64::from(i == j) - f64::from(i == j + 1));
        let mut sizes = rates.transpose() * of_storeys * rates;
        if let StoreyDamping::Rayleigh { mass_factor, .. } = model.damping() {
            for i in 0..n {
                sizes[(i, i)] += mass_factor * model.mass[i];
            }
        }
        sizes.map(f64::abs)
    }

    /// Against sums storey by storey, with and without room to spare in the last vector.
    #[test]
    fn bounds_are_those_of_whole_matrices() {
        for n in [1, 2, 3, 4, 5, 8, 13, 48, 51] {
            let modes = [1, n.min(3)];
            for damping in [
                Damping::Modal { ratio: 0.0 },
                Damping::Modal { ratio: 0.05 },
                Damping::Rayleigh { ratio: 0.03, modes },
            ] {
                if n == 1 && matches!(damping, Damping::Rayleigh { .. }) {
                    continue;
                }
                let model = uneven(n, damping.clone());
                // The tangent of one storey is negative, and its spring has none.
                let tangent = |i: usize, yielded: usize| model.laws[i].spring.law().tangents().unwrap()[yielded];
                let regime = Regime::new(&model, |i| tangent(i, if i == n / 2 { 2 } else { i % 2 }), &vec![500.0; n]);
                let sizes = damping_sizes(&model);
                let row = |row: Row| &regime.row(row)[..n];
                let tangent: Vec<f64> = row(Row::Tangent).iter().map(|k| k.abs()).collect();
                let mass = row(Row::Mass);
                let (root, inverse_root) = (|i: usize| tangent[i].sqrt(), |i: usize| 1.0 / mass[i].sqrt());
                let above = |i: usize, f: &dyn Fn(usize) -> f64| if i + 1 < n { f(i + 1) } else { 0.0 };
                let below = |i: usize, f: &dyn Fn(usize) -> f64| if i > 0 { f(i - 1) } else { 0.0 };
                let damped = |i: usize, f: &dyn Fn(usize) -> f64| (0..n).map(|j| sizes[(i, j)] * f(j)).sum::<f64>();
                let forces = |i: usize, two_below: &dyn Fn(usize) -> f64| {
                    let own = tangent[i] * (two_below(i) + below(i, two_below));
                    own + above(i, &|j| tangent[j] * (two_below(j) + two_below(i)))
                };
                let second = |i: usize| {
                    let squares: f64 = (0..n).map(|j| sizes[(i, j)].powi(2) / mass[j]).sum();
                    (root(i) + above(i, &root) + squares.sqrt()) / mass[i]
                };
                let third = |i: usize| (forces(i, &inverse_root) + damped(i, &second)) / mass[i];
                let fourth = |i: usize| (forces(i, &second) + damped(i, &third)) / mass[i];
                let is_close = |found: f64, expected: f64, what: &str| {
                    assert!(
                        (found - expected).abs() <= 1e-13 * expected,
                        "{what}, {n}, {damping:?}: {found} {expected}"
                    );
                };
                let (mut stiffness, mut viscous, mut growth) = (0.0f64, 0.0f64, 0.0f64);
                for i in 0..n {
                    is_close(row(Row::RootMass)[i], mass[i].sqrt(), "root of the mass");
                    let spring = row(Row::SpringTangent)[i];
                    let flexibility = if spring > 0.0 { 1.0 / spring } else { 0.0 };
                    is_close(row(Row::SpringFlexibility)[i], flexibility, "flexibility");
                    is_close(row(Row::SecondOfAcceleration)[i], second(i), "second");
                    is_close(row(Row::ThirdOfAcceleration)[i], third(i), "third");
                    is_close(row(Row::FourthOfAcceleration)[i], fourth(i), "fourth");
                    is_close(row(Row::FourthOfDrift)[i], second(i) + below(i, &second), "fourth of the drift");
                    is_close(row(Row::FourthOfRate)[i], third(i) + below(i, &third), "fourth of the rate");
                    stiffness = stiffness.max(forces(i, &inverse_root) * inverse_root(i));
                    viscous = viscous.max(damped(i, &inverse_root) * inverse_root(i));
                    if row(Row::Tangent)[i] < 0.0 {
                        growth += 2.0 * root(i) * (inverse_root(i) + below(i, &inverse_root));
                    }
                }
                let frequency = 0.5 * viscous + (0.25 * viscous * viscous + stiffness).sqrt();
                is_close(regime.frequency, frequency, "frequency");
                assert!(growth > 0.0);
                is_close(regime.growth_over(0.01), (0.01 * growth).exp(), "growth");
                for which in [Row::InverseMass, Row::SecondOfAcceleration, Row::FourthOfDrift, Row::FourthOfRate] {
                    assert!(regime.row(which)[n..].iter().all(|&padding| padding == 0.0));
                }
            }
        }
    }
}
