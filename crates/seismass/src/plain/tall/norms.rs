//! Norms of the derivatives of tall buildings: of a whole building, and of the surroundings of each vector of storeys.
//!
//! The bounds of a regime's derivatives ([`RegimeRows::fourth`], [`RegimeRows::second`]) are per unit of a norm of the whole building.
//! A storey of a tall one feels little of what happens far away within a step: with the norm of its surroundings the
//! same bounds hold there, and tell much more of a storey that moves less than others.

use crate::lanes::{Vector, WIDTH, filled_to, lanes};
use crate::plain::columns::MARGINS;
use crate::regime::Row;
use crate::scene::StoreyDamping;
use crate::state::State;

/// What a run reads of its regime.
pub(crate) struct RegimeRows {
    pub(crate) root_mass: Vec<f64>,
    pub(crate) root_tangent: Vec<f64>,
    /// TallBounds of fourth derivatives of drifts, drift rates, floor accelerations and block velocities.
    pub(crate) fourth: [Vec<f64>; 4],
    /// TallBounds of second derivatives of floor accelerations.
    pub(crate) second: Vec<f64>,
    /// Factor by which the norm of the building may grow over the step.
    pub(crate) growth: f64,
    reach: Reach,
}

impl RegimeRows {
    pub(crate) fn new(state: &State, h: f64, length: usize) -> Self {
        let (n, regime) = (state.storeys(), &state.regime);
        let row = |row: Row| filled_to(length, regime.row(row)[..n].iter().copied(), 0.0);
        Self {
            root_mass: row(Row::RootMass),
            root_tangent: row(Row::RootTangent),
            fourth: MARGINS.map(row),
            second: row(Row::SecondOfAcceleration),
            growth: regime.growth_over(h),
            reach: Reach::new(state, h, regime.growth_over(h)),
        }
    }
}

/// Vector of (root_mass rate)^2 + (root_tangent q)^2.
#[inline(always)]
fn squares<V: Vector>([root_mass, rate, root_tangent, q]: [&[f64; WIDTH]; 4]) -> V {
    let (kinetic, elastic) = (V::load(root_mass).mul(V::load(rate)), V::load(root_tangent).mul(V::load(q)));
    kinetic.mul_add(kinetic, elastic.mul(elastic))
}

/// Sum of (root_mass rate)^2 + (root_tangent q)^2.
#[inline(always)]
pub(crate) fn energy<V: Vector>(rows: &RegimeRows, rate: &[f64], q: &[f64]) -> f64 {
    let floors = lanes(&rows.root_mass).iter().zip(lanes(rate));
    let mut sum = V::splat(0.0);
    for ((mass, rate), (tangent, q)) in floors.zip(lanes(&rows.root_tangent).iter().zip(lanes(q))) {
        sum = sum.add(squares([mass, rate, tangent, q]));
    }
    sum.sum()
}

/// Norms of derivatives by vector of storeys and their floors: with them in place of the norm of the whole building,
/// the regime's bounds hold in that vector, during the step ([`Reach`]).
pub(crate) struct Norms {
    /// Energies by vector, after and before a zero.
    energies: Vec<f64>,
    /// Sums of them and of those below, which fall off with the distance.
    below: Vec<f64>,
    /// The norms.
    pub(crate) values: Vec<f64>,
}

impl Norms {
    pub(crate) fn new(vectors: usize) -> Self {
        Self { energies: vec![0.0; vectors + 2], below: vec![0.0; vectors], values: vec![0.0; vectors] }
    }

    /// Forms them from rates of floors and drifts.
    #[inline(always)]
    pub(crate) fn form<V: Vector>(&mut self, rows: &RegimeRows, rate: &[f64], q: &[f64]) {
        let count = self.values.len();
        let floors = lanes(&rows.root_mass).iter().zip(lanes(rate));
        let storeys = lanes(&rows.root_tangent).iter().zip(lanes(q));
        for (energy, ((mass, rate), (tangent, q))) in self.energies[1..=count].iter_mut().zip(floors.zip(storeys)) {
            *energy = squares::<V>([mass, rate, tangent, q]).sum();
        }
        let (reach, all) = (&rows.reach, self.energies.iter().sum::<f64>() * rows.growth * rows.growth);
        let mut sum = 0.0;
        for (below, energy) in self.below.iter_mut().zip(&self.energies[1..]) {
            sum = reach.falls_by * sum + energy;
            *below = sum;
        }
        let mut above = [0.0; 2];
        for k in (0..count).rev() {
            let below = if k >= 2 { self.below[k - 2] } else { 0.0 };
            let near = self.energies[k] + self.energies[k + 1] + self.energies[k + 2];
            let local = reach.growth * (near + below + above[1]);
            self.values[k] = if local < all { local } else { all };
            above = [reach.falls_by * above[0] + self.energies[k + 1], above[0]];
        }
        for value in &mut self.values {
            *value = value.sqrt();
        }
    }
}

/// How far derivatives are felt within a step, where damping couples neighbours only.
///
/// Weigh the energies of floors by squares of w and those of storeys by the products of w below and above them, with
/// w = 1 up to four storeys around those of a vector and smaller by a factor r for each storey farther away. Where w is
/// the same on all floors, the sum E of these energies grows at most like that of the building. Where neighbours differ
/// by r, springs take from one what they do not give to the other, and dampers may feed: with
/// d = r^(1/2) - r^(-1/2), E may grow at a rate of d s + d^2 t more, s being the norm of the differences between floors
/// times root_tangent over root_mass, t the largest row of what couples neighbours in M^(-1/2) C M^(-1/2). The bounds of
/// a regime's derivatives come from values up to three storeys away, whose energies are parts of E.
struct Reach {
    /// Factor of the weights of energies from one vector of storeys to the next: r^-8.
    falls_by: f64,
    /// Factor by which E may grow over the step.
    growth: f64,
}

impl Reach {
    /// What r is chosen for: E may grow by so much more than the energy of the building.
    const GROWTH: f64 = 4.0;

    /// The reach over `h`, during which the norm of the building grows by at most a factor `growth`.
    fn new(state: &State, h: f64, growth: f64) -> Self {
        match state.model.damping() {
            StoreyDamping::Dense(_) => Self { falls_by: 1.0, growth: growth * growth },
            _ => {
                let (n, row) = (state.storeys(), |row: Row| state.regime.row(row));
                let (root_mass, root_tangent) = (&row(Row::RootMass)[..n], &row(Row::RootTangent)[..n]);
                Self::of_chain(root_mass, root_tangent, &state.model.lanes.storey_damping, h, growth)
            }
        }
    }

    /// The reach where damping couples neighbours only; `damping` is that of storeys, if there is any.
    fn of_chain(root_mass: &[f64], root_tangent: &[f64], damping: &[f64], h: f64, growth: f64) -> Self {
        let n = root_mass.len();
        let (mut by_storey, mut by_floor, mut dampers) = (0.0f64, 0.0f64, 0.0f64);
        for i in 0..n {
            let below = if i > 0 { 1.0 / root_mass[i - 1] } else { 0.0 };
            let own = 1.0 / root_mass[i];
            let damper = |s: usize| {
                damping.get(s).map_or(0.0, |d| if s > 0 { d / (root_mass[s] * root_mass[s - 1]) } else { 0.0 })
            };
            let above = if i + 1 < n { (root_tangent[i + 1], damper(i + 1)) } else { (0.0, 0.0) };
            by_storey = by_storey.max(root_tangent[i] * (own + below));
            by_floor = by_floor.max(own * (root_tangent[i] + above.0));
            dampers = dampers.max(damper(i) + above.1);
        }
        let (springs, dampers, exponent) = (h * (by_storey * by_floor).sqrt(), h * dampers, libm::log(Self::GROWTH));
        let d = 2.0 * exponent / (springs + (springs * springs + 4.0 * dampers * exponent).sqrt());
        let root = 0.5 * (d + (d * d + 4.0).sqrt());
        Self { falls_by: (root * root).powi(-2 * WIDTH as i32), growth: Self::GROWTH * growth * growth }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Plain;

    const STOREYS: usize = 48;

    /// A chain of floors and springs, with dampers of storeys and floors.
    struct Chain {
        mass: Vec<f64>,
        tangent: Vec<f64>,
        damping: Vec<f64>,
        floor_damping: f64,
    }

    impl Chain {
        /// Rates of drifts and of floors' rates.
        fn rates(&self, q: &[f64], u: &[f64]) -> (Vec<f64>, Vec<f64>) {
            let v: Vec<f64> = (0..STOREYS).map(|i| u[i] - if i > 0 { u[i - 1] } else { 0.0 }).collect();
            let force: Vec<f64> = (0..STOREYS).map(|i| self.tangent[i] * q[i] + self.damping[i] * v[i]).collect();
            let net = |i: usize| force.get(i + 1).unwrap_or(&0.0) - force[i] - self.floor_damping * u[i];
            (v, (0..STOREYS).map(|i| net(i) / self.mass[i]).collect())
        }

        /// A step of the midpoint rule.
        fn advance(&self, q: &mut [f64], u: &mut [f64], h: f64) {
            let moved = |from: &[f64], rate: &[f64], h: f64| -> Vec<f64> {
                from.iter().zip(rate).map(|(value, rate)| value + h * rate).collect()
            };
            let (v, a) = self.rates(q, u);
            let (v, a) = self.rates(&moved(q, &v, 0.5 * h), &moved(u, &a, 0.5 * h));
            q.copy_from_slice(&moved(q, &v, h));
            u.copy_from_slice(&moved(u, &a, h));
        }
    }

    /// Energies around each vector stay below the squares of its norm during the step, and the norms fall off.
    #[test]
    fn norms_hold_in_their_surroundings() {
        let wave = |i: usize, step: f64| 1.0 + 0.5 * (step * i as f64).sin();
        for (h, damping) in [(0.5, 0.0), (0.5, 0.1), (1.0, 0.8), (3.0, 0.02)] {
            let tangent: Vec<f64> = (0..STOREYS).map(|i| wave(i, 1.3)).collect();
            let chain = Chain {
                mass: (0..STOREYS).map(|i| wave(i, 0.7)).collect(),
                damping: tangent.iter().map(|tangent| damping * tangent).collect(),
                tangent,
                floor_damping: 0.1 * damping,
            };
            let root = |values: &[f64]| -> Vec<f64> { values.iter().map(|value| value.sqrt()).collect() };
            let (root_mass, root_tangent) = (root(&chain.mass), root(&chain.tangent));
            let reach = Reach::of_chain(&root_mass, &root_tangent, &chain.damping, h, 1.0);
            let none = || vec![0.0; STOREYS];
            let fourth = [none(), none(), none(), none()];
            let rows = RegimeRows { root_mass, root_tangent, fourth, second: none(), growth: 1.0, reach };
            for struck in [0, 5, 23, 47] {
                let (mut q, mut u) = (none(), none());
                (q[struck], u[struck]) = (0.3, 1.0);
                let vectors = STOREYS / WIDTH;
                let mut norms = Norms::new(vectors);
                norms.form::<Plain>(&rows, &u, &q);
                let own = struck / WIDTH;
                for (k, norm) in norms.values.iter().enumerate().filter(|(k, _)| k.abs_diff(own) > 5) {
                    assert!(*norm < 0.5 * norms.values[own], "{h}, {damping}: {norm} in {k}, struck in {own}");
                }
                for _ in 0..400 {
                    chain.advance(&mut q, &mut u, h / 400.0);
                    let energy = |i: usize| chain.mass[i] * u[i] * u[i] + chain.tangent[i] * q[i] * q[i];
                    for k in 0..vectors {
                        let around = WIDTH * k.saturating_sub(1)..STOREYS.min(WIDTH * (k + 2));
                        let (found, norm) = (around.map(energy).sum::<f64>().sqrt(), norms.values[k]);
                        // The midpoint rule gains a little energy of its own.
                        assert!(found <= norm * (1.0 + 1e-6), "{h}, {damping}: {found} in {k}, norm {norm}");
                    }
                }
            }
        }
    }
}
