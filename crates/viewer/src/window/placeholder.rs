//! The placeholder without an organ, and dropped pictures that are wrapped around one.

use eframe::egui;

use super::SimulatorWindow;
use super::choice::Choice;
use super::page;
use super::texts::text;
use crate::{TissuePicture, style};

impl SimulatorWindow {
    /// Wraps the organ in a PNG file that was dropped on the window.
    pub(super) fn take_dropped(&mut self, context: &egui::Context) {
        let dropped = context.input(|input| input.raw.dropped_files.clone());
        for file in dropped {
            let path = file.path();
            match TissuePicture::read(path) {
                Ok(picture) => {
                    self.picture.surround(&self.gpu, Some(&picture));
                    self.surroundings = Some(path.display().to_string());
                    self.notice = None;
                }
                Err(error) => self.notice = Some(error.to_string()),
            }
        }
    }

    /// Fills the place of the picture when there is no organ.
    pub(super) fn show_absence(&mut self, ui: &mut egui::Ui) {
        let context = ui.ctx().clone();
        ui.centered_and_justified(|ui| {
            ui.vertical_centered(|ui| {
                ui.add_space(0.35 * ui.available_height());
                match self.fault.clone() {
                    None => {
                        page::spinner(ui);
                        ui.label(text!("preparing-organ"));
                    }
                    Some(fault) => {
                        ui.colored_label(style::FAULT, fault);
                        ui.add_space(12.0);
                        if ui.button(text!("absence-way-out")).clicked() {
                            self.choice = Choice::new(self.fallback.clone());
                            self.radius = 1e3 * self.choice.tip.radius_m;
                            self.fault = None;
                            self.reset(&context);
                        }
                    }
                }
            });
        });
    }
}
