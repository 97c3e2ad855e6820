//! Scenes that cannot be simulated: the message names the file, the cause and the remedy.

use std::fs;
use std::path::Path;

use palpate_simulate::{Error, Flow, Simulation, play};

use crate::scenes::{Setting, motion};

fn refusal(organ: &str) -> String {
    let scene = Setting {
        organ,
        ..Setting::default()
    }
    .scene();
    let error = Simulation::new(&scene).unwrap_err();
    assert!(error.is_input());
    error.to_string()
}

fn assert_names(message: &str, words: &[&str]) {
    println!("{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    for word in words {
        assert!(message.contains(word), "{message:?} lacks {word:?}");
    }
}

fn mesh(path: &Path) -> String {
    format!("mesh = {:?}", path.to_str().unwrap())
}

/// Triangles of a tetrahedron of `size`, without its last one when `open`.
fn tetrahedron(size: f64, open: bool) -> String {
    let corners = [
        [0.0, 0.0, 0.0],
        [size, 0.0, 0.0],
        [0.0, size, 0.0],
        [0.0, 0.0, size],
    ];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut text = "solid t\n".to_owned();
    for face in &faces[..if open { 3 } else { 4 }] {
        text += "facet normal 0 0 0\nouter loop\n";
        for corner in face {
            let [x, y, z]: [f64; 3] = corners[*corner];
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid t\n"
}

#[test]
fn a_missing_mesh_is_named() {
    let message = refusal("mesh = \"nowhere/kidney.stl\"\nmesh_unit = \"m\"");
    assert_names(
        &message,
        &["nowhere/kidney.stl", "no such file", "check the path"],
    );
}

#[test]
fn an_open_mesh_bounds_no_solid() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("open.stl");
    fs::write(&path, tetrahedron(0.1, true)).unwrap();
    let message = refusal(&(mesh(&path) + "\nmesh_unit = \"m\""));
    assert_names(
        &message,
        &["open.stl", "not closed", "3 edges", "fill the holes"],
    );
}

#[test]
fn real_mesh_with_a_hole_bounds_no_solid() {
    let Some(folder) = crate::data::folder() else {
        return;
    };
    let path = folder.join("dirty/vhf_liver_capsule_onehole.ply");
    let message = refusal(&(mesh(&path) + "\nmesh_unit = \"m\""));
    assert_names(
        &message,
        &[
            "vhf_liver_capsule_onehole.ply",
            "not closed",
            "fill the holes",
        ],
    );
}

/// 120 in a file without a unit is no organ in metres.
#[test]
fn a_unit_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.stl");
    fs::write(&path, tetrahedron(120.0, false)).unwrap();
    assert_names(
        &refusal(&mesh(&path)),
        &["large.stl", "120", "mesh_unit", "mm"],
    );
}

fn refused_motion(rows: &[(f64, [f64; 3])], name: &str) -> String {
    let text = motion(rows).to_csv().replace("right", name);
    let motion = palpate_files::Motion::parse(&text, "motion.csv").unwrap();
    let simulation = Setting::default().simulation();
    let result = play(&simulation, &motion, |_| -> Result<Flow, Error> {
        Ok(Flow::Continue)
    });
    result.unwrap_err().to_string()
}

#[test]
fn a_motion_of_an_unknown_tool_names_the_known() {
    let above = [0.0, 0.0, 0.06];
    let message = refused_motion(&[(0.0, above), (1.0, above)], "rihgt");
    assert_names(&message, &["\"rihgt\"", "\"right\"", "name one of these"]);
}

#[test]
fn a_motion_of_a_year_is_refused_at_once() {
    let above = [0.0, 0.0, 0.06];
    let message = refused_motion(&[(0.0, above), (3.2e7, above)], "right");
    assert_names(&message, &["32000000 s", "40000000", "step_s"]);
}
