//! The card on which a trainee states how large the lump is.

use eframe::egui::{self, RichText, Ui};

use super::attempt::DIAMETERS;
use super::cards::AttemptAction;
use super::page::{main_button, or_key, quiet};
use super::texts::text;
use crate::style::WHITE;

/// Shows the card; `diameter` [mm] is none until somebody sets it.
pub(super) fn show(ui: &mut Ui, diameter: &mut Option<u32>, asked: &mut Option<AttemptAction>) {
    let [least, most] = DIAMETERS;
    ui.add_space(4.0);
    let title = RichText::new(text!("diameter-title")).size(16.0);
    ui.label(title.strong().color(WHITE));
    let mut value = diameter.unwrap_or(least);
    let slider = egui::Slider::new(&mut value, least..=most)
        .text(text!("diameter-slider"))
        .show_value(diameter.is_some());
    let slider = ui.add(slider);
    if slider.changed() || slider.clicked() {
        *diameter = Some(value);
    }
    if slider.drag_stopped() {
        // The keys of the hands go on.
        slider.surrender_focus();
    }
    ui.horizontal_wrapped(|ui| {
        ui.add_enabled_ui(diameter.is_some(), |ui| {
            let state = main_button(ui, &text!("diameter-state"));
            if state.clicked() {
                *asked = Some(AttemptAction::State);
            }
        });
        ui.label(quiet(match diameter {
            None => text!("diameter-keys"),
            Some(_) => or_key("Enter"),
        }));
    });
}

#[cfg(test)]
mod tests {
    use eframe::egui::accesskit::Role;

    use super::*;
    use crate::window::test_page::TestPage;

    /// Judge: the accessibility tree that the window gives, and what a person clicks in it.
    #[test]
    fn a_diameter_is_set_before_it_can_be_stated() {
        let (mut diameter, mut asked) = (None, None);
        let mut seen = TestPage::default();
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        assert!(
            seen.has(Role::Label, &text!("diameter-title"))
                && seen.has(Role::Slider, &text!("diameter-slider"))
        );
        seen.click(Role::Button, &text!("diameter-state"));
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        assert_eq!((diameter, asked), (None, None), "nothing is set yet");
        seen.click(Role::Slider, &text!("diameter-slider"));
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        let [least, most] = DIAMETERS;
        let middle = f64::from(least + most) / 2.0;
        // Judge: the middle of the slider is that of its range. Tolerance: the slider contains its value and name.
        let set = f64::from(diameter.unwrap());
        assert!((set - middle).abs() <= 18.0, "{set}");
        seen.click(Role::Button, &text!("diameter-state"));
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        seen.show(|ui| show(ui, &mut diameter, &mut asked));
        assert_eq!(asked, Some(AttemptAction::State));
    }
}
