//! The example in C, compiled, linked both ways and run. The judge of its forces is the step in Rust.

use std::path::{Path, PathBuf};
use std::process::Command;

use palpate_files::{Pose, Scene};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

/// What a Rust program needs of the system: rustc --print native-static-libs.
const SYSTEM: &[&str] = &["-lpthread", "-ldl", "-lm"];

/// The folder with the library that Cargo has built for this test.
pub(super) fn libraries() -> PathBuf {
    let own = std::env::current_exe().unwrap();
    own.parent().unwrap().to_owned()
}

pub(super) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// What the example says, linked with `how`.
fn said(name: &str, how: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join(name);
    let compiled = Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1", "-o"])
        .arg(&program)
        .arg(format!("-I{}", root().join("crates/c/include").display()))
        .arg(root().join("examples/palpate_a_liver.c"))
        .args(how)
        .args(SYSTEM)
        .output()
        .expect("a C compiler is needed to build the project");
    let error = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{error}");
    let run = Command::new(&program).output().unwrap();
    let error = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{error}");
    String::from_utf8(run.stdout).unwrap()
}

/// The same press in Rust.
pub(super) fn expected() -> String {
    let example = std::fs::read_to_string(root().join("examples/palpate_a_liver.c")).unwrap();
    let lines = example.lines().map(str::trim);
    let quoted = lines.filter_map(|line| {
        line.strip_prefix('"')?
            .strip_suffix("\\n\";")
            .or(line.strip_prefix('"')?.strip_suffix("\\n\""))
    });
    let scene: Vec<_> = quoted.map(|line| line.replace("\\\"", "\"")).collect();
    let scene = Scene::parse(&scene.join("\n"), "liver.toml").unwrap();
    let simulation = Simulation::new(&scene).unwrap();
    let mut state = SimulationState::new(&simulation);
    let mut workspace = SimulationWorkspace::new(&simulation);
    let surface = simulation.surface();
    let tip = surface.mesh().vertices()[0] - 0.004 * surface.vertex_normals()[0];
    let pose = Pose {
        position_m: tip.into(),
        orientation: None,
        grip: 0.0,
        cut: false,
    };
    let (mut before, mut forces) = (0.0, Vec::new());
    for k in 0..=400 {
        let time = 0.1 * f64::from(k);
        step(
            &simulation,
            time,
            time - before,
            &[Some(pose)],
            &mut state,
            &mut workspace,
        );
        before = time;
        forces.push(state.tools[0].force.norm());
    }
    format!(
        "{:.4} N at once, {:.4} N after 40 s\n",
        forces[0], forces[400]
    )
}

#[test]
#[ignore = "long"]
fn it_prints_the_forces_of_the_step_in_rust() {
    let folder = libraries();
    let archive = folder.join("libpalpate_c.a");
    let expected = expected();
    println!("{expected}");
    assert_eq!(said("static", &[archive.to_str().unwrap()]), expected);
    let folder = folder.to_str().unwrap();
    let (search, at_run_time) = (
        format!("-L{folder}"),
        format!("-Wl,--disable-new-dtags,-rpath,{folder}"),
    );
    let shared = [search.as_str(), "-lpalpate_c", &at_run_time];
    // The archive lies in the same folder; a linker takes the shared library first. A path of the old kind comes before
    // those that Cargo names, where a library of an earlier build may lie.
    assert_eq!(said("shared", &shared), expected);
}

#[test]
fn it_is_short() {
    let example = std::fs::read_to_string(root().join("examples/palpate_a_liver.c")).unwrap();
    assert!(example.lines().count() <= 60);
}
