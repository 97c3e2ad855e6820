//! Analysis of recordings without a material model.

mod analyzed;
mod answer;

use palpate_characterize::Analysis;

pub use analyzed::{Analyzed, warnings_of};

use crate::{Error, ReadRecording, Recordings, Watch};

/// Analyzes every one of `recordings`.
///
/// # Errors
/// When no recording can be used.
pub fn analyze(recordings: &Recordings, watch: &dyn Watch) -> Result<Analyzed, Error> {
    let (read, unusable) =
        recordings.read(|path| watch.say(&format!("reading {}", path.display())))?;
    watch.say("analyzing");
    let analyses = read.into_iter().map(|read| {
        let analysis = palpate_characterize::analyze(&read.clean);
        (read, analysis)
    });
    let analyses: Vec<(ReadRecording, Analysis)> = analyses.collect();
    Ok(Analyzed::of(analyses, unusable))
}
