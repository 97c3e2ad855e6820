//! `palpate solve` on solids, in the words that others rely on.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::errors::assert_refused;
use crate::{json, palpate_in};

const BODY: &str = "format = 1\nkind = \"solid\"\nbuiltin = \"cube\"\naccuracy = 0.2\n";

/// A stiffness at which nothing turns far.
const TISSUE: &str = "[tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 50000.0\npoissons_ratio = 0.3\n\
                      density_kg_per_m3 = 1060.0\n";

/// A load on the top of the cube.
const TOP: &str =
    "[[load]]\nforce_n = [0.0, 0.0, -0.1]\nbox_m = [[-0.05, -0.05, 0.049], [0.05, 0.05, 0.06]]\n";

const STIFF: &str =
    "tissue = { law = \"linear\", youngs_modulus_pa = 90000.0, poissons_ratio = 0.45 }\n";

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
    assert_refused(folder.path(), &["solve", "problem.toml", "--json"], words);
}

fn vector(value: &Value) -> [f64; 3] {
    serde_json::from_value(value.clone()).unwrap_or_else(|_| panic!("{value}"))
}

/// A dead load on a flat box, the top of the cube, and one in a ball on a side of it, with its weight. Judge: equilibrium.
#[test]
#[ignore = "long"]
fn weight_and_loads_in_boxes_and_balls_are_carried() {
    let answer = solve(&format!(
        "{BODY}gravity_m_per_s2 = [0.0, 0.0, -9.81]\n\
         points_m = [[0.0, 0.0, 0.05], [0.02, 0.02, 0.0], [0.0, 0.0, 0.08]]\n{TISSUE}\
         [[load]]\nbox_m = [[-0.05, -0.05, 0.05], [0.05, 0.05, 0.05]]\nforce_n = [0.0, 0.0, -0.5]\n\
         [[load]]\ncenter_m = [0.05, 0.0, 0.02]\nradius_m = 0.004\nforce_n = [0.2, 0.0, 0.0]\n"
    ));
    let reaction = vector(&answer["reaction_n"]);
    let expected = [-0.2, 0.0, 0.5 + 1060.0 * 9.81 * 1e-3];
    for axis in 0..3 {
        let off = reaction[axis] - expected[axis];
        assert!(off.abs() < 1e-6, "{reaction:?} for {expected:?}");
    }
    // In the order in which they were asked for; what is outside is the nearest point of the body.
    let moved = answer["displacement_m"].as_array().unwrap();
    let moved: Vec<_> = moved.iter().map(vector).collect();
    assert_eq!(moved.len(), 3);
    assert!(moved[0][2] < moved[1][2] && moved[1][2] < 0.0, "{moved:?}");
    assert_eq!(moved[2], moved[0]);
    let points = answer["points"].as_array().unwrap();
    let of_points: Vec<_> = points
        .iter()
        .map(|own| vector(&own["displacement_m"]))
        .collect();
    assert_eq!(of_points, moved);
    assert_eq!(vector(&points[2]["at_m"]), [0.0, 0.0, 0.05]);
    let warnings = answer["warnings"].to_string();
    assert!(
        warnings.contains("`points_m[2]` is 0.0300 m outside of the body"),
        "{warnings}"
    );
}

/// Judge: the same body in the words of the first version, to the last bit.
#[test]
#[ignore = "long"]
fn regions_are_layers_and_inclusions() {
    let soft = "tissue = { law = \"linear\", youngs_modulus_pa = 5000.0, poissons_ratio = 0.45 }\n";
    let now = solve(&format!(
        "{BODY}{TOP}{TISSUE}\
         [[region]]\nname = \"skin\"\nlayer = {{ thickness_m = 0.01 }}\n{soft}\
         [[region]]\nname = \"lump\"\nball = {{ center_m = [0.0, 0.0, 0.0], radius_m = 0.03 }}\n{STIFF}\
         [[region]]\nname = \"fat\"\nlayer = {{ thickness_mm = 8.0 }}\n{STIFF}"
    ));
    let before = solve(&format!(
        "{BODY}{TOP}{TISSUE}\
         [[layer]]\nname = \"skin\"\nthickness_m = 0.01\n{soft}\
         [[layer]]\nname = \"fat\"\nthickness_m = 0.008\n{STIFF}\
         [[inclusion]]\nname = \"lump\"\nball = {{ center_m = [0.0, 0.0, 0.0], radius_m = 0.03 }}\n{STIFF}"
    ));
    let volumes = |answer: &Value| {
        let regions = answer["regions"].as_array().unwrap();
        let mut volumes: Vec<_> = regions
            .iter()
            .map(|own| (own["name"].to_string(), own["volume_m3"].to_string()))
            .collect();
        volumes.sort();
        volumes
    };
    assert_eq!(now["regions"].as_array().unwrap().len(), 4, "{now}");
    assert_eq!(volumes(&now), volumes(&before));
    assert_eq!(now["reaction_n"], before["reaction_n"]);
}

/// A cube of this edge [mm] about the origin, as an STL file that states no unit.
fn cube_in_millimetres(edge: f64) -> String {
    let corner = |number: usize| {
        let side = |axis: usize| match number >> axis & 1 {
            0 => -0.5 * edge,
            _ => 0.5 * edge,
        };
        format!("vertex {} {} {}\n", side(0), side(1), side(2))
    };
    // Two triangles of each side, counter-clockwise seen from outside.
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = sides
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    let facet = |corners: [usize; 3]| {
        let vertices: String = corners.into_iter().map(corner).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!(
        "solid cube\n{}endsolid cube\n",
        triangles.map(facet).collect::<String>()
    )
}

/// Judge: the pressure and the fluid that were asked for, and signs.
#[test]
#[ignore = "long"]
fn a_region_is_a_cavity() {
    let ball = "ball = { center_m = [0.0, 0.0, 0.0], radius_m = 0.035 }";
    let problem = |cavity: &str, load: &str| {
        format!("{BODY}{TISSUE}{load}[[region]]\nname = \"bladder\"\n{ball}\ncavity = {cavity}\n")
    };
    let only = |answer: &Value| {
        let cavities = answer["cavities"].as_array().unwrap();
        assert_eq!(cavities.len(), 1, "{answer}");
        assert_eq!(cavities[0]["name"], "bladder");
        // The tissue around it.
        assert_eq!(answer["regions"].as_array().unwrap().len(), 1, "{answer}");
        let number = |key: &str| cavities[0][key].as_f64().unwrap();
        let grown = number("volume_m3") / number("volume_at_rest_m3") - 1.0;
        (number("pressure_pa"), grown)
    };
    // A pressure loads the body by itself.
    let (pressure, grown) = only(&solve(&problem("{ pressure_kpa = 0.5 }", "")));
    assert_eq!(pressure, 500.0);
    assert!(grown > 0.0, "{grown}");
    let (pressure, grown) = only(&solve(&problem("{ constant_volume = true }", TOP)));
    assert!(pressure > 0.0, "{pressure}");
    assert!(grown.abs() < 1e-9, "{grown}");
}

/// A closed surface inside, with its unit. Judge: the volume of a cube.
#[test]
#[ignore = "long"]
fn a_region_is_the_inside_of_a_surface() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("lump.stl"), cube_in_millimetres(80.0)).unwrap();
    let answer = solve_in(
        folder,
        &format!(
            "{BODY}{TOP}{TISSUE}\
             [[region]]\nname = \"lump\"\nsurface = \"lump.stl\"\nmesh_unit = \"mm\"\n{STIFF}"
        ),
    );
    let lump = &answer["regions"][1];
    assert_eq!(lump["name"], "lump");
    let volume = lump["volume_m3"].as_f64().unwrap();
    // Tetrahedra cut off the corners of what they do not cross.
    assert!((volume / 512e-6 - 1.0).abs() < 0.1, "{volume}");
}

/// Two tetrahedra of a VTK file, of which one has the label 7.
#[test]
fn a_region_is_a_label_of_a_volume_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mesh = "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n\
        0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n0 0 -0.1\n\
        CELLS 2 10\n4 0 1 2 3\n4 0 2 1 4\nCELL_TYPES 2\n10\n10\n\
        CELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n3\n7\n";
    fs::write(folder.join("body.vtk"), mesh).unwrap();
    let problem = |key: &str| {
        format!(
            "format = 1\nkind = \"solid\"\naccuracy = 0.2\nmesh = \"body.vtk\"\nmesh_unit = \"m\"\n\
             anchor = {{ planes = [{{ point_m = [0.0, 0.0, -0.02], normal = [0.0, 0.0, 1.0] }}] }}\n\
             {TISSUE}[[load]]\nforce_n = [0.0, 0.0, -0.01]\ncenter_m = [0.0, 0.0, 0.1]\nradius_m = 0.03\n\
             [[region]]\nname = \"below\"\n{key} = 7\n{STIFF}"
        )
    };
    let answer = solve_in(folder, &problem("label"));
    let below = &answer["regions"][1];
    assert_eq!(below["name"], "below");
    let volume = below["volume_m3"].as_f64().unwrap();
    assert!((volume / (1e-3 / 6.0) - 1.0).abs() < 1e-9, "{volume}");
    assert_eq!(
        solve_in(folder, &problem("number"))["reaction_n"],
        answer["reaction_n"]
    );
    fs::write(
        folder.join("problem.toml"),
        problem("label").replace("= 7", "= 8"),
    )
    .unwrap();
    let words = ["`region[0].label` is 8", "regions 3, 7"];
    assert_refused(folder, &["solve", "problem.toml"], &words);
    let hollow = problem("label").replace(STIFF, "cavity = {}\n");
    fs::write(folder.join("problem.toml"), hollow).unwrap();
    let words = ["`region[0].label` is \"below\"", "that tissue encloses"];
    assert_refused(folder, &["solve", "problem.toml"], &words);
}

#[test]
fn mistakes_are_named() {
    let with = |more: &str| format!("{BODY}{TISSUE}{more}");
    let load = |keys: &str| with(&format!("[[load]]\nforce_n = [0.0, 0.0, -0.1]\n{keys}\n"));
    refused(
        &load(""),
        &[
            "line 11",
            "`load[0].box_m` is missing",
            "`center_m` with `radius_m`",
        ],
    );
    refused(
        &load("box_m = [[0.0, 0.0, 0.0]]"),
        &["line 12", "`load[0].box_m`", "two opposite corners"],
    );
    refused(
        &load("box_m = [[0.0, 0.0, 0.0], [0.0, 0.1]]"),
        &[
            "line 12",
            "`load[0].box_m[1]` is [0.0, 0.1]",
            "three numbers",
        ],
    );
    refused(
        &load("box_m = [[0.2, 0.2, 0.2], [0.3, 0.3, 0.3]]"),
        &[
            "line 12",
            "`load[0].box_m`",
            "without a part of the surface",
        ],
    );
    refused(
        &load("center_m = [0.0, 0.0, 0.05]"),
        &["`load[0].radius_m` is missing"],
    );
    refused(
        &load("line = { from_m = [0, 0, 0.05], to_m = [0.05, 0, 0.05] }\nradius_m = 0.1"),
        &["line 13", "`load[0].radius_m`", "`center_m` too"],
    );
    refused(
        &load("center_m = [0.0, 0.0, 0.05]\nradius_m = 0.1\nbox_m = [[0, 0, 0], [1, 1, 1]]"),
        &["`load[0].center_m` is given although `load[0].box_m`"],
    );
    let region = |keys: &str| with(&format!("{TOP}[[region]]\n{STIFF}{keys}\n"));
    refused(
        &region(""),
        &["`region[0].layer` is missing", "`surface = \"file.stl\"`"],
    );
    refused(
        &region("layer = { thickness_m = 0.01 }\nlabel = 2"),
        &["`region[0].label` is given although `region[0].layer`"],
    );
    refused(
        &region("ball = { center_m = [0.0, 0.0, 0.0], radius_m = 0.01 }\ncavity = {}"),
        &["`region[0].tissue` is given although `region[0].cavity`"],
    );
    let hollow = |keys: &str| with(&format!("{TOP}[[region]]\n{keys}\n"));
    refused(
        &hollow("layer = { thickness_m = 0.01 }\ncavity = {}"),
        &["`region[0].layer`", "a shape that tissue encloses"],
    );
    refused(
        &region("label = 2"),
        &["`region[0].label` is 2", "no file of tetrahedra"],
    );
    refused(
        &with(&format!("density_kg_m3 = 1000.0\n{TOP}")),
        &["`tissue.density_kg_m3`", "`tissue.density_kg_per_m3`"],
    );
}
