//! Layers: imports go downwards in this crate, in no crate in a circle, and no file is long.

#![allow(clippy::unwrap_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Layers of the kernel, the lowest first (drawn in CONTRIBUTING.md): a module imports from its own and from those before.
const KERNEL: [&str; 23] = [
    "units",
    "tolerances",
    "error",
    "response",
    "threads",
    "memory",
    "classes",
    "lanes",
    "polynomial",
    "scene",
    "machines",
    "regime",
    "step",
    "state",
    "events",
    "record",
    "plain",
    "run",
    "general",
    "batch",
    "reference",
    "spectrum",
    "lib",
];
/// Most lines of a file.
const LONGEST: usize = 600;
/// Most lines of most files.
const USUAL: usize = 300;

struct Source {
    path: PathBuf,
    lines: usize,
    /// Modules that it names after `crate`, itself excluded.
    imports: BTreeSet<String>,
}

/// Sources by module, `a::b` for `a/b.rs` and `a` for `a/mod.rs`.
fn sources(root: &Path) -> BTreeMap<String, Source> {
    let mut paths = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                paths.push(path);
            }
        }
    }
    let module = |path: &Path| {
        let parts = path.strip_prefix(root).unwrap().with_extension("");
        let parts: Vec<_> = parts.iter().map(|part| part.to_str().unwrap()).filter(|&part| part != "mod").collect();
        parts.join("::")
    };
    let modules: BTreeSet<String> = paths.iter().map(|path| module(path)).collect();
    let source = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        let mut imports = imports(&module(&path), &text, &modules);
        imports.remove(&module(&path));
        (module(&path), Source { lines: text.lines().count(), path, imports })
    };
    paths.into_iter().map(source).collect()
}

/// Modules that the text of a module names, tests and comments excluded: the longest part of each path that is one.
fn imports(own: &str, text: &str, modules: &BTreeSet<String>) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
    let code: String = code.lines().map(|line| line.split("//").next().unwrap().to_owned() + "\n").collect();
    let parent = own.rsplit_once("::").map_or("", |(parent, _)| parent);
    let mut found = BTreeSet::new();
    for (start, from) in [("crate::", ""), ("super::", parent)] {
        for (at, _) in code.match_indices(start) {
            let rest = &code[at + start.len()..];
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap_or(rest.len());
            // The items of a list are looked up one by one.
            let list = rest[end..].strip_prefix('{').and_then(|list| list.split('}').next());
            for item in list.unwrap_or_default().split(',') {
                let parts = from.split("::").chain(rest[..end].split("::")).chain(item.trim().split("::"));
                let path: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
                let longest = (1..=path.len()).rev().map(|n| path[..n].join("::")).find(|path| modules.contains(path));
                found.extend(longest);
            }
        }
    }
    // What a module takes from those inside it: `use inner::Item`.
    for line in code.lines().map(|line| line.trim_start_matches("pub(crate) ").trim_start_matches("pub ")) {
        let inner = line.strip_prefix("use ").and_then(|path| path.split("::").next());
        found.extend(inner.map(|inner| format!("{own}::{inner}")).filter(|inner| modules.contains(inner)));
    }
    found
}

/// A circle of imports that a module is part of, if there is one.
fn circle<'a>(sources: &'a BTreeMap<String, Source>, from: &'a str) -> Option<Vec<&'a str>> {
    let mut ways: Vec<Vec<&str>> = vec![vec![from]];
    let mut seen = BTreeSet::new();
    while let Some(way) = ways.pop() {
        for next in &sources[*way.last().unwrap()].imports {
            if next == from {
                return Some(way);
            }
            if seen.insert(next.as_str()) {
                ways.push(way.iter().copied().chain([next.as_str()]).collect());
            }
        }
    }
    None
}

fn assert_no_circle_and_no_long_file(sources: &BTreeMap<String, Source>) {
    for (module, source) in sources {
        assert!(source.lines <= LONGEST, "{} has {} lines, more than {LONGEST}", source.path.display(), source.lines);
        if let Some(way) = circle(sources, module) {
            panic!("imports in a circle: {}", way.join(" -> "));
        }
    }
    let long = sources.values().filter(|source| source.lines > USUAL).count();
    assert!(4 * long < sources.len(), "{long} of {} files have more than {USUAL} lines", sources.len());
}

#[test]
fn imports_of_the_kernel_go_downwards() {
    let sources = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    assert!(sources.len() > 60, "{} files", sources.len());
    let layer = |module: &str| {
        let name = module.split("::").next().unwrap();
        KERNEL.iter().position(|&layer| layer == name).unwrap_or_else(|| {
            panic!("{name} is in no layer: name it in KERNEL, and in CONTRIBUTING.md, Layers of the kernel")
        })
    };
    for (module, source) in &sources {
        for import in &source.imports {
            assert!(
                layer(import) <= layer(module),
                "{module} imports {import}, which is above it: CONTRIBUTING.md, Layers of the kernel"
            );
        }
    }
    assert_no_circle_and_no_long_file(&sources);
}

/// Those of the workspace: beside the package of this one there are none.
#[test]
fn imports_of_the_other_crates_form_no_circle() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    if !workspace.join("seismass/src").is_dir() {
        return;
    }
    for (name, files) in [("seismass-judge", 20), ("seismass-python", 9), ("seismass-web", 8)] {
        let sources = sources(&workspace.join(name).join("src"));
        assert!(sources.len() > files, "{name}: {} files", sources.len());
        assert_no_circle_and_no_long_file(&sources);
    }
}

/// The test fails where it should: on an upward path, on one that goes on below a module, and on `super`.
#[test]
fn imports_are_found() {
    let modules = ["a", "a::b", "a::c", "d"].map(str::to_owned).into();
    let text = "use crate::a::{b, b::X};\n// crate::d\nuse super::c::Z;\nfn f() { crate::d::g() }\n";
    assert_eq!(imports("a::x", text, &modules), ["a::b", "a::c", "d"].map(str::to_owned).into());
    assert_eq!(imports("a", "pub(crate) use b::X;\nuse std::fmt;\n", &modules), ["a::b".to_owned()].into());
}

/// No state of a run is extended above its layer.
#[test]
fn the_state_has_methods_in_its_own_layer_alone() {
    let sources = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    for (module, source) in sources.iter().filter(|(module, _)| !module.starts_with("state")) {
        let text = fs::read_to_string(&source.path).unwrap();
        let extends = text.lines().any(|line| line.starts_with("impl") && line.contains(" State<"));
        assert!(!extends, "{module} has methods of State");
    }
}
