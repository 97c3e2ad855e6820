use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

use palpate_files::Overwrite;
use palpate_jobs::characterize::{StudyFolder, characterize};
use palpate_jobs::{NoProgress, ProgressCallback, Recordings, json_text};

use crate::measured;
use crate::recordings::quick;

/// Unwinds when it has heard so much.
struct Impatient {
    left: AtomicUsize,
}

impl Impatient {
    fn hears(&self) {
        let left = self
            .left
            .fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| {
                left.checked_sub(1)
            });
        if left.is_err() {
            resume_unwind(Box::new("impatient"));
        }
    }
}

impl ProgressCallback for Impatient {
    fn report_step(&self, _doing: &str) {
        self.hears();
    }

    fn report_fraction(&self, _part: f64) {
        self.hears();
    }
}

/// Broken off after each of its words, on its threads: the study holds whole files alone, and goes on to the same
/// answer.
#[test]
#[ignore = "long"]
fn a_study_that_is_cancelled_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings {
        paths: measured(folder.path()),
        ..Recordings::default()
    };
    let whole = characterize(&recordings, quick(), None, &NoProgress).unwrap();
    let whole = json_text(&whole.answer).unwrap();
    for patience in 0.. {
        let kept = tempfile::tempdir().unwrap();
        let study = StudyFolder::open(kept.path(), Overwrite::Refused).unwrap();
        let watch = Impatient {
            left: AtomicUsize::new(patience),
        };
        let begun = catch_unwind(AssertUnwindSafe(|| {
            characterize(&recordings, quick(), Some(&study), &watch).map(drop)
        }));
        for file in fs::read_dir(kept.path()).unwrap() {
            let path = file.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            if [".palpate-lock", ".palpate-study"].contains(&name) {
                continue;
            }
            let ending = path.extension().unwrap().to_str().unwrap().to_owned();
            assert!(
                ["json", "toml", "csv"].contains(&ending.as_str()),
                "{path:?}"
            );
            if ending == "json" {
                let text = fs::read_to_string(&path).unwrap();
                let _whole: serde_json::Value = serde_json::from_str(&text).unwrap();
            }
        }
        let found = characterize(&recordings, quick(), Some(&study), &NoProgress).unwrap();
        assert_eq!(json_text(&found.answer).unwrap(), whole, "after {patience}");
        if begun.is_ok() {
            assert!(patience > 4, "{patience}");
            break;
        }
    }
}
