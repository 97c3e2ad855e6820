use eframe::egui::{self, Color32, Visuals};

/// What went wrong.
pub(crate) const FAULT: Color32 = Color32::from_rgb(242, 122, 106);
/// What deserves doubt.
pub(crate) const DOUBT: Color32 = Color32::from_rgb(226, 182, 92);
/// The force.
pub(crate) const FORCE: Color32 = Color32::from_rgb(236, 126, 92);
/// The depth, and the mark on the organ.
pub(crate) const DEPTH: Color32 = Color32::from_rgb(84, 196, 178);
/// What is said in passing.
pub(crate) const QUIET: Color32 = Color32::from_rgb(150, 158, 168);
/// The button of the emergency stop.
pub(crate) const STOP: Color32 = Color32::from_rgb(196, 32, 28);
/// What is written on it.
pub(crate) const ON_STOP: Color32 = Color32::WHITE;

/// What the emergency stop does.
pub(crate) const STOP_HINT: &str =
    "no force at once (space bar); it stays so until it is armed again";

/// Dark, so that the organ is what is bright.
pub(crate) fn dress(context: &egui::Context) {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = Color32::from_rgb(22, 25, 30);
    visuals.window_fill = visuals.panel_fill;
    visuals.extreme_bg_color = Color32::from_rgb(13, 15, 18);
    visuals.override_text_color = Some(Color32::from_rgb(218, 222, 228));
    visuals.selection.bg_fill = Color32::from_rgb(38, 96, 92);
    context.set_theme(egui::Theme::Dark);
    context.set_visuals(visuals);
}
