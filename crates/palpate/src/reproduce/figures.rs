use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use palpate_files::{Claim, Error, Overwrite};

use super::Item;
use crate::failure::Failure;

/// The folder of figures. It is made for the first one, and is then this program's alone.
pub(crate) struct Figures<'a> {
    folder: &'a Path,
    overwrite: Overwrite,
    claim: OnceCell<Claim>,
}

impl<'a> Figures<'a> {
    pub(crate) fn new(folder: &'a Path, overwrite: Overwrite) -> Self {
        Self {
            folder,
            overwrite,
            claim: OnceCell::new(),
        }
    }

    /// Refuses items with a figure that exists, before the work, unless figures may be replaced.
    pub(crate) fn check(&self, items: &[Item]) -> Result<(), Failure> {
        // A folder that cannot be listed is told when a figure is written.
        let Ok(entries) = self.folder.read_dir() else {
            return Ok(());
        };
        let mut paths = entries.flatten().map(|entry| entry.path());
        let is_of = |path: &PathBuf, item: &Item| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let rest = name.strip_prefix(&stem(item.name));
            rest.is_some_and(|rest| rest.starts_with(['.', '-']))
        };
        match paths.find(|path| items.iter().any(|item| is_of(path, item))) {
            Some(path) if self.overwrite == Overwrite::Refused => {
                Err(Error::Exists { path }.into())
            }
            _ => Ok(()),
        }
    }

    /// The path of the figure `file`, which may be written.
    pub(super) fn path(&self, file: &str) -> Result<PathBuf, Failure> {
        let claim = match self.claim.get() {
            Some(claim) => claim,
            None => {
                let claim =
                    Claim::of_folder(self.folder, self.overwrite).map_err(cannot_be_made)?;
                self.claim.get_or_init(|| claim)
            }
        };
        claim.check([file])?;
        Ok(self.folder.join(file))
    }
}

/// How the files of an item begin: a part of a table has no folder of its own.
pub(super) fn stem(item: &str) -> String {
    item.replace('/', "-")
}

fn cannot_be_made(error: Error) -> Failure {
    match error {
        Error::Write { path, source } => Failure::input(format!(
            "the folder {} cannot be made or written ({source}); give another with --out",
            path.display()
        )),
        other => other.into(),
    }
}
