use eframe::egui::{self, Color32, Visuals};

/// Errors.
pub(crate) const FAULT: Color32 = Color32::from_rgb(242, 122, 106);
/// Warnings.
pub(crate) const WARNING: Color32 = Color32::from_rgb(226, 182, 92);
/// The force.
pub(crate) const FORCE: Color32 = Color32::from_rgb(236, 126, 92);
/// The depth, and the mark on the organ.
pub(crate) const DEPTH: Color32 = Color32::from_rgb(84, 196, 178);
/// Secondary text.
pub(crate) const QUIET: Color32 = Color32::from_rgb(150, 158, 168);
/// Primary text.
pub(crate) const WHITE: Color32 = Color32::from_rgb(232, 235, 240);
/// Texts that need no color.
pub(crate) const TEXT: Color32 = Color32::from_rgb(218, 222, 228);
/// The ground of pages, panels and the window.
const GROUND: Color32 = Color32::from_rgb(22, 25, 30);
/// The ground of fields and plots.
const FIELD: Color32 = Color32::from_rgb(13, 15, 18);
/// The ground of an entry of the start screen.
pub(crate) const CARD: Color32 = Color32::from_rgb(30, 34, 41);
/// The ground of a card over the picture, and of texts in it.
pub(crate) const CARD_OVER_PICTURE: Color32 =
    Color32::from_rgba_unmultiplied_const(16, 19, 24, 236);
/// The ground of texts in the picture.
pub(crate) const PLATE: Color32 = Color32::from_black_alpha(210);
/// The button of what is usually done next, and what is chosen.
pub(crate) const ACTION: Color32 = Color32::from_rgb(38, 96, 92);
/// The band of a gauge.
pub(crate) const BAR: Color32 = Color32::from_rgb(50, 118, 107);
/// One trainee versus the mean of all.
pub(crate) const EACH: Color32 = Color32::from_rgb(104, 112, 124);
/// Remaining work on an organ, and the solution: everybody sees yellow on red.
pub(crate) const LEFT: Color32 = Color32::from_rgb(255, 224, 92);
/// Actions or marks of somebody else on an organ.
pub(crate) const BRIGHT: Color32 = Color32::from_rgb(120, 232, 214);
/// The button of the emergency stop.
pub(crate) const STOP: Color32 = Color32::from_rgb(196, 32, 28);
/// What is written on it.
pub(crate) const ON_STOP: Color32 = Color32::WHITE;

/// Effect of the emergency stop.
pub(crate) const STOP_HINT: &str =
    "no force at once (space bar); it stays so until it is armed again";

/// Dark, so that the organ is what is bright.
pub(crate) fn apply(context: &egui::Context) {
    let mut visuals = Visuals::dark();
    // The window is cleared to their ground, which costs less than to fill them where the processor draws.
    visuals.panel_fill = Color32::TRANSPARENT;
    visuals.window_fill = GROUND;
    visuals.extreme_bg_color = FIELD;
    visuals.override_text_color = Some(TEXT);
    visuals.selection.bg_fill = ACTION;
    context.set_theme(egui::Theme::Dark);
    context.set_visuals(visuals);
}

/// Background of a window before its elements are drawn.
pub(crate) fn cleared() -> [f32; 4] {
    GROUND.to_normalized_gamma_f32()
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

    /// A color over another one that shines through.
    fn over(own: Color32, ground: Color32) -> Color32 {
        ground.blend(own)
    }

    /// The least contrast of some colors on some grounds; each is at least `least`.
    fn least_contrast(colors: &[Color32], grounds: &[Color32], least: f64) -> f64 {
        let mut found = f64::INFINITY;
        for color in colors {
            for ground in grounds {
                let own = contrast(*color, *ground);
                assert!(own >= least, "{color:?} on {ground:?}: {own}");
                found = found.min(own);
            }
        }
        found
    }

    /// Judge: the formula of the Web Content Accessibility Guidelines 2.1, and its level AA: 4.5 for texts, 3 for
    /// graphics. `docs/how_to/use_the_trainer.md` states the least values.
    #[test]
    fn texts_and_graphics_have_contrast() {
        // A lit liver, in a picture of the window; a card lets it shine through, and white is the brightest picture.
        let liver = Color32::from_rgb(133, 44, 33);
        let card = over(CARD_OVER_PICTURE, liver);
        let bright_card = over(CARD_OVER_PICTURE, Color32::WHITE);
        let pages = [GROUND, CARD, FIELD, card, bright_card];
        let plates = [liver, Color32::WHITE].map(|ground| over(PLATE, ground));
        let texts = [WHITE, TEXT, QUIET, FAULT, WARNING, FORCE, DEPTH];
        let found = [
            least_contrast(&texts, &pages, 4.5),
            // In the picture, on a dark plate.
            least_contrast(&[TEXT, QUIET, WARNING], &plates, 4.5),
            least_contrast(&[LEFT, BRIGHT], &[liver], 4.5),
            least_contrast(&[WHITE], &[ACTION], 4.5),
            least_contrast(&[ON_STOP], &[STOP], 4.5),
            // Graphics: curves, the gauge's band, marks.
            least_contrast(&[DEPTH, FORCE, EACH], &[FIELD], 3.0),
            least_contrast(&[BAR, WHITE, FAULT], &[Color32::BLACK], 3.0),
            least_contrast(&[WHITE], &[BAR], 3.0),
        ];
        let page = include_str!("../../../docs/how_to/use_the_trainer.md");
        let stated = page.lines().filter_map(|line| line.strip_suffix(" : 1 |"));
        let stated = stated.filter_map(|line| Some(line.rsplit_once("| ")?.1));
        let found = found.map(|value| format!("{value:.1}"));
        assert_eq!(
            stated.collect::<Vec<_>>(),
            found,
            "of the page and of the colors"
        );
    }
}
