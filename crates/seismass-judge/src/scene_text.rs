//! Scenes of the benchmarks as text: a name and its numbers per line; numbers round-trip.
//!
//! mass, stiffness, yield_shear, overstrength, second_slope, third_slope (per storey), damping (ratio in every mode),
//! block (one line each: floor, mass, mu), dt, acceleration.

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

fn parse(text: &str) -> Result<(Input, Vec<Block>), Box<dyn Error>> {
    let (mut input, mut blocks) = (Input::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let Some(name) = words.next() else { continue };
        let values = words.map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        match (name, &values[..]) {
            ("block", &[floor, mass, mu]) => blocks.push(Block::new(floor as usize, mass, mu)),
            ("block", _) => return Err("block of input must be floor, mass and mu".into()),
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
            stiffness: lists[0][i],
            yield_shear: lists[1][i],
            overstrength: lists[2][i],
            second_slope: lists[3][i],
            third_slope: lists[4][i],
        })
        .collect();
    let ratio = number(input, "damping")?;
    Ok(Building::new(mass, storeys, Damping::Modal { ratio })?)
}

/// Reads a scene and its motion.
///
/// # Errors
/// A name that is missing, a list of the wrong length, and what the kernel refuses.
pub fn read(text: &str) -> Result<(Scene, Motion), Box<dyn Error>> {
    let (mut input, blocks) = parse(text)?;
    let scene = Scene::new(Some(Arc::new(building(&mut input)?)), blocks)?;
    let dt = number(&mut input, "dt")?;
    Ok((scene, Motion::new(take(&mut input, "acceleration")?, dt, None)?))
}
