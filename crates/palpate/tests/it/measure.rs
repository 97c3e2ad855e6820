//! `palpate measure`, as an experimenter meets it.

use std::fs;
use std::process::Command;

use crate::errors::assert_refused;
use crate::{json, palpate_in, stderr};

/// A tissue under one stimulus.
fn protocol(specimen: &str, stimulus: &str) -> String {
    format!(
        "format = 1\n[rig]\nrecovery_s = 5\n[[specimen]]\n{specimen}\n[[stimulus]]\n{stimulus}\n"
    )
}

const HOLD: &str = "kind = \"ramp_and_hold\"\ndepth_m = 0.0015\nramp_s = 0.3\nhold_s = 10";
const SOFT: &str = "organ = \"jelly\"\nsubject = \"1\"\n[specimen.tissue]\nlaw = \"neo_hookean\"\nc10_pa = 3000.0\nprony = [{ g = 0.4, tau_s = 2.0 }]";

/// The chain: what is measured and then characterized is what the specimen was made of. Judge: the numbers of the
/// specimen, whose force is of finite elements on meshes that the fit does not use. Tolerance: what is stated, by
/// noise and by elements; and the contact, which is met to 0.02 mm of 1.5 (`rig`), and the specimen's own 2 %.
#[test]
#[ignore = "long"]
fn a_specimen_comes_back_as_its_tissue() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("protocol.toml"), protocol(SOFT, HOLD)).unwrap();
    // Solved once, and kept where nobody else looks.
    let measured = |file: &str| {
        let asked = ["measure", "protocol.toml", "--headless", "--json", "--out"];
        Command::new(env!("CARGO_BIN_EXE_palpate"))
            .args(asked)
            .arg(file)
            .current_dir(folder.path())
            .env("PALPATE_CACHE", folder.path().join("kept"))
            .output()
            .unwrap()
    };
    let answer = json(&measured("one.csv"));
    assert_eq!(answer["recordings"][0]["file"], "one.csv", "{answer:#}");
    assert_eq!(answer["stopped"], false);
    let kept = fs::read_dir(folder.path().join("kept")).unwrap();
    assert_eq!(kept.count(), 1);
    json(&measured("two.csv"));
    let bytes = |file: &str| fs::read(folder.path().join(file)).unwrap();
    assert!(bytes("one.csv") == bytes("two.csv"));
    let asked = [
        "characterize",
        "one.csv",
        "--law",
        "neo_hookean",
        "--draws",
        "0",
        "--json",
    ];
    let found = json(&palpate_in(folder.path(), &asked));
    let specimen = &found["specimens"][0];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let c10 = &specimen["laws"]["neo_hookean"]["c10_pa"];
    let stated = 1.96 * number(&c10["standard_error"]) + number(&c10["discretisation_error"]);
    let off = (number(&c10["value"]) - 3000.0).abs();
    assert!(off < stated + (0.02 / 1.5 + 0.02) * 3000.0, "{c10:#}");
    for (key, truth) in [("g", 0.4), ("tau_s", 2.0)] {
        let known = &specimen["relaxation"][key][0];
        let off = (number(&known["value"]) - truth).abs();
        let stated = 1.96 * number(&known["standard_error"]);
        assert!(off < stated + 0.01 * truth, "{key}: {known:#}");
    }
}

/// The same seed gives the same bytes, another one others; a heart and a breath are in them.
#[test]
#[ignore = "long"]
fn a_seed_is_all_there_is_to_chance() {
    let folder = tempfile::tempdir().unwrap();
    let alive = protocol("published = \"liver\"\nalive = true", HOLD);
    fs::write(folder.path().join("protocol.toml"), alive).unwrap();
    let bytes = |name: &str, seed: &str| {
        let asked = [
            "measure",
            "protocol.toml",
            "--headless",
            "--out",
            name,
            "--seed",
            seed,
        ];
        let output = palpate_in(folder.path(), &asked);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        fs::read(folder.path().join(name)).unwrap()
    };
    let first = bytes("a.csv", "7");
    assert!(first == bytes("b.csv", "7"));
    assert!(first != bytes("c.csv", "8"));
    let text = String::from_utf8(first).unwrap();
    assert!(text.contains("# organ = \"liver\""), "{text:.400}");
    assert!(!folder.path().join("a.csv.part").exists());
}

/// What goes beyond a limit is refused before anything moves.
#[test]
fn a_protocol_beyond_its_limits_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |text: &str, words: &[&str]| {
        fs::write(folder.path().join("protocol.toml"), text).unwrap();
        assert_refused(
            folder.path(),
            &["measure", "protocol.toml", "--headless"],
            words,
        );
    };
    let deep = "kind = \"ramp_and_hold\"\ndepth_m = 0.02\nramp_s = 2";
    refused(
        &protocol("published = \"liver\"", deep),
        &["20.0 mm", "12.0 mm"],
    );
    let breathless =
        protocol("published = \"liver\"", HOLD).replace("recovery_s = 5", "breath_s = 8");
    refused(&breathless, &["breath", "8.0 s"]);
    refused("format = 1\n[[stimulus]]\nkind = \"sine\"\n", &["specimen"]);
    refused(
        &protocol("published = \"lever\"", HOLD),
        &["lever", "liver"],
    );
    refused(
        &protocol("published = \"liver\"", "kind = \"ramp_and_hold\""),
        &["depth_m"],
    );
    refused(
        &protocol(
            SOFT,
            "kind = \"sine\"\namplitude_m = 0.002\npre_indentation_m = 0.001\nfrequency_hz = 1",
        ),
        &["pre-indentation"],
    );
    assert!(!folder.path().join("recordings").exists());
}

/// What is there is not written over, nor what is left of a recording that was not finished.
#[test]
#[ignore = "long"]
fn recordings_are_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let text = protocol("published = \"liver\"\nsubject = \"1\"", HOLD);
    fs::write(folder.path().join("protocol.toml"), text).unwrap();
    let asked = ["measure", "protocol.toml", "--headless", "--out", "out"];
    let name = "out/liver-1-ramp-and-hold-1.5mm-1.csv";
    for there in [format!("{name}.part"), name.to_owned()] {
        let there = folder.path().join(there);
        fs::create_dir_all(folder.path().join("out")).unwrap();
        fs::write(&there, "precious").unwrap();
        let words = [there.file_name().unwrap().to_str().unwrap(), "--overwrite"];
        assert_refused(folder.path(), &asked, &words);
        assert_eq!(fs::read_to_string(&there).unwrap(), "precious");
        let output = palpate_in(folder.path(), &[&asked[..], &["--overwrite"]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(text.contains("# ended = \"whole\""), "{text:.600}");
        fs::remove_dir_all(folder.path().join("out")).unwrap();
    }
}

/// A recording that was cut short says why at its top, and whoever reads it is told.
#[test]
fn a_force_beyond_its_limit_is_told_to_who_reads() {
    let folder = tempfile::tempdir().unwrap();
    let limited = protocol("published = \"liver\"\nsubject = \"1\"", HOLD)
        .replace("recovery_s = 5", "recovery_s = 5\nforce_limit_n = 0.006");
    fs::write(folder.path().join("protocol.toml"), limited).unwrap();
    let asked = ["measure", "protocol.toml", "--headless", "--out", "one.csv"];
    let output = palpate_in(folder.path(), &asked);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("one.csv")).unwrap();
    assert!(
        text.contains("# ended = \"the force reached 0.01 N"),
        "{text:.700}"
    );
    let read = palpate_in(folder.path(), &["analyze", "one.csv", "--json"]);
    let said = String::from_utf8_lossy(&read.stdout).into_owned() + &stderr(&read);
    assert!(said.contains("cut short (the force reached"), "{said}");
}
