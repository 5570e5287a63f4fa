//! The constant data of a run: nodes, springs, damping and goods of a scene.

use nalgebra::DMatrix;

use crate::error::Result;
use crate::general::base_law::Base;
use crate::machines::block::BlockLaw;
use crate::machines::storey::StoreyLaw;
use crate::scene::{GeneralScene, Goods, Motion, Rack, Stops, StoreyDamping};

/// Nodes that follow each other, with damping and perhaps an elastic matrix between their drifts: the building, or a rack.
pub(super) struct Part {
    /// The first node.
    pub(super) first: usize,
    /// Number of nodes.
    pub(super) count: usize,
    /// Columns of the damping matrix between drift rates and forces; empty without damping.
    pub(super) damping: Vec<f64>,
    /// Columns of the elastic matrix between drifts and forces; empty without one.
    pub(super) elastic: Vec<f64>,
}

/// A scene as the engine sees it. Node 0 is the ground, or the slab of a sliding base; floors follow from 1, then the levels of each rack. Each node has a
/// spring to its parent, which has a lower number. Lists by node have an entry for the ground.
pub(super) struct System {
    /// Number of nodes without the ground.
    pub(super) nodes: usize,
    /// Number of storeys of the building.
    pub(super) storeys: usize,
    /// Number of levels of each rack.
    pub(super) levels: Vec<usize>,
    pub(super) parent: Vec<usize>,
    pub(super) mass: Vec<f64>,
    /// Law of the spring of node p, at p - 1.
    pub(super) laws: Vec<StoreyLaw>,
    pub(super) parts: Vec<Part>,
    /// Damping and the elastic matrix between displacements of the nodes: rows one after the other.
    pub(super) damping: Vec<f64>,
    pub(super) elastic: Vec<f64>,
    /// Goods; their floor is a node.
    pub(super) blocks: Vec<BlockLaw>,
    pub(super) stops: Vec<Option<Stops>>,
    pub(super) on_node: Vec<Vec<usize>>,
    /// Whether friction coefficients change with the path slipped.
    pub(super) wears: bool,
    /// The sliding base, whose slab node 0 is then.
    pub(super) base: Option<Base>,
}

impl System {
    /// # Errors
    /// As for a damping matrix: none for a valid scene.
    pub(super) fn new(scene: &GeneralScene, motion: &Motion) -> Result<Self> {
        let (nodes, storeys) = (scene.nodes(), scene.storeys());
        let mut system = Self {
            nodes,
            storeys,
            levels: scene.racks().iter().map(|rack| rack.mass.len()).collect(),
            parent: vec![0],
            mass: vec![scene.base().map_or(0.0, |base| base.mass)],
            laws: Vec::with_capacity(nodes),
            parts: Vec::new(),
            damping: Vec::new(),
            elastic: Vec::new(),
            blocks: Vec::new(),
            stops: Vec::new(),
            on_node: vec![Vec::new(); nodes + 1],
            wears: false,
            base: Base::new(scene, motion),
        };
        system.add_building(scene);
        for goods in scene.goods() {
            system.add_goods(goods, goods.block.floor);
        }
        for rack in scene.racks() {
            system.add_rack(rack)?;
        }
        system.wears = system.blocks.iter().any(|block| !block.wear.is_empty());
        system.damping = system.between_nodes(|part| &part.damping);
        system.elastic = system.between_nodes(|part| &part.elastic);
        Ok(system)
    }

    fn add_building(&mut self, scene: &GeneralScene) {
        let Some(building) = scene.building() else { return };
        let (geometric, collapse) = (scene.geometric_stiffness(), scene.collapse_drift());
        for (i, storey) in building.storeys().iter().enumerate() {
            // What a matrix bears is not in the backbone of a storey.
            let beside_matrix = building.stiffness_matrix().map(|_| f64::INFINITY);
            let collapse_drift = collapse.map(|limits| limits[i]).or(beside_matrix);
            self.parent.push(i);
            self.mass.push(building.mass()[i]);
            self.laws.push(StoreyLaw::new(storey, geometric[i], collapse_drift));
        }
        let damping = columns(building.storey_damping());
        let elastic = building.elastic().map_or(Vec::new(), columns);
        self.parts.push(Part { first: 1, count: building.len(), damping, elastic });
    }

    fn add_rack(&mut self, rack: &Rack) -> Result<()> {
        let first = self.parent.len();
        for (i, (&mass, level)) in rack.mass.iter().zip(&rack.levels).enumerate() {
            self.parent.push(if i == 0 { rack.floor } else { first + i - 1 });
            self.mass.push(mass);
            let geometric = rack.geometric_stiffness.get(i).copied().unwrap_or(0.0);
            self.laws.push(StoreyLaw::new(level, geometric, None));
        }
        let damping = match rack.damping()? {
            StoreyDamping::Dense(matrix) => columns(&matrix),
            _ => Vec::new(),
        };
        self.parts.push(Part { first, count: rack.mass.len(), damping, elastic: Vec::new() });
        for goods in &rack.goods {
            self.add_goods(goods, first + goods.block.floor - 1);
        }
        Ok(())
    }

    fn add_goods(&mut self, goods: &Goods, node: usize) {
        self.on_node[node].push(self.blocks.len());
        self.blocks.push(BlockLaw { floor: node, ..BlockLaw::new(&goods.block) });
        self.stops.push(goods.stops);
    }

    /// The entries by node of a matrix that is given between the drifts of each part.
    fn between_nodes(&self, of: impl Fn(&Part) -> &Vec<f64>) -> Vec<f64> {
        let width = self.nodes + 1;
        let mut total = vec![0.0; width * width];
        for part in self.parts.iter().filter(|part| !of(part).is_empty()) {
            for (i, j) in (0..part.count).flat_map(|i| (0..part.count).map(move |j| (i, j))) {
                let value = of(part)[j * part.count + i];
                let (p, q) = (part.first + i, part.first + j);
                for (row, column, sign) in [
                    (p, q, 1.0),
                    (self.parent[p], q, -1.0),
                    (p, self.parent[q], -1.0),
                    (self.parent[p], self.parent[q], 1.0),
                ] {
                    total[row * width + column] += sign * value;
                }
            }
        }
        total
    }

    /// What an element is called where something is reported: "storey 2", "level 1 of rack 3".
    pub(super) fn element_name(&self, node: usize) -> String {
        if node <= self.storeys {
            return format!("storey {node}");
        }
        let mut level = node - self.storeys;
        for (r, &levels) in self.levels.iter().enumerate() {
            if level <= levels {
                return format!("level {level} of rack {}", r + 1);
            }
            level -= levels;
        }
        format!("node {node}")
    }
}

/// Columns of a symmetric matrix, one after the other; empty where all is zero.
fn columns(matrix: &DMatrix<f64>) -> Vec<f64> {
    if matrix.iter().all(|&value| value == 0.0) { Vec::new() } else { matrix.as_slice().to_vec() }
}
