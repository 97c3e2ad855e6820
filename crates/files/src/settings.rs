//! Settings of the window, in a file of the user.

use std::fmt::Write;
use std::ops::Bound::Included;
use std::path::{Path, PathBuf};

use crate::toml_document::{Document, quoted, toml_number};
use crate::words::words;
use crate::{Domain, Error, Key, Keys, write_atomically};

words! {
    /// Whose tool the mouse moves at first.
    pub enum MouseHand {
        /// The one that the scene gives to the mouse.
        Scene = "scene",
        /// The left hand's.
        Left = "left",
        /// The right hand's.
        Right = "right",
    }
}

words! {
    /// The language of the trainer's window.
    pub enum Language {
        /// The one that the environment names (LC_ALL, LC_MESSAGES, LANG).
        System = "system",
        /// English.
        English = "en",
        /// German.
        German = "de",
        /// French.
        French = "fr",
    }
}

/// The settings of a user.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Whose tool the mouse moves at first.
    pub mouse_hand: MouseHand,
    /// The language of the trainer's window.
    pub language: Language,
    /// The scale of texts and buttons, relative to that of the display [-].
    pub scale: f64,
    /// The folder of sessions and results; none for that of the system.
    pub training_folder: Option<PathBuf>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            mouse_hand: MouseHand::Scene,
            language: Language::System,
            scale: 1.0,
            training_folder: None,
        }
    }
}

/// Scales at which texts fit into the smallest window and are readable [-].
const SCALE: Domain = Domain::number("a factor", [Included(0.75), Included(2.0)]);

impl Settings {
    /// The keys of the file.
    pub const KEYS: &'static [Key] = &[
        Key::word(
            "mouse_hand",
            MouseHand::MEANINGS,
            "Whose tool the mouse moves at first.",
        )
        .optional("\"scene\"", "\"scene\""),
        Key::word(
            "language",
            Language::MEANINGS,
            "The language of the trainer's window; `palpate --language` overrides it.",
        )
        .optional("\"system\"", "\"system\""),
        Key::number(
            "scale",
            SCALE,
            "The size of texts and buttons beside that of the display.",
        )
        .optional("1.0", "1"),
        Key::path(
            "training_folder",
            "The folder of sessions and results; the variable PALPATE_TRAINING overrides it.",
        )
        .optional("\"training\"", "the data folder of the system"),
    ];

    /// Least and largest [`Self::scale`] [-].
    pub const SCALES: [f64; 2] = [0.75, 2.0];

    /// Reads a file; without one all settings have their defaults.
    ///
    /// # Errors
    /// When there is a file and it cannot be read, or holds no settings.
    pub fn read(path: &Path) -> Result<Self, Error> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let mut settings = Self::of(&Document::read(path)?)?;
        if let (Some(folder), Some(base)) = (&mut settings.training_folder, path.parent()) {
            *folder = base.join(&*folder);
        }
        Ok(settings)
    }

    fn of(document: &Document) -> Result<Self, Error> {
        let keys: Keys<'_> = document.keys(Self::KEYS)?;
        let hand = keys.word("mouse_hand", MouseHand::WORDS)?;
        let language = keys.word("language", Language::WORDS)?;
        Ok(Self {
            mouse_hand: hand.unwrap_or(MouseHand::Scene),
            language: language.unwrap_or(Language::System),
            scale: keys.number("scale")?.unwrap_or(1.0),
            training_folder: keys.text("training_folder")?.map(PathBuf::from),
        })
    }

    /// The text of the file.
    pub fn print(&self) -> String {
        let mut text = format!(
            "# What is set in palpate's window.\nformat = 1\nmouse_hand = {}\nlanguage = {}\nscale = {}\n",
            quoted(self.mouse_hand.word()),
            quoted(self.language.word()),
            toml_number(self.scale)
        );
        if let Some(folder) = &self.training_folder {
            let folder = quoted(&folder.to_string_lossy());
            writeln!(text, "training_folder = {folder}").expect("a string takes every text");
        }
        text
    }

    /// Writes the file whole or not at all, and its folder where that is missing.
    ///
    /// # Errors
    /// When the operating system refuses; the file is then as it was.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|source| Error::write(folder, source))?;
        }
        write_atomically(path, self.print().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_read_as_they_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/settings.toml");
        assert_eq!(Settings::read(&path).unwrap(), Settings::default());
        for settings in [
            Settings::default(),
            Settings {
                mouse_hand: MouseHand::Left,
                language: Language::German,
                scale: 1.3,
                training_folder: Some(PathBuf::from("/C:\\a \"b\"/c")),
            },
        ] {
            settings.write(&path).unwrap();
            assert_eq!(Settings::read(&path).unwrap(), settings);
            let files = std::fs::read_dir(path.parent().unwrap()).unwrap();
            assert_eq!(files.count(), 1, "nothing is left beside the file");
        }
    }

    /// Each error is one sentence with the file and the line or key.
    #[test]
    fn damaged_settings_give_an_error() {
        for (text, word) in [
            ("format = 1\nscale = 9.0\n", "scale"),
            ("format = 1\nmouse_hand = \"third\"\n", "mouse_hand"),
            ("format = 1\nlanguage = \"german\"\n", "language"),
            ("format = 1\nscael = 1.0\n", "scael"),
            ("format = 1\nscale = \n", "line 2"),
            ("\u{0}", "settings.toml"),
        ] {
            let error = Document::parse(text, "settings.toml")
                .and_then(|document| Settings::of(&document))
                .unwrap_err();
            let error = error.to_string();
            assert!(
                error.contains("settings.toml") && error.contains(word),
                "{error}"
            );
        }
    }
}
