//! Scenes played through the crate's own front door.

#![allow(clippy::unwrap_used, reason = "tests may unwrap")]

mod agreement;
mod analytic;
mod data;
mod errors;
mod invariants;
mod no_allocation;
mod scenes;
mod slides;
