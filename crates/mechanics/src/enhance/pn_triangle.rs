use crate::Vec3;

/// A curved patch over a triangle: a cubic that has its corners and the normals there
/// [Vlachos et al. 2001]. Its edges depend on their own ends alone, so that neighbours meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct PnTriangle {
    corners: [Vec3; 3],
    /// Per edge from corner k to the next: the control points next to its ends [m].
    edges: [[Vec3; 2]; 3],
    middle: Vec3,
}

impl PnTriangle {
    /// Over `corners` [m] with unit `normals` [-]; a `straight` edge (from corner k to the next) does not
    /// bulge.
    pub(super) fn new(corners: [Vec3; 3], normals: &[Vec3; 3], straight: [bool; 3]) -> Self {
        // b210 and its like: a third of the way, put down on the tangent plane of the near end.
        let control_point = |near: usize, far: usize, straight: bool| {
            let way = corners[far] - corners[near];
            let height = if straight {
                0.0
            } else {
                way.dot(&normals[near])
            };
            corners[near] + (way - height * normals[near]) / 3.0
        };
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(k, next)| {
            [
                control_point(k, next, straight[k]),
                control_point(next, k, straight[k]),
            ]
        });
        let of_edges = edges.iter().flatten().sum::<Vec3>() / 6.0;
        let of_corners = corners.iter().sum::<Vec3>() / 3.0;
        Self {
            corners,
            edges,
            middle: of_edges + 0.5 * (of_edges - of_corners),
        }
    }

    /// The patch's point [m] over the triangle's point with these weights of the corners [-].
    pub(super) fn at(&self, weights: &[f64; 3]) -> Vec3 {
        let mut sum = 6.0 * weights[0] * weights[1] * weights[2] * self.middle;
        for k in 0..3 {
            let (here, next) = (weights[k], weights[(k + 1) % 3]);
            let [near, far] = self.edges[k];
            sum += here * here * here * self.corners[k];
            sum += 3.0 * here * next * (here * near + next * far);
        }
        sum
    }
}
