//! A tally on disk, so that a long random run can stop and go on: one line per entry, tab-separated. The first names
//! the program that made it, for the counts of different kernels mean nothing together.

use std::fmt::Write as _;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::Path;

use super::family::Family;
use super::random::Tally;

/// A digest of the running executable, kernel and judge among it.
///
/// # Errors
/// Those of the file system.
pub fn program() -> io::Result<String> {
    let mut hasher = DefaultHasher::new();
    fs::read(std::env::current_exe()?)?.hash(&mut hasher);
    Ok(format!("{:016x}", hasher.finish()))
}

impl Tally {
    /// Writes the tally, made by this [`program`], to a file, whole or not at all.
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
        let counts = [self.scenes, self.collapsed, self.judged, self.balanced];
        line("counts", &counts.map(|c| c.to_string()));
        line("families", &self.families.map(|c| c.to_string()));
        line("kinds", &self.kinds.map(|c| c.to_string()));
        for (family, name) in Family::ALL.iter().map(|family| family.name()).enumerate() {
            for (key, worst) in
                [("residual", self.worst_residual), ("difference", self.worst_difference), ("time", self.worst_time)]
            {
                let (value, seed) = worst[family];
                line(key, &[name.into(), format!("{value:e}"), seed.to_string()]);
            }
        }
        for (events, runs) in &self.events {
            line("events", &[events.to_string(), runs.to_string()]);
        }
        for (key, list) in [("grazing", &self.grazing), ("sensitive", &self.sensitive), ("pairs", &self.pairs)] {
            for (seed, digits, difference) in list {
                line(key, &[seed.to_string(), digits.to_string(), difference.clone()]);
            }
        }
        for (seed, explained, residual) in &self.cancelled {
            line("cancelled", &[seed.to_string(), format!("{explained:e}"), format!("{residual:e}")]);
        }
        for (key, list) in [("failed", &self.failed), ("defect", &self.defects)] {
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
    /// program, or has another first seed.
    pub fn load(path: &Path, program: &str, first: u64) -> io::Result<Self> {
        let mut tally = Self::from_seed(first);
        for (number, line) in lines_of(path, program)?.iter().enumerate() {
            let fields: Vec<&str> = line.split('\t').collect();
            tally.read_line(&fields).ok_or_else(|| {
                refused(format!("line {} of {} is not of a tally: {line}", number + 2, path.display()))
            })?;
        }
        if tally.first != first {
            return Err(refused(format!(
                "first seed of tally {} must be {first}; got {}",
                path.display(),
                tally.first
            )));
        }
        Ok(tally)
    }

    fn read_line(&mut self, fields: &[&str]) -> Option<()> {
        let (key, fields) = fields.split_first()?;
        let whole = |i: usize| fields.get(i)?.parse::<u64>().ok();
        let real = |i: usize| fields.get(i)?.parse::<f64>().ok();
        let family = |i: usize| Family::ALL.iter().position(|family| Some(&family.name()) == fields.get(i));
        let text = |i: usize| fields.get(i).map(ToString::to_string);
        match *key {
            "first" => self.first = whole(0)?,
            "counts" => {
                let counts = [&mut self.scenes, &mut self.collapsed, &mut self.judged, &mut self.balanced];
                take_numbers(fields, counts.into_iter())?;
            }
            "families" => take_numbers(fields, self.families.iter_mut())?,
            "kinds" => take_numbers(fields, self.kinds.iter_mut())?,
            "residual" => self.worst_residual[family(0)?] = (real(1)?, whole(2)?),
            "difference" => self.worst_difference[family(0)?] = (real(1)?, whole(2)?),
            "time" => self.worst_time[family(0)?] = (real(1)?, whole(2)?),
            "events" => {
                self.events.insert(whole(0)?, whole(1)?);
            }
            "grazing" => self.grazing.push((whole(0)?, real(1)?, text(2)?)),
            "sensitive" => self.sensitive.push((whole(0)?, real(1)?, text(2)?)),
            "pairs" => self.pairs.push((whole(0)?, real(1)?, text(2)?)),
            "cancelled" => self.cancelled.push((whole(0)?, real(1)?, real(2)?)),
            "failed" => self.failed.push((whole(0)?, text(1)?)),
            "defect" => self.defects.push((whole(0)?, text(1)?)),
            _ => return None,
        }
        Some(())
    }
}

/// Writes a file whole or not at all.
pub(super) fn write_whole(path: &Path, text: &str) -> io::Result<()> {
    let new = path.with_extension("new");
    fs::write(&new, text)?;
    fs::rename(&new, path)
}

/// The lines of a tally after that which names the program; none where there is no file.
pub(super) fn lines_of(path: &Path, program: &str) -> io::Result<Vec<String>> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = fs::read_to_string(path)?;
    let mut lines = text.lines();
    let made_by = lines.next().and_then(|line| line.strip_prefix("program\t"));
    if made_by != Some(program) {
        return Err(refused(format!(
            "program of tally {} must be the present one, {program}; got {}: remove the tally to begin again",
            path.display(),
            made_by.unwrap_or("none"),
        )));
    }
    Ok(lines.map(ToString::to_string).collect())
}

fn refused(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, message)
}

/// Reads a whole number from each field; None if there are fewer fields, or one is no such number.
pub(super) fn take_numbers<'a>(fields: &[&str], numbers: impl Iterator<Item = &'a mut u64>) -> Option<()> {
    let mut fields = fields.iter();
    for number in numbers {
        *number = fields.next()?.parse().ok()?;
    }
    Some(())
}
