use super::TetrahedronMesh;
use crate::Vec3;

/// Edges of a tetrahedron, each with the two corners that it does not touch.
const EDGES: [[usize; 4]; 6] = [
    [0, 1, 2, 3],
    [0, 2, 1, 3],
    [0, 3, 1, 2],
    [1, 2, 0, 3],
    [1, 3, 0, 2],
    [2, 3, 0, 1],
];

/// How well the tetrahedra of a mesh are shaped: angles between faces near 0 or 180° cost a solver
/// accuracy and condition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TetrahedronQuality {
    /// Smallest angle between two faces [rad].
    pub least_dihedral: f64,
    /// Largest angle between two faces [rad].
    pub largest_dihedral: f64,
    /// Number of the tetrahedron that has the smallest angle.
    pub worst: usize,
    /// Shortest edge [m].
    pub shortest_edge: f64,
    /// Longest edge [m].
    pub longest_edge: f64,
}

impl TetrahedronMesh {
    /// The extremes of its angles and edges.
    pub fn quality(&self) -> TetrahedronQuality {
        let mut quality = TetrahedronQuality {
            least_dihedral: f64::INFINITY,
            largest_dihedral: 0.0,
            worst: 0,
            shortest_edge: f64::INFINITY,
            longest_edge: 0.0,
        };
        for tetrahedron in 0..self.tetrahedra().len() {
            let positions = self.positions(tetrahedron);
            for angle in dihedral_angles(&positions) {
                if angle < quality.least_dihedral {
                    quality.least_dihedral = angle;
                    quality.worst = tetrahedron;
                }
                quality.largest_dihedral = quality.largest_dihedral.max(angle);
            }
            for [i, j, ..] in EDGES {
                let length = (positions[j] - positions[i]).norm();
                quality.shortest_edge = quality.shortest_edge.min(length);
                quality.longest_edge = quality.longest_edge.max(length);
            }
        }
        quality
    }
}

/// Six times the signed volume [m³].
pub(crate) fn six_fold_volume([a, b, c, d]: &[Vec3; 4]) -> f64 {
    (b - a).dot(&(c - a).cross(&(d - a)))
}

/// The longest edge [m].
pub(crate) fn longest_edge(positions: &[Vec3; 4]) -> f64 {
    EDGES
        .iter()
        .map(|&[i, j, ..]| (positions[j] - positions[i]).norm_squared())
        .fold(0.0, f64::max)
        .sqrt()
}

/// The angles between faces at the six edges [rad].
pub(crate) fn dihedral_angles(positions: &[Vec3; 4]) -> [f64; 6] {
    EDGES.map(|[i, j, k, l]| {
        let edge = positions[j] - positions[i];
        let one = edge.cross(&(positions[k] - positions[i]));
        let other = edge.cross(&(positions[l] - positions[i]));
        one.cross(&other).norm().atan2(one.dot(&other))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_regular_tetrahedron_has_six_equal_angles() {
        let corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
        let mut corners = corners.map(|c| Vec3::from(c.map(f64::from)));
        corners.swap(0, 1);
        let edge = 8f64.sqrt();
        let six_fold = edge.powi(3) / 2f64.sqrt();
        assert!((six_fold_volume(&corners).abs() - six_fold).abs() < 1e-13);
        for angle in dihedral_angles(&corners) {
            assert!((angle - (1.0f64 / 3.0).acos()).abs() < 1e-14);
        }
        assert!((longest_edge(&corners) - edge).abs() < 1e-14);
    }
}
