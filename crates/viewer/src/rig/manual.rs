use eframe::egui::{Button, Grid, RichText, Ui, vec2};
use palpate_measure::live::RigCommand;
use palpate_servo::Vec3;

use super::{RigWindow, keys};
use crate::style::QUIET;

/// How far a click may move the indenter [mm].
const STEPS: [f64; 4] = [0.1, 0.5, 1.0, 5.0];

/// Moves between stimuli.
pub(super) fn show(window: &mut RigWindow, ui: &mut Ui) {
    ui.add_space(4.0);
    ui.label(RichText::new("by hand").strong());
    steps(window, ui);
    let size = vec2((ui.available_width() - 20.0) / 3.0, 26.0);
    Grid::new("sideways")
        .spacing(vec2(8.0, 6.0))
        .show(ui, |ui| {
            for row in PAD {
                for button in row {
                    match button {
                        Some(own) => jog(window, own, size, ui),
                        None => {
                            ui.label("");
                        }
                    }
                }
                ui.end_row();
            }
        });
    let size = vec2(0.5 * (ui.available_width() - 12.0), 28.0);
    Grid::new("by hand").spacing(vec2(8.0, 6.0)).show(ui, |ui| {
        drive(window, true, "Page Up", size, ui);
        drive(window, false, "Page Down", size, ui);
        ui.end_row();
        programmed(window, size, ui);
    });
    ui.add_space(2.0);
    ui.vertical_centered(|ui| {
        let size = vec2(ui.available_width(), 28.0);
        let stop = Button::new("Stop and withdraw (Esc)").min_size(size);
        if ui.add_enabled(window.watch.waiting > 0, stop).clicked() {
            window.stop();
        }
    });
    let more = match window.watch.waiting {
        0 | 1 => String::new(),
        n => format!("{} more orders wait", n - 1),
    };
    ui.label(RichText::new(more).small().color(QUIET));
}

/// How far a click goes.
fn steps(window: &mut RigWindow, ui: &mut Ui) {
    ui.horizontal(|ui| {
        for step in STEPS {
            let metres = 1e-3 * step;
            let chosen = (window.step - metres).abs() < 1e-9;
            let button = Button::selectable(chosen, format!("{step}")).min_size(vec2(38.0, 22.0));
            if ui.add(button).clicked() {
                window.step = metres;
            }
        }
        ui.label("mm");
    });
}

/// A button that moves the indenter by a step.
#[derive(Debug, Clone, Copy)]
struct Jog {
    word: &'static str,
    key: &'static str,
    way: JogStep,
}

/// Where a step goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum JogStep {
    /// Along x (right) and y (away), in steps.
    Sideways([f64; 2]),
    /// Out of the tissue, or into it when it is negative, in steps.
    AlongNormal(f64),
}

impl JogStep {
    /// In the rig's axes [m], where a step is so long [m] and the normal leads there [-].
    pub(super) fn in_rig(self, step: f64, normal: &Vec3) -> Vec3 {
        match self {
            Self::Sideways([x, y]) => step * Vec3::new(x, y, 0.0),
            Self::AlongNormal(steps) => step * steps * normal,
        }
    }
}

const fn to(word: &'static str, key: &'static str, way: JogStep) -> Option<Jog> {
    Some(Jog { word, key, way })
}

/// As the operator sees the rig from above, with up and down at the right.
const PAD: [[Option<Jog>; 3]; 3] = [
    [
        None,
        to("Away", "Shift+Up", JogStep::Sideways([0.0, 1.0])),
        to("Up", "Up", JogStep::AlongNormal(1.0)),
    ],
    [
        to("Left", "Left", JogStep::Sideways([-1.0, 0.0])),
        None,
        to("Right", "Right", JogStep::Sideways([1.0, 0.0])),
    ],
    [
        None,
        to("Near", "Shift+Down", JogStep::Sideways([0.0, -1.0])),
        to("Down", "Down", JogStep::AlongNormal(-1.0)),
    ],
];

/// By a step.
fn jog(window: &mut RigWindow, own: Jog, size: eframe::egui::Vec2, ui: &mut Ui) {
    let button = Button::new(own.word).min_size(size);
    let button = ui.add_enabled(window.watch.is_free(), button);
    let along = match own.way {
        JogStep::Sideways(_) => "sideways, above the tissue",
        JogStep::AlongNormal(_) => "along the normal",
    };
    let hint = format!("by one step, {along} ({} key)", own.key);
    if button.on_hover_text(hint).clicked() {
        window.jog(own.way);
    }
}

/// For as long as a button is held.
fn drive(window: &mut RigWindow, up: bool, key: &str, size: eframe::egui::Vec2, ui: &mut Ui) {
    let free = window.watch.is_free();
    let word = if up { "up" } else { "down" };
    let button = Button::new(format!("Hold to go {word}")).min_size(size);
    // Enabled while it is held, when its own command is being carried out.
    let driving = matches!(window.watch.doing, Some((RigCommand::Drive(_), _)));
    let speed = 1e3 * window.settings.jog_speed;
    let hint = format!("at {speed} mm/s for as long as it is held ({key} key)");
    let button = ui.add_enabled(free || driving, button).on_hover_text(hint);
    if button.is_pointer_button_down_on() {
        keys::drive(window, up);
    }
}

fn programmed(window: &mut RigWindow, size: eframe::egui::Vec2, ui: &mut Ui) {
    let down = "down until tissue is met, then wait above it (A key)";
    let out = "out of the tissue (W key)";
    for (word, hint, command) in [
        ("Approach", down, RigCommand::Approach),
        ("Withdraw", out, RigCommand::Withdraw),
    ] {
        let button = Button::new(word).min_size(size);
        let button = ui.add_enabled(window.watch.is_free(), button);
        if button.on_hover_text(hint).clicked() {
            window.send(command);
        }
    }
    ui.end_row();
}
