//! Nothing is lost and nothing falsified: refused commands, commands that are killed, two at once. Judges: the bytes
//! before, and the whole run.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use palpate_files::{Claim, Overwrite, Session};
use palpate_record::{Filter, Record};
use serde_json::Value;
use tempfile::TempDir;

use crate::{json, palpate_in, stderr, stdout};

const SCENE: &str = "\
format = 1
[organ]
builtin = \"hemisphere\"
[organ.tissue]
law = \"linear\"
youngs_modulus_pa = 10000.0
poissons_ratio = 0.45
[[tool]]
name = \"right\"
tip = { shape = \"flat\", radius_m = 0.001, contact = \"slip\" }
[task]
title = \"Press\"
";

/// Through the pole, 3 mm deep at 1 s, and out again until `end` [s].
fn motion(end: f64) -> String {
    format!(
        "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,right,0.0,0.0,0.051\n1.0,right,0.0,0.0,0.047\n\
         {end:?},right,0.0,0.0,0.051\n"
    )
}

/// A folder with a scene, a motion of two seconds and one of an hour.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("scene.toml"), SCENE).unwrap();
    fs::write(at("motion.csv"), motion(2.0)).unwrap();
    fs::write(at("long.csv"), motion(3600.0)).unwrap();
    folder
}

fn arguments<'a>(motion: &'a str, out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let mut all = vec!["simulate", "scene.toml", "--headless", "--motion", motion];
    all.extend(["--out", out]);
    all.extend(more);
    all
}

fn simulate(folder: &Path, motion: &str, out: &str, more: &[&str]) -> Output {
    palpate_in(folder, &arguments(motion, out, more))
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

fn refused(output: &Output, status: i32, words: &[&str]) {
    let said = stderr(output);
    assert_eq!(output.status.code(), Some(status), "{said}");
    for word in words {
        assert!(said.contains(word), "{said} lacks {word}");
    }
}

/// The files of a folder with their bytes.
fn bytes(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .map(|path| (path.clone(), fs::read(path).unwrap()))
        .collect()
}

/// A motion that is being played, from its first thousand bytes on.
fn begun(folder: &Path, out: &str) -> Child {
    let child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments("long.csv", out, &[]))
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let session = folder.join(out).join("session.csv.part");
    let patience = Instant::now();
    while fs::metadata(&session).map_or(0, |data| data.len()) < 30_000 {
        assert!(patience.elapsed() < Duration::from_secs(60), "no session");
        sleep(Duration::from_millis(5));
    }
    child
}

#[test]
fn a_refused_simulation_leaves_the_session_as_it_was() {
    let folder = folder();
    let folder = folder.path();
    done(&simulate(folder, "motion.csv", "out", &[]));
    let before = bytes(&folder.join("out"));
    let unchanged = || assert!(bytes(&folder.join("out")) == before);
    // Without being asked nothing is replaced.
    refused(
        &simulate(folder, "motion.csv", "out", &[]),
        2,
        &["session.csv is there already", "--overwrite"],
    );
    unchanged();
    // A tool that the scene has not, too many steps, and a scene that cannot be prepared.
    fs::write(
        folder.join("other.csv"),
        motion(2.0).replace("right", "rihgt"),
    )
    .unwrap();
    fs::write(folder.join("endless.csv"), motion(1e9)).unwrap();
    refused(
        &simulate(folder, "other.csv", "out", &["--overwrite"]),
        2,
        &["rihgt"],
    );
    unchanged();
    refused(
        &simulate(folder, "endless.csv", "out", &["--overwrite"]),
        2,
        &["steps"],
    );
    unchanged();
    let hybrid = SCENE.replace(
        "[organ.tissue]",
        "[model]\nkind = \"hybrid\"\n[organ.anchor]\nspheres = [{ center_m = [9, 9, 9], radius_m = 0.1 }]\n\
         [organ.tissue]",
    );
    fs::write(folder.join("scene.toml"), hybrid).unwrap();
    refused(
        &simulate(folder, "motion.csv", "out", &["--overwrite"]),
        2,
        &["anchor"],
    );
    unchanged();
    // What is refused makes no folder either.
    refused(&simulate(folder, "other.csv", "new", &[]), 2, &[]);
    assert!(!folder.join("new").exists());
    fs::write(folder.join("scene.toml"), SCENE).unwrap();
    fs::write(folder.join("motion.csv"), motion(3.0)).unwrap();
    done(&simulate(folder, "motion.csv", "out", &["--overwrite"]));
    let session = Session::read(folder.join("out/session.csv")).unwrap();
    assert_eq!((session.rows.len(), session.incomplete), (601, None));
}

/// The scene that is played is not replaced by the one that is kept with the session.
#[test]
fn a_session_beside_its_scene_is_refused() {
    let folder = folder();
    let output = simulate(folder.path(), "motion.csv", ".", &[]);
    refused(&output, 2, &["scene.toml is there already"]);
    assert_eq!(
        fs::read_to_string(folder.path().join("scene.toml")).unwrap(),
        SCENE
    );
}

/// The demonstration replaces its own results, and nothing that a user changed.
#[test]
fn the_demonstration_can_be_repeated() {
    let folder = tempfile::tempdir().unwrap();
    let play = || {
        let command = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .current_dir(folder.path())
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .output();
        let output = command.unwrap();
        done(&output);
        stdout(&output)
    };
    play();
    assert!(play().contains("written to palpate-demo/:"));
    let motion = folder.path().join("palpate-demo/motion.csv");
    fs::write(&motion, "mine").unwrap();
    assert!(play().contains("written to palpate-demo-2/:"));
    assert_eq!(fs::read_to_string(motion).unwrap(), "mine");
}

#[test]
fn a_second_writer_is_refused() {
    let folder = folder();
    let folder = folder.path();
    let mut first = begun(folder, "out");
    let process = first.id().to_string();
    let second = simulate(folder, "motion.csv", "out", &["--overwrite"]);
    refused(
        &second,
        1,
        &["out is being written by another program", &process],
    );
    // Of a program that is killed nothing is held.
    first.kill().unwrap();
    first.wait().unwrap();
    done(&simulate(folder, "motion.csv", "out", &["--overwrite"]));
    // The same for a rig, in a folder or one file.
    fs::write(
        folder.join("protocol.toml"),
        "format = 1\n[[specimen]]\npublished = \"liver\"\n[[stimulus]]\nkind = \"ramp_and_hold\"\n\
         depth_m = 0.001\nramp_s = 0.5\nhold_s = 0.5\n",
    )
    .unwrap();
    let measure = |out: &str| {
        palpate_in(
            folder,
            &[
                "measure",
                "protocol.toml",
                "--headless",
                "--overwrite",
                "--out",
                out,
            ],
        )
    };
    let held = [
        Claim::of_folder(folder.join("recordings"), Overwrite::Refused).unwrap(),
        Claim::of_file(folder.join("one.csv"), Overwrite::Refused).unwrap(),
    ];
    refused(&measure("recordings"), 1, &["recordings is being written"]);
    refused(&measure("one.csv"), 1, &["one.csv is being written"]);
    drop(held);
    done(&measure("one.csv"));
}

fn attempts(record: &Path) -> Vec<palpate_record::Attempt> {
    match record.exists() {
        true => Record::read(record)
            .unwrap()
            .attempts(&Filter::default())
            .unwrap(),
        false => Vec::new(),
    }
}

/// A session that was killed, and one that was cut between two rows, are shown, said to be incomplete, and kept in
/// the record only when that is asked for.
#[test]
fn an_incomplete_session_is_shown_and_not_kept() {
    let folder = folder();
    let folder = folder.path();
    let mut killed = begun(folder, "killed");
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert!(!folder.join("killed/session.csv").exists());
    done(&simulate(folder, "motion.csv", "whole", &[]));
    let session = fs::read_to_string(folder.join("whole/session.csv")).unwrap();
    let half: Vec<&str> = session.lines().take(210).collect();
    fs::create_dir(folder.join("cut")).unwrap();
    fs::copy(
        folder.join("whole/scene.toml"),
        folder.join("cut/scene.toml"),
    )
    .unwrap();
    fs::write(folder.join("cut/session.csv"), half.join("\n") + "\n").unwrap();
    let record = folder.join("r.sqlite");
    let keep = |session: &str, more: &[&str]| {
        let all = [
            "score",
            session,
            "--trainee",
            "Anna",
            "--record",
            "r.sqlite",
            "--json",
        ];
        palpate_in(folder, &[&all[..], more].concat())
    };
    for session in ["killed", "cut"] {
        let shown = json(&palpate_in(folder, &["score", session, "--json"]));
        assert!(
            shown["warnings"].to_string().contains("incomplete"),
            "{shown}"
        );
        let output = keep(session, &[]);
        refused(&output, 2, &["incomplete", "--incomplete"]);
        let shown: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(shown["measures"]["time_s"].as_f64().unwrap() > 0.5);
        assert!(attempts(&record).is_empty());
        let again = json(&palpate_in(folder, &["replay", session, "--json"]));
        assert!(
            again["warnings"].to_string().contains("incomplete"),
            "{again}"
        );
        assert_eq!(again["largest_difference_n"], 0.0);
    }
    done(&keep("cut", &["--incomplete"]));
    done(&keep("whole", &[]));
    assert_eq!(attempts(&record).len(), 2);
}

/// While a session is replaced the older one stays readable, with its own scene.
#[test]
fn a_killed_replacement_leaves_the_older_session() {
    let folder = folder();
    let folder = folder.path();
    done(&simulate(folder, "motion.csv", "out", &[]));
    let session = fs::read(folder.join("out/session.csv")).unwrap();
    fs::write(folder.join("scene.toml"), SCENE.replace("Press", "Other")).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments("long.csv", "out", &["--overwrite"]))
        .current_dir(folder)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while !folder.join("out/session.csv.part").exists() {
        assert!(patience.elapsed() < Duration::from_secs(60), "no session");
        sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(fs::read(folder.join("out/session.csv")).unwrap() == session);
    let shown = json(&palpate_in(folder, &["score", "out", "--json"]));
    assert_eq!(shown["task"]["title"], "Press");
    assert!(
        shown["warnings"].to_string().contains("not finished"),
        "{shown}"
    );
}

/// A recording that is cut anywhere is said to be incomplete, whatever its top says.
#[test]
fn a_cut_recording_is_incomplete() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(
        at("protocol.toml"),
        "format = 1\n[[specimen]]\npublished = \"liver\"\n[[stimulus]]\nkind = \"ramp_and_hold\"\n\
         depth_m = 0.002\nramp_s = 0.5\nhold_s = 2.0\n",
    )
    .unwrap();
    let measure = [
        "measure",
        "protocol.toml",
        "--headless",
        "--out",
        "whole.csv",
    ];
    done(&palpate_in(folder.path(), &measure));
    let text = fs::read_to_string(at("whole.csv")).unwrap();
    let incomplete = |name: &str| {
        let output = palpate_in(folder.path(), &["analyze", name, "--json"]);
        json(&output)["warnings"].to_string().contains("incomplete")
    };
    assert!(!incomplete("whole.csv"));
    // Between two rows, and in one.
    let at_row = text[..text.len() * 65 / 100].rfind('\n').unwrap() + 1;
    for end in [at_row, at_row + 9] {
        fs::write(at("cut.csv"), &text[..end]).unwrap();
        assert!(text[..end].contains("# ended = \"whole\""));
        assert!(incomplete("cut.csv"), "{end}");
    }
    // Another row in the middle is another recording; a key above the table is not.
    let named = text.replacen("# format = 1\n", "# format = 1\n# thickness_m = 0.02\n", 1);
    fs::write(at("named.csv"), &named).unwrap();
    assert!(!incomplete("named.csv"));
    let line = text[..at_row].trim_end().rfind('\n').unwrap();
    fs::write(
        at("less.csv"),
        text[..line].to_owned() + &text[at_row - 1..],
    )
    .unwrap();
    assert!(incomplete("less.csv"));
}

/// A motion that is cut in its last number is refused, wherever the cut is; it would press anywhere.
#[test]
fn a_cut_motion_is_not_played() {
    let folder = folder();
    let folder = folder.path();
    let text = motion(2.0);
    let last = text.trim_end().rfind('\n').unwrap() + 1;
    for end in [last + 4, text.len() - 4, text.len() - 1] {
        fs::write(folder.join("cut.csv"), &text[..end]).unwrap();
        refused(
            &simulate(folder, "cut.csv", "out", &[]),
            2,
            &["cut.csv line 5", "cut"],
        );
    }
    // Cut between two rows it can be told only by its mark; without one that is said.
    let marked = format!("{text}# end = {{ rows = 3 }}\n");
    fs::write(folder.join("marked.csv"), &marked).unwrap();
    let whole = json(&simulate(folder, "marked.csv", "a", &["--json"]));
    assert!(whole["incomplete"].is_null() && whole["warnings"] == serde_json::json!([]));
    let unmarked = json(&simulate(folder, "motion.csv", "b", &["--json"]));
    assert!(
        unmarked["incomplete"].to_string().contains("no end mark"),
        "{unmarked}"
    );
    fs::write(
        folder.join("less.csv"),
        marked.replacen("1.0,right,0.0,0.0,0.047\n", "", 1),
    )
    .unwrap();
    let less = json(&simulate(folder, "less.csv", "c", &["--json"]));
    assert!(
        less["warnings"]
            .to_string()
            .contains("3 rows, and there are 2"),
        "{less}"
    );
}

/// The README's workflow: score one trainee, simulate again into the same folder, score another.
#[test]
fn an_attempt_never_replaces_another() {
    let folder = folder();
    let folder = folder.path();
    let keep = |trainee: &str| {
        let all = [
            "score",
            "session",
            "--trainee",
            trainee,
            "--record",
            "r.sqlite",
            "--json",
        ];
        json(&palpate_in(folder, &all))["warnings"].to_string()
    };
    let record = folder.join("r.sqlite");
    let trainees = || -> Vec<String> {
        let attempts = attempts(&record);
        attempts.into_iter().map(|own| own.trainee).collect()
    };
    done(&simulate(folder, "motion.csv", "session", &[]));
    assert!(!keep("Anna").contains("training record"));
    // The same attempt again, by another name of its folder, is told and counts once.
    assert!(keep("Anna").contains("in the training record already"));
    assert_eq!(trainees(), ["Anna"]);
    fs::write(folder.join("motion.csv"), motion(2.5)).unwrap();
    done(&simulate(folder, "motion.csv", "session", &["--overwrite"]));
    assert!(!keep("Bela").contains("training record"));
    assert_eq!(trainees(), ["Anna", "Bela"]);
    // Somebody else's session, to the last bit: kept, and told.
    assert!(keep("Cleo").contains("an attempt of Bela"));
    assert_eq!(trainees(), ["Anna", "Bela", "Cleo"]);
}

/// Ends a motion that is being played by a signal; what is left is whole, and says that it was interrupted.
#[cfg(unix)]
fn ended_by(signal: &str) {
    let folder = folder();
    let child = begun(folder.path(), "out");
    let id = child.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    refused(&output, 1, &["interrupted"]);
    let session = Session::read(folder.path().join("out/session.csv")).unwrap();
    assert_eq!(session.incomplete, None, "{signal}");
    let summary = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["interrupted"], true);
    assert_eq!(summary["steps"], session.rows.len() as u64);
}

#[test]
#[cfg(unix)]
fn sigterm_and_sighup_end_a_motion_as_ctrl_c_does() {
    for signal in ["-INT", "-TERM", "-HUP"] {
        ended_by(signal);
    }
}

/// A rig withdraws its indenter and keeps what was recorded.
#[test]
#[cfg(unix)]
fn sigterm_withdraws_the_indenter() {
    for signal in ["-TERM", "-HUP"] {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(
            at("protocol.toml"),
            "format = 1\n[rig]\nrecovery_s = 1\n[[specimen]]\npublished = \"liver\"\n[[stimulus]]\n\
             kind = \"ramp_and_hold\"\ndepth_m = 0.001\nramp_s = 0.5\nhold_s = 100000\n",
        )
        .unwrap();
        let child = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .args(["measure", "protocol.toml", "--headless", "--out", "one.csv"])
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let patience = Instant::now();
        while fs::metadata(at("one.csv.part")).map_or(0, |data| data.len()) < 30_000 {
            assert!(patience.elapsed() < Duration::from_secs(60), "no recording");
            sleep(Duration::from_millis(5));
        }
        let sent = Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
        let output = child.wait_with_output().unwrap();
        refused(&output, 1, &["the indenter was withdrawn"]);
        let recording = palpate_files::Recording::read(at("one.csv")).unwrap();
        assert_eq!(recording.header.cut_short(), Some("stopped by hand"));
        assert_eq!(recording.incomplete(), None);
    }
}

/// What is told to go on after the terminal is closed goes on (`nohup`).
#[test]
#[cfg(target_os = "linux")]
fn nohup_keeps_its_meaning() {
    let folder = folder();
    fs::write(folder.path().join("long.csv"), motion(60.0)).unwrap();
    let line = format!(
        "trap '' HUP; exec {} {}",
        env!("CARGO_BIN_EXE_palpate"),
        arguments("long.csv", "out", &[]).join(" ")
    );
    let child = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while !folder.path().join("out/session.csv.part").exists() {
        assert!(patience.elapsed() < Duration::from_secs(60), "no session");
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("kill")
        .args(["-HUP", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    done(&child.wait_with_output().unwrap());
    let session = Session::read(folder.path().join("out/session.csv")).unwrap();
    assert_eq!(session.rows.len(), 12_001);
}

/// Nobody is judged against himself.
#[test]
fn a_session_is_not_its_own_expert() {
    let folder = folder();
    let folder = folder.path();
    done(&simulate(folder, "motion.csv", "session", &[]));
    for expert in ["session", ".", "session/../session"] {
        let output = palpate_in(folder, &["score", "session", "--expert", expert]);
        refused(&output, 2, &["against itself"]);
    }
    let scene = SCENE.to_owned() + "expert = \".\"\n";
    fs::write(folder.join("scene.toml"), scene).unwrap();
    let output = simulate(folder, "motion.csv", "other", &[]);
    refused(&output, 2, &["task.expert", "\".\""]);
}
