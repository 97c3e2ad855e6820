use palpate_geometry::{MeshError, NodeId, TriangleMesh, Vec3};

/// The edges of `mesh` with its vertices at `places` [m], as ribbons `width` wide [m] that lie on it: what
/// a picture shows of a wire frame.
///
/// # Errors
/// When a place is not finite.
pub(crate) fn wire_frame(
    mesh: &TriangleMesh,
    places: &[Vec3],
    width: f64,
) -> Result<TriangleMesh, MeshError> {
    let mut edges: Vec<([NodeId; 2], Vec3)> = Vec::with_capacity(3 * mesh.triangles().len());
    for corners in mesh.triangles() {
        let [a, b, c] = corners.map(|node| places[node.index()]);
        let normal = (b - a).cross(&(c - a));
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            edges.push(([from.min(to), from.max(to)], normal));
        }
    }
    edges.sort_by_key(|(ends, _)| *ends);
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for same in edges.chunk_by(|(one, _), (other, _)| one == other) {
        let [a, b] = same[0].0.map(|node| places[node.index()]);
        let normal: Vec3 = same.iter().map(|(_, normal)| normal).sum();
        let (Some(normal), Some(along)) = (normal.try_normalize(0.0), (b - a).try_normalize(1e-12))
        else {
            continue;
        };
        let across = 0.5 * width * along.cross(&normal);
        // Above the surface, so that it does not cut through.
        let lift = 0.4 * width * normal;
        let first = vertices.len() as u32;
        vertices.extend([a + across, b + across, b - across, a - across].map(|v| v + lift));
        let node = |k: u32| NodeId(first + k);
        triangles.push([node(0), node(1), node(2)]);
        triangles.push([node(0), node(2), node(3)]);
    }
    TriangleMesh::new(vertices, triangles)
}
