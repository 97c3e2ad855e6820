//! What a simulated palpation feels, beside `palpate solve` of the same tissue under the same indenter. The block of
//! `solve` is round and has the cube's height and cross-section.

use std::fs;
use std::path::Path;

use palpate_files::Session;

use crate::{json, palpate_in, stderr};

/// Neo-Hookean tissue that relaxes to a half.
const TISSUE: &str = "law = \"neo_hookean\"\nc10_pa = 1000.0\n\
                      prony = [{ g = 0.2866, tau_s = 1.537 }, { g = 0.2022, tau_s = 6.090 }]\n";

fn problem(accuracy: f64, asked: &str) -> String {
    format!(
        "format = 1\nkind = \"indentation\"\nblock = {{ radius_m = 0.05642, height_m = 0.1 }}\n\
         indenter = {{ radius_m = 0.002, face = \"stick\", side = \"stick\" }}\naccuracy = {accuracy:?}\n{asked}\n\
         [tissue]\n{TISSUE}"
    )
}

fn scene(model: &str) -> String {
    format!(
        "format = 1\n[organ]\nbuiltin = \"cube\"\n[organ.tissue]\n{TISSUE}[model]\nkind = \"{model}\"\n\
         [[tool]]\nname = \"right\"\ntip = {{ shape = \"flat\", radius_m = 0.002 }}\n"
    )
}

/// Forces [N] of a course of times [s] and depths [m] into the cube's upper side.
fn simulated(folder: &Path, model: &str, course: &[(f64, f64)]) -> Vec<f64> {
    let rows = course
        .iter()
        .map(|(time, depth)| format!("{time},right,0.0,0.0,{}\n", 0.05 - depth));
    let motion = "# format = 1\ntime_s,tool,x_m,y_m,z_m\n".to_owned() + &rows.collect::<String>();
    fs::write(folder.join("motion.csv"), motion).unwrap();
    fs::write(folder.join("scene.toml"), scene(model)).unwrap();
    let arguments = [
        "simulate",
        "scene.toml",
        "--headless",
        "--motion",
        "motion.csv",
        "--out",
        "out",
        "--overwrite",
    ];
    let output = palpate_in(folder, &arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let session = Session::read(folder.join("out/session.csv")).unwrap();
    let at = |time: f64| {
        let nearest = |row: &&palpate_files::SessionRow| ((row.time_s - time).abs() * 1e9) as u64;
        session.rows.iter().min_by_key(nearest).unwrap().force_n[2]
    };
    course.iter().map(|(time, _)| at(*time)).collect()
}

fn solved(folder: &Path, accuracy: f64, asked: &str) -> (Vec<f64>, Vec<f64>) {
    fs::write(folder.join("problem.toml"), problem(accuracy, asked)).unwrap();
    let answer = json(&palpate_in(folder, &["solve", "problem.toml", "--json"]));
    let numbers = |key: &str| -> Vec<f64> {
        let list = answer[key].as_array().into_iter().flatten();
        list.map(|value| value.as_f64().unwrap()).collect()
    };
    (numbers("force_n"), numbers("time_s"))
}

/// Quick form of the two tests below: two depths and a short ramp under the local model, beside a coarser mesh. Judge:
/// the same. Tolerances: those of the long forms, and the 5 % that are asked of the mesh.
#[test]
fn a_palpation_begins_as_finite_elements() {
    let folder = tempfile::tempdir().unwrap();
    let (forces, _) = solved(folder.path(), 0.05, "depths_m = [0.0005, 0.001]");
    assert_eq!(forces.len(), 2);
    for (depth, force) in [0.0005, 0.001].into_iter().zip(forces) {
        let course = [(0.0, depth), (0.02, depth)];
        let found = simulated(folder.path(), "local", &course)[0];
        println!("{depth} m: {found:.5} N of {force:.5} N");
        assert!(
            (found / force - 1.0).abs() < 0.15,
            "{depth} {found} {force}"
        );
    }
    let ramp = "ramp = { depth_m = 0.001, ramp_s = 0.5, hold_s = 2.0, samples = 11 }";
    let (forces, times) = solved(folder.path(), 0.05, ramp);
    let course: Vec<_> = times
        .iter()
        .map(|time| (*time, 0.001 * (time / 0.5).min(1.0)))
        .collect();
    let found = simulated(folder.path(), "local", &course);
    let largest = |forces: &[f64]| forces.iter().copied().fold(0.0, f64::max);
    let scale = largest(&found) / largest(&forces);
    assert!((scale - 1.0).abs() < 0.15, "{scale}");
    for ((found, force), time) in found.iter().zip(&forces).zip(&times) {
        // Over its own largest force the mesh has no part.
        let off = (found / scale - force) / largest(&forces);
        assert!(off.abs() < 0.05, "{time} s: {off}");
    }
}

/// Judge: `palpate solve`. Ten depths to 3 radii, at once: no time to relax. Tolerance: 10 %, as asked of the trainer.
#[test]
#[ignore = "slow: ten depths by finite elements, a minute"]
fn ten_depths_are_those_of_finite_elements() {
    let folder = tempfile::tempdir().unwrap();
    let depths: Vec<f64> = (1..=10).map(|number| 0.6e-3 * f64::from(number)).collect();
    let (forces, _) = solved(folder.path(), 0.01, &format!("depths_m = {depths:?}"));
    for model in ["local", "hybrid"] {
        let mut largest = 0.0_f64;
        for (depth, force) in depths.iter().zip(&forces) {
            // The first row in contact is a step.
            let course = [(0.0, *depth), (0.02, *depth)];
            let found = simulated(folder.path(), model, &course)[0];
            println!(
                "{model} {:.1} mm: {found:.5} N of {force:.5} N",
                1e3 * depth
            );
            largest = largest.max((found / force - 1.0).abs());
        }
        assert!(largest < 0.1, "{model} {largest}");
    }
}

/// Judge: `palpate solve`. A ramp of half a second to 4 mm and ten seconds of rest. Tolerance: 5 % of the largest force, as asked of the
/// trainer, over the course divided by its own largest force, and 10 % of the force.
#[test]
#[ignore = "slow: a ramp by finite elements, a minute"]
fn a_ramp_and_its_relaxation_are_those_of_finite_elements() {
    let folder = tempfile::tempdir().unwrap();
    let ramp = "ramp = { depth_m = 0.004, ramp_s = 0.5, hold_s = 10.0, samples = 43 }";
    let (forces, times) = solved(folder.path(), 0.01, ramp);
    let largest = |forces: &[f64]| forces.iter().copied().fold(0.0, f64::max);
    let depth = |time: f64| 0.004 * (time / 0.5).min(1.0);
    let course: Vec<_> = times.iter().map(|time| (*time, depth(*time))).collect();
    for model in ["local", "hybrid"] {
        let found = simulated(folder.path(), model, &course);
        let scale = largest(&found) / largest(&forces);
        println!("{model}: peak {:.4}", scale - 1.0);
        assert!((scale - 1.0).abs() < 0.1, "{model} {scale}");
        for ((found, force), time) in found.iter().zip(&forces).zip(&times) {
            let off = (found / scale - force) / largest(&forces);
            assert!(off.abs() < 0.05, "{model} {time} s: {off}");
        }
    }
}
