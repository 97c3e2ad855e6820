use std::path::PathBuf;

use palpate_characterize::{Characterization, CleanRecording};
use palpate_files::Tissue;
use serde::{Deserialize, Serialize};

use super::answer::Specimen;
use super::portrait::Portrait;
use crate::output;

/// One specimen with its recordings and all that was found.
pub(super) struct Studied {
    pub(super) files: Vec<PathBuf>,
    /// SHA-256 of the files.
    pub(super) digests: Vec<String>,
    pub(super) recordings: Vec<CleanRecording>,
    pub(super) found: Characterization,
}

/// What stays of a specimen.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Finished {
    pub(super) specimen: Specimen,
    /// The text of its tissue file, or why there is none.
    pub(super) tissue: Result<String, String>,
    /// What a report draws of it.
    pub(super) portrait: Portrait,
}

impl Finished {
    pub(super) fn of(studied: &Studied) -> Self {
        let tissue = studied.tissue();
        Self {
            specimen: Specimen::new(studied),
            portrait: Portrait::of(studied),
            tissue: tissue
                .map(|tissue| tissue.to_toml())
                .map_err(|why| why.to_string()),
        }
    }
}

impl Studied {
    /// The tissue of the law that is to be preferred.
    fn tissue(&self) -> Result<Tissue, palpate_characterize::Error> {
        let mut tissue = self.found.tissue(None)?;
        tissue.name.clone_from(&self.recordings[0].header.organ);
        let doubts = self.recordings.iter().flat_map(|own| &own.doubts);
        tissue.source.warnings.extend(doubts.cloned());
        let named = self.files.iter().map(|path| path.display().to_string());
        tissue.source.recordings = named.collect();
        tissue.source.version = Some(format!("palpate {}", output::VERSION));
        Ok(tissue)
    }
}
