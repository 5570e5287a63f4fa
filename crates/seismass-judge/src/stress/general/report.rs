//! What the stress suite prints and writes of the general engine, in one direction and in two.

use std::fmt::Write as _;

use seismass::EventKind;

use super::chains::{Chains, PEAK};
use super::examine::LARGEST_DIVISION;
use super::tally::{Directions, GeneralTally};
use super::verdict::MAX_SERIES;
use crate::stress::random::LARGEST_RESIDUAL;
use crate::stress::verdict::AGREEMENT;

const SLOW_TOUCHES: &str = "Goods between stops of hardly any clearance tremble there, ever less: below 1e-12 of the largest \
     velocity the times and the number of touches are rounding; a scene in which the two implementations part in these alone is \
     listed by itself (`stress/general/slow_touches.rs`).";

/// The distribution of a random run, as Markdown.
pub fn distribution(tally: &GeneralTally) -> String {
    let mut text = String::new();
    let mut row = |what: &str, value: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "| {what} | {value} |");
    };
    row("quantity", "value".into());
    row("---", "---".into());
    row(&format!("scenes run (seeds from {})", tally.first), tally.scenes.to_string());
    let failed = tally.failed.len() as u64;
    let completed = tally.scenes - tally.collapsed - failed;
    row("completed / collapsed / failed", format!("{completed} / {} / {failed}", tally.collapsed));
    let [least, median, most] = tally.event_quantiles();
    row("events of a run: least / median / most", format!("{least} / {median} / {most}"));
    let kinds = EventKind::ALL.iter().zip(tally.kinds);
    let kinds: Vec<String> = kinds.map(|(kind, n)| format!("{} {n}", kind.name())).collect();
    row("events by kind", kinds.join(", "));
    row(&format!("worst energy residual (limit {LARGEST_RESIDUAL:.0e})"), of_worst(tally.worst_residual));
    row("with every sample interval divided by four, the same events", tally.divided.to_string());
    let beyond = format!("largest change by the division (limit {LARGEST_DIVISION:.0e})");
    row(&beyond, of_worst(tally.worst_division));
    row("as their images, as many events", tally.turned.to_string());
    let beyond = format!("largest difference of peaks and paths to the image (limit {LARGEST_DIVISION:.0e})");
    row(&beyond, of_worst(tally.worst_turn));
    row("beyond a limit, and as far by changes of the input in last digits", tally.moved_by_themselves.to_string());
    row("compared with the plain implementation", tally.judged.to_string());
    let limit = format!("where the events agree (limit {AGREEMENT:.0e})");
    row(&format!("worst relative difference {limit}"), of_worst(tally.worst_difference));
    row(&format!("worst difference of event times, of the duration, {limit}"), of_worst(tally.worst_time));
    if tally.directions == Directions::Two {
        let apart = "apart in peak accelerations just before stops alone, by no more than friction does as it turns";
        row(apart, tally.before_stops.len().to_string());
    }
    let slow = "apart in touches and leaves of stops alone, slower than 1e-12 of the largest velocity";
    row(slow, tally.slow_touches.len().to_string());
    row("not judged, too dear: the plain implementation takes too many steps", tally.not_followed.len().to_string());
    row("parted at a grazing, explained", tally.grazing.len().to_string());
    row("parted by sensitivity, explained", tally.sensitive.len().to_string());
    row("defects: panics, NaN, errors, residuals, broken invariants, unexplained", tally.defects.len().to_string());
    if tally.directions == Directions::One {
        of_chains(&tally.chains, &mut row);
    }
    let of_input = "with the change of the input, in last digits, that does the same";
    for (heading, list) in [
        ("Grazings", &tally.grazing),
        ("Sensitive scenes (0: by the judge's own rounding in double precision)", &tally.sensitive),
    ] {
        if !list.is_empty() {
            let _ = writeln!(text, "\n{heading}, {of_input}:\n");
        }
        for (seed, digits, difference) in list {
            let _ = writeln!(text, "- seed {seed}, {digits}: `{difference}`");
        }
    }
    let not_judged = format!(
        "Not judged: the plain implementation has explicit steps alone, and takes more than {MAX_SERIES} in all solutions of \
         the scene, one in double-double counted as thirty, or too many in one of them"
    );
    for (heading, list) in [
        ("Apart in peak accelerations just before stops alone", &tally.before_stops),
        ("Apart in touches and leaves of stops slower than rounding alone", &tally.slow_touches),
        (&*not_judged, &tally.not_followed),
        (
            "Failed runs, no defects where the judge fails for the same reason or takes too many steps itself",
            &tally.failed,
        ),
        ("Defects", &tally.defects),
        ("Defects of shear buildings", &tally.chains.defects),
    ] {
        if !list.is_empty() {
            let _ = writeln!(text, "\n{heading}:\n");
        }
        for (seed, reason) in list {
            let _ = writeln!(text, "- seed {seed}: `{reason}`");
        }
    }
    text
}

fn of_worst((value, seed): (f64, u64)) -> String {
    format!("{value:.1e} (seed {seed})")
}

/// Rows of the shear buildings solved by both engines.
fn of_chains(chains: &Chains, row: &mut impl FnMut(&str, String)) {
    row("random shear buildings solved by both engines", chains.scenes.to_string());
    row("of them, the same events, and numbers", {
        let same = chains.scenes - chains.judged.len() as u64 - chains.defects.len() as u64;
        format!("{same}, to {} of the largest peak (limit {PEAK:.0e})", of_worst(chains.worst))
    });
    row("of them, apart by more, and the judge in double-double agrees with the general engine or with neither", {
        let seeds: Vec<String> = chains.judged.iter().map(ToString::to_string).collect();
        if seeds.is_empty() { "0".into() } else { format!("{} (seeds {})", seeds.len(), seeds.join(", ")) }
    });
    row("of them, defects", chains.defects.len().to_string());
}

/// The page of docs.
pub fn page(tally: &GeneralTally) -> String {
    match tally.directions {
        Directions::One => of_one_direction(tally),
        Directions::Two => of_two_directions(tally),
    }
}

fn of_two_directions(tally: &GeneralTally) -> String {
    format!(
        "# Stress of two directions\n\n\
         Written by `make stress-plane`, which may be stopped and gone on with as long as the kernel is the same; the numbers \
         are in its table. Racks, walls and stops in one direction have a [page of their own](stress_general.md).\n\n\
         Random scenes in two directions (`plane_scene.rs` of `crates/seismass-judge`): no building, or one to three storeys, \
         with springs, walls, damping, P-Delta, initial states and collapse drifts of each direction, or the same in both; in a \
         third a rack; several blocks per node, with mu_s at and above mu_k, without friction, with wear, much heavier than \
         their node, thrown in any direction, with stops across x and y; motions of their own in each direction, along a line \
         or in one direction alone, with and without a vertical one. `--twins` draws equal goods at equal stops, which come to \
         their limits within 1e-8 s of each other.\n\n\
         Every run is checked by itself: finite numbers; energy balance in each direction; legal sequences of events, in which no \
         block starts and stops more than three times within 1e-9 s; stuck \
         blocks that neither move nor exceed the circle; stops that never pull, and blocks that press where they must; slips \
         within clearance and penetration; peaks, of directions and of vectors, that no sample beats. A fifth is solved again \
         with every sample interval divided by four, turned by a right angle, and for peaks alone, which must not change a \
         bit. A random part is compared with a second implementation, written from the specification alone \
         (`crates/seismass-judge/src/general/plane`), as on the page of one direction: with events, times, velocities, the \
         angles at which sliding begins, histories, peaks and paths.\n\n\
         Within the last 1e-15 s before a block stops, its friction turns into the direction of what drives the block, and \
         takes a light node with it. No run is solved to that end: a peak acceleration that falls there depends on where it is \
         cut off (`numerics`, section 9.7), which is elsewhere in other precisions and with other steps. Where peak \
         accelerations of the node of such a block part at its stop, by no more than its friction can do as it turns, and all \
         else agrees, the scene is listed by itself (`stress/general/before_stops.rs`). {SLOW_TOUCHES}\n\n{}",
        distribution(tally),
    )
}

fn of_one_direction(tally: &GeneralTally) -> String {
    format!(
        "# Stress of the general engine\n\n\
         Written by `make stress-general`, which may be stopped and gone on with as long as the kernel is the same; the numbers \
         are in its table. The chain engine has a [page of its own](stress.md).\n\n\
         Random scenes with racks, walls and stops (`general_scene.rs` of `crates/seismass-judge`): up to six storeys of every \
         spring law, or none, with cantilevers, braces and random matrices beside them; up to three racks of one to four \
         levels on floors and on the ground; several blocks per node, with stops of clearances down to zero, soft and stiff, \
         with dampers and without; goods that are fixed; every kind of damping; P-Delta, vertical motion, wear, initial states; \
         in a sixth of the scenes all of it on a sliding base.\n\n\
         Every run is checked by itself: finite numbers; energy balance; legal sequences of events; stuck blocks that neither \
         move nor exceed their limit; stops that never pull, and blocks that press where they must; slips within clearance and \
         penetration; peaks that no sample beats. A fifth is solved again with every sample interval divided by four, as its \
         image in a mirror, and for peaks alone, which must not change a bit. Where one of the first two changes events, or \
         numbers beyond the limit, changes of the input by some last digits must move the engine as far, or a second \
         implementation is asked. A random part is compared with that implementation, written from the \
         specification alone, but for the sliding base, whose engine was known (`crates/seismass-judge/src/general`): a tenth of it in double-double, the others in double \
         precision and in double-double where that parts. The modal damping of racks is its own; that of the building is the \
         kernel's, and a test compares it. Where the two part, the judge is asked again with its input changed in the last \
         digits, as on the page of the chain engine. Some scenes are chaotic: blocks that are thrown to and fro between stops \
         let differences grow until two runs have other events, be they of two implementations or of one with its intervals \
         divided. For these the change of the ground acceleration, or of g + a_v, is sought with which the judge in \
         double-double has the engine's events, times and numbers from the first sample to the last within the same limits; \
         the scene is explained if it is below 1e-12, and counts as sensitive (`stress/general/backward_error.rs`). Where \
         differences outgrow the digits of double-double before the end, the judge must follow the engine as far as its own \
         last digit allows. {SLOW_TOUCHES} \
         Random shear buildings are solved by both engines.\n\n{}",
        distribution(tally),
    )
}
