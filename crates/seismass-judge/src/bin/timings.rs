//! Times the kernel beside what it is compared with, in one process: `benchmarks/performance.py` builds and runs it.
//!
//! Usage: timings WORK FILE SECONDS, with a scene as text ([`scene_text`]) and the time to spend. Prints names and numbers; what
//! is compared takes turns, and times are medians (s). WORK is
//!
//! - runs: the exact run with peaks only, with histories of drift and slip, and with all; and one pass of the leapfrog at the motion's own step;
//! - steps: a plain step of a building of 4 storeys, and the bare chain y = P x + c of the same size;
//! - threads: a loop of pure arithmetic on one thread and its two copies on two; the scene plays no part.

use std::error::Error;
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use seismass::reference::{Method, integrate};
use seismass::{InstructionSet, Motion, Options, Response, Scene, simulate};
use seismass_judge::scene_text;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Turns that are taken whatever they cost.
const LEAST_TURNS: usize = 5;
/// Factor of a motion under which nothing yields and nothing slides.
const CALM: f64 = 0.01;
/// Storeys of the building whose step is compared with the bare chain.
const STOREYS: usize = 4;
/// Steps of the bare chain between two looks at the clock.
const CHAIN_STEPS: usize = 4000;
/// Dependent multiplications between two looks at the clock, of the cycles below each.
const MULTIPLICATIONS: usize = 100_000;
/// Latency of a 64-bit multiplication and an exclusive or on x86-64 cores of the last ten years.
const CYCLES_OF_MULTIPLICATION: f64 = 4.0;

/// Median time of each work (s): they take turns for so many seconds, after one turn that does not count.
fn alternate(seconds: f64, works: &mut [&mut dyn FnMut() -> Outcome<()>]) -> Outcome<Vec<f64>> {
    let mut times = vec![Vec::new(); works.len()];
    for work in works.iter_mut() {
        work()?;
    }
    let began = Instant::now();
    while began.elapsed().as_secs_f64() < seconds || times[0].len() < LEAST_TURNS {
        for (work, times) in works.iter_mut().zip(&mut times) {
            let before = Instant::now();
            work()?;
            times.push(before.elapsed().as_secs_f64());
        }
    }
    Ok(times.into_iter().map(median).collect())
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn print(name: &str, value: f64) {
    println!("{name} {value:?}");
}

fn print_work(response: &Response) {
    let done = &response.statistics;
    print("plain_steps", done.plain_steps as f64);
    print("series_steps", done.series_steps as f64);
    print("events", done.events.total() as f64);
    print("regimes", done.regimes as f64);
}

fn runs(scene: &Scene, motion: &Motion, seconds: f64) -> Outcome<()> {
    let histories = Options { histories: Some(NonZeroUsize::MIN), ..Options::default() };
    let displacements = Options { displacements_only: true, ..histories };
    let exact = |options: &Options| -> Outcome<()> {
        black_box(simulate(scene, black_box(motion), options)?);
        Ok(())
    };
    let times = alternate(
        seconds,
        &mut [&mut || exact(&Options::PEAKS), &mut || exact(&displacements), &mut || exact(&histories), &mut || {
            black_box(integrate(scene, black_box(motion), &Method::Leapfrog { substeps: 1 })?);
            Ok(())
        }],
    )?;
    print("samples", motion.acceleration().len() as f64);
    print_work(&simulate(scene, motion, &Options::PEAKS)?);
    for (name, time) in ["peaks", "displacements", "histories", "leapfrog"].into_iter().zip(times) {
        print(name, time);
    }
    Ok(())
}

/// A chain of steps y = P x + c: `ROWS` rows, of which the first 2 `STOREYS` are the next step's x.
struct Chain<const ROWS: usize> {
    columns: [[f64; ROWS]; 2 * STOREYS],
    constant: [f64; ROWS],
}

impl<const ROWS: usize> Chain<ROWS> {
    /// Bounded: no row of P sums up to more than 0.8.
    fn new() -> Self {
        let columns = std::array::from_fn(|k| std::array::from_fn(|row| 0.1 * ((3 * k + 5 * row) as f64).cos()));
        Self { columns, constant: std::array::from_fn(|row| 1.0 / (1.0 + row as f64)) }
    }

    /// Two sums per row, so that a step waits for half as many additions.
    fn run(&self, steps: usize) -> [f64; ROWS] {
        let mut y = self.constant;
        for _ in 0..steps {
            let x: [f64; 2 * STOREYS] = std::array::from_fn(|k| y[k]);
            let (mut even, mut odd) = (self.constant, [0.0; ROWS]);
            for k in 0..STOREYS {
                for row in 0..ROWS {
                    even[row] = self.columns[2 * k][row].mul_add(x[2 * k], even[row]);
                    odd[row] = self.columns[2 * k + 1][row].mul_add(x[2 * k + 1], odd[row]);
                }
            }
            y = std::array::from_fn(|row| even[row] + odd[row]);
        }
        y
    }
}

fn scaled(motion: &Motion, factors: &[f64]) -> Outcome<Motion> {
    let samples = factors.iter().flat_map(|factor| motion.acceleration().iter().map(move |a| factor * a));
    Ok(Motion::new(samples.collect::<Vec<_>>(), motion.dt(), None)?)
}

fn multiplications(mut x: u64) -> u64 {
    for i in 0..MULTIPLICATIONS as u64 {
        x = x.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ i;
    }
    x
}

fn steps(scene: &Scene, motion: &Motion, seconds: f64) -> Outcome<()> {
    if scene.storeys() != STOREYS {
        return Err(format!("storeys of the scene must be {STOREYS}; got {}", scene.storeys()).into());
    }
    // What nine tenths of a calm motion add to it beats no peak: plain steps are all they cost.
    let (calm, continued) = (scaled(motion, &[CALM])?, scaled(motion, &[CALM, 0.9 * CALM])?);
    let (of_calm, of_continued) =
        (simulate(scene, &calm, &Options::PEAKS)?.statistics, simulate(scene, &continued, &Options::PEAKS)?);
    let of_continued = of_continued.statistics;
    if of_calm.events.total() > 0 || of_calm.series_steps != of_continued.series_steps {
        return Err("the calm motion has events, or its continuation is not all plain steps".into());
    }
    let run = |motion: &Motion| -> Outcome<()> {
        black_box(simulate(scene, black_box(motion), &Options::PEAKS)?);
        Ok(())
    };
    let state = black_box(Chain::<{ 2 * STOREYS }>::new());
    let state_and_rates = black_box(Chain::<{ 4 * STOREYS }>::new());
    let times = alternate(
        seconds,
        &mut [
            &mut || run(&calm),
            &mut || run(&continued),
            &mut || {
                black_box(black_box(&state).run(CHAIN_STEPS));
                Ok(())
            },
            &mut || {
                black_box(black_box(&state_and_rates).run(CHAIN_STEPS));
                Ok(())
            },
            &mut || {
                black_box(multiplications(black_box(1)));
                Ok(())
            },
        ],
    )?;
    print("step", (times[1] - times[0]) / (of_continued.plain_steps - of_calm.plain_steps) as f64);
    print("chain", times[2] / CHAIN_STEPS as f64);
    print("chain_with_rates", times[3] / CHAIN_STEPS as f64);
    print("frequency", CYCLES_OF_MULTIPLICATION * MULTIPLICATIONS as f64 / times[4]);
    Ok(())
}

/// Sums of eight logistic maps: nothing but multiplications and additions in registers.
fn arithmetic(steps: usize) -> f64 {
    let mut x: [f64; 8] = std::array::from_fn(|lane| black_box(0.1 + 0.1 * lane as f64));
    for _ in 0..steps {
        x = x.map(|x| 3.9 * x * (1.0 - x));
    }
    x.iter().sum()
}

fn threads(seconds: f64) -> Outcome<()> {
    let steps = 20_000_000;
    let on = |copies: usize| {
        std::thread::scope(|scope| {
            for _ in 0..copies {
                scope.spawn(|| black_box(arithmetic(steps)));
            }
        });
        Ok(())
    };
    let times = alternate(seconds, &mut [&mut || on(1), &mut || on(2)])?;
    print("one", times[0]);
    print("two", times[1]);
    Ok(())
}

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, work, file, seconds] = &arguments[..] else { return Err("usage: timings WORK FILE SECONDS".into()) };
    let (scene, motion) = scene_text::read(&std::fs::read_to_string(file)?)?;
    let seconds = seconds.parse()?;
    println!("instructions {}", InstructionSet::in_use().name());
    match work.as_str() {
        "runs" => runs(&scene, &motion, seconds),
        "steps" => steps(&scene, &motion, seconds),
        "threads" => threads(seconds),
        _ => Err(format!("work must be runs, steps or threads; got {work}").into()),
    }
}
