//! `palpate cache`: results that take long and can be computed again.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use palpate_jobs::preparation::folder;
use serde::Serialize;

use crate::failure::Failure;
use crate::output;

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate cache
      shows its folder, the number of cached organs and specimens, and its size
  palpate cache --clear
      removes them; each is computed again when needed

The cache is in the system's cache folder, or in the folder that PALPATE_CACHE names.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Remove the cached files.
    #[arg(long)]
    clear: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// File extensions of prepared organs and of solved specimens of the virtual rig.
const ENDS: [&str; 2] = ["response", "specimen"];

/// The answer of `--json`.
#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    folder: PathBuf,
    files: usize,
    bytes: u64,
    cleared: bool,
}

/// Shows the cache, and clears it with `--clear`.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = folder().ok_or_else(|| {
        Failure::failed(
            "the system names no folder for what can be made again; name one by PALPATE_CACHE",
        )
    })?;
    let cached = cached_files(&folder)?;
    let bytes = cached.iter().map(|(_, bytes)| bytes).sum();
    if arguments.clear {
        remove(&cached)?;
    }
    let answer = Answer {
        palpate: output::VERSION,
        folder,
        files: cached.len(),
        bytes,
        cleared: arguments.clear,
    };
    match arguments.json {
        true => output::json(&answer),
        false => output::line(format!(
            "{}: {} prepared organ{} or specimen{}, {:.1} MB{}",
            answer.folder.display(),
            answer.files,
            if answer.files == 1 { "" } else { "s" },
            if answer.files == 1 { "" } else { "s" },
            1e-6 * answer.bytes as f64,
            if answer.cleared { ", removed" } else { "" }
        )),
    }
}

/// The cached files of a folder, with their sizes [B]; other files do not belong to this program.
pub(crate) fn cached_files(folder: &Path) -> Result<Vec<(PathBuf, u64)>, Failure> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(unusable(folder, &error)),
    };
    let mut found = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|error| unusable(folder, &error))?;
        let path = entry.path();
        let known = entry.metadata().map_err(|error| unusable(&path, &error))?;
        if known.is_file()
            && path
                .extension()
                .is_some_and(|end| ENDS.iter().any(|own| end == *own))
        {
            found.push((path, known.len()));
        }
    }
    found.sort();
    Ok(found)
}

/// Removes cached files.
pub(crate) fn remove(cached: &[(PathBuf, u64)]) -> Result<(), Failure> {
    for (file, _) in cached {
        fs::remove_file(file).map_err(|error| unusable(file, &error))?;
    }
    Ok(())
}

fn unusable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::failed(format!("{}: {error}", path.display()))
}
