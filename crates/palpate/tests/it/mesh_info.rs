use std::fs;

use crate::{json, palpate, palpate_in, stdout};

/// The keys of the contract.
const KEYS: [&str; 15] = [
    "palpate",
    "warnings",
    "vertices",
    "triangles",
    "closed",
    "manifold",
    "oriented",
    "components",
    "boundary_edges",
    "self_intersections",
    "genus",
    "volume_m3",
    "area_m2",
    "extent_m",
    "problems",
];

#[test]
fn a_builtin_has_every_key_and_its_axes() {
    let builtin = ["mesh", "info", "--builtin", "hemisphere"];
    let answer = json(&palpate(&[&builtin[..], &["--json"]].concat()));
    for key in KEYS {
        assert!(answer.get(key).is_some(), "{key}");
    }
    assert_eq!(answer["closed"], true);
    assert_eq!(answer["genus"], 0);
    assert_eq!(answer["can_be_simulated"], true);
    assert_eq!(answer["builtin"], "hemisphere");
    let volume = 2.0 / 3.0 * std::f64::consts::PI * 0.05f64.powi(3);
    // The mesh is inscribed: a little less.
    let ratio = answer["volume_m3"].as_f64().unwrap() / volume;
    assert!(ratio > 0.99 && ratio < 1.0, "{ratio}");
    let text = stdout(&palpate(&builtin));
    for words in ["pole at +z", "radius 50 mm", "can be simulated: yes"] {
        assert!(text.contains(words), "{text}");
    }
}

#[test]
fn the_number_of_triangles_can_be_chosen() {
    let line = [
        "mesh",
        "info",
        "--builtin",
        "liver",
        "--triangles",
        "800",
        "--json",
    ];
    assert_eq!(json(&palpate(&line))["triangles"], 800);
}

/// A tetrahedron of 0.1 m whose faces do not share their corners, one of them turned inward.
fn torn_tetrahedron(faces: usize) -> String {
    let corners = ["0 0 0", "0.1 0 0", "0 0.1 0", "0 0 0.1"];
    let triangles = [[0, 1, 2], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut text = String::new();
    for corner in triangles[..faces].iter().flatten() {
        text += &format!("v {}\n", corners[*corner]);
    }
    for face in 0..faces {
        text += &format!("f {} {} {}\n", 3 * face + 1, 3 * face + 2, 3 * face + 3);
    }
    text
}

#[test]
fn a_faulty_mesh_is_reported_with_what_a_repair_does() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("torn.obj"), torn_tetrahedron(4)).unwrap();
    let answer = json(&palpate_in(
        folder.path(),
        &["mesh", "info", "torn.obj", "--json"],
    ));
    assert_eq!(answer["closed"], false);
    assert_eq!(answer["components"], 4);
    assert_eq!(answer["genus"], serde_json::Value::Null);
    assert_eq!(answer["repair"]["welded_vertices"], 8);
    assert_eq!(answer["repair"]["flipped_triangles"], 1);
    assert_eq!(answer["can_be_simulated"], true);
    let problems = answer["problems"].as_array().unwrap();
    assert!(
        problems
            .iter()
            .any(|problem| problem["kind"] == "not_closed")
    );
    assert!(problems.iter().all(|problem| problem["mend"].is_string()));
    let text = stdout(&palpate_in(folder.path(), &["mesh", "info", "torn.obj"]));
    assert!(
        text.contains("can be simulated: yes, because after the repair"),
        "{text}"
    );
}

#[test]
fn a_mesh_with_a_hole_cannot_be_simulated_and_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("open.obj"), torn_tetrahedron(3)).unwrap();
    let answer = json(&palpate_in(
        folder.path(),
        &["mesh", "info", "open.obj", "--json"],
    ));
    assert_eq!(answer["can_be_simulated"], false);
    assert!(answer["because"].as_str().unwrap().contains("not closed"));
}

#[test]
fn the_unit_of_a_file_is_taken_over() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("mm.obj"),
        torn_tetrahedron(4).replace("0.1", "50"),
    )
    .unwrap();
    let line = ["mesh", "info", "mm.obj", "--unit", "mm", "--json"];
    let answer = json(&palpate_in(folder.path(), &line));
    assert_eq!(answer["extent_m"], serde_json::json!([0.05, 0.05, 0.05]));
    assert_eq!(answer["unit"], "mm");
}
