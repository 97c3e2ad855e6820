use std::path::PathBuf;

use palpate_characterize::{Characterization, CleanRecording};
use palpate_files::Tissue;
use serde::{Deserialize, Serialize};

use super::answer::{Specimen, former};
use super::fit_plots::{DrawnFit, FitPlots, all_samples};
use crate::{Error, VERSION};

/// One specimen with its recordings and all results.
pub(crate) struct Studied {
    pub(crate) files: Vec<PathBuf>,
    /// SHA-256 of the files.
    pub(crate) digests: Vec<String>,
    pub(crate) recordings: Vec<CleanRecording>,
    pub(crate) found: Characterization,
}

/// The stored results of a specimen.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Finished {
    #[serde(serialize_with = "former::of_one")]
    pub(crate) specimen: Specimen,
    /// The text of its tissue file, or why there is none.
    pub(crate) tissue: Result<String, String>,
    /// Whether the tissue is missing because of a failure, and not because of the recordings.
    #[serde(default)]
    pub(crate) has_failed: bool,
    /// Plot data for a report.
    pub(crate) portrait: FitPlots,
    /// The fit of each recording, with its file, at every sample: not stored in a study's folder, which would grow a
    /// hundredfold.
    #[serde(skip)]
    pub(crate) samples: Vec<(String, DrawnFit)>,
}

impl Finished {
    pub(crate) fn of(studied: &Studied) -> Self {
        let tissue = studied.tissue();
        Self {
            specimen: Specimen::new(studied),
            portrait: FitPlots::of(studied),
            samples: all_samples(studied),
            has_failed: tissue.as_ref().is_err_and(|why| !why.is_input()),
            tissue: tissue
                .map(|tissue| tissue.to_toml())
                .map_err(|why| why.to_string()),
        }
    }

    /// The text of its tissue file.
    pub(crate) fn tissue(&self) -> Result<String, Error> {
        self.tissue.clone().map_err(|why| match self.has_failed {
            true => Error::Failed(why),
            false => Error::Input(why),
        })
    }
}

impl Studied {
    /// The tissue of the preferred law.
    fn tissue(&self) -> Result<Tissue, palpate_characterize::Error> {
        let mut tissue = self.found.tissue(None)?;
        tissue.name.clone_from(&self.recordings[0].header.organ);
        let warnings = self.recordings.iter().flat_map(|own| &own.warnings);
        tissue.source.warnings.extend(warnings.cloned());
        let named = self.files.iter().map(|path| path.display().to_string());
        tissue.source.recordings = named.collect();
        tissue.source.version = Some(format!("palpate {}", VERSION));
        Ok(tissue)
    }
}
