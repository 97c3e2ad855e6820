use std::fs;

use palpate_characterize::inverse::{SoughtLaw, Terms};
use palpate_jobs::characterize::{Choice, characterize, specimens};
use palpate_jobs::{Nobody, Recordings, json_text};

use crate::measured;

/// Few draws, one law: the question is who is asked, not what is found.
pub(crate) fn quick() -> Choice {
    Choice {
        law: Some(Choice::law_named("neo_hookean", None).unwrap()),
        draws: 10,
        ..Choice::default()
    }
}

/// Judge: the same recordings as files.
#[test]
fn texts_answer_as_files_do() {
    let folder = tempfile::tempdir().unwrap();
    let paths = measured(folder.path());
    let texts = paths
        .iter()
        .map(|path| (path.clone(), fs::read_to_string(path).unwrap()))
        .collect();
    let as_files = Recordings {
        paths,
        ..Recordings::default()
    };
    let as_texts = Recordings {
        texts,
        ..Recordings::default()
    };
    let answers = [&as_files, &as_texts].map(|recordings| {
        let found = characterize(recordings, quick(), None, &Nobody).unwrap();
        json_text(&found.answer).unwrap()
    });
    assert_eq!(answers[0], answers[1]);
    assert_eq!(
        specimens(&as_files).unwrap().0,
        specimens(&as_texts).unwrap().0
    );
}

/// The bounds are those of the settings: 0 is an answer without repeated fits, and from ten draws on there is a spread.
#[test]
fn too_few_draws_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings {
        paths: measured(folder.path()),
        ..Recordings::default()
    };
    let found = |draws: usize| {
        let choice = Choice { draws, ..quick() };
        characterize(&recordings, choice, None, &Nobody).map(|found| json_text(&found.answer))
    };
    for draws in [1, 9] {
        let sentence = found(draws).map(drop).unwrap_err().to_string();
        assert!(
            sentence.contains(&format!("{draws} draws are too few")),
            "{sentence}"
        );
    }
    for (draws, repeated) in [(0, false), (10, true)] {
        let text = found(draws).unwrap().unwrap();
        assert_eq!(
            text.contains("\"bootstrap_error\""),
            repeated,
            "{draws}: {text}"
        );
    }
}

#[test]
fn specimens_are_told_without_being_characterized() {
    let folder = tempfile::tempdir().unwrap();
    let paths = measured(folder.path());
    fs::write(folder.path().join("wrong.csv"), "nothing").unwrap();
    let recordings = Recordings {
        paths: vec![folder.path().to_owned()],
        ..Recordings::default()
    };
    let (found, unusable) = specimens(&recordings).unwrap();
    let named: Vec<_> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(named, ["soft, 1", "soft, 2"]);
    assert_eq!(found[0].1, [paths[0].clone()]);
    assert!(unusable[0].sentence().contains("wrong.csv"));
}

#[test]
fn a_law_that_is_not_there_is_refused_with_the_nearest() {
    let refused = Choice::law_named("neohookean", None).unwrap_err();
    assert!(refused.is_input());
    assert!(refused.to_string().contains("such as neo_hookean"));
}

#[test]
fn an_order_is_one_of_a_law_that_has_some() {
    let law = Choice::law_named("ogden", Some(3)).unwrap();
    assert_eq!(law, SoughtLaw::Ogden(Terms::Three));
    for (name, order, why) in [
        ("ogden", 4, "give 1, 2 or 3"),
        ("exponential", 1, "has no order"),
    ] {
        let refused = Choice::law_named(name, Some(order)).unwrap_err();
        assert!(
            refused.is_input() && refused.to_string().contains(why),
            "{refused}"
        );
    }
}
