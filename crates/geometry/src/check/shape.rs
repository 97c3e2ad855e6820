use crate::{TriangleId, TriangleMesh};

/// A triangle whose height is a smaller part of its longest side has no area that can be relied on
/// [-]; rounding moves single-precision corners by as much.
const DEGENERATE_HEIGHT: f64 = 1e-7;

/// Below this a corner is so sharp that deformations come out wrong there [rad]: two degrees.
const SHARPEST_CORNER: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// How many triangles have hardly any area, and how many others have a needle's corner.
pub(super) fn count_bad_triangles(mesh: &TriangleMesh) -> (usize, usize) {
    let (mut degenerate, mut slivers) = (0, 0);
    for triangle in mesh.triangle_ids() {
        let longest = longest_side(mesh, triangle);
        let height = 2.0 * mesh.area_vector(triangle).norm() / longest;
        if height.is_nan() || height < DEGENERATE_HEIGHT * longest {
            degenerate += 1;
        } else if sharpest_corner(mesh, triangle) < SHARPEST_CORNER {
            slivers += 1;
        }
    }
    (degenerate, slivers)
}

fn longest_side(mesh: &TriangleMesh, triangle: TriangleId) -> f64 {
    let [a, b, c] = mesh.positions(triangle);
    (b - a).norm().max((c - b).norm()).max((a - c).norm())
}

/// Smallest angle [rad].
fn sharpest_corner(mesh: &TriangleMesh, triangle: TriangleId) -> f64 {
    let p = mesh.positions(triangle);
    (0..3)
        .map(|k| (p[(k + 1) % 3] - p[k]).angle(&(p[(k + 2) % 3] - p[k])))
        .fold(f64::INFINITY, f64::min)
}
