//! `palpate validate`: identifies files and checks them.

use std::path::PathBuf;

use clap::Args;
use palpate_jobs::validate::{Validated, validate};
use serde::Serialize;

use crate::failure::Failure;
use crate::output;

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate validate scene.toml motion.csv
      identifies each file and lists its contents, or names the line with the error
  palpate validate tasks/*.toml --json
      one JSON object for a program

Checks scenes, tasks, tissues, protocols and problems (.toml), motions, recordings and sessions (.csv), meshes \
(.stl, .obj, .ply, .gltf, .glb), volume meshes (.msh, .vtk, .vtu) and label maps (.nii, .nrrd, .dcm), with all files that \
they name, without computing. Exit status: 0 if all are valid, 2 \
otherwise.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Files of any kind.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// The answer of `--json`.
#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    valid: Vec<Validated>,
    invalid: Vec<Invalid>,
}

/// An invalid file.
#[derive(Debug, Serialize)]
struct Invalid {
    file: PathBuf,
    reason: String,
}

/// Its warnings, each with the file's name.
fn of_file(valid: &Validated) -> Vec<String> {
    let name = valid.file.display().to_string();
    let named = |warning: &String| match warning.contains(&name) {
        true => warning.clone(),
        false => format!("{name}: {warning}"),
    };
    valid.warnings.iter().map(named).collect()
}

/// Checks all files, and fails if one is invalid.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut answer = Answer {
        palpate: output::VERSION,
        valid: Vec::new(),
        invalid: Vec::new(),
    };
    for file in &arguments.files {
        match validate(file) {
            Ok(valid) => {
                if !arguments.json {
                    output::line(format!(
                        "{}: {}: {}",
                        file.display(),
                        valid.kind.word(),
                        valid.content
                    ))?;
                    output::warnings(&of_file(&valid));
                }
                answer.valid.push(valid);
            }
            Err(error) => {
                let reason = error.to_string();
                if !arguments.json {
                    output::error(&Failure::input(&reason));
                }
                answer.invalid.push(Invalid {
                    file: file.clone(),
                    reason,
                });
            }
        }
    }
    if arguments.json {
        output::json(&answer)?;
    }
    match answer.invalid.len() {
        0 => Ok(()),
        count => Err(Failure::input(format!(
            "{count} of {} files cannot be used as they are",
            arguments.files.len()
        ))),
    }
}
