//! Loops run through the crate's own front door.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests may unwrap, and print what they measured"
)]

mod chain;
mod devices;
mod enabling;
mod errors;
mod hand_over;
mod hosts;
mod limits;
mod no_allocation;
mod passivity;
mod servo;
mod slow_model;
mod stability;
mod supervisor;
mod watch;
