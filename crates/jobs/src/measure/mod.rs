//! Runs a protocol on the rig, and makes a recording of each stimulus.

mod answer;
mod estimating;
mod files;
mod live;
mod measuring;
mod plan;
mod sensor;
mod specimen;
mod specimen_cache;

pub use answer::Answer;
pub use files::{Files, Out, files, folder};
pub use measuring::{Measured, Measuring};
pub use plan::{OnRig, Plan};

/// The default protocol, with every key explained.
pub const DEFAULT: &str = include_str!("protocol.toml");
