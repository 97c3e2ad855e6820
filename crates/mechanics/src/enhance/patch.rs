use palpate_geometry::{NodeId, TriangleId, TriangleMesh, closest_on_triangle};

use super::carrier::EmbeddedDisplayPoints;
use super::field::SurfaceField;
use super::interpolation::SurfacePoint;
use super::model::EnhancementModel;
use super::neighborhood::Neighborhood;
use super::pn_triangle::PnTriangle;
use crate::Vec3;

/// The finer triangles around some contacts, and those of the displayed surface that they replace. Rebuilt in
/// the same buffers when a contact moves to another triangle.
///
/// Its first points are vertices of that surface, and move as [`EnhancementModel::carrier`] moves those, to
/// the last bit: the surface has no cracks, at rest or moved.
#[derive(Debug, Clone, Default)]
pub struct EnhancedPatch {
    neighborhood: Neighborhood,
    corners: Vec<NodeId>,
    sites: Vec<SurfacePoint>,
    carrier: EmbeddedDisplayPoints,
    triangles: Vec<[u32; 3]>,
    cuts: Vec<Cut>,
}

/// An edge with new points on it.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// In ascending order.
    ends: [NodeId; 2],
    /// The first of its points, from the lower end.
    first: u32,
}

/// Number of parts of an edge, with the maps from the surface's numbers to the patch's.
struct Grid<'a> {
    parts: usize,
    corners: &'a [NodeId],
    cuts: &'a [Cut],
}

impl EnhancedPatch {
    /// Replaces the neighbourhood of the triangles `touched`; that of none is empty.
    pub fn build(&mut self, model: &EnhancementModel, touched: &[TriangleId]) {
        let surface = model.surface();
        let area = model.settings().area;
        self.neighborhood.gather(surface, touched, area);
        self.sites.clear();
        self.carrier.clear();
        self.triangles.clear();
        self.cuts.clear();
        self.place_corners(model);
        let parts = 1 << model.settings().levels;
        for number in 0..self.neighborhood.refined().len() {
            self.refine(model, self.neighborhood.refined()[number], parts);
        }
        let grid = Grid {
            parts,
            corners: &self.corners,
            cuts: &self.cuts,
        };
        for &triangle in self.neighborhood.border() {
            let cut = self.neighborhood.cut(surface, triangle);
            grid.join(surface.mesh().corners(triangle), cut, &mut self.triangles);
        }
    }

    /// The triangles that are replaced.
    pub fn replaced(&self) -> impl Iterator<Item = TriangleId> {
        let refined = self.neighborhood.refined().iter();
        refined.chain(self.neighborhood.border()).copied()
    }

    /// The vertices that the first points are.
    pub fn corners(&self) -> &[NodeId] {
        &self.corners
    }

    /// Over which points of the seen surface they lie.
    pub fn sites(&self) -> &[SurfacePoint] {
        &self.sites
    }

    /// The points at rest [m].
    pub fn places(&self) -> &[Vec3] {
        self.carrier.places()
    }

    /// The point of the patch at rest that is nearest to `place` [m]; that itself where there is no patch.
    pub fn nearest(&self, place: &Vec3) -> Vec3 {
        let on = self.triangles.iter().map(|points| {
            let corners = points.map(|point| self.places()[point as usize]);
            closest_on_triangle(&corners, place).position
        });
        let away = |on: &Vec3| (on - place).norm_squared();
        on.min_by(|one, other| away(one).total_cmp(&away(other)))
            .unwrap_or(*place)
    }

    /// Displacements of the points [m]. Allocates nothing.
    ///
    /// # Panics
    /// When `displacements` has not the length of [`EnhancedPatch::places`].
    pub fn displace(&self, field: &SurfaceField, displacements: &mut [Vec3]) {
        self.carrier.interpolate(field, displacements);
    }

    /// The seen mesh with the patch in it, whose points are at `places` [m]: its vertices keep their numbers
    /// and positions, new points follow.
    ///
    /// # Panics
    /// When the mesh is not the model's, or `places` has not the length of [`EnhancedPatch::places`].
    pub fn in_mesh(&self, seen: &TriangleMesh, places: &[Vec3]) -> TriangleMesh {
        assert_eq!(places.len(), self.places().len(), "one per point");
        let (old, shared) = (seen.vertices().len(), self.corners.len());
        let mut vertices = seen.vertices().to_vec();
        vertices.extend_from_slice(&places[shared..]);
        let mut gone = vec![false; seen.triangles().len()];
        for triangle in self.replaced() {
            gone[triangle.index()] = true;
        }
        let remaining = seen.triangle_ids().filter(|id| !gone[id.index()]);
        let mut triangles: Vec<_> = remaining.map(|id| seen.corners(id)).collect();
        let number = |point: u32| match self.corners.get(point as usize) {
            Some(node) => *node,
            None => NodeId((old + point as usize - shared) as u32),
        };
        triangles.extend(self.triangles.iter().map(|points| points.map(number)));
        TriangleMesh::new(vertices, triangles).expect("places are finite and numbers in range")
    }

    fn place_corners(&mut self, model: &EnhancementModel) {
        let surface = model.surface();
        self.corners.clear();
        let replaced = self.neighborhood.refined().iter();
        for &triangle in replaced.chain(self.neighborhood.border()) {
            self.corners.extend(surface.mesh().corners(triangle));
        }
        self.corners.sort_unstable();
        self.corners.dedup();
        for &node in &self.corners {
            let at = SurfacePoint::vertex(surface, node);
            let place = surface.mesh().vertices()[node.index()];
            self.sites.push(at);
            let site = model.site(&at, &place);
            self.carrier.push(model.interpolation(), &site, place);
        }
    }

    /// Cuts one triangle into `parts` along each edge.
    fn refine(&mut self, model: &EnhancementModel, triangle: TriangleId, parts: usize) {
        let mesh = model.surface().mesh();
        let normals = &model.normals;
        let curved = PnTriangle::new(
            mesh.positions(triangle),
            normals.of(triangle),
            normals.sharp(triangle),
        );
        let corners = mesh.corners(triangle);
        let (carrier, sites) = (&mut self.carrier, &mut self.sites);
        let mut next = carrier.places().len() as u32;
        let mut push = |steps: [usize; 3]| {
            let barycentric = steps.map(|step| step as f64 / parts as f64);
            let at = SurfacePoint {
                triangle,
                barycentric,
            };
            let place = curved.at(&barycentric);
            sites.push(at);
            carrier.push(model.interpolation(), &model.site(&at, &place), place);
            carrier.places().len() as u32
        };
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            let ends = [from.min(to), from.max(to)];
            if self.cuts.iter().any(|cut| cut.ends == ends) {
                continue;
            }
            self.cuts.push(Cut { ends, first: next });
            for step in 1..parts {
                let mut steps = [0; 3];
                steps[k] = if from < to { parts - step } else { step };
                steps[(k + 1) % 3] = parts - steps[k];
                next = push(steps);
            }
        }
        let inner = next;
        for i in 1..parts {
            for j in 1..parts - i {
                push([parts - i - j, i, j]);
            }
        }
        let grid = Grid {
            parts,
            corners: &self.corners,
            cuts: &self.cuts,
        };
        grid.fill(corners, inner, &mut self.triangles);
    }
}

impl Grid<'_> {
    /// The point `step` parts of the way from one corner to another.
    fn along(&self, from: NodeId, to: NodeId, step: usize) -> u32 {
        if step == 0 || step == self.parts {
            let node = if step == 0 { from } else { to };
            let found = self.corners.binary_search(&node);
            return found.expect("all corners are listed") as u32;
        }
        let ends = [from.min(to), from.max(to)];
        let cut = self.cuts.iter().find(|cut| cut.ends == ends);
        let first = cut.expect("the edge has been cut").first;
        let from_low = if from < to { step } else { self.parts - step };
        first + from_low as u32 - 1
    }

    /// The triangles of a refined triangle a, b, c, whose points inside begin at `inner`.
    fn fill(&self, [a, b, c]: [NodeId; 3], inner: u32, triangles: &mut Vec<[u32; 3]>) {
        let n = self.parts;
        // i parts from a towards b and j towards c.
        let point = |i: usize, j: usize| match (i, j) {
            (i, 0) => self.along(a, b, i),
            (0, j) => self.along(a, c, j),
            (i, j) if i + j == n => self.along(b, c, j),
            (i, j) => inner + ((i - 1) * (n - 1) - i * (i - 1) / 2 + j - 1) as u32,
        };
        for i in 0..n {
            for j in 0..n - i {
                triangles.push([point(i, j), point(i + 1, j), point(i, j + 1)]);
                if i + j + 1 < n {
                    triangles.push([point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
                }
            }
        }
    }

    /// The triangles of a neighbour, of which one edge or two are cut.
    fn join(&self, corners: [NodeId; 3], cut: [bool; 3], triangles: &mut Vec<[u32; 3]>) {
        let turned = |k: usize| [0, 1, 2].map(|corner| corners[(k + corner) % 3]);
        let twice = cut.iter().filter(|&&cut| cut).count() == 2;
        // The cut edge from a to b, or the cut edges that meet in a.
        let first = (0..3).find(|&k| if twice { !cut[(k + 1) % 3] } else { cut[k] });
        let [a, b, c] = turned(first.unwrap_or(0));
        for step in 0..self.parts {
            let (near, far) = (self.along(a, b, step), self.along(a, b, step + 1));
            if !twice {
                triangles.push([near, far, self.along(c, c, 0)]);
                continue;
            }
            let (left, right) = (self.along(a, c, step), self.along(a, c, step + 1));
            triangles.push([near, far, right]);
            if step > 0 {
                triangles.push([near, right, left]);
            }
        }
    }
}
