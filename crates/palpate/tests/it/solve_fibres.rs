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
    let words = [&["problem.toml"], words].concat();
    assert_refused(folder.path(), &["solve", "problem.toml", "--json"], &words);
}

fn bar(along: &str, angle: f64) -> Value {
    solve(&format!(
        "format = 1\nkind = \"uniaxial\"\nstretches = [0.8, 1.2]\npulled_along = \"{along}\"\n{}",
        TISSUE.replace("25.0", &angle.to_string())
    ))
}

/// Judges: σ₂ = σ₃ by the principal stresses; two names of one bar; and the matrix alone along the normal in tension, by
/// which both families are slack.
#[test]
fn a_strip_is_pulled_along_each_axis() {
    let answer = bar("axis", 25.0);
    let (c10, k1, k2, kappa) = (1e4, 2e5, 1.0, 0.05);
    let cos = 25.0_f64.to_radians().cos().powi(2);
    for (row, stretch) in [0.8_f64, 1.2].into_iter().enumerate() {
        let sides = &answer["lateral_stretch"][row];
        let [wide, thick] = [0, 1].map(|side| sides[side].as_f64().unwrap());
        let squares = [stretch, wide, thick].map(|l| l * l);
        let fourth = squares[0] * cos + squares[1] * (1.0 - cos);
        let strain =
            kappa * (squares.iter().sum::<f64>() - 3.0) + (1.0 - 3.0 * kappa) * (fourth - 1.0);
        let strain = strain.max(0.0);
        let slope = k1 * strain * (k2 * strain * strain).exp();
        let stress = |i: usize, part: f64| {
            squares[i] * (2.0 * c10 + 4.0 * slope * (kappa + (1.0 - 3.0 * kappa) * part))
        };
        let [along, across, normal] = [stress(0, cos), stress(1, 1.0 - cos), stress(2, 0.0)];
        // Rounding, in the stiffness of fibres.
        assert!(
            (across - normal).abs() < 1e-12 * k1,
            "{stretch}: {across} {normal}"
        );
        let found = answer["nominal_stress_pa"][row].as_f64().unwrap();
        assert!(
            (found - (along - normal) / stretch).abs() < 1e-12 * k1,
            "{stretch}: {found}"
        );
    }
    let (one, other) = (bar("across", 25.0), bar("axis", 65.0));
    for row in 0..2 {
        let [one, other] =
            [&one, &other].map(|bar| bar["nominal_stress_pa"][row].as_f64().unwrap());
        assert!((one / other - 1.0).abs() < 1e-12, "{one} {other}");
    }
    let normal = bar("normal", 25.0)["nominal_stress_pa"][1]
        .as_f64()
        .unwrap();
    let matrix = 2.0 * c10 * (1.2 - 1.2_f64.powi(-2));
    assert!((normal / matrix - 1.0).abs() < 1e-12, "{normal} {matrix}");
}

/// A cube of 0.1 m whose lowest triangles are fixed, under its weight.
fn cube(fibres: &str) -> String {
    format!(
        "format = 1\nkind = \"solid\"\nmesh = \"cube.vtu\"\naccuracy = 0.2\ngravity_m_per_s2 = [3.0, 1.0, -9.81]\n\
         anchor = {{ planes = [{{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }}] }}\n{TISSUE}{fibres}\n"
    )
}

/// The file of that cube, of a few tetrahedra.
fn write_cube(folder: &Path) {
    let mesh = TetrahedronMesh::block(Vec3::zeros(), Vec3::repeat(0.1), [1; 3]).unwrap();
    let nodes: Vec<u32> = mesh
        .tetrahedra()
        .iter()
        .flatten()
        .map(|node| node.0)
        .collect();
    let cells = Cells {
        kind: CellKind::Tetrahedron,
        nodes: &nodes,
    };
    let bytes = unstructured_grid(mesh.vertices(), &cells, &[], &[]);
    fs::write(folder.join("cube.vtu"), bytes).unwrap();
}

/// Judge: the same directions said in three ways; others give another answer.
#[test]
fn directions_are_the_same_however_they_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "# format = 1\nx_m,y_m,z_m,axis_x,axis_y,axis_z,across_x,across_y,across_z\n0,0,0,2,0,0,0,0,1\n";
    fs::write(folder.path().join("fibres.csv"), rows).unwrap();
    write_cube(folder.path());
    let point = "point = [{ at_m = [0.05, 0.05, 0.1] }]";
    let moved = |fibres: &str| -> Vec<f64> {
        let points =
            solve_in(folder.path(), &cube(&format!("{point}\n{fibres}")))["points"].clone();
        let moved = points[0]["displacement_m"].as_array().unwrap().clone();
        moved.iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let off = |one: &[f64], other: &[f64]| {
        let each = one.iter().zip(other).map(|(a, b)| (a - b).powi(2));
        each.sum::<f64>().sqrt() / one.iter().map(|a| a * a).sum::<f64>().sqrt()
    };
    let constant = moved("fibres = { axis = [1.0, 0.0, 0.0], across = [0.0, 0.0, 1.0] }");
    let read = moved("fibres = { file = \"fibres.csv\" }");
    assert_eq!(constant, read);
    // A line a kilometre away, around which directions turn by less than 1e-4 within the cube.
    let around =
        moved("fibres = { around = { point_m = [0.0, -1000.0, 0.0], line = [0.0, 0.0, 1.0] } }");
    assert!(off(&constant, &around) < 1e-3, "{constant:?} {around:?}");
    let other = moved("fibres = { axis = [0.0, 1.0, 0.0], across = [0.0, 0.0, 1.0] }");
    assert!(off(&constant, &other) > 0.02, "{constant:?} {other:?}");
}

#[test]
fn a_model_without_directions_refuses_fibres() {
    refused(
        &format!(
            "format = 1\nkind = \"indentation\"\nblock = {{ radius_m = 0.05, height_m = 0.1 }}\n{TISSUE}\
             indenter = {{ radius_m = 0.001 }}\ndepths_m = [0.001]"
        ),
        &[
            "line 4",
            "`tissue.law` is \"holzapfel_gasser_ogden\"",
            "isotropic",
            "axisymmetric",
        ],
    );
    refused(
        &format!("format = 1\nkind = \"hemisphere\"\n{TISSUE}"),
        &["`tissue.law` is \"holzapfel_gasser_ogden\"", "\"linear\""],
    );
    let folder = tempfile::tempdir().unwrap();
    let scene = format!(
        "format = 1\n[organ]\nbuiltin = \"liver\"\n{TISSUE}[[tool]]\nname = \"probe\"\ntip = {{ shape = \"sphere\", radius_m = 0.003 }}\n"
    );
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
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
