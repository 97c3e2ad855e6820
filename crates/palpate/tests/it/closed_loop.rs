//! The whole chain: a specimen is measured, characterized, and its tissue pressed again in a scene.
//!
//! Judge: the recording. Its specimen is solved by finite elements, or is a closed form or published forces;
//! its relaxation is that of a rig that goes its own way, with friction and a sensor's steps. What is simulated
//! knows only what `characterize` found. Tolerance: at every instant what is stated, and 15 % of the recording's
//! largest force.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use palpate_files::{Recording, Session};
use serde_json::Value;

use crate::{json, stderr};

/// A protocol of ramps of 0.5 s and holds.
fn protocol(specimen: &str, depths_mm: &[u32], hold_s: u32) -> String {
    let depths: Vec<String> = depths_mm.iter().map(|mm| format!("{mm}e-3")).collect();
    format!(
        "format = 1\n[[specimen]]\n{specimen}\norgan = \"organ\"\nsubject = \"1\"\n[[stimulus]]\n\
         kind = \"ramp_and_hold\"\ndepths_m = [{}]\nramp_s = 0.5\nhold_s = {hold_s}\n",
        depths.join(", ")
    )
}

/// The block that the specimen is, of the tissue that was found. So few triangles do for a block: 500 and 2,000
/// differ by 0.1 %.
fn scene(model: &str) -> String {
    format!(
        "format = 1\norgan = {{ builtin = \"cube\", triangles = 500, tissue = \"tissue.toml\" }}\n\
         model = {{ kind = \"{model}\" }}\n"
    )
}

/// In `folder`, with what takes long kept in it.
fn palpate_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments)
        .current_dir(folder)
        .env("PALPATE_CACHE", folder.join("kept"))
        .output()
        .unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

/// What is stated of a simulated force F [N]: a part of it, and newtons.
struct Stated {
    part: f64,
    newtons: f64,
}

/// What both models are promised to on a block under a punch (README).
const MODEL: f64 = 0.03;
/// A step of the sensor [N].
const SENSOR: f64 = 1.0 / 1280.0;
/// What is asked of the whole chain, over the largest force [-].
const ASKED: f64 = 0.15;

impl Stated {
    /// Of a specimen in the answer of `characterize`: its 95 % intervals of modulus and relaxation, the elements'
    /// error, and 1.96 times the law's misfit.
    fn of(specimen: &Value, largest: f64) -> Self {
        let preferred = specimen["preferred"].as_str().unwrap();
        let modulus = match preferred {
            "exponential" => "gamma_pa",
            _ => "c10_pa",
        };
        let error = |known: &Value| {
            1.96 * number(&known["standard_error"]) + number(&known["discretisation_error"])
        };
        let found = &specimen["laws"][preferred];
        let modulus = &found[modulus];
        let terms = specimen["relaxation"]["g"].as_array().unwrap();
        let relaxed: f64 = terms.iter().map(|g| number(&g["value"])).sum();
        let unsure: f64 = terms.iter().map(error).sum();
        Self {
            part: error(modulus) / number(&modulus["value"]) + unsure / (1.0 - relaxed) + MODEL,
            newtons: 1.96 * number(&found["misfit"]) * largest + SENSOR,
        }
    }
}

/// The mean force [N] of 25 ms about each sample, less the sensor's zero above the tissue.
fn smooth(recording: &Recording) -> Vec<f64> {
    let (depth, force) = (recording.depth_m(), recording.force_n());
    let mean = |forces: &[f64]| forces.iter().sum::<f64>() / forces.len() as f64;
    let above: Vec<f64> = depth
        .iter()
        .zip(force)
        .filter_map(|(depth, force)| (*depth < -2e-4).then_some(*force))
        .collect();
    let zero = mean(&above);
    let about = |i: usize| &force[i.saturating_sub(12)..(i + 13).min(force.len())];
    (0..force.len()).map(|i| mean(about(i)) - zero).collect()
}

/// One indentation of one tissue on one model.
struct Closed {
    /// Which it is.
    name: String,
    /// The largest deviation over the largest force [-], with its sign.
    worst: f64,
    /// The same over what is stated there and then.
    of_stated: f64,
}

/// Measures, characterizes with `asked`, simulates every indentation on both models.
#[allow(clippy::print_stdout, reason = "a test prints what it measured")]
fn close(name: &str, protocol: &str, asked: &[&str]) -> Vec<Closed> {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("protocol.toml"), protocol).unwrap();
    let measured = json(&palpate_in(
        folder,
        &[
            "measure",
            "protocol.toml",
            "--headless",
            "--json",
            "--out",
            "recordings",
        ],
    ));
    let asked = [
        &[
            "characterize",
            "recordings",
            "--json",
            "--out",
            "tissue.toml",
        ],
        asked,
    ];
    let found = json(&palpate_in(folder, &asked.concat()));
    let files = measured["recordings"].as_array().unwrap();
    let largest = files.iter().map(|file| number(&file["peak_force_n"]));
    let stated = Stated::of(&found["specimens"][0], largest.fold(0.0, f64::max));
    let mut all = Vec::new();
    for model in ["local", "hybrid"] {
        fs::write(folder.join("scene.toml"), scene(model)).unwrap();
        for file in files {
            let file = file["file"].as_str().unwrap();
            let asked = [
                "simulate",
                "scene.toml",
                "--headless",
                "--indentation",
                file,
                "--json",
                "--out",
                "session",
                "--overwrite",
            ];
            let summary = json(&palpate_in(folder, &asked));
            let closed = compare(folder, file, &stated);
            let beside = &summary["beside"];
            let told =
                number(&beside["largest_deviation_n"]) / number(&beside["largest_recorded_n"]);
            // Another filter, of the same noise.
            assert!((told - closed.0).abs() < 0.03, "{told} {}", closed.0);
            let depth = file.rsplit('-').nth(1).unwrap();
            let (worst, of_stated) = closed;
            println!(
                "{name} {depth} {model}: {:+.1} % at most, {of_stated:.2} of what is stated ({:.1} % of the force \
                 and {:.2} mN)",
                100.0 * worst,
                100.0 * stated.part,
                1e3 * stated.newtons,
            );
            all.push(Closed {
                name: format!("{name} {depth} {model}"),
                worst,
                of_stated,
            });
        }
    }
    all
}

/// The largest deviation in the whole course, over the largest force and over what is stated.
fn compare(folder: &Path, file: &str, stated: &Stated) -> (f64, f64) {
    let recording = Recording::read(folder.join(file)).unwrap();
    let forces = smooth(&recording);
    let largest = forces.iter().copied().fold(0.0, f64::max);
    let session = Session::read(folder.join("session/session.csv")).unwrap();
    let end = recording.time_s().last().unwrap();
    assert!((session.rows.last().unwrap().time_s - end).abs() < 1e-6);
    let (mut worst, mut of_stated) = (0.0_f64, 0.0_f64);
    for row in &session.rows {
        let after = recording
            .time_s()
            .partition_point(|time| *time < row.time_s);
        let off = row.force_n[2] - forces[after.min(forces.len() - 1)];
        if off.abs() > worst.abs() * largest {
            worst = off / largest;
        }
        let bound = stated.part * row.force_n[2] + stated.newtons;
        of_stated = of_stated.max(off.abs() / bound);
    }
    (worst, of_stated)
}

/// A linear tissue in closed form, found as a neo-Hookean one.
#[test]
#[ignore = "long"]
fn a_linear_tissue_comes_back_as_the_force_it_was() {
    let protocol = protocol("builtin_tissue = \"pig-esophagus\"", &[4], 10);
    let closed = close(
        "esophagus",
        &protocol,
        &["--law", "neo_hookean", "--draws", "0"],
    );
    assert_eq!(closed.len(), 2);
    for one in closed {
        assert!(
            one.worst.abs() < ASKED && one.of_stated < 1.0,
            "{}",
            one.name
        );
    }
}

/// Liver of a law that is found, by finite elements; a kidney whose forces are those of table 5-1, of no law; a
/// linear esophagus. Three depths of each are characterized together, and the simplest law that serves is taken.
#[test]
#[ignore = "slow: three tissues with all laws and both models, four minutes"]
fn three_tissues_come_back_on_both_models() {
    let specimens = [
        ("liver", "builtin_tissue = \"pig-liver\""),
        ("kidney", "published = \"kidney\""),
        ("esophagus", "builtin_tissue = \"pig-esophagus\""),
    ];
    let mut missed = Vec::new();
    for (name, specimen) in specimens {
        let closed = close(name, &protocol(specimen, &[2, 4, 6], 20), &[]);
        assert_eq!(closed.len(), 6);
        let misses = |one: &Closed| one.worst.abs() > ASKED || one.of_stated > 1.0;
        missed.extend(closed.into_iter().filter(misses));
    }
    let names: Vec<&str> = missed.iter().map(|one| one.name.as_str()).collect();
    // No law here is as soft at first as the kidney of table 5-1: a millimetre deep, on the way to two, the one
    // that was fitted down to six is too stiff by half.
    assert_eq!(names, ["kidney 2mm local", "kidney 2mm hybrid"]);
    for one in missed {
        assert!(one.worst.abs() < 0.2 && one.of_stated < 1.0, "{}", one.name);
    }
}

/// What cannot be repeated is refused before anything is prepared; what can, but not to be compared, is told.
#[test]
fn an_indentation_that_makes_no_sense_is_refused_or_warned_about() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let table = "time_s,depth_m,force_n\n0,0,0\n0.1,0.0005,0.01\n0.2,0.001,0.02\n0.3,0.001,0.019\n0.4,0.001,0.018\n";
    let write = |name: &str, keys: &str| {
        fs::write(folder.join(name), format!("# format = 1\n{keys}{table}")).unwrap();
    };
    write(
        "ball.csv",
        "# indenter_shape = \"sphere\"\n# indenter_radius_m = 0.004\n",
    );
    write(
        "bar.csv",
        "# stimulus = \"uniaxial\"\n# area_m2 = 1e-4\n# height_m = 0.01\n",
    );
    let tissue = "tissue = { law = \"neo_hookean\", c10_pa = 1000.0 }";
    fs::write(
        folder.join("scene.toml"),
        format!("format = 1\norgan = {{ builtin = \"cube\", {tissue} }}\n"),
    )
    .unwrap();
    let run = |more: &[&str]| {
        let asked = ["simulate", "scene.toml", "--headless", "--out", "session"];
        palpate_in(folder, &[&asked[..], more].concat())
    };
    for (more, word) in [
        (&["--indentation", "bar.csv"][..], "uniaxial"),
        (&["--indentation", "none.csv"], "none.csv"),
        (
            &["--indentation", "ball.csv", "--at", "1,2"],
            "three numbers",
        ),
        (
            &["--indentation", "ball.csv", "--motion", "ball.csv"],
            "--motion",
        ),
        (&["--at", "1,2,3"], "--indentation"),
    ] {
        let output = run(more);
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        let said = stderr(&output).replace("a whole piece", "uniaxial");
        assert!(said.contains(word), "{more:?}: {said}");
        assert!(!folder.join("session").exists());
    }
    let output = run(&["--indentation", "ball.csv", "--at", "0.01,0,0.07"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stderr(&output);
    assert!(
        said.contains("the tip is flat, radius 1 mm, and the indenter was sphere, radius 4 mm"),
        "{said}"
    );
    let session = Session::read(folder.join("session/session.csv")).unwrap();
    let last = session.rows.last().unwrap();
    // The nearest place of the top, and a millimetre down.
    for (place, expected) in last.position_m.iter().zip([0.01, 0.0, 0.049]) {
        assert!((place - expected).abs() < 1e-9, "{:?}", last.position_m);
    }
    assert!((last.depth_m - 1e-3).abs() < 1e-9);
    for plot in ["force.png", "force-depth.png", "beside.png"] {
        assert!(
            fs::read(folder.join("session").join(plot))
                .unwrap()
                .starts_with(b"\x89PNG"),
            "{plot}"
        );
    }
}
