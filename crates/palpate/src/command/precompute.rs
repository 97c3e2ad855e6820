//! `palpate precompute`: computes the global response of an organ once and caches it.

use std::path::PathBuf;

use clap::Args;
use palpate_files::Scene;
use palpate_jobs::preparation::{Precomputed, precompute};

use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use crate::{output, preparation};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate precompute scene.toml
      solves the response to a force on each touchable triangle, and caches it
  palpate precompute scene.toml --memory-gb 4 --json
      refuses to use more than 4 GB; prints one JSON object

The hybrid model (`model.kind = \"hybrid\"`) needs this once per organ, Poisson's ratio and anchor; the \
stiffness of the tissue, tips and tools can change without it. `palpate simulate` runs it when needed. To reduce time \
and memory, set
  [model]
  mechanical_triangles = 2000         the displayed surface keeps its own triangles
  [organ.touchable]
  spheres = [{ center_m = [0.0, 0.0, 0.05], radius_m = 0.03 }]
The responses are cached in the system's cache folder, or in the folder that PALPATE_CACHE names.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The scene.
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Memory limit [GB]; default: four fifths of the free memory, within ulimit and control groups.
    #[arg(long, value_name = "GB", value_parser = positive)]
    memory_gb: Option<f64>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Prepares and reports.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = Scene::read(&arguments.scene)?;
    let mut resources = preparation::resources();
    if let Some(memory) = arguments.memory_gb {
        resources.memory = (1e9 * memory) as usize;
    }
    let bar = Progress::of_parts(Reader::of_json(arguments.json));
    let answer = precompute(scene, &resources, &bar)?;
    drop(bar);
    if arguments.json {
        output::json(&answer)?;
    } else {
        output::text(text(&answer))?;
        output::warnings(&answer.warnings);
    }
    // The command has no other purpose than to cache it.
    match answer.file {
        Some(_) => Ok(()),
        None => Err(Failure::failed(
            "the organ's response was solved and could not be kept, as the warning says; make room, or name another \
             folder by PALPATE_CACHE",
        )),
    }
}

fn text(answer: &Precomputed) -> String {
    let what = format!(
        "{} of {} mechanical triangles can be touched, by {}; {:.1} MB; {:.1} s",
        answer.touchable_triangles,
        answer.mechanical_triangles,
        answer.method,
        1e-6 * answer.memory_bytes as f64,
        answer.seconds,
    );
    match &answer.file {
        Some(file) if answer.was_kept => format!("{what}\nkept before in {}", file.display()),
        Some(file) => format!("{what}\nkept in {}", file.display()),
        None => format!("{what}\nnot cached"),
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if number > 0.0 && f64::is_finite(number) => Ok(number),
        _ => Err("give a number above 0".to_owned()),
    }
}
