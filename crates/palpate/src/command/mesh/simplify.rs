//! `palpate mesh simplify`: fewer triangles for the same surface.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use palpate_geometry::{Deviation, LengthUnit, SimplifySettings, repair, simplify_with_progress};
use palpate_jobs::ProgressCallback;
use serde::Serialize;

use super::written::{Output, Written, repair_sentences};
use crate::command::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use crate::{interrupt, output};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate mesh simplify esophagus.ply esophagus-3726.ply --triangles 3726
  palpate mesh simplify scan.stl small.stl --unit mm --triangles 5000 --json

Preserves sharp edges, borders, handles and volume, and makes triangles even in size, as mechanical models need them. \
The deviation is measured in both directions between the two surfaces.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The mesh: STL, OBJ, PLY or glTF.
    #[arg(value_name = "MESH")]
    file: PathBuf,
    /// The file to write, in metres: .stl, .obj, .ply or .vtp.
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// Number of triangles; a closed mesh has an even number.
    #[arg(long, value_name = "N")]
    triangles: usize,
    /// The unit of the file: m, cm, mm or um.
    #[arg(long)]
    unit: Option<String>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    #[serde(flatten)]
    written: Written,
    triangles_before: usize,
    /// Part of the volume before.
    volume_change: f64,
    original_to_result: Deviation,
    result_to_original: Deviation,
    seconds: f64,
    warnings: Vec<String>,
}

/// Simplifies and reports.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let out = Output::new(&arguments.out, LengthUnit::Metre)?;
    let _claims = arguments.overwrite.claim([&arguments.out])?;
    interrupt::ends_between_files("interrupted; nothing was simplified");
    let progress = Progress::of_job(Reader::of_json(arguments.json));
    progress.show_step("reading the mesh");
    let mut imported = super::read(&arguments.file, arguments.unit.as_deref())?;
    let (mesh, repairs) = repair(&imported.mesh)?;
    let warnings = &mut imported.warnings;
    warnings.extend(repair_sentences(&repairs));
    progress.show_step(format!(
        "{} triangles become {}",
        mesh.triangles().len(),
        arguments.triangles
    ));
    let begin = Instant::now();
    let settings = SimplifySettings::to(arguments.triangles);
    let simplified = simplify_with_progress(&mesh, &settings, &mut |part| {
        ProgressCallback::report_fraction(&progress, part);
        ControlFlow::Continue(())
    });
    let simplified = simplified?;
    let seconds = begin.elapsed().as_secs_f64();
    warnings.extend(simplified.warning());
    let answer = Answer {
        palpate: output::VERSION,
        written: out.write(&simplified.mesh)?,
        triangles_before: mesh.triangles().len(),
        volume_change: simplified.mesh.volume() / mesh.volume() - 1.0,
        original_to_result: simplified.of_original,
        result_to_original: simplified.of_result,
        seconds,
        warnings: imported.warnings,
    };
    drop(progress);
    if arguments.json {
        return output::json(&answer);
    }
    output::warnings(&answer.warnings);
    output::text(answer.text())
}

impl Answer {
    fn text(&self) -> String {
        format!(
            "{} triangles became {}, written to {} in metres\n\
             from the original to the result  {}\n\
             from the result to the original  {}\n\
             volume                           {:+.3} %",
            self.triangles_before,
            self.written.triangles,
            self.written.file.display(),
            self.original_to_result,
            self.result_to_original,
            100.0 * self.volume_change,
        )
    }
}
