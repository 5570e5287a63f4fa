//! Solves a scene in double-double and writes histories, peaks and residuals: the reference of the benchmarks.
//!
//! Usage: judge_reference INPUT OUTPUT. Both are text, a name and its numbers per line; numbers round-trip. Input: see
//! [`scene_text`]. Output: drift and slip (row by row), peak_drift, peak_slip, residual_slip, events.

use std::error::Error;
use std::fmt::Write;

use seismass_judge::{DoubleDouble, scene_text, solve};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, from, to] = &arguments[..] else { return Err("usage: judge_reference INPUT OUTPUT".into()) };
    let (scene, motion) = scene_text::read(&std::fs::read_to_string(from)?)?;
    let solution = solve::<DoubleDouble>(&scene, &motion, 1)?;
    let peaks = |peaks: &[seismass::Peak]| peaks.iter().map(|peak| peak.value).collect();
    let rows: [(&str, Vec<f64>); 6] = [
        ("drift", solution.drift),
        ("slip", solution.slip),
        ("peak_drift", peaks(&solution.peaks.drift)),
        ("peak_slip", peaks(&solution.peaks.slip)),
        ("residual_slip", solution.residual_slip),
        ("events", vec![solution.events.len() as f64]),
    ];
    let mut text = String::new();
    for (name, values) in rows {
        text.push_str(name);
        for value in values {
            write!(text, " {value:?}")?;
        }
        text.push('\n');
    }
    std::fs::write(to, text)?;
    Ok(())
}
