//! `palpate simulate`: tool motions on an organ.

use std::path::PathBuf;

use clap::Args;

use crate::failure::Failure;

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Example:
  palpate simulate scene.toml --headless --motion motion.csv --out session
      writes session/session.csv (forces on the tool at every step) and session/summary.json";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The scene; without one, the built-in esophagus.
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Play without a window.
    #[arg(long, requires = "motion", requires = "out")]
    headless: bool,
    /// The tool motions to play: time_s, tool, x_m, y_m, z_m.
    #[arg(long, value_name = "MOTION.csv")]
    motion: Option<PathBuf>,
    /// The folder to write the session into; it is made when it is not there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the summary as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Plays the motions.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments {
        scene: _,
        headless: _,
        motion: _,
        out: _,
        json: _,
    } = arguments;
    Err(Failure::failed(
        "simulating is not here yet; see `palpate --help` for what is",
    ))
}
