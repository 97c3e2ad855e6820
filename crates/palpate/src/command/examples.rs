//! `palpate examples`: the example files of the documentation, written into a folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use palpate_files::write_atomically;
use palpate_jobs::documents;
use palpate_jobs::solve::Problem;

use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::output;

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate examples .
      writes all examples to this folder, in which the commands of the documentation then run
  palpate examples examples --overwrite
      restores the original files

Prints a list of the files. `schemas/` contains JSON Schemas for completion and checks in editors. \
`palpate validate FILE` checks a file after editing.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The folder; it is created if missing.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// A file with the sentence that is printed next to its name.
struct Example {
    file: &'static str,
    text: &'static str,
    what: &'static str,
}

macro_rules! example {
    ($file:literal, $source:literal, $what:literal) => {
        Example {
            file: $file,
            text: include_str!(concat!("../../../../assets/", $source)),
            what: $what,
        }
    };
}

const ALL: &[Example] = &[
    example!(
        "scene.toml",
        "first/scene.toml",
        "a hemisphere under a probe"
    ),
    example!(
        "motion.csv",
        "first/motion.csv",
        "the probe goes 3 mm deep, holds and comes back"
    ),
    example!(
        "closed-loop.toml",
        "first/closed-loop.toml",
        "a block of the tissue that was found"
    ),
    example!(
        "liver-4mm.csv",
        "first/liver-4mm.csv",
        "a table of depth and force of another program, to be fitted"
    ),
    example!(
        "strip-0.csv",
        "first/strip-0.csv",
        "a strip of muscle, pulled along its fibres"
    ),
    example!(
        "strip-45.csv",
        "first/strip-45.csv",
        "the same at 45 degrees to them"
    ),
    example!("strip-90.csv", "first/strip-90.csv", "the same across them"),
    example!(
        "esophagus/scene.toml",
        "esophagus/scene.toml",
        "the lower esophagus under a probe"
    ),
    example!(
        "esophagus/motion.csv",
        "esophagus/motion.csv",
        "a motion on it"
    ),
    example!(
        "esophagus/trainer.toml",
        "esophagus/trainer.toml",
        "the scene of free play: grasper and scissors"
    ),
    example!(
        "esophagus/myotomy.csv",
        "esophagus/myotomy.csv",
        "two strokes through its muscle"
    ),
    example!(
        "esophagus/palpate.csv",
        "esophagus/palpate.csv",
        "a probe slides along it"
    ),
    example!(
        "esophagus/pull.csv",
        "esophagus/pull.csv",
        "a grasper pulls it"
    ),
    example!(
        "esophagus/beside.toml",
        "esophagus/beside.toml",
        "the esophagus beside a body that bends: for pull.csv"
    ),
    example!(
        "tasks/palpation.toml",
        "tasks/palpation.toml",
        "a task: find the lump"
    ),
    example!(
        "tasks/traction.toml",
        "tasks/traction.toml",
        "a task: an even pull"
    ),
    example!(
        "tasks/retraction.toml",
        "tasks/retraction.toml",
        "a task: lift a lobe and touch what it covers"
    ),
    example!(
        "tasks/cutting.toml",
        "tasks/cutting.toml",
        "a task: cut out a circle along its line"
    ),
    example!(
        "tasks/myotomy.toml",
        "tasks/myotomy.toml",
        "a task: cut the muscle and leave the mucosa"
    ),
    example!(
        "problems/punch.toml",
        "problems/punch.toml",
        "a flat punch on a block"
    ),
    example!(
        "problems/friction.toml",
        "problems/friction.toml",
        "a punch with Coulomb friction"
    ),
    example!(
        "problems/ramp.toml",
        "problems/ramp.toml",
        "a ramp and a hold over time"
    ),
    example!(
        "problems/hemisphere.toml",
        "problems/hemisphere.toml",
        "a patch on a hemisphere"
    ),
    example!(
        "problems/tube.toml",
        "problems/tube.toml",
        "a tube under pressure"
    ),
    example!(
        "problems/artery.toml",
        "problems/artery.toml",
        "an artery under pressure, with its fibres"
    ),
    example!(
        "problems/strip.toml",
        "problems/strip.toml",
        "a strip of its wall, pulled"
    ),
    example!(
        "problems/uniaxial.toml",
        "problems/uniaxial.toml",
        "a stretched bar"
    ),
    example!(
        "problems/kidney.toml",
        "problems/kidney.toml",
        "an organ, fixed and moved"
    ),
    example!(
        "problems/tumour.toml",
        "problems/tumour.toml",
        "the same organ with a layer and a tumour"
    ),
    example!(
        "problems/cyst.toml",
        "problems/cyst.toml",
        "a body with a cyst full of fluid under a patch"
    ),
    example!(
        "problems/slide.toml",
        "problems/slide.toml",
        "a plate that presses a block and is dragged along it, with friction"
    ),
    example!(
        "problems/beam_weight.toml",
        "problems/beam_weight.toml",
        "a beam under its weight, whose stiffness is fitted"
    ),
    example!(
        "problems/beam_load.toml",
        "problems/beam_load.toml",
        "the same beam under a load, predicted"
    ),
    example!("problems/beam.msh", "problems/beam.msh", "its tetrahedra"),
];

/// Writes them all, or none where one exists already.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut files = Vec::new();
    let mut schemas = BTreeMap::new();
    for example in ALL {
        let mut text = example.text.to_owned();
        if let Some(kind) = example.kind()? {
            let folders_up = "../".repeat(example.file.matches('/').count());
            let schema = format!("schemas/{}.schema.json", kind.word);
            text = format!("#:schema {folders_up}{schema}\n{text}");
            schemas.insert(schema, documents::schema(&kind));
        }
        files.push((example.file.to_owned(), text));
    }
    files.extend(schemas);
    for (file, _) in &files {
        let path = arguments.folder.join(file);
        make_folder(path.parent().unwrap_or(&arguments.folder))?;
    }
    let paths = files.iter().map(|(file, _)| arguments.folder.join(file));
    let claims = arguments.overwrite.claim(paths)?;
    for (file, text) in &files {
        write_atomically(arguments.folder.join(file), text.as_bytes())?;
    }
    drop(claims);
    let widest = ALL.iter().map(|example| example.file.len()).max();
    let widest = widest.unwrap_or_default();
    for Example { file, what, .. } in ALL {
        output::line(format!("{file:widest$}  {what}"))?;
    }
    output::line(format!("written into {}", arguments.folder.display()))
}

impl Example {
    /// The kind of document that it is; none for a table.
    fn kind(&self) -> Result<Option<documents::Kind>, Failure> {
        if !self.file.ends_with(".toml") {
            return Ok(None);
        }
        let word = match self.file.starts_with("problems/") {
            true => Problem::parse(self.text, Path::new(self.file))?.kind(),
            false => "scene",
        };
        Ok(documents::kind(word))
    }
}

fn make_folder(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure::failed(format!(
            "{}: the folder cannot be made: {error}",
            folder.display()
        ))
    })
}
