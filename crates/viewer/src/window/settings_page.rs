//! The page of settings. Changes are stored at once.

use std::path::PathBuf;

use eframe::egui::{self, RichText, Slider, Ui};
use palpate_files::{Language, MouseHand, Settings};

use super::hands::gamepads::gamepads;
use super::page::{self, heading, quiet};
use super::settings::{CacheUse, FolderContent, NamedFolder, WindowSettings};
use super::texts::{self, decimal, text};
use crate::style::{DEPTH, FAULT};

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
            folders: own.store.folders(),
            cache: own.store.cache(),
            devices: None,
            is_folder_changed: false,
        }
    }

    /// Shows it; whether somebody leaves it.
    pub(super) fn show(&mut self, ui: &mut Ui, own: &mut WindowSettings) -> bool {
        page::closable_page(ui, &text!("settings-title"), |ui| {
            if let Some(error) = &own.error {
                ui.colored_label(FAULT, error);
            }
            hands(ui, own);
            language(ui, own);
            self.display(ui, own);
            self.folders(ui, own);
            self.cache(ui, own);
            self.devices(ui, own);
        })
    }

    fn display(&mut self, ui: &mut Ui, own: &mut WindowSettings) {
        heading(ui, &text!("settings-display"));
        let [least, most] = Settings::SCALES;
        let slider = Slider::new(&mut self.scale, least..=most)
            .step_by(0.05)
            .custom_formatter(|scale, _| format!("{:.0} %", 100.0 * scale))
            .text(text!("settings-scale"));
        let slider = ui.add(slider);
        if slider.drag_stopped() || slider.changed() && !slider.dragged() {
            own.change(Settings {
                scale: self.scale,
                ..own.settings.clone()
            });
        }
    }

    fn folders(&mut self, ui: &mut Ui, own: &mut WindowSettings) {
        heading(ui, &text!("settings-folders"));
        egui::Grid::new("folders")
            .num_columns(2)
            .spacing([18.0, 4.0])
            .show(ui, |ui| {
                for folder in &self.folders {
                    ui.label(text!(match folder.content {
                        FolderContent::Sessions => "settings-sessions",
                        FolderContent::Settings => "settings-file",
                        FolderContent::Cache => "settings-cached",
                    }));
                    ui.label(quiet(folder.path.display().to_string()));
                    ui.end_row();
                }
            });
        ui.horizontal_wrapped(|ui| {
            let label = ui.label(text!("settings-training-folder"));
            let field = egui::TextEdit::singleline(&mut self.training_folder)
                .hint_text(text!("settings-training-hint"))
                .desired_width(360.0);
            ui.add(field).labelled_by(label.id);
            if ui.button(text!("settings-set-folder")).clicked() {
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
        if self.is_folder_changed && own.error.is_none() {
            ui.label(RichText::new(text!("settings-next-start")).color(DEPTH));
        }
    }

    fn cache(&mut self, ui: &mut Ui, own: &mut WindowSettings) {
        heading(ui, &text!("settings-cache"));
        match &self.cache {
            Ok(cache) => {
                let size = decimal(1e-6 * cache.bytes as f64, 1);
                ui.label(text!("settings-cache-use", files = cache.files, mb = size));
            }
            Err(error) => {
                ui.colored_label(FAULT, error);
            }
        }
        let clear = ui.button(text!("settings-clear-cache"));
        if clear.on_hover_text(text!("settings-clear-hint")).clicked() {
            self.cache = own.store.clear_cache();
        }
    }

    fn devices(&mut self, ui: &mut Ui, own: &WindowSettings) {
        heading(ui, &text!("settings-devices"));
        for line in self.devices.iter().flatten() {
            ui.label(quiet(line));
        }
        if ui.button(text!("settings-find-devices")).clicked() {
            let pads = gamepads();
            let mut devices = own.store.devices();
            match pads.as_slice() {
                [] => devices.push(text!("settings-no-gamepad")),
                pads => devices.extend(
                    pads.iter()
                        .map(|name| text!("settings-gamepad", name = name)),
                ),
            }
            self.devices = Some(devices);
        }
    }
}

/// The choices of a mouse's hand, with the keys of their texts.
const MOUSE_HANDS: [(MouseHand, &str); 3] = [
    (MouseHand::Scene, "settings-mouse-scene"),
    (MouseHand::Left, "settings-mouse-left"),
    (MouseHand::Right, "settings-mouse-right"),
];

fn hands(ui: &mut Ui, own: &mut WindowSettings) {
    heading(ui, &text!("settings-hands"));
    ui.label(text!("settings-mouse"));
    let mut hand = own.settings.mouse_hand;
    for (each, key) in MOUSE_HANDS {
        ui.radio_value(&mut hand, each, text!(key));
    }
    own.change(Settings {
        mouse_hand: hand,
        ..own.settings.clone()
    });
    ui.label(quiet(text!("settings-other-hand")));
}

fn language(ui: &mut Ui, own: &mut WindowSettings) {
    heading(ui, &text!("settings-language"));
    let mut language = own.asked_language.unwrap_or(own.settings.language);
    let before = language;
    ui.radio_value(&mut language, Language::System, text!("settings-system"));
    for (each, name) in texts::languages() {
        ui.radio_value(&mut language, each, name);
    }
    if language != before {
        own.asked_language = None;
        own.change(Settings {
            language,
            ..own.settings.clone()
        });
        texts::set_language(own.language());
    }
    let [translated, all] = texts::translated();
    let words = text!("settings-translated", translated = translated, all = all);
    ui.label(quiet(words));
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::rc::Rc;

    use eframe::egui::Key;
    use eframe::egui::accesskit::Role;

    use super::super::settings::SettingsStore;
    use super::*;
    use crate::window::test_page::TestPage;

    /// Keeps settings in memory, until the disk is full.
    struct Memory {
        saved: Rc<RefCell<Vec<Settings>>>,
        is_full: bool,
        cached: usize,
    }

    impl SettingsStore for Memory {
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
            environment: Language::English,
            asked_language: None,
            error: None,
            store: Box::new(keeper),
        };
        (saved, own)
    }

    /// Shows the page with the press, with the release, and with what came of it.
    fn look(seen: &mut TestPage, page: &mut SettingsPage, own: &mut WindowSettings) -> bool {
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
        let mut seen = TestPage::default();
        look(&mut seen, &mut page, &mut own);
        assert!(saved.borrow().is_empty(), "nothing is changed yet");
        for (role, label) in [
            (Role::Slider, &text!("settings-scale")),
            (Role::Button, &text!("settings-clear-cache")),
            (Role::Button, &text!("settings-find-devices")),
            (Role::Button, &text!("settings-set-folder")),
            (Role::Button, &text!("common-back")),
            (Role::Label, &"3 files, 6.0 MB".to_owned()),
        ] {
            assert!(seen.has(role, label), "{label}: {:?}", seen.labels());
        }
        seen.click(Role::RadioButton, &text!("settings-mouse-left"));
        assert!(!look(&mut seen, &mut page, &mut own));
        assert_eq!(saved.borrow().last().unwrap().mouse_hand, MouseHand::Left);
        seen.click(Role::Slider, &text!("settings-scale"));
        look(&mut seen, &mut page, &mut own);
        let scale = saved.borrow().last().unwrap().scale;
        assert!(scale != 1.0 && scale == own.settings.scale, "{scale}");
        seen.click(Role::Button, &text!("settings-clear-cache"));
        look(&mut seen, &mut page, &mut own);
        assert!(seen.has(Role::Label, "0 files, 0.0 MB"));
        seen.click(Role::Button, &text!("settings-find-devices"));
        look(&mut seen, &mut page, &mut own);
        assert!(seen.has(Role::Label, "a device of the test"));
        seen.click(Role::Button, &text!("common-back"));
        assert!(look(&mut seen, &mut page, &mut own));
    }

    /// By keys alone: Tab past the button that leaves to the first radio button, Space on the next one, Escape leaves.
    #[test]
    fn settings_are_changed_by_keys() {
        let (saved, mut own) = shown(false);
        let mut page = SettingsPage::new(&own);
        let mut seen = TestPage::default();
        look(&mut seen, &mut page, &mut own);
        for key in [Key::Tab, Key::Tab, Key::Tab, Key::Space] {
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
        let mut seen = TestPage::default();
        look(&mut seen, &mut page, &mut own);
        seen.click(Role::RadioButton, &text!("settings-mouse-right"));
        look(&mut seen, &mut page, &mut own);
        look(&mut seen, &mut page, &mut own);
        assert!(seen.has(Role::Label, "the disk is full"));
    }
}
