//! The slab of a sliding base, in the place of the ground under all that has no node (`numerics`, section 9.6).

use seismass::{EventKind, GeneralScene, Motion, STANDARD_GRAVITY, SlidingBase};

use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::{BlockState, Contact};

/// The constant data of a slab.
#[derive(Debug)]
pub(crate) struct BaseData<R> {
    pub(super) mass: R,
    /// Mass of the slab and of all that it carries: the contact force per unit of g + a_v.
    pub(super) carried: R,
    /// Restoring stiffness per unit of g + a_v.
    pub(super) restoring: R,
    pub(super) mu: [R; 2],
    /// No restoring stiffness of a run, in the terms of its series, is above this.
    pub(super) most_stiffness: R,
}

impl<R: Real> BaseData<R> {
    pub(super) fn new(base: &SlidingBase, scene: &GeneralScene) -> Self {
        let of_nodes = scene.building().map_or(&[][..], |building| building.mass()).iter();
        let all = of_nodes.chain(scene.racks().iter().flat_map(|rack| &rack.mass)).copied();
        let all = all.chain(scene.all_goods().map(|goods| goods.block.mass));
        let carried = all.fold(R::of(base.mass), |sum, m| sum + R::of(m));
        let restoring = if base.radius.is_finite() { carried / R::of(base.radius) } else { R::zero() };
        let mu = [base.mu_s, base.mu_k].map(R::of);
        Self { mass: R::of(base.mass), carried, restoring, mu, most_stiffness: R::zero() }
    }

    /// |c_0| + |c_1| of g + a_v in any stretch is at most g plus three times the largest a_v.
    pub(super) fn bound(&mut self, motion: &Motion) {
        let vertical = motion.vertical().unwrap_or(&[]).iter().fold(0.0f64, |most, a| most.max(a.abs()));
        self.most_stiffness = self.restoring * R::of(STANDARD_GRAVITY + 3.0 * vertical);
    }

    pub(super) fn at_rest(&self) -> BlockState<R> {
        let (zero, [mu_s, mu_k]) = (R::zero(), self.mu);
        BlockState {
            contact: Contact::Stuck,
            velocity: zero,
            slip: zero,
            moved: true,
            path: zero,
            stage: 0,
            mu_s,
            mu_k,
        }
    }
}

/// The series of a slab.
pub(super) struct BaseSeries<R> {
    pub(super) velocity: Polynomial<R>,
    pub(super) slip: Polynomial<R>,
    /// Force of the ground that holds it, where it sticks.
    pub(super) holding: Polynomial<R>,
}

impl<R: Real> BaseSeries<R> {
    pub(super) fn at_start(base: &BlockState<R>) -> Self {
        let [velocity, slip] = [base.velocity, base.slip].map(Polynomial::constant);
        Self { velocity, slip, holding: Polynomial(Vec::new()) }
    }

    pub(super) fn polynomials(&mut self) -> [&mut Polynomial<R>; 3] {
        [&mut self.velocity, &mut self.slip, &mut self.holding]
    }
}

/// What lifts or lands with this velocity does then.
pub(super) fn contact_after<R: Real>(kind: EventKind, velocity: R) -> Contact {
    match kind {
        EventKind::Lift => Contact::Airborne,
        _ if velocity == R::zero() => Contact::Stuck,
        _ => Contact::Sliding(Sign::of(velocity)),
    }
}
