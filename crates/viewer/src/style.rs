use eframe::egui::{self, Color32, Visuals};

/// What went wrong.
pub(crate) const FAULT: Color32 = Color32::from_rgb(242, 122, 106);
/// Warnings.
pub(crate) const WARNING: Color32 = Color32::from_rgb(226, 182, 92);
/// The force.
pub(crate) const FORCE: Color32 = Color32::from_rgb(236, 126, 92);
/// The depth, and the mark on the organ.
pub(crate) const DEPTH: Color32 = Color32::from_rgb(84, 196, 178);
/// What is said in passing.
pub(crate) const QUIET: Color32 = Color32::from_rgb(150, 158, 168);
/// What is read first.
pub(crate) const WHITE: Color32 = Color32::from_rgb(232, 235, 240);
/// What is left to do on an organ, and the truth: yellow is seen on red by everybody.
pub(crate) const LEFT: Color32 = Color32::from_rgb(255, 224, 92);
/// What somebody else did, or marked, on an organ.
pub(crate) const BRIGHT: Color32 = Color32::from_rgb(120, 232, 214);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance [WCAG 2.1].
    fn luminance(color: Color32) -> f64 {
        let linear = |value: u8| match f64::from(value) / 255.0 {
            value if value <= 0.03928 => value / 12.92,
            value => ((value + 0.055) / 1.055).powf(2.4),
        };
        let [red, green, blue, _] = color.to_array();
        0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue)
    }

    fn contrast(one: Color32, other: Color32) -> f64 {
        let (one, other) = (luminance(one), luminance(other));
        (one.max(other) + 0.05) / (one.min(other) + 0.05)
    }

    /// Judge: the formula and the 4.5 of the Web Content Accessibility Guidelines 2.1, level AA.
    #[test]
    fn texts_are_readable() {
        // Panels, and entries of the start screen.
        for ground in [(22, 25, 30), (30, 34, 41)] {
            let ground = Color32::from_rgb(ground.0, ground.1, ground.2);
            for text in [WHITE, QUIET, FAULT, WARNING, FORCE, DEPTH] {
                let found = contrast(text, ground);
                assert!(found >= 4.5, "{text:?}: {found}");
            }
        }
        // A lit liver, in a picture of the window.
        let liver = Color32::from_rgb(133, 44, 33);
        for text in [LEFT, BRIGHT] {
            let found = contrast(text, liver);
            assert!(found >= 4.5, "{text:?}: {found}");
        }
    }
}
