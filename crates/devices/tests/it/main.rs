//! Drivers against stand-ins that speak their protocols.

#![allow(
    clippy::unwrap_used,
    reason = "clippy.toml allows it in tests, but does not see helpers as tests"
)]

mod hands;
mod haply;
mod haply_faults;
mod haply_messages;
mod self_test;
