//! The folder of a study: it stores each finished specimen, so that a stopped study can resume.
//!
//! Each specimen has two files, `liver-7.json` with all results and `liver-7.toml` with its tissue. The first
//! contains a digest of its inputs: recordings, meshes and settings. A file that does not match or cannot be read is
//! recomputed if files may be replaced, and is an error otherwise. `.palpate-study` marks the folder of a study,
//! whose tables are rewritten.

use std::path::{Path, PathBuf};

use palpate_characterize::CharacterizeSettings;
use palpate_files::{Claim, MAX_TABLE_BYTES, Overwrite, read_bytes, read_text, write_atomically};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::answer::Specimen;
use super::finished::Finished;
use crate::{Error, ProgressCallback, ReadRecording, VERSION, hexadecimal, json_text};

/// The folder of a study, locked by this program.
#[derive(Debug)]
pub struct StudyFolder {
    path: PathBuf,
    overwrite: Overwrite,
    _claim: Claim,
}

/// The files of one specimen.
pub(crate) struct SpecimenFile {
    json: PathBuf,
    digest: String,
}

/// The file that marks the folder of a study.
const MARK: &str = ".palpate-study";

/// Tables of a whole study.
pub(crate) const TABLES: [&str; 2] = ["summary.csv", "pooled.csv"];

/// A file of a folder.
#[derive(Serialize, Deserialize)]
struct Document<T> {
    palpate: String,
    digest: String,
    #[serde(flatten)]
    finished: T,
}

impl StudyFolder {
    /// The folder at `path`, which is made where it does not exist.
    ///
    /// # Errors
    /// When it cannot be made, or another program writes there.
    pub fn open(path: &Path, overwrite: Overwrite) -> Result<Self, Error> {
        let claim = Claim::of_folder(path, overwrite);
        let claim = claim.map_err(|error| Error::of_folder("--study", error))?;
        Ok(Self {
            path: path.to_owned(),
            overwrite,
            _claim: claim,
        })
    }

    /// The stored results of the specimens `files`. Marks the folder as that of a study.
    ///
    /// # Errors
    /// When the study would replace a file that is not its own, and may not, or the folder cannot be marked.
    pub(crate) fn begin(&self, files: &[SpecimenFile]) -> Result<Vec<Option<Finished>>, Error> {
        let mark = self.path.join(MARK);
        let finished: Vec<_> = files.iter().map(SpecimenFile::read).collect();
        if self.overwrite == Overwrite::Refused {
            let missing = files.iter().zip(&finished).filter(|(_, own)| own.is_none());
            let missing: Vec<_> = missing.map(|(file, _)| file).collect();
            let mut replaced: Vec<_> = missing.iter().map(|file| file.json.clone()).collect();
            // A stopped study leaves a tissue without results, and old tables.
            if !mark.exists() {
                replaced.extend(missing.iter().map(|file| file.tissue()));
                replaced.extend(TABLES.map(|table| self.path.join(table)));
            }
            if let Some(path) = replaced.into_iter().find(|path| path.exists()) {
                return Err(palpate_files::Error::Exists { path }.into());
            }
        }
        write_atomically(&mark, b"")?;
        Ok(finished)
    }

    /// The files of the specimen at `place` of `groups`.
    pub(crate) fn specimen_file(
        &self,
        groups: &[Vec<ReadRecording>],
        place: usize,
        settings: &CharacterizeSettings,
    ) -> SpecimenFile {
        let name = |group: &[ReadRecording]| {
            file_name(&Specimen::title(&group[0].clean.header, &group[0].path))
        };
        let own = name(&groups[place]);
        let before = groups[..place].iter().filter(|group| name(group) == own);
        let stem = match before.count() {
            0 => own,
            earlier => format!("{own}-{}", earlier + 1),
        };
        SpecimenFile {
            json: self.path.join(format!("{stem}.json")),
            digest: digest(&groups[place], settings),
        }
    }

    /// Writes a table of the whole study.
    pub(crate) fn write(&self, name: &str, text: &str) -> Result<(), Error> {
        Ok(write_atomically(self.path.join(name), text.as_bytes())?)
    }
}

impl SpecimenFile {
    /// The stored results for the same recordings and settings.
    fn read(&self) -> Option<Finished> {
        let text = read_text(&self.json, MAX_TABLE_BYTES).ok()?;
        let document: Document<Finished> = serde_json::from_str(&text).ok()?;
        let fits = document.digest == self.digest && document.palpate == VERSION;
        fits.then_some(document.finished)
    }

    fn tissue(&self) -> PathBuf {
        self.json.with_extension("toml")
    }

    pub(crate) fn write(
        &self,
        finished: &Finished,
        watch: &dyn ProgressCallback,
    ) -> Result<(), Error> {
        let text = json_text(&Document {
            palpate: VERSION.to_owned(),
            digest: self.digest.clone(),
            finished,
        })?;
        let mut written = Ok(());
        watch.without_cancellation(&mut || written = self.write_both(finished, &text));
        written
    }

    fn write_both(&self, finished: &Finished, text: &str) -> Result<(), Error> {
        if let Ok(tissue) = &finished.tissue {
            write_atomically(self.tissue(), tissue.as_bytes())?;
        }
        // Last, because its existence marks the specimen as complete.
        Ok(write_atomically(&self.json, text.as_bytes())?)
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

/// Digest of the inputs of a specimen: names, headers and samples of its recordings, and the settings.
fn digest(group: &[ReadRecording], settings: &CharacterizeSettings) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{settings:?}"));
    for read in group {
        let clean = &read.clean;
        hash.update(format!("{}{:?}", read.path.display(), clean.header));
        if let Some(mesh) = read.mesh() {
            // A mesh that cannot be read is an error later, where it is used.
            hash.update(Sha256::digest(
                read_bytes(&mesh, MAX_TABLE_BYTES).unwrap_or_default(),
            ));
        }
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

    /// Results on one mesh are not reused for another mesh of the same name.
    #[test]
    fn a_changed_mesh_is_another_study() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("kidney.csv");
        let text = "# format = 1\n# indenter_radius_m = 0.005\n# mesh = \"kidney.ply\"\n\
            # location_m = [0.0, 0.0, 0.05]\n\
            # fixed = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }\n\
            time_s,depth_m,force_n\n0,0,0\n0.1,0.001,0.01\n0.2,0.002,0.02\n0.3,0.003,0.03\n0.4,0.003,0.02\n";
        std::fs::write(&path, text).unwrap();
        let now = || {
            let (read, _) = crate::Recordings::of(&path).read(|_| ()).unwrap();
            digest(&read, &CharacterizeSettings::default())
        };
        let without = now();
        let mesh = folder.path().join("kidney.ply");
        std::fs::write(&mesh, "one").unwrap();
        let with_one = now();
        assert_eq!(now(), with_one);
        std::fs::write(&mesh, "two").unwrap();
        let with_two = now();
        assert!(without != with_one && with_one != with_two && without != with_two);
    }
}
