//! Attempts and learning curves for one task, trainee by trainee.

use crate::training::VARIANT;
use palpate_record::{
    Attempt, CurvePoint, Judgement, Spread, Standards, learning_curve, proficient_since,
};

/// The measure that is the operation time [s].
pub(crate) const TIME: &str = "time_s";

/// The measures that count errors.
pub(crate) const ERRORS: [&str; 5] = [
    "force_limit_errors",
    "perforations",
    "drops",
    "shaft_contacts",
    "undone_cuts",
];

/// A task, and all attempts at it.
#[derive(Debug)]
pub(super) struct LearningCurve<'r> {
    pub(super) task: &'r str,
    /// By name.
    pub(super) trainees: Vec<Trainee<'r>>,
    pub(super) experts: Vec<&'r Attempt>,
    pub(super) standards: Standards,
    /// How many different scenes there are.
    pub(super) scenes: usize,
}

/// A trainee, and their attempts at a task in the order of time.
#[derive(Debug)]
pub(super) struct Trainee<'r> {
    pub(super) name: &'r str,
    pub(super) attempts: Vec<JudgedAttempt<'r>>,
    /// The attempt with which they became proficient, counted from one.
    pub(super) proficient_since: Option<usize>,
}

/// An attempt compared with the experts' standards.
#[derive(Debug)]
pub(super) struct JudgedAttempt<'r> {
    pub(super) attempt: &'r Attempt,
    pub(super) judgement: Judgement,
}

/// The quantities of learning curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CurveQuantity {
    /// Operation time [s].
    Time,
    /// Number of errors.
    Errors,
    /// The part of the measures that is proficient [%].
    ProficientPart,
}

impl<'r> LearningCurve<'r> {
    /// Learning curves of all tasks in alphabetical order, of one trainee alone if `only` names them. With `only`, a
    /// task without an attempt of that trainee is left out.
    pub(super) fn all(attempts: &'r [Attempt], only: Option<&str>) -> Vec<Self> {
        let tasks = distinct(attempts.iter().map(|own| own.task.as_str()));
        let courses = tasks.into_iter().map(|task| Self::of(task, attempts, only));
        courses
            .filter(|course| only.is_none() || !course.trainees.is_empty())
            .collect()
    }

    fn of(task: &'r str, attempts: &'r [Attempt], only: Option<&str>) -> Self {
        let own = || attempts.iter().filter(|attempt| attempt.task == task);
        let experts: Vec<&Attempt> = own().filter(|attempt| attempt.is_expert).collect();
        let standards = Standards::of(&experts);
        let is_wanted = |own: &&Attempt| only.is_none_or(|only| only == own.trainee);
        // An expert's attempt also belongs to its trainee. An expert without other attempts is no trainee.
        let trains = |attempt: &&Attempt| {
            !attempt.is_expert
                || own().any(|other| !other.is_expert && other.trainee == attempt.trainee)
        };
        let made = || own().filter(trains).filter(is_wanted);
        let names = distinct(made().map(|own| own.trainee.as_str()));
        let trainees = names.into_iter().map(|name| {
            let own = made().filter(|own| own.trainee == name);
            let own = own.map(|attempt| JudgedAttempt {
                judgement: standards.judge(attempt),
                attempt,
            });
            let attempts: Vec<JudgedAttempt<'_>> = own.collect();
            let judgements: Vec<Judgement> =
                attempts.iter().map(|own| own.judgement.clone()).collect();
            Trainee {
                name,
                proficient_since: proficient_since(&judgements),
                attempts,
            }
        });
        Self {
            task,
            trainees: trainees.collect(),
            // Variants of a task are meant to differ.
            scenes: distinct(
                own()
                    .map(|own| own.scene_digest.as_str())
                    .filter(|digest| !digest.contains(VARIANT)),
            )
            .len(),
            experts,
            standards,
        }
    }

    /// The number of attempts of trainees.
    pub(super) fn attempts(&self) -> usize {
        self.trainees.iter().map(|own| own.attempts.len()).sum()
    }

    /// A quantity from attempt to attempt, over trainees.
    pub(super) fn curve(&self, of: CurveQuantity) -> Vec<CurvePoint> {
        let each = self.trainees.iter();
        let each = each.map(|own| own.attempts.iter().map(|own| own.quantity(of)).collect());
        learning_curve(&each.collect::<Vec<_>>())
    }

    /// A quantity over the experts' attempts.
    pub(super) fn of_experts(&self, of: CurveQuantity) -> Option<Spread> {
        let judged = self.experts.iter().map(|attempt| JudgedAttempt {
            judgement: self.standards.judge(attempt),
            attempt,
        });
        Spread::of(
            &judged
                .filter_map(|own| own.quantity(of))
                .collect::<Vec<_>>(),
        )
    }

    /// Warnings.
    pub(super) fn warnings(&self) -> Vec<String> {
        let task = self.task;
        let mut warnings = Vec::new();
        match self.experts.len() {
            0 => warnings.push(format!(
                "no session of an expert at `{task}` is recorded, so proficiency cannot be judged; record two or more"
            )),
            1 => warnings.push(format!(
                "one session of an expert at `{task}` gives no deviation, so proficiency cannot be judged; record another"
            )),
            _ => {}
        }
        if self.scenes > 1 {
            warnings.push(format!(
                "`{task}` was attempted in {} different scenes; their numbers may not compare",
                self.scenes
            ));
        }
        warnings
    }
}

impl JudgedAttempt<'_> {
    /// A quantity of a learning curve, if it is known.
    pub(super) fn quantity(&self, of: CurveQuantity) -> Option<f64> {
        match of {
            CurveQuantity::Time => self.time(),
            CurveQuantity::Errors => self.errors(),
            CurveQuantity::ProficientPart => {
                let (proficient, judged) = self.proficient();
                (judged > 0).then(|| 100.0 * proficient as f64 / judged as f64)
            }
        }
    }

    /// Operation time [s].
    pub(super) fn time(&self) -> Option<f64> {
        self.attempt.value(TIME)
    }

    /// Number of errors.
    pub(super) fn errors(&self) -> Option<f64> {
        let counts = ERRORS.iter().filter_map(|key| self.attempt.value(key));
        counts.reduce(|sum, count| sum + count)
    }

    /// How many measures are proficient, and how many can be judged.
    pub(super) fn proficient(&self) -> (usize, usize) {
        let judged = || {
            self.judgement
                .measures
                .iter()
                .filter_map(|own| own.proficient)
        };
        (judged().filter(|is| *is).count(), judged().count())
    }

    /// Whether a measure of it is proficient; none where that cannot be judged.
    pub(super) fn judged(&self, course: &LearningCurve<'_>, key: &str) -> Option<bool> {
        let mut standards = course.standards.each.iter();
        let place = standards.position(|own| own.key == key)?;
        self.judgement.measures.get(place)?.proficient
    }
}

/// Each once, in alphabetical order.
fn distinct<'n>(names: impl Iterator<Item = &'n str>) -> Vec<&'n str> {
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    names.dedup();
    names
}
