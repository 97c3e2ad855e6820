//! What lies over the picture while a task is attempted: what there is to do, how far it is, how it was done.

use eframe::egui::{self, Align2, Color32, Frame, Margin, RichText, Ui, Vec2};
use palpate_files::scene::Goal;
use palpate_simulate::performance::{Cue, Status};

use super::attempt::{Attempt, Phase, Unsaved};
use super::diameter;
use super::results::over;
use crate::style::{DEPTH, FAULT, QUIET, WARNING, WHITE};

/// What somebody wants of an attempt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asked {
    /// To begin, or to begin again.
    Begin,
    /// To end it here.
    End,
    /// To state the diameter that is set.
    State,
    /// To see how it may be done.
    Show,
    /// To look at it again.
    Again,
    /// To compare it with the demonstration.
    Compare,
    /// To record it in another folder.
    RecordElsewhere,
    /// To go back to the start screen.
    Home,
}

/// What the cards know beside the attempt.
pub(super) struct Around {
    /// How far the preparation of the organ is [-]; none when it is done.
    pub(super) preparing: Option<f64>,
    /// Whether the attempt begins when it is done.
    pub(super) begins: bool,
    /// Whether there is a start screen.
    pub(super) has_home: bool,
    /// How far the demonstration is that shall be seen beside the attempt [-].
    pub(super) comparing: Option<f64>,
}

/// Shows the card of an attempt; what was asked by it.
pub(super) fn show(ui: &Ui, attempt: &mut Attempt, around: &Around) -> Option<Asked> {
    let mut asked = None;
    let mut unsaved = attempt.unsaved.take();
    let mut states = attempt.diameter;
    match &attempt.phase {
        Phase::Reads => card(ui, "task", Align2::CENTER_CENTER, 430.0, |ui| {
            reads(ui, attempt, around, &mut asked);
        }),
        Phase::GoesOn(folder) => card(ui, "in progress", Align2::CENTER_TOP, 360.0, |ui| {
            let badge = match (folder, &unsaved) {
                (_, Some(_)) => Some(RichText::new("NOT RECORDED").strong().color(FAULT)),
                (Some(_), None) => Some(RichText::new("recorded").small().color(FAULT)),
                (None, None) => None,
            };
            goes_on(ui, attempt, badge, &mut asked);
            if attempt.awaits_diameter() {
                diameter::show(ui, &mut states, &mut asked);
            }
            not_recorded(ui, unsaved.as_mut(), &mut asked);
        }),
        Phase::Over(done) => card(ui, "over", Align2::RIGHT_CENTER, 400.0, |ui| {
            over(ui, (attempt, done), around, &mut asked);
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
        // Beside what the picture shows of the truth.
        Align2::RIGHT_CENTER => Vec2::new(-10.0, 0.0),
        _ => Vec2::ZERO,
    };
    let pivot = align.pos_in_rect(&place) + offset;
    egui::Area::new(egui::Id::unique(name))
        .fixed_pos(pivot)
        .pivot(align)
        .show(ui.ctx(), |ui| {
            let frame = Frame::new()
                .fill(Color32::from_rgba_unmultiplied(16, 19, 24, 236))
                .corner_radius(8.0)
                .inner_margin(Margin::symmetric(20, 14));
            frame.show(ui, |ui| {
                ui.set_width(width.min(place.width() - 60.0));
                show(ui);
            });
        });
}

pub(super) fn title(attempt: &Attempt) -> &str {
    attempt.task.title.as_deref().unwrap_or("Free play")
}

/// What there is to do.
fn reads(ui: &mut Ui, attempt: &Attempt, around: &Around, asked: &mut Option<Asked>) {
    ui.label(RichText::new(title(attempt)).size(22.0).color(WHITE));
    ui.add_space(6.0);
    if let Some(words) = &attempt.task.instructions {
        ui.label(RichText::new(words).size(15.0));
    }
    ui.add_space(6.0);
    let mut facts = vec![match &attempt.task.goal {
        Goal::Free => "Enter ends it.".to_owned(),
        Goal::Find { size: None, .. } => {
            "Enter marks the place that you press on, and ends it.".to_owned()
        }
        Goal::Find {
            size: Some(size), ..
        } => format!(
            "Enter marks the place that you press on. Then set the diameter with the left and right arrow keys, and \
             Enter states it; ± {:.0} mm counts.",
            1e3 * size.diameter_tolerance_m
        ),
        Goal::Traction {
            force_n,
            tolerance_n,
            hold_s,
            ..
        } => format!(
            "Hold {:.0} ± {:.0} mN for {hold_s:.0} s in all; then it ends by itself.",
            1e3 * force_n,
            1e3 * tolerance_n
        ),
        Goal::Touch(touch) => format!(
            "Touch the target with {:.0} ± {:.0} mN for {:.0} s in all; then it ends by itself. A touch counts while \
             neither tip nor shaft of the tool touches the organ.",
            1e3 * touch.force_n,
            1e3 * touch.tolerance_n,
            touch.hold_s
        ),
        Goal::Cut { .. } => {
            "It ends by itself when the line is cut; Enter ends it before.".to_owned()
        }
    }];
    if let Some(limit) = attempt.task.time_limit_s {
        facts.push(format!("You have {limit:.0} s."));
    }
    if let Some(limit) = attempt.task.force_limit_n {
        facts.push(format!(
            "A force above {:.0} mN counts as an error.",
            1e3 * limit
        ));
    }
    if attempt.has_expert() {
        facts.push("Bright outlines show how an expert did it.".to_owned());
    }
    if attempt.was_shown {
        facts.push(
            "That was the demonstration (script). Begin draws new numbers for your attempt."
                .to_owned(),
        );
    }
    ui.label(RichText::new(facts.join(" ")).color(QUIET));
    trouble(ui, attempt);
    ui.add_space(10.0);
    ui.horizontal(|ui| match around.preparing {
        Some(part) => {
            ui.add(egui::Spinner::new().color(DEPTH));
            let then = if around.begins {
                "; then it begins"
            } else {
                ""
            };
            ui.label(format!("preparing the organ, {:.0} %{then}", 100.0 * part));
            if !around.begins && ui.button("Begin when ready").clicked() {
                *asked = Some(Asked::Begin);
            }
            if around.has_home && ui.button("Tasks").clicked() {
                *asked = Some(Asked::Home);
            }
        }
        None => {
            let begin = button(ui, "Begin").on_hover_text("or Enter");
            if begin.clicked() {
                *asked = Some(Asked::Begin);
            }
            let can_show = attempt.task.goal != Goal::Free;
            if can_show && ui.button("Watch demonstration (script)").clicked() {
                *asked = Some(Asked::Show);
            }
            if around.has_home && ui.button("Tasks").clicked() {
                *asked = Some(Asked::Home);
            }
        }
    });
}

pub(super) fn button(ui: &mut Ui, words: &str) -> egui::Response {
    let text = RichText::new(words).size(16.0).color(WHITE);
    ui.add(egui::Button::new(text).fill(Color32::from_rgb(38, 96, 92)))
}

/// How far it is.
fn goes_on(ui: &mut Ui, attempt: &Attempt, badge: Option<RichText>, asked: &mut Option<Asked>) {
    ui.horizontal(|ui| {
        let shown = match attempt.is_shown() {
            true => "demonstration (script)",
            false => title(attempt),
        };
        ui.label(RichText::new(shown).strong().color(WHITE));
        let left = attempt
            .task
            .time_limit_s
            .map(|limit| limit - attempt.elapsed());
        let time = match left {
            Some(left) => format!("{:.0} s left", left.max(0.0)),
            None => format!("{:.0} s", attempt.elapsed()),
        };
        let hurry = left.is_some_and(|left| left < 10.0);
        let color = if hurry { WARNING } else { QUIET };
        ui.label(RichText::new(time).monospace().color(color));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if ui.small_button("End").on_hover_text("or Enter").clicked() {
                *asked = Some(Asked::End);
            }
            if let Some(badge) = badge {
                ui.label(badge);
            }
        });
    });
    gauge(ui, attempt);
    if let Status::GoesOn {
        part: Some(part), ..
    } = attempt.status()
    {
        let bar = egui::ProgressBar::new(part as f32)
            .fill(DEPTH)
            .desired_height(8.0);
        ui.add(bar);
    }
    let perforations = attempt.errors().perforations;
    if perforations > 0 {
        let times = if perforations == 1 {
            "once"
        } else {
            "more than once"
        };
        let words = format!("perforated {times}");
        ui.label(RichText::new(words).size(16.0).strong().color(FAULT));
    }
    trouble(ui, attempt);
}

/// Why it is not recorded, and where it can be.
fn not_recorded(ui: &mut Ui, unsaved: Option<&mut Unsaved>, asked: &mut Option<Asked>) {
    let Some(unsaved) = unsaved else { return };
    ui.add_space(4.0);
    ui.label(RichText::new(&unsaved.cause).color(FAULT));
    ui.label("The session is in memory, its first 20 minutes at least. Record all of it in another folder:");
    ui.horizontal(|ui| {
        if ui.button("Record there").clicked() {
            *asked = Some(Asked::RecordElsewhere);
        }
        let field = egui::TextEdit::singleline(&mut unsaved.elsewhere);
        ui.add(field.desired_width(f32::INFINITY));
    });
    if let Some(trouble) = &unsaved.trouble {
        ui.label(RichText::new(trouble).small().color(FAULT));
    }
}

/// The force that counts, beside its band or its limit, and the one thing to change of it.
fn gauge(ui: &mut Ui, attempt: &Attempt) {
    let force = attempt.forces.last().map_or(0.0, |[_, force]| *force);
    let ([low, high, full], force, cue) = match (&attempt.task.goal, attempt.status()) {
        (
            Goal::Traction {
                force_n,
                tolerance_n,
                ..
            },
            Status::GoesOn { advice, .. },
        ) => {
            let (force, cue) = advice.map_or((0.0, Cue::More), |own| (own.force, own.cue));
            let band = [force_n - tolerance_n, force_n + tolerance_n, 2.0 * force_n];
            (band, force, cue_words(cue, "pull"))
        }
        (
            Goal::Touch(touch),
            Status::GoesOn {
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
            (band, own.force, cue_words(own.cue, "press"))
        }
        _ => {
            let Some(limit) = attempt.task.force_limit_n else {
                return;
            };
            let words = match force > limit {
                true => ("too hard".to_owned(), FAULT),
                false => (String::new(), DEPTH),
            };
            ([0.0, limit, 1.5 * limit], force, words)
        }
    };
    ui.horizontal(|ui| {
        let words = format!("{:.0} mN", 1e3 * force);
        ui.label(RichText::new(words).size(28.0).monospace().color(WHITE));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.label(RichText::new(cue.0).size(20.0).strong().color(cue.1));
        });
    });
    let size = Vec2::new(ui.available_width(), 18.0);
    let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    let at = |force: f64| rect.min.x + rect.width() * (force / full).clamp(0.0, 1.0) as f32;
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, Color32::BLACK);
    let mut band = rect;
    (band.min.x, band.max.x) = (at(low), at(high));
    painter.rect_filled(band, 2.0, DEPTH.gamma_multiply(0.45));
    let color = if (low..=high).contains(&force) {
        WHITE
    } else {
        FAULT
    };
    painter.vline(at(force), rect.y_range(), egui::Stroke::new(5.0, color));
}

/// A cue in words, of a force with this verb, and its color.
fn cue_words(cue: Cue, verb: &str) -> (String, Color32) {
    match cue {
        Cue::Hold => ("hold".to_owned(), DEPTH),
        Cue::More => (format!("{verb} harder"), WARNING),
        Cue::Less => (format!("{verb} less"), FAULT),
        Cue::Turn => ("pull along the arrow".to_owned(), WARNING),
        Cue::Grasp => ("grasp the rim".to_owned(), WARNING),
        Cue::Lift => ("lift: organ in the way".to_owned(), WARNING),
        Cue::Reach => ("lift, then touch the target".to_owned(), WARNING),
    }
}

pub(super) fn trouble(ui: &mut Ui, attempt: &Attempt) {
    if let Some(trouble) = &attempt.trouble {
        ui.label(RichText::new(trouble).small().color(FAULT));
    }
}
