use eframe::egui::{Button, DragValue, Grid, RichText, Ui, vec2};

use super::RigWindow;
use crate::style::{QUIET, WARNING};

/// A button for each stimulus, and one for all.
pub(super) fn show(window: &mut RigWindow, ui: &mut Ui) {
    ui.label(RichText::new("stimuli").strong());
    for number in 0..window.prepared.len() {
        ui.push_id(number, |ui| one(window, number, ui));
    }
    ui.add_space(6.0);
    let times: u64 = window.prepared.iter().map(|own| own.repeats).sum();
    let wrong = window
        .prepared
        .iter()
        .any(|own| own.trajectory(&window.settings).is_err());
    let enabled = window.watch.is_free() && !wrong;
    ui.vertical_centered(|ui| {
        let all = Button::new(format!("Run the protocol ({times} recordings)"));
        let all = all.min_size(vec2(ui.available_width(), 30.0));
        let hint = "rest, approach, rest and press, for each of them; Esc stops";
        let missing = "every stimulus must keep to its limits, and what is being done comes first";
        let all = ui.add_enabled(enabled, all).on_hover_text(hint);
        if all.on_disabled_hover_text(missing).clicked() {
            window.press_all();
        }
    });
}

fn one(window: &mut RigWindow, number: usize, ui: &mut Ui) {
    let free = window.watch.is_free();
    let known = window.watch.contact().is_some();
    let prepared = &mut window.prepared[number];
    let trajectory = prepared.trajectory(&window.settings);
    let [what, how] = prepared.words();
    let mut pressed = false;
    ui.horizontal(|ui| {
        let width = ui.available_width() - 34.0;
        let button = Button::new(what).min_size(vec2(width, 26.0));
        let response = ui
            .add_enabled(free && known && trajectory.is_ok(), button)
            .on_hover_text("press it and record it")
            .on_disabled_hover_text(if known {
                "what is being done comes first, and a fault before all"
            } else {
                "approach first: where the tissue begins is not known"
            });
        pressed = response.clicked();
        let edit = Button::selectable(prepared.open, "...").min_size(vec2(26.0, 26.0));
        if ui.add(edit).on_hover_text("change its numbers").clicked() {
            prepared.open = !prepared.open;
        }
    });
    ui.label(RichText::new(how).small().color(QUIET));
    if prepared.open {
        Grid::new("numbers").num_columns(2).show(ui, |ui| {
            for (name, unit, factor, number) in prepared.numbers() {
                ui.label(name);
                let mut shown = (*number * factor * 1e6).round() / 1e6;
                let value = DragValue::new(&mut shown)
                    .suffix(format!(" {unit}"))
                    .range(0.0..=600.0)
                    .speed(0.05)
                    .max_decimals(3);
                if ui.add(value).changed() {
                    *number = shown / factor;
                }
                ui.end_row();
            }
            ui.label("repeats");
            ui.add(DragValue::new(&mut prepared.repeats).range(1..=1000));
            ui.end_row();
        });
    }
    match trajectory {
        Ok(trajectory) if pressed => window.press(&trajectory),
        Ok(_) => {}
        Err(sentence) => {
            ui.label(RichText::new(sentence).small().color(WARNING));
        }
    }
    ui.add_space(3.0);
}
