use super::facets::common;
use super::shell::{CUT_FLOOR, MOVED_FLOOR, SearchedSurface, move_if_valid};
use super::split::SplitNet;
use crate::mesh::edges::{by_edge, sides};
use crate::{NodeId, Surface, TetrahedronError, TetrahedronMesh, Vec3};

/// A vertex this near to a level is on it, in extents of the mesh [-].
const ON: f64 = 1e-12;

/// An end of an edge farther than this part of its length from the crossing is not moved there [-].
const FARTHEST: f64 = 0.6;

/// An edge of a boundary without a surface lies in it where it is within this angle of all triangles around its end [rad].
const IN_PLANE: f64 = 0.1;

/// Steps of the search for a crossing: bisection alone would need 40 for `ON`.
const MAX_STEPS: usize = 60;

/// A surface that tetrahedra are not to cross, given by how far a point lies above it.
#[derive(Clone, Copy)]
pub struct Level<'a> {
    /// Height of a point over it [m]: zero on it, of one sign on each side, continuous.
    pub height: &'a dyn Fn(&Vec3) -> f64,
    /// Whether only the edges of the boundary are not to cross it.
    pub boundary_only: bool,
}

/// Result for the edges that crossed a level.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Resolved {
    /// Vertices that moved onto it.
    pub moved: usize,
    /// Edges that got a new vertex there, since neither end could move.
    pub cut: usize,
    /// Edges that still cross it.
    pub crossing: usize,
    /// Whether each tetrahedron lies below it; one that still crosses counts to where it reaches farther.
    pub below: Vec<bool>,
}

/// Makes vertices lie on each of the `levels`, one after the other, so that no edge passes from one side to the other. Each
/// side is then a set of whole tetrahedra, or of whole triangles of the boundary. Vertices of the boundary stay on
/// `surface`, if it is given, and vertices on a level stay on it.
///
/// The nearer end of a crossing edge moves to the level, unless a tetrahedron gets worse; else the
/// edge is cut in two.
///
/// # Errors
/// When there come more tetrahedra than [`TetrahedronMesh::MAX_TETRAHEDRA`].
pub fn resolve_levels(
    mesh: TetrahedronMesh,
    surface: Option<&Surface>,
    levels: &[Level<'_>],
) -> Result<(TetrahedronMesh, Vec<Resolved>), TetrahedronError> {
    let searched = surface.map(SearchedSurface::new);
    let mut mesh = mesh;
    let mut pinned = mesh.between_regions();
    let mut resolved: Vec<Resolved> = Vec::new();
    for level in levels {
        let mut resolving = Resolving::new(mesh, searched.as_ref(), level, pinned);
        let done = resolving.resolve(&mut resolved);
        resolved.push(done);
        (mesh, pinned) = resolving.into_mesh()?;
    }
    Ok((mesh, resolved))
}

struct Resolving<'a> {
    net: SplitNet,
    regions: Vec<u32>,
    /// Edges of the boundary, in ascending order, and the normals of its triangles around each vertex.
    boundary: Vec<[NodeId; 2]>,
    normals: Vec<Vec<Vec3>>,
    searched: Option<&'a SearchedSurface<'a>>,
    level: &'a Level<'a>,
    /// Heights of the vertices over the level [m]; exactly zero on it.
    heights: Vec<f64>,
    tolerance: f64,
    /// Vertices that are on other levels.
    pinned: Vec<bool>,
}

/// An end of an edge that could move to where the edge crosses.
struct Move {
    /// The way to go, as a part of the edge [-].
    part: f64,
    edge: [NodeId; 2],
    node: NodeId,
}

impl<'a> Resolving<'a> {
    fn new(
        mesh: TetrahedronMesh,
        searched: Option<&'a SearchedSurface<'a>>,
        level: &'a Level<'a>,
        pinned: Vec<bool>,
    ) -> Self {
        let regions = (0..mesh.tetrahedra().len()).map(|t| mesh.region(t));
        let regions = regions.collect();
        let triangles: Vec<_> = mesh
            .boundary()
            .iter()
            .map(|(corners, _)| *corners)
            .collect();
        let mut normals = vec![Vec::new(); mesh.vertices().len()];
        for corners in &triangles {
            let [a, b, c] = corners.map(|node| mesh.vertices()[node.index()]);
            for node in corners {
                normals[node.index()].push((b - a).cross(&(c - a)).normalize());
            }
        }
        let mut boundary: Vec<[NodeId; 2]> = by_edge(&sides(&triangles))
            .map(|sides| [sides[0].low, sides[0].high])
            .collect();
        boundary.sort_unstable();
        let none = Vec3::repeat(f64::INFINITY);
        let (low, high) = mesh
            .vertices()
            .iter()
            .fold((none, -none), |(low, high), v| (low.inf(v), high.sup(v)));
        let (vertices, tetrahedra) = mesh.into_parts();
        let tetrahedra = tetrahedra.iter().map(|corners| corners.map(|node| node.0));
        let mut resolving = Self {
            heights: Vec::new(),
            tolerance: ON * (high - low).max(),
            net: SplitNet::new(vertices, tetrahedra.collect()),
            regions,
            boundary,
            normals,
            searched,
            level,
            pinned,
        };
        let heights = resolving.net.vertices.iter().map(|at| resolving.height(at));
        resolving.heights = heights.collect();
        resolving
    }

    fn into_mesh(self) -> Result<(TetrahedronMesh, Vec<bool>), TetrahedronError> {
        let SplitNet {
            vertices,
            tetrahedra,
            ..
        } = self.net;
        let expected = tetrahedra.len();
        if expected > TetrahedronMesh::MAX_TETRAHEDRA {
            return Err(TetrahedronError::TooMany {
                expected: expected as f64,
                edge_m: self.tolerance / ON / (expected as f64).cbrt(),
                most: TetrahedronMesh::MAX_TETRAHEDRA,
            });
        }
        let mut pinned = self.pinned;
        for (pinned, height) in pinned.iter_mut().zip(&self.heights) {
            *pinned |= *height == 0.0;
        }
        let tetrahedra = tetrahedra.iter().map(|corners| corners.map(NodeId));
        let mesh = TetrahedronMesh::new(vertices, tetrahedra.collect())?;
        Ok((mesh.with_regions(self.regions)?, pinned))
    }

    /// Result for the edges; the sides of `before`, the levels before this one, follow the cuts.
    fn resolve(&mut self, before: &mut [Resolved]) -> Resolved {
        let mut edges = match self.level.boundary_only {
            true => self.boundary.clone(),
            false => self.edges(),
        };
        edges.retain(|edge| self.crosses(*edge));
        let moved = self.move_ends(&edges);
        let mut cut = 0;
        // Each cut leaves edges from the new vertex, which lies on the level: none of them crosses.
        edges.retain(|&edge| self.crosses(edge));
        edges.retain(|&edge| {
            let parents = self.cut(edge);
            for level in before.iter_mut() {
                let sides = parents.iter().map(|&parent| level.below[parent as usize]);
                let sides: Vec<bool> = sides.collect();
                level.below.extend(sides);
            }
            cut += usize::from(!parents.is_empty());
            parents.is_empty()
        });
        let farthest = |corners: &[u32; 4]| {
            let heights = corners.map(|node| self.heights[node as usize]);
            heights.into_iter().fold(0.0, |far: f64, height| {
                if height.abs() > far.abs() {
                    height
                } else {
                    far
                }
            })
        };
        let tetrahedra = self.net.tetrahedra.iter();
        let below = tetrahedra.map(|corners| farthest(corners) < 0.0);
        Resolved {
            moved,
            cut,
            crossing: edges.len(),
            below: below.collect(),
        }
    }

    fn height(&self, at: &Vec3) -> f64 {
        let height = (self.level.height)(at);
        if height.abs() <= self.tolerance {
            0.0
        } else {
            height
        }
    }

    fn crosses(&self, [a, b]: [NodeId; 2]) -> bool {
        self.heights[a.index()] * self.heights[b.index()] < 0.0
    }

    /// All edges, in ascending order.
    fn edges(&self) -> Vec<[NodeId; 2]> {
        let each = self.net.tetrahedra.iter();
        let mut edges: Vec<_> = each
            .flat_map(|&[a, b, c, d]| [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]])
            .map(|[a, b]| [NodeId(a.min(b)), NodeId(a.max(b))])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    fn is_on_boundary(&self, edge: [NodeId; 2]) -> bool {
        self.boundary.binary_search(&edge).is_ok()
    }

    /// Whether a vertex may go along an edge: not off a level, the boundary or a sharp edge.
    fn may_move(&self, node: NodeId, edge: [NodeId; 2]) -> bool {
        let normals = &self.normals[node.index()];
        if self.pinned[node.index()] || (!normals.is_empty() && !self.is_on_boundary(edge)) {
            return false;
        }
        let [a, b] = edge.map(|node| self.net.vertices[node.index()]);
        if let Some(searched) = self.searched {
            let other = if edge[0] == node { b } else { a };
            let [own, others] =
                [&self.net.vertices[node.index()], &other].map(|at| searched.facets_at(at));
            return own.len() < 2 || (own.len() == 2 && common(&own, &others) == own);
        }
        let along = (b - a).normalize();
        normals
            .iter()
            .all(|normal| normal.dot(&along).abs() <= IN_PLANE)
    }

    /// Moves ends of edges, those that have the least way first. How many.
    fn move_ends(&mut self, edges: &[[NodeId; 2]]) -> usize {
        let mut ways = Vec::new();
        for &edge in edges {
            let [a, b] = edge.map(|node| self.heights[node.index()]);
            let part = a / (a - b);
            for (part, node) in [(part, edge[0]), (1.0 - part, edge[1])] {
                if part <= FARTHEST && self.may_move(node, edge) {
                    ways.push(Move { part, edge, node });
                }
            }
        }
        ways.sort_by(|one, other| {
            one.part
                .total_cmp(&other.part)
                .then(one.edge.cmp(&other.edge))
        });
        let mut moved = 0;
        for Move { edge, node, .. } in ways {
            // An edge that a move before this one resolved has an end on the level.
            if !self.crosses(edge) {
                continue;
            }
            let Some(target) = self.crossing(edge) else {
                continue;
            };
            let SplitNet {
                vertices,
                tetrahedra,
                around,
            } = &mut self.net;
            let star = around[node.index()].iter();
            let star = star.map(|&t| tetrahedra[t as usize]);
            if move_if_valid(vertices, star, node.0, target, MOVED_FLOOR) {
                self.heights[node.index()] = 0.0;
                moved += 1;
            }
        }
        moved
    }

    /// Where an edge crosses the level; on the surface, if both of its ends are. Nothing where that is not found, such as
    /// where surface and level are nearly parallel.
    fn crossing(&self, edge: [NodeId; 2]) -> Option<Vec3> {
        let searched = self.searched.filter(|_| self.is_on_boundary(edge));
        let [a, b] = edge.map(|node| self.net.vertices[node.index()]);
        let onto = searched.map(|searched| searched.under_chord([&a, &b]));
        let at = |part: f64| {
            let chord = a + part * (b - a);
            onto.as_ref().map_or(chord, |onto| onto(&chord))
        };
        let [mut low, mut high] = [0.0, 1.0];
        let [mut below, mut above] = edge.map(|node| self.heights[node.index()]);
        // Secants, of which one end loses half of its weight while it stays (the Illinois rule).
        let mut stayed = 0.0;
        for _ in 0..MAX_STEPS {
            let part = low + (high - low) * below / (below - above);
            let point = at(part);
            let height = self.height(&point);
            if height == 0.0 {
                return point.iter().all(|c| c.is_finite()).then_some(point);
            }
            if height * above < 0.0 {
                (low, below) = (part, height);
                if stayed > 0.0 {
                    above *= 0.5;
                }
                stayed = 1.0;
            } else {
                (high, above) = (part, height);
                if stayed < 0.0 {
                    below *= 0.5;
                }
                stayed = -1.0;
            }
        }
        None
    }

    /// Puts a vertex into an edge, where it crosses, and cuts all tetrahedra that have it. Which these are: their other
    /// halves come last, in the same order. None where a flat tetrahedron would come.
    fn cut(&mut self, edge: [NodeId; 2]) -> Vec<u32> {
        let [a, b] = edge;
        let [from, to] = edge.map(|node| self.net.vertices[node.index()]);
        let [below, above] = edge.map(|node| self.heights[node.index()]);
        let chord = from + (to - from) * (below / (below - above));
        // On the surface if that can be, else on the chord.
        let targets = [self.crossing(edge), Some(chord)].into_iter().flatten();
        let Some(parents) = self.net.split_if_valid([a.0, b.0], targets, CUT_FLOOR) else {
            return Vec::new();
        };
        self.heights.push(0.0);
        self.pinned.push(false);
        self.regions.extend(
            parents
                .iter()
                .map(|&t| self.regions[t as usize])
                .collect::<Vec<_>>(),
        );
        parents
    }
}
