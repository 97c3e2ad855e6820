//! `palpate completions` and `palpate manual`: the command line for shells and for `man`.

use std::io;
use std::path::PathBuf;

use clap::{Args, CommandFactory};
use clap_complete::Shell;
use palpate_files::{Claim, write_atomically};

use super::CommandLine;
use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::output;

/// Examples at the end of the help of `completions`.
const COMPLETIONS: &str = "\
Examples:
  palpate completions bash > ~/.local/share/bash-completion/completions/palpate
  palpate completions zsh > ~/.zfunc/_palpate
  palpate completions fish > ~/.config/fish/completions/palpate.fish";

/// Examples at the end of the help of `manual`.
const MANUAL: &str = "\
Examples:
  palpate manual ~/.local/share/man/man1
      then `man palpate` and `man palpate-simulate` show what --help shows";

#[derive(Debug, Args)]
#[command(after_help = COMPLETIONS)]
pub(crate) struct Completions {
    /// The shell.
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

#[derive(Debug, Args)]
#[command(after_help = MANUAL)]
pub(crate) struct Manual {
    /// The folder; it is created if missing.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// Prints the script by which a shell completes the command line.
pub(crate) fn completions(arguments: &Completions) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(
        arguments.shell,
        &mut CommandLine::command(),
        "palpate",
        &mut script,
    );
    output::text(String::from_utf8_lossy(&script))
}

/// Writes a page for the program and one for each command.
pub(crate) fn manual(arguments: &Manual) -> Result<(), Failure> {
    let mut whole = CommandLine::command();
    whole.build();
    let pages = pages(&whole, "palpate").map_err(Failure::failed)?;
    std::fs::create_dir_all(&arguments.folder)
        .map_err(|error| Failure::failed(format!("{}: {error}", arguments.folder.display())))?;
    let path = |name: &String| arguments.folder.join(name);
    let claims = Claim::of_files(
        pages.iter().map(|(name, _)| path(name)),
        arguments.overwrite.rule(),
    )?;
    for (name, page) in &pages {
        write_atomically(path(name), page)?;
    }
    drop(claims);
    output::line(format!(
        "{} pages written into {}",
        pages.len(),
        arguments.folder.display()
    ))
}

/// The pages of a command and of those below it, by file name.
fn pages(command: &clap::Command, name: &str) -> io::Result<Vec<(String, Vec<u8>)>> {
    // A name lives as long as the program, and there are as many as commands.
    let leaked: &'static str = Box::leak(name.to_owned().into_boxed_str());
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone().name(leaked)).render(&mut page)?;
    let mut found = vec![(format!("{name}.1"), page)];
    for below in command.get_subcommands() {
        found.extend(pages(below, &format!("{name}-{}", below.get_name()))?);
    }
    Ok(found)
}
