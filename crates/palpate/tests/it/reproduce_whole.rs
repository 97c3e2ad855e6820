//! `palpate reproduce` as a whole: every item has its rows, and one that fails takes no other with it.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::reproduce::{find, reproduce};
use crate::reproduce_recordings::assert_complete;
use crate::{json, palpate, palpate_in, stderr, stdout};

/// Usual duration of a part [s] on one core.
const PART: f64 = 300.0;

/// Each has a test.
const PARTS: usize = 6;

/// Names and usual durations [s] of all items.
fn listed() -> Vec<(String, f64)> {
    let list = json(&palpate(&["reproduce", "--list", "--json"]));
    let item = |item: &Value| {
        let name = item["item"].as_str().unwrap().to_owned();
        (name, item["seconds"].as_f64().unwrap())
    };
    list.as_array().unwrap().iter().map(item).collect()
}

/// The items in their order, in parts of at most [`PART`], or of one item.
fn parts() -> Vec<Vec<String>> {
    let mut parts = vec![Vec::new()];
    let mut filled = 0.0;
    for (name, seconds) in listed() {
        if filled + seconds > PART && filled > 0.0 {
            parts.push(Vec::new());
            filled = 0.0;
        }
        filled += seconds;
        parts.last_mut().unwrap().push(name);
    }
    parts
}

/// Computes the items, and checks that each has a row, each row a number, a figure or a reason, and that none failed.
fn run_through(items: &[String]) {
    let words: Vec<&str> = items.iter().map(String::as_str).collect();
    let (folder, rows) = reproduce(&words);
    assert_complete(&folder, &rows);
    let failed: Vec<&Value> = rows.iter().filter(|row| row["mark"] == "failed").collect();
    assert!(failed.is_empty(), "{failed:?}");
    // A brace left in a note has no value.
    let unfilled = rows
        .iter()
        .filter(|row| row["note"].as_str().unwrap().contains('{'));
    let unfilled: Vec<&Value> = unfilled.collect();
    assert!(unfilled.is_empty(), "{unfilled:?}");
    for item in items {
        let is_of = |row: &Value| {
            let name = row["row"].as_str().unwrap();
            name == item || name.starts_with(&format!("{item}/"))
        };
        assert!(rows.iter().any(is_of), "{item} has no row");
    }
    // The file has the same rows as the answer.
    let kept = fs::read_to_string(folder.path().join("palpate-reproduce/rows.jsonl")).unwrap();
    let kept: Vec<Value> = kept
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(kept, rows);
}

/// The quick form: all items that take less than 0.3 s, and those that are not computed.
#[test]
fn quick_items_run_through() {
    let quick = listed().into_iter().filter(|(_, seconds)| *seconds < 0.3);
    let quick: Vec<String> = quick.map(|(name, _)| name).collect();
    assert!(quick.len() > 40, "{quick:?}");
    run_through(&quick);
    assert_eq!(parts().len(), PARTS, "as many tests as parts");
}

/// Judge: the command itself: each item of its list has a row, each row a number, a figure or a reason, none failed.
#[test]
#[ignore = "slow: the first part of all items"]
fn everything_runs_through_in_part_1() {
    run_through(&parts()[0]);
}

/// Judge: the command itself, as in part 1.
#[test]
#[ignore = "slow: the second part of all items"]
fn everything_runs_through_in_part_2() {
    run_through(&parts()[1]);
}

/// Judge: the command itself, as in part 1.
#[test]
#[ignore = "slow: the third part of all items"]
fn everything_runs_through_in_part_3() {
    run_through(&parts()[2]);
}

/// Judge: the command itself, as in part 1.
#[test]
#[ignore = "slow: the fourth part of all items"]
fn everything_runs_through_in_part_4() {
    run_through(&parts()[3]);
}

/// Judge: the command itself, as in part 1.
#[test]
#[ignore = "slow: the fifth part of all items"]
fn everything_runs_through_in_part_5() {
    run_through(&parts()[4]);
}

/// Judge: the command itself, as in part 1.
#[test]
#[ignore = "slow: the sixth part of all items"]
fn everything_runs_through_in_part_6() {
    run_through(&parts()[5]);
}

/// A mesh that cannot be read fails the item that needs it.
#[test]
fn an_item_that_fails_is_a_row_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    let mesh = "meshes/bp3d_esophagus_21146.ply";
    fs::write(folder.path().join(mesh), "no mesh").unwrap();
    let run = |words: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .arg("reproduce")
            .args(words)
            .env("PALPATE_DATA", folder.path())
            .current_dir(folder.path())
            .output();
        output.unwrap()
    };
    let rows = json(&run(&["section-7-4", "equation-7-6", "--json"]));
    let rows = rows.as_array().unwrap();
    let failed = find(rows, "section-7-4");
    assert_eq!(failed["mark"], "failed");
    assert!(failed["note"].as_str().unwrap().contains(mesh), "{failed}");
    let mass = find(rows, "equation-7-6/g1/mass");
    assert!(mass["ours"].is_f64() && mass["mark"] == "pipeline_only");
    // Also when one of its rows is asked for, and for a person.
    let output = run(&["section-7-4/triangles"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("failed") && text.contains(mesh), "{text}");
}

#[test]
fn an_exact_name_selects_nothing_else() {
    let (_folder, rows) = reproduce(&["figure-5-1"]);
    let names = rows.iter().map(|row| row["row"].as_str().unwrap());
    let others: Vec<&str> = names
        .filter(|name| *name != "figure-5-1" && !name.starts_with("figure-5-1/"))
        .collect();
    assert!(rows.len() > 1 && others.is_empty(), "{others:?}");
    let (_folder, rows) = reproduce(&["equation-6-18/liver/c10"]);
    let names: Vec<_> = rows.iter().map(|row| row["row"].clone()).collect();
    assert_eq!(names, ["equation-6-18/liver/c10"]);
    // What no row is called selects by its beginning.
    let (_folder, rows) = reproduce(&["equation-6-18/liver/c"]);
    assert_eq!(rows.len(), 3);
}

#[test]
fn the_list_has_every_item_with_its_title() {
    let folder = tempfile::tempdir().unwrap();
    let text = stdout(&palpate_in(folder.path(), &["reproduce", "--list"]));
    let items = listed();
    assert_eq!(text.lines().count(), items.len());
    for (line, (name, _)) in text.lines().zip(&items) {
        assert!(line.starts_with(&format!("{name} ")), "{line}");
    }
    // Nothing was made.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// A run whose second item takes minutes, at the moment when the first one's rows are on the disk.
fn begun(folder: &tempfile::TempDir) -> Child {
    let child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(["reproduce", "equation-6-3", "figure-6-8"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while kept(folder).is_empty() {
        assert!(begun.elapsed() < Duration::from_secs(60), "no row is kept");
        sleep(Duration::from_millis(20));
    }
    child
}

fn kept(folder: &tempfile::TempDir) -> String {
    fs::read_to_string(folder.path().join("palpate-reproduce/rows.jsonl")).unwrap_or_default()
}

#[test]
fn a_killed_run_keeps_its_finished_rows() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = begun(&folder);
    child.kill().unwrap();
    child.wait().unwrap();
    let rows = kept(&folder);
    assert!(rows.lines().count() > 1);
    for line in rows.lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        assert!(row["row"].as_str().unwrap().starts_with("equation-6-3/"));
    }
}

/// Ctrl-C ends the command with a sentence, and what was printed stays printed.
#[cfg(unix)]
#[test]
fn an_interrupted_run_has_printed_its_finished_rows() {
    let folder = tempfile::tempdir().unwrap();
    let child = begun(&folder);
    // The section is printed right after its rows are kept.
    sleep(Duration::from_millis(300));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("rows.jsonl"),
        "{}",
        stderr(&output)
    );
    assert!(
        stdout(&output).contains("pipeline only"),
        "{}",
        stdout(&output)
    );
}
