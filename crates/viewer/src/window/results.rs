//! Result of an attempt: a verdict, advice, one plot; the rest is folded.

use eframe::egui::accesskit::Role;
use eframe::egui::{self, RichText, Ui};
use egui_plot::{HLine, Line, PlotPoints, uniform_grid_spacer};
use palpate_files::scene::Goal;
use palpate_simulate::performance::{Measure, feedback};

use super::attempt::{Attempt, Done};
use super::cards::{AttemptAction, CardContext, show_error, tasks_button, title};
use super::home::{passed_words, time_and_errors};
use super::page::{self, main_button, or_key, quiet};
use super::texts::{decimal, phrase, text, tool_name, translate_if_known};
use crate::style::{DEPTH, FORCE, QUIET, WARNING, WHITE};

/// Shows the result.
pub(super) fn over(
    ui: &mut Ui,
    attempt: &Attempt,
    done: &Done,
    around: &CardContext,
    asked: &mut Option<AttemptAction>,
) {
    let feedback = feedback(&attempt.task, &done.score, done.late);
    let color = match done.score.outcome.passed() {
        Some(true) => DEPTH,
        Some(false) => WARNING,
        None => QUIET,
    };
    ui.label(RichText::new(title(attempt)).color(QUIET));
    ui.label(
        RichText::new(phrase(&feedback.verdict))
            .size(22.0)
            .strong()
            .color(color),
    );
    ui.add_space(4.0);
    for sentence in [&feedback.good, &feedback.change, &feedback.next] {
        ui.label(RichText::new(phrase(sentence)).size(15.0).color(WHITE));
    }
    ui.add_space(6.0);
    forces(ui, attempt);
    earlier(ui, done);
    let most = (ui.ctx().content_rect().height() - 520.0).max(90.0);
    egui::CollapsingHeader::new(text!("result-measures")).show(ui, |ui| {
        egui::ScrollArea::vertical()
            .max_height(most)
            .show(ui, |ui| measures(ui, done));
    });
    if let Some(folder) = &done.folder {
        let words = text!("result-recorded-in", folder = folder.display().to_string());
        ui.label(quiet(words).small());
    }
    show_error(ui, attempt);
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        let retry = main_button(ui, &text!("result-retry"));
        if retry.on_hover_text(or_key("Enter")).clicked() {
            *asked = Some(AttemptAction::Begin);
        }
        if done.folder.is_some() && ui.button(text!("common-replay")).clicked() {
            *asked = Some(AttemptAction::Replay);
        }
        tasks_button(ui, around, asked);
    });
    if done.folder.is_some() && attempt.task.goal != Goal::Free {
        ui.add_space(4.0);
        match around.comparing {
            Some(part) => {
                let percent = (100.0 * part).round();
                ui.label(quiet(text!("result-computing", percent = percent)));
            }
            None => {
                if ui.button(text!("result-compare")).clicked() {
                    *asked = Some(AttemptAction::Compare);
                }
            }
        }
    }
}

/// The force over time, versus its band or its limit.
fn forces(ui: &mut Ui, attempt: &Attempt) {
    let lines: Vec<f64> = match &attempt.task.goal {
        Goal::Traction {
            force_n,
            tolerance_n,
            ..
        } => vec![force_n - tolerance_n, force_n + tolerance_n],
        Goal::Touch(touch) => attempt
            .task
            .force_limit_n
            .or(touch.tear_force_n)
            .into_iter()
            .collect(),
        _ => attempt.task.force_limit_n.into_iter().collect(),
    };
    let words = text!(match lines.len() {
        0 => "result-force",
        1 => "result-force-limit",
        _ => "result-force-band",
    });
    ui.label(quiet(&words).small());
    let points = attempt.forces.iter();
    let points: Vec<[f64; 2]> = points.map(|[time, force]| [*time, 1e3 * force]).collect();
    let most = points
        .iter()
        .fold(0.0, |most: f64, [_, force]| most.max(*force));
    let top = lines.iter().fold(most, |top, line| top.max(1e3 * line));
    let step = label_step(top);
    let plot = page::still_plot("forces", 110.0).y_grid_spacer(uniform_grid_spacer(move |_| {
        [step, 10.0 * step, 100.0 * step]
    }));
    let plot = plot.show(ui, |plot| {
        plot.line(Line::new("force", PlotPoints::from(points)).color(FORCE));
        for line in lines {
            plot.hline(HLine::new("band", 1e3 * line).color(DEPTH).width(2.0));
        }
    });
    let words = text!("result-force-most", plot = words, mn = most.round());
    page::name(&plot.response, Role::Image, &words);
}

/// The largest of 1, 2 and 5 times a power of ten of which two are at most `top`: a low plot has room for a few labels.
fn label_step(top: f64) -> f64 {
    let half = 0.5 * top.max(1.0);
    let power = 10_f64.powf(half.log10().floor());
    let steps = [5.0, 2.0].map(|times| times * power);
    steps
        .into_iter()
        .find(|step| *step <= half)
        .unwrap_or(power)
}

/// The last attempts of the same trainee.
const EARLIER: usize = 4;

/// One's own attempts before.
fn earlier(ui: &mut Ui, done: &Done) {
    if done.earlier.is_empty() {
        ui.label(quiet(text!("result-first")));
        return;
    }
    ui.label(quiet(text!("result-attempts")).small());
    egui::Grid::new("earlier")
        .num_columns(3)
        .spacing([18.0, 3.0])
        .show(ui, |ui| {
            let mut row = |when: &str, passed: Option<bool>, time: f64, errors: u64| {
                ui.label(quiet(when));
                let (words, color) = passed_words(passed);
                ui.label(RichText::new(words).color(color));
                ui.label(time_and_errors(time, errors));
                ui.end_row();
            };
            let errors = &done.score.errors;
            let count = errors.force_limit
                + errors.perforations
                + errors.drops
                + errors.shaft_contacts
                + errors.undone;
            row(
                &text!("result-now"),
                done.score.outcome.passed(),
                done.score.duration,
                count,
            );
            for own in done.earlier.iter().rev().take(EARLIER) {
                row(&own.date, own.passed, own.time, own.errors);
            }
        });
}

/// Whether the tool of a measure was used; measures of idle tools are left out.
fn was_used(done: &Done, measure: &Measure) -> bool {
    let hands = done.score.hands.iter();
    let mut idle = hands.filter(|hand| hand.path <= 0.0);
    !idle.any(|hand| {
        let rest = measure.key.strip_prefix(&hand.tool);
        rest.is_some_and(|rest| rest.starts_with('.'))
    })
}

fn measures(ui: &mut Ui, done: &Done) {
    egui::Grid::new("measures")
        .num_columns(4)
        .striped(true)
        .spacing([18.0, 3.0])
        .show(ui, |ui| {
            let heads = match done.compared.is_empty() {
                true => ["", "result-you", "", ""],
                false => ["", "result-you", "result-experts", ""],
            };
            for head in heads {
                let words = match head {
                    "" => String::new(),
                    key => text!(key),
                };
                ui.label(quiet(words).small());
            }
            ui.end_row();
            let all = done.score.measures().into_iter();
            for measure in all.filter(|own| was_used(done, own)) {
                let (name, value) = words(&measure.key, measure.value);
                ui.label(name);
                ui.label(RichText::new(value).monospace().color(WHITE));
                let mut compared = done.compared.iter();
                if let Some(own) = compared.find(|own| own.measure.key == measure.key) {
                    let mean = words(&measure.key, own.standard.mean).1;
                    ui.label(RichText::new(mean).monospace().color(QUIET));
                    match own.proficient {
                        Some(true) => {
                            ui.label(RichText::new(text!("result-proficient")).color(DEPTH))
                        }
                        Some(false) => {
                            ui.label(RichText::new(text!("result-not-yet")).color(WARNING))
                        }
                        None => ui.label(""),
                    };
                }
                ui.end_row();
            }
        });
}

/// A measure for people: its name, and its value in units that are read.
fn words(key: &str, value: f64) -> (String, String) {
    let (tool, plain) = key
        .split_once('.')
        .map_or(("", key), |(tool, plain)| (tool, plain));
    let units: [(&str, f64, &str); 8] = [
        ("_m2", 1e6, "mm²"),
        ("_part", 100.0, "%"),
        ("_n_s", 1.0, "N s"),
        ("_rad", 57.295_779_513_082_32, "°"),
        ("_m", 1e3, "mm"),
        ("_s", 1.0, "s"),
        ("_n", 1e3, "mN"),
        ("", 1.0, ""),
    ];
    let unit = units.iter().find(|(ending, ..)| plain.ends_with(ending));
    let (ending, factor, unit) = unit.copied().unwrap_or(("", 1.0, ""));
    let of_measure = format!("measure-{}", plain.replace('_', "-"));
    let name = translate_if_known(&of_measure).unwrap_or_else(|| {
        let name = plain.strip_suffix(ending).unwrap_or(plain);
        name.replace('_', " ")
    });
    let name = match tool {
        "" => name,
        tool => format!("{}: {name}", tool_name(tool)),
    };
    let value = factor * value;
    let decimals = match value.abs() {
        size if size == size.round() && unit.is_empty() => 0,
        size if size >= 1e5 => return (name, format!("{value:.1e} {unit}")),
        size if size < 10.0 => 2,
        size if size < 100.0 => 1,
        _ => 0,
    };
    (name, format!("{} {unit}", decimal(value, decimals)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_are_read_in_common_units() {
        let read = |key, value| {
            let (name, value) = words(key, value);
            format!("{name} {value}")
        };
        assert_eq!(read("left.path_m", 0.1234), "left: path 123 mm");
        assert_eq!(read("time_s", 12.34), "time 12.3 s");
        assert_eq!(
            read("right.force_time_n_s", 2.0),
            "right: force integral 2.00 N s"
        );
        assert_eq!(read("right.peak_force_n", 0.5), "right: peak force 500 mN");
        assert_eq!(read("perforations", 2.0), "perforations 2 ");
        assert_eq!(
            read("cut_part", 0.985),
            "part of the line that is cut 98.5 %"
        );
        assert_eq!(
            read("cut_deviation_area_m2", 31.4e-6),
            "area between the cut and the line 31.4 mm²"
        );
    }
}
