//! Who is proficient. Judge: numbers by hand.

use std::path::PathBuf;

use palpate_record::{Attempt, Better, IN_A_ROW, Measure, Standards, proficient_since};

fn measured(measures: &[(&str, f64, Better)], passed: Option<bool>) -> Attempt {
    let measures = measures.iter().map(|(key, value, better)| Measure {
        key: (*key).to_owned(),
        value: *value,
        better: *better,
    });
    Attempt {
        trainee: "Anna".to_owned(),
        task: "Cut".to_owned(),
        scene_digest: String::new(),
        when: 0,
        session_digest: String::new(),
        session: PathBuf::from("session"),
        passed,
        is_expert: false,
        measures: measures.collect(),
    }
}

fn of(time: f64, economy: f64, contact: f64) -> Attempt {
    let measures = [
        ("time_s", time, Better::Less),
        ("economy", economy, Better::More),
        ("contact_time_s", contact, Better::Neither),
    ];
    measured(&measures, Some(true))
}

/// Experts of 8, 10 and 12 s: 10 ± 2 s; of 0.5, 0.75, 1.0: 0.75 ± 0.25; of 3, 4, 5 s: 4 ± 1 s.
fn standards() -> Standards {
    Standards::of(&[
        &of(8.0, 0.5, 3.0),
        &of(10.0, 0.75, 5.0),
        &of(12.0, 1.0, 4.0),
    ])
}

#[test]
fn a_measure_may_be_a_deviation_worse_and_as_much_better_as_it_likes() {
    let standards = standards();
    let spreads: Vec<_> = standards.each.iter().map(|own| own.spread).collect();
    assert_eq!(
        spreads.iter().map(|own| own.mean).collect::<Vec<_>>(),
        [10.0, 0.75, 4.0]
    );
    let deviations = spreads.iter().map(|own| own.standard_deviation.unwrap());
    assert_eq!(deviations.collect::<Vec<_>>(), [2.0, 0.25, 1.0]);
    let judged = |attempt: &Attempt| {
        let judgement = standards.judge(attempt);
        let each = judgement.measures.iter().map(|own| own.proficient.unwrap());
        (each.collect::<Vec<_>>(), judgement.proficient.unwrap())
    };
    assert_eq!(judged(&of(12.0, 0.5, 3.0)), (vec![true; 3], true));
    assert_eq!(judged(&of(1.0, 1.0, 5.0)), (vec![true; 3], true));
    assert_eq!(judged(&of(12.1, 0.4, 2.9)), (vec![false; 3], false));
    assert_eq!(
        judged(&of(10.0, 0.75, 5.1)),
        (vec![true, true, false], false)
    );
}

#[test]
fn what_failed_or_lacks_what_all_experts_do_is_not_proficient() {
    let standards = standards();
    let failed = Attempt {
        passed: Some(false),
        ..of(10.0, 0.75, 4.0)
    };
    assert_eq!(standards.judge(&failed).proficient, Some(false));
    let mut lacking = of(10.0, 0.75, 4.0);
    lacking.measures.pop();
    let judgement = standards.judge(&lacking);
    assert_eq!(judgement.measures[2].value, None);
    assert_eq!(judgement.proficient, Some(false));
    // One expert of two gripped: whoever does not is none the worse.
    let grip = [("time_s", 9.0, Better::Less), ("grip_n", 1.0, Better::Less)];
    let experts = [measured(&grip, None), measured(&grip[..1], None)];
    let standards = Standards::of(&[&experts[0], &experts[1]]);
    assert_eq!(standards.judge(&experts[1]).proficient, Some(true));
}

#[test]
fn one_expert_or_none_tells_nobody_proficient() {
    let alone = of(10.0, 0.75, 4.0);
    for standards in [Standards::of(&[&alone]), Standards::of(&[])] {
        assert_eq!(standards.judge(&alone).proficient, None);
    }
}

#[test]
fn proficiency_takes_several_attempts_in_a_row() {
    assert_eq!(IN_A_ROW, 2);
    let standards = standards();
    let since = |times: &[f64]| {
        let judged = times
            .iter()
            .map(|time| standards.judge(&of(*time, 0.75, 4.0)));
        proficient_since(&judged.collect::<Vec<_>>())
    };
    assert_eq!(since(&[]), None);
    assert_eq!(since(&[11.0]), None);
    assert_eq!(since(&[30.0, 11.0, 20.0, 12.0]), None);
    assert_eq!(since(&[30.0, 11.0, 20.0, 12.0, 9.0, 40.0]), Some(5));
    assert_eq!(since(&[11.0, 11.0]), Some(2));
}

/// Experts of 8, 10 and 15 s miss their own time once in three times: 11 ± 3.6 s.
#[test]
fn nobody_has_to_be_better_than_the_experts() {
    let experts = [of(8.0, 0.5, 3.0), of(10.0, 0.75, 5.0), of(15.0, 1.0, 4.0)];
    let standards = Standards::of(&experts.iter().collect::<Vec<_>>());
    assert!((standards.share.unwrap() - 8.0 / 9.0).abs() < 1e-12);
    let proficient = |attempt: &Attempt| standards.judge(attempt).proficient;
    assert_eq!(proficient(&of(14.0, 0.75, 4.0)), Some(true));
    assert_eq!(proficient(&of(15.0, 0.75, 4.0)), Some(false));
    assert_eq!(standards.each.len(), 3);
}
