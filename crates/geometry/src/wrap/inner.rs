//! Closed surfaces inside an envelope: of cavities and vessels, of parts, and inner walls.
//!
//! Triangles divide the inside into regions. A region away from the envelope has a surface of its own: that of its
//! voxels, grown back to the triangles, with vertices moved to these.

use std::mem;

use super::closing::{Closing, ONE_SIDE, SKIN, within};
use super::grid::Grid;
use super::{WrapError, fit};
use crate::flood::{Connectivity, flood};
use crate::{AabbTree, IsosurfaceSettings, Surface, TriangleMesh, isosurface};

/// Voxels between a region and the outside, at least, in addition to the closing's radius [-]: one is a wall that both share, the other
/// tissue.
const DEEP: f64 = 2.0;

/// Voxels around those of a region [-].
const MARGIN: usize = 3;

/// A region that triangles part from the rest of the inside: its number of voxels, one of them, and the least and largest
/// indices.
struct Region {
    voxels: usize,
    start: usize,
    low: [usize; 3],
    high: [usize; 3],
}

impl Closing<'_> {
    /// The closed surfaces inside the envelope of a closing with `radius` [m], the largest first, each of at most
    /// `triangles`.
    pub(super) fn inner_surfaces(
        &self,
        radius: f64,
        input: &TriangleMesh,
        tree: &AabbTree,
        distance: f64,
        triangles: usize,
    ) -> Result<Vec<Surface>, WrapError> {
        let mut regions = self.deep_regions(radius);
        regions.sort_by_key(|region| (std::cmp::Reverse(region.voxels), region.start));
        let settings = IsosurfaceSettings {
            triangles,
            ..IsosurfaceSettings::default()
        };
        let surface = |region: &Region| {
            let (grid, set) = self.alone(region);
            let map = within(&grid, &set, f64::from(ONE_SIDE) * grid.spacing, true);
            let found = isosurface(&map, 1, &settings)?.simplified.mesh;
            // Seen from inside the region.
            Ok(Surface::new(fit(found, input, tree, distance, -distance))?)
        };
        regions.iter().map(surface).collect()
    }

    fn is_free(&self, number: usize) -> bool {
        !self.outside[number] && self.distance[number] > ONE_SIDE * self.grid.spacing as f32
    }

    /// The regions that are nowhere near the envelope and deeper than a skin.
    fn deep_regions(&self, radius: f64) -> Vec<Region> {
        let grid = self.grid;
        let near = within(grid, &self.outside, radius + DEEP * grid.spacing, true);
        let skin = (SKIN * grid.spacing) as f32;
        let mut seen = vec![false; self.distance.len()];
        let mut regions = Vec::new();
        for start in 0..seen.len() {
            if seen[start] || !self.is_free(start) {
                continue;
            }
            let (mut is_deep, mut is_inner) = (false, true);
            let (mut low, mut high) = ([usize::MAX; 3], [0; 3]);
            let voxels = flood(grid.size, start, Connectivity::Six, |number| {
                if !self.is_free(number) || mem::replace(&mut seen[number], true) {
                    return false;
                }
                is_deep |= self.distance[number] >= skin;
                is_inner &= near.labels[number] == 0;
                let indices = grid.indices(number);
                low = [0, 1, 2].map(|axis| low[axis].min(indices[axis]));
                high = [0, 1, 2].map(|axis| high[axis].max(indices[axis]));
                true
            });
            if is_deep && is_inner {
                regions.push(Region {
                    voxels,
                    start,
                    low,
                    high,
                });
            }
        }
        regions
    }

    /// A grid around a region, and which of its voxels belong to it.
    fn alone(&self, region: &Region) -> (Grid, Vec<bool>) {
        let whole = self.grid;
        let first = region.low.map(|index| index - MARGIN);
        let grid = Grid {
            size: [0, 1, 2].map(|axis| region.high[axis] + MARGIN + 1 - first[axis]),
            origin: whole.middle(first),
            spacing: whole.spacing,
        };
        let mut set = vec![false; grid.size.iter().product()];
        let within = |number: usize| {
            let [i, j, k] = grid.indices(number);
            whole.number([i + first[0], j + first[1], k + first[2]])
        };
        let [i, j, k] = whole.indices(region.start);
        let start = grid.number([i - first[0], j - first[1], k - first[2]]);
        flood(grid.size, start, Connectivity::Six, |number| {
            self.is_free(within(number)) && !mem::replace(&mut set[number], true)
        });
        (grid, set)
    }
}
