//! What the stress suite prints and writes: the table of cases and the distribution of the random run.

use std::fmt::Write as _;

use seismass::EventKind;

use super::cases::Finding;
use super::family::Family;
use super::random::{LARGEST_RESIDUAL, Tally};
use super::verdict::AGREEMENT;

/// The distribution of a random run, as Markdown.
pub fn distribution(tally: &Tally) -> String {
    let mut text = String::new();
    let mut row = |what: &str, value: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "| {what} | {value} |");
    };
    row("quantity", "value".into());
    row("---", "---".into());
    let of_families = Family::ALL.iter().zip(tally.families);
    row(&format!("scenes run (seeds from {})", tally.first), tally.scenes.to_string());
    row("of them by family", listed(of_families.map(|(family, n)| format!("{} {n}", family.name()))));
    let failed = tally.failed.len();
    let completed = tally.scenes - tally.collapsed - failed as u64;
    row("completed / collapsed / failed", format!("{completed} / {} / {failed}", tally.collapsed));
    let [least, median, most] = tally.event_quantiles();
    row("events of a run: least / median / most", format!("{least} / {median} / {most}"));
    let kinds = EventKind::ALL.iter().zip(tally.kinds);
    row("events by kind", listed(kinds.map(|(kind, n)| format!("{} {n}", kind.name()))));
    row(
        "energies balanced; without them the same bits, for peaks alone with a quiet tail the same peaks",
        tally.balanced.to_string(),
    );
    let worst = |worst: [(f64, u64); Family::ALL.len()]| {
        let of_family = Family::ALL.iter().zip(worst);
        listed(of_family.map(|(family, (value, seed))| format!("{} {value:.1e} (seed {seed})", family.name())))
    };
    row(&format!("worst energy residual (limit {LARGEST_RESIDUAL:.0e})"), worst(tally.worst_residual));
    row("compared with the plain implementation", tally.judged.to_string());
    let limit = format!("where the events agree (limit {AGREEMENT:.0e})");
    row(&format!("worst relative difference {limit}"), worst(tally.worst_difference));
    row(&format!("worst difference of event times, of the duration, {limit}"), worst(tally.worst_time));
    row("parted at a grazing, explained", tally.grazing.len().to_string());
    row("parted by sensitivity, explained", tally.sensitive.len().to_string());
    row("logs differ by pairs of events at a graze alone, explained", tally.pairs.len().to_string());
    row("residuals beyond the limit where g + a_v cancels, explained", tally.cancelled.len().to_string());
    row("defects: panics, NaN, errors, residuals, illegal sequences, unexplained", tally.defects.len().to_string());
    let of_input = "with the change of the input, in last digits, that does the same";
    let of_state = "with the change of the state, in last digits, that brings or takes each";
    for (heading, change, list) in [
        ("Grazings", of_input, &tally.grazing),
        ("Sensitive scenes (0: by the judge's own rounding in double precision)", of_input, &tally.sensitive),
        ("Pairs at a graze", of_state, &tally.pairs),
    ] {
        if !list.is_empty() {
            let _ = writeln!(text, "\n{heading}, {change}:\n");
        }
        for (seed, digits, difference) in list {
            let _ = writeln!(text, "- seed {seed}, {digits}: `{difference}`");
        }
    }
    if !tally.cancelled.is_empty() {
        let _ = writeln!(
            text,
            "\nEnergy residuals where g + a_v cancels, with what the last digit of g moves friction work:\n"
        );
    }
    for (seed, explained, residual) in &tally.cancelled {
        let _ = writeln!(text, "- seed {seed}: residual {residual:.1e}, explained up to {explained:.1e}");
    }
    let failed = "Failed runs, no defects where the judge fails for the same reason";
    for (heading, list) in [(failed, &tally.failed), ("Defects", &tally.defects)] {
        if !list.is_empty() {
            let _ = writeln!(text, "\n{heading}:\n");
        }
        for (seed, reason) in list {
            let _ = writeln!(text, "- seed {seed}: `{reason}`");
        }
    }
    text
}

fn listed(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(", ")
}

/// The table of the named cases, as Markdown.
pub fn table(findings: &[Finding]) -> String {
    let mut text = String::from("| theme | case | expectation | found | holds |\n| --- | --- | --- | --- | --- |\n");
    for Finding { case, outcome } in findings {
        let (found, holds) = match outcome {
            Ok(found) => (found, "yes"),
            Err(fault) => (fault, "**no**"),
        };
        let found = found.replace('|', "/");
        let _ = writeln!(text, "| {} | {} | {} | {found} | {holds} |", case.theme, case.name, case.expectation);
    }
    text
}

/// The page of docs.
pub fn page(findings: &[Finding], tally: &Tally) -> String {
    let failed = findings.iter().filter(|f| f.outcome.is_err()).count();
    format!(
        "# Stress\n\nWritten by `make stress`, which runs a million random scenes and may be stopped and \
         gone on with as long as the kernel is the same; how many this page stands for is in its last table. What can still go wrong is in [limitations.md](limitations.md).\n\n\
         ## Named cases\n\n\
         {} cases, {failed} whose expectation does not hold. *Judge*: the second, plain implementation, in double-double \
         precision unless stated; a difference to it is relative to the peak of the same storey or block, of event times to the duration of the run. \
         Every run is also checked by itself: finite numbers, energy balance, legal sequences of events, stuck blocks that \
         neither move nor exceed their limit, peaks that no sample beats.\n\n{}\n\
         ## Random scenes\n\n\
         Seeded scenes that draw every feature of the model; the hard family draws every number from a range far wider than \
         buildings have, the stiff one has steps in which the stiffest mode turns by 50 to 1000 radians, under goods 10 to \
         10000 times as heavy as their floor, the tall one has 13 to 64 storeys, and that of laws has springs of the further laws and friction that \
         changes with the path slipped, as a third of the hard, stiff and tall scenes have too (`random_scene.rs`, `law_scene.rs`, \
         `stress/hard_scene.rs` and `stress/tall_scene.rs` of `crates/seismass-judge`). Every run is checked by itself, a tenth with energies, a \
         random part against the judge, of the stiff and tall families a larger one. Where the two part, the judge is asked again with \
         its input changed in the last digits: a grazing is explained if it then comes to the same events, times and numbers as \
         the kernel, and a scene is sensitive if it has the kernel's events and moves as far from itself as the kernel is \
         from it. Where all numbers agree and the logs \
         differ by pairs of events alone (a yield and its unload, a slip and its stick), the judge's state is changed in the \
         last digits just before each pair: it is explained if every pair thus comes or goes (`stress/pairs.rs`). An energy \
         residual beyond the limit is explained as far as one last digit of g and a_v changes the work of friction.\n\n{}",
        findings.len(),
        table(findings),
        distribution(tally),
    )
}
