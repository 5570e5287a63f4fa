//! Scenes with racks, walls and stops in one direction.

use seismass::{
    Event, GeneralPeaks, GeneralResponse, GeneralScene, Goods, Motion, Options, Peak, Rack, Result, simulate_general,
};

use super::changed::{Factors, changed_motion};
use super::invariants;
use super::subject::{Subject, Summary};
use crate::general::{Budget, GeneralSolution, Scale, divided, solution_of, solve_scaled};
use crate::general_scene::general_scene;
use crate::{Comparison, JudgeError, Real};

impl Subject for (GeneralScene, Motion) {
    type Response = GeneralResponse;
    type Solution = GeneralSolution;

    fn draw(seed: u64) -> Result<Self> {
        general_scene(seed)
    }

    fn simulate(&self, options: &Options) -> Result<GeneralResponse> {
        simulate_general(&self.0, &self.1, options)
    }

    fn solve<R: Real>(&self, scale: Scale<R>, budget: &Budget) -> std::result::Result<GeneralSolution, JudgeError> {
        solve_scaled(&self.0, &self.1, 1, scale, budget)
    }

    fn divided(&self, parts: usize) -> Result<Self> {
        Ok((self.0.clone(), divided(&self.1, parts)?))
    }

    fn changed(&self, digits: f64, trial: u64) -> Option<Self> {
        let (motion, factors) = changed_motion(&self.1, digits, trial)?;
        Some((factors.map_or(Some(self.0.clone()), |factors: Factors| factors.scene(&self.0))?, motion))
    }

    fn image(&self) -> Result<Self> {
        Ok((mirrored(&self.0)?, opposite(&self.1)?))
    }

    const ACCELERATIONS: &'static [usize] = &[1, 9];

    fn peaks(response: &GeneralResponse, _of_image: bool) -> Vec<Vec<Peak>> {
        let mut lists = of_peaks(&response.peaks);
        lists.push(without_times(&response.slip_path));
        let base = response.base.as_ref();
        lists.extend([base.map_or(Vec::new(), |b| vec![b.slip]), base.map_or(Vec::new(), |b| vec![b.acceleration])]);
        lists.push(base.map_or(Vec::new(), |b| without_times(&[b.slip_path])));
        lists
    }

    fn check(&self, response: &GeneralResponse) -> std::result::Result<(), String> {
        invariants::check(&self.0, &self.1, response)
    }

    fn summary(response: &GeneralResponse) -> Summary {
        let residual = response.energy.map_or(f64::NAN, |energy| energy.relative_residual.abs());
        Summary { status: response.status, events: response.statistics.events, residual }
    }

    fn same_bits(one: &GeneralResponse, other: &GeneralResponse) -> bool {
        let base = |of: &GeneralResponse| {
            of.base.as_ref().map(|base| (base.slip, base.acceleration, base.residual_slip, base.slip_path))
        };
        (&other.peaks, &other.residual_drift, &other.residual_slip, &other.slip_path, other.status, base(other))
            == (&one.peaks, &one.residual_drift, &one.residual_slip, &one.slip_path, one.status, base(one))
    }

    fn as_solution(response: &GeneralResponse) -> Option<GeneralSolution> {
        solution_of(response)
    }

    fn compare(found: &GeneralSolution, exact: &GeneralSolution) -> Comparison {
        exact.judge(found)
    }

    fn directions(solution: &GeneralSolution) -> Vec<&GeneralSolution> {
        vec![solution]
    }

    fn directions_mut(solution: &mut GeneralSolution) -> Vec<&mut GeneralSolution> {
        vec![solution]
    }

    fn logs(solution: &GeneralSolution) -> Vec<Vec<Event>> {
        vec![solution.events.iter().map(|entry| entry.event).collect()]
    }
}

/// Numbers as peaks.
pub(super) fn without_times(values: &[f64]) -> Vec<Peak> {
    values.iter().map(|&value| Peak { value, time: 0.0 }).collect()
}

/// Peaks by kind.
pub(super) fn of_peaks(peaks: &GeneralPeaks) -> Vec<Vec<Peak>> {
    let GeneralPeaks { drift, acceleration, shear, base_shear, slip, contact_force, contact_velocity } = peaks;
    [&drift[..], acceleration, shear, &[*base_shear], slip, contact_force, contact_velocity]
        .map(<[Peak]>::to_vec)
        .to_vec()
}

/// The image of a scene: what it had on the positive side is on the negative one.
pub(super) fn mirrored(scene: &GeneralScene) -> Result<GeneralScene> {
    let goods = |goods: &Goods| {
        let mut goods = goods.clone();
        goods.block.velocity = goods.block.velocity.map(|v| -v);
        if let Some(stops) = &mut goods.stops {
            stops.clearance.reverse();
        }
        goods
    };
    let of_rack = |rack: &Rack| Rack { goods: rack.goods.iter().map(goods).collect(), ..rack.clone() };
    let negative = |values: &[f64]| values.iter().map(|v| -v).collect();
    let (on_floors, racks) = (scene.goods().iter().map(goods).collect(), scene.racks().iter().map(of_rack).collect());
    let mut image = GeneralScene::on_base(scene.building().cloned(), on_floors, racks, scene.base().copied())?;
    if scene.building().is_some() {
        image = image.with_initial(negative(scene.initial_drift()), negative(scene.initial_velocity()))?;
    }
    match scene.collapse_drift() {
        Some(drift) => image.with_collapse_drift(drift.to_vec()),
        None => Ok(image),
    }
}

/// A motion the other way.
pub(super) fn opposite(motion: &Motion) -> Result<Motion> {
    let samples: Vec<f64> = motion.acceleration().iter().map(|a| -a).collect();
    Motion::new(samples, motion.dt(), motion.vertical().map(|v| v.to_vec().into()))
}
