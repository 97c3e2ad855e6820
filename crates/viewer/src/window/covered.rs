//! Whether the organ covers a place, as it is now.

use palpate_geometry::{NodeId, Vec3, ray_meets_triangle};

/// Whether a triangle of a surface with these vertices [m] lies between an `eye` and a `place` [m].
pub(super) fn is_covered(
    vertices: &[[f32; 3]],
    triangles: &[[NodeId; 3]],
    place: &Vec3,
    eye: &Vec3,
) -> bool {
    let way = eye - place;
    let (along, distance) = (way.normalize(), way.norm());
    let corner = |node: NodeId| Vec3::from(vertices[node.0 as usize].map(f64::from));
    triangles.iter().any(|nodes| {
        let met = ray_meets_triangle(place, &along, &nodes.map(corner));
        met.is_some_and(|met| met <= distance)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: by hand, a triangle in the plane z = 1.
    #[test]
    fn a_triangle_covers_what_is_behind_it() {
        let vertices = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        let triangles = [[NodeId(0), NodeId(1), NodeId(2)]];
        let covered = |place: [f64; 3], eye: [f64; 3]| {
            is_covered(&vertices, &triangles, &place.into(), &eye.into())
        };
        assert!(covered([0.2, 0.2, 0.0], [0.2, 0.2, 2.0]));
        assert!(covered([0.2, 0.2, 2.0], [0.3, 0.2, 0.0]));
        assert!(!covered([0.2, 0.2, 0.0], [0.2, 0.2, 0.9]));
        assert!(!covered([0.2, 0.2, 1.5], [0.2, 0.2, 2.0]));
        assert!(!covered([0.6, 0.6, 0.0], [0.6, 0.6, 2.0]));
        assert!(!covered([0.0, 0.0, 0.5], [1.0, 0.0, 0.5]));
    }
}
