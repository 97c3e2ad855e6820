use super::guard::double_area;
use super::net::Net;
use crate::{AabbTree, TriangleMesh, Vec3};

/// The mesh that a simpler one shall keep to.
pub(super) struct Reference<'a> {
    pub(super) mesh: &'a TriangleMesh,
    pub(super) tree: &'a AabbTree,
}

impl Reference<'_> {
    /// Per vertex how far the net around it stands outside of the reference, on the mean over its
    /// triangles [m]; none where something else is nearer, as behind a thin wall.
    pub(super) fn mean_gaps(&self, net: &Net) -> Vec<Option<f64>> {
        let at_vertices: Vec<_> = (0..net.positions.len() as u32)
            .map(|v| self.gap_at_vertex(net, v))
            .collect();
        let mut sums = vec![Some((0.0, 0.0)); at_vertices.len()];
        for triangle in net.triangles() {
            let integral = self.integral(net, triangle, &at_vertices);
            for v in net.corners(triangle) {
                let sum = &mut sums[v as usize];
                *sum = sum
                    .zip(integral)
                    .map(|((gap, area), (more, part))| (gap + more, area + part));
            }
        }
        let mean = |(gap, area): (f64, f64)| if area > 0.0 { gap / area } else { 0.0 };
        sums.into_iter().map(|sum| sum.map(mean)).collect()
    }

    fn gap_at_vertex(&self, net: &Net, vertex: u32) -> Option<f64> {
        let normals = net.around(vertex).iter();
        let upright: Vec3 = normals.map(|&t| double_area(&net.placed(t))).sum();
        self.gap(&net.positions[vertex as usize], &upright)
    }

    /// Gap over a triangle [m³] and its area [m²]: by the corners and the middle, which is exact
    /// for a gap that is quadratic.
    fn integral(
        &self,
        net: &Net,
        triangle: u32,
        at_vertices: &[Option<f64>],
    ) -> Option<(f64, f64)> {
        let corners = net.placed(triangle);
        let double = double_area(&corners);
        let area = 0.5 * double.norm();
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let mut mean = 0.75 * self.gap(&middle, &double)?;
        for v in net.corners(triangle) {
            mean += at_vertices[v as usize]? / 12.0;
        }
        Some((area * mean, area))
    }

    /// Signed distance of `point`, positive outside [m], for a surface that faces along `upright`
    /// there.
    fn gap(&self, point: &Vec3, upright: &Vec3) -> Option<f64> {
        let nearest = self.tree.nearest(self.mesh, point);
        let facing = self.mesh.area_vector(nearest.triangle);
        if facing.dot(upright) < 0.0 {
            return None;
        }
        let outside = (point - nearest.on.position).dot(upright) >= 0.0;
        Some(if outside {
            nearest.distance
        } else {
            -nearest.distance
        })
    }
}
