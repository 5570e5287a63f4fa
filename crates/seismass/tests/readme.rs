//! The README shows the example `readme.rs` and what it prints.

#![allow(clippy::expect_used)]

use std::cell::RefCell;
use std::path::Path;

thread_local! {
    static PRINTED: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Takes the place of the library's for the example, so that what it prints can be read.
macro_rules! println {
    ($($argument:tt)*) => {
        crate::PRINTED.with_borrow_mut(|printed| {
            printed.push_str(&format!($($argument)*));
            printed.push('\n');
        })
    };
}

#[path = "../examples/readme.rs"]
mod example;

/// What stands between a line of three backticks and `language`, and the next such line.
fn shown(readme: &str, language: &str) -> String {
    let start = readme.split_once(&format!("\n```{language}\n")).expect(language).1;
    start.split_once("\n```\n").expect("an end").0.to_owned() + "\n"
}

fn read(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect(name)
}

#[test]
fn the_readme_shows_the_example_and_what_it_prints() {
    let (readme, source) = (read("README.md"), read("examples/readme.rs"));
    let program =
        source.split_once("\n\n").expect("a line that says what it is").1.replace("pub(crate) fn main", "fn main");
    assert_eq!(shown(&readme, "rust"), program);
    example::main().unwrap();
    assert_eq!(shown(&readme, "text"), PRINTED.take());
}
