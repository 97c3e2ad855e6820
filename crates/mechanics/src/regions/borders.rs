//! Tetrahedra that do not cross the borders of regions.
//!
//! Flat faces between vertices on the border of a shape cut off a part of its volume, a quarter where edges are as long as 0.8 of a
//! radius. So they lie so far outside of it that they enclose its volume.
//!
//! *How we know*: `solid_regions::…`, `cavities::…`.

use palpate_geometry::{
    Fidelity, Level, Resolved, Surface, TetrahedronError, TetrahedronMesh, resolve_levels,
};

use super::RegionMap;
use crate::Vec3;

/// How often borders are placed at most.
const TRIALS: usize = 8;

/// The part of the way to the surface and to other shapes that a border may go outwards [-].
const OF_CLEARANCE: f64 = 0.5;

/// A mesh that does not cross borders.
#[derive(Debug)]
pub struct Bordered {
    /// Its tetrahedra.
    pub mesh: TetrahedronMesh,
    /// Results for the other levels.
    pub levels: Vec<Resolved>,
    /// Result for each border.
    pub borders: Vec<Resolved>,
    /// Relative error of a region's volume compared with its shape [-]: the largest, and the place of its border among
    /// them.
    pub off: (f64, usize),
}

impl Bordered {
    /// The border that a tetrahedron lies within, by its place among them; the first of several.
    pub fn border_around(&self, tetrahedron: usize) -> Option<usize> {
        self.borders.iter().position(|own| own.below[tetrahedron])
    }
}

impl RegionMap {
    /// The `mesh` of a body within `surface` with vertices on `levels`, and then on the borders of the regions `numbers`, as
    /// [`resolve_levels`] moves and cuts it; where faces cut volume off a shape, they lie outside of it.
    ///
    /// # Errors
    /// As [`resolve_levels`].
    pub fn bordered(
        &self,
        mesh: &TetrahedronMesh,
        surface: Option<&Surface>,
        levels: &[Level<'_>],
        numbers: &[usize],
    ) -> Result<Bordered, TetrahedronError> {
        let mut outwards = vec![0.0; numbers.len()];
        let mut closest: Option<Bordered> = None;
        for _ in 0..TRIALS {
            let heights = numbers.iter().zip(&outwards).map(|(number, outwards)| {
                move |place: &Vec3| self.height(*number, place) - outwards
            });
            let heights: Vec<_> = heights.collect();
            let borders = heights.iter().map(|height| Level {
                height,
                boundary_only: false,
            });
            let all: Vec<_> = levels.iter().copied().chain(borders).collect();
            let (mesh, mut resolved) = resolve_levels(mesh.clone(), surface, &all)?;
            let mut found = Bordered {
                borders: resolved.split_off(levels.len()),
                levels: resolved,
                mesh,
                off: (0.0, 0),
            };
            let before = outwards.clone();
            found.off = self.moved_outwards(&found, numbers, &mut outwards);
            if closest
                .as_ref()
                .is_none_or(|closest| found.off.0 < closest.off.0)
            {
                closest = Some(found);
            }
            let is_close = |closest: &Bordered| closest.off.0 < Fidelity::VOLUME;
            if closest.as_ref().is_some_and(is_close) || outwards == before {
                break;
            }
        }
        Ok(closest.expect("there are trials"))
    }

    /// Moves borders by what their regions lack of the volume of their shapes; the largest part that one lacks or has too
    /// much [-], and which.
    fn moved_outwards(
        &self,
        found: &Bordered,
        numbers: &[usize],
        outwards: &mut [f64],
    ) -> (f64, usize) {
        let mut volumes = vec![0.0; numbers.len()];
        for tetrahedron in 0..found.mesh.tetrahedra().len() {
            if let Some(border) = found.border_around(tetrahedron) {
                volumes[border] += found.mesh.volume_of(tetrahedron);
            }
        }
        let mut worst = (0.0, 0);
        for (border, (number, found)) in numbers.iter().zip(volumes).enumerate() {
            if let Some([volume, area]) = self.volume_and_area(*number) {
                let most = OF_CLEARANCE * self.clearances[number - 1];
                let moved = outwards[border] + (volume - found) / area;
                outwards[border] = moved.clamp(-most, most);
                let off = (found / volume - 1.0).abs();
                if off > worst.0 {
                    worst = (off, border);
                }
            }
        }
        worst
    }
}
