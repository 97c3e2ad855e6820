//! `palpate mesh`: organ geometry before it is simulated.

mod convert;
mod info;
mod isosurface;
mod simplify;
pub(crate) mod wrap;
mod written;

use std::path::Path;

use clap::Subcommand;
use palpate_geometry::{ImportedMesh, LengthUnit, ReadError, ReadFault, read_mesh};

use crate::failure::Failure;

#[derive(Debug, Subcommand)]
pub(super) enum Mesh {
    /// Check a mesh and report whether it can be simulated.
    Info(info::Arguments),
    /// Write the surface with fewer triangles, and report the deviation from the original.
    Simplify(simplify::Arguments),
    /// Repair a mesh and write it in another format or unit.
    Convert(convert::Arguments),
    /// Extract the surface of an organ from a segmented volume (NIfTI, NRRD).
    Isosurface(isosurface::Arguments),
    /// Wrap a closed surface around any triangles: open, intersecting, duplicated or in many pieces.
    Wrap(wrap::Arguments),
}

/// Runs the subcommand.
pub(super) fn run(mesh: &Mesh) -> Result<(), Failure> {
    match mesh {
        Mesh::Info(arguments) => info::run(arguments),
        Mesh::Simplify(arguments) => simplify::run(arguments),
        Mesh::Convert(arguments) => convert::run(arguments),
        Mesh::Isosurface(arguments) => isosurface::run(arguments),
        Mesh::Wrap(arguments) => wrap::run(arguments),
    }
}

/// Reads a mesh; its warnings name the option `--unit`.
fn read(file: &Path, unit: Option<&str>) -> Result<ImportedMesh, Failure> {
    let unit: Option<LengthUnit> = unit.map(str::parse).transpose()?;
    let mut imported = read_mesh(file, unit).map_err(about_unit)?;
    for warning in &mut imported.warnings {
        *warning = in_words_of_this_command(warning);
    }
    Ok(imported)
}

/// The reader names the scene's key; here it is an option.
fn about_unit(error: ReadError) -> Failure {
    match error.fault {
        ReadFault::UnitNeeded { .. } => {
            Failure::input(in_words_of_this_command(&error.to_string()))
        }
        _ => error.into(),
    }
}

fn in_words_of_this_command(message: &str) -> String {
    message.replace("mesh_unit", "--unit")
}
