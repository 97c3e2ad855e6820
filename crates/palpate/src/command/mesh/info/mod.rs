//! `palpate mesh info`: the size of a mesh, its defects, and whether it can be simulated.

mod answer;
mod table;

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use palpate_jobs::builtin_organ;

use self::answer::{Answer, Origin};
use crate::failure::Failure;
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate mesh info liver.stl --unit mm
  palpate mesh info scan.glb --json
  palpate mesh info --builtin kidney --triangles 8000

The report describes the mesh as it is in the file (only STL and glTF, which repeat vertices, are welded first), and \
what a repair would change. An invalid mesh is no error of this command: the exit status is 0 unless the file cannot \
be read.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, group(ArgGroup::new("mesh").required(true)))]
pub(crate) struct Arguments {
    /// The mesh: STL, OBJ, PLY or glTF.
    #[arg(group = "mesh")]
    file: Option<PathBuf>,
    /// A built-in organ instead of a file: esophagus, liver, kidney, stomach, spleen, diaphragm, hemisphere, cube, slab.
    #[arg(long, value_name = "NAME", group = "mesh")]
    builtin: Option<String>,
    /// The unit of the file: m, cm, mm or um.
    #[arg(long, conflicts_with = "builtin")]
    unit: Option<String>,
    /// Number of triangles of the built-in organ.
    #[arg(long, value_name = "N", conflicts_with = "file")]
    triangles: Option<usize>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Prints the report.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let progress = Progress::new(Reader::of_json(arguments.json), None);
    progress.show_step("reading the mesh");
    let answer = match (&arguments.file, &arguments.builtin) {
        (Some(file), _) => of_file(file, arguments.unit.as_deref(), &progress)?,
        (None, name) => of_builtin(name.as_deref().unwrap_or_default(), arguments, &progress)?,
    };
    drop(progress);
    if arguments.json {
        return output::json(&answer);
    }
    output::warnings(&answer.warnings);
    output::text(table::of(&answer))
}

fn of_file(file: &Path, unit: Option<&str>, progress: &Progress) -> Result<Answer, Failure> {
    let imported = super::read(file, unit)?;
    progress.show_step("looking for holes, crossings and slivers");
    let origin = Origin::File {
        file: file.to_owned(),
        format: imported.format.to_string(),
        unit: imported.unit.symbol(),
    };
    Ok(Answer::new(origin, &imported.mesh, imported.warnings))
}

fn of_builtin(name: &str, arguments: &Arguments, progress: &Progress) -> Result<Answer, Failure> {
    let organ = builtin_organ(name)?;
    let triangles = arguments.triangles;
    let mesh = organ.surface_mesh(triangles.unwrap_or(organ.default_triangles()))?;
    progress.show_step("looking for holes, crossings and slivers");
    Ok(Answer::new(Origin::Builtin(organ), &mesh, Vec::new()))
}
