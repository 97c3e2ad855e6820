//! `palpate measure`: a protocol on specimens, and a recording of each stimulus.

mod answer;
mod measuring;
mod specimen;

use std::fs;
use std::path::PathBuf;

use clap::Args;
use palpate_files::Protocol;

use self::answer::Answer;
use self::measuring::Measuring;
use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use crate::{interrupt, output};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate measure --headless --out recordings
      three depths on a pig's liver that is not there: recordings/liver-virtual-....csv
  palpate measure --print-protocol > protocol.toml
      that protocol with every key explained, to be changed
  palpate measure protocol.toml --headless --out recordings --seed 7 --json
      yours; the same seed gives the same bytes
  palpate characterize recordings/
      the tissue behind them

Each stimulus is approached until first contact, pressed, withdrawn and recorded at 1 kHz. Ctrl-C withdraws
the indenter and keeps what was recorded. A recording that is being made has the ending .part.";

/// What is measured without a protocol, and every key.
const DEFAULT: &str = include_str!("protocol.toml");

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The protocol; without one, three depths on a virtual liver.
    #[arg(value_name = "PROTOCOL.toml")]
    protocol: Option<PathBuf>,
    /// Measure without a window, as fast as the machine can.
    #[arg(long)]
    headless: bool,
    /// The recording of an only stimulus, or the folder for several.
    #[arg(
        long,
        value_name = "RECORDING.csv | FOLDER",
        default_value = "recordings"
    )]
    out: PathBuf,
    /// The seed of noise, heart and breath.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Print the protocol that is used without one, and nothing else.
    #[arg(long)]
    print_protocol: bool,
}

/// Measures and prints what was recorded.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.print_protocol {
        return output::text(DEFAULT);
    }
    let protocol = match &arguments.protocol {
        Some(path) => Protocol::read(path)?,
        None => Protocol::parse(DEFAULT, "the default protocol")?,
    };
    if !arguments.headless {
        return Err(Failure::input(
            "the rig has no window yet; add --headless to measure without one",
        ));
    }
    let reader = Reader::of_json(arguments.json);
    let progress = Progress::new(reader, None);
    let measuring = Measuring::of(&protocol, arguments.seed, &progress)?;
    drop(progress);
    let files = arguments.files(&measuring)?;
    let progress = Progress::new(reader, Some(files.len() as u64));
    // Asked once, so that Ctrl-C is heard from now on.
    let _ = interrupt::is_asked();
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
            "stopped before the end of the protocol; the indenter was withdrawn, and what was recorded is kept",
        )),
        false => Ok(()),
    }
}

impl Arguments {
    /// A file for each recording, in a folder that is there.
    fn files(&self, measuring: &Measuring) -> Result<Vec<PathBuf>, Failure> {
        let names = measuring.names();
        let is_file = self.out.extension().is_some_and(|ending| ending == "csv");
        let folder = if is_file {
            self.out.parent()
        } else {
            Some(self.out.as_path())
        };
        if is_file && names.len() != 1 {
            return Err(Failure::input(format!(
                "the protocol makes {} recordings, and --out {} is one file; name a folder",
                names.len(),
                self.out.display()
            )));
        }
        if let Some(folder) = folder.filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder).map_err(|error| {
                let folder = folder.display();
                Failure::input(format!(
                    "the folder {folder} cannot be made ({error}); give another with --out"
                ))
            })?;
        }
        match is_file {
            true => Ok(vec![self.out.clone()]),
            false => Ok(names
                .iter()
                .map(|name| self.out.join(format!("{name}.csv")))
                .collect()),
        }
    }
}
