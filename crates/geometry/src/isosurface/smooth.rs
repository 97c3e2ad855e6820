use crate::mesh::edges::{by_edge, sides};
use crate::{NodeId, Vec3};

/// A step towards the middle of the neighbours, and the larger one back [Taubin 1995]: together they
/// take away what is shorter than some twenty edges and leave what is longer.
const STEPS: [f64; 2] = [0.5, -0.53];

/// How far a vertex may go along each index from where the voxels put it [voxel]: what the picture
/// leaves open.
const REACH: f64 = 0.5;

/// Takes the steps of the voxels away.
pub(super) fn smooth(vertices: &mut [Vec3], triangles: &[[NodeId; 3]], rounds: usize) {
    let start = vertices.to_vec();
    let sides = sides(triangles);
    let edges: Vec<[usize; 2]> = by_edge(&sides)
        .map(|edge| [edge[0].low.index(), edge[0].high.index()])
        .collect();
    let mut sums = vec![(Vec3::zeros(), 0.0); vertices.len()];
    for _ in 0..rounds {
        for step in STEPS {
            sums.fill((Vec3::zeros(), 0.0));
            for &[a, b] in &edges {
                for (one, other) in [(a, b), (b, a)] {
                    sums[one].0 += vertices[other];
                    sums[one].1 += 1.0;
                }
            }
            for (vertex, (sum, count)) in vertices.iter_mut().zip(&sums) {
                *vertex += step * (sum / *count - *vertex);
            }
        }
        for (vertex, start) in vertices.iter_mut().zip(&start) {
            *vertex = vertex
                .inf(&start.add_scalar(REACH))
                .sup(&start.add_scalar(-REACH));
        }
    }
}
