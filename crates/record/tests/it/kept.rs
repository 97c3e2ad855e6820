//! What was added is there again. Judge: what was added.

use std::fs;

use palpate_record::{Added, Attempt, Filter, Record};

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
    assert!(record.warnings().is_empty());
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

/// An attempt counts once, and never takes the place of another: not of another trainee's, another time's or another
/// session's in the same folder.
#[test]
fn attempts_are_told_apart_by_content_and_never_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    let mut record = Record::open(&path).unwrap();
    let anna = attempt("Anna", "Cut", 1);
    assert_eq!(record.add(&anna).unwrap(), Added::New);
    // Scored again, from a copy, with what another version makes of it.
    let mut again = anna.clone();
    again.session = "/elsewhere".into();
    again.measures.truncate(3);
    assert_eq!(record.add(&again).unwrap(), Added::AlreadyThere);
    let same = Added::SameSession {
        trainee: "Anna".to_owned(),
        when: anna.when,
    };
    let bela = Attempt {
        trainee: "Béla".to_owned(),
        ..anna.clone()
    };
    assert_eq!(record.add(&bela).unwrap(), same);
    let later = Attempt {
        when: anna.when + 60,
        ..anna.clone()
    };
    assert_eq!(record.add(&later).unwrap(), same);
    let other = Attempt {
        session_digest: "other".to_owned(),
        ..anna.clone()
    };
    assert_eq!(record.add(&other).unwrap(), Added::New);
    let kept = record.attempts(&Filter::default()).unwrap();
    assert_eq!(kept, [anna, bela, other, later]);
}

/// The tables of version 1, with two attempts.
const VERSION_1: &str = "
CREATE TABLE attempt (
    id INTEGER PRIMARY KEY,
    session TEXT NOT NULL UNIQUE,
    trainee TEXT NOT NULL,
    task TEXT NOT NULL,
    scene_digest TEXT NOT NULL,
    when_s INTEGER NOT NULL,
    passed INTEGER CHECK (passed IN (0, 1)),
    is_expert INTEGER NOT NULL CHECK (is_expert IN (0, 1))
) STRICT;
CREATE TABLE measure (
    attempt INTEGER NOT NULL REFERENCES attempt (id),
    place INTEGER NOT NULL,
    key TEXT NOT NULL,
    value REAL NOT NULL,
    better TEXT NOT NULL CHECK (better IN ('less', 'more', 'neither')),
    PRIMARY KEY (attempt, place)
) STRICT, WITHOUT ROWID;
INSERT INTO attempt VALUES (3, '/sessions/a', 'Anna', 'Cut', '1f3a', 7, 1, 0);
INSERT INTO attempt VALUES (5, '/sessions/b', 'Anna', 'Cut', '1f3a', 7, NULL, 1);
INSERT INTO measure VALUES (3, 0, 'time_s', 2.5, 'less');
INSERT INTO measure VALUES (5, 0, 'time_s', 3.5, 'less');
INSERT INTO measure VALUES (5, 1, 'drops', 0, 'less');
PRAGMA application_id = 0x7061_6c70;
PRAGMA user_version = 1;
";

/// A record of version 1 is read as it is, and keeps all its attempts when one is added.
#[test]
fn a_record_of_version_1_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    let version_1 = VERSION_1.replace("0x7061_6c70", "0x70616c70");
    rusqlite::Connection::open(&path)
        .unwrap()
        .execute_batch(&version_1)
        .unwrap();
    let bytes = fs::read(&path).unwrap();
    let read = Record::read(&path).unwrap();
    let before = read.attempts(&Filter::default()).unwrap();
    drop(read);
    assert_eq!(fs::read(&path).unwrap(), bytes);
    let measures: Vec<_> = before.iter().map(|own| own.measures.len()).collect();
    assert_eq!(measures, [1, 2]);
    let mut record = Record::open(&path).unwrap();
    assert!(record.warnings().is_empty());
    assert_eq!(record.attempts(&Filter::default()).unwrap(), before);
    let new = attempt("Anna", "Cut", 9);
    assert_eq!(record.add(&new).unwrap(), Added::New);
    drop(record);
    let all = Record::open(&path)
        .unwrap()
        .attempts(&Filter::default())
        .unwrap();
    assert_eq!(all[..2], before);
    assert_eq!(all[2..], [new]);
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
