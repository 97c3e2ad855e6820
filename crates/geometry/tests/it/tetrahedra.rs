//! Meshes of tetrahedra: what every one of them must be, and what is refused.

use palpate_geometry::{NodeId, TetrahedronError, TetrahedronMesh, Vec3};

/// In one piece; all volumes positive; each face inside shared by two; the boundary closed,
/// manifold, oriented outward; Euler's number of the solid half that of its boundary.
pub(crate) fn assert_sound(mesh: &TetrahedronMesh) {
    assert!(mesh.pieces().iter().all(|&piece| piece == 0));
    let boundary = mesh.boundary_surface().unwrap();
    assert!((boundary.mesh().volume() / mesh.volume() - 1.0).abs() < 1e-10);
    let faces = (4 * mesh.tetrahedra().len() + boundary.mesh().triangles().len()) / 2;
    let solid = mesh.vertices().len() as i64 - mesh.edges().len() as i64 + faces as i64
        - mesh.tetrahedra().len() as i64;
    let shell = boundary.mesh();
    // A closed surface has three edges to two triangles.
    let hull = shell.vertices().len() as i64 - shell.triangles().len() as i64 / 2;
    assert_eq!(
        2 * solid,
        hull,
        "Euler's numbers of the solid and of its boundary"
    );
}

/// Its size and shape in a line.
pub(crate) fn report(mesh: &TetrahedronMesh) -> String {
    let quality = mesh.quality();
    format!(
        "{} tetrahedra, {} vertices, {:.2}° to {:.2}°",
        mesh.tetrahedra().len(),
        mesh.vertices().len(),
        quality.least_dihedral.to_degrees(),
        quality.largest_dihedral.to_degrees()
    )
}

/// Judge: counts and volume of a block by hand, and the angles of Kuhn's tetrahedra.
#[test]
fn a_block_has_its_volume_and_its_faces() {
    let (low, high) = (Vec3::new(-1.0, 0.0, 2.0), Vec3::new(1.0, 3.0, 6.0));
    let mesh = TetrahedronMesh::block(low, high, [2, 3, 4]).unwrap();
    assert_sound(&mesh);
    assert_eq!(mesh.tetrahedra().len(), 6 * 24);
    assert_eq!(mesh.vertices().len(), 3 * 4 * 5);
    assert_eq!(mesh.boundary().len(), 2 * 2 * (6 + 8 + 12));
    assert!((mesh.volume() - 24.0).abs() < 1e-12);
    let quality = mesh.quality();
    assert!((quality.least_dihedral.to_degrees() - 45.0).abs() < 1e-9);
    assert!((quality.largest_dihedral.to_degrees() - 90.0).abs() < 1e-9);
    assert!((quality.longest_edge - 3f64.sqrt()).abs() < 1e-12);
    assert!(TetrahedronMesh::block(low, high, [2, 0, 4]).is_err());
    assert!(TetrahedronMesh::block(low, high, [2, usize::MAX, 4]).is_err());
    assert!(TetrahedronMesh::block(high, low, [1, 1, 1]).is_err());
}

fn made(vertices: &[Vec3], corners: &[[u32; 4]]) -> Result<TetrahedronMesh, TetrahedronError> {
    let corners = corners.iter().map(|c| c.map(NodeId)).collect();
    TetrahedronMesh::new(vertices.to_vec(), corners)
}

#[test]
fn faults_are_named_by_number() {
    let mut vertices = vec![Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()];
    vertices.extend([Vec3::new(1.0, 1.0, 0.0), Vec3::repeat(1.0)]);
    let mesh = made(&vertices, &[[0, 1, 2, 3], [1, 2, 3, 5]]).unwrap();
    // The fifth was dropped, and the sixth is now the fifth.
    assert_eq!(mesh.vertices().len(), 5);
    assert_eq!(mesh.tetrahedra()[1].map(|n| n.0), [1, 2, 3, 4]);
    assert_eq!(mesh.pieces(), [0, 0]);
    assert_eq!(made(&vertices, &[]), Err(TetrahedronError::Empty));
    let refused = |corners: &[[u32; 4]]| made(&vertices, corners).unwrap_err();
    assert!(matches!(
        refused(&[[0, 1, 2, 3], [1, 0, 2, 3]]),
        TetrahedronError::Inverted { tetrahedron: 1, .. }
    ));
    let flat = TetrahedronError::Flat { tetrahedron: 1 };
    assert_eq!(refused(&[[0, 1, 2, 3], [0, 1, 2, 4]]), flat);
    assert!(refused(&[[0, 1, 2, 9]]).to_string().contains("vertex 9"));
    let crowded = refused(&[[0, 1, 2, 3], [0, 1, 2, 5], [0, 1, 2, 3]]);
    assert!(crowded.to_string().contains("belongs to 3"), "{crowded}");
    vertices[3].z = f64::NAN;
    let broken = made(&vertices, &[[0, 1, 2, 3]]).unwrap_err();
    assert_eq!(broken, TetrahedronError::NotFinite { vertex: 3 });
}
