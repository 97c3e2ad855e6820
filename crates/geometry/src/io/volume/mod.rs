//! Files of tetrahedra: Gmsh MSH 2 and 4.1, VTK legacy, VTK XML (`.vtu`).
//!
//! Points, lines and faces are passed over. Of tetrahedra with nodes on their edges the corners are
//! used; a solver makes such nodes again. Inverted tetrahedra are turned. Files of text are read, and
//! `.vtu` also with uncompressed numbers between its tags, as [`crate::vtk`] writes it.
//!
//! *How we know*: `volumes::every_format_gives_the_tetrahedra_back`,
//! `volumes::bad_files_are_refused_with_their_place`, `fuzz::damaged_volumes_never_panic`.
//!
//! The region of a cell is its first physical group in MSH, and a whole number in the cell data of VTK: that of the first
//! array with one of the usual names (`REGION_ARRAYS`).

mod cells;
mod msh;
mod vtk_legacy;
mod vtu;
mod words;

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use super::raw::RawMesh;
use super::unit::{extent_warning, unit_by_extent};
use super::{MAX_BYTES, in_unit, read_whole};
use crate::mesh::tetrahedra::six_fold_volume;
use crate::{LengthUnit, NodeId, ReadError, ReadFault, TetrahedronMesh, Vec3};

/// The format of a file of tetrahedra.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VolumeFormat {
    /// Gmsh MSH, 2 or 4.1.
    Msh,
    /// VTK legacy.
    VtkLegacy,
    /// VTK XML unstructured grid.
    Vtu,
}

/// Tetrahedra as their file has them, but in metres and all positive.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedTetrahedra {
    /// The tetrahedra [m]. Vertices that none uses were dropped; the others keep their order.
    pub mesh: TetrahedronMesh,
    /// The format that the file was in.
    pub format: VolumeFormat,
    /// The unit that the coordinates were in.
    pub unit: LengthUnit,
    /// The regions of the file, in ascending order; those of the mesh are places in this list.
    pub regions: Vec<VolumeRegion>,
    /// Tetrahedra that were inverted, and have been turned.
    pub turned: usize,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Tetrahedra that belong together in their file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VolumeRegion {
    /// Its number in the file; 0 for tetrahedra that have none.
    pub number: i64,
    /// Its name, of a physical group that has one.
    pub name: Option<String>,
    /// How many tetrahedra it has.
    pub tetrahedra: usize,
}

/// Tetrahedra in the unit of the file. Vertices are checked, corners are in range.
#[derive(Debug, Default)]
struct RawVolume {
    points: RawMesh,
    tetrahedra: Vec<[u32; 4]>,
    /// Number of the region of each tetrahedron.
    regions: Vec<i64>,
    /// Names of regions, by their numbers.
    names: BTreeMap<i64, String>,
}

/// Arrays of cell data that number regions, as this crate, Gmsh, meshio, ParaView, SimpleITK and OpenGeoSys call them.
const REGION_ARRAYS: [&str; 8] = [
    "region",
    "gmsh:physical",
    "medit:ref",
    "CellEntityIds",
    "MaterialIDs",
    "material",
    "label",
    "labels",
];

/// Reads a file of tetrahedra. The format is that of the extension. Without a `unit`, metres are
/// taken when that makes a plausible organ.
///
/// # Errors
/// When the file cannot be read, is damaged, holds other volume elements or flat tetrahedra, or is
/// of unknown unit; the error names the path, the cause and the remedy.
pub fn read_tetrahedra(
    path: &Path,
    unit: Option<LengthUnit>,
) -> Result<ImportedTetrahedra, ReadError> {
    read_here(path, unit).map_err(|fault| ReadError {
        path: path.to_owned(),
        fault,
    })
}

fn read_here(path: &Path, unit: Option<LengthUnit>) -> Result<ImportedTetrahedra, ReadFault> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let format = match extension.to_ascii_lowercase().as_str() {
        "msh" => VolumeFormat::Msh,
        "vtk" => VolumeFormat::VtkLegacy,
        "vtu" => VolumeFormat::Vtu,
        _ => {
            let found = extension.chars().take(40).collect();
            return Err(ReadFault::UnknownVolumeExtension { found });
        }
    };
    let bytes = read_whole(path, MAX_BYTES)?;
    let text = String::from_utf8_lossy(&bytes);
    let raw = match format {
        VolumeFormat::Msh => msh::read(&text)?,
        VolumeFormat::VtkLegacy => vtk_legacy::read(&text)?,
        VolumeFormat::Vtu => vtu::read(&text)?,
    };
    if raw.tetrahedra.is_empty() {
        return Err(ReadFault::NoTetrahedra);
    }
    let extent = largest_extent(&raw);
    let unit = match unit {
        Some(unit) => unit,
        None => unit_by_extent(extent)?,
    };
    let vertices = in_unit(&raw.points.vertices, unit);
    let mut tetrahedra: Vec<[NodeId; 4]> = raw.tetrahedra.iter().map(|t| t.map(NodeId)).collect();
    let mut turned = 0;
    for corners in &mut tetrahedra {
        if six_fold_volume(&corners.map(|node| vertices[node.index()])) < 0.0 {
            corners.swap(2, 3);
            turned += 1;
        }
    }
    let (regions, numbers) = regions(&raw);
    Ok(ImportedTetrahedra {
        mesh: TetrahedronMesh::new(vertices, tetrahedra)?.with_regions(numbers)?,
        format,
        unit,
        regions,
        turned,
        warnings: extent_warning(extent * unit.in_metres())
            .into_iter()
            .collect(),
    })
}

/// The regions of a file, and the place of that of each tetrahedron among them.
fn regions(raw: &RawVolume) -> (Vec<VolumeRegion>, Vec<u32>) {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for number in &raw.regions {
        *counts.entry(*number).or_default() += 1;
    }
    let places: BTreeMap<i64, u32> = counts.keys().copied().zip(0..).collect();
    let regions = counts.iter().map(|(number, count)| VolumeRegion {
        number: *number,
        name: raw.names.get(number).cloned(),
        tetrahedra: *count,
    });
    let numbers = raw.regions.iter();
    (
        regions.collect(),
        numbers.map(|number| places[number]).collect(),
    )
}

fn largest_extent(raw: &RawVolume) -> f64 {
    let mut low = Vec3::repeat(f64::INFINITY);
    let mut high = Vec3::repeat(f64::NEG_INFINITY);
    for &corner in raw.tetrahedra.iter().flatten() {
        low = low.inf(&raw.points.vertices[corner as usize]);
        high = high.sup(&raw.points.vertices[corner as usize]);
    }
    (high - low).max()
}

impl fmt::Display for VolumeFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Msh => "Gmsh MSH",
            Self::VtkLegacy => "VTK legacy",
            Self::Vtu => "VTK XML",
        })
    }
}
