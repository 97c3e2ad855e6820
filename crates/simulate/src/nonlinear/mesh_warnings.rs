//! What the mesh of a body lacks: parts of the body, and nodes where the body is held.

use palpate_geometry::{Fidelity, FillSettings, NodeId, Surface, TetrahedronMesh, Vec3};

/// Part of the held area of a surface below which a warning says that its nodes are not held [-]. Areas are those of
/// the corners of triangles, which agree within a tenth or so where an anchor takes in a layer of nodes.
const HELD: f64 = 0.5;

/// Warnings about the mesh of so many `nodes` of the body within `surface`, which is held where `is_held` says so.
pub(super) fn mesh_warnings(
    surface: &Surface,
    nodes: usize,
    mesh: &TetrahedronMesh,
    is_held: impl Fn(&Vec3) -> bool,
) -> Vec<String> {
    let edge = FillSettings::with_about(surface, nodes).edge;
    let missing = Fidelity::of(mesh, surface).warning(edge);
    let missing = missing.map(|warning| format!("{warning}; more `nodes` follow it closer"));
    let loose = loose(surface, mesh, is_held).map(|part| {
        format!(
            "the anchor holds {:.0} % of the boundary that it should: a mesh of {nodes} nodes follows the surface to a part of an \
             edge, so that an anchor that ends on a face misses its nodes; let it reach {:.1} mm deeper, half an edge",
            100.0 * part,
            1e3 * 0.5 * edge
        )
    });
    missing.into_iter().chain(loose).collect()
}

/// The held area of the boundary of `mesh` over that of `surface`, where it is far less [-].
fn loose(
    surface: &Surface,
    mesh: &TetrahedronMesh,
    is_held: impl Fn(&Vec3) -> bool,
) -> Option<f64> {
    let wanted = surface.mesh();
    let wanted = held_area(
        wanted.vertices(),
        wanted.triangles().iter().copied(),
        &is_held,
    );
    let faces = mesh.boundary().into_iter().map(|(corners, _)| corners);
    let part = held_area(mesh.vertices(), faces, &is_held) / wanted;
    (part < HELD).then_some(part)
}

/// The area of these triangles [m²] at the corners that are held.
fn held_area(
    vertices: &[Vec3],
    triangles: impl Iterator<Item = [NodeId; 3]>,
    is_held: impl Fn(&Vec3) -> bool,
) -> f64 {
    let of = |corners: [NodeId; 3]| {
        let [a, b, c] = corners.map(|corner| vertices[corner.0 as usize]);
        let held = [a, b, c].iter().filter(|place| is_held(place)).count();
        (b - a).cross(&(c - a)).norm() * held as f64 / 6.0
    };
    triangles.map(of).sum()
}
