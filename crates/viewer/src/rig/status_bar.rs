use eframe::egui::{
    self, Align, Align2, Button, Color32, ComboBox, FontId, Frame, Layout, Margin, ProgressBar,
    RichText, Ui, vec2,
};
use palpate_measure::live::RigCommand;

use super::{Behind, RigWindow};
use crate::style::{DEPTH, FAULT, FORCE, ON_STOP, QUIET, STOP, STOP_HINT, WARNING};

/// Size of the button of the emergency stop.
const STOP_SIZE: [f32; 2] = [176.0, 62.0];
/// Height of the row with all quantities, whatever they are.
const HEIGHT: f32 = 68.0;
/// Width of a quantity with its limit, at most.
const WIDEST: f32 = 300.0;

/// Shows the state of the rig, its distance from the limits, the emergency stop and errors.
pub(super) fn show(window: &mut RigWindow, ui: &mut Ui) {
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        ui.set_min_height(HEIGHT);
        let width = (0.25 * (ui.available_width() - STOP_SIZE[0] - 40.0)).min(WIDEST);
        for block in [state, force, depth, breath] {
            ui.allocate_ui_with_layout(
                vec2(width, STOP_SIZE[1]),
                Layout::top_down(Align::Min),
                |ui| {
                    ui.set_width(width);
                    block(window, ui);
                },
            );
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let button = Button::new("").fill(STOP).min_size(STOP_SIZE.into());
            let button = ui.add(button).on_hover_text(STOP_HINT);
            for (words, size, above) in [("EMERGENCY STOP", 18.0, -9.0), ("space bar", 12.0, 13.0)]
            {
                let place = button.rect.center() + vec2(0.0, above);
                let font = FontId::proportional(size);
                ui.painter()
                    .text(place, Align2::CENTER_CENTER, words, font, ON_STOP);
            }
            if button.clicked() {
                window.emergency_stop();
            }
        });
    });
    ui.add_space(4.0);
    fault(window, ui);
    unsaved(window, ui);
    notice(window, ui);
}

/// A name, a number, and how much of its limit it is.
fn quantity(ui: &mut Ui, name: &str, number: String, color: Color32, part: f64, of: String) {
    ui.label(RichText::new(name).small().color(QUIET));
    ui.label(RichText::new(number).size(21.0).monospace().color(color));
    let fill = if part > 0.9 {
        FAULT
    } else {
        color.gamma_multiply(0.55)
    };
    let bar = ProgressBar::new(part.clamp(0.0, 1.0) as f32)
        .desired_width(ui.available_width() - 8.0)
        .desired_height(15.0)
        .corner_radius(3)
        .fill(fill)
        .text(RichText::new(of).small());
    ui.add(bar);
}

/// With so many digits behind the point, and no sign before a zero.
fn rounded(number: f64, digits: usize) -> String {
    let text = format!("{number:.digits$}");
    match text.parse() {
        Ok(0.0) => text.trim_start_matches('-').to_owned(),
        _ => text,
    }
}

fn state(window: &mut RigWindow, ui: &mut Ui) {
    specimen(window, ui);
    let watch = &window.watch;
    let (word, color) = match &window.behind {
        Behind::Preparing(_) => ("preparing", QUIET),
        Behind::Failed(_) => ("no rig", FAULT),
        Behind::Live(_) if watch.fault.is_some() => (watch.state(), FAULT),
        Behind::Live(_) => (watch.state(), Color32::from_rgb(218, 222, 228)),
    };
    ui.label(RichText::new(word).size(21.0).color(color));
    let now = watch.now.map_or(0.0, |now| now.time);
    let whole = watch.doing.and_then(|(command, since)| {
        let whole = match command {
            RigCommand::Rest => window.settings.recovery,
            RigCommand::Press(trajectory, _) => window.settings.time_of(&trajectory),
            _ => return None,
        };
        Some((now - since, whole))
    });
    if let Some((gone, whole)) = whole {
        let left = (whole - gone).max(0.0);
        let bar = ProgressBar::new((gone / whole).clamp(0.0, 1.0) as f32)
            .desired_width(ui.available_width() - 8.0)
            .desired_height(15.0)
            .corner_radius(3)
            .text(RichText::new(format!("{left:.0} s left")).small());
        ui.add(bar);
    }
}

fn specimen(window: &mut RigWindow, ui: &mut Ui) {
    let name = &window.places[window.place].name;
    if window.places.len() == 1 {
        ui.label(RichText::new(name).small().color(QUIET));
        return;
    }
    let mut place = window.place;
    ComboBox::from_id_salt("specimen")
        .selected_text(RichText::new(name).small())
        .width(ui.available_width() - 8.0)
        .show_ui(ui, |ui| {
            for (number, other) in window.places.iter().enumerate() {
                ui.selectable_value(&mut place, number, &other.name);
            }
        });
    if place != window.place {
        window.move_to(place, ui.ctx());
    }
}

fn force(window: &mut RigWindow, ui: &mut Ui) {
    let force = window.watch.now.map_or(0.0, |now| now.force);
    let limit = window.settings.force_limit;
    quantity(
        ui,
        "force, mean of the last 20 ms",
        format!("{} mN", rounded(1e3 * window.watch.steady_force(), 1)),
        FORCE,
        force / limit,
        format!(
            "limit {limit:.2} N, sensor {:.0} N",
            window.watch.sensor_range
        ),
    );
}

fn depth(window: &mut RigWindow, ui: &mut Ui) {
    let limit = window.settings.depth_limit;
    let now = window.watch.now;
    let (name, shown, part) = match now.and_then(|now| now.depth) {
        Some(depth) => ("depth from first contact", 1e3 * depth, depth / limit),
        None => (
            "way down, no contact yet",
            now.map_or(0.0, |now| -1e3 * now.height),
            0.0,
        ),
    };
    quantity(
        ui,
        name,
        format!("{} mm", rounded(shown, 2)),
        DEPTH,
        part,
        format!("limit {:.1} mm", 1e3 * limit),
    );
}

fn breath(window: &mut RigWindow, ui: &mut Ui) {
    let breath_time = window.watch.now.and_then(|now| now.breath);
    let number = |seconds: f64| format!("{seconds:.1} s");
    let (name, number, part, of) = match (breath_time, window.settings.breath) {
        (Some(breath_time), Some(budget)) => {
            let left = (budget - breath_time).max(0.0);
            let of = format!("budget {budget:.0} s");
            (
                "breath is held, left",
                number(left),
                breath_time / budget,
                of,
            )
        }
        (Some(breath_time), None) => (
            "breath is held",
            number(breath_time),
            0.0,
            "no budget".to_owned(),
        ),
        (None, Some(budget)) => (
            "breath",
            "drawn".to_owned(),
            0.0,
            format!("budget {budget:.0} s"),
        ),
        (None, None) => ("breath", "drawn".to_owned(), 0.0, "no budget".to_owned()),
    };
    quantity(ui, name, number, WARNING, part, of);
}

/// A fault, until forces are on again.
fn fault(window: &mut RigWindow, ui: &mut Ui) {
    let Some(fault) = window.watch.fault.clone() else {
        return;
    };
    let frame = Frame::new()
        .fill(Color32::from_rgb(72, 20, 18))
        .corner_radius(4)
        .inner_margin(Margin::symmetric(10, 6));
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("FAULT").strong().color(FAULT));
            ui.label(&fault.sentence);
            if !fault.seen {
                if ui.button("I have seen it").clicked()
                    && let Some(shown) = &mut window.watch.fault
                {
                    shown.seen = true;
                }
            } else if fault.arming {
                ui.spinner();
                ui.label("forces return");
            } else {
                if ui.button("Arm again").clicked() {
                    window.arm();
                }
                ui.label(
                    RichText::new("the indenter stays where it is then")
                        .small()
                        .color(QUIET),
                );
            }
        });
    });
    ui.add_space(4.0);
}

/// A recording that is in memory alone.
fn unsaved(window: &mut RigWindow, ui: &mut Ui) {
    let Some(unsaved) = &mut window.journal.unsaved else {
        return;
    };
    let samples = unsaved.failed.rows.len();
    let (mut saves, mut discards) = (false, false);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("NOT RECORDED").strong().color(FAULT));
        ui.label(unsaved.failed.error.to_string());
    });
    ui.horizontal(|ui| {
        ui.label(format!(
            "The rig was stopped; {samples} samples are in memory. Record them, and all that follows, in"
        ));
        ui.add(egui::TextEdit::singleline(&mut unsaved.elsewhere).desired_width(320.0));
        saves = ui.button("Record there").clicked();
        discards = ui.button("Discard them").clicked();
    });
    if let Some(trouble) = &unsaved.error {
        ui.label(RichText::new(trouble).small().color(FAULT));
    }
    ui.add_space(4.0);
    if saves {
        window.journal.save_elsewhere();
    }
    if discards {
        window.journal.unsaved = None;
    }
}

/// An error.
fn notice(window: &mut RigWindow, ui: &mut Ui) {
    let Some(notice) = window.watch.notice.clone() else {
        return;
    };
    egui::Sides::new().shrink_left().show(
        ui,
        |ui| {
            let label = egui::Label::new(RichText::new(&notice).color(WARNING)).truncate();
            ui.add(label).on_hover_text(&notice);
        },
        |ui| {
            if ui.button("I have seen it").clicked() {
                window.watch.notice = None;
            }
        },
    );
    ui.add_space(4.0);
}
