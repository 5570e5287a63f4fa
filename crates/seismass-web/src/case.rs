//! A case as the page states it, and the scenes that it means: goods that slide, or a share of them attached as mass.

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, Domain, Error, GravityEffect, Result, STANDARD_GRAVITY, Scene, SpringLaw, Storey,
    UniformBuilding,
};

/// Numbers of a case ahead of its lists.
const HEAD: usize = 4;
/// Lists of a case.
const LISTS: usize = 10;

/// A building with goods on its floors, in masses whose unit is the mean floor mass: drifts and slips do not depend on it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Case {
    period: f64,
    damping: f64,
    /// Whether building and goods act in P-Delta with their whole weight.
    p_delta: bool,
    /// First yield shear of each storey over the weight of the building without goods; infinite: elastic.
    yield_shear_over_weight: Vec<f64>,
    /// Mass of the goods over the mean floor mass, by floor; 0: none.
    goods: Vec<f64>,
    mu_s: Vec<f64>,
    mu_k: Vec<f64>,
    /// Mass of each floor over the mean one.
    mass: Vec<f64>,
    /// Stiffness of each storey, of which only the ratios count.
    shape: Vec<f64>,
    /// Height of each storey (m).
    height: Vec<f64>,
    overstrength: Vec<f64>,
    second_slope: Vec<f64>,
    third_slope: Vec<f64>,
}

pub(crate) fn refuse(parameter: &str, requirement: &str, value: impl ToString) -> Error {
    Error::invalid(Domain::Scene, parameter, "case", requirement, value.to_string())
}

/// Number of storeys as the page states it, with `numbers` in all.
fn storeys_of(stated: f64, numbers: usize) -> Result<usize> {
    if !(stated >= 1.0 && stated.fract() == 0.0 && stated <= f64::from(u16::MAX)) {
        return Err(refuse("storeys", "a whole number of at least 1", stated));
    }
    let storeys = stated as usize;
    let length = HEAD + LISTS * storeys;
    if numbers != length {
        return Err(refuse("length", &format!("{length} numbers for {storeys} storeys"), numbers));
    }
    Ok(storeys)
}

impl Case {
    /// Takes storeys, period (s), damping ratio and whether there is P-Delta (1) or not (0), then one list per storey of
    /// V_y/W, goods over the mean floor mass, mu_s, mu_k, floor masses, stiffnesses, heights (m), overstrength, second and
    /// third slope.
    pub(crate) fn new(numbers: &[f64]) -> Result<Self> {
        let storeys = storeys_of(numbers.first().copied().unwrap_or(0.0), numbers.len())?;
        let (head, lists) = numbers.split_at(HEAD);
        let list = |number: usize| lists[number * storeys..][..storeys].to_vec();
        let case = Self {
            period: head[1],
            damping: head[2],
            p_delta: head[3] != 0.0,
            yield_shear_over_weight: list(0),
            goods: list(1),
            mu_s: list(2),
            mu_k: list(3),
            mass: list(4),
            shape: list(5),
            height: list(6),
            overstrength: list(7),
            second_slope: list(8),
            third_slope: list(9),
        };
        if let Some(&ratio) = case.goods.iter().find(|ratio| !(ratio.is_finite() && **ratio >= 0.0)) {
            return Err(refuse("mass_ratio", "zero or positive", ratio));
        }
        if let Some(&height) = case.height.iter().find(|height| !(height.is_finite() && **height > 0.0)) {
            return Err(refuse("height", "a positive number", height));
        }
        Ok(case)
    }

    pub(crate) fn storeys(&self) -> usize {
        self.mass.len()
    }

    /// Mass of the goods on each floor (kg).
    pub(crate) fn goods(&self) -> &[f64] {
        &self.goods
    }

    /// Height of each storey (m).
    pub(crate) fn heights(&self) -> &[f64] {
        &self.height
    }

    /// Mass of each floor with a share of its goods (kg).
    pub(crate) fn mass_with(&self, share: f64) -> Vec<f64> {
        self.mass.iter().zip(&self.goods).map(|(mass, goods)| mass + share * goods).collect()
    }

    /// Weight of the building without goods (N).
    pub(crate) fn weight(&self) -> f64 {
        STANDARD_GRAVITY * self.mass.iter().sum::<f64>()
    }

    /// Weight of building and goods (N).
    pub(crate) fn full_weight(&self) -> f64 {
        STANDARD_GRAVITY * (self.mass.iter().sum::<f64>() + self.goods.iter().sum::<f64>())
    }

    /// Kinetic friction coefficient, averaged over the goods by mass.
    pub(crate) fn friction(&self) -> f64 {
        self.goods.iter().zip(&self.mu_k).map(|(mass, mu)| mass * mu).sum::<f64>() / self.goods.iter().sum::<f64>()
    }

    /// Stiffness of each storey (N/m), by which the building without goods has its first period.
    pub(crate) fn stiffness(&self) -> Result<Vec<f64>> {
        let (storeys, period) = (self.storeys(), self.period);
        let uniform = UniformBuilding { storeys, period, mass: 1.0, ..Default::default() }.stiffness()?;
        if self.mass.iter().chain(&self.shape).all(|&value| value == 1.0) {
            return Ok(vec![uniform; storeys]);
        }
        let springs = self.shape.iter().map(|&shape| Storey::elastic(shape)).collect();
        let trial = Building::new(self.mass.clone(), springs, Damping::default())?;
        let factor = (trial.periods()[0] / period).powi(2);
        Ok(self.shape.iter().map(|shape| factor * shape).collect())
    }

    /// Whether no goods have friction.
    pub(crate) fn is_without_friction(&self) -> bool {
        self.goods.iter().zip(&self.mu_s).all(|(&ratio, &mu)| ratio == 0.0 || mu == 0.0)
    }

    /// P/h of each storey (N/m) with the weight of building and goods, whatever share of the goods is attached.
    fn gravity(&self) -> GravityEffect {
        if !self.p_delta {
            return GravityEffect::None;
        }
        let above = self.mass_with(1.0);
        let load = |storey: usize| STANDARD_GRAVITY * above[storey..].iter().sum::<f64>() / self.height[storey];
        GravityEffect::GeometricStiffness((0..self.storeys()).map(load).collect())
    }

    fn building(&self, mass: Vec<f64>, damping: Damping) -> Result<Building> {
        let (stiffness, weight) = (self.stiffness()?, self.weight());
        let storey = |(i, stiffness): (usize, f64)| Storey {
            stiffness,
            yield_shear: self.yield_shear_over_weight[i] * weight,
            overstrength: self.overstrength[i],
            second_slope: self.second_slope[i],
            third_slope: self.third_slope[i],
            law: SpringLaw::Trilinear,
        };
        let storeys = stiffness.into_iter().enumerate().map(storey).collect();
        Building::new(mass, storeys, damping)?.with_gravity(self.gravity())
    }

    fn bare(&self) -> Result<Building> {
        self.building(self.mass.clone(), Damping::Modal { ratio: self.damping })
    }

    /// The building with goods that may slide.
    pub(crate) fn real(&self) -> Result<Scene> {
        let blocks = self.goods.iter().copied().enumerate().filter(|(_, mass)| *mass > 0.0);
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
        Scene::new(Some(Arc::new(self.building(self.mass_with(share), damping)?)), Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers() -> Vec<f64> {
        vec![
            2.0, 0.4, 0.05, 0.0, 0.3, 0.2, // head, strengths
            1.0, 0.0, 0.4, 0.0, 0.2, 0.0, // goods, mu_s, mu_k
            1.0, 1.0, 1.0, 1.0, 3.0, 3.0, // masses, stiffnesses, heights
            2.0, 2.0, 0.05, 0.05, 0.0, 0.0, // overstrength, slopes
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

    /// Floors and storeys of their own keep the first period; P/h has the weight of all goods in every model.
    #[test]
    fn floors_may_differ() {
        let mut numbers = numbers();
        numbers[3] = 1.0;
        numbers[12..18].copy_from_slice(&[1.2, 0.8, 1.0, 0.7, 4.0, 3.0]);
        let case = Case::new(&numbers).unwrap();
        let (real, attached) = (case.real().unwrap(), case.attached(0.5).unwrap());
        let (real, attached) = (real.building().unwrap(), attached.building().unwrap());
        assert!((real.periods()[0] / 0.4 - 1.0).abs() < 1e-12);
        assert!((real.storeys()[1].stiffness / real.storeys()[0].stiffness / 0.7 - 1.0).abs() < 1e-12);
        assert_eq!(attached.mass(), [1.7, 0.8]);
        let loads = [STANDARD_GRAVITY * 3.0 / 4.0, STANDARD_GRAVITY * 0.8 / 3.0];
        for building in [real, attached] {
            let GravityEffect::GeometricStiffness(found) = building.gravity() else { panic!("{building:?}") };
            assert!(found.iter().zip(loads).all(|(found, load)| (found / load - 1.0).abs() < 1e-14), "{found:?}");
        }
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
        assert_eq!(refused(&|n| n.truncate(9)), "length of case must be 24 numbers for 2 storeys; got 9");
        assert_eq!(refused(&|n| n.clear()), "storeys of case must be a whole number of at least 1; got 0");
        assert_eq!(refused(&|n| n[6] = -1.0), "mass_ratio of case must be zero or positive; got -1");
        assert_eq!(refused(&|n| n[16] = 0.0), "height of case must be a positive number; got 0");
        assert_eq!(refused(&|n| n[1] = 0.0), "period of building must be a positive number; got 0");
        assert_eq!(refused(&|n| n[10] = 0.5), "mu_k of block 1 must be at most mu_s = 0.4; got 0.5");
    }
}
