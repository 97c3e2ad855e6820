use std::fmt;

use crate::{AabbTree, TriangleId, TriangleMesh, Vec3};

/// About how many points of a mesh are looked at, and in how many rows at most on a triangle.
const SAMPLES: f64 = 40_000.0;
const ROWS: f64 = 24.0;

/// Distances of the points of one mesh from another.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Deviation {
    /// Of the farthest point that was looked at [m].
    #[serde(rename = "max_m")]
    pub max: f64,
    /// Over the area [m].
    #[serde(rename = "mean_m")]
    pub mean: f64,
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [max, mean] = [self.max, self.mean].map(|metres| 1e3 * metres);
        write!(f, "at most {max:.3} mm, {mean:.3} mm on the mean")
    }
}

/// Distance of the surface `from` to the surface `to`: the one-sided Hausdorff distance. Its
/// vertices are looked at, and some 40,000 points that are spread evenly over its triangles.
pub fn deviation(from: &TriangleMesh, to: &TriangleMesh) -> Deviation {
    deviation_with_tree(from, to, &AabbTree::new(to))
}

pub(crate) fn deviation_with_tree(
    from: &TriangleMesh,
    to: &TriangleMesh,
    tree: &AabbTree,
) -> Deviation {
    let distance = |point: &Vec3| tree.nearest(to, point).distance;
    let corners = from.triangles().iter().flatten();
    let mut is_used = vec![false; from.vertices().len()];
    corners.for_each(|node| is_used[node.index()] = true);
    let used = from
        .vertices()
        .iter()
        .zip(is_used)
        .filter(|(_, used)| *used);
    let at_vertices = used.map(|(v, _)| distance(v)).fold(0.0, f64::max);
    let whole = from.area();
    let (mut max, mut integral) = (at_vertices, 0.0);
    for triangle in from.triangle_ids() {
        let area = from.area_vector(triangle).norm();
        let rows = (SAMPLES * area / whole).sqrt().ceil().clamp(1.0, ROWS) as usize;
        let (mut sum, mut count) = (0.0, 0.0);
        for_each_middle(from, triangle, rows, |point| {
            let here = distance(&point);
            max = f64::max(max, here);
            sum += here;
            count += 1.0;
        });
        integral += area * sum / count;
    }
    let mean = if whole > 0.0 { integral / whole } else { 0.0 };
    Deviation { max, mean }
}

/// The middles of the `rows` × `rows` equal parts of a triangle.
pub(crate) fn for_each_middle(
    mesh: &TriangleMesh,
    triangle: TriangleId,
    rows: usize,
    mut visit: impl FnMut(Vec3),
) {
    let [a, b, c] = mesh.positions(triangle);
    let count = rows as f64;
    for i in 0..rows {
        for j in 0..rows - i {
            let mut at = |more: f64| {
                let (u, v) = (i as f64 + more, j as f64 + more);
                visit(a + ((b - a) * u + (c - a) * v) / count);
            };
            at(1.0 / 3.0);
            // The part that points the other way.
            if i + j + 1 < rows {
                at(2.0 / 3.0);
            }
        }
    }
}
