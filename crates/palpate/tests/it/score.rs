//! `palpate score` and `palpate replay`: a session that was played, measured and played again, and bad input.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::{json, palpate_in, stderr, stdout};

const SCENE: &str = "\
format = 1
[organ]
mesh = \"meshes/ball.stl\"
mesh_unit = \"m\"
[organ.tissue]
law = \"linear\"
youngs_modulus_pa = 10000.0
poissons_ratio = 0.45
prony = [{ g = 0.3, tau_s = 0.5 }]
[[tool]]
name = \"right\"
tip = { shape = \"flat\", radius_m = 0.002, contact = \"slip\" }
[task]
title = \"Press\"
force_limit_n = 0.1
time_limit_s = 30.0
";

/// Down to a depth [mm] through the pole, and out again.
fn motion(depth: f64) -> String {
    let deepest = 0.05 - 1e-3 * depth;
    format!(
        "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0.0,right,0.0,0.0,0.051\n1.0,right,0.0,0.0,{deepest}\n\
         2.0,right,0.0,0.0,0.051\n"
    )
}

/// A folder with sessions of 2 and 4 mm.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("meshes")).unwrap();
    hemisphere(&at("meshes/ball.stl"));
    fs::write(at("scene.toml"), SCENE).unwrap();
    for (name, depth) in [("gentle", 2.0), ("hard", 4.0)] {
        fs::write(at("motion.csv"), motion(depth)).unwrap();
        let arguments = [
            "simulate",
            "scene.toml",
            "--headless",
            "--motion",
            "motion.csv",
            "--out",
            name,
        ];
        let output = palpate_in(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    folder
}

/// A ball of 50 mm as an STL file.
fn hemisphere(path: &Path) {
    let (rings, sides) = (24, 40);
    let place = |ring: usize, side: usize| {
        let (down, about) = (
            std::f64::consts::PI * ring as f64 / rings as f64,
            std::f64::consts::TAU * (side % sides) as f64 / sides as f64,
        );
        let out = if ring == 0 || ring == rings {
            0.0
        } else {
            0.05 * down.sin()
        };
        format!(
            "vertex {} {} {}\n",
            out * about.cos(),
            out * about.sin(),
            0.05 * down.cos()
        )
    };
    let mut text = "solid ball\n".to_owned();
    let mut add = |corners: [String; 3]| {
        text += &format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            corners.concat()
        );
    };
    for ring in 0..rings {
        for side in 0..sides {
            let [a, b] = [place(ring, side), place(ring, side + 1)];
            let [c, d] = [place(ring + 1, side), place(ring + 1, side + 1)];
            if ring > 0 {
                add([a.clone(), c.clone(), b.clone()]);
            }
            if ring + 1 < rings {
                add([b, c, d]);
            }
        }
    }
    fs::write(path, text + "endsolid\n").unwrap();
}

fn score(folder: &TempDir, more: &[&str]) -> Value {
    let mut arguments = vec!["score"];
    arguments.extend(more);
    arguments.push("--json");
    json(&palpate_in(folder.path(), &arguments))
}

#[test]
fn a_session_is_measured_and_played_again() {
    let folder = folder();
    let (gentle, hard) = (score(&folder, &["gentle"]), score(&folder, &["hard"]));
    let measure = |answer: &Value, key: &str| answer["measures"][key].as_f64().unwrap();
    // The ways of the motions.
    assert!((measure(&gentle, "right.path_m") - 0.006).abs() < 1e-9);
    assert!((measure(&hard, "right.path_m") - 0.010).abs() < 1e-9);
    assert!((measure(&hard, "time_s") - 2.0).abs() < 1e-9);
    assert!(measure(&hard, "right.peak_force_n") > 1.5 * measure(&gentle, "right.peak_force_n"));
    assert!(measure(&hard, "force_limit_errors") == 1.0);
    assert_eq!(hard["task"]["title"], "Press");
    // Without its scene the session has no limit.
    let alone = score(&folder, &["hard/session.csv"]);
    assert!(measure(&alone, "right.peak_force_n") > 0.0);
    // It stands alone: from another folder, and after the scene's own file is gone.
    fs::remove_file(folder.path().join("scene.toml")).unwrap();
    fs::create_dir(folder.path().join("elsewhere")).unwrap();
    let output = palpate_in(
        &folder.path().join("elsewhere"),
        &["replay", "../hard", "--json"],
    );
    let again = json(&output);
    assert_eq!(again["largest_difference_n"], 0.0);
    assert_eq!(again["rows_compared"], 401);
    // Two seconds at twice the speed, 12.5 pictures a second.
    let arguments = [
        "replay", "hard", "--gif", "hard.gif", "--speed", "2", "--json",
    ];
    let again = json(&palpate_in(folder.path(), &arguments));
    assert_eq!(again["files"][0], "hard.gif");
    let bytes = fs::read(folder.path().join("hard.gif")).unwrap();
    let mut reader = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut pictures = 0;
    while reader.read_next_frame().unwrap().is_some() {
        pictures += 1;
    }
    assert_eq!(pictures, 13);
}

#[test]
fn an_expert_is_beside_it_and_the_record_keeps_it() {
    let folder = folder();
    let beside = score(&folder, &["hard", "--expert", "gentle"]);
    let force = &beside["expert"]["right.peak_force_n"];
    assert!(force["ratio"].as_f64().unwrap() > 1.5);
    assert_eq!(force["proficient"], Value::Null);
    let warnings = beside["warnings"].to_string();
    assert!(warnings.contains("a single expert session"), "{warnings}");
    for (session, more) in [("gentle", &["--as-expert"][..]), ("hard", &[])] {
        let mut arguments = vec![session, "--trainee", "Anna", "--record", "r.sqlite"];
        arguments.extend(more);
        score(&folder, &arguments);
    }
    let output = palpate_in(folder.path(), &["progress", "--record", "r.sqlite"]);
    let shown = stdout(&output);
    assert!(shown.contains("Anna") && shown.contains("Press"), "{shown}");
}

#[test]
fn bad_sessions_are_told() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let refused = |arguments: &[&str], expected: &str| {
        let output = palpate_in(folder.path(), arguments);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains(expected) && said.lines().count() == 1,
            "{said}"
        );
    };
    refused(&["score", "nowhere"], "nowhere");
    refused(
        &["score", "gentle", "--expert", "meshes"],
        "holds no session",
    );
    // Of another version, and of another scene.
    let session = fs::read_to_string(at("gentle/session.csv")).unwrap();
    fs::create_dir(at("new")).unwrap();
    fs::write(
        at("new/session.csv"),
        session.replace("# format = 1", "# format = 2"),
    )
    .unwrap();
    refused(&["score", "new"], "format");
    let scene = fs::read_to_string(at("gentle/scene.toml")).unwrap();
    fs::write(at("other.toml"), scene.replace("10000.0", "12000.0")).unwrap();
    refused(
        &["replay", "gentle", "--scene", "other.toml", "--json"],
        "recorded with the scene",
    );
    // Without a scene, and one whose mesh is gone.
    fs::write(at("new/session.csv"), &session).unwrap();
    refused(&["replay", "new", "--json"], "--scene");
    // An animation is not written over a file, and its speed has bounds.
    fs::write(at("kept.gif"), "mine").unwrap();
    let to_gif = ["replay", "gentle", "--gif", "kept.gif"];
    refused(&to_gif, "--overwrite");
    assert_eq!(fs::read_to_string(at("kept.gif")).unwrap(), "mine");
    let too_fast = palpate_in(
        folder.path(),
        &["replay", "gentle", "--gif", "new.gif", "--speed", "9"],
    );
    assert!(stderr(&too_fast).contains("from 0.25 to 8"));
    assert!(!at("new.gif").exists());
    fs::remove_file(at("meshes/ball.stl")).unwrap();
    refused(&["replay", "gentle", "--json"], "ball.stl");
    // A line that was cut off is told, and the rest counts.
    fs::write(at("new/session.csv"), &session[..session.len() - 20]).unwrap();
    let cut = score(&folder, &["new"]);
    assert!(cut["warnings"].to_string().contains("cut off"));
    assert!(cut["measures"]["time_s"].as_f64().unwrap() > 1.9);
}
