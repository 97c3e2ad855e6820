//! Invalid problems: exit status 2 and one sentence that says what, where and how.

use std::fs;
use std::path::Path;

use crate::errors::assert_refused;

const TISSUE: &str = "tissue = { law = \"neo_hookean\", c10_pa = 1000.0 }\n";
const PUNCH: &str =
    "format = 1\nkind = \"indentation\"\nblock = { radius_m = 0.05, height_m = 0.1 }\n";
const INDENTER: &str = "indenter = { radius_m = 0.001 }\n";

/// A folder with `problem.toml`.
fn folder(problem: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("problem.toml"), problem).unwrap();
    folder
}

fn refused(problem: &str, words: &[&str]) {
    refused_in(folder(problem).path(), words);
}

fn refused_in(folder: &Path, words: &[&str]) {
    let words = [&["problem.toml"], words].concat();
    assert_refused(folder, &["solve", "problem.toml", "--json"], &words);
}

#[test]
fn a_document_that_is_none() {
    refused("", &["`format` is missing", "format = 1"]);
    refused("format = 2", &["line 1", "format is 2", "format 1"]);
    refused("format = 1", &["`kind` is missing", "\"indentation\""]);
    refused(
        "format = 1\nknd = \"tube\"",
        &["line 2", "`knd`", "nearest known key is `kind`"],
    );
    refused(
        "format = 1\nkind = \"punch\"",
        &["line 2", "\"punch\"", "\"indentation\", \"hemisphere\""],
    );
    refused("format = ", &["line 1", "not TOML"]);
    let empty = tempfile::tempdir().unwrap();
    assert_refused(
        empty.path(),
        &["solve", "none.toml"],
        &["none.toml", "No such file"],
    );
    assert_refused(empty.path(), &["solve"], &["PROBLEM.toml", "--help"]);
}

#[test]
fn keys_of_an_indentation() {
    let with = |lines: &str| format!("{PUNCH}{TISSUE}{lines}");
    refused(&with(INDENTER), &["`depths_m` is missing", "ramp"]);
    let indenter =
        |more: &str| format!("{PUNCH}{TISSUE}indenter = {{ {more} }}\ndepths_m = [0.001]");
    refused(
        &indenter("radius_m = 0.001, friction = -0.1"),
        &[
            "line 5",
            "`indenter.friction` is -0.1",
            "a coefficient of friction",
        ],
    );
    refused(
        &indenter("radius_m = 0.001, face = \"slip\", friction = 0.3"),
        &["line 5", "friction", "face = \"stick\""],
    );
    refused(
        &indenter("radius_m = -0.001"),
        &[
            "line 5",
            "`indenter.radius_m` is -0.001",
            "a length from 1 nm",
        ],
    );
    refused(
        &indenter("radius_m = 0.06"),
        &["`indenter.radius_m` is 0.06", "radius of the block, 0.05 m"],
    );
    refused(
        &indenter("radius_kg = 0.001"),
        &["`indenter.radius_kg`", "`radius_m`"],
    );
    refused(
        &indenter("radius_m = 0.001, sde = \"stick\""),
        &["`indenter.sde`", "`indenter.side`"],
    );
    refused(
        &indenter("radius_m = 0.001, face = \"glue\""),
        &["\"glue\"", "\"stick\" or \"slip\""],
    );
    let pressed = |line: &str| format!("{PUNCH}{TISSUE}{INDENTER}{line}");
    refused(&pressed("depths_m = []"), &["line 6", "at least one"]);
    refused(&pressed("depths_mm = [1, -2]"), &["`depths_mm[1]` is -2"]);
    refused(
        &pressed("depths_m = [0.001, 0.1]"),
        &["`depths_m[1]` is 0.1", "height of the block, 0.1 m"],
    );
    refused(&pressed("depths_m = [nan]"), &["`depths_m[0]` is nan"]);
    refused(
        &pressed("depths_m = [0.001]\naccuracy = 0.9"),
        &["line 7", "0.9", "0.0001 to 0.2"],
    );
    refused(&pressed("depth_m = 0.001"), &["`depth_m`", "`depths_m`"]);
    refused(
        &pressed("depths_m = [0.001]\nramp = {}"),
        &["`depths_m`", "`ramp`", "keep one"],
    );
    refused(
        &pressed("ramp = { depth_m = 0.001, ramp_s = 0.0 }"),
        &["`ramp.ramp_s` is 0.0", "a duration from 1 us"],
    );
    refused(
        &pressed("ramp = { depth_m = 0.001, ramp_s = 1.0 }"),
        &["`ramp.hold_s` is missing"],
    );
}

#[test]
fn tissues() {
    let with = |tissue: &str| format!("{PUNCH}{INDENTER}depths_m = [0.001]\n{tissue}");
    refused(&with(""), &["`tissue` is missing", "pig-liver"]);
    let linear = "tissue = { law = \"linear\", youngs_modulus_pa = 1000.0, poissons_ratio = 0.5 }";
    refused(
        &with(linear),
        &[
            "line 6",
            "`tissue.poissons_ratio` is 0.5",
            "below 0.5",
            "neo_hookean",
        ],
    );
    refused(
        &with("builtin_tissue = \"pig-livr\""),
        &["\"pig-livr\"", "\"pig-liver\""],
    );
    let hemisphere = "format = 1\nkind = \"hemisphere\"\nradius_m = 0.05\npatch_radius_m = 0.003\n\
                      patch = \"slip\"\ndepth_m = 0.001\n";
    refused(
        &format!("{hemisphere}{TISSUE}"),
        &["line 7", "`tissue.law`", "neo_hookean", "\"linear\""],
    );
    // A tissue file is looked for beside the problem.
    let empty = folder(&with("tissue = \"liver.toml\""));
    assert_refused(
        empty.path(),
        &["solve", "problem.toml"],
        &["liver.toml", "No such file"],
    );
}

#[test]
fn shapes_that_are_none() {
    let tube =
        |lines: &str| format!("format = 1\nkind = \"tube\"\nlength_m = 0.06\n{TISSUE}{lines}");
    refused(
        &tube("inner_radius_m = 0.005\nouter_radius_m = 0.004\npressure_pa = 1"),
        &["`inner_radius_m` is 0.005", "outer radius, 0.004 m"],
    );
    refused(
        &tube("inner_radius_m = 0.005\nouter_radius_m = 0.006"),
        &["`pressures_pa` is missing", "indent"],
    );
    refused(
        &tube("inner_radius_m = 0.005\nouter_radius_m = 0.006\npressures_pa = [-5]"),
        &["`pressures_pa[0]` is -5"],
    );
    refused(
        &format!("format = 1\nkind = \"uniaxial\"\nstretches = [1.0, 0.0]\n{TISSUE}"),
        &["`stretches[1]` is 0.0", "above 0"],
    );
    refused(
        "format = 1\nkind = \"uniaxial\"\nstretches = [50.0]\n\
         tissue = { law = \"exponential\", gamma_pa = 1000.0, alpha = 10.0 }",
        &["50"],
    );
}

const PATCH: &str = "patch = { center_m = [0.0, 0.0, 0.0], radius_m = 0.01, displacement_m = [0.0, 0.0, -0.001] }\n";

/// Three faces of a tetrahedron.
const OPEN: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

#[test]
fn meshes_that_cannot_be_solved() {
    let solid = |lines: &str| format!("format = 1\nkind = \"solid\"\n{TISSUE}{PATCH}{lines}");
    refused(
        &solid("mesh = \"open.obj\""),
        &["`anchor` is missing", "planes"],
    );
    refused(&solid(""), &["`mesh` is missing", "builtin"]);
    refused(&solid("builtin = \"kidny\""), &["\"kidny\"", "\"kidney\""]);
    let anchor =
        "anchor = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }";
    let problem = folder(&solid(&format!("mesh = \"open.obj\"\n{anchor}")));
    fs::write(problem.path().join("open.obj"), OPEN).unwrap();
    let line = ["solve", "problem.toml"];
    assert_refused(
        problem.path(),
        &line,
        &["open.obj", "not closed", "fill the holes"],
    );
    refused(
        &solid("mesh = \"open.obj\"\nanchor = {}"),
        &["`anchor` is a table", "planes"],
    );
}

#[test]
fn files_that_cannot_be_written_are_refused_before_the_work() {
    let problem = folder(&format!("{PUNCH}{TISSUE}{INDENTER}depths_m = [0.001]"));
    let refused = |more: &[&str], words: &[&str]| {
        assert_refused(
            problem.path(),
            &[&["solve", "problem.toml"], more].concat(),
            words,
        );
    };
    refused(
        &["--plot", "no/such/a.png"],
        &["no/such/a.png", "folder exists"],
    );
    refused(&["--plot", "."], &["cannot be written"]);
    refused(&["--plot", "a", "--out", "a"], &["a is named twice"]);
    refused(&["--recording", "a.csv"], &["--recording", "`ramp`"]);
    refused(&["--plt", "a"], &["--plt", "--plot"]);
    assert_eq!(fs::read_dir(problem.path()).unwrap().count(), 1);
}

#[test]
fn loads_that_are_none() {
    let solid = |lines: &str| {
        format!(
            "format = 1\nkind = \"solid\"\nbuiltin = \"cube\"\ntriangles = 200\naccuracy = 0.2\n\
             tissue = {{ law = \"neo_hookean\", c10_pa = 1e5 }}\n{lines}"
        )
    };
    let nothing = ["`patch` is missing", "gravity_m_per_s2", "[[load]]"];
    refused(&solid(""), &nothing);
    refused(
        &solid("gravity_m_per_s2 = [0.0, 0.0, 0.0]"),
        &[
            "line 7",
            "`gravity_m_per_s2` is [0.0, 0.0, 0.0]",
            "not zero",
        ],
    );
    let weight = solid("gravity_m_per_s2 = [0.0, 0.0, -9.81]");
    for density in ["0.0", "-1.0"] {
        let more = format!("c10_pa = 1e5, density_kg_m3 = {density}");
        refused(
            &weight.replace("c10_pa = 1e5", &more),
            &["line 6", "`tissue.density_kg_m3`", density],
        );
    }
    refused(
        &format!("{weight}\nfit_stiffness = true"),
        &["line 8", "`fit_stiffness` is true", "measured_m"],
    );
    let load = |more: &str| solid(&format!("load = [{{ {more} }}]"));
    let force = "force_n = [0.0, 0.0, -0.1]";
    let refused_load = |more: &str, words: &[&str]| {
        refused(&load(&format!("{force}, {more}")), words);
    };
    refused(
        &load(force),
        &["`load[0].box_m` is missing", "region", "line"],
    );
    refused(
        &load("force_n = [0.0, 0.0, 0.0], region = {}"),
        &["line 7", "`load[0].force_n` is [0.0, 0.0, 0.0]", "not zero"],
    );
    refused(
        &load("force_kg = [0.0, 0.0, 1.0]"),
        &["`load[0].force_kg`", "`force_n`"],
    );
    refused_load(
        "region = { spheres = [{ center_m = [1.0, 0.0, 0.0], radius_m = 0.1 }] }",
        &[
            "line 7",
            "`load[0].region`",
            "without a part of the surface",
        ],
    );
    refused_load(
        "line = { from_m = [0.0, 0.0, 0.05], to_m = [0.0, 0.0, 0.05] }",
        &["line 7", "`load[0].line.to_m`", "another point"],
    );
    refused_load(
        "line = { from_m = [0.0, 0.0, 0.5], to_m = [0.01, 0.0, 0.5] }",
        &["line 7", "`load[0].line` is 0.450 m off the surface"],
    );
    refused(
        &format!("{weight}\npoint = [{{ at_m = [0.0, 0.0, 1.0] }}]"),
        &["line 8", "`point[0].at_m` is 0.950 m outside the body"],
    );
}
