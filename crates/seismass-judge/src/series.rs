//! The Taylor series of everything over a stretch of time in one regime, as polynomials on [0, 1].

use crate::model::{Model, Terms};
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::springs::{Course, Part};
use crate::state::{Contact, Drive, State};

/// The length of a stretch times the norm of the system is at most this.
pub(crate) const MAX_PHASE: f64 = 0.5;

/// The solution over `length`, which starts at the state it was made from.
pub(crate) struct Series<R> {
    pub(crate) length: R,
    pub(crate) ground: Polynomial<R>,
    /// g + a_v.
    pub(crate) contact: Polynomial<R>,
    pub(crate) drift: Vec<Polynomial<R>>,
    pub(crate) rate: Vec<Polynomial<R>>,
    /// Forces of the parts of each storey's spring.
    pub(crate) force: Vec<Vec<Polynomial<R>>>,
    /// Absolute acceleration of the ground (index 0) and of each floor.
    pub(crate) acceleration: Vec<Polynomial<R>>,
    /// Velocity of each block relative to its floor.
    pub(crate) velocity: Vec<Polynomial<R>>,
    pub(crate) slip: Vec<Polynomial<R>>,
}

/// The order K from which `phase`^K / K! is below the rounding of the number type.
pub(crate) fn orders<R: Real>(phase: f64) -> usize {
    let mut term = 1.0;
    let mut order = 0;
    while term > 0.01 * R::EPSILON {
        order += 1;
        term *= phase / order as f64;
    }
    order
}

/// Appends the coefficients of the integral of `rate` over a stretch of `length`, as far as those of `rate` are known.
pub(crate) fn integrate<R: Real>(rate: &Polynomial<R>, factor: R, length: R, integral: &mut Polynomial<R>) {
    for order in integral.0.len()..=rate.0.len() {
        integral.0.push(factor * rate.0[order - 1] * length / R::of(order as f64));
    }
}

impl<R: Real> Series<R> {
    /// c_(k+1) = (A c_k + load_k) / (k + 1), from the state at `tau` over `length`.
    pub(crate) fn new(model: &Model<R>, state: &State<R>, drive: &Drive<R>, tau: R, length: R) -> Self {
        let starts = |values: &[R]| values.iter().map(|&v| Polynomial::constant(v)).collect::<Vec<_>>();
        let n = model.mass.len();
        let ground = Polynomial(vec![drive.ground_at(tau), drive.ground[1] * length]);
        let contact = Polynomial(vec![drive.contact_at(tau), drive.contact[1] * length]);
        let mut mass = model.mass.clone();
        // Friction on each floor, per unit of g + a_v.
        let mut friction = vec![R::zero(); n];
        for (block, data) in state.blocks.iter().zip(&model.blocks).filter(|(_, data)| data.floor > 0) {
            let floor = data.floor - 1;
            match block.contact {
                Contact::Stuck => mass[floor] = mass[floor] + data.mass,
                Contact::Sliding(sign) => friction[floor] = friction[floor] + sign.times(block.mu_k * data.mass),
                Contact::Airborne => {}
            }
        }
        let parts: Vec<Vec<Part<R>>> = state.springs.iter().map(|spring| spring.parts()).collect();
        let mut series = Self {
            length,
            drift: starts(&state.drift),
            rate: starts(&state.rate),
            force: parts.iter().map(|s| starts(&s.iter().map(|part| part.force).collect::<Vec<_>>())).collect(),
            acceleration: vec![Polynomial(Vec::new()); n + 1],
            velocity: Vec::new(),
            slip: Vec::new(),
            ground,
            contact,
        };
        let one = R::of(1.0);
        for order in 0..orders::<R>(MAX_PHASE) {
            let term = |p: &Polynomial<R>| p.0.get(order).copied().unwrap_or(R::zero());
            let spring = |i: usize| {
                let parts = series.force[i].iter().fold(R::zero(), |sum, part| sum + term(part));
                parts + state.springs[i].linear() * term(&series.drift[i])
            };
            let springs: Vec<R> = (0..n).map(spring).collect();
            let drift: Vec<R> = series.drift.iter().map(term).collect();
            let rate: Vec<R> = series.rate.iter().map(term).collect();
            let pull = model.pull(&springs, &drift, &rate, Terms::Signed);
            let (ground, contact) = (term(&series.ground), term(&series.contact));
            series.acceleration[0].0.push(ground);
            for i in 0..n {
                series.acceleration[i + 1].0.push((pull[i] + friction[i] * contact) / mass[i]);
            }
            for i in 0..n {
                let difference = series.acceleration[i + 1].0[order] - series.acceleration[i].0[order];
                series.rate[i].0.push(length * difference / R::of((order + 1) as f64));
                integrate(&series.rate[i], one, length, &mut series.drift[i]);
                for (force, part) in series.force[i].iter_mut().zip(&parts[i]).filter(|(_, p)| p.tangent != R::zero()) {
                    integrate(&series.rate[i], part.tangent, length, force);
                }
            }
        }
        for (block, data) in state.blocks.iter().zip(&model.blocks) {
            let mut velocity = Polynomial::constant(block.velocity);
            let mut slip = Polynomial::constant(block.slip);
            if block.contact != Contact::Stuck {
                let floor = &series.acceleration[data.floor];
                let relative = match block.contact {
                    Contact::Sliding(sign) => floor.plus(&series.contact.scaled(sign.times(block.mu_k))),
                    _ => floor.clone(),
                };
                integrate(&relative, -one, length, &mut velocity);
                integrate(&velocity, one, length, &mut slip);
            }
            series.velocity.push(velocity);
            series.slip.push(slip);
        }
        series
    }

    /// Restricts the stretch to its first part, of this fraction.
    pub(crate) fn shrink(&mut self, place: R) {
        self.length = self.length * place;
        let Self { ground, contact, drift, rate, force, acceleration, velocity, slip, .. } = self;
        let lists = [drift, rate, acceleration, velocity, slip].into_iter().flatten();
        for polynomial in lists.chain(force.iter_mut().flatten()).chain([ground, contact]) {
            polynomial.shrink(place);
        }
    }

    /// Moves the state to the end of the stretch.
    pub(crate) fn advance(&self, state: &mut State<R>) {
        for i in 0..state.drift.len() {
            state.springs[i].advance(&self.course(i));
            state.drift[i] = self.drift[i].end();
            state.rate[i] = self.rate[i].end();
        }
        for (j, block) in state.blocks.iter_mut().enumerate() {
            block.velocity = self.velocity[j].end();
            block.slip = self.slip[j].end();
            if let Contact::Sliding(sign) = block.contact {
                block.path = block.path + sign.times(self.slipped(j).end());
            }
            block.moved |= self.length > R::zero();
        }
    }

    /// What a storey's spring sees.
    pub(crate) fn course(&self, storey: usize) -> Course<'_, R> {
        let (drift, rate, forces) = (&self.drift[storey], &self.rate[storey], &self.force[storey]);
        Course { length: self.length, drift, rate, forces }
    }

    /// Change of a block's slip since the beginning of the stretch, not as a difference of slips.
    pub(crate) fn slipped(&self, block: usize) -> Polynomial<R> {
        let mut slipped = self.slip[block].clone();
        slipped.0[0] = R::zero();
        slipped
    }

    /// Size of the terms of each floor's acceleration over the stretch (index 0: the ground): the measure of its rounding.
    pub(crate) fn acceleration_sizes(&self, model: &Model<R>, state: &State<R>) -> Vec<R> {
        let sizes = |list: &[Polynomial<R>]| list.iter().map(Polynomial::size).collect::<Vec<R>>();
        let spring = |i: usize| {
            let parts = self.force[i].iter().fold(R::zero(), |sum, part| sum + part.size());
            parts + state.springs[i].linear() * self.drift[i].size()
        };
        let springs: Vec<R> = (0..model.storeys.len()).map(spring).collect();
        let pull = model.pull(&springs, &sizes(&self.drift), &sizes(&self.rate), Terms::Sizes);
        let contact = self.contact.size();
        let mut sizes = vec![self.ground.size()];
        for (floor, &pull) in pull.iter().enumerate() {
            let (mut force, mut mass) = (pull, model.mass[floor]);
            for (block, data) in state.blocks.iter().zip(&model.blocks).filter(|(_, data)| data.floor == floor + 1) {
                match block.contact {
                    Contact::Stuck => mass = mass + data.mass,
                    _ => force = force + block.mu_k * data.mass * contact,
                }
            }
            sizes.push(force / mass);
        }
        sizes
    }
}
