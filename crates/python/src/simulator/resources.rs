//! What this machine offers, as the command takes it.

use std::path::PathBuf;

use palpate_simulate::Resources;
use pyo3::prelude::*;

/// Where what takes minutes is kept: whether at all, or in which folder.
#[derive(Debug, FromPyObject)]
pub(super) enum Cache {
    Whether(bool),
    Folder(PathBuf),
}

/// `memory` in bytes, or most of what is free.
pub(super) fn resources(memory: Option<usize>, cache: Cache) -> Resources {
    let offered = palpate_jobs::preparation::resources();
    Resources {
        responses: match cache {
            Cache::Whether(true) => offered.responses,
            Cache::Whether(false) => None,
            Cache::Folder(path) => Some(path),
        },
        memory: memory.unwrap_or(offered.memory),
        ..Resources::default()
    }
}
