//! How the state follows its machines: bounds, loads, and the regime.

use crate::lanes::{FAR, Vector, by_width, for_each_path};
use crate::machines::block::BlockState;
use crate::regime::Regime;
use crate::state::State;
use crate::state::key::WORD;

impl State<'_> {
    /// Follows all state machines: bounds, loads, and the regime.
    pub(crate) fn enter_regime(&mut self) {
        by_width!(self.model.width, K => follow_machines::<K>(self));
        self.find_regime();
    }

    /// Follows a change of one storey's spring.
    #[inline(always)]
    pub(crate) fn enter_regime_of_spring<V: Vector, const K: usize>(&mut self, i: usize) {
        self.follow_spring::<V, K>(i);
        self.springs.form_loads::<V, K>(self.vectors::<K>());
        self.find_regime();
    }

    /// Follows changes of the blocks on a floor, or on the ground (0).
    #[inline(always)]
    pub(crate) fn enter_regime_of_blocks<V: Vector, const K: usize>(&mut self, floor: usize) {
        self.follow_blocks::<V, K>(floor);
        self.find_regime();
    }

    #[inline(always)]
    fn follow_spring<V: Vector, const K: usize>(&mut self, i: usize) {
        self.springs.follow::<V, K>(self.model, i);
        let segment = self.springs.machines[i].segment();
        self.bounds.follow_spring::<V, K>(i, self.springs.guarded_drift(i), segment.rate_sign);
        let bits = self.model.class_bits;
        let class = if bits == WORD { segment.tangent.to_bits() } else { u64::from(segment.class) };
        self.key.set_class(bits, i, class);
    }

    #[inline(always)]
    fn follow_blocks<V: Vector, const K: usize>(&mut self, floor: usize) {
        let (model, blocks) = (self.model, &mut self.blocks);
        let of_springs = model.class_bits * self.springs.machines.len();
        let (mut friction, mut stuck_mass, mut least) = (0.0, 0.0, f64::INFINITY);
        blocks.moving.retain(|&j| model.blocks[j].floor != floor);
        for &j in &model.on_floor[floor] {
            let (motion, law) = (&blocks.motions[j], &model.blocks[j]);
            self.key.set_stuck(of_springs, j, motion.is_stuck());
            match motion.state {
                BlockState::Stuck => {
                    least = motion.mu_s.min(least);
                    stuck_mass += law.mass;
                    continue;
                }
                BlockState::Sliding(sign) => friction += sign.factor() * motion.mu_k * law.mass,
                BlockState::Airborne => {}
            }
            blocks.moving.push(j);
        }
        blocks.moving.sort_unstable();
        blocks.is_sliding = blocks.moving.iter().any(|&j| blocks.motions[j].sliding().is_some());
        blocks.stuck_mu[floor] = least;
        if let Some(i) = floor.checked_sub(1) {
            blocks.stuck_mass[i] = stuck_mass;
            blocks.friction.set_lane::<V, K>(i, friction);
            self.bounds.stuck_mu.set_lane::<V, K>(i, least.min(FAR));
        }
    }

    fn find_regime(&mut self) {
        let (model, springs, stuck_mass) = (self.model, &self.springs.machines, &self.blocks.stuck_mass);
        let form = || Regime::new(model, |i| springs[i].segment().tangent, stuck_mass);
        let known;
        (self.regime, self.key.entry, known) = self.cache.enter(&self.key.words, form);
        if known {
            self.key.entered.1 += 1;
        } else {
            self.key.entered.0 += 1;
        }
        self.step.effects.valid = false;
    }
}

for_each_path! {
    /// Follows all springs and blocks.
    fn follow_machines[K: usize](state: &mut State) = machines_by_path
}

#[inline(always)]
fn machines_by_path<V: Vector, const K: usize>(state: &mut State) {
    for i in 0..state.storeys() {
        state.follow_spring::<V, K>(i);
    }
    state.springs.form_loads::<V, K>(state.vectors::<K>());
    for floor in 0..state.model.on_floor.len() {
        state.follow_blocks::<V, K>(floor);
    }
}
