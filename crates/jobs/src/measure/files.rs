use std::fs;
use std::path::{Path, PathBuf};

use super::Measuring;
use super::measuring::what_is_there;
use crate::Error;

/// Where recordings go.
#[derive(Debug, Clone, Copy)]
pub struct Out<'a> {
    /// A folder, or the file of an only recording.
    pub path: &'a Path,
    /// Whether recordings that are there may be lost.
    pub overwrite: bool,
}

/// A file for each recording of `measuring`, in a folder that is there.
///
/// # Errors
/// When the folder cannot be made, or a recording would be lost.
pub fn files(measuring: &Measuring, out: Out<'_>) -> Result<Vec<PathBuf>, Error> {
    let names = measuring.names();
    let is_file = out.path.extension().is_some_and(|ending| ending == "csv");
    let folder = match is_file {
        true => out.path.parent(),
        false => Some(out.path),
    };
    if is_file && names.len() != 1 {
        return Err(Error::input(format!(
            "the protocol makes {} recordings, and --out {} is one file; name a folder",
            names.len(),
            out.path.display()
        )));
    }
    if let Some(folder) = folder.filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|error| {
            let folder = folder.display();
            Error::input(format!(
                "the folder {folder} cannot be made ({error}); give another with --out"
            ))
        })?;
    }
    let in_folder = |name: &String| out.path.join(format!("{name}.csv"));
    let files: Vec<PathBuf> = match is_file {
        true => vec![out.path.to_owned()],
        false => names.iter().map(in_folder).collect(),
    };
    let there = files.iter().find_map(|file| what_is_there(file));
    match there.filter(|_| !out.overwrite) {
        Some(there) => Err(Error::input(format!(
            "{} is there already; move it, name another place with --out, or add --overwrite",
            there.display()
        ))),
        None => Ok(files),
    }
}
