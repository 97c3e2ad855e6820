use clap::Args;
use palpate_files::{Claim, Overwrite};
use std::path::Path;

use crate::failure::Failure;

/// The option of every command that writes files which are named.
#[derive(Debug, Args)]
pub(super) struct OverwriteOption {
    /// Replace files that exist.
    #[arg(long)]
    overwrite: bool,
}

impl OverwriteOption {
    pub(super) fn rule(&self) -> Overwrite {
        Overwrite::of_option(self.overwrite)
    }

    /// Claims the files that are going to be written, before the work. They are this program's until it is dropped.
    pub(super) fn claim(
        &self,
        files: impl IntoIterator<Item = impl AsRef<Path>>,
    ) -> Result<Vec<Claim>, Failure> {
        Ok(Claim::of_files(files, self.rule())?)
    }
}
