//! `palpate measure`: the rig in a window, or a protocol on specimens without one, and a recording of each
//! stimulus.

mod window;

use std::path::PathBuf;

use clap::Args;
use palpate_files::{Overwrite, Protocol};
use palpate_jobs::measure::{Answer, DEFAULT, Measuring, Out, Plan, files};

use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use crate::{interrupt, output};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate measure
      a window that operates the rig: jog, approach, one button for each stimulus, live force;
      the space bar is the emergency stop, and recordings are written to recordings/
  palpate measure --headless --out recordings
      three depths on a virtual pig liver: recordings/liver-virtual-....csv
  palpate measure --print-protocol > protocol.toml
      the default protocol with every key explained, for editing
  palpate measure protocol.toml
      a window with your stimuli and specimens
  palpate measure protocol.toml --headless --out recordings --seed 7 --json
      the same without a window; the same seed gives the same bytes
  palpate characterize recordings/
      fits the tissue

Each stimulus approaches until first contact, presses, withdraws, and is recorded at 1 kHz. Ctrl-C withdraws the \
indenter and saves the recording so far. An unfinished recording has the extension .part; a truncated one states the \
reason in its header. A window never overwrites a recording; it numbers them.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The protocol; without one, three depths on a virtual liver.
    #[arg(value_name = "PROTOCOL.toml")]
    protocol: Option<PathBuf>,
    /// Run without a window, as fast as possible.
    #[arg(long)]
    headless: bool,
    /// The recording of a single stimulus, or the folder for several.
    #[arg(
        long,
        value_name = "RECORDING.csv | FOLDER",
        default_value = "recordings"
    )]
    out: PathBuf,
    /// The random seed of noise, heartbeat and breathing.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Replace existing recordings.
    #[arg(long, requires = "headless")]
    overwrite: bool,
    /// Print one JSON object.
    #[arg(long, requires = "headless")]
    json: bool,
    /// Print the default protocol and exit.
    #[arg(long)]
    print_protocol: bool,
}

/// Measures and prints the recordings.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.print_protocol {
        return output::text(DEFAULT);
    }
    let protocol = match &arguments.protocol {
        Some(path) => Protocol::read(path)?,
        None => Protocol::parse(DEFAULT, "the default protocol")?,
    };
    let plan = Plan::of(protocol, arguments.seed)?;
    match arguments.headless {
        true => headless(arguments, plan),
        false => window::open(plan, &arguments.out),
    }
}

fn headless(arguments: &Arguments, plan: Plan) -> Result<(), Failure> {
    let reader = Reader::of_json(arguments.json);
    let progress = Progress::new(reader, None);
    let measuring = Measuring::of(plan, &progress)?;
    drop(progress);
    let out = Out {
        path: &arguments.out,
        overwrite: Overwrite::of_option(arguments.overwrite),
    };
    let files = files(&measuring, out)?;
    let progress = Progress::new(reader, Some(files.paths.len() as u64));
    // The first call starts listening for Ctrl-C.
    let _ = interrupt::is_requested();
    let recorded = measuring.run(&files, &progress)?;
    drop(progress);
    let answer = Answer::new(recorded, &measuring);
    if arguments.json {
        output::json(&answer)?;
    } else {
        output::text(&answer)?;
        output::warnings(&answer.warnings);
    }
    match answer.stopped {
        true => Err(Failure::failed(
            "stopped before the end of the protocol; the indenter was withdrawn, and finished recordings are kept",
        )),
        false => Ok(()),
    }
}
