//! What lies over the picture while a task is attempted: what there is to do, how far it is, how it was done.

use eframe::egui::{self, Align2, Color32, Frame, Margin, RichText, Ui, Vec2};
use palpate_files::scene::Goal;
use palpate_simulate::Stray;
use palpate_simulate::performance::{Comparison, Measure, Status, outcome_words};

use super::attempt::{Attempt, Done, Phase, Unsaved};
use crate::style::{DEPTH, DOUBT, FAULT, FORCE, QUIET};

/// What somebody wants of an attempt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asked {
    /// To begin, or to begin again.
    Begin,
    /// To end it here.
    End,
    /// To look at it again.
    Again,
    /// To record it in another folder.
    RecordElsewhere,
    /// To go back to the start screen.
    Home,
}

/// What the cards know beside the attempt.
pub(super) struct Around {
    /// How far the preparation of the organ is [-]; none when it is done.
    pub(super) preparing: Option<f64>,
    /// Whether there is a start screen.
    pub(super) has_home: bool,
}

const WHITE: Color32 = Color32::from_rgb(232, 235, 240);

/// Shows the card of an attempt; what was asked by it.
pub(super) fn show(ui: &Ui, attempt: &mut Attempt, around: &Around) -> Option<Asked> {
    let mut asked = None;
    let mut unsaved = attempt.unsaved.take();
    match &attempt.phase {
        Phase::Reads => card(ui, "task", Align2::CENTER_CENTER, 430.0, |ui| {
            reads(ui, attempt, around, &mut asked);
        }),
        Phase::GoesOn(folder) => card(ui, "goes on", Align2::CENTER_TOP, 360.0, |ui| {
            let badge = match (folder, &unsaved) {
                (_, Some(_)) => Some(RichText::new("NOT RECORDED").strong().color(FAULT)),
                (Some(_), None) => Some(RichText::new("recorded").small().color(FAULT)),
                (None, None) => None,
            };
            goes_on(ui, attempt, badge, &mut asked);
            not_recorded(ui, unsaved.as_mut(), &mut asked);
        }),
        Phase::Over(done) => card(ui, "over", Align2::CENTER_CENTER, 430.0, |ui| {
            over(ui, (attempt, done), around, &mut asked);
            not_recorded(ui, unsaved.as_mut(), &mut asked);
        }),
    }
    attempt.unsaved = unsaved;
    asked
}

fn card(ui: &Ui, name: &str, align: Align2, width: f32, show: impl FnOnce(&mut Ui)) {
    let place = ui.max_rect();
    let offset = match align {
        Align2::CENTER_TOP => Vec2::new(0.0, 10.0),
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

fn title(attempt: &Attempt) -> &str {
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
    let ends = match attempt.task.goal {
        Goal::Free => "Enter ends it.",
        Goal::Find { .. } => "Enter marks the place that you press on, and ends it.",
        Goal::Traction { .. } => "It ends by itself when the force was held for long enough.",
        Goal::Cut { .. } => "It ends by itself when the line is cut; Enter ends it before.",
    };
    let mut facts = vec![ends.to_owned()];
    if let Some(limit) = attempt.task.time_limit_s {
        facts.push(format!("You have {limit:.0} s."));
    }
    if let Some(limit) = attempt.task.force_limit_n {
        facts.push(format!("Forces above {limit} N count as errors."));
    }
    if attempt.has_expert() {
        facts.push("Bright outlines show how it was done before.".to_owned());
    }
    ui.label(RichText::new(facts.join(" ")).color(QUIET));
    trouble(ui, attempt);
    ui.add_space(10.0);
    ui.horizontal(|ui| match around.preparing {
        Some(part) => {
            ui.add(egui::Spinner::new().color(DEPTH));
            ui.label(format!("preparing the organ, {:.0} %", 100.0 * part));
        }
        None => {
            if button(ui, "Begin").clicked() {
                *asked = Some(Asked::Begin);
            }
            if around.has_home && ui.button("Other tasks").clicked() {
                *asked = Some(Asked::Home);
            }
        }
    });
}

fn button(ui: &mut Ui, words: &str) -> egui::Response {
    let text = RichText::new(words).size(16.0).color(WHITE);
    ui.add(egui::Button::new(text).fill(Color32::from_rgb(38, 96, 92)))
}

/// How far it is.
fn goes_on(ui: &mut Ui, attempt: &Attempt, badge: Option<RichText>, asked: &mut Option<Asked>) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(title(attempt)).strong().color(WHITE));
        let left = attempt
            .task
            .time_limit_s
            .map(|limit| limit - attempt.elapsed());
        let time = match left {
            Some(left) => format!("{:.0} s left", left.max(0.0)),
            None => format!("{:.0} s", attempt.elapsed()),
        };
        let hurry = left.is_some_and(|left| left < 10.0);
        let color = if hurry { DOUBT } else { QUIET };
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
    if let Status::GoesOn { part, pull: now } = attempt.status() {
        if let (
            Goal::Traction {
                force_n,
                tolerance_n,
                ..
            },
            Some(now),
        ) = (&attempt.task.goal, now)
        {
            pull(ui, now.force, [*force_n, *tolerance_n]);
        }
        if let Some(part) = part {
            let bar = egui::ProgressBar::new(part as f32)
                .fill(DEPTH)
                .desired_height(8.0);
            ui.add(bar);
        }
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
    if let Some(guidance) = &attempt.guidance {
        let words = format!("on the expert's way: {:.0} %", 100.0 * guidance.progress);
        ui.horizontal(|ui| {
            ui.label(RichText::new(words).small().color(QUIET));
            for stray in guidance.strays.iter().flatten() {
                let words = match stray {
                    Stray::Above => "harder than the expert",
                    Stray::Below => "more gently than the expert",
                };
                ui.label(RichText::new(words).strong().color(DOUBT));
            }
        });
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

/// A pull beside the wanted one.
fn pull(ui: &mut Ui, force: f64, [wanted, tolerance]: [f64; 2]) {
    let (rect, _) =
        ui.allocate_exact_size(Vec2::new(ui.available_width(), 20.0), egui::Sense::hover());
    let full = 2.0 * wanted;
    let at = |force: f64| rect.min.x + rect.width() * (force / full).clamp(0.0, 1.0) as f32;
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, Color32::from_black_alpha(120));
    let mut band = rect;
    (band.min.x, band.max.x) = (at(wanted - tolerance), at(wanted + tolerance));
    painter.rect_filled(band, 2.0, DEPTH.gamma_multiply(0.45));
    let inside = (force - wanted).abs() <= tolerance;
    let color = if inside { DEPTH } else { FORCE };
    let stroke = egui::Stroke::new(3.0, color);
    painter.vline(at(force), rect.y_range(), stroke);
    let words = format!("{:.0} of {:.0} mN", 1e3 * force, 1e3 * wanted);
    let font = egui::FontId::monospace(12.0);
    let at = rect.left_center() + Vec2::new(6.0, 0.0);
    painter.text(at, Align2::LEFT_CENTER, words, font, WHITE);
}

/// How it was done.
fn over(
    ui: &mut Ui,
    (attempt, done): (&Attempt, &Done),
    around: &Around,
    asked: &mut Option<Asked>,
) {
    ui.label(RichText::new(title(attempt)).size(22.0).color(WHITE));
    let words = match done.late {
        true => format!("The time is over. {}", outcome_words(&done.score.outcome)),
        false => outcome_words(&done.score.outcome),
    };
    let color = match done.score.outcome.passed() {
        Some(true) => DEPTH,
        Some(false) => DOUBT,
        None => QUIET,
    };
    ui.label(RichText::new(words).size(16.0).color(color));
    ui.add_space(6.0);
    let most = (ui.ctx().content_rect().height() - 260.0).max(120.0);
    egui::ScrollArea::vertical()
        .max_height(most)
        .show(ui, |ui| {
            measures(ui, done);
        });
    if let Some(folder) = &done.folder {
        let words = format!("recorded in {}", folder.display());
        ui.label(RichText::new(words).small().color(QUIET));
    }
    trouble(ui, attempt);
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if button(ui, "Once more").clicked() {
            *asked = Some(Asked::Begin);
        }
        if done.folder.is_some() && ui.button("Look at it again").clicked() {
            *asked = Some(Asked::Again);
        }
        if around.has_home && ui.button("Other tasks").clicked() {
            *asked = Some(Asked::Home);
        }
    });
}

fn measures(ui: &mut Ui, done: &Done) {
    let beside = |measure: &Measure| -> Option<&Comparison> {
        done.compared
            .iter()
            .find(|own| own.measure.key == measure.key)
    };
    egui::Grid::new("measures")
        .num_columns(4)
        .striped(true)
        .spacing([18.0, 3.0])
        .show(ui, |ui| {
            let heads = match done.compared.is_empty() {
                true => ["", "you", "", ""],
                false => ["", "you", "expert", ""],
            };
            for head in heads {
                ui.label(RichText::new(head).small().color(QUIET));
            }
            ui.end_row();
            for measure in done.score.measures() {
                let (name, value) = words(&measure.key, measure.value);
                ui.label(name);
                ui.label(RichText::new(value).monospace().color(WHITE));
                if let Some(own) = beside(&measure) {
                    let mean = words(&measure.key, own.standard.mean).1;
                    ui.label(RichText::new(mean).monospace().color(QUIET));
                    match own.proficient {
                        Some(true) => ui.label(RichText::new("proficient").color(DEPTH)),
                        Some(false) => ui.label(RichText::new("not yet").color(DOUBT)),
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
    let units: [(&str, f64, &str); 6] = [
        ("_n_s", 1.0, "N s"),
        ("_rad", 57.295_779_513_082_32, "°"),
        ("_m", 1e3, "mm"),
        ("_s", 1.0, "s"),
        ("_n", 1e3, "mN"),
        ("", 1.0, ""),
    ];
    let unit = units.iter().find(|(ending, ..)| plain.ends_with(ending));
    let (ending, factor, unit) = unit.copied().unwrap_or(("", 1.0, ""));
    let name = plain
        .strip_suffix(ending)
        .unwrap_or(plain)
        .replace('_', " ");
    let name = match tool {
        "" => name,
        tool => format!("{tool}: {name}"),
    };
    let value = factor * value;
    let decimals = match value.abs() {
        size if size == size.round() && unit.is_empty() => 0,
        size if size >= 1e5 => return (name, format!("{value:.1e} {unit}")),
        size if size < 10.0 => 2,
        size if size < 100.0 => 1,
        _ => 0,
    };
    (name, format!("{value:.decimals$} {unit}"))
}

fn trouble(ui: &mut Ui, attempt: &Attempt) {
    if let Some(trouble) = &attempt.trouble {
        ui.label(RichText::new(trouble).small().color(FAULT));
    }
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
            "right: force time 2.00 N s"
        );
        assert_eq!(read("right.peak_force_n", 0.5), "right: peak force 500 mN");
        assert_eq!(read("perforations", 2.0), "perforations 2 ");
    }
}
