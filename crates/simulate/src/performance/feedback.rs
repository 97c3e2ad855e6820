//! Feedback on an attempt: a verdict, what was good, what to change and what to do next.
//!
//! Each is a [`Phrase`]: a key and its numbers. The window translates it (`assets/texts/*.ftl`).

use palpate_files::scene::{Goal, Task};

use super::{Outcome, Score};

/// A translatable text: its key in a catalogue, and its arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Phrase {
    /// The key.
    pub key: &'static str,
    /// Placeholders and their values.
    pub values: Vec<(&'static str, PhraseValue)>,
}

/// An argument of a phrase.
#[derive(Debug, Clone, PartialEq)]
pub enum PhraseValue {
    /// A whole number, in the unit in the placeholder's name: `mm`, `mn`, `s`, `percent`, or a count.
    Number(f64),
    /// Another phrase.
    Phrase(Phrase),
}

impl Phrase {
    fn plain(key: &'static str) -> Self {
        Self {
            key,
            values: Vec::new(),
        }
    }

    fn filled<const N: usize>(key: &'static str, values: [(&'static str, f64); N]) -> Self {
        let number = |(name, value): (_, f64)| (name, PhraseValue::Number(value.round()));
        Self {
            key,
            values: values.map(number).into(),
        }
    }
}

/// Four phrases on an attempt.
#[derive(Debug, Clone, PartialEq)]
pub struct Feedback {
    /// The verdict: whether it passed, and why not.
    pub verdict: Phrase,
    /// What was good.
    pub good: Phrase,
    /// The one thing to change first.
    pub change: Phrase,
    /// What to do next.
    pub next: Phrase,
}

/// The feedback on an attempt at `task`; `late` if it ended because its time was over.
pub fn feedback(task: &Task, score: &Score, late: bool) -> Feedback {
    let passed = score.outcome.passed();
    let verdict = match (passed, late) {
        (Some(true), _) => Phrase::plain("verdict-passed"),
        (Some(false), true) => Phrase::plain("verdict-late"),
        (Some(false), false) => Phrase {
            key: "verdict-not-passed",
            values: vec![("why", PhraseValue::Phrase(why_not(task, score)))],
        },
        (None, _) => Phrase::plain("verdict-done"),
    };
    Feedback {
        verdict,
        good: good(task, score),
        change: change(task, score),
        next: match passed {
            Some(true) => Phrase::filled("next-repeat", [("s", score.duration.max(1.0))]),
            Some(false) => Phrase::plain("next-retry"),
            None => Phrase::plain("next-choose"),
        },
    }
}

fn why_not(task: &Task, score: &Score) -> Phrase {
    let perforated = score.errors.perforations > 0;
    match &score.outcome {
        Outcome::Find {
            target_distance: None,
            ..
        } => Phrase::plain("why-unmarked"),
        Outcome::Find {
            found: true,
            size: Some(size),
            ..
        } => match size.stated {
            None => Phrase::plain("why-no-diameter"),
            Some(stated) => {
                let values = [("mm", 2e3 * size.truth.radius_m), ("stated", 1e3 * stated)];
                Phrase::filled("why-diameter", values)
            }
        },
        Outcome::Find {
            target_distance: Some(off),
            ..
        } => Phrase::filled("why-far", [("mm", 1e3 * off)]),
        Outcome::Traction {
            torn: Some(force), ..
        } => Phrase::filled("why-torn", [("mn", 1e3 * force)]),
        Outcome::Traction { within, .. } => Phrase::filled("why-short", [("s", *within)]),
        Outcome::Touch {
            torn: Some(force), ..
        } => Phrase::filled("why-held-torn", [("mn", 1e3 * force)]),
        Outcome::Touch {
            injured: Some(force),
            ..
        } => Phrase::filled("why-injured", [("mn", 1e3 * force)]),
        Outcome::Touch {
            target_distance: None,
            ..
        } => Phrase::plain("why-covered"),
        Outcome::Touch { within, .. } if *within > 0.0 => {
            Phrase::filled("why-touched-short", [("s", *within)])
        }
        Outcome::Touch {
            target_distance: Some(off),
            ..
        } => Phrase::filled("why-beside", [("mm", 1e3 * off)]),
        Outcome::Cut { .. } if perforated => Phrase::plain("why-perforated"),
        Outcome::Cut { part, .. } => match off_line(task, score) {
            Some(deviation) => Phrase::filled("why-off-line", [("mm", 1e3 * deviation)]),
            None => Phrase::filled("why-uncut", [("percent", 100.0 * (1.0 - part))]),
        },
        _ => Phrase::plain("why-unknown"),
    }
}

/// Deviation of a cut from its line [m], if it is more than the task allows.
fn off_line(task: &Task, score: &Score) -> Option<f64> {
    let Goal::Cut { tolerance_m, .. } = &task.goal else {
        return None;
    };
    let deviation = score.cut?.along_line?.largest_deviation;
    (deviation > *tolerance_m).then_some(deviation)
}

/// The largest force of any tool [N].
fn peak(score: &Score) -> f64 {
    let peaks = score.forces.iter().map(|force| force.peak);
    peaks.fold(0.0, f64::max)
}

fn good(task: &Task, score: &Score) -> Phrase {
    let gentle = task.force_limit_n.filter(|limit| peak(score) <= *limit);
    match &score.outcome {
        Outcome::Find {
            target_distance: Some(off),
            found: true,
            size,
        } => match size.and_then(|size| Some((size, size.stated?))) {
            Some((size, stated)) if size.is_right() => {
                let truth = 2e3 * size.truth.radius_m;
                let values = [
                    ("mm", 1e3 * off),
                    ("stated", 1e3 * stated),
                    ("truth", truth),
                ];
                Phrase::filled("good-found-size", values)
            }
            _ => Phrase::filled("good-found", [("mm", 1e3 * off)]),
        },
        Outcome::Traction {
            held: true,
            error: Some(error),
            ..
        } => Phrase::filled("good-held", [("mn", 1e3 * error)]),
        Outcome::Touch {
            reached: true,
            within,
            ..
        } => Phrase::filled("good-touched", [("s", *within)]),
        Outcome::Touch {
            target_distance: Some(_),
            torn: None,
            ..
        } if gentle.is_none() => Phrase::plain("good-clear"),
        Outcome::Cut { clean: true, .. } => Phrase::plain("good-cut"),
        Outcome::Cut { part, .. } if *part >= 0.5 => {
            Phrase::filled("good-part", [("percent", 100.0 * part)])
        }
        Outcome::Traction {
            within, torn: None, ..
        } if *within >= 1.0 => Phrase::filled("good-within", [("s", *within)]),
        _ => match gentle {
            Some(limit) => {
                let values = [("mn", 1e3 * limit), ("most", 1e3 * peak(score))];
                Phrase::filled("good-gentle", values)
            }
            None => Phrase::filled("good-worked", [("s", score.duration)]),
        },
    }
}

fn change(task: &Task, score: &Score) -> Phrase {
    let perforated = score.errors.perforations > 0;
    Phrase::plain(match &score.outcome {
        Outcome::Find {
            target_distance: None,
            ..
        } => "change-mark",
        Outcome::Find { found: false, .. } => "change-rows",
        Outcome::Find {
            size: Some(size), ..
        } if !size.is_right() => {
            let stated = size.stated.unwrap_or(0.0);
            match size.truth.error_of(stated) > 0.0 {
                true => "change-smaller",
                false => "change-larger",
            }
        }
        Outcome::Traction { torn: Some(_), .. } => "change-slower",
        Outcome::Traction { held: false, .. } => "change-grasp",
        Outcome::Touch { torn: Some(_), .. } => "change-lift-slower",
        Outcome::Touch {
            injured: Some(_), ..
        } => "change-come-slowly",
        Outcome::Touch {
            target_distance: None,
            ..
        } => "change-lift",
        Outcome::Touch { reached: false, .. } => "change-stay",
        Outcome::Cut { .. } if perforated => "change-shallower",
        Outcome::Cut { clean: false, .. } => match off_line(task, score) {
            Some(_) => "change-line",
            None => "change-uncut",
        },
        _ => return errors(task, score),
    })
}

fn errors(task: &Task, score: &Score) -> Phrase {
    let errors = &score.errors;
    match task.force_limit_n {
        Some(limit) if errors.force_limit > 0 => {
            let values = [("mn", 1e3 * limit), ("count", errors.force_limit as f64)];
            Phrase::filled("change-gentler", values)
        }
        _ if errors.drops > 0 => Phrase::filled("change-drops", [("count", errors.drops as f64)]),
        _ if errors.shaft_contacts > 0 => {
            let count = errors.shaft_contacts as f64;
            Phrase::filled("change-shaft", [("count", count)])
        }
        _ => Phrase::plain("change-nothing"),
    }
}

#[cfg(test)]
mod tests {
    use palpate_files::scene::CutLine;
    use palpate_files::{Events, SessionRow};

    use super::super::Performance;
    use super::*;

    fn feedback_on(goal: Goal, events: Events, force: f64, seconds: u32) -> Feedback {
        let task = Task {
            force_limit_n: Some(0.3),
            goal,
            ..Task::default()
        };
        let mut performance = Performance::new(&task, &["left".to_owned()]);
        for number in 0..=seconds {
            performance.add(&SessionRow {
                time_s: f64::from(number),
                tool: 0,
                position_m: [0.0; 3],
                orientation: [0.0, 0.0, 0.0, 1.0],
                grip: 0.0,
                cut: false,
                force_n: [0.0, force, 0.0],
                torque_nm: [0.0; 3],
                contact: true,
                depth_m: 0.0,
                events: if number == seconds {
                    events
                } else {
                    Events::NONE
                },
                grip_force_n: 0.0,
                stated_diameter_m: None,
            });
        }
        feedback(&task, &performance.score(), false)
    }

    /// Both the verdict and the change name each fault.
    #[test]
    fn what_went_wrong_is_what_is_to_change() {
        use palpate_files::Event;
        let find = |x: f64| Goal::Find {
            target_m: [x, 0.0, 0.0],
            tolerance_m: 0.005,
            size: None,
        };
        let pull = || Goal::Traction {
            tool: None,
            force_n: 0.2,
            tolerance_n: 0.05,
            hold_s: 3.0,
            direction: None,
            tear_force_n: Some(0.5),
        };
        let missed = feedback_on(find(0.02), Event::Mark.into(), 0.1, 1);
        let why = |key, values| Phrase {
            key: "verdict-not-passed",
            values: vec![("why", PhraseValue::Phrase(Phrase { key, values }))],
        };
        let number = |name, value| vec![(name, PhraseValue::Number(value))];
        assert_eq!(missed.verdict, why("why-far", number("mm", 20.0)));
        assert_eq!(missed.change.key, "change-rows");
        let found = feedback_on(find(0.002), Event::Mark.into(), 0.1, 1);
        let keys = [found.verdict.key, found.change.key];
        assert_eq!(keys, ["verdict-passed", "change-nothing"]);
        let hard = feedback_on(find(0.002), Event::Mark.into(), 0.4, 1);
        let values = [number("mn", 300.0), number("count", 1.0)].concat();
        let gentler = Phrase {
            key: "change-gentler",
            values,
        };
        assert_eq!(hard.change, gentler);
        let torn = feedback_on(pull(), Events::NONE, 0.6, 2);
        assert_eq!(torn.verdict, why("why-torn", number("mn", 600.0)));
        assert_eq!(torn.change.key, "change-slower");
        let held = feedback_on(pull(), Events::NONE, 0.2, 4);
        assert_eq!(held.verdict.key, "verdict-passed");
        let short = feedback_on(pull(), Events::NONE, 0.2, 2);
        assert_eq!(short.verdict, why("why-short", number("s", 2.0)));
        let cut = |x: f64| Goal::Cut {
            line: CutLine::straight([x, 0.0, 0.0], [x, 0.03, 0.0]),
            tolerance_m: 0.002,
            layers: None,
        };
        let aside = feedback_on(cut(0.01), Event::Cut.into(), 0.1, 1);
        assert_eq!(aside.verdict, why("why-off-line", number("mm", 10.0)));
        assert_eq!(aside.change.key, "change-line");
        let begun = feedback_on(cut(0.001), Event::Cut.into(), 0.1, 1);
        assert_eq!(begun.verdict, why("why-uncut", number("percent", 100.0)));
        assert_eq!(begun.change.key, "change-uncut");
    }
}
