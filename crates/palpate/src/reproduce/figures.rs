use std::path::{Path, PathBuf};

use palpate_files::{Claim, Error, Overwrite};

use super::Item;
use super::kept::{KEPT, KeptRows};
use crate::failure::Failure;

/// The folder of figures and finished rows. It is this program's alone; without a file in it, it is removed.
pub(crate) struct Figures {
    folder: PathBuf,
    claim: Claim,
}

impl Figures {
    /// Claims the folder for the figures of `items`, before the work.
    ///
    /// # Errors
    /// When one of their figures exists and may not be replaced, another program uses the folder, or the operating
    /// system refuses.
    pub(crate) fn claimed(
        folder: &Path,
        overwrite: Overwrite,
        items: &[Item],
    ) -> Result<Self, Failure> {
        if let (Overwrite::Refused, Some(path)) = (overwrite, existing(folder, items)) {
            return Err(Error::Exists { path }.into());
        }
        Ok(Self {
            folder: folder.to_owned(),
            claim: Claim::of_folder(folder, overwrite).map_err(cannot_be_made)?,
        })
    }

    /// The path of the figure `file`, which may be written.
    pub(super) fn path(&self, file: &str) -> Result<PathBuf, Failure> {
        self.claim.check([file])?;
        Ok(self.folder.join(file))
    }

    /// Where finished rows are kept.
    pub(crate) fn rows(&self) -> KeptRows {
        KeptRows::at(self.folder.join(KEPT))
    }
}

/// A figure of `items` in the folder. A folder that cannot be listed is reported when it is claimed.
fn existing(folder: &Path, items: &[Item]) -> Option<PathBuf> {
    let mut paths = folder.read_dir().ok()?.flatten().map(|entry| entry.path());
    let is_of = |path: &PathBuf, item: &Item| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let rest = name.strip_prefix(&stem(item.name));
        rest.is_some_and(|rest| rest.starts_with(['.', '-']))
    };
    paths.find(|path| items.iter().any(|item| is_of(path, item)))
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
