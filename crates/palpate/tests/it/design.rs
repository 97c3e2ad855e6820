//! `palpate design`, as an experimenter meets it.

use std::fs;
use std::path::Path;

use crate::errors::assert_refused;
use crate::{json, palpate_in};

const LIVER: &str = "format = 1\n[tissue]\nname = \"liver\"\nlaw = \"mooney_rivlin\"\nc10_pa = 386.0\nc01_pa = 226.0\n\
                     prony = [{ g = 0.2866, tau_s = 1.537 }, { g = 0.2022, tau_s = 6.09 }]\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("liver.toml"), LIVER).unwrap();
    folder
}

fn designed(folder: &Path, more: &[&str]) -> serde_json::Value {
    json(&palpate_in(
        folder,
        &[&["design", "liver.toml", "--json"], more].concat(),
    ))
}

/// The half width of an interval over the value [-].
fn reach(answer: &serde_json::Value, name: &str, key: &str) -> f64 {
    let told = &answer["parameters"][name];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    0.5 * (number(&told[key][1]) - number(&told[key][0])) / number(&told["value"])
}

/// Judge: what is wanted is expected to be known better than before, and what is designed keeps within the limits.
#[test]
#[ignore = "long"]
fn a_protocol_keeps_within_its_limits_and_tells_more() {
    let folder = folder();
    let limits = [
        "--depth-mm",
        "4",
        "--total-time",
        "40",
        "--press-time",
        "25",
        "--radii-mm",
        "1,1.5",
    ];
    let found = designed(folder.path(), &limits);
    let number = |key: &str| found["designed"][key].as_f64().unwrap();
    let depths = found["designed"]["depths_m"].as_array().unwrap();
    assert!(depths.iter().all(|depth| depth.as_f64().unwrap() <= 4e-3));
    assert!(number("time_s") <= 40.0 + 1e-9 && number("ramp_s") + number("hold_s") <= 25.0 + 1e-9);
    assert!(
        [1e-3, 1.5e-3]
            .iter()
            .any(|radius| (number("indenter_radius_m") - radius).abs() < 1e-12)
    );
    let wanted = ["--parameters", "tau_1_s,tau_2_s"];
    let found = designed(folder.path(), &wanted);
    for name in ["tau_1_s", "tau_2_s"] {
        assert_eq!(found["parameters"][name]["wanted"], true);
        let [before, after] =
            ["interval_95_before", "interval_95_expected"].map(|key| reach(&found, name, key));
        assert!(after < before, "{name}: {after} {before}");
    }
    assert_eq!(found["parameters"]["c10_pa"]["wanted"], false);
}

/// The chain: the file that is written is measured, and what is found holds the guess, of which the virtual specimen is made.
/// C₁₀ is as well known as was expected, but for a factor of two by which expectation may err (`design::…` of
/// palpate-characterize) and another by which an interval spreads that comes from noise known from three presses. Those of
/// the times are up to five times as wide on this rig: see the limits in `docs/theory/characterization.md`.
#[test]
#[ignore = "long"]
fn a_designed_protocol_is_measured() {
    let folder = folder();
    let neo_hookean = LIVER
        .replace("mooney_rivlin", "neo_hookean")
        .replace("c01_pa = 226.0\n", "");
    fs::write(folder.path().join("liver.toml"), neo_hookean).unwrap();
    let found = designed(
        folder.path(),
        &["--out", "protocol.toml", "--radii-mm", "2"],
    );
    let run = |arguments: &[&str]| {
        let ran = std::process::Command::new(env!("CARGO_BIN_EXE_palpate"))
            .args(arguments)
            .current_dir(folder.path())
            .env("PALPATE_CACHE", folder.path().join("kept"))
            .output()
            .unwrap();
        json(&ran)
    };
    run(&[
        "measure",
        "protocol.toml",
        "--headless",
        "--out",
        "made",
        "--json",
    ]);
    let asked = [
        "characterize",
        "made",
        "--law",
        "neo_hookean",
        "--terms",
        "2",
        "--draws",
        "0",
        "--json",
    ];
    let specimen = &run(&asked)["specimens"][0];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let relaxation = &specimen["relaxation"];
    let c10 = &specimen["laws"]["neo_hookean"]["c10_pa"];
    for (truth, known) in [
        (386.0, c10),
        (1.537, &relaxation["tau_s"][0]),
        (6.09, &relaxation["tau_s"][1]),
    ] {
        let [low, high] = [0, 1].map(|end| number(&known["interval_95"][end]));
        assert!((low..=high).contains(&truth), "{known:#}");
    }
    let half = 0.5 * (number(&c10["interval_95"][1]) - number(&c10["interval_95"][0]))
        / number(&c10["value"]);
    let ratio = half / reach(&found, "c10_pa", "interval_95_expected");
    assert!((0.25..=4.0).contains(&ratio), "{ratio}");
}

#[test]
fn what_cannot_be_designed_is_one_sentence() {
    let folder = folder();
    let refused = |more: &[&str], said: &str| {
        let asked = [&["design", "liver.toml"], more].concat();
        assert_refused(folder.path(), &asked, &[said]);
    };
    refused(&["--parameters", "alpha"], "no parameter `alpha`");
    refused(
        &["--force-n", "1e-9"],
        "no protocol keeps within the limits",
    );
    refused(&["--depth-mm=-1"], "above zero");
    refused(&["--presses", "0"], "give 1 to 10");
    refused(&["--radii-mm", "0"], "an indenter's radius is 0 m");
    refused(&["--law", "neo_hookean"], "leave it out");
    refused(&["liver.csv"], "one tissue or recordings alone");
    let linear = "format = 1\n[tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 3000.0\npoissons_ratio = 0.45\n";
    fs::write(folder.path().join("liver.toml"), linear).unwrap();
    refused(&[], "not one that indentations are fitted with");
}
