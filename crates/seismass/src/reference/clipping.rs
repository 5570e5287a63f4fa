//! The friction impulses of one floor over one step, clipped to their limits; in closed form for several blocks too.
//!
//! With V the floor's velocity after the step, w_j the block's without friction, and L_j its limit, the impulse of
//! block j is clip(m_j (w_j - V), -L_j, L_j), and m V = m V_free + their sum. That is piecewise linear and increasing
//! in V, so its root is found by sorting the velocities at which blocks begin and cease to stick (the scalar case of
//! the time-stepping of Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988).

/// A block as the leapfrog sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub(super) mass: f64,
    pub(super) mu_s: f64,
    pub(super) mu_k: f64,
    /// 1 / (1 / floor mass + 1 / block mass); the block's mass on the ground.
    pub(super) reduced: f64,
    pub(super) inverse_mass: f64,
    /// Velocity relative to the ground (m/s).
    pub(super) velocity: f64,
    /// Velocity relative to the floor (m/s): exactly zero while stuck.
    pub(super) relative: f64,
    pub(super) slip: f64,
    /// Limit of the impulse in the present step (N s).
    pub(super) limit: f64,
}

impl Contact {
    /// A single block, its velocity being the free one; returns the impulse on the floor, whose free velocity is
    /// `floor`. `contact` is the impulse of the contact force per mass.
    ///
    /// A block that passes zero relative velocity is braked up to there and pushed from there on: clipping alone, which
    /// takes the limit of one sign for the whole step, is of order 1 at such a reversal.
    #[inline]
    pub(super) fn clip(&mut self, floor: f64, floor_inverse_mass: f64, contact: f64) -> f64 {
        let kinetic = self.mu_k * self.mass * contact;
        let before = self.reduced * self.relative;
        let sticking = self.reduced * (self.velocity - floor);
        let push = sticking - before;
        let arrives = before * (sticking - kinetic.copysign(before)) <= 0.0;
        let stays = arrives && push.abs() <= self.mu_s * self.mass * contact;
        let impulse = if stays {
            sticking
        } else if arrives {
            kinetic.copysign(push) * (1.0 - 2.0 * before.abs() / (push.abs() + kinetic))
        } else {
            kinetic.copysign(before)
        };
        let end = floor + impulse * floor_inverse_mass;
        self.velocity = if stays { end } else { self.velocity - impulse * self.inverse_mass };
        self.relative = self.velocity - end;
        impulse
    }
}

impl Contact {
    /// The impulse on the floor with which the block sticks to it at its velocity `end`.
    fn sticking(&self, end: f64) -> f64 {
        self.mass * (self.velocity - end)
    }
}

/// A velocity of the floor at which a block begins to stick, or ceases to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Breakpoint {
    velocity: f64,
    block: usize,
    begins: bool,
}

/// Several blocks on one floor of mass `mass` and free velocity `free`; returns the floor's velocity after the step.
///
/// Limits hold for the whole step, so this is of order 1 where a block reverses.
pub(super) fn clip_several(
    mass: f64,
    free: f64,
    blocks: &mut [Contact],
    contact: f64,
    breakpoints: &mut Vec<Breakpoint>,
) -> f64 {
    for block in blocks.iter_mut() {
        block.limit = if block.relative == 0.0 { block.mu_s } else { block.mu_k } * block.mass * contact;
    }
    let mut end = common_velocity(mass, free, blocks, breakpoints);
    let mut changed = false;
    for block in blocks.iter_mut() {
        // A block that would reverse passes zero, where the static limit holds it if it can.
        if block.sticking(end).abs() > block.limit && block.sticking(end) * block.relative < 0.0 {
            block.limit = block.mu_s * block.mass * contact;
            changed = true;
        }
    }
    loop {
        if changed {
            end = common_velocity(mass, free, blocks, breakpoints);
        }
        // A block that cannot be held at its static limit slides at the kinetic one, and the floor decides again.
        changed = false;
        for block in blocks.iter_mut() {
            let kinetic = block.mu_k * block.mass * contact;
            if block.limit > kinetic && block.sticking(end).abs() > block.limit {
                block.limit = kinetic;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    for block in blocks {
        let sticking = block.sticking(end);
        let sticks = sticking.abs() <= block.limit;
        block.velocity =
            if sticks { end } else { block.velocity - block.limit.copysign(sticking) * block.inverse_mass };
        block.relative = block.velocity - end;
    }
    end
}

/// The root of m (V - V_free) = sum of clip(m_j (w_j - V), -L_j, L_j).
fn common_velocity(mass: f64, free: f64, blocks: &[Contact], breakpoints: &mut Vec<Breakpoint>) -> f64 {
    breakpoints.clear();
    let (mut momentum, mut moving) = (mass * free, mass);
    for (j, block) in blocks.iter().enumerate() {
        let reach = block.limit * block.inverse_mass;
        breakpoints.push(Breakpoint { velocity: block.velocity - reach, block: j, begins: true });
        breakpoints.push(Breakpoint { velocity: block.velocity + reach, block: j, begins: false });
        momentum += block.limit;
    }
    // A block without friction begins before it ceases: the sort is by velocity, then by that.
    breakpoints.sort_unstable_by(|a, b| a.velocity.total_cmp(&b.velocity).then(b.begins.cmp(&a.begins)));
    for point in breakpoints.iter() {
        if momentum <= moving * point.velocity {
            break;
        }
        let block = &blocks[point.block];
        let own = block.mass * block.velocity;
        if point.begins {
            momentum += own - block.limit;
            moving += block.mass;
        } else {
            momentum -= own + block.limit;
            moving -= block.mass;
        }
    }
    momentum / moving
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(mass: f64, mu_s: f64, mu_k: f64, velocity: f64, relative: f64) -> Contact {
        Contact {
            mass,
            mu_s,
            mu_k,
            reduced: 1.0 / (1.0 / 3.0 + 1.0 / mass),
            inverse_mass: 1.0 / mass,
            velocity,
            relative,
            slip: 0.0,
            limit: 0.0,
        }
    }

    /// One block that does not reverse: both ways are the same closed form.
    #[test]
    fn several_blocks_of_one_are_the_single_block() {
        for step in -40..=40 {
            let velocity = 0.1 * f64::from(step);
            for relative in [0.0, velocity - 0.4] {
                let mut single = contact(2.0, 0.3, 0.2, velocity, relative);
                let mut several = [single];
                let floor = 0.4 + single.clip(0.4, 1.0 / 3.0, 1.5) / 3.0;
                let end = clip_several(3.0, 0.4, &mut several, 1.5, &mut Vec::new());
                assert!((floor - end).abs() < 1e-15);
                assert!((single.velocity - several[0].velocity).abs() < 1e-15);
                assert_eq!(single.relative == 0.0, several[0].relative == 0.0);
            }
        }
    }

    /// Relative velocity 0.5, limit 2 * 0.2 * 1.5 on the ground, free impulse -2 * 3: it stops after
    /// 1 / 6.6 of the step.
    #[test]
    fn a_reversal_is_split_where_the_block_stops() {
        let mut block = Contact { reduced: 2.0, ..contact(2.0, 0.3, 0.2, 0.5 - 3.0, 0.5) };
        block.clip(0.0, 0.0, 1.5);
        let expected = (1.0 - 1.0 / 6.6) * (-3.0 + 0.3);
        assert!((block.velocity - expected).abs() < 1e-15, "{}", block.velocity);
    }

    /// Momentum is conserved, no impulse exceeds its limit, and a block that slides is slowed with all of it.
    #[test]
    fn the_root_satisfies_the_law_of_friction() {
        for step in -60..=60 {
            let free = 0.07 * f64::from(step);
            let specification =
                [(1.0, 0.1, 0.1, 0.3), (2.0, 0.25, 0.25, -0.2), (1.5, 0.0, 0.0, 0.1), (0.5, 0.4, 0.4, 0.0)];
            let mut blocks = specification.map(|(mass, mu_s, mu_k, v)| contact(mass, mu_s, mu_k, v, 1.0));
            let end = clip_several(3.0, free, &mut blocks, 1.3, &mut Vec::new());
            let mut momentum = 3.0 * (end - free);
            for (block, (mass, _, mu, before)) in blocks.iter().zip(specification) {
                let impulse = mass * (before - block.velocity);
                momentum -= impulse;
                assert!(impulse.abs() <= mu * mass * 1.3 + 1e-14);
                if block.relative != 0.0 {
                    assert!((impulse - (mu * mass * 1.3).copysign(block.relative)).abs() < 1e-14);
                }
            }
            assert!(momentum.abs() < 1e-14);
        }
    }
}
