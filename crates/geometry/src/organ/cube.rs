use super::{AnchorPlane, OrganDescription, grid};
use crate::{MeshError, TriangleMesh, Vec3};

const EDGE: f64 = 0.1;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "A cube, for comparison with closed forms.",
        axes: "x, y and z along the edges, z up",
        origin: "the centre",
        lengths: "edge 100 mm: [-0.05, 0.05] m along each axis",
        fixed: "the bottom face, z = -0.05 m",
        extent: Vec3::repeat(EDGE),
        volume: EDGE.powi(3),
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    vec![AnchorPlane {
        // Just above the face: below the centroid of any triangle of the sides.
        point: Vec3::new(0.0, 0.0, -0.5 * EDGE + 1e-6),
        normal: Vec3::z(),
    }]
}

/// A grid of squares on each face, with alternating diagonals: 12 n² triangles.
pub(super) fn surface_mesh(triangles: usize) -> Result<TriangleMesh, MeshError> {
    let cells = nearest_square(triangles, 12, 1);
    grid::surface_mesh([cells; 3], |part| EDGE * part.add_scalar(-0.5))
}

/// The whole number n, `least` or more, for which `factor` n² is nearest to `wanted`.
pub(super) fn nearest_square(wanted: usize, factor: usize, least: usize) -> usize {
    let root = (wanted as f64 / factor as f64).sqrt();
    let (below, above) = (root.floor() as usize, root.ceil() as usize);
    let nearest =
        if wanted.abs_diff(factor * below * below) <= wanted.abs_diff(factor * above * above) {
            below
        } else {
            above
        };
    nearest.max(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volume_and_bounds_are_exact() {
        let mesh = surface_mesh(300).unwrap();
        assert_eq!(mesh.triangles().len(), 300);
        assert!((mesh.volume() - 1e-3).abs() < 1e-15);
        assert_eq!(mesh.bounds(), (Vec3::repeat(-0.05), Vec3::repeat(0.05)));
    }

    #[test]
    fn the_nearest_square_is_chosen() {
        assert_eq!(nearest_square(12, 12, 1), 1);
        assert_eq!(nearest_square(100, 12, 1), 3);
        assert_eq!(nearest_square(5, 12, 1), 1);
    }
}
