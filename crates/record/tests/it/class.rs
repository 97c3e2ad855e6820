//! What a teacher keeps beside the attempts.

use palpate_record::{Assignment, AssignmentProgress, Cohort, Error, Filter, Record};

use crate::attempt;

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn cohorts_and_assignments_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    let mut record = Record::open(&path).unwrap();
    record
        .join("spring", &names(&["Béla", "Anna", "Anna"]))
        .unwrap();
    record.join("autumn", &names(&["Carla"])).unwrap();
    record
        .leave("autumn", &names(&["Carla", "nobody"]))
        .unwrap();
    let mut given = Assignment {
        cohort: "spring".to_owned(),
        task: "Cut".to_owned(),
        due: 2_000,
        passes: 1,
    };
    record.assign(&given).unwrap();
    given.passes = 2;
    record.assign(&given).unwrap();
    assert!(matches!(
        record.join(" ", &names(&["Anna"])),
        Err(Error::Unnamed { .. })
    ));
    drop(record);
    let record = Record::read(&path).unwrap();
    let spring = Cohort {
        name: "spring".to_owned(),
        trainees: names(&["Anna", "Béla"]),
    };
    assert_eq!(record.cohorts().unwrap(), [spring]);
    assert_eq!(record.assignments().unwrap(), [given]);
}

/// Judge: the attempts by hand. What was passed after the due time does not count.
#[test]
fn an_assignment_is_done_by_enough_passes_in_time() {
    let at = |when: i64, passed: bool| palpate_record::Attempt {
        when,
        passed: Some(passed),
        ..attempt("Anna", "Cut", when)
    };
    let mut other = at(3, true);
    other.task = "Pull".to_owned();
    let attempts = [at(1, false), at(2, true), other, at(10, true), at(11, true)];
    let given = |passes: u32| Assignment {
        cohort: "spring".to_owned(),
        task: "Cut".to_owned(),
        due: 10,
        passes,
    };
    let expected = |is_done: bool| AssignmentProgress {
        attempts: 4,
        passed: 2,
        is_done,
    };
    assert_eq!(given(2).standing(attempts.iter()), expected(true));
    assert_eq!(given(3).standing(attempts.iter()), expected(false));
}

#[test]
fn a_pin_is_asked_for_once_there_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut record = Record::open(folder.path().join("training.sqlite")).unwrap();
    record.check_pin(None).unwrap();
    record.set_pin("4711").unwrap();
    record.check_pin(Some("4711")).unwrap();
    for wrong in [None, Some(""), Some("4712")] {
        assert!(matches!(
            record.check_pin(wrong),
            Err(Error::WrongPin { .. })
        ));
    }
    record.set_pin("0815").unwrap();
    record.check_pin(Some("0815")).unwrap();
}

/// Only what was passed, and it stays whose it is.
#[test]
fn a_passed_attempt_becomes_an_experts_and_stays_its_owners() {
    let folder = tempfile::tempdir().unwrap();
    let mut record = Record::open(folder.path().join("training.sqlite")).unwrap();
    let (failed, passed) = (attempt("Anna", "Cut", 1), attempt("Anna", "Cut", 5));
    assert_eq!((failed.passed, passed.passed), (Some(false), Some(true)));
    record.add(&failed).unwrap();
    record.add(&passed).unwrap();
    record.make_expert("Anna", &passed.session_digest).unwrap();
    for (who, session) in [
        ("Anna", &failed.session_digest),
        ("Béla", &passed.session_digest),
    ] {
        assert!(matches!(
            record.make_expert(who, session),
            Err(Error::NoExpert { .. })
        ));
    }
    let all = record.attempts(&Filter::default()).unwrap();
    let found: Vec<_> = all
        .iter()
        .map(|own| (own.trainee.as_str(), own.is_expert))
        .collect();
    assert_eq!(found, [("Anna", false), ("Anna", true)]);
}
