//! The springs of storeys, from lists by name, and the path of one of them.

use std::collections::BTreeMap;

use seismass::{PeakOriented, SpringLaw, Storey};

use crate::arrays::{Table, Values};
use crate::scene::refuse;

/// What a storey's spring is given by, whatever its law.
struct Spring {
    storey: Storey,
    clearance: f64,
    stop_stiffness: f64,
    peak_oriented: PeakOriented,
}

/// A number of a storey's spring: its name and its place.
type SpringField = (&'static str, fn(&mut Spring) -> &mut f64);

const SPRING_FIELDS: [SpringField; 10] = [
    ("stiffness", |spring| &mut spring.storey.stiffness),
    ("yield_shear", |spring| &mut spring.storey.yield_shear),
    ("overstrength", |spring| &mut spring.storey.overstrength),
    ("second_slope", |spring| &mut spring.storey.second_slope),
    ("third_slope", |spring| &mut spring.storey.third_slope),
    ("clearance", |spring| &mut spring.clearance),
    ("stop_stiffness", |spring| &mut spring.stop_stiffness),
    ("unloading_exponent", |spring| &mut spring.peak_oriented.unloading_exponent),
    ("energy_capacity", |spring| &mut spring.peak_oriented.energy_capacity),
    ("residual_strength", |spring| &mut spring.peak_oriented.residual_strength),
];

/// The storeys, from lists that must be as long as the list of masses; a number without a list has its default.
pub(crate) fn storeys(
    count: usize,
    springs: &BTreeMap<String, Values<f64>>,
    backbones: Option<&[Option<Table<f64>>]>,
    peak_oriented: Option<&[bool]>,
) -> seismass::Result<Vec<Storey>> {
    let one_per_storey = |name: &str, length: usize| {
        let requirement = format!("one number or a list of {count} values, one per storey");
        if length == count { Ok(()) } else { Err(refuse(name, &requirement, &format!("{length} values"))) }
    };
    let mut given: Vec<Spring> = (0..count)
        .map(|_| Spring {
            storey: Storey::elastic(f64::NAN),
            clearance: f64::INFINITY,
            stop_stiffness: 0.0,
            peak_oriented: PeakOriented::default(),
        })
        .collect();
    for (name, place) in SPRING_FIELDS {
        let Some(Values(list)) = springs.get(name) else {
            continue;
        };
        one_per_storey(name, list.len())?;
        for (spring, &value) in given.iter_mut().zip(list) {
            *place(spring) = value;
        }
    }
    if let Some(name) = springs.keys().find(|&name| SPRING_FIELDS.iter().all(|(known, _)| known != name)) {
        return Err(refuse(name, "a number that springs have", "another name"));
    }
    one_per_storey("backbone", backbones.map_or(count, <[_]>::len))?;
    one_per_storey("hysteresis", peak_oriented.map_or(count, <[_]>::len))?;
    given
        .into_iter()
        .enumerate()
        .map(|(i, spring)| {
            let backbone = backbones.and_then(|listed| listed[i].as_ref());
            let law = law(i, &spring, backbone, peak_oriented.is_some_and(|listed| listed[i]))?;
            Ok(Storey { law, ..spring.storey })
        })
        .collect()
}

/// The law of storey `i`; two at once are refused.
fn law(i: usize, spring: &Spring, backbone: Option<&Table<f64>>, peak_oriented: bool) -> seismass::Result<SpringLaw> {
    let alone = |parameter: &str, other: &str, got: String| {
        let requirement = format!("left out where storey {} {other}", i + 1);
        Err(refuse(parameter, &requirement, &got))
    };
    let has_stop = spring.clearance != f64::INFINITY;
    match backbone {
        Some(_) if peak_oriented => alone("hysteresis", "has a backbone", "peak-oriented".into()),
        Some(_) if has_stop => alone("clearance", "has a backbone", format!("{} m", spring.clearance)),
        None if peak_oriented && has_stop => alone("clearance", "is peak-oriented", format!("{} m", spring.clearance)),
        Some(points) if points.columns != 2 => {
            Err(refuse("backbone", "pairs of drift and force", &format!("{} columns", points.columns)))
        }
        Some(points) => {
            let backbone = points.values.chunks_exact(2).map(|point| [point[0], point[1]]).collect();
            Ok(SpringLaw::Multilinear { backbone })
        }
        None if peak_oriented => Ok(SpringLaw::PeakOriented(spring.peak_oriented)),
        None if has_stop => Ok(SpringLaw::Gap { clearance: spring.clearance, stop_stiffness: spring.stop_stiffness }),
        None => Ok(SpringLaw::Trilinear),
    }
}
