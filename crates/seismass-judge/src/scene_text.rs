//! Scenes of the benchmarks as text: a name and its numbers per line; numbers round-trip.
//!
//! mass, stiffness, yield_shear, overstrength, second_slope, third_slope (per storey), damping (ratio in every mode),
//! block (one line each: floor, mass, mu), dt, acceleration. All but block must be given once, and nothing else may be.

use std::collections::HashMap;
use std::error::Error;
use std::sync::Arc;

use seismass::{Block, Building, Damping, Motion, Scene, Storey};

type Input = HashMap<String, Vec<f64>>;

fn take(input: &mut Input, name: &str) -> Result<Vec<f64>, String> {
    input.remove(name).ok_or_else(|| format!("{name} of input must be given; got none"))
}

fn number(input: &mut Input, name: &str) -> Result<f64, String> {
    match take(input, name)?[..] {
        [value] => Ok(value),
        ref values => Err(format!("{name} of input must be one number; got {}", values.len())),
    }
}

fn whole(floor: f64) -> Result<usize, String> {
    let number = floor as usize;
    if number as f64 == floor { Ok(number) } else { Err(format!("floor of block must be a whole number; got {floor}")) }
}

fn parse(text: &str) -> Result<(Input, Vec<Block>), Box<dyn Error>> {
    let (mut input, mut blocks) = (Input::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let Some(name) = words.next() else { continue };
        let values = words.map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        match (name, &values[..]) {
            ("block", &[floor, mass, mu]) => blocks.push(Block::new(whole(floor)?, mass, mu)),
            ("block", _) => return Err("block of input must be floor, mass and mu".into()),
            _ if input.contains_key(name) => return Err(format!("{name} of input must be given once").into()),
            _ => drop(input.insert(name.to_owned(), values)),
        }
    }
    Ok((input, blocks))
}

fn building(input: &mut Input) -> Result<Building, Box<dyn Error>> {
    let mass = take(input, "mass")?;
    let names = ["stiffness", "yield_shear", "overstrength", "second_slope", "third_slope"];
    let lists = names.into_iter().map(|name| take(input, name)).collect::<Result<Vec<_>, _>>()?;
    if let Some(list) = lists.iter().find(|list| list.len() != mass.len()) {
        return Err(format!("lists of input must have {} values; got {}", mass.len(), list.len()).into());
    }
    let storeys = (0..mass.len())
        .map(|i| Storey {
            overstrength: lists[2][i],
            second_slope: lists[3][i],
            third_slope: lists[4][i],
            ..Storey::yielding(lists[0][i], lists[1][i])
        })
        .collect();
    let ratio = number(input, "damping")?;
    Ok(Building::new(mass, storeys, Damping::Modal { ratio })?)
}

/// Reads a scene and its motion.
///
/// # Errors
/// A name that is missing, unknown or given twice, a list of the wrong length, a floor that is no whole number, and
/// what the kernel refuses.
pub fn read(text: &str) -> Result<(Scene, Motion), Box<dyn Error>> {
    let (mut input, blocks) = parse(text)?;
    let scene = Scene::new(Some(Arc::new(building(&mut input)?)), blocks)?;
    let dt = number(&mut input, "dt")?;
    let motion = Motion::new(take(&mut input, "acceleration")?, dt, None)?;
    match input.into_keys().min() {
        Some(name) => Err(format!("name of input must be a known one; got {name}").into()),
        None => Ok((scene, motion)),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    const SCENE: &str = "mass 2.0 1.0\nstiffness 300.0 200.0\nyield_shear 5.0 inf\noverstrength 1.0 1.5\n\
        second_slope 0.05 0.1\nthird_slope 0.0 0.0\ndamping 0.05\nblock 0.0 1.0 0.3\nblock 2 0.5 0.2\n\
        dt 0.01\nacceleration 0.0 1.0 -1.0\n";

    #[test]
    fn a_scene_is_read() {
        let (scene, motion) = read(SCENE).unwrap();
        assert_eq!((scene.storeys(), motion.acceleration(), motion.dt()), (2, &[0.0, 1.0, -1.0][..], 0.01));
        assert_eq!(scene.blocks(), [Block::new(0, 1.0, 0.3), Block::new(2, 0.5, 0.2)]);
    }

    #[test]
    fn what_is_not_of_a_scene_is_refused() {
        for (line, message) in [
            ("heights 3.0 3.0", "name of input must be a known one; got heights"),
            ("damping 0.02", "damping of input must be given once"),
            ("block -1 1.0 0.3", "floor of block must be a whole number; got -1"),
            ("block 1.5 1.0 0.3", "floor of block must be a whole number; got 1.5"),
            ("block NaN 1.0 0.3", "floor of block must be a whole number; got NaN"),
            ("block 1 1.0", "block of input must be floor, mass and mu"),
        ] {
            assert_eq!(read(&format!("{SCENE}{line}\n")).unwrap_err().to_string(), message);
        }
        let without = SCENE.replace("damping 0.05\n", "");
        assert_eq!(read(&without).unwrap_err().to_string(), "damping of input must be given; got none");
    }
}
