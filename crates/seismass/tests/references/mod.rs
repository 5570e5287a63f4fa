//! Where reference scenes are: some in the repository, the others, many under recordings, in the folder of shared data.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The scene files of a folder of references ("" or "general"), in order of name: those of the repository always, all others
/// where `SEISMASS_SHARED` names shared data. Where it is not set, that is said where the test harness does not hide it.
pub fn reference_files(folder: &str) -> Vec<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let of_kernel = [own.join("tests/data/reference"), own.join("../seismass/tests/data/reference")];
    let mut folders: Vec<_> = of_kernel.into_iter().filter(|place| place.is_dir()).take(1).collect();
    folders.iter_mut().for_each(|place| place.push(folder));
    match std::env::var_os("SEISMASS_SHARED") {
        Some(shared) => folders.push(Path::new(&shared).join("reference").join(folder)),
        None => {
            let (program, thread) = (std::env::args().next().unwrap_or_default(), std::thread::current());
            let program = Path::new(&program).file_name().unwrap_or_default().to_string_lossy();
            let (program, test) = (program.split('-').next().unwrap_or_default(), thread.name().unwrap_or_default());
            let skipped = "skipped: references outside the repository; SEISMASS_SHARED is not set";
            // Not by eprintln, of which a test that passes shows nothing.
            let mut shown = std::io::stderr();
            writeln!(shown, "{program}, {test}: {skipped}").unwrap();
        }
    }
    let mut files = BTreeMap::new();
    for folder in folders {
        let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for path in
            entries.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "json"))
        {
            files.entry(path.file_name().unwrap().to_owned()).or_insert(path);
        }
    }
    assert!(files.len() > 3);
    files.into_values().collect()
}
