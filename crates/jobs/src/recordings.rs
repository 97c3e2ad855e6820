//! The recordings that a command is given: files and folders, of this project and of other programs.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use palpate_characterize::CleanRecording;
use palpate_characterize::clean::{CleanSettings, clean};
use palpate_files::recording::{
    ForeignColumns, RecordingHeader, deflection_beside, position_beside,
};
use palpate_files::{MAX_TABLE_BYTES, Recording, read_bytes};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::{Error, LateralLoad, nearest};

/// A selection of recordings, with facts that the files do not state.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Recordings {
    /// Recordings, or folders of them; files of instruments and tables of other programs are read too.
    pub paths: Vec<PathBuf>,
    /// Recordings that are not files here: their names and texts.
    pub texts: Vec<(PathBuf, String)>,
    /// The column of the time, in a table of another program; found by its name if not given.
    pub time: Option<String>,
    /// The column of the depth.
    pub depth: Option<String>,
    /// The column of the force.
    pub force: Option<String>,
    /// The unit of the depth, where its name does not state it: m, mm, um, nm.
    pub depth_unit: Option<String>,
    /// The unit of the force, where its name does not state it: N, mN, uN, nN.
    pub force_unit: Option<String>,
    /// Header entries that the files do not state, by the keys of a recording: `indenter_radius_m=0.001`.
    #[serde(rename = "said")]
    pub header_entries: Vec<String>,
}

/// A recording that was read.
#[derive(Debug)]
pub struct ReadRecording {
    /// Its name, as given; a curve of a map with its number, `map.jpk-force-map#7`.
    pub path: PathBuf,
    /// Its samples, from first contact on.
    pub clean: CleanRecording,
    /// Lateral force and torque of its sensor; none for a sensor of one axis.
    pub lateral_load: Option<LateralLoad>,
    /// SHA-256 of the file, and of the number of the curve in it where it has several.
    pub digest: String,
}

impl ReadRecording {
    /// The file of the mesh of its organ; none where it names none.
    pub fn mesh(&self) -> Option<PathBuf> {
        let mesh = self.clean.header.mesh.as_ref()?;
        let folder = self.path.parent().unwrap_or(Path::new(""));
        Some(folder.join(mesh))
    }
}

/// A recording that could not be used, and why.
#[derive(Debug, Serialize)]
pub struct Unusable {
    /// Its name, as given.
    #[serde(serialize_with = "crate::lossy")]
    pub file: PathBuf,
    /// Why; it may or may not name the file.
    #[serde(serialize_with = "in_words")]
    pub reason: Error,
}

/// A recording by the name of its file, or why it could not be read.
type NamedRecording = (PathBuf, Result<ReadRecording, Error>);

impl Recordings {
    /// A single recording, with nothing stated besides.
    pub fn of(path: &Path) -> Self {
        Self {
            paths: vec![path.to_owned()],
            ..Self::default()
        }
    }

    /// All that can be read, and all that cannot: one bad file does not stop the others.
    pub fn read(
        &self,
        mut at_file: impl FnMut(&Path),
    ) -> Result<(Vec<ReadRecording>, Vec<Unusable>), Error> {
        let stated = self.header()?;
        let (mut good, mut bad) = (Vec::new(), Vec::new());
        let files = self.files()?.into_iter().map(|path| (path, None));
        let texts = self.texts.iter();
        let texts = texts.map(|(path, text)| (path.clone(), Some(text.as_str())));
        for (path, text) in files.chain(texts) {
            at_file(&path);
            match self.all_of(&path, text, &stated) {
                Ok(each) => {
                    for (path, read) in each {
                        match read {
                            Ok(read) => good.push(read),
                            Err(reason) => bad.push(Unusable { file: path, reason }),
                        }
                    }
                }
                Err(reason) => bad.push(Unusable { file: path, reason }),
            }
        }
        if !good.is_empty() || bad.is_empty() {
            return Ok((good, bad));
        }
        let count = bad.len();
        let first = bad.swap_remove(0).reason;
        Err(match count {
            1 => first,
            _ => Error::NoRecording {
                count,
                first: Box::new(first),
            },
        })
    }

    /// The options for the recordings, by name and value.
    pub fn options(&self) -> Vec<(String, String)> {
        let columns = [
            ("--time", &self.time),
            ("--depth", &self.depth),
            ("--force", &self.force),
            ("--depth-unit", &self.depth_unit),
            ("--force-unit", &self.force_unit),
        ];
        let columns = columns
            .into_iter()
            .filter_map(|(name, value)| Some((name, value.as_ref()?)));
        columns
            .chain(self.header_entries.iter().map(|entry| ("--set", entry)))
            .map(|(name, value)| (name.to_owned(), value.clone()))
            .collect()
    }

    /// The files that were named, and those of the folders in alphabetical order.
    fn files(&self) -> Result<Vec<PathBuf>, Error> {
        let mut files = Vec::new();
        for path in &self.paths {
            if path.is_dir() {
                let inside = tables(path)?;
                if inside.is_empty() {
                    let path = path.display();
                    return Err(Error::input(format!(
                        "{path} holds no file of recordings (.csv, .txt, .tsv, .jpk-force, …); name a folder that does, or files"
                    )));
                }
                files.extend(inside);
            } else {
                files.push(path.clone());
            }
        }
        Ok(files)
    }

    /// The recordings in a file, or in a text that is called by a path, each by its name.
    fn all_of(
        &self,
        path: &Path,
        text: Option<&str>,
        stated: &RecordingHeader,
    ) -> Result<Vec<NamedRecording>, Error> {
        let bytes = match text {
            Some(text) => Cow::Borrowed(text.as_bytes()),
            None => read_bytes(path, MAX_TABLE_BYTES)?.into(),
        };
        let mut digest = Sha256::new_with_prefix(&bytes);
        if let Some(position) = position_beside(path) {
            digest.update(read_bytes(position, MAX_TABLE_BYTES)?);
        }
        let digest = digest.finalize();
        let all = Recording::parse_all(&bytes, path, &self.columns(), stated)?;
        let several = all.len() > 1;
        let each = all.into_iter().enumerate().map(|(place, recording)| {
            let own = match several {
                true => (
                    PathBuf::from(format!("{}#{place}", path.display())),
                    Sha256::digest([&digest[..], &place.to_le_bytes()].concat()),
                ),
                false => (path.to_owned(), digest),
            };
            let read =
                ready(recording, &own.0, stated).map(|(clean, lateral_load)| ReadRecording {
                    path: own.0.clone(),
                    clean,
                    lateral_load,
                    digest: hexadecimal(&own.1),
                });
            (own.0, read)
        });
        Ok(each.collect())
    }

    fn columns(&self) -> ForeignColumns {
        ForeignColumns {
            time: self.time.clone(),
            depth: self.depth.clone(),
            force: self.force.clone(),
            depth_unit: self.depth_unit.clone(),
            force_unit: self.force_unit.clone(),
        }
    }

    /// The header entries of `--set`, by the rules of a recording's own header.
    fn header(&self) -> Result<RecordingHeader, Error> {
        let mut text = "# format = 1\n".to_owned();
        for entry in &self.header_entries {
            let Some((key, value)) = entry.split_once('=') else {
                return Err(Error::input(format!(
                    "--set {entry}: write a key and its value, such as indenter_radius_m=0.001"
                )));
            };
            let plain = value.parse::<f64>().is_ok() || value == "true" || value == "false";
            let quoted = if plain || value.starts_with('"') {
                value.to_owned()
            } else {
                format!("{value:?}")
            };
            text += &format!("# {} = {quoted}\n", key.trim());
        }
        text += "time_s,depth_m,force_n\n0,0,0\n";
        let header = Recording::parse(&text, "--set")?.header;
        match header.extra.first() {
            None => Ok(header),
            Some(unknown) => {
                let (key, meant) = (
                    &unknown.key,
                    nearest(
                        &unknown.key,
                        &RecordingHeader::KEYS
                            .iter()
                            .map(|key| key.name)
                            .collect::<Vec<_>>(),
                    ),
                );
                Err(Error::input(format!(
                    "--set {key}: a recording has no key `{key}`; the nearest is `{meant}`"
                )))
            }
        }
    }
}

/// A `recording` of the file `path`, cleaned, with its header completed by `stated`.
fn ready(
    mut recording: Recording,
    path: &Path,
    stated: &RecordingHeader,
) -> Result<(CleanRecording, Option<LateralLoad>), Error> {
    recording.header = recording.header.completed_by(stated);
    if let Some((key, expected)) = recording.header.layer_error() {
        let path = path.display();
        let mut entries = recording.header.entries().into_iter();
        let wrong = match entries.any(|(own, _)| own == key) {
            true => "does not fit the other keys",
            false => "is missing",
        };
        return Err(Error::input(format!(
            "{path}: `{key}` {wrong}; give {expected}"
        )));
    }
    let mut clean = clean(&recording, &CleanSettings::default())
        .map_err(|error| Error::from(error).about(path))?;
    let lateral_load = LateralLoad::of(&recording);
    clean
        .warnings
        .extend(lateral_load.and_then(|found| found.warning()));
    Ok((clean, lateral_load))
}

/// `bytes` as text.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The ends of the names of files that hold recordings.
pub(crate) const ENDINGS: [&str; 9] = [
    "csv",
    "txt",
    "tsv",
    "jpk-force",
    "jpk-force-map",
    "jpk-qi-data",
    "jpk-qi-series",
    "ibw",
    "nid",
];

/// The files of recordings in a folder, in alphabetical order.
fn tables(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let unreadable = |source| palpate_files::Error::Read {
        path: folder.to_owned(),
        source,
    };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        let is_table = ENDINGS.contains(&extension.to_ascii_lowercase().as_str());
        let is_license = path.file_stem().is_some_and(|stem| {
            let stem = stem.to_string_lossy().to_ascii_lowercase();
            stem.starts_with("license") || stem.starts_with("readme")
        });
        // The position of a curve is read with its deflection.
        let is_position = || deflection_beside(&path).is_some();
        if is_table && !is_license && path.is_file() && !is_position() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

impl Unusable {
    /// The reason, which names the file.
    pub fn sentence(&self) -> String {
        let (file, reason) = (self.file.display().to_string(), self.reason.to_string());
        match reason.contains(&file) {
            true => reason,
            false => format!("{file}: {reason}"),
        }
    }
}

fn in_words<S: serde::Serializer>(reason: &Error, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(reason)
}
