//! A scene as the solver sees it: spring laws, block laws, damping, and which blocks stand on which floor.

use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;

use crate::lanes::{Padded, Symmetric, WIDTH, filled, padded};
use crate::machines::block::BlockLaw;
use crate::machines::storey::StoreyLaw;
use crate::scene::{Building, Damping, Scene, StoreyDamping};

/// The constant data of a run.
pub(crate) struct Model {
    /// Storeys padded to whole vectors.
    pub(crate) width: usize,
    pub(crate) mass: Vec<f64>,
    /// Initial stiffness of each storey, for Rayleigh damping.
    pub(crate) stiffness: Vec<f64>,
    pub(crate) laws: Vec<StoreyLaw>,
    /// Bits that tell the tangents of a storey from each other: in a word, those of the tangent itself.
    pub(crate) class_bits: usize,
    pub(crate) blocks: Vec<BlockLaw>,
    /// Whether friction coefficients change with the path slipped.
    pub(crate) wears: bool,
    /// Blocks on the ground (0) and on each floor.
    pub(crate) on_floor: Vec<Vec<usize>>,
    building: Option<Arc<Building>>,
    pub(crate) lanes: ModelLanes,
    /// See [`Model::symmetric_damping`].
    symmetric_damping: OnceLock<Option<Symmetric<1>>>,
    /// The damping matrix is the user's own: it need not dissipate.
    damping_may_feed: bool,
}

/// What the series needs of a building, padded to whole vectors with zeros.
#[derive(Default)]
pub(crate) struct ModelLanes {
    /// 1 for a storey, 0 for padding.
    pub(crate) inside: Padded,
    /// Columns of the full damping matrix, one after the other, as many as fill vectors; empty without one.
    pub(crate) damping: Vec<f64>,
    /// Columns of the absolute values of the full damping matrix in floor coordinates, one after the other; empty without one.
    pub(crate) damping_sizes: Vec<f64>,
    /// Rayleigh damping: storey damping of each storey (N s/m), and mass-proportional damping of each floor (N s/m).
    pub(crate) storey_damping: Vec<f64>,
    pub(crate) floor_damping: Vec<f64>,
}

impl ModelLanes {
    fn new(mass: &[f64], stiffness: &[f64], damping: &StoreyDamping) -> Self {
        let n = mass.len();
        let inside = Padded::filled(mass.iter().map(|_| 1.0), n, 0.0);
        match damping {
            StoreyDamping::None => Self { inside, ..Self::default() },
            StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => Self {
                inside,
                storey_damping: filled(stiffness.iter().map(|k| stiffness_factor * k), n, 0.0),
                floor_damping: filled(mass.iter().map(|m| mass_factor * m), n, 0.0),
                ..Self::default()
            },
            StoreyDamping::Dense(d) => {
                let mut columns: Vec<f64> =
                    d.column_iter().flat_map(|column| filled(column.iter().copied(), n, 0.0)).collect();
                columns.resize(padded(n) * n.next_multiple_of(WIDTH), 0.0);
                Self { inside, damping: columns, damping_sizes: damping_sizes(d), ..Self::default() }
            }
        }
    }
}

/// Columns of |C| in floor coordinates, padded, from a full matrix between drift rates and storey forces.
fn damping_sizes(d: &DMatrix<f64>) -> Vec<f64> {
    let n = d.nrows();
    let at = |r: usize, c: usize| if r < n && c < n { d[(r, c)] } else { 0.0 };
    let size = |i: usize, j: usize| (at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1)).abs();
    (0..n).flat_map(|j| filled((0..n).map(|i| size(i, j)), n, 0.0)).collect()
}

/// Bits that tell the tangents of a storey from each other, a power of two of them.
fn class_bits(law: &StoreyLaw) -> usize {
    match law.spring.law().tangents().map(|tangents| tangents.len()) {
        Some(..=4) => 2,
        Some(5..=16) => 4,
        Some(17..=256) => 8,
        _ => u64::BITS as usize,
    }
}

impl Model {
    pub(crate) fn new(scene: &Scene) -> Self {
        let n = scene.storeys();
        let storeys = scene.building().map_or(&[][..], |b| b.storeys());
        let collapse = scene.collapse_drift();
        let laws: Vec<StoreyLaw> = (0..n)
            .map(|i| StoreyLaw::new(&storeys[i], scene.geometric_stiffness()[i], collapse.map(|c| c[i])))
            .collect();
        let mut on_floor = vec![Vec::new(); n + 1];
        for (j, block) in scene.blocks().iter().enumerate() {
            on_floor[block.floor].push(j);
        }
        let mass = scene.building().map_or_else(Vec::new, |b| b.mass().to_vec());
        let stiffness: Vec<f64> = storeys.iter().map(|s| s.stiffness).collect();
        let damping = scene.building().map_or(&StoreyDamping::None, |b| b.storey_damping());
        Self {
            width: padded(n),
            lanes: ModelLanes::new(&mass, &stiffness, damping),
            symmetric_damping: OnceLock::new(),
            mass,
            stiffness,
            class_bits: laws.iter().map(class_bits).max().unwrap_or(2),
            laws,
            wears: scene.blocks().iter().any(|block| !block.wear.is_empty()),
            blocks: scene.blocks().iter().map(BlockLaw::new).collect(),
            on_floor,
            building: scene.building().cloned(),
            damping_may_feed: scene.building().is_some_and(|b| matches!(b.damping(), Damping::Matrix(_))),
        }
    }

    /// Number of storeys.
    #[inline]
    pub(crate) fn storeys(&self) -> usize {
        self.mass.len()
    }

    /// Damping between drift rates and storey forces.
    #[inline]
    pub(crate) fn damping(&self) -> &StoreyDamping {
        self.building.as_ref().map_or(&StoreyDamping::None, |b| b.storey_damping())
    }

    /// A full damping matrix between drift rates and storey forces, for products with vectors of any length.
    pub(crate) fn symmetric_damping(&self) -> Option<&Symmetric<1>> {
        let form = || match self.damping() {
            StoreyDamping::Dense(d) => Some(Symmetric::new(d.nrows(), |i, j| [d[(i, j)]])),
            _ => None,
        };
        self.symmetric_damping.get_or_init(form).as_ref()
    }

    /// Whether damping may feed energy into the building.
    pub(crate) fn damping_may_feed(&self) -> bool {
        self.damping_may_feed
    }
}
