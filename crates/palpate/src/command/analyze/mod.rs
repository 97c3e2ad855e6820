//! `palpate analyze`: what recordings show, without a model.

mod answer;
mod table;

use clap::Args;
use palpate_characterize::analyze;
use palpate_files::check_writable;
use std::path::PathBuf;

use self::answer::Answer;
use super::recordings::{Recordings, Unusable};
use crate::failure::Failure;
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate analyze liver-2mm.csv
      static force, relaxation, and the answer to sines and chirps
  palpate analyze recordings/ --json > analysis.json
      every recording of a folder, and each organ over its subjects
  palpate analyze test.txt --depth 'Extension' --depth-unit mm --force 'Load' --force-unit N
      a table of another program

Steady force is the mean of the last tenth of a hold. The phase is positive when force leads depth,
the hysteresis when energy is lost.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    recordings: Recordings,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Write the JSON object to a file as well.
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,
}

/// Analyzes and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(out) = &arguments.out {
        check_writable(out)?;
    }
    let progress = Progress::new(Reader::of_json(arguments.json), None);
    let (recordings, unusable) = arguments
        .recordings
        .read(|path| progress.say(format!("reading {}", path.display())))?;
    progress.say("analyzing");
    let analyzed: Vec<_> = recordings
        .iter()
        .map(|read| (read, analyze(&read.clean)))
        .collect();
    drop(progress);
    let answer = Answer::new(&analyzed, &unusable);
    if let Some(out) = &arguments.out {
        palpate_files::write_whole(out, output::json_text(&answer)?.as_bytes())?;
    }
    if arguments.json {
        return output::json(&answer);
    }
    output::text(table::of(&answer))?;
    if let Some(out) = &arguments.out {
        output::text(format!("written: {}", out.display()))?;
    }
    output::warnings(&answer.warnings);
    output::warnings(&unusable.iter().map(Unusable::sentence).collect::<Vec<_>>());
    Ok(())
}
