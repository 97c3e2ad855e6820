//! The judge of the header is cbindgen, which makes it of the sources, and compilers, which read it.

use std::path::Path;
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

#[test]
fn it_is_what_the_sources_say() {
    let root = Path::new(ROOT);
    let settings = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    let made = cbindgen::generate_with_config(root, settings).unwrap();
    let mut fresh = Vec::new();
    made.write(&mut fresh);
    let kept = std::fs::read(root.join("include/palpate.h")).unwrap_or_default();
    if fresh != kept {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("palpate.h");
        std::fs::write(&path, fresh).unwrap();
        panic!(
            "include/palpate.h is not what the sources say; look at {} and copy it there",
            path.display()
        );
    }
}

/// `compiler` reads the header alone, without a warning; whether it is there.
fn compiles(compiler: &str, flags: &[&str]) -> bool {
    if Command::new(compiler).arg("--version").output().is_err() {
        println!("there is no {compiler}: the header was not read by it");
        return false;
    }
    let header = Path::new(ROOT).join("include/palpate.h");
    let said = Command::new(compiler)
        .args(["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"])
        .args(flags)
        .arg(header)
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&said.stderr);
    assert!(said.status.success(), "{compiler} {flags:?}: {error}");
    true
}

#[test]
fn compilers_read_it() {
    assert!(compiles("cc", &["-std=c99", "-xc"]), "install a C compiler");
    for standard in ["-std=c++11", "-std=c++20"] {
        compiles("c++", &[standard, "-xc++"]);
    }
}
