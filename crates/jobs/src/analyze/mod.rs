//! Analysis of recordings without a material model.

mod analyzed;
mod answer;

use palpate_characterize::Analysis;

pub use analyzed::{Analyzed, warnings_of};

use crate::{Error, ProgressCallback, ReadRecording, Recordings};

/// Analyzes every one of `recordings`.
///
/// # Errors
/// When no recording can be used.
pub fn analyze(recordings: &Recordings, watch: &dyn ProgressCallback) -> Result<Analyzed, Error> {
    let (read, unusable) =
        recordings.read(|path| watch.report_step(&format!("reading {}", path.display())))?;
    watch.report_step("analyzing");
    let analyses = read.into_iter().map(|read| {
        let analysis = palpate_characterize::analyze(&read.clean);
        (read, analysis)
    });
    let analyses: Vec<(ReadRecording, Analysis)> = analyses.collect();
    Ok(Analyzed::of(analyses, unusable))
}
