//! Newmark's method with stiff elastic-plastic springs for friction, as finite element programs model it.
//!
//! The spring between block and floor has a stiffness of a multiple of the storey's and yields at mu times the contact
//! force: a block slips elastically before it slides, and vibrates on its spring where it should stick. Average
//! acceleration (Newmark 1959), return mapping of all springs, Newton iterations with the consistent tangent (Simo &
//! Hughes, Computational Inelasticity, 1998, section 1.4) for the accelerations at the end of the step.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::history::{History, check_finite};
use super::method::{Error, require};
use crate::machines::model::Model;
use crate::response::Status;
use crate::scene::{Motion, Scene};
use crate::units::STANDARD_GRAVITY;

/// Parameters of the method.
pub(super) struct Newton {
    pub(super) substeps: usize,
    pub(super) stiffness_ratio: f64,
    pub(super) tolerance: f64,
    pub(super) max_iterations: usize,
}

/// Integrates a scene.
pub(super) fn integrate(scene: &Scene, motion: &Motion, newton: &Newton) -> Result<History, Error> {
    let model = Model::new(scene);
    let h = motion.dt() / newton.substeps as f64;
    let samples = motion.acceleration().len();
    let mut history = History::new(samples, scene.storeys(), scene.blocks().len());
    let mut run = FrictionSpringRun::new(scene, &model, newton, h)?;
    let vertical = |i: usize| motion.vertical().map_or(0.0, |samples| samples[i]);
    run.start(motion.acceleration()[0], vertical(0) + STANDARD_GRAVITY);
    history.observe(run.drift.iter().copied(), run.slip.iter().copied());
    history.record(0, run.drift.iter().copied(), run.slip.iter().copied());
    for i in 0..samples - 1 {
        let ground = [motion.acceleration()[i], motion.acceleration()[i + 1]];
        for k in 1..=newton.substeps {
            let s = k as f64 / newton.substeps as f64;
            let time = (i as f64 + s) * motion.dt();
            run.contact = (STANDARD_GRAVITY + vertical(i) + s * (vertical(i + 1) - vertical(i))).max(0.0);
            history.steps += run.step(ground[0] + s * (ground[1] - ground[0]), time)?;
            history.observe(run.drift.iter().copied(), run.slip.iter().copied());
            if let Some(i) = (0..run.drift.len()).find(|&i| run.drift[i].abs() >= model.laws[i].collapse_drift) {
                history.status = Status::Collapsed { storey: i + 1, time };
                return Ok(history);
            }
        }
        check_finite((i + 1) as f64 * motion.dt(), run.drift.iter().copied(), run.slip.iter().copied())?;
        history.record(i + 1, run.drift.iter().copied(), run.slip.iter().copied());
    }
    Ok(history)
}

/// A spring element by return mapping.
#[derive(Debug, Clone, Copy, Default)]
struct Spring {
    stiffness: f64,
    /// Force at the start of the step (N).
    committed: f64,
    /// Force at the end of the step (N).
    force: f64,
    /// Whether it is elastic at the end of the step.
    elastic: bool,
}

impl Spring {
    fn map(&mut self, change: f64, limit: f64) {
        let trial = self.committed + self.stiffness * change;
        self.elastic = trial.abs() <= limit;
        self.force = if self.elastic { trial } else { limit.copysign(trial) };
    }

    fn tangent(&self) -> f64 {
        if self.elastic { self.stiffness } else { 0.0 }
    }
}

/// Degrees of freedom: floors, then blocks, relative to the ground.
struct FrictionSpringRun<'a> {
    model: &'a Model,
    newton: &'a Newton,
    h: f64,
    contact: f64,
    damping: DMatrix<f64>,
    mass: DVector<f64>,
    velocity: DVector<f64>,
    acceleration: DVector<f64>,
    drift: Vec<f64>,
    slip: Vec<f64>,
    elements: Vec<[Spring; 2]>,
    friction: Vec<Spring>,
    /// Displacements over the step, accelerations and velocities at its end.
    change: DVector<f64>,
    next_acceleration: DVector<f64>,
    next_velocity: DVector<f64>,
    residual: DVector<f64>,
    /// Which springs were elastic when the equations were last factorised, and their factors.
    pattern: Vec<bool>,
    factors: Option<LU<f64, Dyn, Dyn>>,
}

impl<'a> FrictionSpringRun<'a> {
    fn new(scene: &Scene, model: &'a Model, newton: &'a Newton, h: f64) -> Result<Self, Error> {
        let (n, blocks) = (model.storeys(), model.blocks.len());
        let mut friction = Vec::with_capacity(blocks);
        require(n > 0, "scene", "one with a building, for the stiffness of friction springs", "none")?;
        for law in &model.blocks {
            require(law.mu_s == law.mu_k, "mu_s", &format!("mu_k = {} for friction springs", law.mu_k), law.mu_s)?;
            let stiffness = newton.stiffness_ratio * model.stiffness[law.floor.saturating_sub(1)];
            friction.push(Spring { stiffness, ..Spring::default() });
        }
        let elements = model.laws.iter().zip(scene.initial_drift()).map(|(law, drift)| {
            let mut both = [Spring::default(); 2];
            for (spring, e) in both.iter_mut().zip(law.spring.elements()) {
                *spring = Spring { stiffness: e.stiffness, committed: e.stiffness * drift, ..Spring::default() };
            }
            both
        });
        let size = n + blocks;
        let mut velocity = DVector::from_column_slice(scene.initial_velocity()).resize_vertically(size, 0.0);
        for (j, block) in scene.blocks().iter().enumerate() {
            let floor = if block.floor > 0 { velocity[block.floor - 1] } else { 0.0 };
            velocity[n + j] = block.velocity.unwrap_or(floor);
        }
        let zero = DVector::zeros(size);
        Ok(Self {
            model,
            newton,
            h,
            contact: STANDARD_GRAVITY,
            damping: scene.building().map_or_else(|| DMatrix::zeros(0, 0), |b| b.damping_matrix()),
            mass: DVector::from_iterator(size, model.mass.iter().copied().chain(model.blocks.iter().map(|b| b.mass))),
            velocity,
            acceleration: zero.clone(),
            drift: scene.initial_drift().to_vec(),
            slip: vec![0.0; blocks],
            elements: elements.collect(),
            friction,
            change: zero.clone(),
            next_acceleration: zero.clone(),
            next_velocity: zero.clone(),
            residual: zero,
            pattern: Vec::new(),
            factors: None,
        })
    }

    /// Accelerations at t = 0.
    fn start(&mut self, ground: f64, contact: f64) {
        self.contact = contact.max(0.0);
        self.next_velocity.copy_from(&self.velocity);
        self.assemble(ground);
        self.acceleration = -self.residual.component_div(&self.mass);
    }

    /// One step to `time`; returns the number of iterations.
    fn step(&mut self, ground: f64, time: f64) -> Result<usize, Error> {
        let h = self.h;
        let mut residual = f64::INFINITY;
        self.next_acceleration.copy_from(&self.acceleration);
        for iteration in 1..=self.newton.max_iterations {
            for p in 0..self.mass.len() {
                let sum = self.acceleration[p] + self.next_acceleration[p];
                self.change[p] = h * self.velocity[p] + 0.25 * h * h * sum;
                self.next_velocity[p] = self.velocity[p] + 0.5 * h * sum;
            }
            let largest = self.assemble(ground);
            let worst = self.residual.amax();
            if worst <= self.newton.tolerance * largest {
                self.commit();
                return Ok(iteration);
            }
            residual = worst / largest;
            self.factorise();
            if !self.factors.as_ref().is_some_and(|lu| lu.solve_mut(&mut self.residual)) {
                return Err(Error::SingularStep { time: time - h });
            }
            self.next_acceleration -= &self.residual;
        }
        Err(Error::NotConverged { time, iterations: self.newton.max_iterations, residual })
    }

    /// Residual forces of the present changes, velocities and accelerations; returns the largest force among them.
    fn assemble(&mut self, ground: f64) -> f64 {
        let n = self.drift.len();
        self.residual.fill(0.0);
        let mut largest = 0.0f64;
        let mut add = |residual: &mut f64, force: f64| {
            *residual += force;
            largest = largest.max(force.abs());
        };
        for p in 0..self.mass.len() {
            add(&mut self.residual[p], self.mass[p] * (self.next_acceleration[p] + ground));
        }
        for i in 0..n {
            let damping: f64 = self.damping.column(i).iter().zip(&self.next_velocity).map(|(c, v)| c * v).sum();
            add(&mut self.residual[i], damping);
            let law = &self.model.laws[i];
            let change = self.change[i] - if i > 0 { self.change[i - 1] } else { 0.0 };
            let linear = law.last_slope() - law.geometric;
            let mut force = linear * (self.drift[i] + change);
            for (e, spring) in self.elements[i].iter_mut().enumerate() {
                spring.map(change, law.spring.elements().get(e).map_or(0.0, |element| element.yield_force));
                force += spring.force;
            }
            add(&mut self.residual[i], force);
            if i > 0 {
                add(&mut self.residual[i - 1], -force);
            }
        }
        for (j, law) in self.model.blocks.iter().enumerate() {
            let below = if law.floor > 0 { self.change[law.floor - 1] } else { 0.0 };
            self.friction[j].map(self.change[n + j] - below, law.mu_k * law.mass * self.contact);
            add(&mut self.residual[n + j], self.friction[j].force);
            if law.floor > 0 {
                add(&mut self.residual[law.floor - 1], -self.friction[j].force);
            }
        }
        largest
    }

    /// Factors of M + h/2 C + h^2/4 K, unless they are those of the last iteration.
    fn factorise(&mut self) {
        let springs = self.elements.iter().flatten().chain(&self.friction);
        if self.factors.is_some() && springs.clone().map(|s| s.elastic).eq(self.pattern.iter().copied()) {
            return;
        }
        self.pattern.clear();
        self.pattern.extend(springs.map(|s| s.elastic));
        let n = self.drift.len();
        let mut equations = DMatrix::from_diagonal(&self.mass);
        let mut damped = equations.view_mut((0, 0), (n, n));
        damped += &self.damping * (0.5 * self.h);
        let factor = 0.25 * self.h * self.h;
        let mut add = |below: Option<usize>, above: usize, tangent: f64| {
            equations[(above, above)] += factor * tangent;
            if let Some(below) = below {
                equations[(below, below)] += factor * tangent;
                equations[(below, above)] -= factor * tangent;
                equations[(above, below)] -= factor * tangent;
            }
        };
        for (i, law) in self.model.laws.iter().enumerate() {
            let linear = law.last_slope() - law.geometric;
            add(i.checked_sub(1), i, linear + self.elements[i].iter().map(Spring::tangent).sum::<f64>());
        }
        for (j, law) in self.model.blocks.iter().enumerate() {
            add(law.floor.checked_sub(1), n + j, self.friction[j].tangent());
        }
        self.factors = Some(equations.lu());
    }

    /// The end of the step becomes the start of the next.
    fn commit(&mut self) {
        let n = self.drift.len();
        for i in 0..n {
            self.drift[i] += self.change[i] - if i > 0 { self.change[i - 1] } else { 0.0 };
        }
        for (j, law) in self.model.blocks.iter().enumerate() {
            self.slip[j] += self.change[n + j] - if law.floor > 0 { self.change[law.floor - 1] } else { 0.0 };
        }
        for spring in self.elements.iter_mut().flatten().chain(&mut self.friction) {
            spring.committed = spring.force;
        }
        self.velocity.copy_from(&self.next_velocity);
        self.acceleration.copy_from(&self.next_acceleration);
    }
}
