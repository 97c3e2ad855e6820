//! The exit status follows from the kind of error: 2 when the input is invalid, 1 for any other failure.

use std::fs;

use crate::{palpate_in, stderr};

/// A law that softens so soon that Newton's method finds no equilibrium under the punch.
const WITHOUT_EQUILIBRIUM: &str = "\
format = 1
kind = \"indentation\"
block = { radius_m = 0.01, height_m = 0.01 }
tissue = { law = \"mooney_rivlin\", c10_pa = 1000.0, c01_pa = -950.0 }
indenter = { radius_m = 0.001 }
depths_m = [0.004]
accuracy = 0.2
";

/// The exit status and the error of `palpate solve` on a problem.
fn solved(problem: &str) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("problem.toml"), problem).unwrap();
    let output = palpate_in(folder.path(), &["solve", "problem.toml"]);
    (output.status.code(), stderr(&output))
}

#[test]
fn a_solver_that_finds_no_equilibrium_is_a_failure() {
    let (status, said) = solved(WITHOUT_EQUILIBRIUM);
    assert!(said.contains("problem.toml: no equilibrium"), "{said}");
    assert_eq!(status, Some(1), "{said}");
}

#[test]
fn a_value_that_is_out_of_range_is_invalid_input() {
    let (status, said) = solved(&WITHOUT_EQUILIBRIUM.replace("-950.0", "-1050.0"));
    assert!(said.contains("c01"), "{said}");
    assert_eq!(status, Some(2), "{said}");
}

#[test]
fn a_file_that_is_something_else_is_invalid_input() {
    let (status, said) = solved("an essay");
    assert!(said.contains("problem.toml line 1"), "{said}");
    assert_eq!(status, Some(2), "{said}");
}

#[test]
fn memory_that_does_not_suffice_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let made = palpate_in(folder.path(), &["examples", "."]);
    assert!(made.status.success(), "{}", stderr(&made));
    let scene = "esophagus/scene.toml";
    let output = palpate_in(
        folder.path(),
        &["precompute", scene, "--memory-gb", "0.000001"],
    );
    let said = stderr(&output);
    assert!(said.contains("of memory"), "{said}");
    assert_eq!(output.status.code(), Some(1), "{said}");
}
