//! Lays the project's `data/` out for the wheel, where it becomes the folder `seismass/data` (see pyproject.toml).

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn copy_tree(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy_tree(&entry.path(), &target)?;
        } else {
            fs::copy(entry.path(), target)?;
        }
    }
    Ok(())
}

fn main() -> io::Result<()> {
    let variable = |name: &str| env::var_os(name).map(PathBuf::from).ok_or(io::Error::other(format!("{name} not set")));
    let data = variable("CARGO_MANIFEST_DIR")?.join("../../data");
    let target = variable("OUT_DIR")?.join("data");
    println!("cargo::rerun-if-changed={}", data.display());
    if target.exists() {
        // A file removed from data/ must not survive in the wheel.
        fs::remove_dir_all(&target)?;
    }
    copy_tree(&data, &target)
}
