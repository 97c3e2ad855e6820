//! The location of the training record, and the conversion of scores for it.

use std::path::{Path, PathBuf};

use palpate_record as record;
use palpate_simulate::performance::{Better, Score};

use crate::failure::Failure;

/// The file of the training record: the named one, or else that of this user.
pub(crate) fn record_file(named: Option<&Path>) -> Result<PathBuf, Failure> {
    if let Some(named) = named {
        return Ok(named.to_owned());
    }
    Ok(super::folder()?.join("training.sqlite"))
}

/// The measures of a score in the form of a record.
pub(super) fn measures(score: &Score) -> Vec<record::Measure> {
    let measures = score.measures().into_iter();
    let stored = measures.map(|own| record::Measure {
        key: own.key,
        value: own.value,
        better: match own.better {
            Better::Less => record::Better::Less,
            Better::More => record::Better::More,
            Better::Neither => record::Better::Neither,
        },
    });
    stored.collect()
}

#[cfg(test)]
mod tests {
    use palpate_files::scene::Task;
    use palpate_files::{Events, SessionRow};
    use palpate_simulate::performance::{self, Standard, compare};

    use super::*;

    /// Two seconds of a hand that goes back and forth and presses at its own pace and strength.
    fn scored(pace: f64, strength: f64) -> Score {
        let task = Task {
            force_limit_n: Some(0.5),
            ..Task::default()
        };
        let rows = (0..=400).map(|step| {
            let time = 0.005 * f64::from(step);
            let press = (pace * time).sin().max(0.0);
            SessionRow {
                time_s: time,
                tool: 0,
                position_m: [
                    0.02 * (pace * time).cos(),
                    0.01 * time * time,
                    -0.002 * press,
                ],
                orientation: [0.0, 0.0, 0.0, 1.0],
                grip: 0.0,
                cut: false,
                force_n: [0.0, 0.0, strength * press],
                torque_nm: [0.0; 3],
                contact: press > 0.0,
                depth_m: 0.002 * press,
                events: Events::default(),
                grip_force_n: 0.0,
                stated_diameter_m: None,
            }
        });
        performance::score(&task, &["left".to_owned()], &rows.collect::<Vec<_>>())
    }

    fn attempt(score: &Score) -> record::Attempt {
        record::Attempt {
            trainee: "Anna".to_owned(),
            task: "Press".to_owned(),
            scene_digest: String::new(),
            when: 0,
            session: PathBuf::from("session"),
            session_digest: String::new(),
            passed: score.outcome.passed(),
            is_expert: false,
            measures: measures(score),
        }
    }

    /// The record judges stored measures as a single session is compared with its experts. Judge: the other code.
    #[test]
    fn the_record_judges_as_a_comparison_does() {
        let experts = [(3.0, 0.4), (4.0, 0.6), (5.0, 0.9)].map(|(pace, force)| scored(pace, force));
        let standards = Standard::of(&experts);
        let attempts = experts.each_ref().map(attempt);
        let stored = record::Standards::of(&attempts.each_ref());
        let (mut met, mut missed) = (0, 0);
        for (pace, force) in [(2.0, 0.3), (4.1, 0.61), (6.0, 0.7), (9.0, 2.0)] {
            let score = scored(pace, force);
            let own = attempt(&score);
            let judgement = stored.judge(&own);
            let compared = compare(&score, &standards);
            assert!(compared.len() > 10);
            for one in compared {
                let place = stored
                    .each
                    .iter()
                    .position(|own| own.key == one.measure.key);
                let place = place.unwrap();
                let judged = judgement.measures[place];
                assert_eq!(judged.value, Some(one.measure.value));
                assert_eq!(judged.proficient, one.proficient, "{}", one.measure.key);
                assert_eq!(stored.each[place].spread.mean, one.standard.mean);
                met += usize::from(one.proficient == Some(true));
                missed += usize::from(one.proficient == Some(false));
            }
        }
        assert!(met > 5 && missed > 5, "{met} met, {missed} missed");
    }

    /// The quantities of the learning curves are among the measures of a score.
    #[test]
    fn time_and_errors_are_measures_of_a_score() {
        use crate::command::progress::{ERRORS, TIME};
        let own = attempt(&scored(3.0, 0.4));
        assert_eq!(own.value(TIME), Some(2.0));
        assert!(ERRORS.iter().all(|key| own.value(key).is_some()));
    }

    #[test]
    fn a_record_that_is_named_is_taken() {
        let named = Path::new("mine.sqlite");
        assert_eq!(record_file(Some(named)).unwrap(), named);
    }
}
