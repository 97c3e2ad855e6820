//! `palpate analyze` and `palpate characterize`, as a researcher with a folder of recordings meets them.

use std::fs;
use std::path::Path;

use crate::errors::assert_refused;
use crate::{json, palpate_in, stderr};

/// A ramp of 0.2 s and a hold of 20 s at 20 Hz of tissue with the stiffness `stiffness` [N/m] that relaxes by
/// g = 0.4 and τ = 2 s: F(t) = k v (t − g (t − τ (1 − exp(−t/τ)))) on the ramp, in closed form.
pub(crate) fn recording(depth: f64, stiffness: f64, keys: &str) -> String {
    let (g, tau, ramp) = (0.4, 2.0, 0.2);
    let speed = depth / ramp;
    let risen = |t: f64| t.max(0.0) - g * (t.max(0.0) - tau * (1.0 - (-t.max(0.0) / tau).exp()));
    let mut text =
        format!("# format = 1\n# stimulus = \"ramp_and_hold\"\n{keys}time_s,depth_m,force_n\n");
    for sample in 0..=404 {
        let t = 0.05 * f64::from(sample);
        let force = stiffness * speed * (risen(t) - risen(t - ramp));
        // What a sensor adds, the same every time.
        let noise = 1e-5 * (12.9898 * f64::from(sample)).sin();
        text += &format!("{t},{},{}\n", speed * t.min(ramp), force + noise);
    }
    text
}

const PUNCH: &str = "# indenter_shape = \"flat\"\n# indenter_radius_m = 0.001\n";

fn liver(subject: &str) -> String {
    format!("# organ = \"liver\"\n# subject = \"{subject}\"\n{PUNCH}")
}

/// Two depths of one subject, one of another, and a file that is no recording.
pub(crate) fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("a1.csv", &recording(0.001, 8.0, &liver("A")));
    write("a2.csv", &recording(0.002, 8.0, &liver("A")));
    write("b1.csv", &recording(0.001, 12.0, &liver("B")));
    write(
        "broken.csv",
        "# format = 1\ntime_s,depth_m,force_n\n0,0,0\n0.1,0.001,NaN\n",
    );
    folder
}

/// Judge: the closed form of the recordings. The reference's linear stiffness is 16 C₁₀ a for small depths,
/// and a neo-Hookean force falls behind it by up to 7 % at two radii.
#[test]
fn a_folder_is_a_study() {
    let folder = folder();
    let output = palpate_in(folder.path(), &["characterize", ".", "--json"]);
    let answer = json(&output);
    let specimens = answer["specimens"].as_array().unwrap();
    assert_eq!(specimens.len(), 2, "{answer:#}");
    assert_eq!(specimens[0]["files"].as_array().unwrap().len(), 2);
    let relaxation = &specimens[0]["relaxation"];
    let (g, tau) = (
        &relaxation["g"][0]["value"],
        &relaxation["tau_s"][0]["value"],
    );
    assert!((g.as_f64().unwrap() - 0.4).abs() < 0.01, "{relaxation:#}");
    assert!((tau.as_f64().unwrap() - 2.0).abs() < 0.1, "{relaxation:#}");
    let c10 = |specimen: usize| {
        specimens[specimen]["neo_hookean"]["c10_pa"]["value"]
            .as_f64()
            .unwrap()
    };
    assert!((c10(0) / 500.0 - 1.0).abs() < 0.08, "{}", c10(0));
    assert!((c10(1) / c10(0) / 1.5 - 1.0).abs() < 0.04, "{}", c10(1));
    for key in [
        "mooney_rivlin",
        "exponential",
        "preferred",
        "identifiability",
    ] {
        assert!(!specimens[0][key].is_null(), "{key}: {answer:#}");
    }
    assert_eq!(answer["pooled"]["liver.neo_hookean.c10_pa"]["n"], 2);
    let warnings = answer["warnings"].to_string();
    assert!(warnings.contains("broken.csv line 4"), "{warnings}");
}

/// A study is gone on with: what is kept is not found again, what was damaged or has changed is.
#[test]
fn a_study_goes_on_where_it_stopped() {
    let folder = folder();
    let at = |name: &str| folder.path().join("kept").join(name);
    let run = || {
        let asked = [
            "characterize",
            ".",
            "--study",
            "kept",
            "--law",
            "neo_hookean",
            "--json",
        ];
        json(&palpate_in(folder.path(), &asked))
    };
    let first = run();
    let summary = fs::read_to_string(at("summary.csv")).unwrap();
    assert!(
        summary.starts_with("# format = 1\nspecimen,organ,"),
        "{summary}"
    );
    assert_eq!(
        summary.lines().count(),
        5,
        "two specimens and what is no recording: {summary}"
    );
    assert!(summary.contains("broken.csv line 4"), "{summary}");
    assert!(
        fs::read_to_string(at("pooled.csv"))
            .unwrap()
            .contains("liver.neo_hookean.c10_pa,2,")
    );
    palpate_files::Tissue::read(at("liver-A.toml")).unwrap();
    // What is kept is taken as it stands, which a mark shows.
    let marked = fs::read_to_string(at("liver-A.json"))
        .unwrap()
        .replace("\"A\"", "\"kept\"");
    fs::write(at("liver-A.json"), marked).unwrap();
    fs::write(at("liver-B.json"), "{ half").unwrap();
    let second = run();
    assert_eq!(second["specimens"][0]["subject"], "kept");
    assert_eq!(second["specimens"][1], first["specimens"][1]);
    // Another recording is another specimen.
    fs::write(
        folder.path().join("a1.csv"),
        recording(0.001, 9.0, &liver("A")),
    )
    .unwrap();
    let third = run();
    assert_eq!(third["specimens"][0]["subject"], "A");
    assert_ne!(third["specimens"][0], first["specimens"][0]);
}

#[test]
fn a_tissue_and_its_cards_are_written() {
    let folder = folder();
    let output = palpate_in(
        folder.path(),
        &[
            "characterize",
            "a1.csv",
            "a2.csv",
            "--law",
            "neo_hookean",
            "--out",
            "liver.toml",
            "--abaqus",
            "liver.inp",
            "--febio",
            "liver.feb",
        ],
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let tissue = palpate_files::Tissue::parse(&read("liver.toml"), "liver.toml").unwrap();
    assert_eq!(tissue.name.as_deref(), Some("liver"));
    assert_eq!(tissue.source.recordings, ["a1.csv", "a2.csv"]);
    assert!(read("liver.inp").contains("*HYPERELASTIC, NEO HOOKE, MODULI=INSTANTANEOUS"));
    assert!(read("liver.feb").contains("uncoupled viscoelastic"));
}

#[test]
fn what_is_seen_without_a_model() {
    let folder = folder();
    let answer = json(&palpate_in(folder.path(), &["analyze", ".", "--json"]));
    let files = answer["files"].as_array().unwrap();
    assert_eq!(files.len(), 3);
    let relaxation = &files[0]["relaxation"];
    // After 20 s of τ = 2 s nothing is left to relax: 1 − g of what a step would have.
    let steady = relaxation["steady_n"].as_f64().unwrap();
    assert!(
        (steady / (8.0 * 0.001 * 0.6) - 1.0).abs() < 0.01,
        "{relaxation}"
    );
    for key in ["peak_n", "ratio", "settle_s"] {
        assert!(relaxation[key].as_f64().unwrap() > 0.0, "{key}");
    }
    let rows = answer["organs"][0]["static"].as_array().unwrap();
    assert_eq!(rows.len(), 2, "{answer:#}");
    assert_eq!(rows[0]["n"], 2);
    assert!(rows[0]["min_n"].as_f64().unwrap() < rows[0]["max_n"].as_f64().unwrap());
}

fn refused(folder: &Path, text: &str, words: &[&str]) {
    fs::write(folder.join("bad.csv"), text).unwrap();
    for command in ["analyze", "characterize"] {
        assert_refused(
            folder,
            &[command, "bad.csv"],
            &[&["bad.csv"], words].concat(),
        );
    }
}

#[test]
fn what_is_no_recording_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let head = "# format = 1\ntime_s,depth_m,force_n\n";
    let rows = |rows: &str| format!("{head}{rows}");
    refused(folder.path(), "", &[]);
    refused(folder.path(), &rows("0,0,0\n"), &["1 samples"]);
    refused(folder.path(), &rows("0,0,0\n1,0.001,x\n"), &["line 4"]);
    refused(
        folder.path(),
        &rows("0,0,0\n2,0.001,0.1\n1,0.001,0.1\n"),
        &["line 5"],
    );
    let constant: String = (0..50)
        .map(|i| format!("{i},{},0.25\n", 1e-5 * f64::from(i)))
        .collect();
    refused(folder.path(), &rows(&constant), &["0.25 N in every sample"]);
    assert_refused(
        folder.path(),
        &["characterize", "none.csv"],
        &["none.csv", "No such file"],
    );
    assert_refused(
        folder.path(),
        &["analyze", "bad.csv", "--set", "radius"],
        &["--set", "="],
    );
}

/// Without the indenter's radius there is a relaxation but no law, and the reason says what to add.
#[test]
fn a_missing_radius_is_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.csv"), recording(0.001, 8.0, "")).unwrap();
    let answer = json(&palpate_in(
        folder.path(),
        &["characterize", "a.csv", "--json"],
    ));
    let specimen = &answer["specimens"][0];
    assert!(specimen["neo_hookean"].is_null() && !specimen["relaxation"].is_null());
    let reason = specimen["reasons"]["neo_hookean"].as_str().unwrap();
    assert!(
        reason.contains("indenter_radius_m") && reason.contains("--set"),
        "{reason}"
    );
    let said = [
        "characterize",
        "a.csv",
        "--json",
        "--set",
        "indenter_radius_m=0.001",
    ];
    let answer = json(&palpate_in(folder.path(), &said));
    assert!(!answer["specimens"][0]["neo_hookean"].is_null());
}
