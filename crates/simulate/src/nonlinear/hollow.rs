//! The walls of cavities in the tetrahedra of a body.

use palpate_geometry::{Surface, TetrahedronMesh};

use crate::Error;
use crate::regions::Regions;

/// A cavity is rejected if its volume deviates by more than this part from that of its shape [-].
const FARTHEST: f64 = 0.1;

impl Regions {
    /// The `mesh` of the body within `surface`, in which no tetrahedron crosses the wall of a cavity: those in cavities
    /// have the regions from 1, in the order of these. And warnings.
    pub(super) fn with_cavities(
        &self,
        mesh: TetrahedronMesh,
        surface: &Surface,
    ) -> Result<(TetrahedronMesh, Vec<String>), Error> {
        if self.cavities.is_empty() {
            return Ok((mesh, Vec::new()));
        }
        let numbers: Vec<_> = self.cavities.iter().map(|own| own.number).collect();
        let found = self.map.bordered(&mesh, Some(surface), &[], &numbers);
        let found = found.map_err(palpate_mechanics::Error::from)?;
        let (off, worst) = found.off;
        if off > FARTHEST {
            return Err(Error::CavityNotEnclosed {
                name: self.cavities[worst].name.clone(),
            });
        }
        let crossed = self.cavities.iter().zip(&found.borders);
        let crossed = crossed.filter(|(_, own)| own.crossing > 0);
        let warnings = crossed.map(|(cavity, own)| {
            format!(
                "{} edges of the nonlinear model cross the wall of {:?}, which lies up to half an edge off there",
                own.crossing, cavity.name
            )
        });
        let warnings = warnings.collect();
        let cavity_of = |tetrahedron: usize| {
            let cavity = found.border_around(tetrahedron);
            cavity.map_or(0, |cavity| cavity as u32 + 1)
        };
        let regions = (0..found.mesh.tetrahedra().len()).map(cavity_of).collect();
        let mesh = found.mesh.with_regions(regions);
        Ok((mesh.map_err(palpate_mechanics::Error::from)?, warnings))
    }
}
