//! Blocks that slide during a run of plain steps: those on floors in layers of lanes, those on the ground one by one.

use std::mem::swap;

use crate::lanes::{FAR, Padded, Vector, load};
use crate::machines::block::BlockMotion;
use crate::machines::model::Model;
use crate::polynomial::enclosure::{THIRD, distance_against, range, ranges};
use crate::tolerances::SMALL_DIFFERENCE;

/// Blocks that slide, at most one on each floor. Padded; lanes in which no block slides never turn.
pub(crate) struct Layer {
    /// Sign times mu_k.
    pub(crate) friction: Padded,
    pub(crate) sign: Padded,
    /// What the negative of sign times velocity may not reach: 0; far where no block slides.
    pub(crate) turn: Padded,
    pub(crate) velocity: Padded,
    pub(crate) slip: Padded,
    /// Velocity and slip at the end of the present step.
    pub(crate) after: [Padded; 2],
}

impl Layer {
    pub(crate) fn new(model: &Model) -> Self {
        let lanes = |value: f64| Padded::new(model.width, value);
        let zero = || lanes(0.0);
        Self {
            friction: zero(),
            sign: zero(),
            turn: lanes(FAR),
            velocity: zero(),
            slip: zero(),
            after: [zero(), zero()],
        }
    }

    /// Whether no block slides in a lane.
    #[inline(always)]
    pub(crate) fn is_free<const K: usize>(&self, lane: usize) -> bool {
        self.sign.numbers::<K>()[lane] == 0.0
    }

    #[inline(always)]
    pub(crate) fn take<const K: usize>(&mut self, lane: usize, sign: f64, friction: f64, motion: &BlockMotion) {
        self.set::<K>(lane, [sign, 0.0, friction, motion.velocity, motion.slip]);
    }

    #[inline(always)]
    pub(crate) fn leave<const K: usize>(&mut self, lane: usize) {
        self.set::<K>(lane, [0.0, FAR, 0.0, 0.0, 0.0]);
    }

    #[inline(always)]
    fn set<const K: usize>(&mut self, lane: usize, values: [f64; 5]) {
        let Self { sign, turn, friction, velocity, slip, .. } = self;
        for (numbers, value) in [sign, turn, friction, velocity, slip].into_iter().zip(values) {
            numbers.numbers_mut::<K>()[lane] = value;
        }
    }

    /// Velocity and slip in a lane.
    #[inline(always)]
    pub(crate) fn motion<const K: usize>(&self, lane: usize) -> (f64, f64) {
        (self.velocity.numbers::<K>()[lane], self.slip.numbers::<K>()[lane])
    }

    /// Takes the present step.
    pub(crate) fn accept(&mut self) {
        let [velocity, slip] = &mut self.after;
        swap(&mut self.velocity, velocity);
        swap(&mut self.slip, slip);
    }
}

/// A [`Layer`] in vectors.
#[derive(Clone, Copy)]
pub(crate) struct LayerInLanes<V, const K: usize> {
    pub(crate) friction: [V; K],
    pub(crate) sign: [V; K],
    pub(crate) turn: [V; K],
    pub(crate) velocity: [V; K],
    pub(crate) slip: [V; K],
}

/// What moves the blocks in a step: the motion of the ground and of the floors on it, the latter beyond that at the
/// velocities of the start, and contact forces.
pub(crate) struct BlockDrive<V, const K: usize> {
    pub(crate) h: f64,
    pub(crate) ground: LinearInTime,
    pub(crate) contact: LinearInTime,
    pub(crate) velocity: [V; K],
    pub(crate) displacement: [V; K],
    pub(crate) a: [[V; K]; 2],
    /// Margin of the relative velocities.
    pub(crate) margin: [V; K],
}

impl<V: Vector, const K: usize> LayerInLanes<V, K> {
    #[inline(always)]
    pub(crate) fn of(layer: &Layer) -> Self {
        Self {
            friction: load(&layer.friction),
            sign: load(&layer.sign),
            turn: load(&layer.turn),
            velocity: load(&layer.velocity),
            slip: load(&layer.slip),
        }
    }

    /// Lanes in which blocks slide, as bits.
    #[inline(always)]
    pub(crate) fn taken(&self) -> [u32; K] {
        let mut lanes = [0; K];
        for k in 0..K {
            lanes[k] = self.sign[k].abs().not_below(V::splat(1.0));
        }
        lanes
    }

    /// h / 3 times the size of the relative acceleration, less sign times velocity.
    #[inline(always)]
    fn approach(&self, k: usize, velocity: V, a: V, contact: f64, third: V) -> V {
        let rate = self.friction[k].mul(V::splat(contact)).add(a);
        third.mul(rate.abs()).sub(self.sign[k].mul(velocity))
    }

    /// The layer at the end of a step, and whether a block may have turned in it.
    #[inline(always)]
    pub(crate) fn pushed(&self, push: &BlockDrive<V, K>) -> (Self, bool) {
        let (length, third) = (V::splat(push.h), V::splat(push.h * THIRD));
        let (once, ground_once) = (V::splat(push.contact.once(push.h)), V::splat(push.ground.once(push.h)));
        let (twice, ground_twice) = (V::splat(push.contact.twice(push.h)), V::splat(push.ground.twice(push.h)));
        // A velocity that is a small difference of large ones is left to the series.
        let digits = V::splat(-SMALL_DIFFERENCE);
        let mut after = *self;
        let mut turning = 0;
        for k in 0..K {
            let pushed = self.friction[k].mul_add(once, ground_once);
            after.velocity[k] = self.velocity[k].sub(pushed.add(push.velocity[k]));
            let pushed = self.friction[k].mul_add(twice, ground_twice);
            let own = length.mul(self.velocity[k]).sub(pushed.add(push.displacement[k]));
            after.slip[k] = self.slip[k].add(own);
            let approach = self.approach(k, self.velocity[k], push.a[0][k], push.contact.start, third);
            let approach_after = self.approach(k, after.velocity[k], push.a[1][k], push.contact.end, third);
            let bound = digits.mul_add(push.velocity[k].abs(), self.turn[k]);
            turning |= push.margin[k].add(approach.max(approach_after)).not_below(bound);
        }
        (after, turning != 0)
    }

    /// Checks whether a block may turn in the step to `velocity`, by the Bezier points of relative velocities.
    #[inline(always)]
    pub(crate) fn turns(&self, velocity: &[V; K], push: &BlockDrive<V, K>) -> bool {
        let (zero, third, digits) = (V::splat(0.0), V::splat(push.h * THIRD), V::splat(-SMALL_DIFFERENCE));
        let mut turning = 0;
        for k in 0..K {
            let rate = zero.sub(self.friction[k].mul(V::splat(push.contact.start)).add(push.a[0][k]));
            let rate_after = zero.sub(self.friction[k].mul(V::splat(push.contact.end)).add(push.a[1][k]));
            let ends = ([self.velocity[k], rate], [velocity[k], rate_after]);
            let range = ranges(ends.0, ends.1, third, push.margin[k]);
            let bound = digits.mul_add(push.velocity[k].abs(), self.turn[k]);
            turning |= distance_against(range, self.sign[k]).not_below(bound);
        }
        turning != 0
    }
}

/// A block that slides on the ground.
#[derive(Clone, Copy)]
pub(crate) struct GroundBlock {
    pub(crate) block: usize,
    pub(crate) friction: f64,
    pub(crate) sign: f64,
    pub(crate) velocity: f64,
    pub(crate) slip: f64,
    /// What sign times slip does not reach before the friction coefficient changes.
    pub(crate) limit: f64,
}

impl GroundBlock {
    /// Slip after a step of `h`.
    #[inline(always)]
    fn slip_after(&self, ground: LinearInTime, contact: LinearInTime, h: f64) -> f64 {
        self.slip + (self.velocity * h - self.friction * contact.twice(h) - ground.twice(h))
    }
}

/// Values at both ends of an interval of what is linear between them.
#[derive(Clone, Copy)]
pub(crate) struct LinearInTime {
    pub(crate) start: f64,
    pub(crate) end: f64,
}

impl LinearInTime {
    /// Integral over the length `h`.
    #[inline(always)]
    pub(crate) fn once(self, h: f64) -> f64 {
        0.5 * h * (self.start + self.end)
    }

    /// Second integral over the length `h`.
    #[inline(always)]
    pub(crate) fn twice(self, h: f64) -> f64 {
        (1.0 / 6.0) * h * h * (2.0 * self.start + self.end)
    }
}

/// Whether the ground holds blocks that are stuck to it with `stuck_mu`, by accelerations and contact forces over a step.
fn holds_on_ground(ground: LinearInTime, contact: LinearInTime, stuck_mu: f64) -> bool {
    ground.start.abs() < stuck_mu * contact.start && ground.end.abs() < stuck_mu * contact.end
}

/// Moves the blocks that slide on the ground over a step; false when one may have turned, or one that is stuck broken
/// away: then nothing is moved.
#[inline(never)]
pub(crate) fn move_on_ground(
    blocks: &mut [GroundBlock],
    ground: LinearInTime,
    contact: LinearInTime,
    h: f64,
    stuck_mu: f64,
) -> bool {
    if stuck_mu.is_finite() && !holds_on_ground(ground, contact, stuck_mu) {
        return false;
    }
    let end = |b: &GroundBlock| b.velocity - b.friction * contact.once(h) - ground.once(h);
    let keeps = |b: &GroundBlock| {
        let rate = (-b.friction * contact.start - ground.start, -b.friction * contact.end - ground.end);
        let (low, high) = range(b.velocity, rate.0, end(b), rate.1, h * THIRD, 0.0);
        let slides = if b.sign > 0.0 { low > 0.0 } else { high < 0.0 };
        slides && (b.limit == f64::INFINITY || b.sign * b.slip_after(ground, contact, h) < b.limit)
    };
    if !blocks.iter().all(keeps) {
        return false;
    }
    for block in blocks {
        block.slip = block.slip_after(ground, contact, h);
        block.velocity = end(block);
    }
    true
}

/// Blocks on the ground, which nothing but the ground moves: they go ahead of the building as far as none has an event.
pub(crate) struct OnGround {
    sliding: Vec<GroundBlock>,
    /// The same where they last went ahead from.
    before: Vec<GroundBlock>,
    /// Samples that they last went ahead from, and have come to.
    from: usize,
    ahead: usize,
    stuck_mu: f64,
}

impl OnGround {
    /// Intervals that they go ahead at once.
    const STRETCH: usize = 32;

    pub(crate) fn new() -> Self {
        Self { sliding: Vec::new(), before: Vec::new(), from: 0, ahead: 0, stuck_mu: f64::INFINITY }
    }

    /// Starts anew at a sample, without blocks that slide and with `stuck_mu` of those that do not.
    #[inline]
    pub(crate) fn begin(&mut self, sample: usize, stuck_mu: f64) {
        self.sliding.clear();
        (self.from, self.ahead, self.stuck_mu) = (sample, sample, stuck_mu);
    }

    pub(crate) fn push(&mut self, block: GroundBlock) {
        self.sliding.push(block);
    }

    /// Those that slide, where they have come to.
    pub(crate) fn sliding(&self) -> &[GroundBlock] {
        &self.sliding
    }

    /// Whether there is anything to look at.
    #[inline]
    pub(crate) fn is_watched(&self) -> bool {
        !self.sliding.is_empty() || self.stuck_mu < f64::INFINITY
    }

    /// Lets them go ahead of the building, which has come to sample `reached`, if they are not; to `end` at most, and by
    /// one interval if they are to stay together. `drive` gives ground acceleration and contact force in an interval.
    /// Returns the sample that they have come to.
    pub(crate) fn go_ahead(
        &mut self,
        reached: usize,
        end: usize,
        stay_together: bool,
        h: f64,
        drive: impl Fn(usize) -> (LinearInTime, LinearInTime),
    ) -> usize {
        if reached == self.ahead {
            self.before.clone_from(&self.sliding);
            self.from = reached;
            let stretch = if stay_together { 1 } else { Self::STRETCH };
            self.move_to(end.min(reached + stretch), h, drive);
        }
        self.ahead
    }

    /// Takes them back to the sample that the building has come to.
    pub(crate) fn go_back(&mut self, reached: usize, h: f64, drive: impl Fn(usize) -> (LinearInTime, LinearInTime)) {
        if reached < self.ahead {
            self.sliding.clone_from(&self.before);
            self.ahead = self.from;
            self.move_to(reached, h, drive);
        }
    }

    fn move_to(&mut self, end: usize, h: f64, drive: impl Fn(usize) -> (LinearInTime, LinearInTime)) {
        while self.ahead < end {
            let (ground, contact) = drive(self.ahead);
            if !move_on_ground(&mut self.sliding, ground, contact, h, self.stuck_mu) {
                break;
            }
            self.ahead += 1;
        }
    }
}

/// A block that slides on a floor.
pub(crate) struct FloorBlock {
    pub(crate) block: usize,
    pub(crate) floor: usize,
    /// Sign times mu_k.
    pub(crate) friction: f64,
    pub(crate) sign: f64,
    pub(crate) velocity: f64,
    pub(crate) slip: f64,
    /// What sign times slip does not reach before the friction coefficient changes.
    pub(crate) limit: f64,
    /// Velocity and slip at the end of the step.
    pub(crate) velocity_after: f64,
    pub(crate) slip_after: f64,
}
