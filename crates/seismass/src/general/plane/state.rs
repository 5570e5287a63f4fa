//! The state of a run in the plane: that of each direction, and of each block what belongs to the circle.

use crate::general::plane::vector::{Vector2, angle, dot, length, minus, plus, times, unit};
use crate::general::state::GeneralState;
use crate::general::system::System;
use crate::machines::block::{BlockLaw, BlockState};
use crate::machines::sign::Sign;
use crate::scene::PlaneScene;
use crate::tolerances::ARRIVED_ON_CIRCLE;

/// What of a block belongs to neither direction alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slide {
    /// Direction in which it starts, where it slides and its relative velocity is still zero.
    pub(super) start: Option<Vector2>,
    /// It has started from rest and not yet been faster than what counts as rest: its relative velocity is zero still.
    pub(super) is_young: bool,
    /// Path slipped in contact (m).
    pub(super) path: f64,
    /// Changes of the friction coefficients so far, and the path at the next (m).
    stage: usize,
    next_wear: f64,
}

impl Slide {
    fn new(law: &BlockLaw) -> Self {
        let next_wear = law.wear.first().map_or(f64::INFINITY, |next| next.path);
        Self { start: None, is_young: false, path: 0.0, stage: 0, next_wear }
    }

    /// Path until the coefficients change (m); infinite: they do not.
    pub(super) fn path_to_wear(&self) -> f64 {
        self.next_wear - self.path
    }
}

/// The state. The states of both directions hold the same states and friction coefficients of blocks.
pub(super) struct PlaneState<'a> {
    pub(super) axes: [GeneralState<'a>; 2],
    pub(super) slides: Vec<Slide>,
    /// Largest velocity of a node or of a block relative to its node so far (m/s).
    pub(super) fastest: f64,
    /// Working space: velocities of the nodes.
    nodes: Vec<Vector2>,
}

impl<'a> PlaneState<'a> {
    /// A scene at its start; no regime is entered yet.
    pub(super) fn new(scene: &PlaneScene, systems: [&'a System; 2], vertical: bool) -> Self {
        let [x, y] = scene.directions();
        let axes = [GeneralState::new(x, systems[0], vertical), GeneralState::new(y, systems[1], vertical)];
        let slides = systems[0].blocks.iter().map(Slide::new).collect();
        let nodes = vec![[0.0; 2]; systems[0].nodes + 1];
        let mut state = Self { axes, slides, fastest: 0.0, nodes };
        for j in 0..state.slides.len() {
            let slides = state.velocity(j) != [0.0; 2] || state.is_frictionless(j);
            state.set(j, if slides { SLIDING } else { BlockState::Stuck });
        }
        state.note_velocities();
        state
    }

    pub(super) fn system(&self) -> &'a System {
        self.axes[0].system
    }

    /// Velocity of a block relative to its node (m/s).
    #[inline]
    pub(super) fn velocity(&self, block: usize) -> Vector2 {
        self.axes.each_ref().map(|axis| axis.motions[block].velocity)
    }

    /// Slip of a block (m).
    pub(super) fn slip(&self, block: usize) -> Vector2 {
        self.axes.each_ref().map(|axis| axis.motions[block].slip)
    }

    pub(super) fn is_stuck(&self, block: usize) -> bool {
        self.axes[0].motions[block].is_stuck()
    }

    /// Whether a block slides in contact: with friction, or without.
    pub(super) fn slides(&self, block: usize) -> bool {
        self.axes[0].motions[block].sliding().is_some()
    }

    /// mu_s and mu_k of a block.
    #[inline]
    pub(super) fn friction(&self, block: usize) -> (f64, f64) {
        let motion = &self.axes[0].motions[block];
        (motion.mu_s, motion.mu_k)
    }

    /// Whether a block never sticks.
    #[inline]
    pub(super) fn is_frictionless(&self, block: usize) -> bool {
        self.friction(block).0 == 0.0
    }

    /// Sets what a block does; at rest where it sticks.
    pub(super) fn set(&mut self, block: usize, state: BlockState) {
        for axis in &mut self.axes {
            axis.motions[block].state = state;
            if state == BlockState::Stuck {
                axis.motions[block].velocity = 0.0;
            }
        }
        (self.slides[block].start, self.slides[block].is_young) = (None, false);
    }

    /// Lets a block slide from rest in a direction.
    pub(super) fn start(&mut self, block: usize, direction: Vector2) {
        self.set(block, SLIDING);
        (self.slides[block].start, self.slides[block].is_young) = (Some(direction), true);
    }

    /// Brings a block to rest; what it does then is to be decided.
    pub(super) fn bring_to_rest(&mut self, block: usize) {
        self.axes.iter_mut().for_each(|axis| axis.motions[block].velocity = 0.0);
    }

    /// Direction of the friction on a block's node: that of the relative velocity, or of the start.
    pub(super) fn direction(&self, block: usize) -> Vector2 {
        if !self.slides(block) || self.friction(block).1 == 0.0 {
            return [0.0; 2];
        }
        self.slides[block].start.or_else(|| unit(self.velocity(block))).unwrap_or([0.0; 2])
    }

    /// Whether a block starts away from its stop of a direction, and is not yet faster than what counts as rest.
    pub(super) fn starts_from(&self, block: usize, axis: usize, side: Sign) -> bool {
        let Slide { start, is_young, .. } = self.slides[block];
        is_young && start.is_some_and(|direction| side.factor() * direction[axis] < 0.0)
    }

    /// Angle of the relative velocity, or of the start; NaN where there is neither.
    pub(super) fn heading(&self, block: usize) -> f64 {
        self.slides[block].start.or_else(|| unit(self.velocity(block))).map_or(f64::NAN, angle)
    }

    /// Acceleration that its stops give a block (m/s2).
    pub(super) fn drive(&self, block: usize) -> Vector2 {
        let mass = self.system().blocks[block].mass;
        self.axes.each_ref().map(|axis| axis.stop_force(block) / mass)
    }

    /// The friction coefficients of a block change; returns how often they have.
    pub(super) fn wear(&mut self, block: usize) -> u8 {
        let (law, slide) = (&self.axes[0].system.blocks[block], &mut self.slides[block]);
        if let Some(wear) = law.wear.get(slide.stage) {
            slide.stage += 1;
            slide.next_wear = law.wear.get(slide.stage).map_or(f64::INFINITY, |next| next.path);
            for axis in &mut self.axes {
                (axis.motions[block].mu_s, axis.motions[block].mu_k) = (wear.mu_s, wear.mu_k);
            }
        }
        slide.stage as u8
    }

    /// Follows machines that have changed.
    pub(super) fn follow(&mut self) {
        self.axes.iter_mut().for_each(GeneralState::follow);
    }

    /// Forces of springs, matrix and dampers on a node, and the sizes of their terms (N).
    pub(super) fn node_force(&self, node: usize) -> (Vector2, f64) {
        let forces = self.axes.each_ref().map(GeneralState::node_forces);
        (forces.each_ref().map(|f| f.force[node]), forces.iter().map(|f| f.size[node]).sum())
    }

    /// Force of a block in motion on its node (N).
    pub(super) fn force_on_node(&self, block: usize, tau: f64) -> Vector2 {
        let friction = self.friction(block).1 * self.axes[0].contact_at(tau);
        times(self.system().blocks[block].mass, minus(times(friction, self.direction(block)), self.drive(block)))
    }

    /// Absolute accelerations of the nodes in both directions, that of the ground first (m/s2).
    pub(super) fn accelerations(&self, tau: f64) -> [Vec<f64>; 2] {
        let mut forces = self.axes.each_ref().map(|axis| axis.node_forces().force);
        for &j in &self.axes[0].moving {
            let (node, force) = (self.system().blocks[j].floor, self.force_on_node(j, tau));
            (forces[0][node], forces[1][node]) = (forces[0][node] + force[0], forces[1][node] + force[1]);
        }
        for (axis, force) in self.axes.iter().zip(&mut forces) {
            force.iter_mut().zip(&axis.regime.inverse_mass).for_each(|(value, inverse)| *value *= inverse);
            force[0] = axis.interval.ground_at(tau);
        }
        forces
    }

    /// Notes the largest velocity so far.
    pub(super) fn note_velocities(&mut self) {
        let Self { axes, nodes, fastest, .. } = self;
        nodes[0] = [0.0; 2];
        for p in 1..nodes.len() {
            let parent = nodes[axes[0].system.parent[p]];
            nodes[p] = [parent[0] + axes[0].v[p], parent[1] + axes[1].v[p]];
        }
        let of_blocks = axes[0].motions.iter().zip(&axes[1].motions).map(|(x, y)| [x.velocity, y.velocity]);
        for velocity in nodes.iter().copied().chain(of_blocks) {
            // A length where it may be the largest, and where the square has lost digits.
            let square = dot(velocity, velocity);
            if square > *fastest * *fastest || square < f64::MIN_POSITIVE {
                *fastest = fastest.max(length(velocity));
            }
        }
    }

    /// Drift vector of a node's spring (m).
    pub(super) fn drift(&self, node: usize) -> Vector2 {
        self.axes.each_ref().map(|axis| axis.drift(node))
    }

    /// Moves a block by changes of its relative velocity and slip, over a path. The direction of a velocity that counts as
    /// rest is rounding: a block that has just started is at rest until it is faster.
    pub(super) fn move_block(&mut self, block: usize, velocity: Vector2, slip: Vector2, path: f64) {
        let mut velocity = plus(self.velocity(block), velocity);
        let slide = &mut self.slides[block];
        slide.is_young &= length(velocity) <= ARRIVED_ON_CIRCLE * self.fastest;
        slide.path += path;
        if slide.is_young {
            velocity = [0.0; 2];
        } else {
            slide.start = None;
        }
        for (a, axis) in self.axes.iter_mut().enumerate() {
            axis.motions[block].velocity = velocity[a];
            axis.motions[block].slip += slip[a];
            axis.stops[block].move_by(slip[a]);
        }
    }
}

/// A block slides; its direction is that of the vector, the sign has no meaning.
pub(super) const SLIDING: BlockState = BlockState::Sliding(Sign::Positive);
