use std::path::{Path, PathBuf};

use palpate_files::{Claim, Overwrite};
use palpate_jobs::plot::Plot;

use super::Item;
use super::finished_rows::{FinishedRows, KEPT};
use crate::Error;

/// The folder of figures and finished rows. It is this program's alone; without a file in it, it is removed.
pub struct Figures {
    folder: PathBuf,
    claim: Claim,
    draw: DrawPlot,
}

/// Draws a plot as a PNG file.
pub type DrawPlot = fn(&Plot) -> Result<Vec<u8>, palpate_jobs::Error>;

impl Figures {
    /// Claims the folder for the figures of `items`, before the work; plots are drawn by `draw`.
    ///
    /// # Errors
    /// When one of their figures exists and may not be replaced, another program uses the folder, or the operating
    /// system refuses.
    pub fn claimed(
        folder: &Path,
        overwrite: Overwrite,
        items: &[Item],
        draw: DrawPlot,
    ) -> Result<Self, Error> {
        if let (Overwrite::Refused, Some(path)) = (overwrite, existing(folder, items)) {
            return Err(palpate_files::Error::Exists { path }.into());
        }
        Ok(Self {
            folder: folder.to_owned(),
            claim: Claim::of_folder(folder, overwrite)
                .map_err(|error| palpate_jobs::Error::of_folder("--out", error))?,
            draw,
        })
    }

    /// The picture of `plot`.
    pub(super) fn drawn(&self, plot: &Plot) -> Result<Vec<u8>, Error> {
        Ok((self.draw)(plot)?)
    }

    /// The path of the figure `file`, which may be written.
    pub(super) fn path(&self, file: &str) -> Result<PathBuf, Error> {
        self.claim.check([file])?;
        Ok(self.folder.join(file))
    }

    /// The file of finished rows.
    pub fn rows(&self) -> FinishedRows {
        FinishedRows::at(self.folder.join(KEPT))
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
