//! What somebody meets first: examples, help, what files are, and what is kept.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::{json, palpate, palpate_in, stderr, stdout};

/// Every example is right, and the folder holds no other files.
#[test]
#[ignore = "long"]
fn examples_are_valid() {
    let folder = tempfile::tempdir().unwrap();
    let written = palpate_in(folder.path(), &["examples", "here"]);
    assert!(written.status.success(), "{}", stderr(&written));
    let text = stdout(&written);
    let named: Vec<&str> = text
        .lines()
        .filter(|line| !line.starts_with("written"))
        .map(|line| line.split_whitespace().next().unwrap())
        .collect();
    let here = folder.path().join("here");
    let schemas = files_below(&here.join("schemas"));
    assert!(schemas > 0);
    assert_eq!(files_below(&here) - schemas, named.len());
    // What it names comes from a measurement.
    let apart = ["closed-loop.toml"];
    let complete = named.iter().filter(|name| !apart.contains(name));
    let arguments: Vec<&str> = ["validate", "--json"]
        .into_iter()
        .chain(complete.copied())
        .collect();
    let answer = json(&palpate_in(&here, &arguments));
    assert_eq!(answer["invalid"].as_array().unwrap().len(), 0, "{answer}");
    for valid in answer["valid"].as_array().unwrap() {
        let file = valid["file"].as_str().unwrap();
        let kind = valid["kind"].as_str().unwrap();
        let expected = match file {
            "liver-4mm.csv" | "strip-0.csv" | "strip-45.csv" | "strip-90.csv" => "recording",
            _ if file.ends_with(".csv") => "motion",
            _ if file.ends_with(".msh") => "volume_mesh",
            _ if file.starts_with("tasks/") || file.ends_with("trainer.toml") => "task",
            _ if file.starts_with("problems/") => "problem",
            _ => "scene",
        };
        assert_eq!(kind, expected, "{file}");
    }
    let again = palpate_in(folder.path(), &["examples", "here"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("--overwrite"));
}

fn files_below(folder: &Path) -> usize {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    entries
        .map(|path| if path.is_dir() { files_below(&path) } else { 1 })
        .sum()
}

/// What is wrong is told for each file, with its name, and the right ones are told all the same.
#[test]
fn what_is_wrong_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    put("empty.toml", "");
    put("neither.toml", "format = 1\nname = \"x\"\n");
    put("broken.toml", "format = 1\norgan = {\n");
    put(
        "missing.toml",
        "format = 1\norgan = { builtin = \"cube\", tissue = \"found.toml\" }\n",
    );
    // Each variant has its lump outside.
    put(
        "lump.toml",
        "format = 1\norgan = { builtin = \"cube\", builtin_tissue = \"pig-liver\", inclusion = [{ stiffness_ratio = 6.0, ball = { \
         center_m = { draw = \"lump\" }, radius_m = 0.005 } }] }\ndraw.lump.uniform = [[1, 1, 1], [2, 2, 2]]\n\
         tool = [{ name = \"right\" }]\n",
    );
    put("open.stl", "solid a\nendsolid a\n");
    put("empty.csv", "");
    put(
        "tissue.toml",
        "format = 1\n[tissue]\nlaw = \"neo_hookean\"\nc10_pa = 1000.0\n",
    );
    let names = [
        "empty.toml",
        "neither.toml",
        "broken.toml",
        "missing.toml",
        "open.stl",
        "empty.csv",
        "none.toml",
        "lump.toml",
    ];
    let arguments: Vec<&str> = ["validate", "tissue.toml"]
        .into_iter()
        .chain(names)
        .collect();
    let output = palpate_in(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(2));
    assert!(stdout(&output).starts_with("tissue.toml: tissue: neo_hookean"));
    let said = stderr(&output);
    for name in names {
        let sentences = said.lines().filter(|line| line.contains(name)).count();
        assert_eq!(sentences, 1, "{name}: {said}");
    }
}

/// A paragraph of a help is broken where the width ends and nowhere else: each of its lines but the last is longer
/// than the width without the longest word that could not follow.
#[test]
fn helps_are_not_broken_twice() {
    const WIDTH: usize = 100;
    for command in commands() {
        let output = palpate(&[&command, "--help"]);
        let text = stdout(&output);
        let lines: Vec<&str> = text.lines().collect();
        for pair in lines.windows(2) {
            // Lines of a document are broken where the document has them.
            let is_text = |line: &str| {
                !line.is_empty()
                    && !line.starts_with([' ', '['])
                    && !line.ends_with(':')
                    && !line.contains(" = ")
            };
            if !is_text(pair[0]) || !is_text(pair[1]) {
                continue;
            }
            let next = pair[1].split(' ').next().unwrap();
            assert!(
                pair[0].chars().count() + 1 + next.chars().count() > WIDTH,
                "{command}: {:?} and {:?}",
                pair[0],
                pair[1]
            );
        }
    }
}

/// The commands of `palpate --help`.
fn commands() -> Vec<String> {
    let text = stdout(&palpate(&["--help"]));
    let lines = text.lines().skip_while(|line| *line != "Commands:").skip(1);
    lines
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .map(|line| line.split_whitespace().next().unwrap().to_owned())
        .collect()
}

#[test]
fn shells_and_manuals_know_every_command() {
    let all = commands();
    assert!(all.len() > 15, "{all:?}");
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish"] {
        let script = stdout(&palpate(&["completions", shell]));
        for command in &all {
            assert!(script.contains(command.as_str()), "{shell}: {command}");
        }
        if shell == "bash" {
            let file = folder.path().join("script");
            fs::write(&file, script).unwrap();
            let checked = Command::new("bash").arg("-n").arg(&file).status();
            assert!(checked.is_ok_and(|status| status.success()));
        }
    }
    let pages = folder.path().join("man");
    let written = palpate(&["manual", pages.to_str().unwrap()]);
    assert!(written.status.success(), "{}", stderr(&written));
    for command in &all {
        let page = fs::read_to_string(pages.join(format!("palpate-{command}.1"))).unwrap();
        assert!(page.starts_with(".ie") || page.contains(".TH"), "{page}");
    }
}

#[test]
fn what_is_kept_is_told_and_cleared() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("0123456789abcdef.response"), [0; 1000]).unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let cache = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .arg("cache")
            .args(arguments)
            .env("PALPATE_CACHE", folder.path())
            .output()
            .unwrap();
        json(&output)
    };
    let told = cache(&["--json"]);
    assert_eq!((&told["files"], &told["bytes"]), (&1.into(), &1000.into()));
    assert_eq!(cache(&["--clear", "--json"])["cleared"], true);
    assert_eq!(cache(&["--json"])["files"], 0);
    assert!(folder.path().join("notes.txt").exists());
}

#[test]
fn the_version_names_commit_and_target() {
    let long = stdout(&palpate(&["--version"]));
    let words: Vec<&str> = long
        .lines()
        .map(|line| line.split(' ').next().unwrap())
        .collect();
    assert_eq!(words, ["palpate", "commit", "target", "devices"], "{long}");
    assert_eq!(
        stdout(&palpate(&["-V"])),
        format!("palpate {}\n", env!("CARGO_PKG_VERSION"))
    );
}
