//! A person's settings for the window, and their store.

use std::path::PathBuf;

use palpate_files::{Language, Settings};

/// The settings of a window.
pub struct WindowSettings {
    /// The settings.
    pub settings: Settings,
    /// The language that the environment names.
    pub environment: Language,
    /// The language that was asked for at this start, if any; until another one is set.
    pub asked_language: Option<Language>,
    /// Why the settings differ from the stored ones, or cannot be stored; in a sentence.
    pub error: Option<String>,
    /// The store of the settings.
    pub store: Box<dyn SettingsStore>,
}

/// Use of a folder or file of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FolderContent {
    /// Sessions and results.
    Sessions,
    /// The settings.
    Settings,
    /// Prepared organs.
    Cache,
}

/// A folder or file that the program uses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedFolder {
    /// Its contents.
    pub content: FolderContent,
    /// Where it is.
    pub path: PathBuf,
}

/// How much is cached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CacheUse {
    /// Number of files.
    pub files: usize,
    /// Their size [B].
    pub bytes: u64,
}

/// The store of settings, and the setup of this machine.
pub trait SettingsStore {
    /// Keeps the settings.
    ///
    /// # Errors
    /// When they cannot be stored; in a sentence.
    fn save(&mut self, settings: &Settings) -> Result<(), String>;

    /// Haptic devices that are connected, and why others are not; a sentence each. It may take seconds.
    fn devices(&self) -> Vec<String>;

    /// The folders and files that the program uses.
    fn folders(&self) -> Vec<NamedFolder>;

    /// How much is cached.
    ///
    /// # Errors
    /// When the cache cannot be read; in a sentence.
    fn cache(&self) -> Result<CacheUse, String>;

    /// Removes what is cached; how much is left.
    ///
    /// # Errors
    /// When it cannot be removed; in a sentence.
    fn clear_cache(&mut self) -> Result<CacheUse, String>;
}

impl WindowSettings {
    /// The language of the texts.
    pub(super) fn language(&self) -> Language {
        let asked = self.asked_language.unwrap_or(self.settings.language);
        match asked {
            Language::System => self.environment,
            language => language,
        }
    }

    /// Takes over what a person set, and keeps it.
    pub(super) fn change(&mut self, settings: Settings) {
        if self.settings != settings {
            if self.settings.language != settings.language {
                self.asked_language = None;
            }
            self.error = self.store.save(&settings).err();
            self.settings = settings;
        }
    }
}
