//! Tests of the pictures and of the hand of the mouse.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "clippy.toml allows it in tests, but does not see helpers as tests"
)]

mod agreement;
mod analytic;
mod animation;
mod errors;
mod golden;
mod hands;
mod invariants;
mod labels;
mod layers;
mod wet;

use std::sync::{Mutex, OnceLock};

use palpate_viewer::Gpu;

/// The adapter of this machine, one for all tests; none on a machine without, which is said.
fn gpu() -> Option<Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    GPU.get_or_init(|| {
        Gpu::open()
            .map_err(|error| eprintln!("skipped: {error}"))
            .ok()
    })
    .clone()
}

/// Those who draw take turns: the processor may be what draws.
static TURN: Mutex<()> = Mutex::new(());
