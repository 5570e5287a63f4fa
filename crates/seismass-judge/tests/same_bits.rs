//! A path gives the same bits whatever else a processor has: where another one can be emulated.

#![allow(clippy::unwrap_used)]

use std::process::Command;

const SCENES: &str = "60";

/// What `bits` prints on a path, by itself or under an emulator; none where that is not at hand.
fn printed(path: &str, emulator: Option<[&str; 3]>) -> Option<String> {
    let bits = env!("CARGO_BIN_EXE_bits");
    let mut command = Command::new(emulator.map_or(bits, |[name, ..]| name));
    if let Some([_, option, value]) = emulator {
        command.args([option, value, bits]);
    }
    let output = command.arg(SCENES).env("SEISMASS_INSTRUCTIONS", path).output().ok()?;
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{path}, {emulator:?}: {errors}");
    let printed = String::from_utf8(output.stdout).unwrap();
    // What a machine has is taken without a word.
    assert!(emulator.is_some() || !printed.starts_with(path) || errors.is_empty(), "{path}: {errors}");
    Some(printed)
}

/// The first processor has neither AVX nor fused multiply-add, the second not AVX-512.
#[test]
fn a_path_gives_the_same_bits_on_every_processor() {
    for (path, processor) in [("baseline", "qemu64"), ("avx2", "Haswell")] {
        let here = printed(path, None).unwrap();
        assert_eq!(here.lines().count(), 1 + SCENES.parse::<usize>().unwrap());
        let emulator = ["qemu-x86_64", "-cpu", processor];
        let there = if cfg!(target_arch = "x86_64") { printed(path, Some(emulator)) } else { None };
        let Some(there) = there else {
            println!("skipped: no x86-64 processor, or no qemu-x86_64");
            return;
        };
        if !here.starts_with(path) || !there.starts_with(path) {
            println!("skipped: {path}, which this machine or its emulator does not have");
            continue;
        }
        for (here, there) in here.lines().zip(there.lines()) {
            assert_eq!(here, there, "{path}: seed, storeys, events, hash");
        }
        println!("{path}: the same bits on this processor and on {processor}, {SCENES} scenes");
    }
}

/// The path for AVX-512 has more registers and the same arithmetic.
#[test]
fn avx2_and_avx512_give_the_same_bits() {
    let [narrow, wide] = ["avx2", "avx512"].map(|path| printed(path, None).unwrap());
    if !wide.starts_with("avx512") {
        println!("skipped: this machine does not have AVX-512");
        return;
    }
    for (narrow, wide) in narrow.lines().zip(wide.lines()).skip(1) {
        assert_eq!(narrow, wide, "seed, storeys, events, hash");
    }
}
