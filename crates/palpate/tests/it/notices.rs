//! The notices that are owed to others go along with programs, crates and wheels.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::{palpate, stdout};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// Judge: the lock file, which has every crate of a build. `.ci/notices` writes the notices anew.
#[test]
fn every_crate_of_the_lock_file_is_in_the_notices() {
    let lock = text("Cargo.lock");
    let value = |package: &str, key: &str| {
        let line = package.lines().find_map(|line| line.strip_prefix(key))?;
        Some(line.trim_matches(['=', ' ', '"']).to_owned())
    };
    let packages = lock.split("[[package]]").skip(1);
    let foreign = packages.filter(|package| package.contains("\nsource = "));
    let crates: BTreeSet<String> = foreign
        .filter_map(|package| {
            Some(format!(
                "{} {}",
                value(package, "name ")?,
                value(package, "version ")?
            ))
        })
        .collect();
    assert!(crates.len() > 300, "{}", crates.len());
    let notices = text("THIRD-PARTY.txt");
    let listed: BTreeSet<&str> = notices
        .lines()
        .flat_map(|line| line.trim().split(", "))
        .map(|name| name.trim_end_matches(','))
        .collect();
    let missing: Vec<_> = crates
        .iter()
        .filter(|own| !listed.contains(own.as_str()))
        .collect();
    assert!(missing.is_empty(), "run `.ci/notices`: {missing:?}");
    for licence in [
        "Apache License",
        "Permission is hereby granted, free of charge",
        "Mozilla Public License Version 2.0",
        "UBUNTU FONT LICENCE Version 1.0",
        "SIL Open Font License",
        "Bitstream Vera",
        "Font DejaVu Sans",
        "Font Hack",
        "Font Noto Emoji",
    ] {
        assert!(notices.contains(licence), "{licence}");
    }
}

#[test]
fn the_command_prints_the_notices() {
    assert_eq!(stdout(&palpate(&["--notices"])), text("THIRD-PARTY.txt"));
}

/// `cargo package` and `maturin` take what lies in the folder of a crate.
#[test]
fn every_crate_has_its_licences() {
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        for file in ["LICENSE-MIT", "LICENSE-APACHE"] {
            let own = fs::read_to_string(folder.join(file)).unwrap_or_default();
            assert_eq!(own, text(file), "{}", folder.join(file).display());
        }
    }
    let wheel = text("crates/python/pyproject.toml");
    assert!(
        wheel
            .contains("license-files = [\"LICENSE-MIT\", \"LICENSE-APACHE\", \"THIRD-PARTY.txt\"]")
    );
    assert_eq!(
        text("crates/python/THIRD-PARTY.txt"),
        text("THIRD-PARTY.txt")
    );
}
