//! A pressure on a part of a solid's boundary, such as an insufflated abdomen's on an organ. It stays normal to the faces
//! and in proportion to their area as they move: with a = x_ξ × x_η its force on node n is p ∫ N_n a dξ dη.
//!
//! Around a part that ends in the middle of a free side this force has no potential, so its tangent is not symmetric. The
//! symmetric part alone is used: the other one lives on the edge of the part, and costs iterations, not accuracy. A body
//! of small strain is loaded in its shape at rest.
//!
//! *How we know*: `pressed_faces::…`.

use nalgebra::{SMatrix, SVector};

use super::cavity::{SidePoint, TRIANGLE, is_small, moved, triangle_point};
use super::mismatch::Mismatch;
use super::model::FiniteElementModel;
use crate::Vec3;

/// Faces of a solid of quadratic tetrahedra that a pressure acts on.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct PressedFaces {
    faces: Vec<PressedFace>,
}

#[derive(Debug, Clone, PartialEq)]
struct PressedFace {
    /// As those of a side of [`super::Cavity`].
    nodes: [u32; 6],
    /// Of the points of integration [-]: of the whole face, or of its part that is pressed.
    weights: [f64; 6],
}

impl PressedFaces {
    /// Adds a face with these `nodes`, numbered as those of a side of [`super::Cavity`], and of this `area` at rest [m²].
    /// The `integrals` of its nodes' shape functions [m²] over the part that is pressed say which part that is.
    pub(super) fn add(&mut self, nodes: [u32; 6], integrals: [f64; 6], area: f64) {
        let points = TRIANGLE.map(triangle_point);
        // Six points integrate the six functions exactly, with one set of weights.
        let values = SMatrix::<f64, 6, 6>::from_fn(|node, point| points[point].value[node]);
        let wanted = SVector::from(integrals) / (2.0 * area);
        let weights = values.lu().solve(&wanted);
        let weights = weights.expect("no quadratic function is zero at all six points");
        self.faces.push(PressedFace {
            nodes,
            weights: weights.into(),
        });
    }

    /// The nodes are some of the model, whose elements have such faces.
    pub(super) fn check(&self, model: &FiniteElementModel) -> Result<(), Mismatch> {
        let nodes = model.mesh.nodes.len();
        let mut all = self.faces.iter().flat_map(|face| face.nodes);
        match all.find(|node| *node as usize >= nodes) {
            Some(node) => Err(Mismatch::NodeBeyondMesh {
                what: "a pressed face",
                node: node as usize,
                nodes,
            }),
            None => Ok(()),
        }
    }

    /// Adds the forces of a pressure of this `size` [Pa] to `out`.
    pub(super) fn add_force(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        size: f64,
        out: &mut [f64],
    ) {
        let rest = is_small(model).then(|| vec![0.0; unknowns.len()]);
        let unknowns = rest.as_deref().unwrap_or(unknowns);
        for face in &self.faces {
            for (point, [e, h]) in face.points(model, unknowns) {
                let area = point.weight * size * e.cross(&h);
                for (node, share) in face.nodes.iter().zip(point.value) {
                    for axis in 0..3 {
                        out[3 * *node as usize + axis] += share * area[axis];
                    }
                }
            }
        }
    }

    /// Adds the symmetric part of the derivative of these forces to the lower triangle `values`.
    pub(super) fn add_tangent(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        size: f64,
        values: &mut [f64],
    ) {
        if is_small(model) {
            return;
        }
        for face in &self.faces {
            for (point, [e, h]) in face.points(model, unknowns) {
                // The force on a node turns as N_a (x_ξ × x_η) does when a node moves by d: N_a (c_b × d).
                let turns: [Vec3; 6] =
                    std::array::from_fn(|b| point.across[b] * e - point.along[b] * h);
                for (a, b) in (0..6).flat_map(|a| (0..6).map(move |b| (a, b))) {
                    let both = point.value[a] * turns[b] - point.value[b] * turns[a];
                    let block = (0.5 * point.weight * size * both).cross_matrix();
                    for (i, k) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
                        let row = 3 * face.nodes[a] as usize + i;
                        let column = 3 * face.nodes[b] as usize + k;
                        if row >= column {
                            values[model.pattern.index(row, column)] += block[(i, k)];
                        }
                    }
                }
            }
        }
    }
}

impl PressedFace {
    /// Its points of integration, with x_ξ and x_η [m] there.
    fn points(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
    ) -> impl Iterator<Item = (SidePoint<6>, [Vec3; 2])> {
        let places = moved(model, unknowns, &self.nodes);
        let weights = self.weights;
        let points = TRIANGLE.into_iter().zip(weights);
        points.map(move |((at, _), weight)| {
            let point = triangle_point((at, weight));
            let sum = |f: &[f64; 6]| f.iter().zip(&places).map(|(f, x)| *f * x).sum::<Vec3>();
            let axes = [sum(&point.along), sum(&point.across)];
            (point, axes)
        })
    }
}
