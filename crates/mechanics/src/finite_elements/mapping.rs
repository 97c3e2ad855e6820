//! An element in its place at rest: gradients and weights at the points of integration, made once.

use nalgebra::Matrix3;

use super::mesh::ElementMesh;
use crate::{Error, Vec3};

/// Data for integration over a mesh.
#[derive(Debug)]
pub(crate) struct Mapping {
    /// Points of integration per element.
    pub(crate) points: usize,
    /// The points in the elements' own coordinates.
    pub(crate) at: Vec<[f64; 3]>,
    /// Undeformed volume of each point [m³], in an axisymmetric body of the whole ring.
    pub(crate) weights: Vec<f64>,
    /// ∂N/∂X [1/m]; points × nodes × dimension.
    pub(crate) gradients: Vec<f64>,
    /// N/R [1/m], in an axisymmetric body; points × nodes.
    pub(crate) hoop_terms: Vec<f64>,
    /// Pressure functions [-]; points × pressures of an element.
    pub(crate) pressures: Vec<f64>,
    /// Pressures of an element: 0 without a pressure field.
    pub(crate) pressures_per_element: usize,
}

impl Mapping {
    pub(crate) fn new(mesh: &ElementMesh, with_pressure: bool) -> Result<Self, Error> {
        let (kind, rule) = (mesh.kind, mesh.kind.quadrature());
        let (nodes, dimension) = (kind.nodes(), kind.dimension());
        let pressures_per_element = if with_pressure {
            kind.corners().len()
        } else {
            0
        };
        let all = mesh.len() * rule.len();
        let mut mapping = Self {
            points: rule.len(),
            at: rule.iter().map(|point| point.at).collect(),
            weights: Vec::with_capacity(all),
            gradients: Vec::with_capacity(all * nodes * dimension),
            hoop_terms: Vec::new(),
            pressures: Vec::with_capacity(all * pressures_per_element),
            pressures_per_element,
        };
        let mut shape = vec![0.0; nodes];
        let mut slopes = vec![[0.0; 3]; nodes];
        let mut corner = vec![0.0; pressures_per_element];
        for element in 0..mesh.len() {
            let places: Vec<Vec3> = mesh
                .element(element)
                .iter()
                .map(|&n| mesh.nodes[n as usize])
                .collect();
            for point in &rule {
                kind.shape(point.at, &mut shape);
                kind.shape_gradients(point.at, &mut slopes);
                let mut jacobian = Matrix3::zeros();
                let mut at = Vec3::zeros();
                for ((place, slope), value) in places.iter().zip(&slopes).zip(&shape) {
                    jacobian += place * Vec3::from(*slope).transpose();
                    at += *value * place;
                }
                if dimension == 2 {
                    jacobian[(2, 2)] = 1.0;
                }
                let determinant = jacobian.determinant();
                let inverse = jacobian.try_inverse();
                let ring = if dimension == 2 { at.x } else { 1.0 };
                let Some(inverse) = inverse.filter(|_| determinant > 0.0 && ring > 0.0) else {
                    return Err(Error::InvertedElement { element });
                };
                let around = if dimension == 2 {
                    std::f64::consts::TAU * at.x
                } else {
                    1.0
                };
                mapping.weights.push(point.weight * determinant * around);
                for slope in &slopes {
                    let gradient = inverse.transpose() * Vec3::from(*slope);
                    mapping.gradients.extend(gradient.iter().take(dimension));
                }
                if dimension == 2 {
                    mapping.hoop_terms.extend(shape.iter().map(|n| n / at.x));
                }
                if with_pressure {
                    kind.corner_shape(point.at, &mut corner);
                    mapping.pressures.extend(&corner);
                }
            }
        }
        Ok(mapping)
    }
}
