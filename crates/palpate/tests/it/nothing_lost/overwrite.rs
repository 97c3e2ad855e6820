//! Every command that writes files which are named refuses one that exists, before its work, unless `--overwrite` is
//! given. Judge: the bytes before.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::{done, refused};
use crate::{mesh, palpate_in, progress, recordings};

/// The names in a folder.
fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

/// Refused for each of the files that exists alone; all are replaced with `--overwrite`.
fn assert_asks(folder: &Path, line: &str, files: &[&str]) {
    let words: Vec<&str> = line.split_whitespace().collect();
    let at = |file: &str| folder.join(file);
    for file in files {
        fs::create_dir_all(at(file).parent().unwrap()).unwrap();
        fs::write(at(file), "old").unwrap();
        let before = names(folder);
        let said = format!("{file} is there already");
        refused(&palpate_in(folder, &words), 2, &[&said, "--overwrite"]);
        assert_eq!(fs::read(at(file)).unwrap(), b"old", "{line}");
        assert_eq!(names(folder), before, "{line}");
        fs::remove_file(at(file)).unwrap();
    }
    for file in files {
        fs::write(at(file), "old").unwrap();
    }
    let before = names(folder);
    done(&palpate_in(
        folder,
        &[&words[..], &["--overwrite"]].concat(),
    ));
    assert_eq!(names(folder), before, "{line}");
    for file in files {
        assert_ne!(fs::read(at(file)).unwrap(), b"old", "{line}: {file}");
    }
}

#[test]
fn a_mesh_that_exists_is_replaced_when_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    mesh::write_ball(&folder.join("labels.nrrd"));
    let ball = "mesh isosurface labels.nrrd --label 5 --out ball.ply --triangles 200";
    assert_asks(folder, ball, &["ball.ply"]);
    assert_asks(folder, "mesh convert ball.ply ball.stl", &["ball.stl"]);
    let line = "mesh simplify ball.ply small.ply --triangles 100";
    assert_asks(folder, line, &["small.ply"]);
    // A mesh is not replaced by its own conversion either.
    let ball = fs::read(folder.join("ball.ply")).unwrap();
    let output = palpate_in(folder, &["mesh", "convert", "ball.ply", "ball.ply"]);
    refused(&output, 2, &["ball.ply is there already"]);
    assert_eq!(fs::read(folder.join("ball.ply")).unwrap(), ball);
}

#[test]
fn an_answer_that_exists_is_replaced_when_that_is_asked_for() {
    let folder = recordings::folder();
    let folder = folder.path();
    fs::write(
        folder.join("bar.toml"),
        "format = 1\nkind = \"uniaxial\"\nstretches = [0.5, 1.0, 2.0]\n\
         [tissue]\nlaw = \"neo_hookean\"\nc10_pa = 100.0\n",
    )
    .unwrap();
    let line = "solve bar.toml --plot bar.png --out bar.json";
    assert_asks(folder, line, &["bar.png", "bar.json"]);
    let line = "analyze a1.csv --out a.json --report a.html";
    assert_asks(folder, line, &["a.json", "a.html"]);
    let line = "characterize a1.csv --law neo_hookean --draws 0 --out t.toml --abaqus t.inp --febio t.feb --report t.html";
    assert_asks(folder, line, &["t.toml", "t.inp", "t.feb", "t.html"]);
    // Finished rows are appended to, never replaced.
    fs::create_dir(folder.join("figures")).unwrap();
    fs::write(folder.join("figures/rows.jsonl"), "").unwrap();
    let line = "reproduce figure-4-5 --out figures";
    assert_asks(folder, line, &["figures/figure-4-5.png"]);
}

#[test]
fn a_table_of_attempts_that_exists_is_replaced_when_that_is_asked_for() {
    let folder = progress::folder();
    let line = "progress --record training.sqlite --csv all.csv --report all.html";
    assert_asks(folder.path(), line, &["all.csv", "all.html"]);
}

/// Ctrl-C leaves neither a file nor a lock.
#[cfg(unix)]
#[test]
fn a_command_that_is_interrupted_leaves_nothing_beside() {
    use std::process::{Command, Stdio};
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    let folder = tempfile::tempdir().unwrap();
    let problem = include_str!("../../../../../assets/problems/punch.toml");
    // Minutes of work.
    let problem = problem.replace("accuracy = 0.01 ", "accuracy = 0.0001 ");
    fs::write(folder.path().join("punch.toml"), problem).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(["solve", "punch.toml", "--out", "punch.json"])
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while !folder.path().join(".punch.json.palpate-lock").exists() {
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing claimed");
        sleep(Duration::from_millis(5));
    }
    // Signals are caught soon after files are claimed.
    sleep(Duration::from_millis(300));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    refused(&child.wait_with_output().unwrap(), 1, &["interrupted"]);
    assert_eq!(names(folder.path()), ["punch.toml".to_owned()].into());
}
