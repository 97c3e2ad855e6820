//! The C# binding, compiled and run by Mono, which Unity is made with. The judges are those of the example in C: the step
//! in Rust, and the refusals of the header.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::example::{expected, libraries, root};

/// The binding and `sources`, compiled to `program` with these `flags`; whether Mono is installed.
fn compiles(program: &Path, sources: &[&Path], flags: &[&str]) -> bool {
    if Command::new("mcs").arg("--version").output().is_err() {
        println!("there is no mcs: the binding for C# was not compiled");
        return false;
    }
    let compiled = Command::new("mcs")
        .args(["-langversion:7.2", "-warnaserror"])
        .args(flags)
        .arg(format!("-out:{}", program.display()))
        .arg(root().join("crates/c/csharp/Palpate.cs"))
        .args(sources)
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{error}");
    true
}

/// The output of the program of these `sources` and the binding; none where Mono is not installed.
fn run(sources: &[&Path], flags: &[&str]) -> Option<Output> {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("program.exe");
    compiles(&program, sources, flags).then(|| {
        let mut mono = Command::new("mono");
        mono.arg(&program).env("LD_LIBRARY_PATH", libraries());
        mono.output().unwrap()
    })
}

/// A file beside this one.
fn beside(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/it")
        .join(name)
}

fn example() -> PathBuf {
    root().join("examples/palpate_a_liver.cs")
}

#[test]
#[ignore = "long"]
fn the_example_prints_the_forces_of_the_step_in_rust() {
    if let Some(output) = run(&[&example()], &[]) {
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{error}");
        assert_eq!(String::from_utf8_lossy(&output.stdout), expected());
    }
}

#[test]
#[ignore = "long"]
fn refusals_and_states_are_those_of_the_header() {
    let sources: [&Path; 2] = [&beside("checks.cs"), &example()];
    if let Some(output) = run(&sources, &["-main:Checks"]) {
        let told = String::from_utf8_lossy(&output.stdout);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{told}{error}");
    }
}

/// Judge: the compiler, with a stand-in for Unity's classes.
#[test]
fn the_component_of_the_page_on_unity_compiles() {
    let page = std::fs::read_to_string(root().join("docs/how_to/unity.md")).unwrap();
    let (_, component) = page.split_once("```csharp\n").unwrap();
    let (component, _) = component.split_once("```").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("Organ.cs");
    std::fs::write(&source, component).unwrap();
    let library = folder.path().join("organ.dll");
    compiles(
        &library,
        &[&source, &beside("unity_stand_in.cs")],
        &["-target:library"],
    );
}
