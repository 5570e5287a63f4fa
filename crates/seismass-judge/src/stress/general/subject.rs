//! What the suite asks of a scene with its motion, in one direction or in two.

use seismass::{Event, EventCounts, GeneralStatus, Options, Peak, Result};

use super::before_stops::BeforeStops;
use crate::general::{Budget, GeneralSolution, Scale};
use crate::{Comparison, JudgeError, Real};

/// What is counted of a response.
pub(super) struct Summary {
    pub(super) status: GeneralStatus,
    pub(super) events: EventCounts,
    /// The largest energy residual, relative; NaN where there are no energies.
    pub(super) residual: f64,
}

/// A scene with its motion.
pub(super) trait Subject: Sized {
    type Response;
    type Solution: Clone;

    /// That of a seed.
    fn draw(seed: u64) -> Result<Self>;

    /// Solved by the engine.
    fn simulate(&self, options: &Options) -> Result<Self::Response>;

    /// Solved by the judge, under the motion times factors and within a budget.
    fn solve<R: Real>(&self, scale: Scale<R>, budget: &Budget) -> std::result::Result<Self::Solution, JudgeError>;

    /// With every sample interval in so many parts.
    fn divided(&self, parts: usize) -> Result<Self>;

    /// With every number changed by up to so many last digits.
    fn changed(&self, digits: f64, trial: u64) -> Option<Self>;

    /// Its image in a mirror, or turned by a right angle: peaks and paths of the response are the same, in places given by
    /// `peaks`.
    fn image(&self) -> Result<Self>;

    /// Peaks by kind, and paths: those of the image of a scene in the order of the scene.
    fn peaks(response: &Self::Response, of_image: bool) -> Vec<Vec<Peak>>;

    /// Which of them are of the accelerations of nodes.
    const ACCELERATIONS: &'static [usize];

    /// The stops of blocks before which friction turns; none in one direction.
    fn before_stops(&self, _response: &Self::Response) -> BeforeStops {
        BeforeStops::default()
    }

    /// A solution with the peak accelerations of another where the two part before stops alone.
    fn with_accelerations_of(found: &Self::Solution, _exact: &Self::Solution, _stops: &BeforeStops) -> Self::Solution {
        found.clone()
    }

    /// What must hold for a response by itself.
    fn check(&self, response: &Self::Response) -> std::result::Result<(), String>;

    fn summary(response: &Self::Response) -> Summary;

    /// Whether peaks, residuals, paths and endings have the same bits.
    fn same_bits(one: &Self::Response, other: &Self::Response) -> bool;

    /// A response with events, histories and energies as a solution.
    fn as_solution(response: &Self::Response) -> Option<Self::Solution>;

    /// Compares a solution with one that is taken as exact.
    fn compare(found: &Self::Solution, exact: &Self::Solution) -> Comparison;

    /// What a solution is in each direction.
    fn directions(solution: &Self::Solution) -> Vec<&GeneralSolution>;

    /// The same, to be changed.
    fn directions_mut(solution: &mut Self::Solution) -> Vec<&mut GeneralSolution>;

    /// The logs of a solution, one per direction and one of vectors.
    fn logs(solution: &Self::Solution) -> Vec<Vec<Event>>;
}
