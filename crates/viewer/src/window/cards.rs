//! Cards over the picture during an attempt: instructions, progress and result.

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Align2, Color32, Frame, Margin, RichText, Ui, Vec2};
use palpate_files::scene::Goal;
use palpate_simulate::performance::{Cue, Status};

use super::attempt::{Attempt, Phase, Unsaved};
use super::diameter;
use super::page::{self, main_button, or_key, quiet};
use super::results::over;
use super::texts::{decimal, of_task, text};
use crate::style::{BAR, CARD_OVER_PICTURE, DEPTH, FAULT, QUIET, WARNING, WHITE};

/// Action on an attempt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AttemptAction {
    /// To begin, or to begin again.
    Begin,
    /// To end it here.
    End,
    /// To state the diameter that is set.
    State,
    /// To see how it may be done.
    Show,
    /// To look at it again.
    Replay,
    /// To compare it with the demonstration.
    Compare,
    /// To record it in another folder.
    RecordElsewhere,
    /// To go back to the start screen.
    Home,
}

/// Context of the cards, in addition to the attempt.
pub(super) struct CardContext {
    /// How far the preparation of the organ is [-] and what it still takes [s], if known; none when it is done.
    pub(super) preparing: Option<(f64, Option<f64>)>,
    /// Whether the attempt begins when it is done.
    pub(super) begins: bool,
    /// Whether there is a start screen.
    pub(super) has_home: bool,
    /// Progress of the demonstration for comparison with the attempt [-].
    pub(super) comparing: Option<f64>,
}

/// Shows the card of an attempt and returns the chosen action.
pub(super) fn show(ui: &Ui, attempt: &mut Attempt, around: &CardContext) -> Option<AttemptAction> {
    let mut asked = None;
    let mut unsaved = attempt.unsaved.take();
    let mut states = attempt.diameter;
    match &attempt.phase {
        Phase::Briefing => card(ui, "task", Align2::CENTER_CENTER, 430.0, |ui| {
            reads(ui, attempt, around, &mut asked);
        }),
        Phase::Running(folder) => card(ui, "in progress", Align2::CENTER_TOP, 420.0, |ui| {
            let badge = match (folder, &unsaved) {
                (_, Some(_)) => Some(
                    RichText::new(text!("attempt-not-recorded"))
                        .strong()
                        .color(FAULT),
                ),
                (Some(_), None) => Some(
                    RichText::new(text!("attempt-recorded"))
                        .small()
                        .color(FAULT),
                ),
                (None, None) => None,
            };
            goes_on(ui, attempt, badge, &mut asked);
            if attempt.awaits_diameter() {
                diameter::show(ui, &mut states, &mut asked);
            }
            not_recorded(ui, unsaved.as_mut(), &mut asked);
        }),
        Phase::Ended(done) => card(ui, "over", Align2::RIGHT_CENTER, 400.0, |ui| {
            over(ui, attempt, done, around, &mut asked);
            not_recorded(ui, unsaved.as_mut(), &mut asked);
        }),
    }
    attempt.unsaved = unsaved;
    attempt.diameter = states;
    asked
}

fn card(ui: &Ui, name: &str, align: Align2, width: f32, show: impl FnOnce(&mut Ui)) {
    let place = ui.max_rect();
    let offset = match align {
        Align2::CENTER_TOP => Vec2::new(0.0, 10.0),
        // Next to the solution in the picture.
        Align2::RIGHT_CENTER => Vec2::new(-10.0, 0.0),
        _ => Vec2::ZERO,
    };
    let pivot = align.pos_in_rect(&place) + offset;
    egui::Area::new(egui::Id::unique(name))
        .fixed_pos(pivot)
        .pivot(align)
        .show(ui.ctx(), |ui| {
            let frame = Frame::new()
                .fill(CARD_OVER_PICTURE)
                .corner_radius(8.0)
                .inner_margin(Margin::symmetric(20, 14));
            frame.show(ui, |ui| {
                ui.set_width(width.min(place.width() - 60.0));
                show(ui);
            });
        });
}

pub(super) fn title(attempt: &Attempt) -> String {
    let title = attempt.task.title.as_deref();
    title.map_or_else(|| text!("common-free-play"), of_task)
}

/// The instructions.
fn reads(ui: &mut Ui, attempt: &Attempt, around: &CardContext, asked: &mut Option<AttemptAction>) {
    ui.label(RichText::new(title(attempt)).size(22.0).color(WHITE));
    ui.add_space(6.0);
    if let Some(words) = &attempt.task.instructions {
        ui.label(RichText::new(of_task(words)).size(15.0));
    }
    ui.add_space(6.0);
    ui.label(quiet(facts(attempt).join(" ")));
    show_error(ui, attempt);
    ui.add_space(10.0);
    ui.horizontal_wrapped(|ui| {
        match around.preparing {
            Some((part, time_left)) => {
                page::spinner(ui);
                let key = match around.begins {
                    true => "attempt-preparing-begins",
                    false => "attempt-preparing",
                };
                ui.label(text!(key, percent = (100.0 * part).round()));
                if let Some(seconds) = time_left {
                    ui.label(text!("preparing-left", seconds = seconds));
                }
                if !around.begins && ui.button(text!("attempt-begin-ready")).clicked() {
                    *asked = Some(AttemptAction::Begin);
                }
            }
            None => {
                let begin = main_button(ui, &text!("attempt-begin"));
                if begin.on_hover_text(or_key("Enter")).clicked() {
                    *asked = Some(AttemptAction::Begin);
                }
                let can_show = attempt.task.goal != Goal::Free;
                if can_show && ui.button(text!("attempt-watch")).clicked() {
                    *asked = Some(AttemptAction::Show);
                }
            }
        }
        tasks_button(ui, around, asked);
    });
}

/// What ends the task, and what counts.
fn facts(attempt: &Attempt) -> Vec<String> {
    let task = &attempt.task;
    let mut facts = vec![match &task.goal {
        Goal::Free => text!("fact-free"),
        Goal::Find { size: None, .. } => text!("fact-find"),
        Goal::Find {
            size: Some(size), ..
        } => text!(
            "fact-find-size",
            mm = (1e3 * size.diameter_tolerance_m).round()
        ),
        Goal::Traction {
            force_n,
            tolerance_n,
            hold_s,
            ..
        } => text!(
            "fact-hold",
            mn = (1e3 * force_n).round(),
            tolerance = (1e3 * tolerance_n).round(),
            s = hold_s.round()
        ),
        Goal::Touch(touch) => text!(
            "fact-touch",
            mn = (1e3 * touch.force_n).round(),
            tolerance = (1e3 * touch.tolerance_n).round(),
            s = touch.hold_s.round()
        ),
        Goal::Cut { .. } => text!("fact-cut"),
    }];
    if let Some(limit) = task.time_limit_s {
        facts.push(text!("fact-time", s = limit.round()));
    }
    if let Some(limit) = task.force_limit_n {
        facts.push(text!("fact-force", mn = (1e3 * limit).round()));
    }
    if attempt.has_expert() {
        facts.push(text!("fact-expert"));
    }
    if attempt.was_shown {
        facts.push(text!("fact-shown"));
    }
    facts
}

/// Back to the start screen, where there is one.
pub(super) fn tasks_button(ui: &mut Ui, around: &CardContext, asked: &mut Option<AttemptAction>) {
    if around.has_home && ui.button(text!("common-tasks")).clicked() {
        *asked = Some(AttemptAction::Home);
    }
}

/// The progress.
fn goes_on(
    ui: &mut Ui,
    attempt: &Attempt,
    badge: Option<RichText>,
    asked: &mut Option<AttemptAction>,
) {
    ui.horizontal(|ui| {
        let shown = match attempt.is_shown() {
            true => text!("common-demonstration"),
            false => title(attempt),
        };
        ui.label(RichText::new(shown).strong().color(WHITE));
        let left = attempt
            .task
            .time_limit_s
            .map(|limit| limit - attempt.elapsed());
        let time = match left {
            Some(left) => text!("attempt-time-left", s = left.max(0.0).round()),
            None => text!("attempt-time", s = attempt.elapsed().round()),
        };
        let hurry = left.is_some_and(|left| left < 10.0);
        let color = if hurry { WARNING } else { QUIET };
        ui.label(RichText::new(time).monospace().color(color));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let end = ui.small_button(text!("attempt-end"));
            if end.on_hover_text(or_key("Enter")).clicked() {
                *asked = Some(AttemptAction::End);
            }
            if let Some(badge) = badge {
                ui.label(badge);
            }
        });
    });
    gauge(ui, attempt);
    if let Status::InProgress {
        part: Some(part), ..
    } = attempt.status()
    {
        let bar = egui::ProgressBar::new(part as f32)
            .fill(DEPTH)
            .desired_height(8.0);
        let bar = ui.add(bar);
        page::name(&bar, Role::ProgressIndicator, &text!("attempt-part"));
    }
    let perforations = attempt.errors().perforations;
    if perforations > 0 {
        let words = text!("attempt-perforated", count = perforations);
        ui.label(RichText::new(words).size(16.0).strong().color(FAULT));
    }
    show_error(ui, attempt);
}

/// Why it is not recorded, and where it can be.
fn not_recorded(ui: &mut Ui, unsaved: Option<&mut Unsaved>, asked: &mut Option<AttemptAction>) {
    let Some(unsaved) = unsaved else { return };
    ui.add_space(4.0);
    ui.label(RichText::new(&unsaved.cause).color(FAULT));
    let label = ui.label(text!("attempt-elsewhere"));
    ui.horizontal(|ui| {
        if ui.button(text!("attempt-record-there")).clicked() {
            *asked = Some(AttemptAction::RecordElsewhere);
        }
        let field = egui::TextEdit::singleline(&mut unsaved.elsewhere);
        let field = ui.add(field.desired_width(f32::INFINITY));
        field.labelled_by(label.id);
    });
    if let Some(error) = &unsaved.error {
        ui.label(RichText::new(error).small().color(FAULT));
    }
}

/// The force that counts, versus its band or its limit, and the cue how to change it.
fn gauge(ui: &mut Ui, attempt: &Attempt) {
    let force = attempt.forces.last().map_or(0.0, |[_, force]| *force);
    let ([low, high, full], force, cue) = match (&attempt.task.goal, attempt.status()) {
        (
            Goal::Traction {
                force_n,
                tolerance_n,
                ..
            },
            Status::InProgress { advice, .. },
        ) => {
            let (force, cue) = advice.map_or((0.0, Cue::More), |own| (own.force, own.cue));
            let band = [force_n - tolerance_n, force_n + tolerance_n, 2.0 * force_n];
            (band, force, cue_words(cue, ["cue-harder", "cue-less"]))
        }
        (
            Goal::Touch(touch),
            Status::InProgress {
                advice: Some(own), ..
            },
        ) => {
            let limit = attempt.task.force_limit_n.or(touch.tear_force_n);
            let band = match (own.cue, limit) {
                // Of the tool that holds.
                (Cue::Grasp | Cue::Lift | Cue::Reach, Some(limit)) if touch.holder.is_some() => {
                    [0.0, limit, 1.5 * limit]
                }
                _ => {
                    let (low, high) = (
                        touch.force_n - touch.tolerance_n,
                        touch.force_n + touch.tolerance_n,
                    );
                    [low.max(0.0), high, 1.5 * high]
                }
            };
            (
                band,
                own.force,
                cue_words(own.cue, ["cue-press-harder", "cue-press-less"]),
            )
        }
        _ => {
            let Some(limit) = attempt.task.force_limit_n else {
                return;
            };
            let words = match force > limit {
                true => (text!("cue-too-hard"), FAULT),
                false => deviation_words(attempt),
            };
            ([0.0, limit, 1.5 * limit], force, words)
        }
    };
    ui.horizontal(|ui| {
        let words = format!("{:.0} mN", 1e3 * force);
        ui.label(RichText::new(words).size(28.0).monospace().color(WHITE));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if !cue.0.is_empty() {
                let words = RichText::new(cue.0).size(20.0);
                ui.label(words.strong().color(cue.1));
            }
        });
    });
    let size = Vec2::new(ui.available_width(), 18.0);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let number = |force: f64| (1e3 * force).round();
    let words = text!(
        "attempt-gauge",
        mn = number(force),
        low = number(low),
        high = number(high)
    );
    page::name(&response, Role::Meter, &words);
    let at = |force: f64| rect.min.x + rect.width() * (force / full).clamp(0.0, 1.0) as f32;
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, Color32::BLACK);
    let edge = egui::Stroke::new(1.0, QUIET);
    painter.rect_stroke(rect, 3.0, edge, egui::StrokeKind::Outside);
    let mut band = rect;
    (band.min.x, band.max.x) = (at(low), at(high));
    painter.rect_filled(band, 2.0, BAR);
    let color = if (low..=high).contains(&force) {
        WHITE
    } else {
        FAULT
    };
    painter.vline(at(force), rect.y_range(), egui::Stroke::new(5.0, color));
}

/// The words of a cue, with the keys of those for more and less of the force that counts, and its color.
fn cue_words(cue: Cue, [more, less]: [&'static str; 2]) -> (String, Color32) {
    let (key, color) = match cue {
        Cue::Hold => ("cue-hold", DEPTH),
        Cue::More => (more, WARNING),
        Cue::Less => (less, FAULT),
        Cue::Turn => ("cue-turn", WARNING),
        Cue::Grasp => ("cue-grasp", WARNING),
        Cue::Lift => ("cue-lift", WARNING),
        Cue::Reach => ("cue-reach", WARNING),
    };
    (text!(key), color)
}

/// A cut this near to its line is on it, in units of the distance that counts [-].
const ON_THE_LINE: f64 = 0.25;

/// Deviation of the current cut from its line, in words, and their color; nothing without a cut.
fn deviation_words(attempt: &Attempt) -> (String, Color32) {
    let Some((deviation, tolerance)) = attempt.deviation() else {
        return (String::new(), DEPTH);
    };
    if deviation.distance < ON_THE_LINE * tolerance {
        return (text!("cue-on-line"), DEPTH);
    }
    let key = match deviation.is_inside {
        Some(true) => "cue-inside",
        Some(false) => "cue-outside",
        None => "cue-beside",
    };
    let color = match deviation.distance <= tolerance {
        true => WARNING,
        false => FAULT,
    };
    (text!(key, mm = decimal(1e3 * deviation.distance, 1)), color)
}

pub(super) fn show_error(ui: &mut Ui, attempt: &Attempt) {
    if let Some(error) = &attempt.error {
        ui.label(RichText::new(error).small().color(FAULT));
    }
}
