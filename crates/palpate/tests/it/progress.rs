//! `palpate progress`. Judge: a record of few attempts whose numbers are worked out by hand.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use palpate_record::{Attempt, Better, Measure, Record};
use tempfile::TempDir;

use crate::errors::assert_refused;
use crate::report::{parse, texts};
use crate::{json, palpate_in, stderr, stdout};

const FILE: &str = "training.sqlite";

/// An attempt at time `when` [min] that took `time` [s], with so many errors.
fn attempt(trainee: &str, when: i64, time: f64, errors: f64) -> Attempt {
    let measure = |key: &str, value, better| Measure {
        key: key.to_owned(),
        value,
        better,
    };
    Attempt {
        trainee: trainee.to_owned(),
        task: "Cut <straight>".to_owned(),
        scene_digest: "ab12".to_owned(),
        when: 1_000_000_000 + 60 * when,
        session: PathBuf::from(format!("/sessions/{trainee}-{when}")),
        session_digest: format!("{trainee}-{when}"),
        passed: Some(time < 25.0),
        is_expert: trainee == "Expert",
        measures: vec![
            measure("time_s", time, Better::Less),
            measure("left.path_m", time / 10.0, Better::Less),
            measure("force_limit_errors", errors, Better::Less),
            measure("drops", 0.0, Better::Less),
        ],
    }
}

/// Experts of 10 ± 2 s and 1 ± 1 errors, two trainees, out of order.
pub(crate) fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut record = Record::open(folder.path().join(FILE)).unwrap();
    for (when, time, errors) in [(0, 8.0, 0.0), (1, 10.0, 1.0), (2, 12.0, 2.0)] {
        record.add(&attempt("Expert", when, time, errors)).unwrap();
    }
    let anna = [
        (40, 12.0, 2.0),
        (10, 30.0, 5.0),
        (30, 11.0, 0.0),
        (20, 20.0, 3.0),
    ];
    for (when, time, errors) in anna {
        record.add(&attempt("Anna", when, time, errors)).unwrap();
    }
    for (when, time, errors) in [(15, 40.0, 1.0), (25, 24.0, 1.0)] {
        record.add(&attempt("Béla", when, time, errors)).unwrap();
    }
    let mut other = attempt("Béla", 50, 9.0, 0.0);
    other.task = "Find".to_owned();
    record.add(&other).unwrap();
    folder
}

fn progress(folder: &Path, more: &[&str]) -> std::process::Output {
    palpate_in(folder, &[&["progress", "--record", FILE], more].concat())
}

#[test]
fn the_numbers_are_those_by_hand() {
    let folder = folder();
    let answer = json(&progress(folder.path(), &["--json"]));
    let task = &answer["tasks"][0];
    assert_eq!(task["task"], "Cut <straight>");
    let time = &task["standards"][0];
    assert_eq!(time["measure"], "time_s");
    assert_eq!(
        [&time["mean"], &time["standard_deviation"], &time["n"]],
        [10.0, 2.0, 3.0]
    );
    let curve = &task["learning_curve"]["time_s"]["trainees"];
    // (30 + 40) / 2 ± √50, (20 + 24) / 2 ± √8, 11, 12.
    let means = [35.0, 22.0, 11.0, 12.0];
    let deviations = [Some(50.0_f64.sqrt()), Some(8.0_f64.sqrt()), None, None];
    for (place, (mean, deviation)) in means.iter().zip(deviations).enumerate() {
        assert_eq!(curve[place]["mean"], *mean);
        let own = curve[place]["standard_deviation"].as_f64();
        assert_eq!(own.is_some(), deviation.is_some());
        assert!((own.unwrap_or(0.0) - deviation.unwrap_or(0.0)).abs() < 1e-12);
    }
    assert_eq!(curve.as_array().unwrap().len(), 4);
    let errors = &task["learning_curve"]["errors"];
    assert_eq!(errors["trainees"][0]["mean"], 3.0);
    assert_eq!(
        [
            &errors["experts"]["mean"],
            &errors["experts"]["standard_deviation"]
        ],
        [1.0, 1.0]
    );
    let [anna, bela] = [0, 1].map(|place| &task["trainees"][place]);
    assert_eq!([&anna["trainee"], &bela["trainee"]], ["Anna", "Béla"]);
    // 11 s and 12 s with none and two errors are within; 20 s is not.
    assert_eq!(anna["proficient_since_attempt"], 4);
    assert!(bela["proficient_since_attempt"].is_null());
    let proficient: Vec<_> = (0..4)
        .map(|place| &anna["attempts"][place]["proficient"])
        .collect();
    assert_eq!(proficient, [false, false, true, true]);
    assert_eq!(anna["attempts"][0]["date_utc"], "2001-09-09T01:56:40Z");
    assert_eq!(answer["tasks"][1]["task"], "Find");
    let warnings = answer["warnings"].to_string();
    assert!(
        warnings.contains("no session of an expert at `Find`"),
        "{warnings}"
    );
}

#[test]
fn one_trainee_and_one_task_are_shown_alone() {
    let folder = folder();
    let of = |more: &[&str]| json(&progress(folder.path(), &[more, &["--json"]].concat()));
    let anna = of(&["--trainee", "Anna"]);
    assert_eq!(anna["tasks"].as_array().unwrap().len(), 1);
    assert_eq!(anna["tasks"][0]["trainees"].as_array().unwrap().len(), 1);
    assert_eq!(anna["tasks"][0]["experts"], 3);
    assert_eq!(
        anna["tasks"][0]["learning_curve"]["time_s"]["trainees"][0]["mean"],
        30.0
    );
    let find = of(&["--task", "Find"]);
    assert_eq!(find["tasks"].as_array().unwrap().len(), 1);
    let refused = |more: &[&str], words: &[&str]| {
        let said = [&["progress", "--record", FILE], more].concat();
        assert_refused(folder.path(), &said, words);
    };
    refused(&["--trainee", "Ana"], &["`Ana`", "nearest is `Anna`"]);
    refused(&["--task", "find"], &["`find`", "nearest is `Find`"]);
}

#[test]
fn people_read_attempts_and_the_rule() {
    let folder = folder();
    let output = progress(folder.path(), &[]);
    let text = stdout(&output);
    for words in [
        "Cut <straight>: 6 attempts of 2 trainees, 3 sessions of experts",
        "Anna: proficient since attempt 4",
        "Béla: not proficient yet",
        "2001-09-09 01:56",
        "2 of 4",
        "4 of 4",
        "after 2 attempts in a row",
    ] {
        assert!(text.contains(words), "{words}:\n{text}");
    }
    // An expert, and somebody who did something else.
    for more in [
        ["--trainee", "Expert", "--task", "Find"],
        ["--trainee", "Anna", "--task", "Find"],
    ] {
        assert!(stdout(&progress(folder.path(), &more)).contains("no such attempt"));
    }
    // Measure by measure for one of them.
    let text = stdout(&progress(folder.path(), &["--trainee", "Anna"]));
    let line = text
        .lines()
        .find(|line| line.trim_start().starts_with("time_s"));
    let words: Vec<_> = line.unwrap().split_whitespace().collect();
    assert_eq!(
        words,
        ["time_s", "12.00", "s", "10.0", "±", "2.0", "s", "yes"]
    );
    assert!(stderr(&output).contains("warning: no session of an expert at `Find`"));
}

/// A row for each measure of each attempt, which any program reads.
#[test]
fn the_table_has_every_measure_of_every_attempt() {
    let folder = folder();
    let output = progress(folder.path(), &["--csv", "attempts.csv"]);
    assert!(stdout(&output).contains("written: attempts.csv"));
    let mut reader = csv::Reader::from_path(folder.path().join("attempts.csv")).unwrap();
    let head = reader.headers().unwrap().clone();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 10 * 4);
    let cell = |row: &csv::StringRecord, name: &str| {
        let place = head.iter().position(|own| own == name).unwrap();
        row[place].to_owned()
    };
    let own: Vec<_> = rows
        .iter()
        .filter(|row| cell(row, "trainee") == "Anna" && cell(row, "measure") == "time_s")
        .map(|row| ["attempt", "value", "proficient", "passed"].map(|name| cell(row, name)))
        .collect();
    let expected = [
        ["1", "30", "false", "false"],
        ["2", "20", "false", "true"],
        ["3", "11", "true", "true"],
        ["4", "12", "true", "true"],
    ];
    assert_eq!(own, expected);
    let experts = rows.iter().filter(|row| cell(row, "expert") == "true");
    assert_eq!(
        experts
            .filter(|row| cell(row, "attempt").is_empty())
            .count(),
        12
    );
}

/// The page stands alone, and what a record says is text and nothing else.
#[test]
fn a_page_has_learning_curves() {
    let folder = folder();
    let mut record = Record::open(folder.path().join(FILE)).unwrap();
    record
        .add(&attempt("<script>alert(1)</script>", 60, 15.0, 1.0))
        .unwrap();
    drop(record);
    let page = || {
        let output = progress(folder.path(), &["--report", "page.html", "--overwrite"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        fs::read_to_string(folder.path().join("page.html")).unwrap()
    };
    let text = page();
    let document = parse(&text);
    assert_eq!(texts(&document, "h2"), ["Cut <straight>", "Find"]);
    let figures = texts(&document, "h4");
    let all = ["Operation time", "Errors", "Proficient measures"];
    assert_eq!(figures[..3], all);
    // Nobody is beside an expert where there is none.
    assert_eq!(figures[3..], all[..2]);
    let drawn = texts(&document, "figure").join(" ");
    assert!(
        drawn.contains("mean of 3 trainees") && drawn.contains("experts"),
        "{drawn}"
    );
    let parts = texts(&document, "h3");
    for part in [
        "Attempts",
        "Latest attempts compared with the experts",
        "Provenance",
    ] {
        assert!(parts.iter().any(|own| own == part), "{part}: {parts:?}");
    }
    let cells = texts(&document, "td").join(" ");
    assert!(
        cells.contains("✗ 15.00\u{202f}s") && cells.contains("2001-09-09 01:56"),
        "{cells}"
    );
    assert!(!text.contains("<script") && text.contains("prefers-color-scheme: dark"));
    let mut attributes = document.descendants().flat_map(|node| node.attributes());
    assert!(!attributes.any(|own| ["href", "src"].contains(&own.name())));
    assert_eq!(page(), text, "the same bytes again");
}

#[test]
fn records_that_are_none_are_refused_and_left_as_they_are() {
    let folder = folder();
    let path = folder.path().join(FILE);
    let refused =
        |words: &[&str]| assert_refused(folder.path(), &["progress", "--record", FILE], words);
    for out in ["--csv", "--report"] {
        let said = ["progress", "--record", FILE, out, "./training.sqlite"];
        assert_refused(folder.path(), &said, &["itself"]);
    }
    let sound = fs::read(&path).unwrap();
    let cases = [sound[..9000].to_vec(), vec![7; 5000], b"text\n".to_vec()];
    for bytes in cases {
        fs::write(&path, &bytes).unwrap();
        refused(&[FILE, "damaged", "as it is"]);
        assert_eq!(fs::read(&path).unwrap(), bytes);
    }
    fs::remove_file(&path).unwrap();
    refused(&[FILE, "no training record yet"]);
    fs::create_dir(&path).unwrap();
    refused(&[FILE, "folder"]);
    fs::write(folder.path().join("notes.txt"), "notes").unwrap();
    assert_refused(
        folder.path(),
        &["progress", "--record", "notes.txt"],
        &["notes.txt", "no training record"],
    );
    let nowhere = ["progress", "--record", FILE, "--csv", "nowhere/table.csv"];
    assert_refused(folder.path(), &nowhere, &["nowhere"]);
}

#[test]
fn a_record_without_attempts_says_so() {
    let folder = tempfile::tempdir().unwrap();
    drop(Record::open(folder.path().join(FILE)).unwrap());
    assert!(stdout(&progress(folder.path(), &[])).contains("holds no attempt of a trainee yet"));
    let answer = json(&progress(folder.path(), &["--json"]));
    assert_eq!(answer["tasks"].as_array().unwrap().len(), 0);
    assert_refused(
        folder.path(),
        &["progress", "--record", FILE, "--trainee", "Anna"],
        &["empty"],
    );
}

/// Without a name, the record of this user is read.
#[cfg(target_os = "linux")]
#[test]
fn the_users_own_record_is_the_default() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("palpate/training.sqlite");
    let mut record = Record::open(path).unwrap();
    record.add(&attempt("Anna", 0, 30.0, 1.0)).unwrap();
    drop(record);
    let output = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(["progress", "--json"])
        .env("XDG_DATA_HOME", folder.path())
        .output()
        .unwrap();
    assert_eq!(json(&output)["tasks"][0]["trainees"][0]["trainee"], "Anna");
}

/// What leaves the house has no names, no dates and no folders. Judge: none of them stands in the files.
#[test]
fn anonymous_files_name_nobody() {
    let folder = folder();
    let more = ["--anonymous", "--xapi", "s.json", "--csv", "s.csv"];
    let output = progress(folder.path(), &more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    for name in ["s.json", "s.csv"] {
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        for told in ["Anna", "Béla", "Expert\"", "/sessions/", "2001"] {
            assert!(!text.contains(told), "{told} in {name}");
        }
        assert!(text.contains("trainee 2"), "{name}");
    }
}

/// Judge: the words of the xAPI specification, version 1.0.3, and the attempts.
#[test]
fn statements_are_those_of_the_experience_api() {
    let folder = folder();
    progress(folder.path(), &["--xapi", "s.json"]);
    let text = fs::read_to_string(folder.path().join("s.json")).unwrap();
    let all: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    // Seven attempts of trainees; experts learn nothing.
    assert_eq!(all.len(), 7);
    let first = &all[0];
    assert_eq!(first["actor"]["account"]["name"], "Anna");
    assert_eq!(first["verb"]["id"], "http://adlnet.gov/expapi/verbs/failed");
    assert_eq!(first["result"]["success"], false);
    assert_eq!(first["result"]["duration"], "PT30.00S");
    assert_eq!(first["timestamp"], "2001-09-09T01:56:40Z");
    let id = first["object"]["id"].as_str().unwrap();
    assert!(id.ends_with("/task/Cut%20%3Cstraight%3E"), "{id}");
    let measures = first["result"]["extensions"].as_object().unwrap();
    assert_eq!(measures.len(), 4);
}

/// A teacher's commands on the same record. Judge: the attempts by hand.
#[test]
fn a_cohort_has_an_assignment() {
    let folder = folder();
    let teacher = |more: &[&str]| {
        let said = [&["teacher", "--record", FILE], more].concat();
        let output = palpate_in(folder.path(), &said);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    };
    let refused = |more: &[&str], words: &[&str]| {
        let said = [&["teacher", "--record", FILE], more].concat();
        assert_refused(folder.path(), &said, words);
    };
    teacher(&["cohort", "spring", "--add", "Anna", "--add", "Carla"]);
    let task = "Cut <straight>";
    teacher(&[
        "assign",
        "spring",
        task,
        "--due",
        "2001-09-09",
        "--passes",
        "2",
    ]);
    refused(
        &["assign", "spring", task, "--due", "2001-02-30"],
        &["`2001-02-30`"],
    );
    let shown: serde_json::Value = serde_json::from_str(&teacher(&["show", "--json"])).unwrap();
    let given = &shown["assignments"][0];
    assert_eq!(given["due_utc"], "2001-09-09T23:59:59Z");
    let [anna, carla] = [0, 1].map(|place| &given["trainees"][place]);
    // Passed below 25 s: 20 s, 11 s and 12 s.
    assert_eq!([&anna["attempts"], &anna["passed"]], [4, 3]);
    assert_eq!([&anna["standing"], &carla["standing"]], ["done", "late"]);
    assert!(teacher(&["show"]).contains("done  passed 3 of 4 attempts"));
    // The cohort alone.
    let only = json(&progress(folder.path(), &["--cohort", "spring", "--json"]));
    assert_eq!(only["tasks"][0]["trainees"].as_array().unwrap().len(), 1);
    refused(&["cohort"], &["NAME"]);
    teacher(&["pin", "4711"]);
    refused(&["cohort", "spring", "--add", "Béla"], &["PIN", "--pin"]);
    teacher(&["cohort", "spring", "--add", "Béla", "--pin", "4711"]);
    // To look is everybody's.
    assert!(teacher(&["show"]).contains("Béla"));
}
