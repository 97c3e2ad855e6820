use eframe::egui::accesskit::Role;
use eframe::egui::{self, Key, Ui};
use palpate_files::scene::{Enhancement, EnhancementArea, Smoothing};

use super::SimulatorWindow;
use super::page::{self, quiet};
use super::texts::text;

/// So many times each triangle is cut into four at most; more is drawn too slowly while the tip slides.
const MOST: usize = 4;

/// How the whole organ is shown around its contacts; switched while it is touched.
pub(super) fn show(window: &mut SimulatorWindow, ui: &mut Ui) {
    let chosen = window.picture.enhancement;
    let wanted = window
        .play
        .as_ref()
        .and_then(|play| play.simulation.enhancement())
        .map(|of_scene| chosen.unwrap_or(*of_scene));
    let (Some(mut wanted), Some(play)) = (wanted, &mut window.play) else {
        ui.label(quiet(text!("finer-none")).small());
        return;
    };
    let before = wanted;
    choose(&mut wanted, ui);
    let simulation = &play.simulation;
    let (shown, solved) = (
        simulation.surface().mesh().triangles().len(),
        simulation
            .response()
            .map_or(0, |response| response.triangles),
    );
    let summary = match simulation.is_carried() {
        true => text!("finer-carried", shown = shown, solved = solved),
        false => text!("finer-solved", solved = solved),
    };
    ui.label(quiet(summary).small());
    if wanted != before {
        window.picture.enhancement = Some(wanted);
        let enhanced = window.picture.enhance(&window.gpu, play);
        window.notice = enhanced.err().map(|error| error.to_string());
    }
}

/// The switches, and keys for a hand that presses: it has the mouse.
fn choose(wanted: &mut Enhancement, ui: &mut Ui) {
    if ui.input(|input| input.key_pressed(Key::F2)) {
        wanted.area = after(wanted.area, EnhancementArea::WORDS);
    }
    if ui.input(|input| input.key_pressed(Key::F3)) {
        wanted.smoothing = after(wanted.smoothing, Smoothing::WORDS);
    }
    egui::Grid::new("enhancement")
        .num_columns(2)
        .show(ui, |ui| {
            // A scene may have others.
            let range = wanted.levels.min(1)..=wanted.levels.max(MOST);
            let label = ui.label(text!("finer-title"));
            label.on_hover_text(text!("finer-hint"));
            ui.horizontal(|ui| {
                ui.selectable_value(&mut wanted.area, EnhancementArea::None, text!("finer-no"));
                ui.selectable_value(&mut wanted.area, EnhancementArea::Edge, text!("finer-edge"));
                ui.selectable_value(
                    &mut wanted.area,
                    EnhancementArea::Vertex,
                    text!("finer-vertex"),
                );
                let levels = egui::Slider::new(&mut wanted.levels, range).show_value(false);
                let levels = ui.add_enabled(wanted.area != EnhancementArea::None, levels);
                page::name(&levels, Role::Slider, &text!("finer-levels"));
                levels.on_hover_text(text!("finer-levels"));
            });
            ui.end_row();
            let label = ui.label(text!("smooth-title"));
            label.on_hover_text(text!("smooth-hint"));
            ui.horizontal(|ui| {
                ui.selectable_value(&mut wanted.smoothing, Smoothing::None, text!("finer-no"));
                ui.selectable_value(&mut wanted.smoothing, Smoothing::Shepard, "Shepard");
                let squares = Smoothing::MovingLeastSquares;
                ui.selectable_value(&mut wanted.smoothing, squares, text!("smooth-squares"));
            });
            ui.end_row();
        });
}

/// The choice after `now`, and the first after the last.
fn after<T: Copy + PartialEq>(now: T, words: &[(&str, T)]) -> T {
    let choices = words.iter().map(|(_, choice)| *choice);
    let mut later = choices.clone().cycle().skip_while(|choice| *choice != now);
    later.nth(1).unwrap_or(now)
}
