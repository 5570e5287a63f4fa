//! Wall times of the kernel's kinds of work: `make bench-kernel`. Instruction counts are steadier: `count.rs`.

mod common;

use std::num::NonZeroUsize;

use common::{Case, NAMES, case, motion};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use seismass::reference::{Method, integrate};
use seismass::spectrum::response_spectra;
use seismass::{Control, Options, simulate};

fn main() {
    divan::main();
}

/// A benchmark that cannot begin says why and ends.
#[allow(clippy::expect_used)]
fn known(name: &str) -> Case {
    case(name).expect("scenes of the suite are valid")
}

fn samples(case: &Case) -> ItemsCount {
    ItemsCount::new(case.motion.acceleration().len())
}

/// A whole run, peaks only; items are samples.
#[divan::bench(args = NAMES)]
fn peaks(bencher: Bencher, name: &str) {
    let case = known(name);
    bencher.counter(samples(&case)).bench(|| simulate(&case.scene, black_box(&case.motion), &Options::PEAKS));
}

/// The same with histories of everything at every sample.
#[divan::bench(args = ["plain, 4 storeys", "section 4, r2 = 0.05", "section 4, r2 = 0.5"])]
fn histories(bencher: Bencher, name: &str) {
    let case = known(name);
    let options = Options { histories: Some(NonZeroUsize::MIN), ..Options::default() };
    bencher.counter(samples(&case)).bench(|| simulate(&case.scene, black_box(&case.motion), &options));
}

/// The half-explicit leapfrog at the step of the motion, for reference.
#[divan::bench(args = ["plain, 4 storeys", "section 4, r2 = 0.05", "section 4, r2 = 0.5"])]
fn leapfrog(bencher: Bencher, name: &str) {
    let case = known(name);
    let method = Method::Leapfrog { substeps: 1 };
    bencher.counter(samples(&case)).bench(|| integrate(&case.scene, black_box(&case.motion), &method));
}

/// 200 periods and 5 damping ratios of one motion on one thread; items are oscillators times samples.
#[divan::bench]
#[allow(clippy::expect_used)]
fn spectrum(bencher: Bencher) {
    let motions = [motion(0.7).expect("the built-in motion is there")];
    let periods: Vec<f64> = (0..200).map(|i| 0.05 * 100f64.powf(f64::from(i) / 199.0)).collect();
    let damping = [0.01, 0.02, 0.05, 0.1, 0.2];
    let items = periods.len() * damping.len() * motions[0].acceleration().len();
    bencher
        .counter(ItemsCount::new(items))
        .bench(|| response_spectra(black_box(&motions), &periods, &damping, Some(1), &Control::default()));
}
