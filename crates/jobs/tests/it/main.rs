//! Jobs, as a program asks for them.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test that cannot do its job has failed"
)]

mod cancelled;
mod exit_status;
mod fuzz;
mod heart;

mod online;
mod readers;
mod recordings;
mod watched;

use std::path::{Path, PathBuf};

use palpate_files::Protocol;
use palpate_jobs::NoProgress;
use palpate_jobs::measure::{Measuring, Out, Plan, files};

/// Two specimens of linear tissue, which need no finite elements, pressed once each.
const PROTOCOL: &str = r#"
format = 1

[[specimen]]
organ = "soft"
subject = "1"
tissue = { law = "linear", youngs_modulus_pa = 3000.0, poissons_ratio = 0.45 }

[[specimen]]
organ = "soft"
subject = "2"
tissue = { law = "linear", youngs_modulus_pa = 4000.0, poissons_ratio = 0.45 }

[[stimulus]]
kind = "ramp_and_hold"
depth_m = 0.002
ramp_s = 0.5
hold_s = 2.0
"#;

/// Measures [`PROTOCOL`] into `folder`.
fn measured(folder: &Path) -> Vec<PathBuf> {
    let protocol = Protocol::parse(PROTOCOL, "protocol.toml").unwrap();
    let measuring = Measuring::of(Plan::of(protocol, 1).unwrap(), &NoProgress).unwrap();
    let out = Out {
        path: folder,
        overwrite: palpate_files::Overwrite::Refused,
    };
    let made = files(&measuring, out).unwrap();
    measuring.run(&made, &NoProgress).unwrap();
    made.paths
}
