//! CMakeLists.txt, as a program meets it: installed, found, and linked both ways. The judge is the example's step in Rust.

use std::path::Path;
use std::process::Command;

use super::example::{expected, libraries, root};

const PROJECT: &str = "cmake_minimum_required(VERSION 3.18)
project(use C)
find_package(palpate REQUIRED)
foreach(kind shared static)
    add_executable(${kind} ${EXAMPLE})
    target_link_libraries(${kind} palpate::${kind} m)
endforeach()
";

fn cmake(arguments: &[&str]) {
    let output = Command::new("cmake").args(arguments).output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {told}{error}");
}

#[test]
#[ignore = "long"]
fn it_installs_what_find_package_finds() {
    if Command::new("cmake").arg("--version").output().is_err() {
        println!("there is no cmake: CMakeLists.txt was not read");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [build, installed, project, program] = ["build", "installed", "project", "program"].map(at);
    let define = |name: &str, path: &Path| format!("-D{name}={}", path.display());
    cmake(&[
        "-S",
        env!("CARGO_MANIFEST_DIR"),
        "-B",
        &build,
        &define("PALPATE_LIBRARIES", &libraries()),
        &define("CMAKE_INSTALL_PREFIX", Path::new(&installed)),
    ]);
    cmake(&["--install", &build]);

    std::fs::create_dir(&project).unwrap();
    std::fs::write(Path::new(&project).join("CMakeLists.txt"), PROJECT).unwrap();
    cmake(&[
        "-S",
        &project,
        "-B",
        &program,
        &define("CMAKE_PREFIX_PATH", Path::new(&installed)),
        &define("EXAMPLE", &root().join("examples/palpate_a_liver.c")),
    ]);
    cmake(&["--build", &program]);
    for kind in ["shared", "static"] {
        let output = Command::new(Path::new(&program).join(kind))
            .output()
            .unwrap();
        assert_eq!(
            String::from_utf8_lossy(&output.stdout),
            expected(),
            "{kind}"
        );
    }
    let version =
        std::fs::read_to_string(Path::new(&installed).join("lib/pkgconfig/palpate.pc")).unwrap();
    assert!(
        version.contains(&format!("Version: {}\n", env!("CARGO_PKG_VERSION"))),
        "{version}"
    );
}
