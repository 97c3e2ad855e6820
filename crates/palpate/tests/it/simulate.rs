//! `palpate simulate`: a good run, a run that is cut short, and bad input.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use palpate_files::Session;

use crate::{json, palpate_in, stderr, stdout};

const SCENE: &str = "\
format = 1
[organ]
builtin = \"hemisphere\"
[organ.tissue]
law = \"linear\"
youngs_modulus_pa = 10000.0
poissons_ratio = 0.45
[model]
kind = \"local\"
[[tool]]
name = \"right\"
tip = { shape = \"flat\", radius_m = 0.001, contact = \"slip\" }
";

/// Through the pole and 3 mm deep, and out again, in two seconds.
const MOTION: &str = "\
# format = 1
time_s,tool,x_m,y_m,z_m
0.0,right,0.0,0.0,0.051
1.0,right,0.0,0.0,0.047
2.0,right,0.0,0.0,0.051
";

/// A folder with the good scene and motion.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    fs::write(folder.path().join("motion.csv"), MOTION).unwrap();
    folder
}

fn run(folder: &Path, scene: &str, motion: &str, out: &str, more: &[&str]) -> Output {
    let mut arguments = vec![
        "simulate",
        scene,
        "--headless",
        "--motion",
        motion,
        "--out",
        out,
    ];
    arguments.extend(more);
    palpate_in(folder, &arguments)
}

#[test]
fn a_run_writes_session_summary_and_plots() {
    let folder = folder();
    let folder = folder.path();
    let output = run(folder, "scene.toml", "motion.csv", "a", &[]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("401 steps, 1 contact,"));

    let session = fs::read_to_string(folder.join("a/session.csv")).unwrap();
    let columns = "time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut,fx_n,fy_n,fz_n,tx_nm,ty_nm,tz_nm,contact,depth_m,event,grip_force_n";
    assert!(session.lines().any(|line| line == columns));
    assert_eq!(
        Session::read(folder.join("a/session.csv"))
            .unwrap()
            .rows
            .len(),
        401
    );

    let summary = fs::read_to_string(folder.join("a/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_is_summary(&summary);
    for plot in ["force.png", "force-depth.png"] {
        assert!(
            fs::read(folder.join("a").join(plot))
                .unwrap()
                .starts_with(b"\x89PNG")
        );
    }

    let answer = json(&run(folder, "scene.toml", "motion.csv", "b", &["--json"]));
    assert_is_summary(&answer);
    assert!(session == fs::read_to_string(folder.join("b/session.csv")).unwrap());
}

fn assert_is_summary(summary: &serde_json::Value) {
    assert_eq!(summary["palpate"], env!("CARGO_PKG_VERSION"));
    for name in ["p50", "p99", "p99.9", "max"] {
        assert!(
            summary["step_times_s"][name].as_f64().unwrap() > 0.0,
            "{name}"
        );
    }
    assert_eq!(summary["contacts"], 1);
    assert_eq!(summary["interrupted"], false);
    // 2 a E d / (1 − ν²) for 1 mm and 3 mm, and the organ's size adds a few percent.
    let peak = summary["peak_force_n"].as_f64().unwrap();
    let half_space = 2.0 * 1e-3 * 1e4 * 3e-3 / (1.0 - 0.45 * 0.45);
    assert!((peak / half_space - 1.0).abs() < 0.05, "{peak}");
    assert_eq!(summary["warnings"], serde_json::json!([]));
}

/// A tube of 5 and 8 mm in radius and 80 mm long, closed at its ends [OBJ, m].
fn tube() -> String {
    const AROUND: usize = 48;
    const ALONG: usize = 40;
    // Around the profile: up the outside, down the inside.
    let rings: Vec<(f64, f64)> = (0..=ALONG)
        .map(|k| (0.008, k as f64 / ALONG as f64))
        .chain((0..=ALONG).rev().map(|k| (0.005, k as f64 / ALONG as f64)))
        .collect();
    let mut text = String::new();
    for (radius, part) in &rings {
        for k in 0..AROUND {
            let (sine, cosine) = (std::f64::consts::TAU * k as f64 / AROUND as f64).sin_cos();
            let z = 0.08 * part - 0.04;
            text += &format!("v {:?} {:?} {z:?}\n", radius * cosine, radius * sine);
        }
    }
    let vertex = |ring: usize, k: usize| 1 + (ring % rings.len()) * AROUND + k % AROUND;
    for ring in 0..rings.len() {
        for k in 0..AROUND {
            let [a, b] = [vertex(ring, k), vertex(ring, k + 1)];
            let [c, d] = [vertex(ring + 1, k + 1), vertex(ring + 1, k)];
            text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    text
}

/// A tip of 3 mm on a tube of 8 mm is wider than the local model can bend its particles: the warning, with
/// the curvature of the tube, is in the summary, in the answer and in what a person reads.
#[test]
fn a_tip_too_wide_for_a_tube_is_told() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("tube.obj"), tube()).unwrap();
    let organ = "mesh = \"tube.obj\"\nmesh_unit = \"m\"";
    let scene = SCENE
        .replace("builtin = \"hemisphere\"", organ)
        .replace("radius_m = 0.001", "radius_m = 0.003");
    fs::write(folder.join("scene.toml"), scene).unwrap();
    let motion = "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,right,0.00811,0.0,0.0\n0.2,right,0.00711,0.0,0.0\n";
    fs::write(folder.join("motion.csv"), motion).unwrap();
    let output = run(folder, "scene.toml", "motion.csv", "out", &[]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let told: Vec<&str> = summary["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|warning| warning.as_str())
        .filter(|warning| warning.contains("curvature"))
        .collect();
    assert_eq!(told.len(), 1, "{}", summary["warnings"]);
    let words = "the curvature of the surface under the tip \"right\" was limited from ";
    let numbers = told[0].strip_prefix(words).unwrap();
    let number = |text: &str| text.split(' ').next().unwrap().parse::<f64>().unwrap();
    let (asked, rest) = numbers.split_once(" to ").unwrap();
    // 1/8 mm, averaged over a patch that is wider than the tube: a third more.
    assert!((1.0..1.4).contains(&(number(asked) / 125.0)), "{}", told[0]);
    assert!(number(rest) < 0.8 * number(asked), "{}", told[0]);
    // The face is below the surface from the sixth of 41 steps on.
    assert!(
        rest.contains(" in 36 of 36 steps in contact"),
        "{}",
        told[0]
    );
    assert!(stderr(&output).contains(told[0]), "{}", stderr(&output));
}

fn assert_refused(output: &Output, status: i32, words: &[&str]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(status), "{words:?}: {message}");
    assert!(output.stdout.is_empty());
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.starts_with("palpate: error: "), "{message}");
    for word in words {
        assert!(message.contains(word), "{message} lacks {word}");
    }
}

#[test]
fn a_bad_scene_is_named_with_its_key() {
    let folder = folder();
    let folder = folder.path();
    fs::create_dir(folder.join("folder.toml")).unwrap();
    let refused = |scene: &str, words: &[&str]| {
        assert_refused(&run(folder, scene, "motion.csv", "out", &[]), 2, words);
    };
    refused("missing.toml", &["missing.toml", "cannot be read", "check"]);
    refused("folder.toml", &["folder.toml", "directory"]);
    let changed = |from: &str, to: &str, words: &[&str]| {
        assert!(SCENE.contains(from));
        fs::write(folder.join("bad.toml"), SCENE.replace(from, to)).unwrap();
        refused("bad.toml", &[&["bad.toml"], words].concat());
    };
    changed(
        "poissons_ratio",
        "poisons_ratio",
        &["line 7", "poisons_ratio", "poissons_ratio"],
    );
    changed("0.45", "0.6", &["line 7", "poissons_ratio", "0.6", "0.5"]);
    changed("format = 1", "format = 2", &["line 1", "format", "2", "1"]);
    changed("\"local\"", "\"lokal\"", &["line 9", "lokal", "local"]);
    // Nothing was made.
    assert!(!folder.join("out").exists());
}

#[test]
fn a_bad_motion_is_named_with_its_line() {
    let folder = folder();
    let folder = folder.path();
    let changed = |from: &str, to: &str, words: &[&str]| {
        assert!(MOTION.contains(from));
        fs::write(folder.join("bad.csv"), MOTION.replace(from, to)).unwrap();
        let output = run(folder, "scene.toml", "bad.csv", "out", &[]);
        assert_refused(&output, 2, &[&["bad.csv"], words].concat());
    };
    changed("2.0,right", "0.5,right", &["line 5", "time_s", "0.5"]);
    changed("0.047", "NaN", &["line 4", "z_m", "NaN"]);
    changed("0.047", "deep", &["line 4", "z_m", "deep"]);
    changed("format = 1", "format = 2", &["line 1", "format", "2"]);
    fs::write(folder.join("other.csv"), MOTION.replace("right", "rihgt")).unwrap();
    let output = run(folder, "scene.toml", "other.csv", "out", &[]);
    assert_refused(&output, 2, &["rihgt", "right"]);
    assert_refused(
        &run(folder, "scene.toml", "missing.csv", "out", &[]),
        2,
        &["missing.csv", "cannot be read", "check"],
    );
}

#[test]
fn a_bad_mesh_is_named_with_the_cause() {
    let folder = folder();
    let folder = folder.path();
    // A binary STL that promises 100 triangles and brings none.
    let mut truncated = vec![0_u8; 80];
    truncated.extend(100_u32.to_le_bytes());
    truncated.extend([0; 20]);
    fs::write(folder.join("truncated.stl"), truncated).unwrap();
    fs::write(folder.join("empty.stl"), "").unwrap();
    for (mesh, word) in [
        ("truncated.stl", "100"),
        ("empty.stl", "empty"),
        ("missing.stl", "no such file"),
    ] {
        let organ = format!("mesh = \"{mesh}\"\nmesh_unit = \"m\"");
        let scene = SCENE.replace("builtin = \"hemisphere\"", &organ);
        fs::write(folder.join("bad.toml"), scene).unwrap();
        let output = run(folder, "bad.toml", "motion.csv", "out", &[]);
        assert_refused(&output, 2, &[mesh, word]);
    }
}

/// Not the input is wrong, but the disk.
#[test]
fn a_folder_that_cannot_be_made_fails() {
    let folder = folder();
    let output = run(folder.path(), "scene.toml", "motion.csv", "/proc/nope", &[]);
    assert_refused(&output, 1, &["/proc/nope", "--out"]);
}

/// Ctrl-C ends the motion after a whole step.
#[test]
#[cfg(unix)]
fn an_interrupted_run_leaves_whole_files() {
    let folder = folder();
    let folder = folder.path();
    let long = MOTION.replace("\n2.0,", "\n600.0,");
    fs::write(folder.join("long.csv"), long).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args([
            "simulate",
            "scene.toml",
            "--headless",
            "--motion",
            "long.csv",
        ])
        .args(["--out", "out"])
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Beside its own name until it is finished.
    let session: PathBuf = folder.join("out/session.csv.part");
    let patience = Instant::now();
    while fs::metadata(&session).map_or(0, |data| data.len()) < 1000 {
        assert!(patience.elapsed() < Duration::from_secs(60), "no session");
        sleep(Duration::from_millis(5));
    }
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("interrupted"),
        "{}",
        stderr(&output)
    );

    let session = folder.join("out/session.csv");
    assert!(fs::read_to_string(&session).unwrap().ends_with('\n'));
    let session = Session::read(&session).unwrap();
    println!("interrupted after {} of 120001 steps", session.rows.len());
    assert_eq!(session.incomplete, None);
    assert!((1..120_001).contains(&session.rows.len()));
    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["interrupted"], true);
    assert_eq!(summary["steps"], session.rows.len() as u64);
}
