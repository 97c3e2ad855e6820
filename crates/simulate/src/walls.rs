//! Wall thickness of an organ under its surface.

use palpate_geometry::{AabbTree, Hit, Surface, TriangleId, TriangleMesh, Vec3};

/// Longest edges of boundary elements in parts of a wall that they bend as they should [-]: with constant displacements the error goes
/// with the square of the edges, and a lobe of 3 mm that is 40 mm long is 5 % too stiff with these
/// (`thin_lobes::lobes_of_3_5_and_7_mm_are_those_of_finite_elements`).
const LONGEST: f64 = 0.3;

/// Part of the touchable triangles that may be longer than that, for rims are thin too [-]: beyond, finite elements are meant.
const FEW: f64 = 0.1;

/// Edges with which shorter walls err by as much, in parts of them, and the part of the touchable triangles from which on they get a
/// warning [-].
const COARSE: f64 = 0.42;
const WORTH_A_WARNING: f64 = 0.01;

/// Cosine of the angle between the outward normals of two sides of a wall, at most [-].
const FACES: f64 = -0.4;

/// Longest edge of tetrahedra in parts of a wall [-] (`docs/theory/condensed_elements.md`).
const OF_A_WALL: f64 = 0.5;

/// The walls under the touchable triangles.
pub(crate) struct Walls {
    /// Size of a triangle and thickness of the body under it [m], for each that can be touched.
    under: Vec<(f64, f64)>,
    /// Those of triangles on two sides of a wall or a rim that are too large to resolve its bending.
    thin: Vec<(f64, f64)>,
    /// Triangles of the surface.
    triangles: usize,
}

impl Walls {
    pub(crate) fn new(surface: &Surface, touchable: &[TriangleId]) -> Self {
        let mesh = surface.mesh();
        let tree = AabbTree::new(mesh);
        let edge = |triangle| (2.0 * mesh.area_vector(triangle).norm()).sqrt();
        let (mut under, mut thin) = (Vec::new(), Vec::new());
        for (triangle, hit) in through_each(surface, &tree, touchable.iter().copied()) {
            let wall = (edge(triangle), hit.distance);
            under.push(wall);
            if wall.0 > LONGEST * wall.1 && are_two_sides(mesh, triangle, hit.triangle) {
                thin.push(wall);
            }
        }
        Self {
            under,
            thin,
            triangles: mesh.triangles().len(),
        }
    }

    /// Whether the walls are too thin for boundary elements on these triangles.
    pub(crate) fn are_thin(&self) -> bool {
        self.thin.len() as f64 > FEW * self.under.len() as f64
    }

    /// Longest edge of tetrahedra that bend as the walls do; where there are none, of those that are no larger than a triangle [m].
    pub(crate) fn edge_of_tetrahedra(&self) -> f64 {
        let is_thin = self.are_thin();
        let walls = if is_thin { &self.thin } else { &self.under };
        let [size, thickness] = [median(walls, |wall| wall.0), median(walls, |wall| wall.1)];
        match is_thin {
            true => OF_A_WALL * thickness,
            false => size.min(OF_A_WALL * thickness),
        }
    }

    /// Warning for boundary elements on thin walls; `instead` names the recommended model.
    pub(crate) fn warning(&self, instead: &str) -> Option<String> {
        let coarse = self.thin.iter().filter(|wall| wall.0 > COARSE * wall.1);
        let few = WORTH_A_WARNING * self.under.len() as f64;
        if !self.are_thin() && coarse.count() as f64 <= few {
            return None;
        }
        Some(format!(
            "{:.0} % of what can be touched are rims or walls of {:.1} mm under triangles of {:.1} mm: more than 5 % too stiff where \
             they bend by boundary elements; {instead}",
            100.0 * self.thin.len() as f64 / self.under.len() as f64,
            1e3 * median(&self.thin, |wall| wall.1),
            1e3 * median(&self.thin, |wall| wall.0),
        ))
    }

    /// The recommended model instead of a response by boundary elements.
    pub(crate) fn instead(&self) -> String {
        let other = match self.are_thin() {
            true => "`model.response` to \"finite_elements\"",
            false => "`model.kind` to \"nonlinear\"",
        };
        let triangles = self.triangles;
        format!("raise `model.mechanical_triangles` above {triangles}, or set {other}")
    }
}

/// Thickness of the organ under each of `triangles` [m].
pub(crate) fn thicknesses(
    surface: &Surface,
    tree: &AabbTree,
    triangles: impl Iterator<Item = TriangleId>,
) -> impl Iterator<Item = (TriangleId, f64)> {
    through_each(surface, tree, triangles).map(|(triangle, hit)| (triangle, hit.distance))
}

/// Where the inward normal of each of `triangles` leaves the organ.
fn through_each(
    surface: &Surface,
    tree: &AabbTree,
    triangles: impl Iterator<Item = TriangleId>,
) -> impl Iterator<Item = (TriangleId, Hit)> {
    let mesh = surface.mesh();
    let (low, high) = mesh.bounds();
    let reach = (high - low).norm();
    triangles.filter_map(move |triangle| {
        let [a, b, c] = mesh.positions(triangle);
        let area = mesh.area_vector(triangle);
        let inward: Vec3 = -area.normalize();
        let start = (a + b + c) / 3.0 + inward * (1e-3 * (2.0 * area.norm()).sqrt());
        let hit = tree.cast(mesh, &start, &inward, reach)?;
        Some((triangle, hit))
    })
}

/// Whether two triangles are the sides of a wall or a rim; the faces of a wider wedge are none.
fn are_two_sides(mesh: &TriangleMesh, one: TriangleId, other: TriangleId) -> bool {
    let [here, there] = [one, other].map(|id| mesh.area_vector(id).normalize());
    here.dot(&there) < FACES
}

/// The other side of the wall under each triangle, if that is a wall.
pub(crate) fn through_walls(surface: &Surface, tree: &AabbTree) -> Vec<Option<Hit>> {
    let mesh = surface.mesh();
    let mut through = vec![None; mesh.triangles().len()];
    for (triangle, hit) in through_each(surface, tree, mesh.triangle_ids()) {
        if are_two_sides(mesh, triangle, hit.triangle) {
            through[triangle.index()] = Some(hit);
        }
    }
    through
}

/// Thickness of an organ, at any point of it.
pub(crate) struct Thickness<'a> {
    surface: &'a Surface,
    tree: AabbTree,
    /// Under each triangle [m].
    under: Vec<f64>,
}

impl<'a> Thickness<'a> {
    pub(crate) fn new(surface: &'a Surface) -> Self {
        let tree = AabbTree::new(surface.mesh());
        let through = through_walls(surface, &tree).into_iter();
        let through = through.map(|hit| hit.map_or(f64::INFINITY, |hit| hit.distance));
        let through = through.collect();
        Self {
            surface,
            tree,
            under: with_edges(surface, through),
        }
    }

    /// Under the middle one of the triangles [m].
    pub(crate) fn typical(&self) -> f64 {
        let mut all = self.under.clone();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    }

    /// Under the surface point closest to a point [m].
    pub(crate) fn at(&self, place: &Vec3) -> f64 {
        let nearest = self.tree.nearest(self.surface.mesh(), place);
        self.under[nearest.triangle.index()]
    }
}

/// Cosine of the angle between the normals of a wall and of its edge, at most [-].
const ACROSS: f64 = 0.5;

/// The thickness of each triangle [m]: its distance `through` the body, but on the crest of a rim and on the side of a plate, where
/// that is long, the thickness of the wall that ends there, as far from the wall as it is thick.
fn with_edges(surface: &Surface, mut through: Vec<f64>) -> Vec<f64> {
    let mesh = surface.mesh();
    let centroid = |id: TriangleId| mesh.positions(id).iter().sum::<Vec3>() / 3.0;
    let normal = |id: TriangleId| mesh.area_vector(id).normalize();
    let mut thinnest_first: Vec<TriangleId> = mesh.triangle_ids().collect();
    thinnest_first.retain(|id| through[id.index()].is_finite());
    thinnest_first.sort_by(|a, b| through[a.index()].total_cmp(&through[b.index()]));
    let mut is_known = vec![false; through.len()];
    let mut reached = Vec::new();
    for wall in thinnest_first {
        if is_known[wall.index()] {
            continue;
        }
        let thickness = through[wall.index()];
        let (middle, outward) = (centroid(wall), normal(wall));
        let is_edge = |id: TriangleId| {
            let is_near = (centroid(id) - middle).norm() <= thickness;
            is_near && normal(id).dot(&outward).abs() < ACROSS
        };
        is_known[wall.index()] = true;
        reached.push(wall);
        while let Some(from) = reached.pop() {
            let corners = mesh.corners(from).into_iter();
            for &other in corners.flat_map(|node| surface.adjacency().around(node)) {
                if !is_known[other.index()] && is_edge(other) {
                    is_known[other.index()] = true;
                    through[other.index()] = thickness;
                    reached.push(other);
                }
            }
        }
    }
    through
}

/// Triangles that are asked for a thickness.
const ASKED: usize = 2_000;

/// Thickness of the organ under the middle one of its triangles [m].
pub(crate) fn typical_wall(surface: &Surface) -> f64 {
    let every = surface.mesh().triangles().len().div_ceil(ASKED);
    let asked: Vec<_> = surface.mesh().triangle_ids().step_by(every).collect();
    median(&Walls::new(surface, &asked).under, |wall| wall.1)
}

/// The upper median; zero of an empty list.
fn median(walls: &[(f64, f64)], of: fn(&(f64, f64)) -> f64) -> f64 {
    let mut values: Vec<f64> = walls.iter().map(of).collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_geometry::Organ;

    #[test]
    fn a_thin_wall_gets_a_warning_and_a_solid_none() {
        let walls = |organ: Organ, triangles| {
            let surface = Surface::new(organ.surface_mesh(triangles).unwrap()).unwrap();
            let all: Vec<_> = surface.mesh().triangle_ids().collect();
            Walls::new(&surface, &all)
        };
        assert_eq!(walls(Organ::Kidney, 1000).warning(""), None);
        let thin = walls(Organ::Esophagus, 1000);
        let words = thin.warning(&thin.instead()).unwrap();
        assert!(words.contains("mechanical_triangles` above"), "{words}");
        // A wall of 2.5 mm, which chords make thinner.
        let edge = thin.edge_of_tetrahedra();
        assert!(edge > 0.6 * OF_A_WALL * 2.5e-3 && edge < OF_A_WALL * 2.5e-3);
        // Of the plate of 15 mm, edges of 5 and of 4.1 mm: 0.33 and 0.27 of it.
        assert!(walls(Organ::Slab, 2000).are_thin() && !walls(Organ::Slab, 3000).are_thin());
        assert_eq!(walls(Organ::Slab, 3000).warning(""), None);
    }

    /// Judge: the bodies' own sizes. The rim of a hemisphere, a right angle, is no wall.
    #[test]
    fn a_body_is_as_thick_as_it_is() {
        let surface = |organ: Organ| Surface::new(organ.surface_mesh(2000).unwrap()).unwrap();
        let slab = surface(Organ::Slab);
        let (low, high) = slab.mesh().bounds();
        let middle = 0.5 * (low + high);
        let thickness = Thickness::new(&slab).at(&Vec3::new(middle.x, middle.y, high.z));
        assert!((thickness - 0.015).abs() < 1e-4, "{thickness}");
        // Where its side is several triangles high.
        let side = Thickness::new(&slab).at(&Vec3::new(high.x, middle.y, middle.z));
        assert!((side - 0.015).abs() < 1e-4, "{side}");
        let hemisphere = surface(Organ::Hemisphere);
        let (low, high) = hemisphere.mesh().bounds();
        let rim = Vec3::new(high.x, 0.0, low.z);
        let thickness = Thickness::new(&hemisphere).at(&rim);
        assert!(thickness > 0.01, "{thickness}");
    }
}
