//! What makes two runs of a batch equal, and what they share: each field of what runs are made of has a twin that differs
//! in it. In a batch of all of them each run is the run alone, to the bit, and that of a twin is another one.

#![allow(clippy::unwrap_used)]

mod fixture;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;
use std::num::NonZeroUsize;
use std::sync::Arc;

use fixture::{Parts, motion};
use nalgebra::DMatrix;
use seismass::{
    Block, Control, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, Options, PeakOriented,
    PlaneMotion, PlaneScene, Rack, Run, Scene, SlidingBase, SpringLaw, Stops, Storey, Wear, simulate, simulate_general,
    simulate_general_each, simulate_many, simulate_plane, simulate_plane_each,
};

/// All that a run can give back.
fn options() -> Options {
    Options { histories: NonZeroUsize::new(3), energy: true, events: true, ..Options::default() }
}

/// A value, named, with a change of one of its fields.
type Twin<T> = (&'static str, fn(&mut T));

/// What differs, the run of a base, and that of its twin.
type Pair = (String, Run, Run);

/// Numbers, names and absent values by the path of types and fields that leads to them, as `Debug` prints them: a field
/// that is added is here by itself.
fn leaves(value: &impl Debug) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut path: Vec<String> = Vec::new();
    for line in format!("{value:#?}").lines() {
        let line = line.trim().trim_end_matches(',');
        if matches!(line, "}" | ")" | "]") {
            path.pop();
            continue;
        }
        let (field, rest) = line.split_once(": ").map_or(("", line), |(field, rest)| (field, rest));
        let name = rest.trim_end_matches(['{', '(', '[']).trim();
        let parts = [field, if name.len() < rest.len() { name } else { "" }];
        let step = parts.into_iter().filter(|part| !part.is_empty() && *part != "Some").collect::<Vec<_>>().join(".");
        if name.len() < rest.len() {
            path.push(step);
        } else {
            let place = path.iter().chain([&step]).filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>();
            found.entry(place.join(".")).or_default().push(rest.to_owned());
        }
    }
    found
}

/// Asserts that each field of the bases is another one in one of the twins.
fn assert_every_field_has_a_twin<T: Debug>(bases: &[T], twins: &[(usize, T)]) {
    let bases: Vec<_> = bases.iter().map(leaves).collect();
    let mut missing: BTreeSet<&String> = bases.iter().flat_map(BTreeMap::keys).collect();
    for (base, twin) in twins {
        let twin = leaves(twin);
        missing.retain(|path| bases[*base].get(*path) == twin.get(*path));
    }
    // The sizes of a matrix are those of the building.
    missing.retain(|path| !path.ends_with("nrows.Dyn") && !path.ends_with("ncols.Dyn"));
    assert!(missing.is_empty(), "without a twin: {missing:#?}");
}

/// Asserts that the runs of twins differ from those of their bases, and that in a batch each run is the run alone: in both
/// orders, on one thread and on two.
fn assert_twins<T: Debug>(
    (runs, twins): (Vec<Run>, Vec<Pair>),
    alone: impl Fn(&Run) -> T,
    batch: impl Fn(&[Run], usize) -> Vec<seismass::Result<T>>,
) {
    let expected: Vec<String> = runs.iter().map(|run| format!("{:?}", alone(run))).collect();
    let of = |run: &Run| &expected[runs.iter().position(|other| other == run).unwrap()];
    for (name, base, twin) in &twins {
        assert!(of(base) != of(twin), "{name} changes no result");
    }
    let mut order: Vec<usize> = (0..runs.len()).collect();
    for threads in [1, 2] {
        let ordered: Vec<Run> = order.iter().map(|&i| runs[i]).collect();
        for (&i, found) in order.iter().zip(batch(&ordered, threads)) {
            assert!(format!("{:?}", found.unwrap()) == expected[i], "{:?} on {threads} threads", runs[i]);
        }
        order.reverse();
    }
}

/// The motion multiplied by the factor of a run, as a caller would.
fn times(motion: &Motion, factor: f64) -> Motion {
    let times = |samples: &[f64]| -> Vec<f64> { samples.iter().map(|a| factor * a).collect() };
    Motion::new(times(motion.acceleration()), motion.dt(), motion.vertical().map(|v| times(v).into())).unwrap()
}

/// A sample of each component, the time step, and the vertical component as a whole.
fn changed_motions(motion: &Motion) -> Vec<Motion> {
    let changed = |samples: &[f64]| -> Vec<f64> {
        let mut samples = samples.to_vec();
        samples[201] += 0.7;
        samples
    };
    let (horizontal, vertical) = (motion.acceleration(), motion.vertical().unwrap());
    let made = |horizontal: &[f64], dt: f64, vertical: Option<&[f64]>| {
        Motion::new(horizontal, dt, vertical.map(Into::into)).unwrap()
    };
    vec![
        made(&changed(horizontal), motion.dt(), Some(vertical)),
        made(horizontal, 1.013 * motion.dt(), Some(vertical)),
        made(horizontal, motion.dt(), Some(&changed(vertical))),
        made(horizontal, motion.dt(), None),
        made(&[horizontal, vertical].concat(), motion.dt(), None),
    ]
}

/// Runs of every base under every motion, of the twins under the first, and of factors; and pairs of a base and a twin.
fn runs_of(bases: usize, twins: &[(usize, &str)], motions: usize) -> (Vec<Run>, Vec<Pair>) {
    let mut runs: Vec<Run> = (0..bases).map(|base| Run::new(base, 0)).collect();
    let mut pairs = Vec::new();
    for (i, (base, name)) in twins.iter().enumerate() {
        pairs.push(((*name).to_owned(), Run::new(*base, 0), Run::new(bases + i, 0)));
    }
    for motion in 1..motions {
        pairs.push((format!("motion {motion}"), Run::new(0, 0), Run::new(0, motion)));
    }
    for scale in [-1.0, 0.83] {
        pairs.push((format!("factor {scale}"), Run::new(0, 0), Run { scale, ..Run::new(0, 0) }));
    }
    runs.extend(pairs.iter().map(|(.., twin)| *twin));
    assert_every_field_has_a_twin(&runs[..1], &runs.iter().map(|&run| (0, run)).collect::<Vec<_>>());
    // Equal runs are solved once.
    runs.push(runs[0]);
    (runs, pairs)
}

/// Every law of springs; Rayleigh damping; P-Delta from loads.
fn with_laws() -> Parts {
    let laws = [
        SpringLaw::Gap { clearance: 0.00713, stop_stiffness: 1.09e5 },
        SpringLaw::PeakOriented(PeakOriented {
            unloading_exponent: 0.347,
            energy_capacity: 9.7,
            residual_strength: 0.223,
        }),
        SpringLaw::FlagShaped { flag_height: 0.659 },
    ];
    let mut parts = Parts::new();
    for (storey, law) in parts.storeys.iter_mut().zip(laws) {
        storey.law = law;
    }
    parts.storeys.push(Storey::multilinear([[0.0053, 1063.0], [0.0139, 2017.0], [0.0487, 2903.0]]));
    parts.mass.push(523.0);
    parts.blocks.truncate(3);
    parts.blocks[1].wear.clear();
    parts.damping = Damping::Rayleigh { ratio: 0.0359, modes: [1, 3] };
    let heights = vec![4.3, 3.7, 3.1, 2.9];
    parts.gravity = GravityEffect::Loads { heights, floor_loads: vec![1.21e4, 1.01e4, 7.7e3, 5.9e3] };
    (parts.initial_drift, parts.initial_velocity) = (vec![0.0; 4], vec![0.0; 4]);
    Parts { collapse_drift: None, ..parts }
}

/// A damping matrix of the user's own; no P-Delta, no blocks.
fn with_matrix() -> Parts {
    let matrix = [[2910.0, -1130.0, -127.0], [-1130.0, 2570.0, -811.0], [-127.0, -811.0, 1490.0]];
    Parts {
        damping: Damping::Matrix(DMatrix::from_fn(3, 3, |i, j| matrix[i][j])),
        gravity: GravityEffect::None,
        blocks: Vec::new(),
        ..Parts::new()
    }
}

/// A storey whose law has the numbers of another law: a trilinear one that yields at 1 N of 2^18 N/m and keeps half of it has
/// the tangents of a flag-shaped one that yields at 2^17 N, and its element the yield force and height of that flag.
fn with_equal_numbers() -> Parts {
    let mut parts = Parts::new();
    let stiffness = 2_f64.powi(18);
    parts.storeys[1] = Storey { second_slope: 0.5, third_slope: 0.5, ..Storey::yielding(stiffness, 1.0) };
    Parts { initial_drift: vec![0.0; 3], ..parts }
}

/// Where a variant stands in its enum. A new one does not compile until it has a base.
fn variants(parts: &Parts) -> BTreeSet<&'static str> {
    let of_law = |storey: &Storey| match storey.law {
        SpringLaw::Trilinear => "trilinear",
        SpringLaw::Multilinear { .. } => "multilinear",
        SpringLaw::Gap { .. } => "gap",
        SpringLaw::PeakOriented(_) => "peak-oriented",
        SpringLaw::FlagShaped { .. } => "flag-shaped",
    };
    let damping = match parts.damping {
        Damping::Modal { .. } => "modal",
        Damping::Rayleigh { .. } => "Rayleigh",
        Damping::Matrix(_) => "matrix",
    };
    let gravity = match parts.gravity {
        GravityEffect::None => "no P-Delta",
        GravityEffect::GeometricStiffness(_) => "geometric stiffness",
        GravityEffect::Loads { .. } => "loads",
    };
    parts.storeys.iter().map(of_law).chain([damping, gravity]).collect()
}

const TWINS: &[Twin<Parts>] = &[
    ("mass", |p| p.mass[1] *= 1.01),
    ("stiffness", |p| p.storeys[1].stiffness *= 1.01),
    ("yield shear", |p| p.storeys[1].yield_shear *= 0.97),
    ("overstrength", |p| p.storeys[2].overstrength = 1.13),
    ("second slope", |p| p.storeys[2].second_slope = 0.0937),
    ("third slope", |p| (p.storeys[2].overstrength, p.storeys[2].third_slope) = (1.03, 0.0239)),
    ("damping ratio", |p| p.damping = Damping::Modal { ratio: 0.0431 }),
    ("geometric stiffness", |p| p.gravity = GravityEffect::GeometricStiffness(vec![8.87e3, 6.43e3, 3.41e3])),
    ("no geometric stiffness", |p| p.gravity = GravityEffect::None),
    ("floor of a block", |p| p.blocks[1].floor = 2),
    ("floors of two blocks", |p| (p.blocks[1].floor, p.blocks[2].floor) = (3, 1)),
    ("mass of a block", |p| p.blocks[2].mass *= 1.01),
    ("mu_s", |p| p.blocks[2].mu_s = 0.259),
    ("mu_k", |p| p.blocks[2].mu_k = 0.217),
    ("velocity of a block", |p| p.blocks[0].velocity = Some(0.0587)),
    ("no velocity of a block", |p| p.blocks[0].velocity = None),
    ("path of wear", |p| p.blocks[1].wear[0].path = 0.0223),
    ("mu_s of wear", |p| p.blocks[1].wear[0].mu_s = 0.167),
    ("mu_k of wear", |p| p.blocks[1].wear[0].mu_k = 0.139),
    ("no wear", |p| p.blocks[1].wear.clear()),
    ("another stage of wear", |p| p.blocks[1].wear.push(Wear { path: 0.0367, mu_s: 0.137, mu_k: 0.119 })),
    ("wear of another block", |p| p.blocks[3].wear = std::mem::take(&mut p.blocks[1].wear)),
    ("a block less", |p| drop(p.blocks.pop())),
    ("drift at the start", |p| p.initial_drift[1] = -0.00131),
    ("velocity at the start", |p| p.initial_velocity[1] = -0.0233),
    ("collapse drift", |p| p.collapse_drift = Some(vec![0.937, 0.0161, 0.709])),
];

const TWINS_WITH_LAWS: &[Twin<Parts>] = &[
    ("clearance", |p| p.storeys[0].law = SpringLaw::Gap { clearance: 0.00733, stop_stiffness: 1.09e5 }),
    ("stop stiffness", |p| p.storeys[0].law = SpringLaw::Gap { clearance: 0.00713, stop_stiffness: 1.13e5 }),
    ("no gap", |p| p.storeys[0].law = SpringLaw::Trilinear),
    ("unloading exponent", |p| peak_oriented(p).unloading_exponent = 0.353),
    ("energy capacity", |p| peak_oriented(p).energy_capacity = 9.9),
    ("residual strength", |p| peak_oriented(p).residual_strength = 0.241),
    ("flag height", |p| p.storeys[2].law = SpringLaw::FlagShaped { flag_height: 0.643 }),
    ("no flag", |p| p.storeys[2].law = SpringLaw::Trilinear),
    ("backbone", |p| p.storeys[3] = Storey::multilinear([[0.0053, 1063.0], [0.0141, 2017.0], [0.0487, 2903.0]])),
    ("Rayleigh ratio", |p| p.damping = Damping::Rayleigh { ratio: 0.0367, modes: [1, 3] }),
    ("Rayleigh modes", |p| p.damping = Damping::Rayleigh { ratio: 0.0359, modes: [1, 2] }),
    ("heights", |p| loads(p).0[2] = 3.3),
    ("floor loads", |p| loads(p).1[2] = 7.9e3),
];

const TWINS_WITH_MATRIX: &[Twin<Parts>] = &[
    ("damping matrix", |p| {
        let Damping::Matrix(matrix) = &mut p.damping else { panic!("the base has a matrix") };
        matrix[(1, 1)] *= 1.01;
    }),
    ("a block", |p| p.blocks.push(Block::new(2, 431.0, 0.197))),
];

const TWINS_WITH_EQUAL_NUMBERS: &[Twin<Parts>] = &[("kind of a law", |p| {
    (p.storeys[1].yield_shear, p.storeys[1].law) = (2_f64.powi(17), SpringLaw::FlagShaped { flag_height: 0.5 });
})];

fn peak_oriented(parts: &mut Parts) -> &mut PeakOriented {
    let SpringLaw::PeakOriented(law) = &mut parts.storeys[1].law else { panic!("storey 2 is peak-oriented") };
    law
}

fn loads(parts: &mut Parts) -> (&mut Vec<f64>, &mut Vec<f64>) {
    let GravityEffect::Loads { heights, floor_loads } = &mut parts.gravity else { panic!("the base has loads") };
    (heights, floor_loads)
}

fn twins_of<T: Clone>(base: &T, index: usize, twins: &[Twin<T>]) -> Vec<(usize, &'static str, T)> {
    let made = twins.iter().map(|(name, change)| {
        let mut twin = base.clone();
        change(&mut twin);
        (index, *name, twin)
    });
    made.collect()
}

#[test]
fn shear_buildings() {
    let bases = [Parts::new(), with_laws(), with_matrix(), with_equal_numbers()];
    let covered: BTreeSet<&str> = bases.iter().flat_map(variants).collect();
    assert_eq!(covered.len(), 11, "{covered:?}: each variant has a base");
    let lists = [TWINS, TWINS_WITH_LAWS, TWINS_WITH_MATRIX, TWINS_WITH_EQUAL_NUMBERS];
    let twins: Vec<_> =
        bases.iter().zip(lists).enumerate().flat_map(|(i, (base, twins))| twins_of(base, i, twins)).collect();
    let scenes: Vec<Scene> = bases.iter().chain(twins.iter().map(|(.., parts)| parts)).map(Parts::scene).collect();
    let of_twins: Vec<_> =
        twins.iter().zip(&scenes[bases.len()..]).map(|((base, ..), scene)| (*base, scene.clone())).collect();
    assert_every_field_has_a_twin(&scenes[..bases.len()], &of_twins);
    let mut motions = vec![motion()];
    motions.extend(changed_motions(&motions[0]));
    assert_every_field_has_a_twin(&motions[..1], &motions.iter().map(|m| (0, m.clone())).collect::<Vec<_>>());
    let names: Vec<_> = twins.iter().map(|(base, name, _)| (*base, *name)).collect();
    let runs = runs_of(bases.len(), &names, motions.len());
    let alone = |run: &Run| simulate(&scenes[run.scene], &times(&motions[run.motion], run.scale), &options()).unwrap();
    assert_twins(runs, alone, |runs, threads| {
        simulate_many(&scenes, &motions, runs, &options(), Some(threads), &Control::default()).unwrap()
    });
}

/// What a scene of the general engine is made of.
#[derive(Clone)]
struct GeneralParts {
    shear: Parts,
    matrix: Option<DMatrix<f64>>,
    stops: Option<Stops>,
    rack: Rack,
    base: Option<SlidingBase>,
}

impl GeneralParts {
    fn new() -> Self {
        let level =
            |stiffness, yield_shear| Storey { second_slope: 0.0613, ..Storey::yielding(stiffness, yield_shear) };
        let rack = Rack {
            floor: 2,
            mass: vec![47.0, 38.3],
            levels: vec![level(3.37e4, 331.0), level(2.71e4, 257.0)],
            damping_ratio: 0.0293,
            geometric_stiffness: vec![719.0, 523.0],
            goods: vec![Block { mu_k: 0.181, ..Block::new(2, 83.0, 0.229) }.into()],
        };
        let mut shear = Parts::new();
        shear.collapse_drift = Some(vec![0.937, 0.823, 0.709]);
        let matrix = [[7.9e4, -4.1e4, 1.3e4], [-4.1e4, 6.7e4, -2.3e4], [1.3e4, -2.3e4, 3.1e4]];
        Self {
            shear,
            matrix: Some(DMatrix::from_fn(3, 3, |i, j| matrix[i][j])),
            stops: Some(Stops { clearance: [0.0191, 0.0149], stiffness: 6.1e4, damping: 443.0 }),
            rack,
            base: None,
        }
    }

    fn scene(&self) -> GeneralScene {
        let Self { shear, matrix, stops, rack, base } = self.clone();
        let Parts { mass, storeys, damping, gravity, blocks, initial_drift, initial_velocity, collapse_drift } = shear;
        let building = GeneralBuilding::new(mass, storeys, matrix, &damping, gravity).unwrap();
        let mut goods: Vec<Goods> = blocks.into_iter().map(Goods::from).collect();
        goods[2].stops = stops;
        let scene = GeneralScene::on_base(Some(Arc::new(building)), goods, vec![rack], base).unwrap();
        let scene = scene.with_initial(initial_drift, initial_velocity).unwrap();
        scene.with_collapse_drift(collapse_drift.unwrap()).unwrap()
    }
}

const OF_STRUCTURES: &[Twin<GeneralParts>] = &[
    ("law of a storey", |p| p.shear.storeys[0].law = SpringLaw::FlagShaped { flag_height: 0.659 }),
    ("elastic matrix", |p| p.matrix.as_mut().unwrap()[(1, 1)] *= 1.01),
    ("no elastic matrix", |p| p.matrix = None),
    ("clearance towards minus", |p| p.stops.as_mut().unwrap().clearance[0] = 0.0179),
    ("clearance towards plus", |p| p.stops.as_mut().unwrap().clearance[1] = 0.0157),
    ("stiffness of stops", |p| p.stops.as_mut().unwrap().stiffness *= 1.01),
    ("damping of stops", |p| p.stops.as_mut().unwrap().damping *= 1.01),
    ("no stops", |p| p.stops = None),
    ("floor of the rack", |p| p.rack.floor = 1),
    ("mass of a level", |p| p.rack.mass[0] *= 1.01),
    ("stiffness of a level", |p| p.rack.levels[0].stiffness *= 1.01),
    ("strength of a level", |p| p.rack.levels[0].yield_shear *= 0.97),
    ("overstrength of a level", |p| p.rack.levels[0].overstrength = 1.03),
    ("second slope of a level", |p| p.rack.levels[0].second_slope = 0.0631),
    ("third slope of a level", |p| {
        (p.rack.levels[0].overstrength, p.rack.levels[0].third_slope) = (1.03, 0.0239);
    }),
    ("law of a level", |p| p.rack.levels[0].law = SpringLaw::FlagShaped { flag_height: 0.643 }),
    ("damping of the rack", |p| p.rack.damping_ratio = 0.0307),
    ("geometric stiffness of the rack", |p| p.rack.geometric_stiffness[0] = 727.0),
    ("level of goods", |p| p.rack.goods[0].block.floor = 1),
    ("mass of goods", |p| p.rack.goods[0].block.mass *= 1.01),
    ("mu_s of goods", |p| p.rack.goods[0].block.mu_s = 0.223),
    ("mu_k of goods", |p| p.rack.goods[0].block.mu_k = 0.187),
    ("velocity of goods", |p| p.rack.goods[0].block.velocity = Some(0.0613)),
    ("wear of goods", |p| p.rack.goods[0].block.wear = vec![Wear { path: 0.0131, mu_s: 0.167, mu_k: 0.139 }]),
    ("stops of goods", |p| p.rack.goods[0].stops = Some(Stops::new(0.0109, 2.3e4))),
    ("a base", |p| p.base = Some(base())),
];

const OF_BASES: &[Twin<GeneralParts>] = &[
    ("mass of the base", |p| p.base.as_mut().unwrap().mass *= 1.01),
    ("mu_s of the base", |p| p.base.as_mut().unwrap().mu_s = 0.173),
    ("mu_k of the base", |p| p.base.as_mut().unwrap().mu_k = 0.131),
    ("radius of the base", |p| p.base.as_mut().unwrap().radius = 1.97),
];

fn base() -> SlidingBase {
    SlidingBase { mass: 1490.0, mu_s: 0.179, mu_k: 0.137, radius: 1.93 }
}

/// Twins of the shear building, as twins of a structure that has it.
fn of_shear(base: &GeneralParts) -> Vec<(usize, &'static str, GeneralParts)> {
    let twins = twins_of(&base.shear, 0, TWINS).into_iter();
    twins.map(|(index, name, shear)| (index, name, GeneralParts { shear, ..base.clone() })).collect()
}

#[test]
fn structures() {
    let first = GeneralParts::new();
    let bases = [first.clone(), GeneralParts { base: Some(base()), ..first }];
    let mut twins = of_shear(&bases[0]);
    twins.extend(twins_of(&bases[0], 0, OF_STRUCTURES));
    twins.extend(twins_of(&bases[1], 1, OF_BASES));
    let scenes: Vec<GeneralScene> =
        bases.iter().chain(twins.iter().map(|(.., parts)| parts)).map(GeneralParts::scene).collect();
    let of_twins: Vec<_> =
        twins.iter().zip(&scenes[bases.len()..]).map(|((base, ..), scene)| (*base, scene.clone())).collect();
    assert_every_field_has_a_twin(&scenes[..bases.len()], &of_twins);
    let mut motions = vec![motion()];
    motions.extend(changed_motions(&motions[0]));
    let names: Vec<_> = twins.iter().map(|(base, name, _)| (*base, *name)).collect();
    let runs = runs_of(bases.len(), &names, motions.len());
    let alone =
        |run: &Run| simulate_general(&scenes[run.scene], &times(&motions[run.motion], run.scale), &options()).unwrap();
    assert_twins(runs, alone, |runs, threads| {
        let control = Control::default();
        simulate_general_each(&scenes, &motions, runs, &options(), Some(threads), &control, |r| r).unwrap()
    });
}

/// In two directions, which may differ in what is no mass: springs, damping, stops, states.
#[test]
fn two_directions() {
    let first = GeneralParts::new();
    let of = |change: fn(&mut GeneralParts)| {
        let (x, mut y) = (first.clone(), first.clone());
        change(&mut y);
        PlaneScene::new(x.scene(), y.scene()).unwrap()
    };
    let mut scenes = vec![of(|_| {})];
    let mut names = Vec::new();
    let may_differ = ["elastic", "no elastic", "clearance", "stiffness", "strength", "damping", "velocity", "stops"];
    for (name, change) in OF_STRUCTURES.iter().filter(|(name, _)| may_differ.iter().any(|part| name.contains(part))) {
        scenes.push(of(*change));
        names.push((0, *name));
    }
    assert!(names.len() > 9, "{names:?}");
    let x = motion().with_duration(2.4).unwrap();
    let y: Vec<f64> = x.acceleration().iter().rev().map(|a| 0.77 * a).collect();
    let mut motions = vec![PlaneMotion::new(x.clone(), y.clone()).unwrap()];
    for changed in changed_motions(&x) {
        let y: Vec<f64> = y.iter().copied().cycle().take(changed.acceleration().len()).collect();
        motions.push(PlaneMotion::new(changed, y).unwrap());
    }
    motions.push(PlaneMotion::new(x, y.iter().map(|a| 1.01 * a).collect::<Vec<_>>()).unwrap());
    assert_every_field_has_a_twin(&motions[..1], &motions.iter().map(|m| (0, m.clone())).collect::<Vec<_>>());
    let runs = runs_of(1, &names, motions.len());
    let alone = |run: &Run| {
        let [x, y] = motions[run.motion].directions();
        let motion = PlaneMotion::new(times(x, run.scale), times(y, run.scale).acceleration()).unwrap();
        simulate_plane(&scenes[run.scene], &motion, &options()).unwrap()
    };
    assert_twins(runs, alone, |runs, threads| {
        let control = Control::default();
        simulate_plane_each(&scenes, &motions, runs, &options(), Some(threads), &control, |r| r).unwrap()
    });
}

/// The fixture is what it says, and a field that has no twin is found.
#[test]
fn no_two_quantities_are_equal_or_in_a_round_ratio() {
    let parts = leaves(&Parts::new());
    let is_quantity = |path: &str| !path.ends_with("floor") && !path.ends_with("modes");
    let quantities: Vec<(&String, f64)> = parts
        .iter()
        .filter(|(path, _)| is_quantity(path))
        .flat_map(|(path, values)| values.iter().filter_map(move |v| Some((path, v.parse::<f64>().ok()?.abs()))))
        .collect();
    assert!(quantities.len() > 40, "{}", quantities.len());
    for (i, (path, a)) in quantities.iter().enumerate() {
        for (other, b) in &quantities[..i] {
            let ratio = (a / b).max(b / a);
            let is_round = ratio < 10.5 && (ratio - ratio.round()).abs() < 1e-3;
            assert!(!is_round, "{path} {a} and {other} {b} have the ratio {ratio}");
        }
    }
    let field = leaves(&Some(Block::new(1, 2.0, 0.3)));
    assert_eq!(field["Block.mu_k"], ["0.3"]);
    assert_eq!(field["Block.velocity"], ["None"]);
    let without = std::panic::catch_unwind(|| {
        assert_every_field_has_a_twin(&[Block::new(1, 2.0, 0.3)], &[(0, Block::new(2, 2.0, 0.3))]);
    });
    assert!(without.is_err());
}
