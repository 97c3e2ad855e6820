use std::path::{Path, PathBuf};

use palpate_files::write_atomically;
use palpate_geometry::{Vec3, vtk};
use palpate_simulate::{Frame, Simulation};

use crate::failure::Failure;

/// Writes the deformed surface with its displacement at even times, for ParaView.
pub(super) struct Surfaces<'a> {
    folder: &'a Path,
    wanted: u64,
    written: Vec<(f64, String)>,
}

impl<'a> Surfaces<'a> {
    pub(super) fn new(folder: &'a Path, wanted: u64) -> Self {
        Self {
            folder,
            wanted,
            written: Vec::new(),
        }
    }

    /// Writes this step's surface when it is due: the first step's, and so on to the last.
    pub(super) fn add(
        &mut self,
        simulation: &Simulation,
        frame: &Frame<'_>,
    ) -> Result<(), Failure> {
        let count = self.written.len() as u64;
        if !frame.is_due(count, self.wanted) {
            return Ok(());
        }
        let cuts = frame.state.cuts.as_ref().filter(|cuts| cuts.has_openings());
        let (rest, triangles, moved) = match cuts {
            Some(cuts) => (cuts.mesh(), cuts.triangles(), cuts.places()),
            None => {
                let mesh = simulation.surface().mesh();
                (mesh, mesh.triangles(), frame.state.deformed.vertices())
            }
        };
        let displacement: Vec<Vec3> = moved
            .iter()
            .zip(rest.vertices())
            .map(|(x, rest)| x - rest)
            .collect();
        let field = vtk::PointField {
            name: "displacement_m",
            values: vtk::FieldValues::Vectors(&displacement),
        };
        let bytes = vtk::polydata(moved, triangles, &[field]);
        let name = format!("surface-{:04}.vtp", count + 1);
        write_atomically(self.folder.join(&name), &bytes)?;
        self.written.push((frame.time, name));
        Ok(())
    }

    /// Writes the list of surfaces, which is what ParaView opens.
    pub(super) fn finish(self) -> Result<Option<PathBuf>, Failure> {
        if self.written.is_empty() {
            return Ok(None);
        }
        let entries: Vec<_> = self.written.iter().map(|(t, n)| (*t, n.as_str())).collect();
        let path = self.folder.join("surfaces.pvd");
        write_atomically(&path, &vtk::collection(&entries))?;
        Ok(Some(path))
    }
}
