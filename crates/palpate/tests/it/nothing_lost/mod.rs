//! Nothing is lost and nothing falsified: refused commands, commands that are killed, two at once. Judges: the bytes
//! before, and the whole run.

mod cut;
mod overwrite;
mod signals;

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

/// The demonstration replaces nothing, not even its own results.
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
    assert!(play().contains("written to palpate-demo/:"));
    let session = folder.path().join("palpate-demo/session.csv");
    fs::write(&session, "mine").unwrap();
    assert!(play().contains("written to palpate-demo-2/:"));
    assert_eq!(fs::read_to_string(session).unwrap(), "mine");
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
