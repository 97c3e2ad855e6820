//! Problems of a mesh, and how to repair it.

mod contact;
pub(crate) mod problem;
pub(crate) mod self_intersection;
mod shape;
mod thickness;
pub(crate) mod topology;

use serde::Serialize;

use self::problem::{MeshProblem, ProblemKind};
use self::self_intersection::count_self_intersections;
use self::shape::count_bad_triangles;
use self::thickness::is_double_wall;
use self::topology::Topology;
use crate::{Adjacency, TriangleMesh, is_plausible_extent};

/// The findings of [`inspect`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshReport {
    /// Vertices, used or not.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Whether no edge has one triangle only.
    pub closed: bool,
    /// Whether no edge has more than two triangles and no vertex joins separate fans.
    pub manifold: bool,
    /// Whether neighbours agree about the outside, and a closed mesh has a positive volume.
    pub oriented: bool,
    /// Pieces that hang together over edges.
    pub components: usize,
    /// Edges with one triangle.
    pub boundary_edges: usize,
    /// Triangles that meet another elsewhere than in a vertex or an edge that both have.
    pub self_intersections: usize,
    /// Handles, summed over the pieces; of a closed manifold only.
    pub genus: Option<usize>,
    /// Signed volume [m³]; positive when a closed mesh faces outward, meaningless for an open one.
    pub volume_m3: f64,
    /// Area [m²].
    pub area_m2: f64,
    /// Size along x, y and z [m].
    pub extent_m: [f64; 3],
    /// Its smallest coordinates [m].
    pub low_m: [f64; 3],
    /// Its largest coordinates [m].
    pub high_m: [f64; 3],
    /// Problems, with the remedy; none when the mesh bounds a solid of even triangles.
    pub problems: Vec<MeshProblem>,
}

/// Looks a mesh over. The search for self-intersections makes this slow: about a second for
/// 100,000 triangles.
pub fn inspect(mesh: &TriangleMesh) -> MeshReport {
    let topology = Topology::new(mesh, &Adjacency::new(mesh));
    let (low, high) = mesh.bounds();
    let volume_m3 = mesh.volume();
    let oriented = topology.misoriented_edges == 0 && !(topology.closed() && volume_m3 <= 0.0);
    let mut report = MeshReport {
        vertices: mesh.vertices().len(),
        triangles: mesh.triangles().len(),
        closed: topology.closed(),
        manifold: topology.manifold(),
        oriented,
        components: topology.components,
        boundary_edges: topology.boundary_edges,
        self_intersections: count_self_intersections(mesh),
        genus: topology.genus(),
        volume_m3,
        area_m2: mesh.area(),
        extent_m: (high - low).into(),
        low_m: low.into(),
        high_m: high.into(),
        problems: Vec::new(),
    };
    report.problems = problems(mesh, &topology, &report);
    report
}

fn problems(mesh: &TriangleMesh, topology: &Topology, report: &MeshReport) -> Vec<MeshProblem> {
    use ProblemKind as Kind;
    let misdirected = match topology.misoriented_edges {
        0 if !report.oriented => report.triangles,
        twisted => twisted,
    };
    let solid = report.closed && report.manifold && report.oriented;
    let double_wall = solid && is_double_wall(report.volume_m3, report.area_m2);
    let largest = report.extent_m.into_iter().fold(0.0, f64::max);
    let (degenerate, slivers) = count_bad_triangles(mesh);
    [
        (Kind::NotClosed, topology.boundary_edges),
        (
            Kind::NotManifold,
            topology.non_manifold_edges + topology.split_vertices,
        ),
        (Kind::NotOriented, misdirected),
        (Kind::SeveralPieces, other_than_one(topology.components)),
        (Kind::SelfIntersecting, report.self_intersections),
        (Kind::DoubleWall, usize::from(double_wall)),
        (Kind::DegenerateTriangles, degenerate),
        (Kind::SliverTriangles, slivers),
        (Kind::UnusedVertices, topology.unused_vertices),
        (
            Kind::ImplausibleSize,
            usize::from(!is_plausible_extent(largest)),
        ),
    ]
    .into_iter()
    .filter_map(|(kind, count)| kind.times(count))
    .collect()
}

fn other_than_one(pieces: usize) -> usize {
    if pieces == 1 { 0 } else { pieces }
}
