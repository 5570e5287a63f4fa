//! A case as the page states it, and the scenes that it means: goods that slide, or a share of them attached as mass.

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, Domain, Error, Result, STANDARD_GRAVITY, Scene, SpringLaw, Storey, UniformBuilding,
};

/// Numbers of a case ahead of its lists.
const HEAD: usize = 6;
/// Lists of a case: strengths, mass ratios, static and kinetic friction.
const LISTS: usize = 4;
/// Mass of a floor (kg): drifts and slips do not depend on it.
const FLOOR_MASS: f64 = 1.0;

/// A uniform building with goods on its floors.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Case {
    period: f64,
    damping: f64,
    overstrength: f64,
    second_slope: f64,
    third_slope: f64,
    /// First yield shear of each storey over the weight of the building without goods; infinite: elastic.
    yield_shear_over_weight: Vec<f64>,
    /// Mass of the goods over that of the floor, by floor; 0: none.
    mass_ratio: Vec<f64>,
    mu_s: Vec<f64>,
    mu_k: Vec<f64>,
}

pub(crate) fn refuse(parameter: &str, requirement: &str, value: impl ToString) -> Error {
    Error::invalid(Domain::Scene, parameter, "case", requirement, value.to_string())
}

/// Number of storeys as the page states it, with `numbers` in all that `head` and `lists` of one value per storey make.
pub(crate) fn storeys_of(stated: f64, numbers: usize, head: usize, lists: usize) -> Result<usize> {
    if !(stated >= 1.0 && stated.fract() == 0.0 && stated <= f64::from(u16::MAX)) {
        return Err(refuse("storeys", "a whole number of at least 1", stated));
    }
    let storeys = stated as usize;
    let length = head + lists * storeys;
    if numbers != length {
        return Err(refuse("length", &format!("{length} numbers for {storeys} storeys"), numbers));
    }
    Ok(storeys)
}

impl Case {
    /// Takes storeys, period (s), damping ratio, overstrength, second and third slope, then one list per storey of V_y/W,
    /// mass ratios, mu_s and mu_k.
    pub(crate) fn new(numbers: &[f64]) -> Result<Self> {
        let storeys = storeys_of(numbers.first().copied().unwrap_or(0.0), numbers.len(), HEAD, LISTS)?;
        let (head, lists) = numbers.split_at(HEAD);
        let list = |number: usize| lists[number * storeys..][..storeys].to_vec();
        let case = Self {
            period: head[1],
            damping: head[2],
            overstrength: head[3],
            second_slope: head[4],
            third_slope: head[5],
            yield_shear_over_weight: list(0),
            mass_ratio: list(1),
            mu_s: list(2),
            mu_k: list(3),
        };
        if let Some(&ratio) = case.mass_ratio.iter().find(|ratio| !(ratio.is_finite() && **ratio >= 0.0)) {
            return Err(refuse("mass_ratio", "zero or positive", ratio));
        }
        Ok(case)
    }

    pub(crate) fn storeys(&self) -> usize {
        self.mass_ratio.len()
    }

    /// Mass of the goods on each floor (kg).
    pub(crate) fn goods(&self) -> Vec<f64> {
        self.mass_ratio.iter().map(|ratio| ratio * FLOOR_MASS).collect()
    }

    /// Weight of the building without goods (N).
    pub(crate) fn weight(&self) -> f64 {
        STANDARD_GRAVITY * FLOOR_MASS * self.storeys() as f64
    }

    /// Weight of building and goods (N).
    pub(crate) fn full_weight(&self) -> f64 {
        STANDARD_GRAVITY * (FLOOR_MASS * self.storeys() as f64 + self.goods().iter().sum::<f64>())
    }

    /// Kinetic friction coefficient, averaged over the goods by mass.
    pub(crate) fn friction(&self) -> f64 {
        let goods = self.goods();
        goods.iter().zip(&self.mu_k).map(|(mass, mu)| mass * mu).sum::<f64>() / goods.iter().sum::<f64>()
    }

    /// Stiffness of every storey (N/m).
    fn stiffness(&self) -> Result<f64> {
        let (storeys, period) = (self.storeys(), self.period);
        UniformBuilding { storeys, period, mass: FLOOR_MASS, ..Default::default() }.stiffness()
    }

    /// Whether no goods have friction.
    pub(crate) fn is_without_friction(&self) -> bool {
        self.mass_ratio.iter().zip(&self.mu_s).all(|(&ratio, &mu)| ratio == 0.0 || mu == 0.0)
    }

    fn building(&self, mass: Vec<f64>, damping: Damping) -> Result<Building> {
        let stiffness = self.stiffness()?;
        let weight = self.weight();
        let storey = |&over_weight: &f64| Storey {
            stiffness,
            yield_shear: over_weight * weight,
            overstrength: self.overstrength,
            second_slope: self.second_slope,
            third_slope: self.third_slope,
            law: SpringLaw::Trilinear,
        };
        Building::new(mass, self.yield_shear_over_weight.iter().map(storey).collect(), damping)
    }

    fn bare(&self) -> Result<Building> {
        self.building(vec![FLOOR_MASS; self.storeys()], Damping::Modal { ratio: self.damping })
    }

    /// The building with goods that may slide.
    pub(crate) fn real(&self) -> Result<Scene> {
        let blocks = self.goods().into_iter().enumerate().filter(|(_, mass)| *mass > 0.0);
        let blocks = blocks.map(|(floor, mass)| Block {
            floor: floor + 1,
            mass,
            mu_s: self.mu_s[floor],
            mu_k: self.mu_k[floor],
            velocity: None,
            wear: Vec::new(),
        });
        Scene::new(Some(Arc::new(self.bare()?)), blocks.collect())
    }

    /// The building with a share of the mass of its goods attached and nothing that slides; its damping matrix is that of
    /// the building without goods.
    pub(crate) fn attached(&self, share: f64) -> Result<Scene> {
        let damping = Damping::Matrix(self.bare()?.damping_matrix());
        let mass = self.goods().iter().map(|goods| FLOOR_MASS + share * goods).collect();
        Scene::new(Some(Arc::new(self.building(mass, damping)?)), Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers() -> Vec<f64> {
        vec![
            2.0, 0.4, 0.05, 2.0, 0.05, 0.0, 0.3, 0.2, // head, strengths
            1.0, 0.0, 0.4, 0.0, 0.2, 0.0, // mass ratios, mu_s, mu_k
        ]
    }

    #[test]
    fn goods_slide_or_are_attached() {
        let case = Case::new(&numbers()).unwrap();
        let real = case.real().unwrap();
        assert_eq!(real.blocks().len(), 1);
        assert_eq!((real.blocks()[0].floor, real.blocks()[0].mu_s, real.blocks()[0].mu_k), (1, 0.4, 0.2));
        let attached = case.attached(0.25).unwrap();
        let (real, attached) = (real.building().unwrap(), attached.building().unwrap());
        assert_eq!(attached.mass(), [1.25, 1.0]);
        assert!((attached.damping_matrix() - real.damping_matrix()).amax() < 1e-14);
        assert_eq!(attached.storeys(), real.storeys());
        // W = 2 m g, and with goods of one floor mass 3 m g.
        assert_eq!(real.storeys()[1].yield_shear, 0.2 * 2.0 * STANDARD_GRAVITY);
        assert_eq!(case.full_weight(), 3.0 * STANDARD_GRAVITY);
        assert_eq!(case.friction(), 0.2);
    }

    #[test]
    fn what_is_no_case_is_refused() {
        let refused = |change: &dyn Fn(&mut Vec<f64>)| {
            let mut numbers = numbers();
            change(&mut numbers);
            Case::new(&numbers).and_then(|case| case.real()).unwrap_err().to_string()
        };
        assert_eq!(refused(&|n| n[0] = 1.5), "storeys of case must be a whole number of at least 1; got 1.5");
        assert_eq!(refused(&|n| n[0] = f64::NAN), "storeys of case must be a whole number of at least 1; got NaN");
        assert_eq!(refused(&|n| n.truncate(9)), "length of case must be 14 numbers for 2 storeys; got 9");
        assert_eq!(refused(&|n| n.clear()), "storeys of case must be a whole number of at least 1; got 0");
        assert_eq!(refused(&|n| n[8] = -1.0), "mass_ratio of case must be zero or positive; got -1");
        assert_eq!(refused(&|n| n[1] = 0.0), "period of building must be a positive number; got 0");
        assert_eq!(refused(&|n| n[12] = 0.5), "mu_k of block 1 must be at most mu_s = 0.4; got 0.5");
    }
}
