//! Shows whether two machines give the same bits: `tests/same_bits.rs` and `tools/test-aarch64` compare what it prints.
//!
//! Usage: bits SCENES. Prints the instructions in use and, of so many scenes, the seed, storeys, events and a hash of every
//! number of the response, and of the response spectra of the motion.

use std::error::Error;
use std::hash::{DefaultHasher, Hasher};
use std::num::NonZeroUsize;

use seismass::spectrum::response_spectra;
use seismass::{Control, InstructionSet, Options, simulate};
use seismass_judge::portable_scene::portable_scene;

/// Of response spectra (s): below and above the step from which on they are not by series.
const PERIODS: [f64; 6] = [0.01, 0.03, 0.1, 0.4, 1.0, 3.0];
const DAMPING: [f64; 3] = [0.0, 0.05, 0.3];

fn main() -> Result<(), Box<dyn Error>> {
    let scenes: u64 = std::env::args().nth(1).ok_or("usage: bits SCENES")?.parse()?;
    println!("{}", InstructionSet::in_use().name());
    let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
    for seed in 0..scenes {
        let (scene, motion) = portable_scene(seed)?;
        let response = simulate(&scene, &motion, &options)?;
        let spectra = response_spectra(&[motion], &PERIODS, &DAMPING, Some(1), &Control::default())?;
        // Numbers are written so that they round-trip.
        let mut hasher = DefaultHasher::new();
        hasher.write(format!("{response:?} {spectra:?}").as_bytes());
        println!("{seed} {} {} {:016x}", scene.storeys(), response.statistics.events.total(), hasher.finish());
    }
    Ok(())
}
