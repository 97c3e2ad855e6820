use crate::check::topology::Topology;
use crate::{Adjacency, MeshError, NodeId, TriangleMesh, Vec3};

/// Two triangles have a sharp edge between them, as those of a cube have, when the cosine between their
/// normals is less [-]: they turn by 50°.
pub const SHARP_EDGE: f64 = 0.64;

/// A mesh that bounds a solid: closed, manifold, oriented outward, in one piece unless several were put
/// [merged](Self::merged), without triangles that have no area and without vertices that no triangle uses.
///
/// That it does not pass through itself is not checked here: the check takes seconds on a large
/// organ (see [`crate::inspect`]), and code that takes a `Surface` does not depend on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    mesh: TriangleMesh,
    adjacency: Adjacency,
    vertex_normals: Vec<Vec3>,
}

impl Surface {
    /// The surface that `mesh` is.
    ///
    /// # Errors
    /// When it is not one; the error names the first reason, with a count and a remedy.
    pub fn new(mesh: TriangleMesh) -> Result<Self, MeshError> {
        let adjacency = Adjacency::new(&mesh);
        check(&mesh, &adjacency)?;
        let vertex_normals = vertex_normals(&mesh, &adjacency);
        Ok(Self {
            mesh,
            adjacency,
            vertex_normals,
        })
    }

    /// Several bodies as one surface, in more than one piece: their vertices and triangles one body after the other.
    ///
    /// # Errors
    /// When there is none.
    pub fn merged(bodies: &[&Self]) -> Result<Self, MeshError> {
        let (mut vertices, mut triangles, mut vertex_normals) = (vec![], vec![], vec![]);
        for body in bodies {
            let first = vertices.len() as u32;
            vertices.extend_from_slice(body.mesh.vertices());
            vertex_normals.extend_from_slice(&body.vertex_normals);
            let own = body.mesh.triangles().iter();
            triangles.extend(own.map(|corners| corners.map(|node| NodeId(node.0 + first))));
        }
        let mesh = TriangleMesh::new(vertices, triangles)?;
        Ok(Self {
            adjacency: Adjacency::new(&mesh),
            mesh,
            vertex_normals,
        })
    }

    /// The triangles.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Triangles that share an edge or a vertex.
    pub fn adjacency(&self) -> &Adjacency {
        &self.adjacency
    }

    /// Outward unit normal of each vertex [-]: the mean over its triangles, weighted by their angle
    /// there, so that it does not depend on how a flat side is cut into triangles.
    pub fn vertex_normals(&self) -> &[Vec3] {
        &self.vertex_normals
    }
}

fn check(mesh: &TriangleMesh, adjacency: &Adjacency) -> Result<(), MeshError> {
    let without_area = mesh
        .triangle_ids()
        .filter(|&t| mesh.area_vector(t).try_normalize(0.0).is_none())
        .count();
    if without_area > 0 {
        return Err(MeshError::DegenerateTriangles {
            triangles: without_area,
        });
    }
    let topology = Topology::new(mesh, adjacency);
    if topology.unused_vertices > 0 {
        return Err(MeshError::UnusedVertices {
            vertices: topology.unused_vertices,
        });
    }
    if !topology.manifold() {
        return Err(MeshError::NotManifold {
            edges: topology.non_manifold_edges,
            vertices: topology.split_vertices,
        });
    }
    if !topology.closed() {
        return Err(MeshError::NotClosed {
            edges: topology.boundary_edges,
        });
    }
    if topology.misoriented_edges > 0 {
        return Err(MeshError::NotOriented {
            edges: topology.misoriented_edges,
        });
    }
    if topology.components > 1 {
        return Err(MeshError::SeveralPieces {
            pieces: topology.components,
        });
    }
    let volume_m3 = mesh.volume();
    if volume_m3 <= 0.0 {
        return Err(MeshError::InsideOut { volume_m3 });
    }
    Ok(())
}

fn vertex_normals(mesh: &TriangleMesh, adjacency: &Adjacency) -> Vec<Vec3> {
    (0..mesh.vertices().len())
        .map(|vertex| vertex_normal(mesh, adjacency, NodeId(vertex as u32)))
        .collect()
}

fn vertex_normal(mesh: &TriangleMesh, adjacency: &Adjacency, node: NodeId) -> Vec3 {
    let mut sum = Vec3::zeros();
    let mut largest = Vec3::zeros();
    for &triangle in adjacency.around(node) {
        let corners = mesh.corners(triangle);
        let here = corners.iter().position(|&c| c == node).unwrap_or(0);
        let positions = mesh.positions(triangle);
        let one = positions[(here + 1) % 3] - positions[here];
        let other = positions[(here + 2) % 3] - positions[here];
        let area_vector = mesh.area_vector(triangle);
        sum += one.angle(&other) * area_vector.normalize();
        if area_vector.norm() > largest.norm() {
            largest = area_vector;
        }
    }
    // The weighted normals cancel where a sheet folds back on itself; any of its sides will do.
    sum.try_normalize(1e-12).unwrap_or(largest.normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> TriangleMesh {
        let vertices = vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
        let triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        TriangleMesh::new(vertices, triangles.map(|t| t.map(NodeId)).to_vec()).unwrap()
    }

    fn changed(change: impl Fn(&mut Vec<Vec3>, &mut Vec<[NodeId; 3]>)) -> Result<(), MeshError> {
        let mesh = tetrahedron();
        let (mut vertices, mut triangles) = (mesh.vertices().to_vec(), mesh.triangles().to_vec());
        change(&mut vertices, &mut triangles);
        Surface::new(TriangleMesh::new(vertices, triangles).unwrap()).map(drop)
    }

    #[test]
    fn a_corner_of_three_square_sides_has_the_diagonal_as_normal() {
        let surface = Surface::new(tetrahedron()).unwrap();
        let expected = -Vec3::repeat(1.0).normalize();
        assert!((surface.vertex_normals()[0] - expected).norm() < 1e-14);
    }

    #[test]
    fn refuses_what_bounds_no_solid_and_counts_the_faults() {
        assert_eq!(changed(|_, _| ()), Ok(()));
        let open = changed(|_, t| t.truncate(3));
        assert_eq!(open, Err(MeshError::NotClosed { edges: 3 }));
        let twisted = changed(|_, t| t[0].swap(0, 1));
        assert_eq!(twisted, Err(MeshError::NotOriented { edges: 3 }));
        let inside_out = changed(|_, t| t.iter_mut().for_each(|t| t.swap(0, 1)));
        assert!(matches!(inside_out, Err(MeshError::InsideOut { volume_m3 }) if volume_m3 < 0.0));
        let unused = changed(|v, _| v.push(Vec3::x()));
        assert_eq!(unused, Err(MeshError::UnusedVertices { vertices: 1 }));
        let flat = changed(|v, _| v[1] = Vec3::zeros());
        assert_eq!(flat, Err(MeshError::DegenerateTriangles { triangles: 2 }));
    }

    #[test]
    fn refuses_two_pieces_apart_and_two_pieces_that_touch() {
        let apart = changed(|v, t| add_second(v, t, 4));
        assert_eq!(apart, Err(MeshError::SeveralPieces { pieces: 2 }));
        let touching = changed(|v, t| add_second(v, t, 0));
        let expected = MeshError::NotManifold {
            edges: 0,
            vertices: 1,
        };
        assert_eq!(touching, Err(expected));
    }

    /// A mirrored second tetrahedron; its first corner is the vertex `shared` when that is there.
    fn add_second(vertices: &mut Vec<Vec3>, triangles: &mut Vec<[NodeId; 3]>, shared: u32) {
        let added: Vec<Vec3> = vertices.iter().map(|v| -v).collect();
        let skipped = if shared == 4 { 0 } else { 1 };
        vertices.extend(&added[skipped..]);
        let number = |n: NodeId| match n.0 {
            0 => NodeId(shared),
            other => NodeId(other + 4 - skipped as u32),
        };
        let second: Vec<_> = triangles
            .iter()
            .map(|&[a, b, c]| [a, c, b].map(number))
            .collect();
        triangles.extend(second);
    }
}
