use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation as _};

use crate::Vec3;

/// A unit vector seen in the plane, with its number.
struct Projected {
    position: Point2<f64>,
    number: u32,
}

impl HasPosition for Projected {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// The Delaunay triangulation of unit vectors, counter-clockwise seen from outside.
///
/// Stereographic projection from the last vector turns circles on the sphere into circles in the
/// plane, and those through the last vector into lines: so the planar triangulation gives all
/// triangles but those at the last vector, and these stand on its convex hull.
pub(super) fn triangulate(units: &[Vec3]) -> Vec<[u32; 3]> {
    let last = units.len() - 1;
    let pole = units[last];
    let across = pole.cross(&Vec3::ith(pole.iamin(), 1.0)).normalize();
    let along = pole.cross(&across);
    let projected = units[..last]
        .iter()
        .zip(0..)
        .map(|(unit, number)| {
            let scale = 1.0 / (1.0 - unit.dot(&pole));
            let position = Point2::new(scale * unit.dot(&across), scale * unit.dot(&along));
            Projected { position, number }
        })
        .collect();
    let planar = DelaunayTriangulation::<Projected>::bulk_load(projected)
        .expect("distinct unit vectors have finite projections");
    let inner = planar
        .inner_faces()
        .map(|face| face.vertices().map(|vertex| vertex.data().number));
    let outer = planar.convex_hull().map(|edge| {
        [
            edge.from().data().number,
            edge.to().data().number,
            last as u32,
        ]
    });
    inner
        .chain(outer)
        .map(|[a, b, c]| {
            let [x, y, z] = [a, b, c].map(|i| units[i as usize]);
            if x.dot(&y.cross(&z)) > 0.0 {
                [a, b, c]
            } else {
                [a, c, b]
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octahedron_has_its_eight_faces() {
        let units = [1.0, -1.0]
            .map(|s| [Vec3::x() * s, Vec3::y() * s, Vec3::z() * s])
            .concat();
        let mut faces = triangulate(&units);
        faces.iter_mut().for_each(|face| face.sort_unstable());
        faces.sort_unstable();
        assert_eq!(faces.len(), 8);
        faces.dedup();
        assert_eq!(faces.len(), 8);
    }
}
