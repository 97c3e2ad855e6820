//! `palpate reproduce`: the source's tables and figures, published and recomputed.

use std::path::{Path, PathBuf};

use clap::Args;
use palpate_reproduce::{Figures, Item, KEPT, items, legend, section, select};
use serde::Serialize;

use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::interrupt;
use crate::output;
use crate::plot::{Draw, Plot};
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate reproduce --list
  palpate reproduce figure-5-1 table-3-1/solution_s
  palpate reproduce chapter-5 table-3 --out figures --json

A full name selects that item or row; any other word is a prefix. If an item fails, its row states the reason, and \
the others continue. Rows are printed as they finish, and saved in rows.jsonl in the folder, one JSON object per \
line. A dash means no number; the note gives the reason. Exit status: 0 if every row has a number, a figure or a \
reason.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Tables, figures or rows, by name or prefix; default: all.
    #[arg(value_name = "ROW")]
    rows: Vec<String>,
    /// List the tables and figures with their titles, without computing.
    #[arg(long)]
    list: bool,
    /// The folder for figures and finished rows.
    #[arg(long, value_name = "DIR", default_value = "palpate-reproduce")]
    out: PathBuf,
    /// Print a JSON list with one object per row.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// Computes and prints the rows, item by item.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut selection = select(&arguments.rows)?;
    let items = selection.items();
    if arguments.list {
        return list(&items, arguments.json);
    }
    refuse_file(&arguments.out)?;
    let figures = Figures::claimed(&arguments.out, arguments.overwrite.rule(), &items, drawn)?;
    let mut finished = figures.rows();
    interrupt::ends_between_files(format!(
        "interrupted; finished rows are in {}, and the figures that were written are whole",
        arguments.out.join(KEPT).display()
    ));
    // The JSON answer goes to standard output, and may take an hour.
    let progress = Progress::of_works(Reader::Person, items.iter().map(|item| item.seconds).sum());
    let mut all = Vec::new();
    for item in &items {
        let rows = selection.rows_of(item, item.rows(&figures, &progress));
        finished.keep(&rows, &progress)?;
        if !arguments.json && !rows.is_empty() {
            progress.aside(|| output::text(section(item, &rows)))?;
        }
        all.extend(rows);
        progress.work_done(item.seconds);
    }
    drop(progress);
    if !all.is_empty() {
        match arguments.json {
            true => output::json(&all)?,
            false => output::text(legend(&all) + &more(items.len()))?,
        }
    }
    Ok(selection.check()?)
}

/// The picture of a plot.
fn drawn(plot: &Plot) -> Result<Vec<u8>, palpate_jobs::Error> {
    plot.png().map_err(palpate_jobs::Error::failed)
}

/// The items that were not selected.
fn more(selected: usize) -> String {
    match items().len() - selected {
        0 => String::new(),
        left => format!("{left} more items: palpate reproduce --list\n"),
    }
}

/// An item in `--list --json`.
#[derive(Debug, Serialize)]
struct Listed {
    item: &'static str,
    title: &'static str,
    /// Usual duration [s]; 0 when nothing is computed.
    seconds: f64,
}

fn list(items: &[Item], json: bool) -> Result<(), Failure> {
    if json {
        let listed = items.iter().map(|item| Listed {
            item: item.name,
            title: item.title,
            seconds: item.seconds,
        });
        return output::json(&listed.collect::<Vec<_>>());
    }
    let width = items.iter().map(|item| item.name.len()).max().unwrap_or(0);
    let lines = items.iter().map(|item| {
        let time = match item.seconds {
            0.0 => String::new(),
            seconds if seconds < 60.0 => format!("{seconds:.0} s"),
            seconds => format!("{:.0} min", seconds / 60.0),
        };
        format!("{:<width$}  {time:>6}  {}\n", item.name, item.title)
    });
    output::text(lines.collect::<String>())
}

/// Before the work, not after it.
fn refuse_file(folder: &Path) -> Result<(), Failure> {
    match folder.exists() && !folder.is_dir() {
        true => Err(Failure::input(format!(
            "{} is a file and no folder; give another with --out",
            folder.display()
        ))),
        false => Ok(()),
    }
}
