//! Mesh files: STL, OBJ, PLY and glTF in; STL, OBJ, PLY and VTK out; tetrahedra from MSH and VTK;
//! label maps from NIfTI, NRRD and DICOM.

mod base64;
pub(crate) mod error;
pub(crate) mod format;
mod gltf;
pub(crate) mod label_map;
mod obj;
mod ply;
mod raw;
mod stl;
mod text;
pub(crate) mod unit;
pub(crate) mod volume;
pub mod vtk;
pub(crate) mod write;

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::Path;

use self::raw::RawMesh;
use self::unit::{extent_warning, unit_by_extent};
use crate::weld::weld_exactly;
use crate::{LengthUnit, MeshFormat, NodeId, ReadError, ReadFault, TriangleMesh, Vec3};

/// Bytes that are read of a mesh with all its buffers, or of a volume, at most: no mesh needs more, and a wrong path (a
/// film, a disk image) should fail at once.
const MAX_BYTES: u64 = 1 << 30;

/// A mesh as its file has it, but in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedMesh {
    /// The triangles [m]. Nothing was repaired. Coincident vertices were joined only where the
    /// format forces them apart (STL writes each corner out, glTF each corner of a seam).
    pub mesh: TriangleMesh,
    /// The format that the file was in.
    pub format: MeshFormat,
    /// The unit that the coordinates were in.
    pub unit: LengthUnit,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Reads a mesh file. The format is that of the extension. Without a `unit`, glTF is in metres by
/// its standard; for the other formats metres are taken when that makes a plausible organ.
///
/// # Errors
/// When the file cannot be read, is damaged, holds no triangles, or is of unknown unit; the error
/// names the path, the cause and the remedy.
pub fn read_mesh(path: &Path, unit: Option<LengthUnit>) -> Result<ImportedMesh, ReadError> {
    read_here(path, unit).map_err(|fault| ReadError {
        path: path.to_owned(),
        fault,
    })
}

fn read_here(path: &Path, unit: Option<LengthUnit>) -> Result<ImportedMesh, ReadFault> {
    let bytes = read_whole(path, MAX_BYTES)?;
    let format = MeshFormat::of(path, &bytes)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let raw = match format {
        MeshFormat::Stl => stl::read(&bytes)?,
        MeshFormat::Obj => obj::read(&bytes)?,
        MeshFormat::Ply => ply::read(&bytes)?,
        MeshFormat::Gltf => gltf::read(&bytes, folder)?,
    };
    let extent = largest_extent(&raw);
    let unit = match (unit, format) {
        (Some(unit), _) => unit,
        (None, MeshFormat::Gltf) => LengthUnit::Metre,
        (None, _) => unit_by_extent(extent)?,
    };
    let mesh = in_metres(raw, unit)?;
    let mut warnings: Vec<_> = extent_warning(extent * unit.in_metres())
        .into_iter()
        .collect();
    if format == MeshFormat::Gltf && unit != LengthUnit::Metre {
        let symbol = unit.symbol();
        warnings.push(format!(
            "glTF is in metres by its standard, but was read in {symbol} as mesh_unit asks"
        ));
    }
    let mesh = match format {
        MeshFormat::Stl | MeshFormat::Gltf => weld_exactly(&mesh).0,
        MeshFormat::Obj | MeshFormat::Ply => mesh,
    };
    Ok(ImportedMesh {
        mesh,
        format,
        unit,
        warnings,
    })
}

fn in_metres(raw: RawMesh, unit: LengthUnit) -> Result<TriangleMesh, ReadFault> {
    let vertices = in_unit(&raw.vertices, unit);
    let triangles = raw.triangles.iter().map(|t| t.map(NodeId)).collect();
    Ok(TriangleMesh::new(vertices, triangles)?)
}

/// Coordinates of a file in this unit, in metres.
fn in_unit(vertices: &[Vec3], unit: LengthUnit) -> Vec<Vec3> {
    // Divided where the unit is a fraction of a metre: 0.1 mm is then the same number as 0.0001 m.
    let per_metre = 1.0 / unit.in_metres();
    let whole = per_metre.round();
    if (per_metre / whole - 1.0).abs() < 1e-12 {
        vertices.iter().map(|v| v / whole).collect()
    } else {
        vertices.iter().map(|v| v * unit.in_metres()).collect()
    }
}

fn largest_extent(raw: &RawMesh) -> f64 {
    let mut low = Vec3::repeat(f64::INFINITY);
    let mut high = Vec3::repeat(f64::NEG_INFINITY);
    for &corner in raw.triangles.iter().flatten() {
        low = low.inf(&raw.vertices[corner as usize]);
        high = high.sup(&raw.vertices[corner as usize]);
    }
    (high - low).max()
}

/// All bytes of a file, of which there may be so many, or why not.
fn read_whole(path: &Path, most: u64) -> Result<Vec<u8>, ReadFault> {
    let refused = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => ReadFault::Missing,
        _ => ReadFault::Unreadable(error),
    };
    let metadata = fs::metadata(path).map_err(refused)?;
    if !metadata.is_file() {
        return Err(ReadFault::NotAFile);
    }
    let too_large = |found| ReadFault::TooLarge {
        what: "bytes",
        found,
        most,
    };
    if metadata.len() > most {
        return Err(too_large(metadata.len()));
    }
    let mut bytes = Vec::new();
    // It may grow meanwhile.
    let file = fs::File::open(path).map_err(refused)?;
    file.take(most.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(refused)?;
    match bytes.len() as u64 {
        0 => Err(ReadFault::Empty),
        found if found > most => Err(too_large(found)),
        _ => Ok(bytes),
    }
}
