//! What is refused, with a sentence that says what to do, and stays as it is.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use palpate_record::{Error, Filter, Record};
use rusqlite::Connection;

use crate::attempt;

/// Neither reading nor adding begins; the sentence has `words`, and the file its bytes.
fn refused(path: &Path, words: &[&str]) -> [Error; 2] {
    let before = fs::read(path).ok();
    let errors = [
        Record::open(path).unwrap_err(),
        Record::read(path).unwrap_err(),
    ];
    for error in &errors {
        let said = error.to_string();
        assert!(said.contains("; "), "{said}");
        // Another program that is busy is nobody's mistake.
        let is_locked = matches!(error, Error::Locked { .. });
        assert_eq!(error.is_input(), !is_locked, "{said}");
        for word in words {
            assert!(said.contains(word), "{said} lacks {word}");
        }
    }
    assert_eq!(fs::read(path).ok(), before);
    errors
}

#[test]
fn a_folder_and_what_is_no_folder_are_no_record() {
    let folder = tempfile::tempdir().unwrap();
    refused(folder.path(), &["folder"]);
    let file = folder.path().join("notes.txt");
    fs::write(&file, "a file").unwrap();
    let inside = file.join("training.sqlite");
    assert!(matches!(Record::open(&inside), Err(Error::Unusable { .. })));
    assert!(matches!(Record::read(&inside), Err(Error::Missing { .. })));
}

#[test]
fn reading_begins_no_record() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    assert!(matches!(Record::read(&path), Err(Error::Missing { .. })));
    assert!(!path.exists());
    fs::write(&path, "").unwrap();
    assert!(matches!(Record::read(&path), Err(Error::Missing { .. })));
    assert_eq!(fs::metadata(&path).unwrap().len(), 0);
    // For somebody who adds, an empty file is a record that has not begun.
    let mut record = Record::open(&path).unwrap();
    record.add(&attempt("Anna", "Cut", 1)).unwrap();
    assert!(record.warnings().is_empty());
}

/// A mistyped name must not cost anybody a file.
#[test]
fn files_of_others_stay_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let notes = folder.path().join("notes.txt");
    fs::write(&notes, "Anna was better today.\n".repeat(100)).unwrap();
    refused(&notes, &["notes.txt", "no training record", "another file"]);
    // So short that the database takes it for an empty one.
    fs::write(&notes, "x").unwrap();
    refused(&notes, &["no training record"]);
    let picture = folder.path().join("picture.png");
    fs::write(&picture, b"\x89PNG\r\n\x1a\n\0\0").unwrap();
    refused(&picture, &["no training record"]);
    for name in ["places.sqlite", "places"] {
        let other = folder.path().join(name);
        let sql =
            "CREATE TABLE attempt (id); CREATE TABLE measure (id); INSERT INTO attempt VALUES (1)";
        Connection::open(&other)
            .unwrap()
            .execute_batch(sql)
            .unwrap();
        refused(&other, &["no training record"]);
        // Not even when it is damaged.
        let mut bytes = fs::read(&other).unwrap();
        bytes.truncate(5000);
        fs::write(&other, bytes).unwrap();
        refused(&other, &["no training record"]);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 4);
}

#[test]
fn a_newer_record_is_left_to_newer_programs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    drop(Record::open(&path).unwrap());
    let later = Connection::open(&path).unwrap();
    later
        .execute_batch("PRAGMA user_version = 7; DROP TABLE measure")
        .unwrap();
    drop(later);
    refused(&path, &["version 7", "version 3", "newer"]);
}

#[test]
#[ignore = "long"]
fn a_locked_record_is_waited_for_and_then_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    let mut open = Record::open(&path).unwrap();
    open.add(&attempt("Anna", "Cut", 1)).unwrap();
    let other = Connection::open(&path).unwrap();
    other.execute_batch("BEGIN EXCLUSIVE").unwrap();
    let begun = Instant::now();
    for error in refused(&path, &["in use", "training.sqlite"]) {
        assert!(matches!(error, Error::Locked { .. }));
    }
    let added = open.add(&attempt("Anna", "Cut", 2));
    assert!(matches!(added, Err(Error::Locked { .. })));
    assert!(begun.elapsed() >= Duration::from_secs(6));
    other.execute_batch("COMMIT").unwrap();
    open.add(&attempt("Anna", "Cut", 2)).unwrap();
    assert_eq!(open.attempts(&Filter::default()).unwrap().len(), 2);
}

/// Another program that is done within the patience is not noticed.
#[test]
fn a_record_that_is_locked_for_a_moment_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    drop(Record::open(&path).unwrap());
    let other = Connection::open(&path).unwrap();
    other.execute_batch("BEGIN EXCLUSIVE").unwrap();
    std::thread::scope(|scope| {
        let adding = scope.spawn(|| Record::open(&path)?.add(&attempt("Anna", "Cut", 1)));
        std::thread::sleep(Duration::from_millis(300));
        other.execute_batch("COMMIT").unwrap();
        adding.join().unwrap().unwrap();
    });
}

#[test]
fn an_attempt_that_cannot_be_kept_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut record = Record::open(folder.path().join("training.sqlite")).unwrap();
    let kept = attempt("Anna", "Cut", 1);
    record.add(&kept).unwrap();
    let refused = |record: &mut Record, word: &str, mut change: Box<dyn FnMut(&mut _)>| {
        let mut own = kept.clone();
        change(&mut own);
        let said = record.add(&own).unwrap_err().to_string();
        assert!(said.contains(word) && said.contains("; "), "{said}");
        assert_eq!(
            record.attempts(&Filter::default()).unwrap(),
            std::slice::from_ref(&kept)
        );
    };
    type Own = palpate_record::Attempt;
    refused(
        &mut record,
        "trainee",
        Box::new(|own: &mut Own| own.trainee = " ".into()),
    );
    refused(
        &mut record,
        "task",
        Box::new(|own: &mut Own| own.task.clear()),
    );
    refused(
        &mut record,
        "measure",
        Box::new(|own: &mut Own| own.measures[3].key.clear()),
    );
    for value in [f64::NAN, f64::INFINITY] {
        let change = move |own: &mut Own| own.measures[39].value = value;
        refused(&mut record, "measure_39", Box::new(change));
    }
    let twice = |own: &mut Own| own.measures[39].key = own.measures[0].key.clone();
    refused(&mut record, "twice", Box::new(twice));
}
