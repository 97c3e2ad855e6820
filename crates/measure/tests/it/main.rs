//! Tests of the rig on a virtual clock.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "clippy.toml allows both in tests, but does not see helpers as tests"
)]

mod live;
mod loss;
mod no_allocation;
mod normal;
mod real_device;
mod real_sensor;
mod rig;
mod six_axes;
