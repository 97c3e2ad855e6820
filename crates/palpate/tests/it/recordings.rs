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
#[ignore = "long"]
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
        specimens[specimen]["laws"]["neo_hookean"]["c10_pa"]["value"]
            .as_f64()
            .unwrap()
    };
    assert!((c10(0) / 500.0 - 1.0).abs() < 0.08, "{}", c10(0));
    assert!((c10(1) / c10(0) / 1.5 - 1.0).abs() < 0.04, "{}", c10(1));
    for key in ["laws", "lumped", "preferred", "identifiability"] {
        assert!(!specimens[0][key].is_null(), "{key}: {answer:#}");
    }
    let laws = specimens[0]["laws"].as_object().unwrap();
    let names: Vec<&String> = laws.keys().collect();
    assert_eq!(names, ["exponential", "mooney_rivlin", "neo_hookean"]);
    assert!(laws.contains_key(specimens[0]["preferred"].as_str().unwrap()));
    // The keys of the first version say the same for one release.
    for (name, law) in laws {
        assert_eq!(&specimens[0][name], law);
    }
    let lumped = &specimens[0]["lumped"];
    assert_eq!(specimens[0]["blatz"], lumped["column"]);
    for key in ["kelvin", "nonlinear_springs", "mean_elastic_modulus"] {
        assert_eq!(specimens[0][key], lumped[key]);
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
    let asked = |more: &[&str]| {
        let line = "characterize . --study kept --law neo_hookean --json";
        let line: Vec<&str> = line.split(' ').chain(more.iter().copied()).collect();
        palpate_in(folder.path(), &line)
    };
    let run = || json(&asked(&[]));
    let refused = |file: &str| {
        let output = asked(&[]);
        assert_eq!(output.status.code(), Some(2));
        let said = format!("{file} is there already");
        assert!(stderr(&output).contains(&said), "{}", stderr(&output));
        json(&asked(&["--overwrite"]))
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
    assert_eq!(run()["specimens"][0]["subject"], "kept");
    fs::write(at("liver-B.json"), "{ half").unwrap();
    let second = refused("kept/liver-B.json");
    assert_eq!(second["specimens"][0]["subject"], "kept");
    assert_eq!(second["specimens"][1], first["specimens"][1]);
    // Another recording is another specimen.
    fs::write(
        folder.path().join("a1.csv"),
        recording(0.001, 9.0, &liver("A")),
    )
    .unwrap();
    let third = refused("kept/liver-A.json");
    assert_eq!(third["specimens"][0]["subject"], "A");
    assert_ne!(third["specimens"][0], first["specimens"][0]);
    // Tables of somebody else are no study's.
    fs::create_dir(folder.path().join("mine")).unwrap();
    fs::write(folder.path().join("mine/summary.csv"), "mine").unwrap();
    let line = ["characterize", ".", "--study", "mine", "--draws", "0"];
    assert_refused(folder.path(), &line, &["summary.csv is there already"]);
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
    assert!(specimen["laws"]["neo_hookean"].is_null() && !specimen["relaxation"].is_null());
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
    assert!(!answer["specimens"][0]["laws"]["neo_hookean"].is_null());
}

/// Student's t of one and of two degrees of freedom at 95 %, from a table.
const T: [f64; 2] = [12.706_204_7, 4.302_652_7];

/// Two sites of one animal count once, and a liver in the animal is no liver outside of it. Judge: the closed form
/// of the recordings, in which the force, and so C₁₀, grows with the stiffness; and the table of t.
#[test]
fn an_animal_counts_once_and_conditions_are_kept_apart() {
    let folder = tempfile::tempdir().unwrap();
    let specimens = [
        ("in_vivo", Some("A"), "left", 8.0),
        ("in_vivo", Some("A"), "right", 12.0),
        ("in_vivo", Some("B"), "left", 16.0),
        ("ex_vivo", Some("A"), "left", 24.0),
        ("ex_vivo", None, "left", 20.0),
        ("ex_vivo", None, "right", 28.0),
    ];
    for (place, (condition, subject, site, stiffness)) in specimens.into_iter().enumerate() {
        let subject = subject.map_or(String::new(), |own| format!("# subject = \"{own}\"\n"));
        let keys = format!(
            "# organ = \"liver\"\n{subject}# site = \"{site}\"\n# condition = \"{condition}\"\n{PUNCH}"
        );
        let text = recording(0.001, stiffness, &keys);
        fs::write(folder.path().join(format!("{place}.csv")), text).unwrap();
    }
    let asked = [
        "characterize",
        ".",
        "--json",
        "--law",
        "neo_hookean",
        "--draws",
        "0",
    ];
    let answer = json(&palpate_in(folder.path(), &asked));
    let pooled =
        |condition: &str| answer["pooled"][format!("liver.{condition}.neo_hookean.c10_pa")].clone();
    assert!(answer["pooled"]["liver.neo_hookean.c10_pa"].is_null());
    let [vivo, outside] = ["in_vivo", "ex_vivo"].map(pooled);
    let of = |pooled: &serde_json::Value, key: &str| pooled[key].as_f64().unwrap();
    assert_eq!(
        (of(&vivo, "n"), of(&vivo, "specimens")),
        (2.0, 3.0),
        "{vivo:#}"
    );
    assert_eq!(
        (of(&outside, "n"), of(&outside, "specimens")),
        (3.0, 3.0),
        "{outside:#}"
    );
    // Means of 10 and 16, and of 24, 20 and 28: C₁₀ is the stiffness times one number.
    let per_stiffness = of(&vivo, "mean") / 13.0;
    assert!((of(&outside, "mean") / per_stiffness / 24.0 - 1.0).abs() < 1e-3);
    for (pooled, count, t) in [(&vivo, 2.0_f64, T[0]), (&outside, 3.0, T[1])] {
        let reach = t * of(pooled, "standard_deviation") / count.sqrt();
        let [low, high] = [0, 1].map(|side| pooled["interval_95"][side].as_f64().unwrap());
        assert!(
            (0.5 * (high - low) / reach - 1.0).abs() < 1e-4,
            "{pooled:#}"
        );
        assert!((0.5 * (high + low) / of(pooled, "mean") - 1.0).abs() < 1e-9);
    }
    assert!((of(&vivo, "standard_deviation") / per_stiffness / 18_f64.sqrt() - 1.0).abs() < 1e-3);
}

/// The exponential law's nominal stress [Pa] at the stretch λ: ∂Ψ/∂λ of Ψ = γ/(2 α (α + 1)) Σ (exp(α (λᵢ² − 1)) − 1)
/// with λ₂ = λ₃ = 1/√λ.
fn nominal_stress(gamma: f64, alpha: f64, stretch: f64) -> f64 {
    let across = 1.0 / stretch;
    let along = (alpha * (stretch * stretch - 1.0)).exp() * stretch;
    let sideways = (alpha * (across - 1.0)).exp() * across * across;
    gamma / (alpha + 1.0) * (along - sideways)
}

/// `preferred` names the law in the answer and in the tissue that is written, and this tissue has the recorded force.
/// Judge: the energy of the law, differentiated by hand; the noise of 0.1 mN.
#[test]
fn the_preferred_law_has_one_name_and_the_recorded_force() {
    let (gamma, alpha, area) = (1500.0, 2.0, 4e-4);
    let folder = tempfile::tempdir().unwrap();
    let mut piece =
        "# format = 1\n# stimulus = \"uniaxial\"\n# area_m2 = 0.0004\n# height_m = 0.01\n\
                     time_s,depth_m,force_n\n"
            .to_owned();
    let stretch = |sample: u32| 1.0 - 1.5e-3 * f64::from(sample);
    for sample in 0..200 {
        let force = -area * nominal_stress(gamma, alpha, stretch(sample))
            + 1e-4 * (12.9898 * f64::from(sample)).sin();
        let (time, depth) = (0.1 * f64::from(sample), 1.5e-5 * f64::from(sample));
        piece += &format!("{time},{depth},{force}\n");
    }
    fs::write(folder.path().join("piece.csv"), piece).unwrap();
    let asked = ["characterize", "piece.csv", "--json", "--out", "found.toml"];
    let answer = json(&palpate_in(folder.path(), &asked));
    let specimen = &answer["specimens"][0];
    assert_eq!(specimen["preferred"], "exponential", "{specimen:#}");
    assert_eq!(specimen["exponential"], specimen["laws"]["exponential"]);
    assert!(specimen["blatz"].is_null(), "a column is no law");
    let known = |key: &str| &specimen["laws"]["exponential"][key];
    let text = fs::read_to_string(folder.path().join("found.toml")).unwrap();
    assert!(text.contains("law = \"exponential\""), "{text}");
    let tissue = palpate_files::Tissue::parse(&text, "found.toml").unwrap();
    let written = tissue.elasticity.parameters();
    let names: Vec<&str> = written.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["gamma_pa", "alpha"]);
    for (name, value) in &written {
        assert_eq!(known(name)["value"], value.value);
        let [low, high] = [0, 1].map(|side| known(name)["interval_95"][side].as_f64().unwrap());
        let truth = if *name == "alpha" { alpha } else { gamma };
        assert!(low < truth && truth < high, "{name}: {low} to {high}");
        // Student's quantile is no less than that of the normal distribution, and no more than that of two degrees of
        // freedom: the noise is a sine, of which few periods are seen.
        let reach = 0.5 * (high - low) / value.standard_error.unwrap();
        assert!((1.959..4.303).contains(&reach), "{name}: {reach}");
    }
    let problem =
        "format = 1\nkind = \"uniaxial\"\ntissue = \"found.toml\"\nstretches = [0.75, 0.9]\n";
    fs::write(folder.path().join("problem.toml"), problem).unwrap();
    let again = json(&palpate_in(
        folder.path(),
        &["solve", "problem.toml", "--json"],
    ));
    for (place, stretch) in [0.75, 0.9].into_iter().enumerate() {
        let off = again["nominal_stress_pa"][place].as_f64().unwrap()
            - nominal_stress(gamma, alpha, stretch);
        // The noise over the area is 0.25 Pa.
        assert!(off.abs() < 0.25, "{off} Pa at {stretch}");
    }
    let former = json(&palpate_in(
        folder.path(),
        &["characterize", "piece.csv", "--json", "--law", "blatz"],
    ));
    assert_eq!(former["specimens"][0]["preferred"], "exponential");
}

/// The same for a punch in a block of exponential tissue, where the column's γ is another. Judge: the finite elements
/// that made the recording, on another mesh than those of the fit; 1.5 % is what both promise.
#[test]
#[ignore = "long"]
fn an_indented_tissue_has_the_recorded_force_again() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let body = "format = 1\nkind = \"indentation\"\naccuracy = 0.01\n\
                block = { radius_m = 0.05642, height_m = 0.1 }\n\
                indenter = { radius_m = 0.001, face = \"stick\", side = \"stick\" }\n";
    let ramp = "ramp = { depth_m = 0.002, ramp_s = 0.5, hold_s = 10.0, samples = 200 }\n";
    let truth = "tissue = { law = \"exponential\", gamma_pa = 1000.0, alpha = 1.0, \
                 prony = [{ g = 0.3, tau_s = 2.0 }] }\n";
    write("truth.toml", &format!("{body}{ramp}{truth}"));
    let forces = |asked: &[&str]| -> Vec<f64> {
        let solved = json(&palpate_in(
            folder.path(),
            &[&["solve", "--json"], asked].concat(),
        ));
        let forces = solved["force_n"].as_array().unwrap();
        forces.iter().map(|force| force.as_f64().unwrap()).collect()
    };
    let recorded = forces(&["truth.toml", "--recording", "made.csv"]);
    let asked = [
        "characterize",
        "made.csv",
        "--json",
        "--law",
        "exponential",
        "--draws",
        "0",
        "--out",
        "found.toml",
    ];
    let answer = json(&palpate_in(folder.path(), &asked));
    let specimen = &answer["specimens"][0];
    let preferred = specimen["preferred"].as_str().unwrap();
    assert_eq!(specimen[preferred], specimen["laws"][preferred]);
    let gamma = |known: &serde_json::Value| known["gamma_pa"]["value"].as_f64().unwrap();
    let [law, column] = [&specimen["laws"][preferred], &specimen["lumped"]["column"]].map(gamma);
    assert!((law / column - 1.0).abs() > 0.5, "{law} and {column} Pa");
    write(
        "again.toml",
        &format!("{body}{ramp}tissue = \"found.toml\"\n"),
    );
    let again = forces(&["again.toml"]);
    let largest = recorded.iter().copied().fold(0.0, f64::max);
    let off = recorded.iter().zip(&again).map(|(a, b)| (a - b).abs());
    let worst = off.fold(0.0, f64::max) / largest;
    assert!(worst < 0.015, "{worst}");
}
