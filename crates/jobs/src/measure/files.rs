use std::path::{Path, PathBuf};

use palpate_files::{Claim, Overwrite};

use super::Measuring;
use crate::Error;

/// Destination of recordings.
#[derive(Debug, Clone, Copy)]
pub struct Out<'a> {
    /// A folder, or the file of an only recording.
    pub path: &'a Path,
    /// Whether recordings that exist may be replaced.
    pub overwrite: Overwrite,
}

/// A file for each recording, locked by this program until it is dropped.
#[derive(Debug)]
pub struct Files {
    /// In the order of the recordings.
    pub paths: Vec<PathBuf>,
    _claim: Claim,
}

/// A file for each recording of `measuring`, in a folder, which is made.
///
/// # Errors
/// When the folder cannot be made, another program writes there, or a recording would be replaced.
pub fn files(measuring: &Measuring, out: Out<'_>) -> Result<Files, Error> {
    let names = measuring.names();
    let is_file = out.path.extension().is_some_and(|ending| ending == "csv");
    if is_file && names.len() != 1 {
        return Err(Error::input(format!(
            "the protocol makes {} recordings, and --out {} is one file; name a folder",
            names.len(),
            out.path.display()
        )));
    }
    let in_folder = |name: &String| out.path.join(format!("{name}.csv"));
    let (claim, paths) = match is_file {
        true => {
            let folder = out.path.parent().unwrap_or(Path::new(""));
            if !folder.as_os_str().is_empty() {
                std::fs::create_dir_all(folder).map_err(|source| Error::Folder {
                    folder: folder.to_owned(),
                    option: "--out",
                    source,
                })?;
            }
            let claim = Claim::of_file(out.path, out.overwrite)?;
            (claim, vec![out.path.to_owned()])
        }
        false => {
            let claim = folder(out.path, out.overwrite)?;
            (claim, names.iter().map(in_folder).collect())
        }
    };
    claim.check(paths.iter().filter_map(|path| path.file_name()))?;
    Ok(Files {
        paths,
        _claim: claim,
    })
}

/// The folder of recordings, created if missing and locked by this program.
///
/// # Errors
/// When it cannot be made, or another program writes there.
pub fn folder(path: &Path, overwrite: Overwrite) -> Result<Claim, Error> {
    Claim::of_folder(path, overwrite).map_err(|error| Error::of_folder("--out", error))
}
