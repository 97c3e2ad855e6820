//! Marks of rows that are not simply our number versus the source's.

use serde::{Deserialize, Serialize};

/// The mark of a row, read before its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mark {
    /// The printed number was put in, and came back.
    PipelineOnly,
    /// A bound: ours is the last value that was tried.
    AtLeast,
    /// The row has neither a number nor a figure; its note says why.
    NotComputed,
    /// The computation failed; the note has the error.
    Failed,
}

impl Mark {
    pub(super) const ALL: [Self; 4] = [
        Self::PipelineOnly,
        Self::AtLeast,
        Self::NotComputed,
        Self::Failed,
    ];

    /// As a table shows it.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::PipelineOnly => "pipeline only",
            Self::AtLeast => "at least",
            Self::NotComputed => "not computed",
            Self::Failed => "failed",
        }
    }

    /// What it means, once under the tables.
    pub(super) fn meaning(self) -> &'static str {
        match self {
            Self::PipelineOnly => {
                "the source prints no recording, so a virtual one was made from the printed number, and the number was found \
                 again in it: agreement judges our pipeline, not the source's measurement"
            }
            Self::AtLeast => {
                "ours is a bound, the last value that could be tried; the true one may be larger"
            }
            Self::NotComputed => "the note says why",
            Self::Failed => {
                "the computation ended with the error in the note; the other rows do not depend on it"
            }
        }
    }
}
