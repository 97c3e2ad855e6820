//! `palpate measure`, as an experimenter meets it.

use std::fs;

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
fn a_specimen_comes_back_as_its_tissue() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("protocol.toml"), protocol(SOFT, HOLD)).unwrap();
    let measured = palpate_in(
        folder.path(),
        &[
            "measure",
            "protocol.toml",
            "--headless",
            "--out",
            "one.csv",
            "--json",
        ],
    );
    let answer = json(&measured);
    assert_eq!(answer["recordings"][0]["file"], "one.csv", "{answer:#}");
    assert_eq!(answer["stopped"], false);
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
    let c10 = &specimen["neo_hookean"]["c10_pa"];
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
