//! The stress suite: `stress --scenes 1000000 --judged 10000`. See `--help`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use seismass_judge::stress::random::Tally;
use seismass_judge::stress::{cases, program, report};

const HELP: &str = "\
Named cases and random scenes against the kernel; exit code 1 if anything is unexplained.

  --scenes N     random scenes in all, seeds from 0 (default 1000000)
  --judged N     of them, compared with the plain implementation, about (default 10000)
  --first N      seed to start from (default 0)
  --chunk N      scenes between two printed counts (default 5000)
  --minutes M    stop after the chunk in which so much time has passed
  --tally PATH   tally to go on from and to keep up to date, of the same kernel and the same first seed (default
                 target/stress/tally.tsv, with --first N target/stress/tally-from-N.tsv); failing seeds are in it
  --write PATH   write the page of docs there
  --no-cases     random scenes alone
";

struct Arguments {
    scenes: u64,
    judged: u64,
    first: u64,
    chunk: u64,
    minutes: f64,
    tally: Option<PathBuf>,
    write: Option<PathBuf>,
    cases: bool,
}

impl Arguments {
    fn tally_path(&self) -> PathBuf {
        let usual = || match self.first {
            0 => "target/stress/tally.tsv".into(),
            first => format!("target/stress/tally-from-{first}.tsv").into(),
        };
        self.tally.clone().unwrap_or_else(usual)
    }
}

fn arguments() -> Result<Arguments, String> {
    let mut found = Arguments {
        scenes: 1_000_000,
        judged: 10_000,
        first: 0,
        chunk: 5000,
        minutes: f64::INFINITY,
        tally: None,
        write: None,
        cases: true,
    };
    let mut given = std::env::args().skip(1);
    while let Some(option) = given.next() {
        if option == "--no-cases" {
            found.cases = false;
            continue;
        }
        if option == "--help" {
            return Err(HELP.into());
        }
        let value = given.next().ok_or_else(|| format!("value of {option} must be given\n\n{HELP}"))?;
        let whole = || value.parse().map_err(|_| format!("value of {option} must be a whole number; got {value}"));
        match option.as_str() {
            "--scenes" => found.scenes = whole()?,
            "--judged" => found.judged = whole()?,
            "--first" => found.first = whole()?,
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
    let path = arguments.tally_path();
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let program = program()?;
    let mut tally = Tally::load(&path, &program, arguments.first)?;
    let begin = Instant::now();
    let budget = Duration::try_from_secs_f64(60.0 * arguments.minutes).unwrap_or(Duration::MAX);
    let judged = arguments.judged as f64 / arguments.scenes.max(1) as f64;
    while tally.scenes < arguments.scenes && begin.elapsed() < budget {
        let scenes = arguments.chunk.min(arguments.scenes - tally.scenes);
        tally.run(scenes, judged);
        tally.save(&path, &program)?;
        let explained = tally.grazing.len() + tally.sensitive.len() + tally.pairs.len() + tally.cancelled.len();
        println!(
            "{} scenes, {} judged, {explained} explained, {} failed, {} defects, {:.0} s",
            tally.scenes,
            tally.judged,
            tally.failed.len(),
            tally.defects.len(),
            begin.elapsed().as_secs_f64(),
        );
    }
    println!("\n{}", report::distribution(&tally));
    let findings = if arguments.cases { cases::run(&cases::all()) } else { Vec::new() };
    println!("{}", report::table(&findings));
    if let Some(path) = &arguments.write {
        std::fs::write(path, report::page(&findings, &tally))?;
    }
    Ok(tally.defects.is_empty() && findings.iter().all(|f| f.outcome.is_ok()))
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
