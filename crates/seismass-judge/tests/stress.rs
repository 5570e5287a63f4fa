//! A slice of the stress suite that two slow cores run in two minutes: all named cases, and random
//! scenes with seeds far from those of the full run.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use seismass_judge::stress::random::{Selection, Tally};
use seismass_judge::stress::{cases, random, report};

/// `SEISMASS_STRESS_SCENES` sets another number of random scenes.
fn scenes() -> u64 {
    std::env::var("SEISMASS_STRESS_SCENES").map_or(2000, |n| n.parse().unwrap())
}

#[test]
fn every_named_case_meets_its_expectation() {
    let findings = cases::run(&cases::all());
    println!("{}", report::table(&findings));
    let failed: Vec<_> = findings.iter().filter(|f| f.outcome.is_err()).map(|f| (f.case.name, &f.outcome)).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn random_scenes_are_consistent_and_agree_with_the_judge() {
    let mut tally = Tally::default();
    random::run(Selection { first: 1_000_000_000, scenes: scenes(), judged: 0.1 }, &mut tally);
    println!("{}", report::distribution(&tally));
    assert!(tally.defects.is_empty(), "{:#?}", tally.defects);
    assert!(tally.judged > 0 && tally.balanced > 0 && tally.families.iter().all(|&n| n > 0));
}

/// Seeds that once failed: chatter at the start of a run, a breakaway at N = 0 within rounding, a lift at an arrival, a
/// frictionless block on a floor whose acceleration begins below rounding, an arrival just before a lift, other bits without
/// energies under vertical motion.
#[test]
fn seeds_that_once_failed_hold() {
    for seed in [1209, 14749, 22984, 24647, 29706, 55104, 71144, 130_978, 144_318, 219_850, 297_876, 529_744, 638_979] {
        let mut tally = Tally::default();
        random::run(Selection { first: seed, scenes: 1, judged: 1.0 }, &mut tally);
        assert!(tally.defects.is_empty(), "{:#?}", tally.defects);
    }
}

/// Undamped storeys that turn at their yield force cycle after cycle, and a block under g + a_v that nearly vanishes:
/// rounding decides whether they are to be explained, but they are no defects.
#[test]
fn grazes_of_undamped_storeys_and_cancelled_gravity_are_no_defects() {
    for seed in [84_999, 887_908, 900_235, 700_482] {
        let mut tally = Tally::default();
        random::run(Selection { first: seed, scenes: 1, judged: 1.0 }, &mut tally);
        println!("{}", report::distribution(&tally));
        assert!(tally.defects.is_empty(), "{:#?}", tally.defects);
    }
}

/// Blocks that come to rest within rounding of a landing, among accelerations of 1e-36 m/s2: the order of events differs
/// from the judge's, but the run goes on.
#[test]
fn a_landing_below_all_rounding_runs() {
    let mut tally = Tally::default();
    random::run(Selection { first: 354_294, scenes: 1, judged: 0.0 }, &mut tally);
    assert!(tally.defects.is_empty(), "{:#?}", tally.defects);
}

#[test]
fn a_tally_goes_on_where_it_stopped() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tally.tsv");
    let mut tally = Tally::default();
    random::run(Selection { first: 0, scenes: 60, judged: 0.2 }, &mut tally);
    tally.grazing.push((1, 1.0, "a graze".into()));
    tally.sensitive.push((2, 4.0, "a sensitive scene".into()));
    tally.pairs.push((3, 16.0, "pairs".into()));
    tally.cancelled.push((4, 9.3e-9, 1.1e-11));
    tally.defects.push((5, "a defect".into()));
    tally.save(&path).unwrap();
    let again = Tally::load(&path).unwrap();
    assert_eq!(report::distribution(&again), report::distribution(&tally));
    assert_eq!(again.events, tally.events);
    std::fs::write(&path, "no tally").unwrap();
    assert!(Tally::load(&path).is_err());
}
