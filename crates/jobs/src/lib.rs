//! What palpate is asked to do, whole: a document comes in, progress is told, and one answer comes out. The
//! command line and the Python package both stand on it, so that they answer alike to the last digit.
//!
//! | job | from | to |
//! |---|---|---|
//! | [`solve`] | a problem | forces and fields by finite elements, with their estimated error |
//! | [`analyze`] | recordings | what they show without a model |
//! | [`characterize`] | recordings | the tissue behind them, specimen by specimen |
//! | [`measure`] | a protocol | recordings by the rig |
//! | [`mod@envelope`] | triangles of any kind | a closed surface around them |
//! | [`preparation`] | a scene | a simulation, from what was prepared before where there is such |
//! | [`mod@validate`] | a file | what it is, and whether it is right |
//!
//! *How we know*: the tests of the command, which runs every job, and those here: a study that is cancelled at any of
//! its words leaves no half file and goes on, and what is answered does not depend on who waits.
//!
//! *Limits*: jobs read and write the files that they are asked to, start threads that end with them, and never print
//! or exit.

pub mod analyze;
pub mod characterize;
pub mod design;
pub mod documents;
pub mod envelope;
mod error;
pub mod label;
mod lossy;
pub mod measure;
pub mod memory;
mod nearest;
pub mod plot;
pub mod preparation;
mod recordings;
mod sideways;
pub mod solve;
pub mod validate;
mod watch;

#[doc(hidden)]
pub use error::carried;
pub use error::{Error, exit_status};
pub use lossy::{LossyPath, lossy};
pub use nearest::{builtin_organ, nearest};
pub use recordings::{ReadRecording, Recordings, Unusable, hexadecimal};
pub use sideways::Sideways;
pub use watch::{Nobody, Watch};

/// The version that stands in every machine-readable answer as `palpate`.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// `answer` as one JSON document.
///
/// # Errors
/// When it holds what JSON has no words for.
pub fn json_text(answer: &impl serde::Serialize) -> Result<String, Error> {
    serde_json::to_string_pretty(answer).map_err(|error| {
        Error::failed(format!(
            "the answer is no JSON ({error}); use the text output"
        ))
    })
}
