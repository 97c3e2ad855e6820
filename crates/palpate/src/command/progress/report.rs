//! `--report`: trainees' progress as a page for people.

use super::curves::{self, TRAINEES};
use super::learning_curves::{JudgedAttempt, LearningCurve, Trainee};
use super::table::{NONE, proficient, shown, standing, truth, valued};
use crate::date;
use crate::report::{Markup, Page, Table, count, figure, provenance, quantity, warning_list};

/// Trainees whose latest attempts a table compares, at most.
const COLUMNS: usize = 8;

/// The page on `courses`; `settings` are the options of the command: names and values.
pub(super) fn html(
    courses: &[LearningCurve<'_>],
    warnings: &[String],
    settings: &[(String, String)],
) -> String {
    let attempts: usize = courses.iter().map(LearningCurve::attempts).sum();
    let title = match courses {
        [only] => only.task.to_owned(),
        _ => "Training".to_owned(),
    };
    let lead = format!(
        "{} at {}, compared with experts.",
        count(attempts, "attempt"),
        count(courses.len(), "task")
    );
    let several = courses.len() > 1;
    let each = courses.iter().map(|course| section(course, several));
    let nothing = provenance(settings, std::iter::empty());
    Page {
        title,
        summary: Markup::of_class("p", "lead", lead),
        body: warning_list("Warnings", warnings).and(each.collect::<Markup>()),
        footer: nothing.and(Markup::plain("p", super::rule() + CONVENTIONS)),
    }
    .html()
}

/// Conventions for all numbers.
const CONVENTIONS: &str = " Deviations are standard deviations of one session. Errors are forces above the limit, \
perforations, drops, contacts of a shaft and cuts that were taken back. Dates are in universal time.";

/// The section on one task, with its title if it is one of `several`.
fn section(course: &LearningCurve<'_>, several: bool) -> Markup {
    let title = match several {
        true => Markup::plain("h2", course.task),
        false => Markup::default(),
    };
    let inside = title
        .and(cards(course))
        .and(figures(course))
        .and(attempts(course))
        .and(comparison(course));
    Markup::plain("section", inside)
}

fn cards(course: &LearningCurve<'_>) -> Markup {
    let trainees = course.trainees.len();
    let proficient = course.trainees.iter();
    let proficient = proficient.filter(|own| own.proficient_since.is_some());
    let proficient = match course.experts.len() {
        0 | 1 => NONE.to_owned(),
        _ => format!("{} of {trainees}", proficient.count()),
    };
    let all = [
        ("Trainees", trainees.to_string()),
        ("Attempts", course.attempts().to_string()),
        ("Sessions of experts", course.experts.len().to_string()),
        ("Proficient trainees", proficient),
    ];
    let each = all.into_iter().map(|(name, value)| {
        Markup::plain(
            "div",
            Markup::plain("dt", name).and(Markup::plain("dd", value)),
        )
    });
    Markup::of_class("dl", "cards", each.collect::<Markup>())
}

fn figures(course: &LearningCurve<'_>) -> Markup {
    let trainees = course.trainees.len();
    let mut caption = match trainees {
        1 => "Attempt by attempt.".to_owned(),
        _ => "The mean over those who made that many attempts, with its standard deviation; thin lines are single \
              trainees."
            .to_owned(),
    };
    if trainees > TRAINEES {
        caption += &format!(" Of {trainees} trainees the first {TRAINEES} are drawn.");
    }
    let plots = curves::plots(course).into_iter();
    let drawn = plots.map(|plot| {
        let experts = match plot.bands.len() > usize::from(trainees > 1) {
            true => " Dashed: the experts' mean, with their standard deviation.",
            false => "",
        };
        figure(&plot, format!("{caption}{experts}"))
    });
    Markup::of_class("div", "figures", drawn.collect::<Markup>())
}

fn attempts(course: &LearningCurve<'_>) -> Markup {
    let head = [
        "trainee",
        "attempt",
        "date",
        "time [s]",
        "errors",
        "passed",
        "proficient",
        "measures",
    ];
    let mut table = Table::new(head);
    for trainee in &course.trainees {
        for (number, own) in (1..).zip(&trainee.attempts) {
            let row = row(trainee, number, own);
            match own.judgement.proficient {
                Some(true) => table.marked_row(row),
                _ => table.row(row),
            }
        }
    }
    if table.is_empty() {
        return Markup::default();
    }
    let standing = course.trainees.iter();
    let standing = standing.map(|own| format!("{}: {}", own.name, standing_of(course, own)));
    let standing = standing.map(|said| Markup::plain("li", said));
    Markup::plain("h3", "Attempts")
        .and(Markup::plain("ul", standing.collect::<Markup>()))
        .and(table)
}

fn standing_of(course: &LearningCurve<'_>, trainee: &Trainee<'_>) -> String {
    let attempts = count(trainee.attempts.len(), "attempt");
    match course.experts.len() {
        0 | 1 => attempts,
        _ => format!("{attempts}, {}", standing(trainee)),
    }
}

fn row(trainee: &Trainee<'_>, number: usize, own: &JudgedAttempt<'_>) -> Vec<Markup> {
    vec![
        trainee.name.into(),
        number.to_string().into(),
        date::short(own.attempt.when).into(),
        shown(own.time()).into(),
        shown(own.errors()).into(),
        truth(own.attempt.passed).into(),
        truth(own.judgement.proficient).into(),
        proficient(own).into(),
    ]
}

/// The latest attempts compared with the experts, measure by measure.
fn comparison(course: &LearningCurve<'_>) -> Markup {
    let trainees = course.trainees.iter().take(COLUMNS);
    let last: Vec<_> = trainees
        .filter_map(|own| Some((own, own.attempts.last()?)))
        .collect();
    if last.is_empty() || course.standards.each.is_empty() {
        return Markup::default();
    }
    let head = ["measure".to_owned(), "experts".to_owned()].into_iter();
    let names = last
        .iter()
        .map(|(own, _)| format!("{}, attempt {}", own.name, own.attempts.len()));
    let mut table = Table::new(head.chain(names));
    for (place, standard) in course.standards.each.iter().enumerate() {
        let (key, spread) = (&standard.key, standard.spread);
        let experts = quantity(key, spread.mean, spread.standard_deviation);
        let mut row = vec![Markup::plain("code", &**key), experts.into()];
        row.extend(last.iter().map(|(_, own)| {
            let judged = own.judgement.measures[place];
            let mark = match judged.proficient {
                Some(true) => "✓ ",
                Some(false) => "✗ ",
                None => "",
            };
            (mark.to_owned() + &valued(key, judged.value)).into()
        }));
        table.row(row);
    }
    let mut note = "✓ proficient, ✗ not proficient.".to_owned();
    if course.trainees.len() > COLUMNS {
        let trainees = course.trainees.len();
        note += &format!(" Of {trainees} trainees the first {COLUMNS} are shown; `--csv` has all.");
    }
    Markup::plain("h3", "Latest attempts compared with the experts")
        .and(Markup::of_class("p", "muted", note))
        .and(table)
}
