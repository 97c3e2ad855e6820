//! `palpate reproduce`: the source's tables and figures, published beside ours.

use std::path::{Path, PathBuf};

use clap::Args;

use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::interrupt;
use crate::output;
use crate::progress::{Progress, Reader};
use crate::reproduce::{Figures, ITEMS, Item, Rows, select, table};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate reproduce
  palpate reproduce table-3-1 figure-4-5 --out figures
  palpate reproduce table-3-1/solution --json

A dash stands where there is no number; the note says why.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Tables, figures or rows, by how they begin; without one, everything.
    #[arg(value_name = "ROW")]
    rows: Vec<String>,
    /// The folder for figures; it is made when there is one to write.
    #[arg(long, value_name = "DIR", default_value = "palpate-reproduce")]
    out: PathBuf,
    /// Print a JSON list with one object per row.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// Computes and prints the rows.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let selection = select(&arguments.rows)?;
    refuse_file(&arguments.out)?;
    let items = selection.items();
    let figures = Figures::new(&arguments.out, arguments.overwrite.rule());
    figures.check(&items)?;
    interrupt::ends_between_files("interrupted; the figures that were written are whole");
    let progress = Progress::new(Reader::of_json(arguments.json), Some(items.len() as u64));
    let mut rows = Vec::new();
    for item in &items {
        let mut own = Rows::of(item.name, &figures, &progress);
        (item.run)(&mut own)?;
        rows.extend(own.done());
        progress.step();
    }
    drop(progress);
    let rows = selection.rows(rows)?;
    if arguments.json {
        return output::json(&rows);
    }
    output::text(format!("{}\n{}", titles(&items), table(&rows)))
}

fn titles(items: &[Item]) -> String {
    let width = items.iter().map(|item| item.name.len()).max().unwrap_or(0);
    let titles = items
        .iter()
        .map(|item| format!("{:<width$}  {}\n", item.name, item.title));
    let left = ITEMS.len() - items.len();
    let more = match left {
        0 => String::new(),
        _ => format!("({left} more without a selection)\n"),
    };
    titles.collect::<String>() + &more
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
