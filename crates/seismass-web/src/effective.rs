//! The effective fraction of the live load over a suite: the smallest share of the goods which, attached as mass, gives a
//! mean largest drift not below that of the building with sliding goods, there and at every larger share up to 1.
//!
//! The definition is that of `seismass.effective_mass`, with the mean over the motions and the damping matrix of the real
//! building; drifts are compared over the storey heights. Models are solved share by share, so that a page can show how far
//! it is and stop.

use seismass::{Control, Domain, Error, Motion, Options, Response, Result, Run, Scene, Status, simulate_each};

use crate::case::Case;
use crate::curve::{Kind, interpolated, interpolated_roots, is_below, refined_root};
use crate::scatter::{Resamples, percentiles};
use crate::sections::sections;

/// Intervals between the shares 0 and 1 at which models are solved.
const INTERVALS: usize = 20;
/// Ends of the interval of 90 %.
const ENDS: [f64; 2] = [0.05, 0.95];

/// What is kept of a scene under each motion of the suite.
#[derive(Debug, Clone)]
struct Peaks {
    /// Peak drift (m), motion by motion.
    drift: Vec<Vec<f64>>,
    /// Largest drift of each motion over the storey height.
    largest: Vec<f64>,
    /// Peak base shear of each motion (N).
    base_shear: Vec<f64>,
    /// Whether goods slid, by motion.
    slides: Vec<bool>,
}

impl Peaks {
    /// Solves a scene of a case.
    fn new(case: &Case, scene: Scene, motions: &[Motion]) -> Result<Self> {
        let runs: Vec<Run> = (0..motions.len()).map(|motion| Run::new(0, motion)).collect();
        let options = Options::PEAKS;
        let scene_slides = !scene.blocks().is_empty();
        let keep = |response: Response| match response.status {
            Status::Completed => Some(response.peaks),
            Status::Collapsed { .. } => None,
        };
        let found = simulate_each(&[scene], motions, &runs, &options, None, &Control::default(), keep)?;
        let found = found.into_iter().collect::<Result<Vec<_>>>()?;
        let collapsed = found.iter().filter(|peaks| peaks.is_none()).count();
        if collapsed > 0 {
            let what = if scene_slides { "building with sliding goods" } else { "building with goods attached" };
            let got = format!("a collapse under {collapsed} of {} motions", found.len());
            return Err(Error::invalid(Domain::Scene, "drift", what, "finite", got));
        }
        let peaks: Vec<_> = found.into_iter().flatten().collect();
        let drift: Vec<Vec<f64>> =
            peaks.iter().map(|peaks| peaks.drift.iter().map(|peak| peak.value).collect()).collect();
        Ok(Self {
            largest: drift.iter().map(|drift| largest_ratio(drift, case.heights())).collect(),
            drift,
            base_shear: peaks.iter().map(|peaks| peaks.storey_shear.first().map_or(0.0, |peak| peak.value)).collect(),
            slides: peaks.iter().map(|peaks| peaks.slip.iter().any(|peak| peak.value > 0.0)).collect(),
        })
    }

    /// Mean drift of each storey (m).
    fn by_storey(&self) -> Vec<f64> {
        let storeys = self.drift.first().map_or(0, Vec::len);
        (0..storeys).map(|i| mean(&self.drift.iter().map(|drift| drift[i]).collect::<Vec<f64>>())).collect()
    }
}

fn largest_ratio(drift: &[f64], heights: &[f64]) -> f64 {
    drift.iter().zip(heights).map(|(drift, height)| drift / height).fold(0.0, f64::max)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// A search that is under way.
#[derive(Debug)]
pub(crate) struct Search {
    case: Case,
    motions: Vec<Motion>,
    real: Peaks,
    /// The fully attached model.
    full: Peaks,
    /// Models by share, from 0.
    models: Vec<Peaks>,
}

impl Search {
    /// Solves the real building and the fully attached model.
    pub(crate) fn new(case: Case, motions: Vec<Motion>) -> Result<Self> {
        let refuse = |parameter: &str, requirement: &str| {
            Err(Error::invalid(Domain::Scene, parameter, "effective mass", requirement, "none"))
        };
        if motions.is_empty() {
            return refuse("motions", "at least one");
        }
        if case.goods().iter().all(|&mass| mass == 0.0) {
            return refuse("goods", "on at least one floor of the building, as there is no live load otherwise");
        }
        let real = Peaks::new(&case, case.real()?, &motions)?;
        let full = Peaks::new(&case, case.attached(1.0)?, &motions)?;
        Ok(Self { case, motions, real, full, models: Vec::with_capacity(INTERVALS + 1) })
    }

    /// The mean peak base shear of the fully attached model over the full weight, and mu_k over it.
    pub(crate) fn base_shear(&self) -> [f64; 2] {
        let coefficient = mean(&self.full.base_shear) / self.case.full_weight();
        [coefficient, self.case.friction() / coefficient]
    }

    /// Solves the models of the next `count` shares; returns how many are left.
    pub(crate) fn solve(&mut self, count: usize) -> Result<usize> {
        let end = (self.models.len() + count).min(INTERVALS + 1);
        while self.models.len() < end {
            let place = self.models.len();
            let model =
                if place == INTERVALS { self.full.clone() } else { self.model(place as f64 / INTERVALS as f64)? };
            self.models.push(model);
        }
        Ok(INTERVALS + 1 - end)
    }

    fn model(&self, share: f64) -> Result<Peaks> {
        Peaks::new(&self.case, self.case.attached(share)?, &self.motions)
    }

    /// What was found, once all shares are solved: kind, value, ends of the interval, mean largest drift of the real
    /// building and of the model at the value, over the height, mean peak base shear and mu_k over it; all roots; shares;
    /// mean largest drift of the model at them; ends of
    /// the interval of real over model there; mean drifts by storey of the real building, of the model at the value, at
    /// 0 and at 1; of each motion whether goods slide, the real drift, and its first and last root (NaN: none).
    pub(crate) fn answer(&self, resamples: &Resamples) -> Result<Vec<f64>> {
        if self.models.len() <= INTERVALS {
            let got = format!("{}", self.models.len());
            return Err(Error::invalid(Domain::Options, "shares", "effective mass", "all solved", got));
        }
        let shares: Vec<f64> = (0..=INTERVALS).map(|place| place as f64 / INTERVALS as f64).collect();
        let model: Vec<f64> = self.models.iter().map(|peaks| mean(&peaks.largest)).collect();
        let real = mean(&self.real.largest);
        let below: Vec<bool> = model.iter().map(|&model| is_below(model, real)).collect();
        let kind = if !self.real.slides.contains(&true) {
            Kind::Stuck
        } else if self.case.is_without_friction() {
            Kind::Zero
        } else {
            Kind::of(&below)
        };
        let brackets = (0..INTERVALS).filter(|&k| kind != Kind::Stuck && below[k] != below[k + 1]);
        let roots = brackets.map(|k| self.root(k, real)).collect::<Result<Vec<f64>>>()?;
        let value = match kind {
            Kind::Zero => 0.0,
            Kind::Root | Kind::Multiple => roots.last().copied().unwrap_or(1.0),
            Kind::Stuck | Kind::One => 1.0,
        };
        let at_value = match shares.iter().position(|&share| share == value) {
            Some(place) => self.models[place].clone(),
            None => self.model(value)?,
        };
        let (interval, band) = self.scatter(kind, &shares, resamples);
        let mut head = vec![f64::from(kind as u8), value, interval[0], interval[1], real, mean(&at_value.largest)];
        head.extend(self.base_shear());
        let slides: Vec<f64> = self.real.slides.iter().map(|&slides| f64::from(u8::from(slides))).collect();
        let (first, last) = self.own_roots(&shares);
        let [bare, full] = [0, INTERVALS].map(|place| self.models[place].by_storey());
        Ok(sections(&[
            &head,
            &roots,
            &shares,
            &model,
            &band[0],
            &band[1],
            &self.real.by_storey(),
            &at_value.by_storey(),
            &bare,
            &full,
            &slides,
            &self.real.largest,
            &first,
            &last,
        ]))
    }

    /// The root between two shares of the grid.
    fn root(&self, k: usize, real: f64) -> Result<f64> {
        let ends = [k, k + 1].map(|place| place as f64 / INTERVALS as f64);
        let difference = |share: f64| {
            let known = [k, k + 1].into_iter().find(|&place| share == place as f64 / INTERVALS as f64);
            let model = known
                .map_or_else(|| Ok(mean(&self.model(share)?.largest)), |place| Ok(mean(&self.models[place].largest)))?;
            Ok((model - real) / real)
        };
        refined_root(difference, (ends[0], ends[1]))
    }

    /// Bootstrap interval of the value, and of real over model at each share; NaN without resamples.
    fn scatter(&self, kind: Kind, shares: &[f64], resamples: &Resamples) -> ([f64; 2], [Vec<f64>; 2]) {
        if !resamples.are_of(self.motions.len()) {
            return ([f64::NAN; 2], [(); 2].map(|()| vec![f64::NAN; shares.len()]));
        }
        let real = resamples.means(&self.real.largest);
        let models: Vec<Vec<f64>> = self.models.iter().map(|peaks| resamples.means(&peaks.largest)).collect();
        let interval = match kind {
            Kind::Stuck => [1.0; 2],
            _ if self.case.is_without_friction() => [0.0; 2],
            _ => {
                let value = |(draw, &real): (usize, &f64)| {
                    let model: Vec<f64> = models.iter().map(|model| model[draw]).collect();
                    interpolated(shares, &model, real)
                };
                percentiles(real.iter().enumerate().map(value).collect(), ENDS)
            }
        };
        let ends = models.iter().map(|model| {
            let ratios = real.iter().zip(model).map(|(real, model)| real / model).collect();
            percentiles(ratios, ENDS)
        });
        let ends: Vec<[f64; 2]> = ends.collect();
        (interval, [0, 1].map(|end| ends.iter().map(|both| both[end]).collect()))
    }

    /// First and last root of each motion on its own; NaN where there is none, or where its goods do not slide.
    fn own_roots(&self, shares: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let of_motion = |motion: usize| {
            let model: Vec<f64> = self.models.iter().map(|peaks| peaks.largest[motion]).collect();
            let slides = self.real.slides[motion];
            let roots = if slides { interpolated_roots(shares, &model, self.real.largest[motion]) } else { Vec::new() };
            (roots.first().copied().unwrap_or(f64::NAN), roots.last().copied().unwrap_or(f64::NAN))
        };
        (0..self.motions.len()).map(of_motion).unzip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Below the period of the motion, 0.52 s, so that mass brings the model nearer to it.
    fn case(mu: f64) -> Case {
        Case::new(&[1.0, 0.25, 0.05, 0.0, f64::INFINITY, 1.0, mu, mu, 1.0, 1.0, 3.0, 2.0, 0.05, 0.0]).unwrap()
    }

    fn motion() -> Motion {
        let samples: Vec<f64> = (0..500).map(|i| 4.0 * (0.12 * f64::from(i)).sin()).collect();
        Motion::new(samples, 0.01, None).unwrap()
    }

    fn answer(mu: f64) -> Vec<f64> {
        let mut search = Search::new(case(mu), vec![motion()]).unwrap();
        assert_eq!(search.solve(15).unwrap(), 6);
        assert!(search.answer(&Resamples::default()).is_err());
        assert_eq!(search.solve(100).unwrap(), 0);
        let found = search.answer(&Resamples::new(1, &[1.0])).unwrap();
        found[1 + found[0] as usize..][..8].to_vec()
    }

    /// Goods that stick are mass: the fully attached model is the same system, and the share exactly 1. Goods without
    /// friction are none: the share is 0 and the drift that of the bare building.
    #[test]
    fn limits_are_exact() {
        let stuck = answer(50.0);
        assert_eq!(stuck[..4], [f64::from(Kind::Stuck as u8), 1.0, 1.0, 1.0]);
        assert!((stuck[4] / stuck[5] - 1.0).abs() < 1e-13);
        let free = answer(0.0);
        assert_eq!(free[..4], [f64::from(Kind::Zero as u8), 0.0, 0.0, 0.0]);
        assert!((free[4] / free[5] - 1.0).abs() < 1e-13);
    }

    #[test]
    fn model_at_a_root_has_the_real_drift() {
        let found = answer(0.15);
        assert!(found[0] == f64::from(Kind::Root as u8) || found[0] == f64::from(Kind::Multiple as u8), "{found:?}");
        assert!(found[1] > 0.0 && found[1] < 1.0);
        assert!((found[4] / found[5] - 1.0).abs() < 1e-9, "{found:?}");
        // One motion: every resample is that motion.
        assert!((found[2] - found[1]).abs() < 1e-3 && found[2] == found[3]);
    }

    #[test]
    fn a_building_without_goods_has_no_fraction() {
        let bare = Case::new(&[1.0, 0.5, 0.05, 0.0, 0.3, 0.0, 0.2, 0.2, 1.0, 1.0, 3.0, 2.0, 0.05, 0.0]).unwrap();
        assert!(
            Search::new(bare, vec![motion()]).unwrap_err().to_string().starts_with("goods of effective mass must be")
        );
        assert!(
            Search::new(case(0.2), Vec::new())
                .unwrap_err()
                .to_string()
                .starts_with("motions of effective mass must be")
        );
    }
}
