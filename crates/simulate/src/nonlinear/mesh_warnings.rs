//! Warnings about the mesh of a body: missing parts of the body, and an anchor that misses nodes.

use super::anchor::Anchor;
use palpate_geometry::{Fidelity, FillSettings, NodeId, Surface, TetrahedronMesh, Vec3};

/// Fixed area of the mesh over that of the surface below which a warning is given [-]. Where an anchor contains a layer of
/// nodes, the two agree within a tenth.
const FIXED: f64 = 0.5;

/// Warnings about the mesh of so many `nodes` of the body within `surface`, fixed by `anchor`.
pub(super) fn mesh_warnings(
    surface: &Surface,
    nodes: usize,
    mesh: &TetrahedronMesh,
    anchor: &Anchor<'_>,
) -> Vec<String> {
    let edge = FillSettings::with_tetrahedron_count(surface, nodes).edge;
    let missing = Fidelity::of(mesh, surface).warning(edge);
    let missing = missing.map(|warning| format!("{warning}; more `nodes` follow it closer"));
    let missed = missed_anchor(surface, mesh, anchor).map(|part| {
        format!(
            "the anchor fixes {:.0} % of the area that it should: it is narrower than the elements of a mesh of {nodes} nodes, and \
             misses some; widen it by {:.1} mm (half an edge), or raise `nodes`",
            100.0 * part,
            1e3 * 0.5 * edge
        )
    });
    missing.into_iter().chain(missed).collect()
}

/// The fixed area of the boundary of `mesh` over that of `surface` [-]; none where both are much alike.
fn missed_anchor(surface: &Surface, mesh: &TetrahedronMesh, anchor: &Anchor<'_>) -> Option<f64> {
    let is_fixed = |place: &Vec3| anchor.is_fixed(place);
    let wanted = surface.mesh();
    let wanted = fixed_area(
        wanted.vertices(),
        wanted.triangles().iter().copied(),
        is_fixed,
    );
    let faces = mesh.boundary().into_iter().map(|(corners, _)| corners);
    let part = fixed_area(mesh.vertices(), faces, is_fixed) / wanted;
    (part < FIXED).then_some(part)
}

/// The area of these triangles [m²] that belongs to fixed corners.
fn fixed_area(
    vertices: &[Vec3],
    triangles: impl Iterator<Item = [NodeId; 3]>,
    is_fixed: impl Fn(&Vec3) -> bool,
) -> f64 {
    let of = |corners: [NodeId; 3]| {
        let [a, b, c] = corners.map(|corner| vertices[corner.0 as usize]);
        let fixed = [a, b, c].iter().filter(|place| is_fixed(place)).count();
        (b - a).cross(&(c - a)).norm() * fixed as f64 / 6.0
    };
    triangles.map(of).sum()
}
