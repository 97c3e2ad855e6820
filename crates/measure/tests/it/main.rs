//! Tests of the rig on a virtual clock.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "clippy.toml allows both in tests, but does not see helpers as tests"
)]

mod compensation;
mod live;
mod loss;
mod no_allocation;
mod normal;
mod phantom;
mod phantom_dynamics;
mod real_device;
mod real_sensor;
mod rig;
mod session_end;
mod six_axes;
