//! The form of fields that are not written as they are with the feature `serde`.

use nalgebra::DMatrix;
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::ser::{Error as _, Serialize, Serializer};

/// What a field is written as and read from where it is not its own form.
pub(crate) trait Formed: Sized {
    /// The form.
    type Form;

    /// The value in its form, or what is wrong with it.
    fn form(&self) -> Result<Self::Form, &'static str>;

    /// The value of a form, or what is wrong with that.
    fn of_form(form: Self::Form) -> Result<Self, &'static str>;
}

/// Infinity is none: null in JSON.
impl Formed for f64 {
    type Form = Option<f64>;

    fn form(&self) -> Result<Self::Form, &'static str> {
        match *self {
            f64::INFINITY => Ok(None),
            value if value.is_finite() => Ok(Some(value)),
            _ => Err("a number must be finite or plus infinity"),
        }
    }

    fn of_form(form: Self::Form) -> Result<Self, &'static str> {
        Ok(form.unwrap_or(f64::INFINITY))
    }
}

impl Formed for [f64; 2] {
    type Form = [Option<f64>; 2];

    fn form(&self) -> Result<Self::Form, &'static str> {
        Ok([self[0].form()?, self[1].form()?])
    }

    fn of_form(form: Self::Form) -> Result<Self, &'static str> {
        Ok([f64::of_form(form[0])?, f64::of_form(form[1])?])
    }
}

impl<T: Formed> Formed for Option<T> {
    type Form = Option<T::Form>;

    fn form(&self) -> Result<Self::Form, &'static str> {
        self.as_ref().map(T::form).transpose()
    }

    fn of_form(form: Self::Form) -> Result<Self, &'static str> {
        form.map(T::of_form).transpose()
    }
}

impl<T: Formed> Formed for Vec<T> {
    type Form = Vec<T::Form>;

    fn form(&self) -> Result<Self::Form, &'static str> {
        self.iter().map(T::form).collect()
    }

    fn of_form(form: Self::Form) -> Result<Self, &'static str> {
        form.into_iter().map(T::of_form).collect()
    }
}

/// A matrix is a list of rows.
impl Formed for DMatrix<f64> {
    type Form = Vec<Vec<f64>>;

    fn form(&self) -> Result<Self::Form, &'static str> {
        Ok(self.row_iter().map(|row| row.iter().copied().collect()).collect())
    }

    fn of_form(form: Self::Form) -> Result<Self, &'static str> {
        let columns = form.first().map_or(0, Vec::len);
        if form.iter().any(|row| row.len() != columns) {
            return Err("rows of a matrix must have one length");
        }
        Ok(Self::from_fn(form.len(), columns, |i, j| form[i][j]))
    }
}

pub(crate) fn serialize<T: Formed<Form: Serialize>, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    value.form().map_err(S::Error::custom)?.serialize(serializer)
}

pub(crate) fn deserialize<'de, T: Formed<Form: Deserialize<'de>>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    T::of_form(T::Form::deserialize(deserializer)?).map_err(D::Error::custom)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, from_str, from_value, json, to_string, to_value};

    use std::sync::Arc;

    use super::*;
    use crate::{
        Block, Building, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, Options, PeakOriented,
        PlaneMotion, PlaneScene, Rack, Scene, SlidingBase, SpringLaw, Stops, Storey, Wear, simulate, simulate_general,
        simulate_plane,
    };

    /// Numbers from a seed (SplitMix64; Steele, Lea and Flood 2014).
    struct Draw(u64);

    impl Draw {
        fn below(&mut self, n: usize) -> usize {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (z ^ (z >> 31)) as usize % n
        }

        fn number(&mut self, low: f64, high: f64) -> f64 {
            low + (high - low) * self.below(1 << 53) as f64 / (1u64 << 53) as f64
        }

        fn or_infinite(&mut self, low: f64, high: f64) -> f64 {
            if self.below(2) == 0 { f64::INFINITY } else { self.number(low, high) }
        }

        fn storey(&mut self) -> Storey {
            let backbone = [[self.number(0.001, 0.01), self.number(1e3, 2e3)], [0.2, 2.1e3]];
            let mut storey = Storey {
                overstrength: self.number(1.0, 3.0),
                second_slope: self.number(0.1, 0.9),
                third_slope: self.number(0.0, 0.1),
                ..Storey::yielding(self.number(1e5, 1e6), self.or_infinite(1e3, 1e5))
            };
            storey.law = match self.below(5) {
                0 => SpringLaw::Trilinear,
                1 => SpringLaw::Gap { clearance: self.number(0.01, 0.1), stop_stiffness: self.number(1e5, 1e6) },
                2 => SpringLaw::PeakOriented(PeakOriented {
                    unloading_exponent: self.number(0.0, 0.9),
                    energy_capacity: self.or_infinite(10.0, 100.0),
                    residual_strength: self.number(0.0, 0.9),
                }),
                3 => SpringLaw::FlagShaped { flag_height: self.number(0.0, 1.0) },
                _ => return Storey::multilinear(backbone),
            };
            storey
        }

        fn blocks(&mut self, floors: std::ops::RangeInclusive<usize>) -> Vec<Block> {
            let block = |floor: usize| Block {
                mu_k: self.number(0.1, 0.2),
                velocity: (self.below(3) == 0).then(|| self.number(-0.1, 0.1)),
                wear: vec![
                    Wear { path: self.number(0.001, 0.1), mu_s: 0.3, mu_k: self.number(0.1, 0.2) };
                    self.below(2)
                ],
                ..Block::new(floor, self.number(10.0, 1e3), self.number(0.2, 0.5))
            };
            floors.map(block).collect()
        }

        fn goods(&mut self, floors: std::ops::RangeInclusive<usize>) -> Vec<Goods> {
            let blocks = self.blocks(floors);
            let stops = |draw: &mut Self| Stops {
                clearance: [draw.or_infinite(0.0, 0.01), draw.or_infinite(0.0, 0.01)],
                stiffness: draw.number(1e4, 1e5),
                damping: draw.number(0.0, 1e3),
            };
            let goods = |block| Goods { block, stops: (self.below(2) == 0).then(|| stops(self)) };
            blocks.into_iter().map(goods).collect()
        }

        fn matrix(&mut self, n: usize, size: f64) -> DMatrix<f64> {
            let half = DMatrix::from_fn(n, n, |_, _| self.number(0.0, size));
            (&half + half.transpose()) * 0.25 + DMatrix::identity(n, n) * (n as f64 * size)
        }

        fn scenes(&mut self) -> (Scene, GeneralScene, PlaneScene) {
            let n = self.below(4);
            let storeys: Vec<Storey> = (0..n).map(|_| self.storey()).collect();
            let mass: Vec<f64> = (0..n).map(|_| self.number(500.0, 2e3)).collect();
            let damping = match self.below(3) {
                0 if n > 1 => Damping::Rayleigh { ratio: self.number(0.0, 0.1), modes: [1, 2] },
                1 => Damping::Matrix(self.matrix(n, 1e3)),
                _ => Damping::Modal { ratio: self.number(0.0, 0.1) },
            };
            let gravity = match self.below(3) {
                0 => GravityEffect::None,
                1 => GravityEffect::GeometricStiffness((0..n).map(|_| self.number(0.0, 1e3)).collect()),
                _ => GravityEffect::Loads {
                    heights: (0..n).map(|_| self.number(3.0, 4.0)).collect(),
                    floor_loads: (0..n).map(|_| self.number(0.0, 2e4)).collect(),
                },
            };
            let blocks = self.blocks(0..=n);
            let drift: Vec<f64> = storeys.iter().map(|s| self.number(-1e-3, 1e-3).min(s.elastic_drift())).collect();
            let velocity: Vec<f64> = (0..n).map(|_| self.number(-0.1, 0.1)).collect();
            let limits: Option<Vec<f64>> =
                (self.below(2) == 0).then(|| (0..n).map(|_| self.or_infinite(0.1, 1.0)).collect());
            let matrix = (n > 0 && self.below(2) == 0).then(|| self.matrix(n, 1e5));
            let racks: Vec<Rack> = (0..self.below(3))
                .map(|_| Rack {
                    floor: self.below(n + 1),
                    mass: vec![self.number(10.0, 100.0), self.number(10.0, 100.0)],
                    levels: vec![self.storey(), self.storey()],
                    damping_ratio: self.number(0.0, 0.1),
                    geometric_stiffness: vec![self.number(0.0, 1e3); 2 * self.below(2)],
                    goods: self.goods(1..=2),
                })
                .collect();
            let radius = self.or_infinite(1.0, 3.0);
            let base = SlidingBase { mu_k: self.number(0.0, 0.1), radius, ..SlidingBase::new(1e3, 0.2) };
            let general = GeneralBuilding::new(mass.clone(), storeys.clone(), matrix, &damping, gravity.clone());
            let general = (n > 0).then(|| Arc::new(general.unwrap()));
            let building = || Building::new(mass, storeys, damping)?.with_gravity(gravity);
            let building = (n > 0).then(|| Arc::new(building().unwrap()));
            let scene = Scene::new(building, blocks).unwrap();
            let goods = self.goods(0..=n);
            let on = |base| {
                let scene = GeneralScene::on_base(general.clone(), goods.clone(), racks.clone(), base).unwrap();
                let scene = scene.with_initial(drift.clone(), velocity.clone()).unwrap();
                limits.clone().map_or(Ok(scene.clone()), |limits| scene.with_collapse_drift(limits)).unwrap()
            };
            let scene = scene.with_initial(drift.clone(), velocity.clone()).unwrap();
            let scene = limits.clone().map_or(Ok(scene.clone()), |limits| scene.with_collapse_drift(limits)).unwrap();
            (scene, on((self.below(2) == 0).then_some(base)), PlaneScene::new(on(None), on(None)).unwrap())
        }
    }

    #[test]
    fn what_is_written_is_read() {
        for seed in 0..300 {
            let (scene, general, plane) = Draw(seed).scenes();
            assert_eq!(from_str::<Scene>(&to_string(&scene).unwrap()).unwrap(), scene, "{seed}");
            assert_eq!(from_str::<GeneralScene>(&to_string(&general).unwrap()).unwrap(), general, "{seed}");
            assert_eq!(from_str::<PlaneScene>(&to_string(&plane).unwrap()).unwrap(), plane, "{seed}");
        }
    }

    /// Pointers to all values.
    fn places(value: &Value, at: &str, found: &mut Vec<String>) {
        found.push(at.to_string());
        match value {
            Value::Array(list) => list.iter().enumerate().for_each(|(i, v)| places(v, &format!("{at}/{i}"), found)),
            Value::Object(map) => map.iter().for_each(|(key, v)| places(v, &format!("{at}/{key}"), found)),
            _ => {}
        }
    }

    /// Every changed value is refused or the scene's own, and so is one of another type; unknown keys are refused.
    fn is_checked<T: Serialize + serde::de::DeserializeOwned>(scene: &T) -> usize {
        let whole = to_value(scene).unwrap();
        let (mut all, mut refused) = (Vec::new(), 0);
        places(&whole, "", &mut all);
        for at in all {
            let value = whole.pointer(&at).unwrap();
            let number = value.as_f64().unwrap_or(0.0);
            let mut changes =
                vec![json!("text"), json!(-1.25 * number), json!(1.25 * number), json!(true), Value::Null];
            if let Value::Object(map) = value {
                let unknown = map.clone().into_iter().chain([("unknown".to_string(), Value::Null)]);
                changes.push(unknown.collect());
            }
            for change in changes {
                let mut changed = whole.clone();
                *changed.pointer_mut(&at).unwrap() = change;
                match from_value::<T>(changed.clone()) {
                    Ok(read) => assert_eq!(to_value(read).unwrap(), changed, "{at}"),
                    Err(_) => refused += 1,
                }
            }
        }
        refused
    }

    #[test]
    fn every_field_is_read_and_checked() {
        for seed in 0..8 {
            let (scene, general, plane) = Draw(seed).scenes();
            let refused = [is_checked(&scene), is_checked(&general), is_checked(&plane)];
            assert!(refused.iter().all(|&count| count > 10), "{seed} {refused:?}");
        }
        let heavy = to_value(GeneralScene::from(&Scene::new(None, vec![Block::new(0, 1.0, 0.1)]).unwrap())).unwrap();
        let negative = to_string(&heavy).unwrap().replace("\"mass\":1.0", "\"mass\":-1.0");
        let error = from_str::<GeneralScene>(&negative).unwrap_err().to_string();
        assert!(error.starts_with("mass of block 1 must be a positive number; got -1"), "{error}");
    }

    #[test]
    fn what_has_a_default_may_be_left_out() {
        let slopes = r#""overstrength": 2, "second_slope": 0.05, "third_slope": 0"#;
        let storey = format!(r#"{{"stiffness": 1e6, "yield_shear": null, {slopes}}}"#);
        let building = format!(r#""building": {{"mass": [1000], "storeys": [{storey}]}}"#);
        let block = r#"{"floor": 1, "mass": 1, "mu_s": 0.1, "mu_k": 0.1}"#;
        let read: Scene = from_str(&format!(r#"{{{building}, "blocks": [{block}]}}"#)).unwrap();
        let general: GeneralScene = from_str(&format!(r#"{{{building}, "goods": [{{"block": {block}}}]}}"#)).unwrap();
        let building = Arc::new(Building::new(vec![1e3], vec![Storey::elastic(1e6)], Damping::default()).unwrap());
        let scene = Scene::new(Some(building), vec![Block::new(1, 1.0, 0.1)]).unwrap();
        assert_eq!(read, scene);
        assert_eq!(general, GeneralScene::from(&scene));
    }

    #[test]
    fn the_scene_of_the_readme_is_read() {
        let (_, rest) = include_str!("../../README.md").split_once("```json\n").unwrap();
        let scene: Scene = from_str(rest.split_once("```").unwrap().0).unwrap();
        assert_eq!(scene.collapse_drift(), Some(&[f64::INFINITY][..]));
        assert!(scene.geometric_stiffness()[0] > 981e3 / 3.5);
    }

    #[test]
    fn numbers_without_a_form_are_refused() {
        for value in [f64::NAN, f64::NEG_INFINITY] {
            assert!(to_string(&Storey::yielding(1.0, value)).is_err());
        }
        let ragged = json!({"mass": [1.0], "storeys": [Storey::elastic(1.0)], "damping": {"matrix": [[1.0], []]}});
        let error = from_value::<Building>(ragged).unwrap_err().to_string();
        assert_eq!(error, "rows of a matrix must have one length");
    }

    /// Numbers in the order in which they stand; what is none or not finite is NaN.
    fn numbers(text: &str) -> Vec<u64> {
        let words = text.split(|c: char| !(c.is_alphanumeric() || "+-.".contains(c)));
        let number = |word: &str| match word {
            "null" | "None" | "inf" => Some(f64::NAN),
            _ => word.parse().ok(),
        };
        words.filter_map(number).map(f64::to_bits).collect()
    }

    /// Every number of a response is written: those of its `Debug`, which has all fields, in their order.
    #[test]
    fn responses_are_written_whole() {
        let wave = |size: f64| (0..40).map(|i| size * libm::sin(0.3 * f64::from(i))).collect::<Vec<f64>>();
        let motion = Motion::new(wave(8.0), 0.01, Some(wave(12.0).into())).unwrap();
        let pair = PlaneMotion::new(motion.clone(), wave(5.0)).unwrap();
        let histories = std::num::NonZeroUsize::new(3);
        let options = Options { histories, energy: true, events: true, ..Options::default() };
        let chain = Options { floor_force: true, ..options };
        let same = |written: String, fields: String| assert_eq!(numbers(&written), numbers(&fields));
        for seed in 0..12 {
            let (scene, general, plane) = Draw(seed).scenes();
            let response = simulate(&scene, &motion, &chain).unwrap();
            same(to_string(&response).unwrap(), format!("{response:?}"));
            let response = simulate_general(&general, &motion, &options).unwrap();
            same(to_string(&response).unwrap(), format!("{response:?}"));
            let response = simulate_plane(&plane, &pair, &options).unwrap();
            same(to_string(&response).unwrap(), format!("{response:?}"));
        }
        for kind in crate::EventKind::ALL {
            assert_eq!(to_value(kind).unwrap(), kind.name());
        }
    }
}
