//! Compliance of walls and inclusions under a tip that the elements, which are larger than the tip, do not resolve.
//!
//! The load of the elements is wider. On a half-space the tip's compliance replaces that of the load; a thin wall also
//! bends more under a narrow load (`WallOperator` of the mechanics), the more so the larger its elements are, and an
//! inclusion has another effect (`InclusionField`).
//!
//! *How we know*: `nonlinear_walls::…`, `regions::…`, compared with finite elements.
//!
//! *Limits*: tissue in jaws lacks both: a wall that is pulled far is under tension and bends no more. Walls over
//! cavities are as thick as the organ, and a wall that lies on a neighbour counts as free.

use nalgebra::Matrix3;
use palpate_geometry::{AabbTree, NodeId, PatchField, Surface, TriangleId, Vec3};
use palpate_mechanics::wall::{WallCompliance, WallOperator};

use super::{Body, NonlinearOrgan};
use crate::regions::{Regions, TipExchange};
use crate::tool::Tool;
use crate::walls::through_walls;

/// Largest ratio of half a wall's thickness to the radius of its convex side [-]: a lumen is no narrower than the rest.
const MAX_CURVED: f64 = 0.8;

/// The walls under the vertices of the displayed surface.
#[derive(Debug, Clone, Default)]
pub(super) struct WallField {
    at: Vec<WallCompliance>,
}

impl WallField {
    /// Adds the walls of a piece with its tissues. If its other side is fixed it is no wall: it does not bend.
    pub(super) fn extend(
        &mut self,
        surface: &Surface,
        regions: &Regions,
        is_fixed: impl Fn(&Vec3) -> bool,
    ) {
        let mesh = surface.mesh();
        let centroid = |id: TriangleId| mesh.positions(id).iter().sum::<Vec3>() / 3.0;
        let through = through_walls(surface, &AabbTree::new(mesh)).into_iter();
        let through: Vec<Option<f64>> = through
            .map(|hit| hit.filter(|hit| !is_fixed(&centroid(hit.triangle))))
            .map(|hit| hit.map(|hit| hit.distance))
            .collect();
        let mut walls: Vec<f64> = through.iter().flatten().copied().collect();
        walls.sort_by(f64::total_cmp);
        let Some(&typical) = walls.get(walls.len() / 2) else {
            let all = self.at.len() + mesh.vertices().len();
            return self.at.resize(all, WallCompliance::default());
        };
        let patches = PatchField::new(surface, typical);
        let operator = WallOperator::new(regions.at_rest().poissons_ratio());
        let (low, high) = mesh.bounds();
        let width = 0.5 * (high - low).norm();
        for (number, place) in mesh.vertices().iter().enumerate() {
            let (mut area, mut of_walls, mut volume) = (0.0, 0.0, 0.0);
            let node = NodeId(number as u32);
            for &triangle in surface.adjacency().around(node) {
                let own = mesh.area_vector(triangle).norm();
                area += own;
                if let Some(thickness) = through[triangle.index()] {
                    of_walls += own;
                    volume += own * thickness;
                }
            }
            if of_walls == 0.0 {
                self.at.push(WallCompliance::default());
                continue;
            }
            let thickness = volume / of_walls;
            let of_middle = |own: f64| own / (1.0 - (0.5 * thickness * own).min(MAX_CURVED));
            let curvatures = patches.principal_curvatures(node).map(of_middle);
            let inward = -patches.vertex_normals()[number];
            let stiffness = regions.stiffness_through(place, &(inward * thickness));
            let wall = operator.compliance(thickness, curvatures, width);
            self.at.push(wall.times(of_walls / area / stiffness));
        }
    }
}

impl NonlinearOrgan {
    /// Additional compliance of the tip of tool `number` along its normal at rest, relative to its load [m/N]: due to
    /// walls, and due to inclusions.
    pub(super) fn local_compliance(
        &self,
        number: usize,
        tool: &Tool,
        body: &Body,
    ) -> (Matrix3<f64>, Option<TipExchange>) {
        let load = &body.loads[number];
        let composition = &self.composition;
        let mesh = composition.shown.mesh();
        let near = composition.tree.nearest(mesh, &load.place);
        let radii = [tool.typical_radius, load.radius];
        let corners = mesh.corners(near.triangle).into_iter();
        let of_walls: f64 = corners
            .zip(near.on.barycentric)
            .map(|(node, weight)| {
                weight * composition.walls.at[node.index()].beyond_half_space(radii)
            })
            .sum();
        let law = composition.pieces[body.on[number]].law();
        let of_walls = of_walls / law.youngs_modulus();
        let inclusions = &tool.inclusions;
        let exchange = inclusions.exchange(mesh, near.triangle, &load.place, load.radius);
        (load.normal * load.normal.transpose() * of_walls, exchange)
    }
}
