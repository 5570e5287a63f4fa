//! The constant data of a scene with racks, walls and stops in the number type of the run.

use seismass::{GeneralScene, Goods, Rack, STANDARD_GRAVITY};

use super::base::BaseData;
use super::modal::modal_damping;
use crate::model::{Stage, StoreyData, Terms, storey_data};
use crate::real::Real;

/// Stops of a block: none on a side without a clearance.
#[derive(Debug, Clone)]
pub(super) struct StopData<R> {
    /// On the negative and on the positive side.
    pub(super) clearance: [Option<R>; 2],
    pub(super) stiffness: R,
    pub(super) damping: R,
}

/// A block that may slide.
#[derive(Debug, Clone)]
pub(crate) struct GoodsData<R> {
    /// None is the ground.
    pub(crate) node: Option<usize>,
    pub(crate) mass: R,
    /// By path, the first from the start.
    pub(crate) stages: Vec<Stage<R>>,
    pub(super) stops: Option<StopData<R>>,
}

/// Dampers between the drift rates of the building's storeys, or of a rack's levels.
#[derive(Debug)]
struct Dampers<R> {
    first: usize,
    rows: Vec<Vec<R>>,
}

/// A scene in numbers of type `R`. Nodes are the floors, then the levels of each rack; spring p is below node p.
#[derive(Debug)]
pub(crate) struct Model<R> {
    pub(crate) mass: Vec<R>,
    /// What the node's spring stands on; none: the ground.
    pub(super) parent: Vec<Option<usize>>,
    pub(super) springs: Vec<StoreyData<R>>,
    /// Elastic matrix over the first nodes, the floors.
    pub(super) matrix: Vec<Vec<R>>,
    dampers: Vec<Dampers<R>>,
    pub(crate) goods: Vec<GoodsData<R>>,
    /// The slab that what has no node stands on; none: the ground.
    pub(super) base: Option<BaseData<R>>,
    pub(super) gravity: R,
    /// Whether the first node is a floor of a building.
    pub(super) has_building: bool,
}

impl<R: Real> Model<R> {
    pub(crate) fn new(scene: &GeneralScene) -> Self {
        let mut model = Self {
            mass: Vec::new(),
            parent: Vec::new(),
            springs: Vec::new(),
            matrix: Vec::new(),
            dampers: Vec::new(),
            goods: Vec::new(),
            base: scene.base().map(|base| BaseData::new(base, scene)),
            gravity: R::of(STANDARD_GRAVITY),
            has_building: scene.building().is_some(),
        };
        if let Some(building) = scene.building() {
            let n = building.len();
            model.mass = building.mass().iter().map(|&m| R::of(m)).collect();
            model.parent = (0..n).map(|i| i.checked_sub(1)).collect();
            let has_matrix = building.stiffness_matrix().is_some();
            for (i, (storey, &geometric)) in building.storeys().iter().zip(scene.geometric_stiffness()).enumerate() {
                // Beside a matrix no storey collapses but by a limit that was given.
                let limit = scene.collapse_drift().map(|d| d[i]).or(has_matrix.then_some(f64::INFINITY));
                model.springs.push(storey_data(storey, geometric, limit));
            }
            let rows = |m: &seismass::nalgebra::DMatrix<f64>| -> Vec<Vec<R>> {
                (0..n).map(|i| (0..n).map(|j| R::of(m[(i, j)])).collect()).collect()
            };
            model.matrix = building.stiffness_matrix().map_or(Vec::new(), rows);
            model.dampers.push(Dampers { first: 0, rows: rows(building.storey_damping()) });
        }
        let on_floor = |goods: &Goods| goods_data(goods, goods.block.floor.checked_sub(1));
        model.goods = scene.goods().iter().map(on_floor).collect();
        for rack in scene.racks() {
            model.add(rack);
        }
        model
    }

    fn add(&mut self, rack: &Rack) {
        let first = self.mass.len();
        let level_parent = |level: usize| level.checked_sub(1).map_or(rack.floor.checked_sub(1), |l| Some(first + l));
        for (level, storey) in rack.levels.iter().enumerate() {
            self.mass.push(R::of(rack.mass[level]));
            self.parent.push(level_parent(level));
            self.springs.push(storey_data(storey, rack.geometric_stiffness.get(level).copied().unwrap_or(0.0), None));
        }
        self.goods.extend(rack.goods.iter().map(|goods| goods_data(goods, Some(first + goods.block.floor - 1))));
        self.dampers.push(Dampers { first, rows: rack_damping(rack) });
    }

    pub(super) fn displacements(&self, drift: &[R], terms: Terms) -> Vec<R> {
        let mut sums: Vec<R> = Vec::with_capacity(drift.len());
        for (p, &d) in drift.iter().enumerate() {
            let below = self.parent[p].map_or(R::zero(), |parent| sums[parent]);
            sums.push(below + terms.of(d));
        }
        sums
    }

    /// Damping forces of the springs at these drift rates.
    pub(super) fn damping_forces(&self, rate: &[R], terms: Terms) -> Vec<R> {
        let mut forces = Vec::with_capacity(rate.len());
        for Dampers { first, rows } in &self.dampers {
            let of_part = &rate[*first..first + rows.len()];
            let force = |row: &Vec<R>| row.iter().zip(of_part).fold(R::zero(), |sum, (&d, &r)| sum + terms.of(d * r));
            forces.extend(rows.iter().map(force));
        }
        forces
    }

    /// Forces of the elastic matrix on the floors' displacements.
    pub(super) fn matrix_forces(&self, displacement: &[R], terms: Terms) -> Vec<R> {
        let force = |row: &Vec<R>| row.iter().zip(displacement).fold(R::zero(), |sum, (&k, &u)| sum + terms.of(k * u));
        self.matrix.iter().map(force).collect()
    }

    /// Force of each spring with P-Delta and damper on what it stands on.
    fn actions(&self, springs: &[R], drift: &[R], rate: &[R], terms: Terms) -> Vec<R> {
        let damping = self.damping_forces(rate, terms);
        let action = |p: usize| terms.of(springs[p]) + terms.of(-self.springs[p].geometric * drift[p]) + damping[p];
        (0..self.mass.len()).map(action).collect()
    }

    /// The force of springs, matrix, P-Delta and dampers on the slab or the ground.
    pub(super) fn pull_below(&self, springs: &[R], drift: &[R], rate: &[R], terms: Terms) -> R {
        let actions = self.actions(springs, drift, rate, terms).into_iter().zip(&self.parent);
        let of_springs =
            actions.filter(|(_, parent)| parent.is_none()).fold(R::zero(), |sum, (action, _)| sum + action);
        let displacement = self.displacements(drift, terms);
        self.matrix_forces(&displacement, terms).into_iter().fold(of_springs, |sum, force| sum + terms.of(force))
    }

    /// Q: the force of springs, matrix, P-Delta and dampers on each node, at these spring forces, drifts and drift rates.
    pub(super) fn pull(&self, springs: &[R], drift: &[R], rate: &[R], terms: Terms) -> Vec<R> {
        let mut pull = vec![R::zero(); self.mass.len()];
        for (p, action) in self.actions(springs, drift, rate, terms).into_iter().enumerate() {
            pull[p] = pull[p] + terms.of(-action);
            if let Some(parent) = self.parent[p] {
                pull[parent] = pull[parent] + action;
            }
        }
        let displacement = self.displacements(drift, terms);
        for (p, force) in self.matrix_forces(&displacement, terms).into_iter().enumerate() {
            pull[p] = pull[p] + terms.of(-force);
        }
        pull
    }

    /// Bound of the norm of the system (1/s) in every regime in which the stops of these goods press: sqrt(kappa) + gamma,
    /// where kappa and gamma are the largest row sums from drifts and slips, and from their rates, to the second derivatives
    /// of drifts and slips, with all springs at their stiffest and no mass but that of the nodes.
    pub(super) fn frequency_bound(&self, presses: impl Fn(usize) -> bool) -> f64 {
        let (n, m) = (self.mass.len(), self.goods.len());
        let none = vec![R::zero(); n];
        let unit = |at: usize, value: R| (0..n).map(|i| if i == at { value } else { R::zero() }).collect::<Vec<R>>();
        // By the force on the slab, on each node and on each block, per unit of a drift, a slip, or that of the slab.
        let largest = |column: &dyn Fn(usize) -> (R, Vec<R>, Vec<R>)| {
            let mut sums = vec![0.0; n + m + 1];
            for index in 0..=n + m {
                let (below, force, on_goods) = column(index);
                let slab = self.base.as_ref().map_or(R::zero(), |base| below / base.mass);
                let a = |p: usize| force[p] / self.mass[p];
                for p in 0..n {
                    sums[p] += (a(p) - self.parent[p].map_or(slab, a)).to_f64().abs();
                }
                for (j, goods) in self.goods.iter().enumerate() {
                    sums[n + j] += (on_goods[j] / goods.mass - goods.node.map_or(slab, a)).to_f64().abs();
                }
                sums[n + m] += slab.to_f64().abs();
            }
            let counts = |&(row, _): &(usize, &f64)| row < n || row == n + m || presses(row - n);
            sums.iter().enumerate().filter(counts).fold(0.0, |largest: f64, (_, &sum)| largest.max(sum))
        };
        // Force of a stop on its block's node and on the block, per unit of slip or of its rate.
        let stop = |j: usize, of: &dyn Fn(&StopData<R>) -> R| {
            let value = self.goods[j].stops.as_ref().filter(|_| presses(j)).map_or(R::zero(), of);
            let (below, force) =
                self.goods[j].node.map_or((value, none.clone()), |node| (R::zero(), unit(node, value)));
            (below, force, (0..m).map(|i| if i == j { -value } else { R::zero() }).collect())
        };
        let of_slab = |force: R| (force, none.clone(), vec![R::zero(); m]);
        let kappa = largest(&|index| {
            if index == n + m {
                return of_slab(self.base.as_ref().map_or(R::zero(), |base| base.most_stiffness));
            }
            if index >= n {
                return stop(index - n, &|s| s.stiffness);
            }
            let spring = &self.springs[index];
            let stiffness = spring.spring.largest_stiffness() + spring.geometric;
            let mut force = self.pull(&unit(index, stiffness), &none, &none, Terms::Signed);
            let mut below = self.pull_below(&unit(index, stiffness), &none, &none, Terms::Signed);
            let displacement = self.displacements(&unit(index, R::of(1.0)), Terms::Signed);
            for (p, of_matrix) in self.matrix_forces(&displacement, Terms::Signed).into_iter().enumerate() {
                force[p] = force[p] - of_matrix;
                below = below + of_matrix;
            }
            (below, force, vec![R::zero(); m])
        });
        let gamma = largest(&|index| {
            if index == n + m {
                return of_slab(R::zero());
            }
            if index >= n {
                return stop(index - n, &|s| s.damping);
            }
            let rate = unit(index, R::of(1.0));
            let below = self.pull_below(&none, &none, &rate, Terms::Signed);
            (below, self.pull(&none, &none, &rate, Terms::Signed), vec![R::zero(); m])
        });
        kappa.sqrt() + gamma
    }
}

fn goods_data<R: Real>(goods: &Goods, node: Option<usize>) -> GoodsData<R> {
    let block = &goods.block;
    let stage = |path: f64, mu_s: f64, mu_k: f64| Stage { path: R::of(path), mu_s: R::of(mu_s), mu_k: R::of(mu_k) };
    let worn = block.wear.iter().map(|wear| stage(wear.path, wear.mu_s, wear.mu_k));
    let stages = [stage(0.0, block.mu_s, block.mu_k)].into_iter().chain(worn).collect();
    let stops = goods.stops.map(|stops| StopData {
        clearance: stops.clearance.map(|c| c.is_finite().then(|| R::of(c))),
        stiffness: R::of(stops.stiffness),
        damping: R::of(stops.damping),
    });
    GoodsData { node, mass: R::of(block.mass), stages, stops }
}

/// Dampers of a rack alone, fixed at its base, with frame and goods attached: between its drift rates.
fn rack_damping<R: Real>(rack: &Rack) -> Vec<Vec<R>> {
    let n = rack.mass.len();
    let mut mass: Vec<R> = rack.mass.iter().map(|&m| R::of(m)).collect();
    for goods in &rack.goods {
        let level = goods.block.floor - 1;
        mass[level] = mass[level] + R::of(goods.block.mass);
    }
    let mut stiffness = vec![vec![R::zero(); n]; n];
    for (level, storey) in rack.levels.iter().enumerate() {
        let k = R::of(storey.stiffness);
        stiffness[level][level] = stiffness[level][level] + k;
        if level > 0 {
            stiffness[level - 1][level - 1] = stiffness[level - 1][level - 1] + k;
            stiffness[level][level - 1] = -k;
            stiffness[level - 1][level] = -k;
        }
    }
    let mut sums = modal_damping(&mass, &stiffness, R::of(rack.damping_ratio));
    for i in (0..n).rev() {
        for j in (0..n).rev() {
            let at = |i: usize, j: usize| if i < n && j < n { sums[i][j] } else { R::zero() };
            sums[i][j] = sums[i][j] + at(i + 1, j) + at(i, j + 1) - at(i + 1, j + 1);
        }
    }
    sums
}
