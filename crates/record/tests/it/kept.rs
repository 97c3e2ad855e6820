//! What was added is there again. Judge: what was added.

use std::fs;

use palpate_record::{Filter, Record};

use crate::attempt;

#[test]
fn what_was_added_is_read_again_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/folders/training.sqlite");
    let mut added = Vec::new();
    for seed in 0..6 {
        let own = attempt(
            if seed < 3 {
                "Anna"
            } else {
                "Béla; DROP TABLE"
            },
            "Cut",
            seed,
        );
        // Each time anew, as programs do.
        Record::open(&path).unwrap().add(&own).unwrap();
        added.push(own);
    }
    let mut bare = attempt("Anna", "Find", 7);
    bare.measures.clear();
    let mut record = Record::open(&path).unwrap();
    record.add(&bare).unwrap();
    added.push(bare);
    assert!(record.doubts().is_empty());
    assert_eq!(record.attempts(&Filter::default()).unwrap(), added);
    let read = Record::read(&path).unwrap();
    assert_eq!(read.attempts(&Filter::default()).unwrap(), added);
    assert_eq!(read.trainees().unwrap(), ["Anna", "Béla; DROP TABLE"]);
    assert_eq!(read.tasks().unwrap(), ["Cut", "Find"]);
    drop((record, read));
    let left = fs::read_dir(path.parent().unwrap()).unwrap().count();
    assert_eq!(left, 1, "one file and nothing beside it");
}

#[test]
fn a_filter_leaves_what_it_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut record = Record::open(folder.path().join("training.sqlite")).unwrap();
    let all = [("Anna", "Cut", 2), ("Anna", "Find", 1), ("Béla", "Cut", 3)];
    for (trainee, task, seed) in all {
        record.add(&attempt(trainee, task, seed)).unwrap();
    }
    let seeds = |trainee: Option<&str>, task: Option<&str>| {
        let filter = Filter {
            trainee: trainee.map(str::to_owned),
            task: task.map(str::to_owned),
        };
        let found = record.attempts(&filter).unwrap();
        let seeds = found.iter().map(|own| (own.when - 1_700_000_000) / 60);
        seeds.collect::<Vec<_>>()
    };
    assert_eq!(seeds(None, None), [1, 2, 3]);
    assert_eq!(seeds(Some("Anna"), None), [1, 2]);
    assert_eq!(seeds(None, Some("Cut")), [2, 3]);
    assert_eq!(seeds(Some("Béla"), Some("Find")), [0; 0]);
}

/// A session that is scored again is the same attempt, by whatever way its folder is named.
#[test]
fn a_session_counts_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    let session = folder.path().join("session");
    fs::create_dir(&session).unwrap();
    let mut record = Record::open(&path).unwrap();
    for (seed, place) in [(1, session.clone()), (2, session.join("../session/."))] {
        let mut own = attempt("Anna", "Cut", seed);
        own.session = place;
        own.measures.truncate(40 - seed as usize);
        record.add(&own).unwrap();
    }
    let mut again = attempt("Anna", "Cut", 2);
    again.session = fs::canonicalize(&session).unwrap();
    again.measures.truncate(38);
    assert_eq!(record.attempts(&Filter::default()).unwrap(), [again]);
}

/// Two programs at once, one attempt after the other: all are kept.
#[test]
fn several_programs_may_add() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    std::thread::scope(|scope| {
        for trainee in ["Anna", "Béla", "Cleo"] {
            let path = &path;
            scope.spawn(move || {
                for seed in 0..10 {
                    let mut record = Record::open(path).unwrap();
                    record.add(&attempt(trainee, "Cut", seed)).unwrap();
                }
            });
        }
    });
    let record = Record::read(&path).unwrap();
    assert_eq!(record.attempts(&Filter::default()).unwrap().len(), 30);
}
