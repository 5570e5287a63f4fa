//! Scenes in two directions.

use seismass::{Event, Motion, Options, Peak, PlaneMotion, PlaneResponse, PlaneScene, Result, simulate_plane};

use super::before_stops::BeforeStops;
use super::changed::{Factors, changed_motion};
use super::one_direction::{mirrored, of_peaks, opposite, without_times};
use super::plane_invariants;
use super::subject::{Subject, Summary};
use crate::general::{
    Budget, GeneralSolution, PlaneSolution, Scale, divided_plane, plane_solution_of, solve_plane_scaled,
};
use crate::plane_scene::plane_scene;
use crate::{Comparison, JudgeError, Real, larger};

impl Subject for (PlaneScene, PlaneMotion) {
    type Response = PlaneResponse;
    type Solution = PlaneSolution;

    fn draw(seed: u64) -> Result<Self> {
        plane_scene(seed)
    }

    fn simulate(&self, options: &Options) -> Result<PlaneResponse> {
        simulate_plane(&self.0, &self.1, options)
    }

    fn solve<R: Real>(&self, scale: Scale<R>, budget: &Budget) -> std::result::Result<PlaneSolution, JudgeError> {
        solve_plane_scaled(&self.0, &self.1, 1, scale, budget)
    }

    fn divided(&self, parts: usize) -> Result<Self> {
        Ok((self.0.clone(), divided_plane(&self.1, parts)?))
    }

    fn changed(&self, digits: f64, trial: u64) -> Option<Self> {
        let [x, y] = self.1.directions();
        let (of_x, factors) = changed_motion(x, digits, trial)?;
        let (of_y, _) = changed_motion(y, digits, trial)?;
        let [x, y] = self.0.directions();
        let scene = match factors {
            None => self.0.clone(),
            Some(factors) => {
                let factors: Factors = factors;
                PlaneScene::new(factors.scene(x)?, factors.scene(y)?).ok()?
            }
        };
        Some((scene, PlaneMotion::new(of_x, of_y.acceleration()).ok()?))
    }

    /// Turned by a right angle: what was along x is along y, and what was along y against x.
    fn image(&self) -> Result<Self> {
        let [x, y] = self.0.directions();
        let [of_x, of_y] = self.1.directions();
        let scene = PlaneScene::new(mirrored(y)?, x.clone())?;
        let samples: &[f64] = of_x.acceleration();
        let turned: Motion = opposite(of_y)?;
        Ok((scene, PlaneMotion::new(turned, samples)?))
    }

    /// The second of the seven kinds of each direction, and of those of the vector after them.
    const ACCELERATIONS: &'static [usize] = &[1, 8, 15];

    fn peaks(response: &PlaneResponse, of_image: bool) -> Vec<Vec<Peak>> {
        let [x, y] = &response.peaks.directions;
        let vector = &response.peaks.vector;
        let mut lists = if of_image { [of_peaks(y), of_peaks(x)] } else { [of_peaks(x), of_peaks(y)] }.concat();
        lists.extend([&vector.drift, &vector.acceleration, &vector.shear, &vector.slip].map(Clone::clone));
        lists.extend([vec![vector.base_shear], without_times(&response.slip_path)]);
        lists
    }

    fn before_stops(&self, response: &PlaneResponse) -> BeforeStops {
        let vertical = self.1.directions()[0].vertical().unwrap_or_default();
        BeforeStops::new(&self.0, vertical, response.events.as_deref().unwrap_or_default())
    }

    fn with_accelerations_of(found: &PlaneSolution, exact: &PlaneSolution, stops: &BeforeStops) -> PlaneSolution {
        let mut found = found.clone();
        let parted = |own: &mut [Peak], other: &[Peak]| {
            for (node, (own, other)) in own.iter_mut().zip(other).enumerate() {
                if stops.part(node, *own, *other) {
                    *own = *other;
                }
            }
        };
        for (own, other) in found.directions.iter_mut().zip(&exact.directions) {
            parted(&mut own.peaks.acceleration, &other.peaks.acceleration);
        }
        parted(&mut found.vector.acceleration, &exact.vector.acceleration);
        found
    }

    fn check(&self, response: &PlaneResponse) -> std::result::Result<(), String> {
        plane_invariants::check(&self.0, &self.1, response)
    }

    fn summary(response: &PlaneResponse) -> Summary {
        let residual = response.energy.map_or(f64::NAN, |energy| {
            let of_vector = energy.total.relative_residual.abs();
            // That of a direction in which hardly anything moves is of no weight.
            let total = energy.total.initial.abs() + energy.total.input.abs();
            energy.directions.iter().fold(of_vector, |worst, of| {
                let share = (of.initial.abs() + of.input.abs()) / total;
                if share > LEAST_SHARE { larger(worst, of.relative_residual.abs()) } else { worst }
            })
        });
        Summary { status: response.status, events: response.statistics.events, residual }
    }

    fn same_bits(one: &PlaneResponse, other: &PlaneResponse) -> bool {
        (&other.peaks, &other.residual_drift, &other.residual_slip, &other.slip_path, other.status)
            == (&one.peaks, &one.residual_drift, &one.residual_slip, &one.slip_path, one.status)
    }

    fn as_solution(response: &PlaneResponse) -> Option<PlaneSolution> {
        plane_solution_of(response)
    }

    fn compare(found: &PlaneSolution, exact: &PlaneSolution) -> Comparison {
        exact.judge(found)
    }

    fn directions(solution: &PlaneSolution) -> Vec<&GeneralSolution> {
        solution.directions.iter().collect()
    }

    fn directions_mut(solution: &mut PlaneSolution) -> Vec<&mut GeneralSolution> {
        solution.directions.iter_mut().collect()
    }

    fn logs(solution: &PlaneSolution) -> Vec<Vec<Event>> {
        let directions = solution.directions.iter();
        let mut logs: Vec<Vec<Event>> =
            directions.map(|of| of.events.iter().map(|entry| entry.event).collect()).collect();
        logs.push(solution.events.iter().map(|entry| entry.event.event).collect());
        logs
    }
}

/// A direction whose energies are a smaller part of all is not judged by their balance.
const LEAST_SHARE: f64 = 1e-6;
