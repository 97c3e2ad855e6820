use std::path::{Path, PathBuf};

use palpate_files::write_atomically;
use palpate_geometry::{LengthUnit, ReadError, Repairs, TriangleMesh, WriteFormat};
use serde::Serialize;

use crate::failure::Failure;
use crate::interrupt::UninterruptedSection;

/// A file to write.
pub(super) struct Output {
    path: PathBuf,
    format: WriteFormat,
    unit: LengthUnit,
}

/// A written file.
#[derive(Debug, Serialize)]
pub(super) struct Written {
    #[serde(serialize_with = "palpate_jobs::lossy")]
    pub(super) file: PathBuf,
    unit: &'static str,
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    pub(super) volume_m3: f64,
}

impl Output {
    /// In the format that its name says.
    pub(super) fn new(path: &Path, unit: LengthUnit) -> Result<Self, Failure> {
        let format = WriteFormat::of(path).map_err(|fault| ReadError {
            path: path.to_owned(),
            fault,
        })?;
        Ok(Self {
            path: path.to_owned(),
            format,
            unit,
        })
    }

    /// Writes `mesh`, whole or not at all.
    pub(super) fn write(self, mesh: &TriangleMesh) -> Result<Written, Failure> {
        let bytes = self.format.bytes(mesh, self.unit);
        let _unbroken = UninterruptedSection::begin();
        write_atomically(&self.path, &bytes)?;
        Ok(Written {
            file: self.path,
            unit: self.unit.symbol(),
            vertices: mesh.vertices().len(),
            triangles: mesh.triangles().len(),
            volume_m3: mesh.volume(),
        })
    }
}

/// `out` with `name` at the end of its stem.
pub(super) fn with_stem_suffix(out: &Path, name: &str) -> PathBuf {
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let extension = out.extension().unwrap_or_default().to_string_lossy();
    out.with_file_name(format!("{stem}-{name}.{extension}"))
}

/// The repairs, as sentences.
pub(super) fn repair_sentences(repairs: &Repairs) -> Vec<String> {
    let counts = [
        (
            repairs.welded_vertices,
            "vertices were joined to another in the same place",
        ),
        (
            repairs.degenerate_triangles,
            "triangles without area were dropped",
        ),
        (
            repairs.unused_vertices,
            "vertices that no triangle uses were dropped",
        ),
        (repairs.flipped_triangles, "triangles were turned over"),
    ];
    let done = counts.iter().filter(|(count, _)| *count > 0);
    done.map(|(count, what)| format!("{count} {what}"))
        .collect()
}
