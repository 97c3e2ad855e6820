//! The jobs of palpate: each takes a document, reports progress and returns one answer. The command line and the
//! Python package both call these jobs, so their answers agree to the last digit.
//!
//! | job | from | to |
//! |---|---|---|
//! | [`solve`] | a problem | forces and fields by finite elements, with their estimated error |
//! | [`analyze`] | recordings | what they show without a model |
//! | [`characterize`] | recordings | the tissue behind them, specimen by specimen |
//! | [`measure`] | a protocol | recordings by the rig |
//! | [`mod@envelope`] | triangles of any kind | a closed surface around them |
//! | [`preparation`] | a scene | a simulation, from cached results if there are any |
//! | [`mod@validate`] | a file | its kind, and whether it is valid |
//!
//! *How we know*: the tests of the command, which runs every job, and those here: a study that is cancelled at any
//! progress report leaves no half-written file and can resume, and answers do not depend on the progress receiver.
//!
//! *Limits*: jobs read and write only the files named in the request, start threads that end with them, and never
//! print or exit.

pub mod analyze;
pub mod characterize;
pub mod design;
pub mod documents;
pub mod envelope;
mod error;
pub mod label;
mod lateral_load;
mod lossy;
pub mod measure;
pub mod memory;
mod nearest;
pub mod plot;
pub mod preparation;
mod progress;
mod recordings;
pub mod solve;
pub mod validate;

#[doc(hidden)]
pub use error::carried;
pub use error::{Error, exit_status};
pub use lateral_load::LateralLoad;
pub use lossy::{LossyPath, lossy};
pub use nearest::{builtin_organ, nearest};
pub use progress::{NoProgress, ProgressCallback};
pub use recordings::{ReadRecording, Recordings, Unusable, hexadecimal};

/// The version, which every machine-readable answer has as `palpate`.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// `answer` as one JSON document.
///
/// # Errors
/// When JSON cannot represent a value of the answer.
pub fn json_text(answer: &impl serde::Serialize) -> Result<String, Error> {
    serde_json::to_string_pretty(answer).map_err(|error| {
        Error::failed(format!(
            "the answer is no JSON ({error}); use the text output"
        ))
    })
}
