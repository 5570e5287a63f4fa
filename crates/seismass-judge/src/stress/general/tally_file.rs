//! The tally on disk, as that of the chain engine: one line per entry, tab-separated, the first naming the program.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use super::tally::{Directions, GeneralTally};
use crate::stress::tally_file::{lines_of, take_numbers, write_whole};

impl GeneralTally {
    /// Writes the tally, made by this [`program`](crate::stress::program), to a file, whole or not at all.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn save(&self, path: &Path, program: &str) -> io::Result<()> {
        let mut text = String::new();
        let mut line = |key: &str, fields: &[String]| {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{key}\t{}", fields.join("\t"));
        };
        line("program", &[program.into()]);
        line("first", &[self.first.to_string()]);
        line("directions", &[format!("{:?}", self.directions)]);
        line("counts", &self.counts().map(|c| c.to_string()));
        line("kinds", &self.kinds.map(|c| c.to_string()));
        for (key, (value, seed)) in [
            ("residual", self.worst_residual),
            ("division", self.worst_division),
            ("turn", self.worst_turn),
            ("difference", self.worst_difference),
            ("time", self.worst_time),
            ("chain-worst", self.chains.worst),
        ] {
            line(key, &[format!("{value:e}"), seed.to_string()]);
        }
        for (events, runs) in &self.events {
            line("events", &[events.to_string(), runs.to_string()]);
        }
        for (key, list) in [("grazing", &self.grazing), ("sensitive", &self.sensitive)] {
            for (seed, digits, difference) in list {
                line(key, &[seed.to_string(), digits.to_string(), difference.clone()]);
            }
        }
        line("chains", &[self.chains.scenes, self.chains.events].map(|c| c.to_string()));
        for seed in &self.chains.judged {
            line("chain-judged", &[seed.to_string()]);
        }
        let lists = [
            ("before-stops", &self.before_stops),
            ("slow-touches", &self.slow_touches),
            ("not-followed", &self.not_followed),
            ("failed", &self.failed),
            ("defect", &self.defects),
            ("chain-defect", &self.chains.defects),
        ];
        for (key, list) in lists {
            for (seed, reason) in list {
                line(key, &[seed.to_string(), reason.clone()]);
            }
        }
        write_whole(path, &text)
    }

    /// Reads a tally to go on with; an empty one where there is no file.
    ///
    /// # Errors
    /// Those of the file system, and [`io::ErrorKind::InvalidData`] for a file that is no tally, was made by another
    /// program, has another first seed, or scenes in other directions.
    pub fn load(path: &Path, program: &str, directions: Directions, first: u64) -> io::Result<Self> {
        let mut tally = Self::from_seed(directions, first);
        for (number, line) in lines_of(path, program)?.iter().enumerate() {
            let fields: Vec<&str> = line.split('\t').collect();
            if tally.read_line(&fields).is_none() || tally.first != first || tally.directions != directions {
                let message = format!(
                    "line {} of {} is not of a tally from seed {first}, directions {directions:?}: {line}",
                    number + 2,
                    path.display()
                );
                return Err(io::Error::new(io::ErrorKind::InvalidData, message));
            }
        }
        Ok(tally)
    }

    fn counts(&self) -> [u64; 6] {
        [self.scenes, self.collapsed, self.judged, self.divided, self.turned, self.moved_by_themselves]
    }

    fn read_line(&mut self, fields: &[&str]) -> Option<()> {
        let (key, fields) = fields.split_first()?;
        let whole = |i: usize| fields.get(i)?.parse::<u64>().ok();
        let real = |i: usize| fields.get(i)?.parse::<f64>().ok();
        let text = |i: usize| fields.get(i).map(ToString::to_string);
        let worst = || Some((real(0)?, whole(1)?));
        match *key {
            "first" => self.first = whole(0)?,
            "directions" => {
                self.directions = match *fields.first()? {
                    "One" => Directions::One,
                    "Two" => Directions::Two,
                    _ => return None,
                }
            }
            "counts" => {
                let Self { scenes, collapsed, judged, divided, turned, moved_by_themselves, .. } = self;
                take_numbers(fields, [scenes, collapsed, judged, divided, turned, moved_by_themselves].into_iter())?;
            }
            "kinds" => take_numbers(fields, self.kinds.iter_mut())?,
            "residual" => self.worst_residual = worst()?,
            "division" => self.worst_division = worst()?,
            "turn" => self.worst_turn = worst()?,
            "difference" => self.worst_difference = worst()?,
            "time" => self.worst_time = worst()?,
            "chain-worst" => self.chains.worst = worst()?,
            "events" => {
                self.events.insert(whole(0)?, whole(1)?);
            }
            "grazing" => self.grazing.push((whole(0)?, real(1)?, text(2)?)),
            "sensitive" => self.sensitive.push((whole(0)?, real(1)?, text(2)?)),
            "chains" => (self.chains.scenes, self.chains.events) = (whole(0)?, whole(1)?),
            "chain-judged" => self.chains.judged.push(whole(0)?),
            "before-stops" => self.before_stops.push((whole(0)?, text(1)?)),
            "slow-touches" => self.slow_touches.push((whole(0)?, text(1)?)),
            "not-followed" => self.not_followed.push((whole(0)?, text(1)?)),
            "failed" => self.failed.push((whole(0)?, text(1)?)),
            "defect" => self.defects.push((whole(0)?, text(1)?)),
            "chain-defect" => self.chains.defects.push((whole(0)?, text(1)?)),
            _ => return None,
        }
        Some(())
    }
}
