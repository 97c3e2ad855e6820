//! Below a session that is played again: where it is, and how fast.

use eframe::egui::{self, RichText, Ui};

use super::source::Playback;
use crate::style::QUIET;

/// Paces to choose from [-].
const PACES: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Shows the line; whether somebody wants to leave the session.
pub(super) fn show(ui: &mut Ui, playback: &mut Playback, can_leave: bool) -> bool {
    let mut leaves = false;
    ui.horizontal(|ui| {
        let [steps, played] = playback.steps();
        let word = if playback.plays { "Stop" } else { "Play" };
        if ui.button(word).on_hover_text("or P").clicked() {
            playback.plays = !playback.plays;
            if playback.plays && played == steps {
                playback.go_to(0);
            }
        }
        for pace in PACES {
            ui.selectable_value(&mut playback.pace, pace, format!("{pace}×"));
        }
        let words = format!(
            "{:5.1} of {:.1} s",
            playback.time(played.saturating_sub(1)),
            playback.time(steps)
        );
        ui.label(RichText::new(words).monospace().color(QUIET));
        let room = ui.available_width() - if can_leave { 80.0 } else { 10.0 };
        ui.spacing_mut().slider_width = room.max(60.0);
        let mut at = played;
        let slider = egui::Slider::new(&mut at, 0..=steps).show_value(false);
        if ui.add(slider).changed() {
            playback.go_to(at);
        }
        if can_leave && ui.button("Leave").clicked() {
            leaves = true;
        }
    });
    leaves
}
