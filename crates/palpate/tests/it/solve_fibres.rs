//! `palpate solve` of tissue with fibres: answers against closed forms and one another, and what is refused.

use std::fs;
use std::path::Path;

use palpate_geometry::vtk::{CellKind, Cells, unstructured_grid};
use palpate_geometry::{TetrahedronMesh, Vec3};
use serde_json::Value;

use crate::errors::assert_refused;
use crate::{json, palpate_in, stderr};

const TISSUE: &str = "tissue = { law = \"holzapfel_gasser_ogden\", c10_pa = 1e4, k1_pa = 2e5, k2 = 1.0, dispersion = 0.05, \
                      fibre_angle_deg = 25.0 }\n";

fn solve_in(folder: &Path, problem: &str) -> Value {
    fs::write(folder.join("problem.toml"), problem).unwrap();
    json(&palpate_in(folder, &["solve", "problem.toml", "--json"]))
}

fn solve(problem: &str) -> Value {
    solve_in(tempfile::tempdir().unwrap().path(), problem)
}

fn refused(problem: &str, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("problem.toml"), problem).unwrap();
    let said = palpate_in(folder.path(), &["validate", "scene.toml"]);
    assert_eq!(said.status.code(), Some(2));
    let said = stderr(&said);
    for word in [
        "scene.toml",
        "the tissue has fibres",
        "a simulation does not know",
        "neo_hookean",
    ] {
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn keys_of_fibres() {
    refused(
        &cube(""),
        &["`fibres` is missing", "axis = [1.0, 0.0, 0.0]"],
    );
    refused(
        &cube("fibres = {}"),
        &["`fibres.axis` is missing", "around", "file"],
    );
    refused(
        &cube("fibres = { axis = [1.0, 0.0, 0.0] }"),
        &["`fibres.across` is missing", "`fibre_angle_deg`"],
    );
    refused(
        &cube("fibres = { axis = [1.0, 0.0, 0.0], across = [-2.0, 0.0, 0.0] }"),
        &["line 8", "`fibres.across`", "not that of `axis`"],
    );
    refused(
        &cube("fibres = { axis = [1.0, 0.0, 0.0], file = \"a.csv\" }"),
        &["`fibres.axis`", "`fibres.file`"],
    );
    refused(
        &cube("fibres = { across = [1.0, 0.0, 0.0], file = \"a.csv\" }"),
        &["`fibres.across`", "without `axis`"],
    );
    refused(
        &cube("fibres = { around = { point_m = [0.0, 0.0, 0.0], line = [0.0, 0.0, 0.0] } }"),
        &["`fibres.around.line`"],
    );
    refused(
        &cube("fibres = { axis = [1.0, 0.0, 0.0], across = [0.0, 1.0, 0.0] }")
            .replace(TISSUE, "tissue = { law = \"neo_hookean\", c10_pa = 1e4 }\n"),
        &["line 8", "`fibres`", "no fibres"],
    );
    refused(
        &cube("").replace("dispersion = 0.05", "dispersion = 0.4"),
        &["`tissue.dispersion` is 0.4", "from 0 to 0.333"],
    );
    refused(
        "format = 1\nkind = \"uniaxial\"\nstretches = [1.1]\npulled_along = \"across\"\n\
         tissue = { law = \"neo_hookean\", c10_pa = 1e4 }\n",
        &["`pulled_along`", "no fibres"],
    );
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("problem.toml"),
        cube("fibres = { file = \"a.csv\" }"),
    )
    .unwrap();
    assert_refused(
        folder.path(),
        &["solve", "problem.toml"],
        &["a.csv", "No such file"],
    );
}
