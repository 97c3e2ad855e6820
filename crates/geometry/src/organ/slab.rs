use super::{AnchorPlane, OrganDescription, grid};
use crate::{MeshError, TriangleMesh, Vec3};

const SIZE: Vec3 = Vec3::new(0.1, 0.1, 0.015);

/// Rectangles along a side at least: fewer would be long and narrow on the sides.
const MIN_CELLS: usize = 4;
pub(super) const MIN_TRIANGLES: usize = 4 * MIN_CELLS * (MIN_CELLS + 2);

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "A flat slab, as training models of skin and tissue are.",
        axes: "x and y along the edges, z up",
        origin: "the centre of the bottom face",
        lengths: "100 mm along x and y, 15 mm thick",
        fixed: "the bottom face, z = 0",
        extent: SIZE,
        volume: SIZE.product(),
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![AnchorPlane {
        // Just above the face: below the centroid of any triangle of the sides.
        point: Vec3::new(0.0, 0.0, 1e-6),
        normal: Vec3::z(),
    }]
}

/// A grid of nearly square rectangles on each face, with alternating diagonals.
pub(super) fn surface_mesh(triangles: usize) -> Result<TriangleMesh, MeshError> {
    grid::surface_mesh(cells(triangles), |part| {
        (part - Vec3::new(0.5, 0.5, 0.0)).component_mul(&SIZE)
    })
}

/// The rectangles along x, y and z that make the number of triangles nearest to `wanted`.
fn cells(wanted: usize) -> [usize; 3] {
    let of = |side: usize| {
        let up = (side as f64 * SIZE.z / SIZE.x).round().max(1.0);
        [side, side, up as usize]
    };
    // Two faces alone have four triangles per square of the side.
    let most = (wanted as f64 / 4.0).sqrt().ceil() as usize;
    let sides = (MIN_CELLS..=most).map(of);
    let nearest = sides.min_by_key(|cells| grid::triangles(*cells).abs_diff(wanted));
    nearest.unwrap_or_else(|| of(MIN_CELLS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volume_and_bounds_are_exact() {
        let mesh = surface_mesh(2500).unwrap();
        assert!(mesh.triangles().len().abs_diff(2500) < 120);
        assert!((mesh.volume() - 1.5e-4).abs() < 1e-15);
        let (low, high) = mesh.bounds();
        assert!((low - Vec3::new(-0.05, -0.05, 0.0)).norm() < 1e-15);
        assert!((high - Vec3::new(0.05, 0.05, 0.015)).norm() < 1e-15);
    }
}
