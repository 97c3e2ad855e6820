//! The house keeps to its plan: `ARCHITECTURE.md` is compared with the code and the code with the
//! habits that a machine can check.

#![allow(
    clippy::unwrap_used,
    reason = "clippy.toml allows it in tests, but does not see helpers as tests"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Crates that the table does not list: they are everywhere, or are named for their features alone.
const EVERYWHERE: [&str; 7] = [
    "nalgebra",
    "thiserror",
    "arrayvec",
    "indexmap",
    "matrixmultiply",
    "num-complex",
    "num-integer",
];
/// Longest file, tests included.
const LONGEST: usize = 500;
/// Files that may be longer: tables of constants.
const EXEMPT: [&str; 0] = [];
/// Names that say nothing of what is inside.
const EMPTY_MODULES: [&str; 9] = [
    "common", "core", "helper", "helpers", "misc", "prelude", "types", "util", "utils",
];
/// Identifiers, or beginnings of names of functions, that are words of no meaning or initials.
const EMPTY_WORDS: [&str; 5] = ["utils", "manager", "pcmfs", "compute_", "get_"];

type Table = BTreeMap<String, [BTreeSet<String>; 2]>;

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.canonicalize().unwrap()
}

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// `crate | is | may depend on (ours) | notable outside`, as crate → (ours, outside).
fn documented() -> Table {
    let architecture = text("ARCHITECTURE.md");
    let words = |cell: &str| -> BTreeSet<String> {
        let names = cell.split(',').map(|name| name.trim().replace('`', ""));
        names
            .filter(|name| !name.is_empty() && name != "none")
            .collect()
    };
    let rows = architecture
        .lines()
        .skip_while(|line| !line.starts_with("| crate | is |"));
    rows.skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<_> = line.trim_matches('|').split('|').collect();
            assert_eq!(cells.len(), 4, "ARCHITECTURE.md: four cells in {line:?}");
            let name = cells[0].trim().replace('`', "");
            (name, [words(cells[2]), words(cells[3])])
        })
        .collect()
}

/// Normal dependencies, as crate → (ours, outside).
fn actual() -> Table {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps"])
        .current_dir(root())
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo metadata: {error}");
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    packages.iter().map(crate_and_dependencies).collect()
}

fn crate_and_dependencies(package: &Value) -> (String, [BTreeSet<String>; 2]) {
    let short = |name: &str| name.strip_prefix("palpate-").unwrap_or(name).to_owned();
    let mut sets = [BTreeSet::new(), BTreeSet::new()];
    for dependency in package["dependencies"].as_array().unwrap() {
        let name = dependency["name"].as_str().unwrap();
        // The kind of a normal dependency is null.
        if dependency["kind"].is_string() || EVERYWHERE.contains(&name) {
            continue;
        }
        let ours = name.starts_with("palpate-");
        sets[usize::from(!ours)].insert(short(name));
    }
    (short(package["name"].as_str().unwrap()), sets)
}

/// The arrows, and with the last column the one home of each heavy dependency.
#[test]
fn dependencies_are_those_of_the_table() {
    let (documented, actual) = (documented(), actual());
    let names = |table: &Table| table.keys().cloned().collect::<Vec<_>>();
    assert_eq!(
        names(&documented),
        names(&actual),
        "crates of the table in ARCHITECTURE.md and of the workspace"
    );
    for (name, sets) in &actual {
        for (which, column) in ["may depend on (ours)", "notable outside"]
            .iter()
            .enumerate()
        {
            assert_eq!(
                documented[name][which], sets[which],
                "crate {name}: column {column:?} of ARCHITECTURE.md (left) and Cargo.toml (right); \
                 change the one that is wrong"
            );
        }
    }
}

/// Downward only: no crate reaches itself.
#[test]
fn arrows_make_no_circle() {
    let documented = documented();
    for start in documented.keys() {
        let mut next = vec![start];
        let mut seen = BTreeSet::new();
        while let Some(name) = next.pop() {
            for below in &documented[name][0] {
                assert_ne!(below, start, "{start} depends on itself by way of {name}");
                if seen.insert(below) {
                    next.push(below);
                }
            }
        }
    }
}

#[test]
fn versions_stand_in_the_root_only() {
    for name in actual().keys() {
        let path = format!("crates/{name}/Cargo.toml");
        let mut in_dependencies = false;
        for line in text(&path).lines() {
            if line.starts_with('[') {
                in_dependencies = line.contains("dependencies");
            } else if in_dependencies && line.contains('=') {
                assert!(
                    line.contains("workspace = true"),
                    "{path}: {line:?}: state the version in the root's Cargo.toml"
                );
            }
        }
    }
}

/// What stands in backticks and looks like a path.
fn paths_of(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2).filter(|quoted| {
        let looks_so = quoted.contains('/') || quoted.ends_with(".md") || quoted.ends_with(".toml");
        // What a command makes is not there in a new checkout.
        let kept = !quoted.starts_with(['.', '/']) && !quoted.starts_with("target/");
        looks_so && kept && !quoted.contains([' ', '*', '<', '{', ':'])
    })
}

#[test]
fn paths_in_the_documents_exist() {
    let documents = [
        "ARCHITECTURE.md",
        "CONTRIBUTING.md",
        "docs/devices.md",
        "docs/embedding.md",
        "docs/errata.md",
        "docs/notation.md",
        "docs/slicer.md",
        "docs/theory/finite_spheres.md",
        "docs/theory/haptics.md",
    ];
    for document in documents {
        for (number, line) in text(document).lines().enumerate() {
            for path in paths_of(line) {
                assert!(
                    root().join(path).exists() || line.contains("planned"),
                    "{document}, line {}: there is no {path}; correct the path or say that it is \
                     planned",
                    number + 1
                );
            }
        }
    }
}

fn rust_files() -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![root().join("crates"), root().join("examples")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("target") {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    assert!(files.len() > 50, "the files were not found");
    files
}

fn in_words(path: &Path) -> String {
    let relative = path.strip_prefix(root()).unwrap();
    relative.to_string_lossy().replace('\\', "/")
}

#[test]
fn files_are_short() {
    for path in rust_files() {
        let name = in_words(&path);
        let lines = std::fs::read_to_string(&path).unwrap().lines().count();
        assert!(
            lines <= LONGEST || EXEMPT.contains(&name.as_str()),
            "{name} has {lines} lines; split it at {LONGEST}"
        );
    }
}

#[test]
fn names_say_something() {
    for path in rust_files() {
        let name = in_words(&path);
        if !name.contains("/src/") {
            continue;
        }
        for part in path.strip_prefix(root()).unwrap().iter() {
            let part = part.to_string_lossy();
            let stem = part.strip_suffix(".rs").unwrap_or(&part);
            assert!(
                !EMPTY_MODULES.contains(&stem),
                "{name}: name it for a thing"
            );
        }
        let code = std::fs::read_to_string(&path).unwrap();
        for (number, line) in code.lines().enumerate() {
            if let Some(word) = empty_word(line) {
                panic!("{name}, line {}: {word:?} says nothing", number + 1);
            }
        }
    }
}

/// The first identifier of a line of code that is or begins with an empty word.
fn empty_word(line: &str) -> Option<&str> {
    let code = line.split("//").next().unwrap_or(line);
    let separators = |c: char| !(c.is_alphanumeric() || c == '_');
    let declares = code.contains("fn ") || code.contains("mod ") || code.contains("struct ");
    code.split(separators).find(|word| {
        let lower = word.to_lowercase();
        declares
            && EMPTY_WORDS
                .iter()
                .any(|empty| lower == *empty || empty.ends_with('_') && lower.starts_with(empty))
    })
}

/// `[Author Year, …]` in a comment is a key of `docs/references.md`.
#[test]
fn keys_resolve() {
    let references = text("docs/references.md");
    let mut found = BTreeSet::new();
    for path in rust_files() {
        let code = std::fs::read_to_string(&path).unwrap();
        for line in code.lines().filter(|line| line.contains("//")) {
            for key in keys_of(line) {
                let name = in_words(&path);
                assert!(
                    references.contains(&format!("**[{key}]**")),
                    "{name}: [{key}] is not in docs/references.md"
                );
                found.insert(key.to_owned());
            }
        }
    }
    assert!(found.contains("Spence 1968"), "no key was found: {found:?}");
}

/// From a bracket with a capital up to the year.
fn keys_of(line: &str) -> impl Iterator<Item = &str> {
    line.split('[').skip(1).filter_map(|after| {
        let inside = after.split(']').next()?;
        let end = (0..inside.len().saturating_sub(4)).find(|&at| {
            let bytes = &inside.as_bytes()[at..];
            let year = &bytes[1..5];
            let ends = bytes
                .get(5)
                .is_none_or(|next| !next.is_ascii_alphanumeric());
            bytes[0] == b' ' && year.iter().all(u8::is_ascii_digit) && ends
        })?;
        inside
            .starts_with(char::is_uppercase)
            .then(|| &inside[..end + 5])
    })
}

fn block<'t>(text: &'t str, language: &str) -> &'t str {
    let start = format!("```{language}\n");
    let after = text.split_once(&start).unwrap().1;
    after.split_once("```").unwrap().0
}

/// What the tutorial shows is what `palpate examples` writes.
#[test]
fn the_scene_and_motion_of_the_tutorial_are_examples() {
    let tutorial = text("docs/tutorials/touch_your_organ.md");
    for (language, file) in [("toml", "scene.toml"), ("csv", "motion.csv")] {
        let example = text(&format!("assets/first/{file}"));
        assert_eq!(block(&tutorial, language), example, "{file}");
    }
}

#[test]
fn the_example_of_the_tutorial_is_an_example() {
    let tutorial = text("docs/tutorials/embed_in_rust.md");
    assert!(
        text("examples/palpate_a_liver.rs").ends_with(block(&tutorial, "rust")),
        "docs/tutorials/embed_in_rust.md and examples/palpate_a_liver.rs differ; copy the example"
    );
}
