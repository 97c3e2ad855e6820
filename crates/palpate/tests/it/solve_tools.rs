//! `[[tool]]` of `palpate solve`.

use std::fs;

use serde_json::Value;

use crate::errors::assert_refused;
use crate::{json, palpate_in};

const BLOCK: &str = "format = 1\nkind = \"solid\"\nmesh = \"block.vtk\"\nmesh_unit = \"m\"\naccuracy = 0.2\n\
     anchor = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }\n\
     tissue = { law = \"linear\", youngs_modulus_pa = 9000.0, poissons_ratio = 0.3 }\n";

/// Six tetrahedra that fill a cube of 0.1 m.
fn block() -> String {
    let corners = (0..8).map(|k| {
        let at = [0, 1, 2].map(|axis| 0.1 * f64::from(k >> axis & 1));
        format!("{} {} {}\n", at[0], at[1], at[2])
    });
    let cells = "4 0 1 3 7\n4 0 3 2 7\n4 0 2 6 7\n4 0 6 4 7\n4 0 4 5 7\n4 0 5 1 7\n";
    format!(
        "# vtk DataFile Version 3.0\nblock\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n{}\
         CELLS 6 30\n{cells}CELL_TYPES 6\n{}",
        corners.collect::<String>(),
        "10\n".repeat(6)
    )
}

fn folder_with(problem: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("block.vtk"), block()).unwrap();
    fs::write(folder.path().join("problem.toml"), problem).unwrap();
    folder
}

fn vectors(value: &Value) -> Vec<[f64; 3]> {
    serde_json::from_value(value.clone()).unwrap_or_else(|_| panic!("{value}"))
}

/// Judges: what the tool pushes the table carries; Coulomb's law.
#[test]
#[ignore = "long"]
fn a_plate_presses_and_drags_a_block() {
    let folder = folder_with(&format!(
        "{BLOCK}[[tool]]\nname = \"plate\"\nshape = \"plate\"\nfriction = 0.3\nfrom_m = [0, 0, 0.1]\n\
         path_m = [[0, 0, 0.098], [0.02, 0, 0.098]]\n"
    ));
    let answer = json(&palpate_in(
        folder.path(),
        &["solve", "problem.toml", "--json"],
    ));
    let tool = &answer["tools"][0];
    assert_eq!(tool["name"], "plate");
    let force = vectors(&tool["force_n"]);
    let reaction: [f64; 3] = serde_json::from_value(answer["reaction_n"].clone()).unwrap();
    let last = force[1];
    for axis in 0..3 {
        // To the tolerance of the equilibrium.
        let off = (last[axis] - reaction[axis]).abs();
        assert!(off < 1e-4 * last[2], "{last:?} {reaction:?}");
    }
    assert!(force[0][0].abs() < 0.1 * force[0][2], "{force:?}");
    let ratio = -last[0] / last[2];
    assert!((ratio / 0.3 - 1.0).abs() < 1e-3, "{ratio}");
}

#[test]
fn tools_that_are_none_are_refused_with_their_line() {
    let refused = |tool: &str, words: &[&str]| {
        let place = "from_m = [0, 0, 0.1]\npath_m = [[0, 0, 0.09]]\n";
        let folder = folder_with(&format!("{BLOCK}[[tool]]\n{tool}\n{place}"));
        assert_refused(folder.path(), &["solve", "problem.toml", "--json"], words);
    };
    refused("radius_m = 0.01", &["`tool[0].shape`", "sphere"]);
    refused("shape = \"sphere\"", &["`tool[0].radius_m`"]);
    refused(
        "shape = \"plate\"\nradius_m = 0.01",
        &["line 10", "`tool[0].radius_m`", "no radius"],
    );
    refused(
        "shape = \"cylinder\"\nradius_m = 0.01\nlength_m = 0.015",
        &["`tool[0].length_m`", "at least twice the radius"],
    );
    refused(
        "shape = \"flat_punch\"\nradius_m = 0.01\nedge_radius_m = 0.02",
        &["`tool[0].edge_radius_m`", "less than half"],
    );
    refused(
        "shape = \"sphere\"\nradius_m = 0.01\nfriction = 0.3\ncontact = \"stick\"",
        &["`tool[0].contact`", "`tool[0].friction`"],
    );
    refused(
        "shape = \"jaws\"\nlengths_m = [0.02, 0.005, 0.003]\nopening_m = [0.01]",
        &["`tool[0].opening_m`", "2 numbers"],
    );
    refused(
        "shape = \"bar\"\nlengths_m = [0.02, 0.005, 0.003]\nalong = [0, 0, 1]",
        &["`tool[0].along`", "another direction"],
    );
}
