//! Meshes of smooth maps of the unit sphere.
//!
//! Points are spread evenly over the surface, joined by the Delaunay triangulation of the sphere
//! below them, and moved along the surface until triangles are well shaped. As long as no triangle
//! is turned over on the sphere, the mesh has the topology of the sphere, whatever the shape.

mod delaunay;
mod relaxation;
mod spread;
mod triangulation;

use crate::{MeshError, NodeId, TriangleMesh, Vec3};

/// A smooth one-to-one map from unit vectors [-] to points of a surface [m]; outward stays outward.
pub(super) type SphereMap = fn(&Vec3) -> Vec3;

/// Enough for triangles to stop changing visibly.
const ROUNDS: usize = 25;

/// The surface `map`, in exactly `triangles` triangles (one more when that is odd).
pub(super) fn surface_mesh(map: SphereMap, triangles: usize) -> Result<TriangleMesh, MeshError> {
    // A closed surface without handles: F = 2 V - 4.
    let vertices = triangles.div_ceil(2) + 2;
    let mut units = spread::spread_points(map, vertices);
    let mut net = triangulation::Triangulation::new(delaunay::triangulate(&units));
    relaxation::relax(map, &mut net, &mut units, ROUNDS);
    let faces = net.triangles().iter().map(|t| t.map(NodeId)).collect();
    TriangleMesh::new(units.iter().map(map).collect(), faces)
}
