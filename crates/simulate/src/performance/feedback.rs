//! What a trainee is told of an attempt: a verdict, and what was good, what to change and what to do next.

use palpate_files::scene::{Goal, Task};

use super::{Outcome, Score, SizeOutcome};

/// Four sentences on an attempt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feedback {
    /// Whether it was passed, and why not.
    pub verdict: String,
    /// What was good.
    pub good: String,
    /// The one thing to change first.
    pub change: String,
    /// What to do next.
    pub next: String,
}

fn millimetres(length: f64) -> String {
    format!("{:.0} mm", 1e3 * length)
}

fn millinewtons(force: f64) -> String {
    format!("{:.0} mN", 1e3 * force)
}

/// What is told of an attempt at `task`, which ended because its time was over if `late`.
pub fn feedback(task: &Task, score: &Score, late: bool) -> Feedback {
    let passed = score.outcome.passed();
    let why = why_not(task, score);
    let verdict = match (passed, late) {
        (Some(true), _) => "Passed".to_owned(),
        (Some(false), true) => "Not passed: the time was over".to_owned(),
        (Some(false), false) => format!("Not passed: {why}"),
        (None, _) => "Done".to_owned(),
    };
    Feedback {
        verdict,
        good: good(task, score),
        change: change(task, score),
        next: match passed {
            Some(true) => format!(
                "Next: repeat it, with other numbers, in less than {:.0} s and without errors.",
                score.duration.max(1.0)
            ),
            Some(false) => {
                "Next: watch the demonstration if the way is not clear, then try again.".to_owned()
            }
            None => "Next: choose a task.".to_owned(),
        },
    }
}

fn why_not(task: &Task, score: &Score) -> String {
    let perforated = score.errors.perforations > 0;
    match (&score.outcome, &task.goal) {
        (Outcome::Find { beside: None, .. }, _) => "no place was marked".to_owned(),
        (
            Outcome::Find {
                found: true,
                size: Some(size),
                ..
            },
            _,
        ) => match size.stated {
            None => "no diameter was stated".to_owned(),
            Some(stated) => format!(
                "the diameter is {}, not {}",
                millimetres(2.0 * size.truth.radius_m),
                millimetres(stated)
            ),
        },
        (
            Outcome::Find {
                beside: Some(off), ..
            },
            _,
        ) => {
            format!("the mark is {} from the lump", millimetres(*off))
        }
        (
            Outcome::Traction {
                torn: Some(force), ..
            },
            _,
        ) => {
            format!("the tissue tore under {}", millinewtons(*force))
        }
        (Outcome::Traction { within, .. }, _) => {
            format!("the pull was right for {within:.0} s only")
        }
        (
            Outcome::Touch {
                torn: Some(force), ..
            },
            _,
        ) => format!("the held tissue tore under {}", millinewtons(*force)),
        (
            Outcome::Touch {
                injured: Some(force),
                ..
            },
            _,
        ) => format!("the target is injured, by {}", millinewtons(*force)),
        (Outcome::Touch { beside: None, .. }, _) => {
            "the organ was not held out of the way".to_owned()
        }
        (Outcome::Touch { within, .. }, _) if *within > 0.0 => {
            format!("the target was touched for {within:.1} s only")
        }
        (
            Outcome::Touch {
                beside: Some(off), ..
            },
            _,
        ) => format!("the tip stayed {} from the target", millimetres(*off)),
        (Outcome::Cut { .. }, _) if perforated => "the mucosa is perforated".to_owned(),
        (Outcome::Cut { part, .. }, Goal::Cut { tolerance_m, .. }) => {
            let line = score.cut.and_then(|cut| cut.along_line);
            match line {
                Some(line) if line.largest_deviation > *tolerance_m => {
                    format!(
                        "the cut is {} from the line",
                        millimetres(line.largest_deviation)
                    )
                }
                _ => format!("{:.0} % of the line is not cut", 100.0 * (1.0 - part)),
            }
        }
        _ => String::new(),
    }
}

/// The largest force of any tool [N].
fn peak(score: &Score) -> f64 {
    let peaks = score.forces.iter().map(|force| force.peak);
    peaks.fold(0.0, f64::max)
}

fn good(task: &Task, score: &Score) -> String {
    let gentle = task.force_limit_n.filter(|limit| peak(score) <= *limit);
    match (&score.outcome, gentle) {
        (
            Outcome::Find {
                beside: Some(off),
                found: true,
                size,
            },
            _,
        ) => {
            format!(
                "Good: you found the lump, {} from its middle{}.",
                millimetres(*off),
                size.map_or(String::new(), |size| size_words(&size))
            )
        }
        (
            Outcome::Traction {
                held: true,
                error: Some(error),
                ..
            },
            _,
        ) => {
            format!(
                "Good: you held the pull, {} off on average.",
                millinewtons(*error)
            )
        }
        (
            Outcome::Touch {
                reached: true,
                within,
                ..
            },
            _,
        ) => format!(
            "Good: you held the organ out of the way and touched the target for {within:.0} s."
        ),
        (
            Outcome::Touch {
                beside: Some(_),
                torn: None,
                ..
            },
            None,
        ) => "Good: the organ was out of the way of your tool.".to_owned(),
        (Outcome::Cut { clean: true, .. }, _) => {
            "Good: the whole line is cut, and the mucosa is whole.".to_owned()
        }
        (Outcome::Cut { part, .. }, _) if *part >= 0.5 => {
            format!(
                "Good: {:.0} % of the line is cut to its depth.",
                100.0 * part
            )
        }
        (
            Outcome::Traction {
                within, torn: None, ..
            },
            _,
        ) if *within >= 1.0 => {
            format!("Good: the pull was right for {within:.0} s.")
        }
        (_, Some(limit)) => format!(
            "Good: you stayed below {}, with {} at most.",
            millinewtons(limit),
            millinewtons(peak(score))
        ),
        _ => format!("Good: you worked for {:.0} s.", score.duration),
    }
}

/// How near a stated diameter is.
fn size_words(size: &SizeOutcome) -> String {
    let truth = millimetres(2.0 * size.truth.radius_m);
    match size.stated {
        Some(stated) if size.is_right() => format!(
            ", and stated {} for its diameter of {truth}",
            millimetres(stated)
        ),
        _ => String::new(),
    }
}

fn change(task: &Task, score: &Score) -> String {
    let perforated = score.errors.perforations > 0;
    let first = match (&score.outcome, &task.goal) {
        (Outcome::Find { beside: None, .. }, _) => {
            "press, and mark with Enter while you press".to_owned()
        }
        (Outcome::Find { found: false, .. }, _) => {
            "press to the same depth everywhere, in rows 15 mm apart, and compare the forces"
                .to_owned()
        }
        (
            Outcome::Find {
                size: Some(size), ..
            },
            _,
        ) if !size.is_right() => {
            let stated = size.stated.unwrap_or(0.0);
            match size.truth.error_of(stated) > 0.0 {
                true => "state a smaller diameter for such a rise of the force".to_owned(),
                false => {
                    "state a larger diameter for such a rise of the force over the lump".to_owned()
                }
            }
        }
        (Outcome::Traction { torn: Some(_), .. }, _) => {
            "pull more slowly: tissue keeps yielding, and a fast pull overshoots".to_owned()
        }
        (Outcome::Traction { held: false, .. }, _) => {
            "grasp first, then pull until the cue says hold, and stay there".to_owned()
        }
        (Outcome::Touch { torn: Some(_), .. }, _) => {
            "lift more slowly and less far, and grasp nearer to what is in the way".to_owned()
        }
        (
            Outcome::Touch {
                injured: Some(_), ..
            },
            _,
        ) => "come slowly for the last millimetres, and stop at the first force".to_owned(),
        (Outcome::Touch { beside: None, .. }, _) => {
            "grasp the rim of the organ over the target, and lift it until neither tip nor shaft of \
             the other tool touches the organ"
                .to_owned()
        }
        (Outcome::Touch { reached: false, .. }, _) => {
            "keep the organ lifted, and stay on the target until its time is over".to_owned()
        }
        (Outcome::Cut { .. }, _) if perforated => {
            "lower the blade less deep, and do not press on what is bare".to_owned()
        }
        (Outcome::Cut { clean: false, part }, Goal::Cut { .. }) if *part < 0.97 => {
            "cut what still shines on the organ, to its full depth".to_owned()
        }
        (Outcome::Cut { clean: false, .. }, _) => "stay on the line".to_owned(),
        _ => match errors(task, score) {
            Some(error) => error,
            None => return "Change: nothing; there was no error.".to_owned(),
        },
    };
    format!("Change: {first}.")
}

fn errors(task: &Task, score: &Score) -> Option<String> {
    let errors = &score.errors;
    let times = |count: u64| match count {
        1 => "once".to_owned(),
        count => format!("{count} times"),
    };
    match task.force_limit_n {
        Some(limit) if errors.force_limit > 0 => {
            return Some(format!(
                "press more gently: the force rose above {} {}",
                millinewtons(limit),
                times(errors.force_limit)
            ));
        }
        _ => {}
    }
    if errors.drops > 0 {
        return Some(format!(
            "pull less on what you hold: it slipped {}",
            times(errors.drops)
        ));
    }
    (errors.shaft_contacts > 0).then(|| {
        format!(
            "keep the shaft off the organ: it touched {}",
            times(errors.shaft_contacts)
        )
    })
}

#[cfg(test)]
mod tests {
    use palpate_files::{Events, SessionRow};

    use super::super::Performance;
    use super::*;

    fn told(goal: Goal, events: Events, force: f64, seconds: u32) -> Feedback {
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

    /// Each fault is named, in the verdict and in what to change.
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
        let missed = told(find(0.02), Event::Mark.into(), 0.1, 1);
        assert_eq!(
            missed.verdict,
            "Not passed: the mark is 20 mm from the lump"
        );
        assert!(missed.change.contains("same depth"));
        let found = told(find(0.002), Event::Mark.into(), 0.1, 1);
        assert_eq!(
            (found.verdict.as_str(), found.change.as_str()),
            ("Passed", "Change: nothing; there was no error.")
        );
        let hard = told(find(0.002), Event::Mark.into(), 0.4, 1);
        assert!(hard.change.contains("above 300 mN once"), "{hard:?}");
        let torn = told(pull(), Events::NONE, 0.6, 2);
        assert!(
            torn.verdict.contains("tore under 600 mN") && torn.change.contains("slowly"),
            "{torn:?}"
        );
        let held = told(pull(), Events::NONE, 0.2, 4);
        assert_eq!(held.verdict, "Passed");
        let short = told(pull(), Events::NONE, 0.2, 2);
        assert_eq!(short.verdict, "Not passed: the pull was right for 2 s only");
    }
}
