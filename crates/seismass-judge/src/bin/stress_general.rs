//! The stress suite of the general engine: `stress_general --scenes 100000 --judged 2000`. See `--help`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use seismass_judge::general_scene::SLABS;
use seismass_judge::plane_scene::TWINS;
use seismass_judge::stress::general::{Directions, GeneralTally, distribution, page};
use seismass_judge::stress::program;

const HELP: &str = "\
Random scenes with racks, walls and stops against the general engine; exit code 1 if anything is unexplained.

  --plane        scenes in two horizontal directions, and no shear buildings
  --twins        the same with equal goods that start within 1e-8 s of each other, tally target/stress/twins.tsv
  --slabs        sliding bases whose goods lose most of their friction as they slide, tally target/stress/slabs.tsv
  --scenes N     random scenes in all, seeds from 0 (default 100000)
  --judged N     of them, compared with the plain implementation, about (default 2000)
  --chains N     random shear buildings that both engines solve (default 1000)
  --first N      seed to start from (default 0)
  --chunk N      scenes between two printed counts (default 1000)
  --minutes M    stop after the chunk in which so much time has passed
  --tally PATH   tally to go on from and to keep up to date, of the same kernel and the same first seed (default
                 target/stress/general.tsv or plane.tsv); failing seeds are in it
  --write PATH   write the page of docs there
";

struct Arguments {
    directions: Directions,
    scenes: u64,
    judged: u64,
    chains: u64,
    first: u64,
    chunk: u64,
    minutes: f64,
    tally: Option<PathBuf>,
    write: Option<PathBuf>,
}

fn arguments() -> Result<Arguments, String> {
    let mut found = Arguments {
        directions: Directions::One,
        scenes: 100_000,
        judged: 2000,
        chains: 1000,
        first: 0,
        chunk: 1000,
        minutes: f64::INFINITY,
        tally: None,
        write: None,
    };
    let mut given = std::env::args().skip(1);
    while let Some(option) = given.next() {
        if option == "--help" {
            return Err(HELP.into());
        }
        if option == "--plane" || option == "--twins" {
            found.directions = Directions::Two;
            found.first += if option == "--twins" { TWINS } else { 0 };
            continue;
        }
        if option == "--slabs" {
            found.first += SLABS;
            continue;
        }
        let value = given.next().ok_or_else(|| format!("value of {option} must be given\n\n{HELP}"))?;
        let whole = || value.parse().map_err(|_| format!("value of {option} must be a whole number; got {value}"));
        match option.as_str() {
            "--scenes" => found.scenes = whole()?,
            "--judged" => found.judged = whole()?,
            "--chains" => found.chains = whole()?,
            "--first" => found.first += whole()?,
            "--chunk" => found.chunk = whole()?.max(1),
            "--minutes" => {
                found.minutes =
                    value.parse().map_err(|_| format!("value of --minutes must be a number; got {value}"))?;
            }
            "--tally" => found.tally = Some(value.into()),
            "--write" => found.write = Some(value.into()),
            _ => return Err(format!("option must be one of those below; got {option}\n\n{HELP}")),
        }
    }
    Ok(found)
}

fn stress(arguments: &Arguments) -> Result<bool, Box<dyn std::error::Error>> {
    let usual = match arguments.directions {
        Directions::One if arguments.first >= SLABS => "target/stress/slabs.tsv",
        Directions::One => "target/stress/general.tsv",
        Directions::Two if arguments.first >= TWINS => "target/stress/twins.tsv",
        Directions::Two => "target/stress/plane.tsv",
    };
    let path = &arguments.tally.clone().unwrap_or_else(|| usual.into());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let program = program()?;
    let mut tally = GeneralTally::load(path, &program, arguments.directions, arguments.first)?;
    let begin = Instant::now();
    let budget = Duration::try_from_secs_f64(60.0 * arguments.minutes).unwrap_or(Duration::MAX);
    let judged = arguments.judged as f64 / arguments.scenes.max(1) as f64;
    if arguments.directions == Directions::One && tally.chains.scenes != arguments.chains {
        tally.run_chains(arguments.chains);
        tally.save(path, &program)?;
    }
    while tally.scenes < arguments.scenes && begin.elapsed() < budget {
        tally.run(arguments.chunk.min(arguments.scenes - tally.scenes), judged);
        tally.save(path, &program)?;
        println!(
            "{} scenes, {} judged, {} explained, {} failed, {} defects, {:.0} s",
            tally.scenes,
            tally.judged,
            tally.grazing.len() + tally.sensitive.len(),
            tally.failed.len(),
            tally.defects.len(),
            begin.elapsed().as_secs_f64(),
        );
    }
    println!("\n{}", distribution(&tally));
    if let Some(path) = &arguments.write {
        std::fs::write(path, page(&tally))?;
    }
    Ok(tally.defects.is_empty() && tally.chains.defects.is_empty())
}

fn main() -> ExitCode {
    let arguments = match arguments() {
        Ok(arguments) => arguments,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    match stress(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
