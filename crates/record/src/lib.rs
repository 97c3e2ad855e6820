//! The training record: all attempts over all sessions, with trainee, task, time and measures.
//!
//! It is one file, an SQLite database, that many programs may use at once. [`Record::open`] creates a missing record,
//! [`Record::add`] returns once the attempt is on the disk, [`Record::read`] changes nothing. A damaged record is never
//! overwritten: it is renamed, and a new one is created.
//!
//! [`Standards`] evaluates attempts: the experts' level and the proficient trainees. [`learning_curve`] gives the mean
//! over trainees from attempt to attempt.
//!
//! *How we know*: `killed::…` (a writer that is killed at random times), `damaged::…`, `refused::…`, `kept::…`,
//! `proficiency::…`, `learning::…`, `class::…`.
//!
//! *Limits*: the caller states the times. A number that changes inside a valid page is not detected. A program that
//! keeps a record open while its file is moved continues to write to the moved one, so open it, add and close it again.

mod attempt;
mod class;
mod damaged;
mod error;
mod learning;
mod proficiency;
mod record;
mod rows;
mod schema;
mod spread;

pub use attempt::{Added, Attempt, Better, Measure};
pub use class::{Assignment, AssignmentProgress, Cohort};
pub use error::Error;
pub use learning::{CurvePoint, learning_curve};
pub use proficiency::{IN_A_ROW, Judged, Judgement, Standard, Standards, proficient_since};
pub use record::{Filter, Record};
pub use spread::Spread;
