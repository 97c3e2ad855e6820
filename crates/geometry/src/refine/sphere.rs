use super::shell::{Shell, dihedral_quality, move_if_sound};
use super::uniform::around;
use crate::mesh::edges::{by_edge, sides};
use crate::{NodeId, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// Angles below this are not made by moving a vertex [rad].
const MOVED_FLOOR: f64 = 0.17;

/// Angles below this are not made by cutting an edge [rad].
const CUT_FLOOR: f64 = 0.05;

/// A vertex within this part of the radius from the sphere is on it [-].
const ON: f64 = 1e-9;

/// A boundary edge longer than this part of its length from the crossing is not moved there [-].
const FARTHEST: f64 = 0.6;

/// What became of the edges of the boundary that crossed a sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolved {
    /// Vertices that moved onto it.
    pub moved: usize,
    /// Edges that got a new vertex there, since neither end could move.
    pub cut: usize,
    /// Edges that still cross it.
    pub crossing: usize,
}

/// Makes vertices lie where the sphere around `center` of `radius` [m] meets the boundary of `mesh`,
/// so that no edge of the boundary passes from its inside to its outside: the patch inside is then
/// a set of whole triangles. Vertices stay on `surface`, if it is given.
///
/// An edge that crosses gives its nearer end, when no tetrahedron suffers; else it is cut in two.
///
/// # Errors
/// When the radius is not a positive length.
pub fn resolve_sphere(
    mesh: &TetrahedronMesh,
    surface: Option<&Surface>,
    center: &Vec3,
    radius: f64,
) -> Result<(TetrahedronMesh, Resolved), TetrahedronError> {
    if !radius.is_finite() || radius <= 0.0 {
        let (what, found) = ("the radius of the sphere", radius);
        return Err(TetrahedronError::NotALength { what, found });
    }
    let (vertices, tetrahedra) = mesh.clone().into_parts();
    let mut resolving = Resolving {
        around: around(vertices.len(), &tetrahedra),
        shell: surface.map(Shell::new),
        center: *center,
        radius,
        vertices,
        tetrahedra,
    };
    let mut edges = boundary_edges(mesh);
    let moved = resolving.move_ends(&edges);
    let mut cut = 0;
    // Each cut leaves edges from the new vertex, which lies on the sphere: none of them crosses.
    edges.retain(|&edge| resolving.crosses(edge));
    edges.retain(|&edge| {
        let done = resolving.cut(edge);
        cut += usize::from(done);
        !done
    });
    let crossing = edges.len();
    let resolved = Resolved {
        moved,
        cut,
        crossing,
    };
    let mesh = TetrahedronMesh::new(resolving.vertices, resolving.tetrahedra)?;
    Ok((mesh, resolved))
}

fn boundary_edges(mesh: &TetrahedronMesh) -> Vec<[NodeId; 2]> {
    let triangles: Vec<_> = mesh
        .boundary()
        .iter()
        .map(|&(corners, _)| corners)
        .collect();
    by_edge(&sides(&triangles))
        .map(|sides| [sides[0].low, sides[0].high])
        .collect()
}

struct Resolving<'a> {
    vertices: Vec<Vec3>,
    tetrahedra: Vec<[NodeId; 4]>,
    around: Vec<Vec<u32>>,
    shell: Option<Shell<'a>>,
    center: Vec3,
    radius: f64,
}

impl Resolving<'_> {
    /// Height of a vertex over the sphere [m]; exactly zero for one that is on it.
    fn height(&self, node: NodeId) -> f64 {
        let height = (self.vertices[node.index()] - self.center).norm() - self.radius;
        if height.abs() <= ON * self.radius {
            0.0
        } else {
            height
        }
    }

    fn crosses(&self, [a, b]: [NodeId; 2]) -> bool {
        self.height(a) * self.height(b) < 0.0
    }

    /// Moves ends of edges, those that have the least way first. How many.
    fn move_ends(&mut self, edges: &[[NodeId; 2]]) -> usize {
        let mut ways = Vec::new();
        for &edge in edges.iter().filter(|&&edge| self.crosses(edge)) {
            let [a, b] = edge.map(|node| self.vertices[node.index()]);
            let along = self.fraction(&a, &b);
            ways.push((along, edge, edge[0]));
            ways.push((1.0 - along, edge, edge[1]));
        }
        ways.retain(|way| way.0 <= FARTHEST);
        ways.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        let mut moved = 0;
        for (_, edge, node) in ways {
            // An edge that a move before this one resolved has an end on the sphere.
            if !self.crosses(edge) {
                continue;
            }
            let Some(target) = self.on_both(edge) else {
                continue;
            };
            let star = self.around[node.index()]
                .iter()
                .map(|&t| self.tetrahedra[t as usize].map(|n| n.0));
            moved += usize::from(move_if_sound(
                &mut self.vertices,
                star,
                node.0,
                target,
                MOVED_FLOOR,
            ));
        }
        moved
    }

    /// Where the way from one point to another crosses the sphere, as a part of it.
    fn fraction(&self, from: &Vec3, to: &Vec3) -> f64 {
        let (start, way) = (from - self.center, to - from);
        let (a, b) = (way.norm_squared(), start.dot(&way));
        let c = start.norm_squared() - self.radius * self.radius;
        let root = (b * b - a * c).max(0.0).sqrt();
        // From inside to outside the larger root lies within, else the smaller one; both in the form
        // that does not cancel.
        let fraction = match (c < 0.0, b < 0.0) {
            (true, true) => (root - b) / a,
            (true, false) => -c / (b + root),
            (false, _) => c / (root - b),
        };
        if fraction.is_finite() {
            fraction.clamp(0.0, 1.0)
        } else {
            0.5
        }
    }

    /// A point near the crossing of an edge that lies on the sphere and on the surface. Projected
    /// onto one and the other in turn; nothing when they are nearly parallel there.
    fn on_both(&self, edge: [NodeId; 2]) -> Option<Vec3> {
        let [a, b] = edge.map(|node| self.vertices[node.index()]);
        let mut point = a + (b - a) * self.fraction(&a, &b);
        let Some(shell) = &self.shell else {
            return Some(point);
        };
        for _ in 0..100 {
            let nearest = shell.nearest(&point);
            let out = nearest - self.center;
            point = self.center + out * (self.radius / out.norm());
            if (point - nearest).norm() <= 1e-3 * ON * self.radius {
                return point.iter().all(|c| c.is_finite()).then_some(point);
            }
        }
        None
    }

    /// Puts a vertex into an edge, where it crosses, and cuts all tetrahedra that have it.
    fn cut(&mut self, edge: [NodeId; 2]) -> bool {
        let [a, b] = edge;
        let ends = edge.map(|node| self.vertices[node.index()]);
        let chord = ends[0] + (ends[1] - ends[0]) * self.fraction(&ends[0], &ends[1]);
        let with_edge: Vec<u32> = self.around[a.index()]
            .iter()
            .copied()
            .filter(|&t| self.tetrahedra[t as usize].contains(&b))
            .collect();
        let replaced = |t: u32, old: NodeId, new: NodeId| {
            self.tetrahedra[t as usize].map(|node| if node == old { new } else { node })
        };
        let middle = NodeId(self.vertices.len() as u32);
        let halves: Vec<_> = with_edge
            .iter()
            .map(|&t| (replaced(t, b, middle), replaced(t, a, middle)))
            .collect();
        // On the surface if that can be, else on the chord.
        let targets = [self.on_both(edge), Some(chord)];
        let sound = targets.into_iter().flatten().find(|target| {
            let position = |node: NodeId| {
                if node == middle {
                    *target
                } else {
                    self.vertices[node.index()]
                }
            };
            halves
                .iter()
                .flat_map(|(one, other)| [one, other])
                .all(|corners| dihedral_quality(&corners.map(position)) >= CUT_FLOOR)
        });
        let Some(position) = sound else { return false };
        self.vertices.push(position);
        self.around.push(Vec::new());
        for (&t, &(first, second)) in with_edge.iter().zip(&halves) {
            let added = self.tetrahedra.len() as u32;
            self.tetrahedra[t as usize] = first;
            self.tetrahedra.push(second);
            for node in second {
                let entries = &mut self.around[node.index()];
                if node == b {
                    entries.retain(|&entry| entry != t);
                }
                entries.push(added);
            }
            self.around[middle.index()].push(t);
        }
        true
    }
}
