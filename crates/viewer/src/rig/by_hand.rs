use eframe::egui::{Button, Grid, RichText, Ui, Vec2, vec2};
use palpate_measure::live::Order;

use super::{RigWindow, keys};
use crate::style::QUIET;

/// How far a click may move the indenter [mm].
const STEPS: [f64; 4] = [0.1, 0.5, 1.0, 5.0];

/// Moves between stimuli.
pub(super) fn show(window: &mut RigWindow, ui: &mut Ui) {
    ui.add_space(4.0);
    ui.label(RichText::new("by hand").strong());
    steps(window, ui);
    let size = vec2(0.5 * (ui.available_width() - 12.0), 28.0);
    Grid::new("by hand").spacing(vec2(8.0, 6.0)).show(ui, |ui| {
        jog(window, (true, "Page Up"), size, ui);
        jog(window, (false, "Page Down"), size, ui);
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

/// By a step, and for as long as a button is held.
fn jog(window: &mut RigWindow, (up, key): (bool, &str), size: Vec2, ui: &mut Ui) {
    let free = window.watch.is_free();
    let (word, way) = match up {
        true => ("Up", window.step),
        false => ("Down", -window.step),
    };
    let shown = (1e4 * window.step).round() / 10.0;
    let step = Button::new(format!("{word} {shown} mm")).min_size(size);
    let step = ui.add_enabled(free, step);
    if step.on_hover_text("by one step (arrow key)").clicked() {
        window.order(Order::Jog(way));
    }
    let held = Button::new(format!("Hold to go {}", word.to_lowercase())).min_size(size);
    // Enabled while it is held, when its own order is being carried out.
    let driving = matches!(window.watch.doing, Some((Order::Drive(_), _)));
    let speed = 1e3 * window.settings.jog_speed;
    let hint = format!("at {speed} mm/s for as long as it is held ({key} key)");
    let held = ui.add_enabled(free || driving, held).on_hover_text(hint);
    if held.is_pointer_button_down_on() {
        keys::drive(window, up);
    }
    ui.end_row();
}

fn programmed(window: &mut RigWindow, size: Vec2, ui: &mut Ui) {
    let down = "down until tissue is met, then wait above it (A key)";
    let out = "out of the tissue (W key)";
    for (word, hint, order) in [
        ("Approach", down, Order::Approach),
        ("Withdraw", out, Order::Withdraw),
    ] {
        let button = Button::new(word).min_size(size);
        let button = ui.add_enabled(window.watch.is_free(), button);
        if button.on_hover_text(hint).clicked() {
            window.order(order);
        }
    }
    ui.end_row();
}
