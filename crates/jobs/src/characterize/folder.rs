//! A folder that keeps what is finished of a study, so that the study can be stopped and gone on with.
//!
//! Each specimen has two files, `liver-7.json` with all that was found and `liver-7.toml` with its tissue.
//! The first names what it was found from, by a digest of recordings and settings: what does not fit, or
//! cannot be read, is found again.

use std::fs;
use std::path::{Path, PathBuf};

use palpate_characterize::CharacterizeSettings;
use palpate_files::{MOST_OF_TABLE, read_text, write_whole};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::answer::Specimen;
use super::finished::Finished;
use crate::{Error, ReadRecording, VERSION, Watch, hexadecimal, json_text};

/// The folder of a study.
#[derive(Debug)]
pub struct StudyFolder {
    path: PathBuf,
}

/// Where one specimen is kept.
pub(crate) struct Kept {
    json: PathBuf,
    digest: String,
}

/// A file of a folder.
#[derive(Serialize, Deserialize)]
struct Document<T> {
    palpate: String,
    digest: String,
    #[serde(flatten)]
    finished: T,
}

impl StudyFolder {
    /// The folder at `path`, made if it is not there.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn open(path: &Path) -> Result<Self, Error> {
        fs::create_dir_all(path).map_err(|error| {
            let path = path.display();
            Error::input(format!(
                "the folder {path} cannot be made ({error}); give another with --study"
            ))
        })?;
        let path = path.to_owned();
        Ok(Self { path })
    }

    /// Where the specimen at `place` of `groups` is kept.
    pub(crate) fn kept(
        &self,
        groups: &[Vec<ReadRecording>],
        place: usize,
        settings: &CharacterizeSettings,
    ) -> Kept {
        let name = |group: &[ReadRecording]| {
            file_name(&Specimen::title(&group[0].clean.header, &group[0].path))
        };
        let own = name(&groups[place]);
        let before = groups[..place].iter().filter(|group| name(group) == own);
        let stem = match before.count() {
            0 => own,
            earlier => format!("{own}-{}", earlier + 1),
        };
        Kept {
            json: self.path.join(format!("{stem}.json")),
            digest: digest(&groups[place], settings),
        }
    }

    /// Writes a table of the whole study.
    pub(crate) fn write(&self, name: &str, text: &str) -> Result<(), Error> {
        Ok(write_whole(self.path.join(name), text.as_bytes())?)
    }
}

impl Kept {
    /// What was finished before of the same recordings, in the same way.
    pub(crate) fn read(&self) -> Option<Finished> {
        let text = read_text(&self.json, MOST_OF_TABLE).ok()?;
        let document: Document<Finished> = serde_json::from_str(&text).ok()?;
        let fits = document.digest == self.digest && document.palpate == VERSION;
        fits.then_some(document.finished)
    }

    pub(crate) fn write(&self, finished: &Finished, watch: &dyn Watch) -> Result<(), Error> {
        let text = json_text(&Document {
            palpate: VERSION.to_owned(),
            digest: self.digest.clone(),
            finished,
        })?;
        let mut written = Ok(());
        watch.unbroken(&mut || written = self.write_both(finished, &text));
        written
    }

    fn write_both(&self, finished: &Finished, text: &str) -> Result<(), Error> {
        if let Ok(tissue) = &finished.tissue {
            write_whole(self.json.with_extension("toml"), tissue.as_bytes())?;
        }
        // Last, since it says that all is there.
        Ok(write_whole(&self.json, text.as_bytes())?)
    }
}

/// `title` as a name of a file on any system.
fn file_name(title: &str) -> String {
    let plain = |letter: char| match letter.is_alphanumeric() {
        true => letter,
        false => '-',
    };
    let spaced: String = title.chars().map(plain).collect();
    let words: Vec<&str> = spaced.split('-').filter(|word| !word.is_empty()).collect();
    match words.as_slice() {
        [] => "specimen".to_owned(),
        words => words.join("-"),
    }
}

/// What a specimen is found from: names, headers and samples of its recordings, and the settings.
fn digest(group: &[ReadRecording], settings: &CharacterizeSettings) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{settings:?}"));
    for read in group {
        let clean = &read.clean;
        hash.update(format!("{}{:?}", read.path.display(), clean.header));
        for samples in [&clean.time, &clean.depth, &clean.force] {
            for sample in samples {
                hash.update(sample.to_le_bytes());
            }
        }
    }
    hexadecimal(&hash.finalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_names_of_files() {
        assert_eq!(file_name("liver, 3/left lobe"), "liver-3-left-lobe");
        assert_eq!(file_name("../.."), "specimen");
    }
}
