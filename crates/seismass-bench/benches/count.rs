//! One piece of work in a function of its own, for a profiler that counts instructions: `make count-instructions`.
//!
//! Usage: count WORK SCENE, with a scene of `common`. Prints what was done as names and numbers. WORK is
//!
//! - run: peaks only, as a batch solves it, on this thread;
//! - mirrored: the run and its mirror image, which meets the same regimes and finds them in the cache;
//! - calm: the run under the motion scaled down so far that no event happens;
//! - continued: calm, the motion followed by nine tenths of it, which beats no peak: plain steps are all it adds;
//! - histories: with all of them;
//! - leapfrog: one pass of the half-explicit leapfrog at the step of the motion;
//! - spectrum: 200 periods and 5 damping ratios of the motion; the scene plays no part.

mod common;

use std::hint::black_box;
use std::num::NonZeroUsize;

use common::{Result, case};
use seismass::reference::{Method, integrate};
use seismass::spectrum::response_spectra;
use seismass::{Control, Motion, Options, Response, Run, Scene, simulate_many};

/// Factor of a motion under which nothing yields and nothing slides.
const CALM: f64 = 0.01;

/// Solves a scene under each motion, as a batch of as many scenes.
fn solve(scenes: &[Scene], motions: &[Motion], options: &Options) -> seismass::Result<Vec<Response>> {
    let runs: Vec<_> = (0..scenes.len()).map(|i| Run::new(i, i)).collect();
    simulate_many(scenes, motions, &runs, options, None, &Control::default())?.into_iter().collect()
}

/// The frame that the profiler counts in: called once.
#[inline(never)]
fn counted<T>(work: impl FnOnce() -> T) -> T {
    black_box(work())
}

fn times(motion: &Motion, factor: f64) -> impl Iterator<Item = f64> + '_ {
    motion.acceleration().iter().map(move |a| factor * a)
}

fn print(name: &str, value: usize) {
    println!("{name} {value}");
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let [work, scene] = &arguments[..] else { return Err("usage: count WORK SCENE".into()) };
    let case = case(scene)?;
    let motion = case.motion.clone();
    let dt = motion.dt();
    // Tasks of a batch stay on the thread that counts.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build()?;
    let batch = |motions: Vec<Motion>, options: Options| -> Result<()> {
        let scenes = vec![case.scene.clone(); motions.len()];
        let responses = pool.install(|| counted(|| solve(&scenes, &motions, &options)))?;
        let sum = |of: fn(&Response) -> usize| responses.iter().map(of).sum();
        print("plain_steps", sum(|r| r.statistics.plain_steps));
        print("series_steps", sum(|r| r.statistics.series_steps));
        print("events", sum(|r| r.statistics.events.total()));
        print("regimes", sum(|r| r.statistics.regimes));
        Ok(())
    };
    print("samples", motion.acceleration().len());
    match work.as_str() {
        "run" => batch(vec![motion], Options::PEAKS)?,
        "mirrored" => {
            let mirrored = Motion::new(times(&motion, -1.0).collect::<Vec<_>>(), dt, None)?;
            batch(vec![motion, mirrored], Options::PEAKS)?;
        }
        "calm" => batch(vec![Motion::new(times(&motion, CALM).collect::<Vec<_>>(), dt, None)?], Options::PEAKS)?,
        "continued" => {
            let longer: Vec<f64> = times(&motion, CALM).chain(times(&motion, 0.9 * CALM)).collect();
            batch(vec![Motion::new(longer, dt, None)?], Options::PEAKS)?;
        }
        "histories" => batch(vec![motion], Options { histories: Some(NonZeroUsize::MIN), ..Options::default() })?,
        "leapfrog" => {
            let history = counted(|| integrate(&case.scene, &motion, &Method::Leapfrog { substeps: 1 }))?;
            print("steps", history.steps);
        }
        "spectrum" => {
            let periods: Vec<f64> = (0..200).map(|i| 0.05 * 100f64.powf(f64::from(i) / 199.0)).collect();
            let damping = [0.01, 0.02, 0.05, 0.1, 0.2];
            let motions = [motion];
            let spectra = || response_spectra(&motions, &periods, &damping, None, &Control::default());
            print("oscillators", pool.install(|| counted(spectra))?.len());
        }
        _ => return Err(format!("work must be one of those in the first lines of this file; got {work}").into()),
    }
    Ok(())
}
