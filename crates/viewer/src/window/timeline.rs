//! The timeline below a replayed session: its time and pace.

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Ui, WidgetInfo};

use super::page::{or_key, quiet};
use super::source::Playback;
use super::texts::{decimal, text, written};

/// Paces to choose from [-].
const PACES: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Shows the line; whether somebody wants to leave the session.
pub(super) fn show(ui: &mut Ui, playback: &mut Playback, can_leave: bool) -> bool {
    let mut leaves = false;
    ui.horizontal(|ui| {
        let [steps, played] = playback.steps();
        let word = text!(match playback.plays {
            true => "replay-stop",
            false => "replay-play",
        });
        if ui.button(word).on_hover_text(or_key("P")).clicked() {
            playback.plays = !playback.plays;
            if playback.plays && played == steps {
                playback.go_to(0);
            }
        }
        for pace in PACES {
            let words = written(&format!("{pace}×"));
            ui.selectable_value(&mut playback.pace, pace, words);
        }
        let words = text!(
            "replay-at",
            at = decimal(playback.time(played.saturating_sub(1)), 1),
            end = decimal(playback.time(steps), 1)
        );
        ui.label(quiet(&words).monospace());
        let leave = text!("replay-leave");
        let room = ui.available_width() - if can_leave { 100.0 } else { 10.0 };
        ui.spacing_mut().slider_width = room.max(60.0);
        let mut at = played;
        let slider = ui.add(egui::Slider::new(&mut at, 0..=steps).show_value(false));
        slider.widget_info(|| WidgetInfo {
            current_text_value: Some(words.clone()),
            ..WidgetInfo::labeled(Role::Slider, true, text!("replay-time"))
        });
        if slider.changed() {
            playback.go_to(at);
        }
        if can_leave && ui.button(leave).clicked() {
            leaves = true;
        }
    });
    leaves
}
