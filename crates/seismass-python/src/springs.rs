//! The springs of storeys, from lists by name, and the path of one of them.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use seismass::{PeakOriented, SpringEvent, SpringLaw, Storey};

use crate::arrays::{Output, Table, Values};
use crate::errors::refuse;

/// What a storey's spring is given by, whatever its law.
struct Spring {
    storey: Storey,
    clearance: f64,
    stop_stiffness: f64,
    peak_oriented: PeakOriented,
    flag_height: f64,
}

/// A number of a storey's spring: its name and its place.
type SpringField = (&'static str, fn(&mut Spring) -> &mut f64);

const SPRING_FIELDS: &[SpringField] = &[
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
    ("flag_height", |spring| &mut spring.flag_height),
];

/// A hysteresis: its name, and the law that it makes of a spring's numbers.
type Hysteresis = (&'static str, fn(&Spring) -> SpringLaw);

/// Masing unloading, that of a storey without a name of its own.
const MASING: Hysteresis = ("masing", |spring| match spring.clearance {
    f64::INFINITY => SpringLaw::Trilinear,
    clearance => SpringLaw::Gap { clearance, stop_stiffness: spring.stop_stiffness },
});

const HYSTERESES: &[Hysteresis] = &[
    MASING,
    ("peak-oriented", |spring| SpringLaw::PeakOriented(spring.peak_oriented)),
    ("flag-shaped", |spring| SpringLaw::FlagShaped { flag_height: spring.flag_height }),
];

fn hysteresis(name: &str) -> seismass::Result<&'static Hysteresis> {
    let found = HYSTERESES.iter().find(|(known, _)| *known == name);
    found.ok_or_else(|| refuse("hysteresis", "one that springs have", name))
}

/// The storeys, from lists that must be as long as the list of masses; a number without a list has its default.
pub(crate) fn storeys(
    count: usize,
    springs: &BTreeMap<String, Values<f64>>,
    backbones: Option<&[Option<Table<f64>>]>,
    hystereses: Option<&[String]>,
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
            flag_height: 1.0,
        })
        .collect();
    for &(name, place) in SPRING_FIELDS {
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
    one_per_storey("hysteresis", hystereses.map_or(count, <[_]>::len))?;
    given
        .into_iter()
        .enumerate()
        .map(|(i, spring)| {
            let backbone = backbones.and_then(|listed| listed[i].as_ref());
            let hysteresis = hystereses.map_or(Ok(&MASING), |listed| hysteresis(&listed[i]))?;
            let law = law(i, &spring, backbone, hysteresis)?;
            Ok(Storey { law, ..spring.storey })
        })
        .collect()
}

/// The law of storey `i`; two at once are refused.
fn law(
    i: usize,
    spring: &Spring,
    backbone: Option<&Table<f64>>,
    &(name, of_spring): &Hysteresis,
) -> seismass::Result<SpringLaw> {
    let alone = |parameter: &str, other: &str, got: String| {
        let requirement = format!("left out where storey {} {other}", i + 1);
        Err(refuse(parameter, &requirement, &got))
    };
    let (is_masing, has_stop) = (name == MASING.0, spring.clearance != f64::INFINITY);
    match backbone {
        Some(_) if !is_masing => alone("hysteresis", "has a backbone", name.into()),
        Some(_) if has_stop => alone("clearance", "has a backbone", format!("{} m", spring.clearance)),
        None if !is_masing && has_stop => alone("clearance", &format!("is {name}"), format!("{} m", spring.clearance)),
        Some(points) if points.columns != 2 => {
            Err(refuse("backbone", "pairs of drift and force", &format!("{} columns", points.columns)))
        }
        Some(points) => {
            let backbone = points.values.chunks_exact(2).map(|point| [point[0], point[1]]).collect();
            Ok(SpringLaw::Multilinear { backbone })
        }
        None => Ok(of_spring(spring)),
    }
}

/// What the spring of a storey did along a list of drifts.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct SpringPath(seismass::SpringPath);

impl SpringPath {
    /// Drives the spring of a storey.
    pub(crate) fn new(storey: &Storey, drifts: &[f64]) -> seismass::Result<Self> {
        seismass::spring_path(storey, drifts).map(Self)
    }

    fn event_column<T>(&self, of: impl Fn(&SpringEvent) -> T) -> Output<T> {
        Output::new(self.0.events.iter().map(of))
    }
}

getters! { SpringPath
    /// Force at each drift (N).
    force(self) -> Output<f64> = Output::new(self.0.force.iter().copied());
    /// Energy dissipated up to each drift (J).
    dissipated(self) -> Output<f64> = Output::new(self.0.dissipated.iter().copied());
    /// Energy stored at each drift (J).
    stored(self) -> Output<f64> = Output::new(self.0.stored.iter().copied());
    /// Index of the drift on the way to which each event happened.
    event_leg(self) -> Output<u32> = self.event_column(|event| u32::try_from(event.leg).unwrap_or(u32::MAX));
    /// Drift at each event (m).
    event_drift(self) -> Output<f64> = self.event_column(|event| event.drift);
    /// Force at each event (N).
    event_force(self) -> Output<f64> = self.event_column(|event| event.force);
    /// Kinds of the events, as indices of `Response.event_kinds`.
    event_kind(self) -> Output<u8> = self.event_column(|event| event.kind as u8);
    /// Sign of each event.
    event_sign(self) -> Output<i8> = self.event_column(|event| event.sign);
    /// Number of segments left at each yield, from 1; otherwise 0.
    event_element(self) -> Output<u8> = self.event_column(|event| event.element);
}
