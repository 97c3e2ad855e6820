//! Bad input: exit status 2 and one sentence on standard error.

use std::fs;

use crate::{palpate, palpate_in, stderr};

pub(crate) fn assert_refused(folder: &std::path::Path, arguments: &[&str], words: &[&str]) {
    let output = palpate_in(folder, arguments);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with("palpate: error: "), "{message}");
    for word in words {
        assert!(message.contains(word), "{message} lacks {word}");
    }
}

#[test]
fn a_mesh_that_cannot_be_read_is_named_with_the_cause() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("empty.stl"), "").unwrap();
    fs::create_dir(folder.join("folder.stl")).unwrap();
    fs::write(folder.join("notes.txt"), "v 0 0 0").unwrap();
    // A triangle of 120 units: no organ in metres.
    let large = "v 0 0 0\nv 120 0 0\nv 0 100 0\nf 1 2 3\n";
    fs::write(folder.join("large.obj"), large).unwrap();
    let refused = |file, words: &[&str]| assert_refused(folder, &["mesh", "info", file], words);
    refused(
        "missing.stl",
        &["missing.stl", "no such file", "check the path"],
    );
    refused("folder.stl", &["folder.stl", "not a file"]);
    refused("empty.stl", &["empty.stl", "empty"]);
    refused("notes.txt", &["notes.txt", ".stl"]);
    refused("large.obj", &["large.obj", "120", "--unit"]);
    let unit = ["mesh", "info", "large.obj", "--unit", "inch"];
    assert_refused(folder, &unit, &["inch", "mm"]);
}

#[test]
fn a_word_that_is_not_known_is_answered_with_the_nearest() {
    let folder = tempfile::tempdir().unwrap();
    let refused =
        |arguments: &[&str], words: &[&str]| assert_refused(folder.path(), arguments, words);
    refused(
        &["mesh", "info", "--builtin", "kidny"],
        &["`kidny`", "nearest is `kidney`", "spleen"],
    );
    refused(
        &["reproduce", "tabel-3-1"],
        &["`tabel-3-1`", "nearest is `table-3-1`", "figure-4-5"],
    );
    refused(
        &["reproduce", "table-3-1/soluton_s"],
        &["nearest is `table-3-1/solution_s`"],
    );
    refused(
        &["mesh", "info", "--builtin", "liver", "--triangles", "3"],
        &["200"],
    );
    refused(&["simulat"], &["simulat", "simulate", "--help"]);
    refused(&["mesh", "info"], &["FILE", "--builtin", "--help"]);
    refused(&["mesh", "info", "a.stl", "--jsn"], &["--jsn", "--json"]);
    // Nothing was made.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("taken"), "").unwrap();
    for out in ["taken", "taken/below"] {
        let arguments = ["reproduce", "figure-4-5", "--out", out];
        assert_refused(folder.path(), &arguments, &["taken", "--out"]);
    }
}

/// The parts of a command are listed instead of a sentence.
#[test]
fn half_a_command_is_answered_with_its_parts() {
    let output = palpate(&["mesh"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("info"));
}
