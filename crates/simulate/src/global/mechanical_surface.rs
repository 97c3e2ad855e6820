use palpate_geometry::{AabbTree, SimplifySettings, Surface, simplify_graded};

use crate::Error;
use crate::walls::thicknesses;

/// Largest number of triangles of a mesh that is its own mechanical mesh.
const MAX_OWN_TRIANGLES: usize = 6_000;

/// Number of mechanical triangles for a finer mesh.
const OF_A_FINER_ONE: usize = 5_000;

/// Longest edges in parts of the wall under them [-]. A tip's force is spread over 2.2 of them, which must be less than
/// what bends: on the rim of a liver, 10 to 20 mm thick, even ones were 15 % too stiff when boundary elements
/// still resisted being turned (`docs/theory/boundary_elements.md`).
const OF_A_WALL: f64 = 0.12;

/// Shortest edges, in parts of even ones [-].
const FINEST: f64 = 0.25;

/// By how much edges may grow along the way [-].
const GROWTH: f64 = 0.25;

/// The mechanical surface of `shown`: the same surface, or one of at most `wanted` triangles; with warnings.
pub(super) fn mechanical_surface(
    shown: &Surface,
    wanted: Option<usize>,
) -> Result<(Surface, Vec<String>), Error> {
    let triangles = shown.mesh().triangles().len();
    if triangles <= wanted.unwrap_or(MAX_OWN_TRIANGLES) {
        return Ok((shown.clone(), Vec::new()));
    }
    let wanted = wanted.unwrap_or(OF_A_FINER_ONE);
    let coarse = simplify_graded(
        shown.mesh(),
        &SimplifySettings::to(wanted),
        &sizes(shown, wanted),
    )?;
    let mut warnings = Vec::new();
    if coarse.self_intersections > 0 {
        warnings.push(format!(
            "{} triangles of the mechanical mesh meet others; raise `model.mechanical_triangles` above {wanted}",
            coarse.self_intersections
        ));
    }
    let surface = Surface::new(coarse.mesh).map_err(Error::MechanicalMesh)?;
    Ok((surface, warnings))
}

/// The edges that are wanted at each vertex of `shown` for about `triangles` [m]: where the organ is thin they are as
/// short as its wall asks for, elsewhere even.
fn sizes(shown: &Surface, triangles: usize) -> Vec<f64> {
    let mesh = shown.mesh();
    let area: f64 = mesh
        .triangle_ids()
        .map(|id| mesh.area_vector(id).norm())
        .sum();
    let even = (2.0 * area / triangles as f64).sqrt();
    let mut sizes = vec![even; mesh.vertices().len()];
    let tree = AabbTree::new(mesh);
    for (triangle, thickness) in thicknesses(shown, &tree, mesh.triangle_ids()) {
        for node in mesh.corners(triangle) {
            let size = &mut sizes[node.index()];
            *size = size.min((OF_A_WALL * thickness).max(FINEST * even));
        }
    }
    // A rim has the direction of the leaf that it ends.
    let edges = mesh
        .triangles()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: Vec<_> = edges
        .map(|[a, b]| {
            let [from, to] = [a, b].map(|node| mesh.vertices()[node.index()]);
            (a.index(), b.index(), GROWTH * (to - from).norm())
        })
        .collect();
    loop {
        let mut changed = false;
        for &(a, b, more) in &edges {
            for (a, b) in [(a, b), (b, a)] {
                if sizes[a] > sizes[b] + more {
                    sizes[a] = sizes[b] + more;
                    changed = true;
                }
            }
        }
        if !changed {
            return sizes;
        }
    }
}
