//! The training record: who attempted which task, when, and with what measures, over all sessions.
//!
//! It is one file, an SQLite database, that many programs may use at once. [`Record::open`] begins it where there
//! is none, [`Record::add`] has put an attempt onto the disk when it returns, [`Record::read`] changes nothing.
//! A record that is damaged is never written over: it is kept beside the new one that is begun.
//!
//! What the attempts say is told by [`Standards`], what experts reach and who is proficient, and by
//! [`learning_curve`], the mean over trainees from attempt to attempt.
//!
//! *How we know*: `killed::…` (a writer that is killed at random times), `damaged::…`, `refused::…`, `kept::…`,
//! `proficiency::…`, `learning::…`, `class::…`.
//!
//! *Limits*: times are those that the caller says. A number that is changed inside a sound page is not noticed.
//! A program that keeps a record open while its file is moved goes on writing to the moved one, so open it, add
//! and close it again.

mod aside;
mod attempt;
mod class;
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
