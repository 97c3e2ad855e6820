use std::path::Path;
use std::sync::Mutex;

use palpate_jobs::solve::{Problem, RequestedOutputs, solve};
use palpate_jobs::{NoProgress, ProgressCallback, json_text};

const PUNCH: &str = r#"
format = 1
kind = "indentation"
block = { radius_m = 0.05, height_m = 0.05 }
indenter = { radius_m = 0.002, face = "slip", side = "none" }
depths_m = [0.0005]
accuracy = 0.05
tissue = { law = "linear", youngs_modulus_pa = 1000.0, poissons_ratio = 0.4 }
"#;

/// Writes all down that it hears.
#[derive(Default)]
struct Listener {
    parts: Mutex<Vec<f64>>,
    words: Mutex<Vec<String>>,
}

impl ProgressCallback for Listener {
    fn report_step(&self, doing: &str) {
        self.words.lock().unwrap().push(doing.to_owned());
    }

    fn report_fraction(&self, part: f64) {
        self.parts.lock().unwrap().push(part);
    }
}

#[test]
fn what_is_answered_does_not_depend_on_who_waits() {
    let problem = Problem::parse(PUNCH, Path::new("punch.toml")).unwrap();
    let listener = Listener::default();
    let of = |watch: &dyn ProgressCallback| {
        let mut answer = solve(&problem, RequestedOutputs::default(), watch).unwrap();
        answer.seconds = 0.0;
        json_text(&answer).unwrap()
    };
    assert_eq!(of(&NoProgress), of(&listener));
    let parts = listener.parts.into_inner().unwrap();
    assert!(!parts.is_empty() && parts.iter().all(|part| (0.0..=1.0).contains(part)));
    let words = listener.words.into_inner().unwrap();
    assert_eq!(words[..2], ["preparing the mesh", "coarsest mesh"]);
}

#[test]
fn a_problem_is_refused_with_its_line() {
    let wrong = PUNCH.replace("accuracy", "acuracy");
    let refused = Problem::parse(&wrong, Path::new("punch.toml")).unwrap_err();
    assert!(refused.is_input());
    let said = refused.to_string();
    assert!(
        said.contains("punch.toml line 7") && said.contains("accuracy"),
        "{said}"
    );
}
