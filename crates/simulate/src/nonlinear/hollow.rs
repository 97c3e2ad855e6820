//! The walls of cavities in the tetrahedra of a body.
//!
//! Flat faces between vertices on the border of a shape cut off a part of its volume, a quarter where edges are as long as 0.8 of a
//! radius. So a wall lies so far outside of the shape that it encloses the volume of the shape.

use palpate_geometry::{
    Level, Resolved, Surface, TetrahedronError, TetrahedronMesh, Vec3, resolve_levels,
};

use crate::Error;
use crate::regions::Regions;

/// Volumes are those of the shapes within this part [-], after so many trials at most; the closest of them is refused beyond the
/// other part.
const TOLERANCE: f64 = 0.005;
const TRIALS: usize = 8;
const FARTHEST: f64 = 0.1;

impl Regions {
    /// The `mesh` of the body within `surface`, none of whose tetrahedra crosses the wall of a cavity: those in cavities are of
    /// the regions from 1, in the order of these. And warnings.
    pub(super) fn with_cavities(
        &self,
        mesh: TetrahedronMesh,
        surface: &Surface,
    ) -> Result<(TetrahedronMesh, Vec<String>), Error> {
        if self.cavities.is_empty() {
            return Ok((mesh, Vec::new()));
        }
        let mut outwards = vec![0.0; self.cavities.len()];
        let (mut least, mut closest) = (f64::INFINITY, (mesh.clone(), Vec::new()));
        let mut worst = 0;
        for _ in 0..TRIALS {
            let walled = self.walled(&mesh, surface, &outwards);
            let walled = walled.map_err(palpate_mechanics::Error::from)?;
            let (off, cavity) = self.move_walls(&walled.0, &mut outwards);
            if off < least {
                (least, closest, worst) = (off, walled, cavity);
            }
            if least < TOLERANCE {
                break;
            }
        }
        if least > FARTHEST {
            return Err(Error::CavityNotEnclosed {
                name: self.cavities[worst].name.clone(),
            });
        }
        let (hollow, resolved) = closest;
        let crossed = self.cavities.iter().zip(&resolved);
        let crossed = crossed.filter(|(_, own)| own.crossing > 0);
        let warnings = crossed.map(|(cavity, own)| {
            format!(
                "{} edges of the nonlinear model cross the wall of {:?}, which lies up to half an edge off there",
                own.crossing, cavity.name
            )
        });
        Ok((hollow, warnings.collect()))
    }

    /// The mesh whose tetrahedra end at walls so far outside of the shapes [m].
    fn walled(
        &self,
        mesh: &TetrahedronMesh,
        surface: &Surface,
        outwards: &[f64],
    ) -> Result<(TetrahedronMesh, Vec<Resolved>), TetrahedronError> {
        let heights = self.cavities.iter().zip(outwards).map(|(own, outwards)| {
            move |place: &Vec3| self.map.height(own.number, place) - outwards
        });
        let heights: Vec<_> = heights.collect();
        let levels = heights.iter().map(|height| Level {
            height,
            boundary_only: false,
        });
        let levels: Vec<_> = levels.collect();
        let (mesh, resolved) = resolve_levels(mesh.clone(), Some(surface), &levels)?;
        let of = |tetrahedron: usize| {
            let cavity = resolved.iter().position(|own| own.below[tetrahedron]);
            cavity.map_or(0, |cavity| cavity as u32 + 1)
        };
        let numbers = (0..mesh.tetrahedra().len()).map(of).collect();
        Ok((mesh.with_regions(numbers)?, resolved))
    }

    /// Moves walls by what they lack of the volume of their shapes; the largest part that one lacks or has too much [-], and which.
    fn move_walls(&self, mesh: &TetrahedronMesh, outwards: &mut [f64]) -> (f64, usize) {
        let mut found = vec![0.0; outwards.len()];
        for tetrahedron in 0..mesh.tetrahedra().len() {
            if let Some(cavity) = (mesh.region(tetrahedron) as usize).checked_sub(1) {
                let [a, b, c, d] = mesh.positions(tetrahedron);
                found[cavity] += (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
            }
        }
        let mut worst = (0.0, 0);
        let each = self.cavities.iter().zip(found).zip(outwards);
        for (number, ((own, found), outwards)) in each.enumerate() {
            if let Some([volume, area]) = self.map.volume_and_area(own.number) {
                *outwards += (volume - found) / area;
                let off = (found / volume - 1.0).abs();
                if off > worst.0 {
                    worst = (off, number);
                }
            }
        }
        worst
    }
}
