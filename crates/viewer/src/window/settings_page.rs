//! The page of settings. What is changed is kept at once.

use std::path::PathBuf;

use eframe::egui::{self, Frame, Key, Margin, RichText, Slider, Ui};
use palpate_files::{MouseHand, Settings};

use super::settings::{CacheUse, NamedFolder, WindowSettings};
use super::texts;
use crate::style::{DEPTH, FAULT, QUIET, WHITE};

/// The page, while it is shown.
pub(super) struct SettingsPage {
    /// The folder of sessions as it is typed.
    training_folder: String,
    /// The scale while the slider is dragged [-].
    scale: f64,
    folders: Vec<NamedFolder>,
    cache: Result<CacheUse, String>,
    /// None until somebody looks for them.
    devices: Option<Vec<String>>,
    /// Whether the folder was changed.
    is_folder_changed: bool,
}

impl SettingsPage {
    pub(super) fn new(own: &WindowSettings) -> Self {
        let folder = own.settings.training_folder.as_ref();
        Self {
            training_folder: folder.map_or(String::new(), |path| path.display().to_string()),
            scale: own.settings.scale,
            folders: own.keeper.folders(),
            cache: own.keeper.cache(),
            devices: None,
            is_folder_changed: false,
        }
    }

    /// Shows it; whether somebody leaves it.
    pub(super) fn show(&mut self, ui: &mut Ui, own: &mut WindowSettings) -> bool {
        let mut is_left = ui.input(|input| input.key_pressed(Key::Escape));
        let margin = Margin::symmetric(28, 20);
        Frame::new().inner_margin(margin).show(ui, |ui| {
            egui::ScrollArea::vertical()
                .auto_shrink([false, false])
                .show(ui, |ui| {
                    ui.label(RichText::new(texts::SETTINGS).size(34.0).color(WHITE));
                    if let Some(trouble) = &own.trouble {
                        ui.colored_label(FAULT, trouble);
                    }
                    hands(ui, own);
                    self.display(ui, own);
                    self.folders(ui, own);
                    self.cache(ui, own);
                    self.devices(ui, own);
                    ui.add_space(18.0);
                    let back = ui.button(texts::BACK).on_hover_text(texts::BACK_HINT);
                    is_left |= back.clicked();
                });
        });
        is_left
    }

    fn display(&mut self, ui: &mut Ui, own: &mut WindowSettings) {
        heading(ui, texts::DISPLAY);
        let [least, most] = Settings::SCALES;
        let slider = Slider::new(&mut self.scale, least..=most)
            .step_by(0.05)
            .custom_formatter(|scale, _| format!("{:.0} %", 100.0 * scale))
            .text(texts::SCALE);
        let slider = ui.add(slider);
        if slider.drag_stopped() || slider.changed() && !slider.dragged() {
            own.change(Settings {
                scale: self.scale,
                ..own.settings.clone()
            });
        }
    }

    fn folders(&mut self, ui: &mut Ui, own: &mut WindowSettings) {
        heading(ui, texts::FOLDERS);
        egui::Grid::new("folders")
            .num_columns(2)
            .spacing([18.0, 4.0])
            .show(ui, |ui| {
                for folder in &self.folders {
                    ui.label(folder.name);
                    let path = folder.path.display().to_string();
                    ui.label(RichText::new(path).color(QUIET));
                    ui.end_row();
                }
            });
        ui.horizontal(|ui| {
            let label = ui.label(texts::TRAINING_FOLDER);
            let field = egui::TextEdit::singleline(&mut self.training_folder)
                .hint_text(texts::TRAINING_FOLDER_HINT)
                .desired_width(360.0);
            ui.add(field).labelled_by(label.id);
            if ui.button(texts::SAVE_FOLDER).clicked() {
                let typed = self.training_folder.trim();
                let folder = (!typed.is_empty()).then(|| {
                    let typed = PathBuf::from(typed);
                    // The program may be started elsewhere next time.
                    std::path::absolute(&typed).unwrap_or(typed)
                });
                self.is_folder_changed |= folder != own.settings.training_folder;
                own.change(Settings {
                    training_folder: folder,
                    ..own.settings.clone()
                });
            }
        });
        if self.is_folder_changed && own.trouble.is_none() {
            ui.label(RichText::new(texts::NEXT_START).color(DEPTH));
        }
    }

    fn cache(&mut self, ui: &mut Ui, own: &mut WindowSettings) {
        heading(ui, texts::CACHE);
        match &self.cache {
            Ok(cache) => {
                let files = if cache.files == 1 { "file" } else { "files" };
                ui.label(format!(
                    "{} {files}, {:.1} MB",
                    cache.files,
                    1e-6 * cache.bytes as f64
                ));
            }
            Err(trouble) => {
                ui.colored_label(FAULT, trouble);
            }
        }
        let clear = ui.button(texts::CLEAR_CACHE);
        if clear.on_hover_text(texts::CLEAR_HINT).clicked() {
            self.cache = own.keeper.clear_cache();
        }
    }

    fn devices(&mut self, ui: &mut Ui, own: &WindowSettings) {
        heading(ui, texts::DEVICES);
        for line in self.devices.iter().flatten() {
            ui.label(RichText::new(line).color(QUIET));
        }
        if ui.button(texts::LOOK_FOR_DEVICES).clicked() {
            self.devices = Some(own.keeper.devices());
        }
    }
}

fn heading(ui: &mut Ui, words: &str) {
    ui.add_space(14.0);
    ui.label(RichText::new(words).size(20.0).color(WHITE));
    ui.add_space(2.0);
}

fn hands(ui: &mut Ui, own: &mut WindowSettings) {
    heading(ui, texts::HANDS);
    ui.label(texts::MOUSE_HAND);
    let mut hand = own.settings.mouse_hand;
    let all = [MouseHand::Scene, MouseHand::Left, MouseHand::Right];
    for (each, words) in all.into_iter().zip(texts::MOUSE_HANDS) {
        ui.radio_value(&mut hand, each, words);
    }
    own.change(Settings {
        mouse_hand: hand,
        ..own.settings.clone()
    });
    ui.label(RichText::new(texts::OTHER_HAND).color(QUIET));
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::rc::Rc;

    use eframe::egui::accesskit::Role;

    use super::super::settings::SettingsKeeper;
    use super::*;
    use crate::window::seen::Seen;

    /// Keeps settings in memory, until the disk is full.
    struct Memory {
        saved: Rc<RefCell<Vec<Settings>>>,
        is_full: bool,
        cached: usize,
    }

    impl SettingsKeeper for Memory {
        fn save(&mut self, settings: &Settings) -> Result<(), String> {
            if self.is_full {
                return Err("the disk is full".to_owned());
            }
            self.saved.borrow_mut().push(settings.clone());
            Ok(())
        }

        fn devices(&self) -> Vec<String> {
            vec!["a device of the test".to_owned()]
        }

        fn folders(&self) -> Vec<NamedFolder> {
            Vec::new()
        }

        fn cache(&self) -> Result<CacheUse, String> {
            Ok(CacheUse {
                files: self.cached,
                bytes: 2_000_000 * self.cached as u64,
            })
        }

        fn clear_cache(&mut self) -> Result<CacheUse, String> {
            self.cached = 0;
            self.cache()
        }
    }

    fn shown(is_full: bool) -> (Rc<RefCell<Vec<Settings>>>, WindowSettings) {
        let saved = Rc::default();
        let keeper = Memory {
            saved: Rc::clone(&saved),
            is_full,
            cached: 3,
        };
        let own = WindowSettings {
            settings: Settings::default(),
            trouble: None,
            keeper: Box::new(keeper),
        };
        (saved, own)
    }

    /// Shows the page with the press, with the release, and with what came of it.
    fn look(seen: &mut Seen, page: &mut SettingsPage, own: &mut WindowSettings) -> bool {
        let mut is_left = false;
        for _ in 0..3 {
            seen.show(|ui| is_left |= page.show(ui, own));
        }
        is_left
    }

    /// Judge: the accessibility tree, and what is kept.
    #[test]
    fn settings_are_changed_by_what_a_screen_reader_reads() {
        let (saved, mut own) = shown(false);
        let mut page = SettingsPage::new(&own);
        let mut seen = Seen::default();
        look(&mut seen, &mut page, &mut own);
        assert!(saved.borrow().is_empty(), "nothing is changed yet");
        for (role, label) in [
            (Role::Slider, texts::SCALE),
            (Role::Button, texts::CLEAR_CACHE),
            (Role::Button, texts::LOOK_FOR_DEVICES),
            (Role::Button, texts::SAVE_FOLDER),
            (Role::Button, texts::BACK),
            (Role::Label, "3 files, 6.0 MB"),
        ] {
            assert!(seen.has(role, label), "{label}: {:?}", seen.labels());
        }
        seen.click(Role::RadioButton, texts::MOUSE_HANDS[1]);
        assert!(!look(&mut seen, &mut page, &mut own));
        assert_eq!(saved.borrow().last().unwrap().mouse_hand, MouseHand::Left);
        seen.click(Role::Slider, texts::SCALE);
        look(&mut seen, &mut page, &mut own);
        let scale = saved.borrow().last().unwrap().scale;
        assert!(scale != 1.0 && scale == own.settings.scale, "{scale}");
        seen.click(Role::Button, texts::CLEAR_CACHE);
        look(&mut seen, &mut page, &mut own);
        assert!(seen.has(Role::Label, "0 files, 0.0 MB"));
        seen.click(Role::Button, texts::LOOK_FOR_DEVICES);
        look(&mut seen, &mut page, &mut own);
        assert!(seen.has(Role::Label, "a device of the test"));
        seen.click(Role::Button, texts::BACK);
        assert!(look(&mut seen, &mut page, &mut own));
    }

    /// By keys alone: Tab to the first radio button, Space on the next one, Escape leaves.
    #[test]
    fn settings_are_changed_by_keys() {
        let (saved, mut own) = shown(false);
        let mut page = SettingsPage::new(&own);
        let mut seen = Seen::default();
        look(&mut seen, &mut page, &mut own);
        for key in [Key::Tab, Key::Tab, Key::Space] {
            seen.press(key);
            look(&mut seen, &mut page, &mut own);
        }
        assert_eq!(saved.borrow().last().unwrap().mouse_hand, MouseHand::Left);
        seen.press(Key::Escape);
        // The first Escape lets go of the button.
        let is_left = look(&mut seen, &mut page, &mut own);
        assert!(is_left);
    }

    #[test]
    fn what_is_not_kept_is_told() {
        let (_, mut own) = shown(true);
        let mut page = SettingsPage::new(&own);
        let mut seen = Seen::default();
        look(&mut seen, &mut page, &mut own);
        seen.click(Role::RadioButton, texts::MOUSE_HANDS[2]);
        look(&mut seen, &mut page, &mut own);
        look(&mut seen, &mut page, &mut own);
        assert!(seen.has(Role::Label, "the disk is full"));
    }
}
