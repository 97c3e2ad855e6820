//! Points that a body carries: those of the surface that is seen.

use std::ops::Range;

use palpate_geometry::TetrahedronMesh;

use super::elements::NODES;
use crate::Vec3;
use crate::finite_elements::ElementKind;

/// Points with the element that each belongs to.
#[derive(Debug, Clone, Default)]
pub struct CarriedPoints {
    points: Vec<([u32; NODES], [f32; NODES])>,
}

impl CarriedPoints {
    /// `elements` are the nodes of the quadratic tetrahedra of `mesh`, of which those of `range` carry the `points`. A point outside goes with the tetrahedron whose
    /// smallest barycentric coordinate there is the largest, as the point of it does whose coordinates are cut off at zero:
    /// quadratic functions grow fast outside.
    pub(super) fn new(
        mesh: &TetrahedronMesh,
        elements: &[u32],
        (points, range): (&[Vec3], Range<usize>),
    ) -> Self {
        let frames: Vec<_> = range
            .clone()
            .map(|t| {
                let [a, b, c, d] = mesh.positions(t);
                let edges = nalgebra::Matrix3::from_columns(&[b - a, c - a, d - a]);
                // Tetrahedra of a mesh are not flat.
                (a, edges.try_inverse().unwrap_or_default())
            })
            .collect();
        let points = points.iter().map(|point| {
            let (mut best, mut found) = (f64::NEG_INFINITY, (0, [0.0; 3]));
            for (number, (corner, inverse)) in range.clone().zip(&frames) {
                let [x, y, z]: [f64; 3] = (inverse * (point - corner)).into();
                let least = (1.0 - x - y - z).min(x).min(y).min(z);
                if least > best {
                    (best, found) = (least, (number, [x, y, z]));
                }
            }
            let (number, at) = found;
            let at = within(at);
            let own = &elements[number * NODES..][..NODES];
            let mut shape = [0.0; NODES];
            ElementKind::Tet10.shape(at, &mut shape);
            (
                std::array::from_fn(|k| own[k]),
                shape.map(|value| value as f32),
            )
        });
        Self {
            points: points.collect(),
        }
    }

    /// Carries the points of `other` as well, after its own.
    pub fn extend(&mut self, other: Self) {
        self.points.extend(other.points);
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Displacement [m] of each point, in their order, where the nodes have the `displacements` [m].
    pub fn displacements<'a>(
        &'a self,
        displacements: &'a [f64],
    ) -> impl Iterator<Item = Vec3> + 'a {
        self.points.iter().map(|(nodes, shape)| {
            let mut sum = Vec3::zeros();
            for (&node, &weight) in nodes.iter().zip(shape) {
                let u = &displacements[3 * node as usize..][..3];
                sum += f64::from(weight) * Vec3::new(u[0], u[1], u[2]);
            }
            sum
        })
    }
}

/// A point whose barycentric coordinates are not negative.
fn within([x, y, z]: [f64; 3]) -> [f64; 3] {
    let cut = [1.0 - x - y - z, x, y, z].map(|coordinate: f64| coordinate.max(0.0));
    let sum: f64 = cut.iter().sum();
    [cut[1] / sum, cut[2] / sum, cut[3] / sum]
}
