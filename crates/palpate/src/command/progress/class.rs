//! Data of the window's teacher page: the numbers of `palpate progress` and `palpate teacher show`.

use std::collections::BTreeSet;

use palpate_record::{Attempt, Filter, Record};
use palpate_viewer::training::{
    AssignedTask, Class, StandingWord, TaskProgress, TraineeProgress, TraineeStanding,
};

use super::learning_curves::{CurveQuantity, LearningCurve};
use crate::command::teacher;
use crate::date;
use crate::failure::Failure;

/// All trainees of a record.
pub(crate) fn class(record: &Record) -> Result<Class, Failure> {
    let attempts = record.attempts(&Filter::default())?;
    let courses = LearningCurve::all(&attempts, None);
    Ok(Class {
        assignees: assignees(record, &attempts)?,
        assignments: assignments(record)?,
        tasks: courses.iter().map(task).collect(),
    })
}

/// Cohorts, and then trainees who have no cohort of their own name.
fn assignees(record: &Record, attempts: &[Attempt]) -> Result<Vec<String>, Failure> {
    let cohorts = record.cohorts()?;
    let mut all: Vec<String> = cohorts.iter().map(|own| own.name.clone()).collect();
    let members = cohorts.into_iter().flat_map(|own| own.trainees);
    let trainees = attempts.iter().map(|own| own.trainee.clone());
    let trainees: BTreeSet<String> = members.chain(trainees).collect();
    let others = trainees.into_iter().filter(|name| !all.contains(name));
    all.extend(others.collect::<Vec<_>>());
    Ok(all)
}

fn assignments(record: &Record) -> Result<Vec<AssignedTask>, Failure> {
    let given = teacher::standings(record)?.into_iter();
    let assigned = given.map(|own| AssignedTask {
        due: date::short(own.due_unix_s),
        cohort: own.cohort,
        task: own.task,
        passes: own.passes,
        trainees: own
            .trainees
            .into_iter()
            .map(|own| TraineeStanding {
                trainee: own.trainee,
                attempts: own.attempts,
                passed: own.passed,
                standing: match own.standing {
                    "done" => StandingWord::Done,
                    "open" => StandingWord::Open,
                    _ => StandingWord::Late,
                },
            })
            .collect(),
    });
    Ok(assigned.collect())
}

fn task(course: &LearningCurve<'_>) -> TaskProgress {
    let curve = course.curve(CurveQuantity::Time);
    let mean = curve
        .iter()
        .map(|own| [own.attempt as f64, own.spread.mean]);
    let trainees = course.trainees.iter().map(|own| {
        let passed = own.attempts.iter();
        let passed = passed.filter(|own| own.attempt.passed == Some(true));
        let numbered = (1..).zip(&own.attempts);
        let times = numbered.filter_map(|(number, own)| Some([f64::from(number), own.time()?]));
        TraineeProgress {
            trainee: own.name.to_owned(),
            attempts: own.attempts.len(),
            passed: passed.count(),
            proficient_since: own.proficient_since,
            times: times.collect(),
        }
    });
    TaskProgress {
        task: course.task.to_owned(),
        trainees: trainees.collect(),
        mean_times: mean.collect(),
        expert_time: course.of_experts(CurveQuantity::Time).map(|own| own.mean),
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use palpate_record::{Assignment, Attempt, Better, Measure};

    use super::super::answer::Answer;
    use super::*;

    fn attempt(trainee: &str, when: i64, time: f64) -> Attempt {
        Attempt {
            trainee: trainee.to_owned(),
            task: "Cut".to_owned(),
            scene_digest: "ab".to_owned(),
            when: 1_000_000_000 + 60 * when,
            session: PathBuf::from("session"),
            session_digest: format!("{trainee}-{when}"),
            passed: Some(time < 25.0),
            is_expert: trainee == "Expert",
            measures: vec![Measure {
                key: super::super::TIME.to_owned(),
                value: time,
                better: Better::Less,
            }],
        }
    }

    /// Judge: what `palpate progress --json` prints of the same record, and the times as they were put in.
    #[test]
    fn the_window_and_progress_agree() {
        let folder = tempfile::tempdir().unwrap();
        let mut record = Record::open(folder.path().join("training.sqlite")).unwrap();
        let all = [
            ("Expert", 0, 8.0),
            ("Expert", 1, 12.0),
            ("Anna", 2, 40.0),
            ("Anna", 4, 20.0),
            ("Bela", 3, 30.0),
        ];
        for (trainee, when, time) in all {
            record.add(&attempt(trainee, when, time)).unwrap();
        }
        record
            .join("spring", &["Anna".to_owned(), "Bela".to_owned()])
            .unwrap();
        record
            .assign(&Assignment {
                cohort: "spring".to_owned(),
                task: "Cut".to_owned(),
                due: 1_000_100_000,
                passes: 1,
            })
            .unwrap();
        let class = class(&record).unwrap();
        let [cut] = class.tasks.as_slice() else {
            panic!("{class:?}")
        };
        assert_eq!(cut.mean_times, [[1.0, 35.0], [2.0, 20.0]]);
        assert_eq!(cut.expert_time, Some(10.0));
        let attempts = record.attempts(&Filter::default()).unwrap();
        let courses = LearningCurve::all(&attempts, None);
        let printed = serde_json::to_value(Answer::new(record.path(), &courses)).unwrap();
        let printed = &printed["tasks"][0];
        let curve = printed["learning_curve"]["time_s"]["trainees"].as_array();
        for (own, printed) in cut.mean_times.iter().zip(curve.unwrap()) {
            assert_eq!(printed["attempt"].as_f64(), Some(own[0]));
            assert_eq!(printed["mean"].as_f64(), Some(own[1]));
        }
        let trainees = printed["trainees"].as_array().unwrap();
        assert_eq!(trainees.len(), cut.trainees.len());
        for (own, printed) in cut.trainees.iter().zip(trainees) {
            assert_eq!(printed["trainee"].as_str(), Some(own.trainee.as_str()));
            let since = printed["proficient_since_attempt"].as_u64();
            assert_eq!(since, own.proficient_since.map(|own| own as u64));
            let attempts = printed["attempts"].as_array().unwrap();
            let times = attempts.iter().map(|own| own["time_s"].as_f64().unwrap());
            let shown = own.times.iter().map(|own| own[1]);
            assert_eq!(times.collect::<Vec<_>>(), shown.collect::<Vec<_>>());
        }
        let [given] = class.assignments.as_slice() else {
            panic!("{class:?}")
        };
        let standings = given.trainees.iter().map(|own| (own.passed, own.standing));
        assert_eq!(
            standings.collect::<Vec<_>>(),
            [(1, StandingWord::Done), (0, StandingWord::Late)]
        );
    }
}
