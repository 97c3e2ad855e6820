//! Common parts of all pages of the trainer: their frame, and names for screen readers.

use eframe::egui::accesskit::Role;
use eframe::egui::{
    Button, Frame, Key, Margin, Response, RichText, ScrollArea, Spinner, Ui, WidgetInfo,
};
use egui_plot::Plot;

use super::texts::{key_name, text};
use crate::style::{ACTION, DEPTH, QUIET, WHITE};

/// The frame of a page, which scrolls.
pub(super) fn frame(ui: &mut Ui, show: impl FnOnce(&mut Ui)) {
    let margin = Margin::symmetric(28, 20);
    Frame::new().inner_margin(margin).show(ui, |ui| {
        let area = ScrollArea::vertical().auto_shrink([false, false]);
        area.show(ui, show);
    });
}

/// A page with a title that can be left; whether somebody leaves it.
pub(super) fn closable_page(ui: &mut Ui, title: &str, show: impl FnOnce(&mut Ui)) -> bool {
    let mut is_left = ui.input(|input| input.key_pressed(Key::Escape));
    frame(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(title).size(34.0).color(WHITE));
            let back = ui.button(text!("common-back"));
            is_left |= back.on_hover_text(or_key("Esc")).clicked();
        });
        show(ui);
    });
    is_left
}

/// The heading of a part of a page.
pub(super) fn heading(ui: &mut Ui, words: &str) {
    ui.add_space(14.0);
    ui.label(RichText::new(words).size(20.0).color(WHITE));
    ui.add_space(2.0);
}

/// Said in passing.
pub(super) fn quiet(words: impl Into<String>) -> RichText {
    RichText::new(words).color(QUIET)
}

/// The button of what is usually done next.
pub(super) fn main_button(ui: &mut Ui, words: &str) -> Response {
    let text = RichText::new(words).size(16.0).color(WHITE);
    ui.add(Button::new(text).fill(ACTION))
}

/// Which key does the same as a button.
pub(super) fn or_key(key: &str) -> String {
    text!("common-or-key", key = key_name(key))
}

/// A plot that stays as it is under a pointer.
pub(super) fn still_plot<'a>(
    name: impl std::hash::Hash + std::fmt::Debug,
    height: f32,
) -> Plot<'a> {
    Plot::new(name)
        .height(height)
        .include_y(0.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
}

/// Shows that an organ is being prepared.
pub(super) fn spinner(ui: &mut Ui) {
    let spinner = ui.add(Spinner::new().color(DEPTH));
    let words = text!("preparing-organ");
    name(&spinner, Role::ProgressIndicator, &words);
}

/// Names what a screen reader cannot see.
pub(super) fn name(response: &Response, role: Role, words: &str) {
    response.widget_info(|| WidgetInfo::labeled(role, response.enabled(), words));
}
