//! `palpate analyze`: analysis of recordings without a material model.

mod report;
mod table;

use clap::Args;
use palpate_files::write_atomically;
use palpate_jobs::analyze::analyze;
use palpate_jobs::json_text;
use std::path::PathBuf;

use super::overwrite::OverwriteOption;
use super::recordings::Recordings;
use crate::failure::Failure;
use crate::interrupt::{self, UninterruptedSection};
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate analyze liver-2mm.csv
      static force, relaxation, and the response to sines and chirps
  palpate analyze recordings/ --json > analysis.json
      every recording of a folder, and each organ across subjects
  palpate analyze recordings/ --report analysis.html
      the same as an HTML report with plots
  palpate analyze test.txt --depth 'Extension' --depth-unit mm --force 'Load' --force-unit N
      a table written by another program

Steady force is the mean of the last tenth of a hold. The phase is positive when force leads depth, \
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
    /// Write an HTML report with plots.
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// Analyzes and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let files = arguments.out.iter().chain(&arguments.report);
    let _claims = arguments.overwrite.claim(files)?;
    interrupt::ends_between_files("interrupted; nothing was analyzed");
    let progress = Progress::new(Reader::of_json(arguments.json), None);
    let recordings = arguments.recordings.request();
    let analyzed = analyze(&recordings, &progress)?;
    drop(progress);
    let unbroken = UninterruptedSection::begin();
    if let Some(out) = &arguments.out {
        write_atomically(out, json_text(&analyzed)?.as_bytes())?;
    }
    if let Some(page) = &arguments.report {
        let html = report::html(&analyzed, &recordings.options());
        write_atomically(page, html.as_bytes())?;
    }
    drop(unbroken);
    if arguments.json {
        return output::json(&analyzed);
    }
    output::text(table::of(&analyzed))?;
    for written in arguments.out.iter().chain(&arguments.report) {
        output::line(format!("written: {}", written.display()))?;
    }
    output::warnings(&analyzed.warnings());
    Ok(())
}
