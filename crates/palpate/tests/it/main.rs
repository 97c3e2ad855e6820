//! The built command, as a user meets it.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "tests print what they found; one that cannot run its command has failed"
)]

mod arrows;
mod closed_loop;
mod contract_solve;
mod crash;
mod design;
mod devices;
mod errors;
mod esophagus;
mod exit_status;
mod first_steps;
mod foreign_text;
mod hazards;
mod limits;
mod measure;
mod mesh;
mod mesh_info;
mod nothing_lost;
mod notices;
mod palpation;
mod progress;
mod quality;
mod readme_numbers;
mod recordings;
mod report;
mod report_analyze;
mod reproduce;
mod reproduce_recordings;
mod reproduce_rig;
mod reproduce_whole;
mod score;
mod simulate;
mod solve;
mod solve_errors;
mod solve_fibres;
mod solve_tools;
mod window;

use std::path::Path;
use std::process::{Command, Output};

/// Runs the command in `folder`.
fn palpate_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn palpate(arguments: &[&str]) -> Output {
    palpate_in(Path::new("."), arguments)
}

/// What a command that must succeed prints, as JSON.
fn json(output: &Output) -> serde_json::Value {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn every_help_is_printed_and_is_no_error() {
    let commands: [&[&str]; 12] = [
        &["--help"],
        &["--version"],
        &["simulate", "--help"],
        &["mesh", "--help"],
        &["mesh", "info", "--help"],
        &["reproduce", "--help"],
        &["solve", "--help"],
        &["quality", "--help"],
        &["devices", "--help"],
        &["analyze", "--help"],
        &["characterize", "--help"],
        &["progress", "--help"],
    ];
    for command in commands {
        let output = palpate(command);
        assert_eq!(output.status.code(), Some(0), "{command:?}");
        assert!(!output.stdout.is_empty() && output.stderr.is_empty());
    }
    assert!(stdout(&palpate(&["mesh", "info", "--help"])).contains("Examples:"));
}

/// `palpate … | head`: the reader goes, and that is nothing to complain about.
#[test]
fn a_reader_that_goes_is_no_panic() {
    use std::process::Stdio;
    let mut child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(["mesh", "info", "--builtin", "liver"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(stderr(&output), "");
    assert_eq!(output.status.code(), Some(0));
}
