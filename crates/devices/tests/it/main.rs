//! Drivers against stand-ins that speak their protocols.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests may unwrap, and print what they measured"
)]

mod campaign;
mod ends;
mod force_sensors;
mod hands;
mod haply;
mod haply_faults;
mod haply_messages;
mod libraries;
mod library_faults;
mod no_allocation;
mod openigtlink;
mod rosbridge;
mod self_test;
