//! `docs/safety.md` names tests and third-party parts. Judge: the sources, and `Cargo.lock`.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn document() -> String {
    std::fs::read_to_string(root().join("docs/safety.md")).unwrap()
}

/// The rows of the table whose first column is called `first`, cell by cell.
fn table(document: &str, first: &str) -> Vec<Vec<String>> {
    let head = format!("| {first} |");
    let rows = document.lines().skip_while(|line| !line.starts_with(&head));
    let rows = rows.skip(2).take_while(|line| line.starts_with('|'));
    let cells = |line: &str| -> Vec<String> {
        let cells = line.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().to_owned()).collect()
    };
    rows.map(cells).collect()
}

/// All source files below `folder`.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .flat_map(|path| match path.is_dir() {
            true => sources(&path),
            false => vec![path],
        })
        .collect()
}

/// Whether a crate has the test `path`, as its test binaries call it.
fn is_there(name: &str, path: &str) -> bool {
    let modules: Vec<&str> = path.split("::").collect();
    let Some((test, modules)) = modules.split_last() else {
        return false;
    };
    // Unit tests are in a module of their own.
    let (folder, modules) = match modules.split_last() {
        Some((&"tests", modules)) => ("src", modules),
        _ => ("tests/it", modules),
    };
    let folder = root().join("crates").join(name).join(folder);
    let is_its_file = |file: &PathBuf| {
        let inside = file.strip_prefix(&folder).unwrap().with_extension("");
        let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
        parts == modules
            || parts
                .split_last()
                .is_some_and(|(last, rest)| last == "mod" && rest == modules)
    };
    let has_it = |file: PathBuf| {
        let text = std::fs::read_to_string(file).unwrap();
        let written = format!("fn {test}(");
        let tests = text.split("#[test]").skip(1);
        tests.into_iter().any(|after| {
            let to_its_body = after.split('{').next().unwrap_or_default();
            to_its_body.contains(&written)
        })
    };
    sources(&folder).into_iter().filter(is_its_file).any(has_it)
}

#[test]
fn every_hazard_names_tests_that_are_there() {
    let hazards = table(&document(), "hazard");
    assert!(hazards.len() > 10, "{}", hazards.len());
    for hazard in hazards {
        let [name, _, _, _, tests] = &hazard[..] else {
            panic!("five cells: {hazard:?}");
        };
        let quoted = tests.split('`').skip(1).step_by(2);
        let named: Vec<_> = quoted.filter_map(|test| test.split_once(' ')).collect();
        assert!(!named.is_empty(), "{name}: no test");
        for (own, path) in named {
            assert!(
                is_there(own, path),
                "{name}: the crate {own} has no test {path}"
            );
        }
    }
    // What is looked for is not always found.
    assert!(!is_there("servo", "limits::nothing_of_this_name"));
}

#[test]
fn the_parts_on_the_force_path_have_their_versions() {
    let lock = std::fs::read_to_string(root().join("Cargo.lock")).unwrap();
    let parts = table(&document(), "part");
    assert!(parts.len() > 5, "{}", parts.len());
    for part in parts {
        let entry = format!("name = \"{}\"\nversion = \"{}\"\n", part[0], part[1]);
        assert!(lock.contains(&entry), "{part:?}");
    }
}
