//! What is kept between two calls of the loop of plain steps.

use crate::machines::block::BlockMotion;
use crate::machines::model::Model;
use crate::machines::sign::Sign;
use crate::plain::new_peaks::NewPeaks;
use crate::plain::sliding::{GroundBlock, Layer, OnGround};
use crate::state::State;

/// A run of plain steps between two calls of `clear_steps`: the blocks that slide, and the peaks that are beaten.
pub(crate) struct PlainLoop {
    pub(crate) beaten: NewPeaks,
    /// Series formed for turns beyond peaks, and turns looked at.
    pub(crate) series: usize,
    pub(crate) isolated: usize,
    /// Whether the bounds are to follow springs and peaks before the next step: not where a run goes on with those that it
    /// has made for peaks not taken yet.
    pub(crate) renews_bounds: bool,
    pub(crate) layers: Vec<Layer>,
    /// Layers in which blocks slide: the first so many.
    pub(crate) used: usize,
    /// Blocks that slide on floors: block, layer, lane.
    pub(crate) on_floors: Vec<(usize, usize, usize)>,
    /// Slips at which friction coefficients of these change.
    pub(crate) wear_limits: Vec<WearLimit>,
    pub(crate) on_ground: OnGround,
}

/// A slip, times a sign, at which the friction coefficients of a block change.
pub(crate) struct WearLimit {
    layer: usize,
    lane: usize,
    sign: f64,
    slip: f64,
}

/// Whether a block comes to a slip at which its friction changes, of layers with these slips.
#[inline(never)]
pub(crate) fn wears(limits: &[WearLimit], lowest: &[f64], others: &[Layer]) -> bool {
    limits.iter().any(|limit| {
        let slips = match limit.layer.checked_sub(1) {
            Some(other) => &others[other].after[1][..],
            None => lowest,
        };
        limit.sign * slips[limit.lane] >= limit.slip
    })
}

impl PlainLoop {
    pub(crate) fn new(model: &Model) -> Self {
        Self {
            beaten: NewPeaks::new(model),
            series: 0,
            isolated: 0,
            renews_bounds: true,
            layers: Vec::new(),
            used: 0,
            on_floors: Vec::new(),
            wear_limits: Vec::new(),
            on_ground: OnGround::new(),
        }
    }

    /// Takes up the sliding blocks at a sample.
    pub(crate) fn begin<const K: usize>(&mut self, state: &State, sample: usize) {
        for (_, layer, lane) in self.on_floors.drain(..) {
            self.layers[layer].leave::<K>(lane);
        }
        self.used = 0;
        self.wear_limits.clear();
        self.renews_bounds = true;
        self.beaten.forget_turned();
        self.on_ground.begin(sample, state.blocks.stuck_mu[0]);
        if state.blocks.is_sliding {
            self.take_blocks::<K>(state);
        }
    }

    #[inline(always)]
    fn take_blocks<const K: usize>(&mut self, state: &State) {
        for &block in &state.blocks.moving {
            let (motion, law) = (&state.blocks.motions[block], &state.model.blocks[block]);
            let Some(sign) = motion.sliding().map(Sign::factor) else { continue };
            let friction = sign * motion.mu_k;
            let Some(lane) = law.floor.checked_sub(1) else {
                let (BlockMotion { velocity, slip, .. }, limit) = (*motion, motion.wear_limit(sign));
                self.on_ground.push(GroundBlock { block, friction, sign, velocity, slip, limit });
                continue;
            };
            let free = self.layers.iter().position(|layer| layer.is_free::<K>(lane));
            let which = free.unwrap_or(self.layers.len());
            if free.is_none() {
                self.layers.push(Layer::new(state.model));
            }
            self.layers[which].take::<K>(lane, sign, friction, motion);
            if motion.path_to_wear() < f64::INFINITY {
                self.wear_limits.push(WearLimit { layer: which, lane, sign, slip: motion.wear_limit(sign) });
            }
            self.on_floors.push((block, which, lane));
            self.used = self.used.max(which + 1);
        }
    }

    /// Brings the sliding blocks up to date.
    #[inline(always)]
    pub(crate) fn put_blocks<const K: usize>(&self, motions: &mut [BlockMotion]) {
        for &(block, layer, lane) in &self.on_floors {
            (motions[block].velocity, motions[block].slip) = self.layers[layer].motion::<K>(lane);
        }
        for ground in self.on_ground.sliding() {
            (motions[ground.block].velocity, motions[ground.block].slip) = (ground.velocity, ground.slip);
        }
    }
}
