//! Accelerations of nodes in the last instants before blocks stop in the plane.
//!
//! As a block comes to rest its friction turns into the direction of what drives it, and takes a light node with it. The turn
//! goes on until the stop. A run is cut off where velocities are rounding (`numerics`, section 9.7), which is elsewhere in
//! other precisions and with other steps, and its last way may be one step. The limit is known in closed form; a peak that
//! falls between is known within what friction can do as it turns, and no closer.

use seismass::{EventKind, Peak, PlaneEvent, PlaneScene, STANDARD_GRAVITY};

use crate::general::Model;
use crate::stress::verdict::AGREEMENT;

/// How long before a stop or after it a peak counts as one there (s).
const INSTANTS: f64 = 1e-9;

/// The stops of blocks, and what they may do to their nodes.
#[derive(Debug, Clone, Default)]
pub(super) struct BeforeStops {
    /// Times of the stops of the blocks of each node (s).
    times: Vec<Vec<f64>>,
    /// Twice the friction of all blocks of each node over its mass (m/s2).
    turns: Vec<f64>,
}

impl BeforeStops {
    /// Those of a run; `vertical` are the samples of a vertical acceleration.
    pub(super) fn new(scene: &PlaneScene, vertical: &[f64], events: &[PlaneEvent]) -> Self {
        let model = Model::<f64>::new(&scene.directions()[0]);
        let gravity = vertical.iter().fold(STANDARD_GRAVITY, |most, a| most.max(STANDARD_GRAVITY + a));
        let mut turns = vec![0.0; model.mass.len()];
        for goods in &model.goods {
            if let Some(node) = goods.node {
                let largest = goods.stages.iter().fold(0.0f64, |most, stage| most.max(stage.mu_s));
                turns[node] += 2.0 * goods.mass * largest * gravity / model.mass[node];
            }
        }
        let mut times = vec![Vec::new(); model.mass.len()];
        for event in events.iter().map(|entry| entry.event.event).filter(|event| event.kind == EventKind::Stick) {
            if let Some(node) = model.goods[event.number - 1].node {
                times[node].push(event.time);
            }
        }
        Self { times, turns }
    }

    /// Whether two peaks of a node are apart by no more than friction may do as it turns, the larger being at a stop.
    pub(super) fn part(&self, node: usize, one: Peak, other: Peak) -> bool {
        let largest = if one.value > other.value { one } else { other };
        let apart = (one.value - other.value).abs();
        apart > AGREEMENT * largest.value
            && self.turns.get(node).is_some_and(|&turn| apart <= turn)
            && self.times[node].iter().any(|stop| (stop - largest.time).abs() <= INSTANTS)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::sync::Arc;

    use seismass::{Block, Damping, Event, GeneralBuilding, GeneralEvent, GeneralScene, GravityEffect, Rack, Storey};

    use super::*;

    /// A floor of 200 kg with a rack of one level of 40 kg that carries 10 kg of mu = 0.4: friction turns the acceleration of
    /// the level by up to 2 0.4 10/40 g. Goods on the ground come before.
    #[test]
    fn peaks_part_at_the_stops_of_their_own_goods_alone() {
        let building = GeneralBuilding::new(
            vec![200.0],
            vec![Storey::elastic(1e5)],
            None,
            &Damping::Modal { ratio: 0.0 },
            GravityEffect::None,
        );
        let rack = Rack {
            floor: 1,
            mass: vec![40.0],
            levels: vec![Storey::elastic(1e5)],
            damping_ratio: 0.0,
            geometric_stiffness: Vec::new(),
            goods: vec![Block::new(1, 10.0, 0.4).into()],
        };
        let ground = vec![Block::new(0, 1000.0, 0.5).into()];
        let scene = GeneralScene::new(Some(Arc::new(building.unwrap())), ground, vec![rack]).unwrap();
        let scene = PlaneScene::new(scene.clone(), scene).unwrap();
        let stick = |number: usize, time: f64| {
            let event = Event { time, kind: EventKind::Stick, number, sign: 0, element: 0 };
            PlaneEvent { event: GeneralEvent { event, velocity: 0.0 }, axis: None, angle: 0.0 }
        };
        let stops = BeforeStops::new(&scene, &[], &[stick(1, 1.0), stick(2, 2.0)]);
        let part = |node: usize, value: f64, time: f64| {
            stops.part(node, Peak { value: 3.0, time: 0.5 }, Peak { value: 3.0 + value, time })
        };
        let turn = 0.2 * STANDARD_GRAVITY;
        assert!(part(1, 0.99 * turn, 2.0) && part(1, 1e-6, 2.0 - 1e-15));
        assert!(!part(1, 1.01 * turn, 2.0), "more than friction");
        assert!(!part(1, 0.99 * turn, 2.0 - 1e-8), "before it stops");
        assert!(!part(1, 0.99 * turn, 1.0), "as the goods on the ground stop");
        assert!(!part(1, -0.99 * turn, 2.0), "the larger is elsewhere");
        assert!(!part(0, 0.99 * turn, 2.0), "a floor without goods");
    }
}
