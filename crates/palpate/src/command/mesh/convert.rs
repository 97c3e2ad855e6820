//! `palpate mesh convert`: the same mesh in another format or unit.

use std::path::PathBuf;

use clap::Args;
use palpate_geometry::{LengthUnit, repair};
use serde::Serialize;

use super::written::{Output, Written, repair_sentences};
use crate::command::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use crate::{interrupt, output};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate mesh convert scan.stl kidney.ply --unit mm
      reads millimetres, writes metres
  palpate mesh convert organ.glb organ.stl --to-unit mm
      for a program that wants millimetres

The extension states the format: reads STL, OBJ, PLY, glTF and GLB; writes STL, OBJ, PLY and VTP (ParaView). Merges \
repeated vertices and orients triangles outward; reports each repair.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The mesh: STL, OBJ, PLY or glTF.
    #[arg(value_name = "MESH")]
    file: PathBuf,
    /// The file to write: .stl, .obj, .ply or .vtp.
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// The unit of the file: m, cm, mm or um.
    #[arg(long)]
    unit: Option<String>,
    /// The unit to write.
    #[arg(long, value_name = "UNIT", default_value = "m")]
    to_unit: String,
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
    repaired: Vec<String>,
    warnings: Vec<String>,
}

/// Reads, repairs and writes.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let unit: LengthUnit = arguments.to_unit.parse()?;
    let out = Output::new(&arguments.out, unit)?;
    let _claims = arguments.overwrite.claim([&arguments.out])?;
    interrupt::ends_between_files("interrupted; nothing was converted");
    let progress = Progress::new(Reader::of_json(arguments.json), None);
    progress.show_step("reading the mesh");
    let imported = super::read(&arguments.file, arguments.unit.as_deref())?;
    let (mesh, repairs) = repair(&imported.mesh)?;
    let answer = Answer {
        palpate: output::VERSION,
        written: out.write(&mesh)?,
        repaired: repair_sentences(&repairs),
        warnings: imported.warnings,
    };
    drop(progress);
    if arguments.json {
        return output::json(&answer);
    }
    output::warnings(&answer.warnings);
    for repaired in &answer.repaired {
        output::line(repaired)?;
    }
    output::line(format!(
        "{} triangles written to {}, in {}",
        answer.written.triangles,
        answer.written.file.display(),
        unit.symbol()
    ))
}
