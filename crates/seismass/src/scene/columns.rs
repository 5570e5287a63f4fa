//! Scenes described by columns, one row each, for batches too large to hold an object per scene.

use std::sync::Arc;

use crate::classes::Classes;
use crate::error::{Domain, Error, Result};
use crate::scene::block::Block;
use crate::scene::building::Building;
use crate::scene::building_and_blocks::Scene;
use crate::scene::check::Nth;

/// Rows of scenes that differ in their building and in what their blocks are; all start at rest.
///
/// Lists per block are row-major, rows x blocks.
#[derive(Debug, Clone, Default)]
pub struct SceneColumns {
    /// The buildings that rows choose from.
    pub buildings: Vec<Arc<Building>>,
    /// Floor of each block, counted from 1.
    pub floors: Vec<usize>,
    /// Index of the building of each row.
    pub building: Vec<usize>,
    /// Mass of each block over that of its floor; 0: the row has no such block.
    pub mass_ratio: Vec<f64>,
    /// Static friction coefficient of each block.
    pub mu_s: Vec<f64>,
    /// Kinetic friction coefficient of each block, at most the static one.
    pub mu_k: Vec<f64>,
    /// Collapse drift of every storey (m; infinite: never).
    pub collapse_drift: Option<f64>,
}

impl SceneColumns {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.building.len()
    }

    /// The different scenes among the rows, in order of first appearance, and the index of each row's.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a column is too short, or a row describes no valid scene.
    pub fn scenes(&self) -> Result<(Vec<Scene>, Vec<usize>)> {
        let mut classes = Classes::default();
        let mut scenes = Vec::new();
        let mut key = Vec::new();
        let of_row = (0..self.rows()).map(|row| {
            self.set_key(row, &mut key)?;
            let index = classes.number(&key);
            if index == scenes.len() {
                scenes.push(self.scene(row)?);
            }
            Ok(index)
        });
        let of_row = of_row.collect::<Result<_>>()?;
        Ok((scenes, of_row))
    }

    /// The scene of a row.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a column is too short, or the row describes no valid scene.
    pub fn scene(&self, row: usize) -> Result<Scene> {
        let building = self.building_of(row)?;
        let (mass, columns) = (building.mass(), self.of_blocks(row)?);
        let mut blocks = Vec::with_capacity(self.floors.len());
        for (j, &floor) in self.floors.iter().enumerate() {
            let owner = Nth("block", j);
            let [ratio, mu_s, mu_k] = columns.map(|column| column[j]);
            if !(ratio.is_finite() && ratio >= 0.0) {
                let requirement = "a positive number, or 0 for no block";
                return Err(Error::invalid(Domain::Scene, "mass_ratio", owner.to_string(), requirement, ratio));
            }
            if floor == 0 {
                let requirement = "a floor of the building, as its mass is a ratio";
                return Err(Error::invalid(Domain::Scene, "floor", owner.to_string(), requirement, floor));
            }
            // Friction is judged whether or not the row has the block; what it does not have needs no floor.
            let present = ratio > 0.0;
            let block = Block { mu_k, ..Block::new(floor, 1.0, mu_s) };
            block.validate(owner, if present { mass.len() } else { floor })?;
            if present {
                blocks.push(Block { mass: ratio * mass[floor - 1], ..block });
            }
        }
        let scene = Scene::new(Some(Arc::clone(building)), blocks)?;
        match self.collapse_drift {
            Some(limit) => scene.with_collapse_drift(vec![limit; building.len()]),
            None => Ok(scene),
        }
    }

    fn building_of(&self, row: usize) -> Result<&Arc<Building>> {
        let index = *self.building.get(row).ok_or_else(|| {
            let requirement = format!("below the number of them, {}", self.rows());
            Error::invalid(Domain::Scene, "row", "scene columns", requirement, row)
        })?;
        self.buildings.get(index).ok_or_else(|| {
            let requirement = format!("below the number of buildings, {}", self.buildings.len());
            Error::invalid(Domain::Scene, "building index", "scene columns", requirement, index)
        })
    }

    /// Mass ratio, mu_s and mu_k of the blocks of a row.
    fn of_blocks(&self, row: usize) -> Result<[&[f64]; 3]> {
        let blocks = self.floors.len();
        let of = |name: &str, column: &'_ Vec<f64>| {
            let refuse = || {
                let requirement = format!("a list of {} x {blocks} values, rows by blocks", self.rows());
                Error::invalid(Domain::Scene, name, "scene columns", requirement, format!("{} values", column.len()))
            };
            if column.len() == self.rows() * blocks { Ok(row * blocks..(row + 1) * blocks) } else { Err(refuse()) }
        };
        Ok([
            &self.mass_ratio[of("mass_ratio", &self.mass_ratio)?],
            &self.mu_s[of("mu_s", &self.mu_s)?],
            &self.mu_k[of("mu_k", &self.mu_k)?],
        ])
    }

    /// Makes `key` what the scene of a row depends on, bit for bit.
    fn set_key(&self, row: usize, key: &mut Vec<u64>) -> Result<()> {
        self.building_of(row)?;
        key.clear();
        key.push(self.building[row] as u64);
        for column in self.of_blocks(row)? {
            key.extend(column.iter().map(|value| value.to_bits()));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::scene::{Damping, Storey};

    fn columns() -> SceneColumns {
        let storeys = vec![Storey::elastic(4.37e5), Storey::elastic(3.61e5)];
        let building = Building::new(vec![1000.0, 700.0], storeys, Damping::default()).unwrap();
        SceneColumns {
            buildings: vec![Arc::new(building)],
            floors: vec![1, 2],
            building: vec![0; 3],
            mass_ratio: vec![0.5, 0.0, 0.5, 1.5, 0.5, 0.0],
            mu_s: vec![0.3; 6],
            mu_k: vec![0.2; 6],
            collapse_drift: None,
        }
    }

    #[test]
    fn a_row_is_a_scene_and_a_ratio_of_zero_no_block() {
        let (scenes, of_row) = columns().scenes().unwrap();
        assert_eq!(of_row, [0, 1, 0]);
        let block = |floor, mass| Block { mu_k: 0.2, ..Block::new(floor, mass, 0.3) };
        assert_eq!(scenes[0].blocks(), [block(1, 500.0)]);
        assert_eq!(scenes[1].blocks(), [block(1, 500.0), block(2, 1050.0)]);
        assert_eq!(scenes[1], columns().scene(1).unwrap());
    }

    /// Each column changed in one row: no row has the scene of another.
    #[test]
    fn rows_differ_by_each_column() {
        let mut all = columns();
        // Taken apart field by field: a new one does not compile until it is one of these.
        let SceneColumns { buildings, floors: _, building, mass_ratio, mu_s, mu_k, collapse_drift: _ } = &mut all;
        let other = Building::new(vec![1100.0, 700.0], buildings[0].storeys().to_vec(), Damping::default()).unwrap();
        buildings.push(Arc::new(other));
        (*building, *mass_ratio, *mu_s, *mu_k) = (vec![0; 8], vec![0.5; 16], vec![0.3; 16], vec![0.2; 16]);
        building[1] = 1;
        (mass_ratio[4], mass_ratio[7]) = (0.6, 0.6);
        (mu_s[8], mu_s[11]) = (0.4, 0.4);
        (mu_k[12], mu_k[15]) = (0.1, 0.1);
        let (scenes, of_row) = all.scenes().unwrap();
        assert_eq!(of_row, (0..8).collect::<Vec<_>>());
        for row in 0..8 {
            assert_eq!(scenes[row], all.scene(row).unwrap());
            assert!((0..row).all(|before| scenes[row] != scenes[before]), "row {row}");
        }
    }

    #[test]
    fn collapse_is_that_of_every_storey() {
        let scene = SceneColumns { collapse_drift: Some(0.1), ..columns() }.scene(0).unwrap();
        assert_eq!(scene.collapse_drift(), Some(&[0.1, 0.1][..]));
    }

    #[test]
    fn what_describes_no_scene_is_refused() {
        let refused = |message: &str, change: fn(&mut SceneColumns)| {
            let mut columns = columns();
            change(&mut columns);
            assert_eq!(columns.scenes().unwrap_err().to_string(), message);
        };
        refused("mu_k of block 2 must be at most mu_s = 0.3; got 0.4", |c| c.mu_k[3] = 0.4);
        // Friction is judged where there is no block too.
        refused("mu_s of block 2 must be finite and not negative; got -1", |c| c.mu_s[1] = -1.0);
        refused("mass_ratio of block 1 must be a positive number, or 0 for no block; got -1", |c| {
            c.mass_ratio[0] = -1.0;
        });
        refused("floor of block 1 must be a floor of the building, as its mass is a ratio; got 0", |c| c.floors[0] = 0);
        refused("floor of block 1 must be a floor of the building, 1 to 2, or 0 for the ground; got 3", |c| {
            c.floors[0] = 3;
        });
        refused("building index of scene columns must be below the number of buildings, 1; got 1", |c| {
            c.building[2] = 1;
        });
        refused("mu_s of scene columns must be a list of 3 x 2 values, rows by blocks; got 5 values", |c| {
            c.mu_s.truncate(5);
        });
    }
}
