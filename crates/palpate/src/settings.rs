//! The settings of the window: their file, and the cache, folders and devices that their page shows.

use std::path::PathBuf;

use palpate_devices::{Kind, Places};
use palpate_files::{Language, Settings};
use palpate_jobs::preparation::folder as cache_folder;
use palpate_viewer::settings::{
    CacheUse, FolderContent, NamedFolder, SettingsStore, WindowSettings,
};

use crate::command::cache::{cached_files, remove};
use crate::output;
use crate::training;

/// The variable that names the file of the settings.
const FILE_VARIABLE: &str = "PALPATE_SETTINGS";

/// The file of the settings; none where the system names no folder for it.
fn file() -> Option<PathBuf> {
    let named = std::env::var_os(FILE_VARIABLE).filter(|name| !name.is_empty());
    let own = || Some(dirs::config_dir()?.join("palpate/settings.toml"));
    named.map(PathBuf::from).or_else(own)
}

/// The settings, and, if the file is damaged, a sentence on why the defaults are used instead.
pub(crate) fn read() -> (Settings, Option<String>) {
    let Some(file) = file() else {
        return (Settings::default(), None);
    };
    match Settings::read(&file) {
        Ok(settings) => (settings, None),
        Err(error) => {
            let why = format!(
                "{error}; the default settings are used, and the next change in the window replaces the file"
            );
            (Settings::default(), Some(why))
        }
    }
}

/// The settings of a command without a window, which warns of a damaged file.
pub(crate) fn read_or_warn() -> Settings {
    let (settings, trouble) = read();
    output::warnings(trouble.as_slice());
    settings
}

/// The variables that name a language, the strongest first [POSIX].
const LANGUAGE_VARIABLES: [&str; 3] = ["LC_ALL", "LC_MESSAGES", "LANG"];

/// The language of the first variable that is set; English where the window has no such language.
fn environment() -> Language {
    let mut named = LANGUAGE_VARIABLES.iter().filter_map(std::env::var_os);
    let named = named.find(|value| !value.is_empty());
    let named = named.unwrap_or_default();
    of_locale(&named.to_string_lossy())
}

/// The language of a locale, such as `de_AT.UTF-8`.
fn of_locale(locale: &str) -> Language {
    let word = locale
        .split(['_', '.', '@', '-'])
        .next()
        .unwrap_or_default();
    match Language::from_word(word) {
        None | Some(Language::System) => Language::English,
        Some(language) => language,
    }
}

/// The settings for a window, which shows and changes them; `language` is the option of the command.
pub(crate) fn of_window(language: Option<Language>) -> WindowSettings {
    let (settings, trouble) = read();
    WindowSettings {
        settings,
        environment: environment(),
        asked_language: language,
        error: trouble,
        store: Box::new(Keeper),
    }
}

/// The user's files and devices.
struct Keeper;

impl SettingsStore for Keeper {
    fn save(&mut self, settings: &Settings) -> Result<(), String> {
        let file = file().ok_or_else(|| {
            format!("this system names no folder for settings; name a file by {FILE_VARIABLE}")
        })?;
        settings.write(&file).map_err(|error| error.to_string())
    }

    fn devices(&self) -> Vec<String> {
        let places = match Places::from_environment() {
            Ok(places) => places,
            Err(error) => return vec![error.to_string()],
        };
        let each = Kind::ALL.iter().flat_map(|kind| match kind.list(&places) {
            Ok(found) if found.is_empty() => vec![format!("{kind}: none is plugged in")],
            Ok(found) => {
                let named = found.into_iter();
                named.map(|own| own.capabilities.name.to_string()).collect()
            }
            Err(why) => vec![why.to_string()],
        });
        each.collect()
    }

    fn folders(&self) -> Vec<NamedFolder> {
        let training = training::folder().ok();
        let all = [
            (FolderContent::Sessions, training),
            (FolderContent::Settings, file()),
            (FolderContent::Cache, cache_folder()),
        ];
        let named = all.into_iter();
        named
            .filter_map(|(content, path)| {
                Some(NamedFolder {
                    content,
                    path: path?,
                })
            })
            .collect()
    }

    fn cache(&self) -> Result<CacheUse, String> {
        let cached = match cache_folder() {
            Some(folder) => cached_files(&folder).map_err(|error| error.to_string())?,
            None => Vec::new(),
        };
        Ok(CacheUse {
            files: cached.len(),
            bytes: cached.iter().map(|(_, bytes)| bytes).sum(),
        })
    }

    fn clear_cache(&mut self) -> Result<CacheUse, String> {
        if let Some(folder) = cache_folder() {
            let cached = cached_files(&folder).map_err(|error| error.to_string())?;
            remove(&cached).map_err(|error| error.to_string())?;
        }
        self.cache()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_locale_names_a_language() {
        for (locale, language) in [
            ("de_AT.UTF-8", Language::German),
            ("fr", Language::French),
            ("fr-CH", Language::French),
            ("en_US.UTF-8", Language::English),
            ("C.UTF-8", Language::English),
            ("pl_PL", Language::English),
            ("system", Language::English),
            ("", Language::English),
        ] {
            assert_eq!(of_locale(locale), language, "{locale}");
        }
    }
}
