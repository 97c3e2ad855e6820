//! A body under its own weight.

use super::model::NonlinearModel;
use crate::finite_elements::{ElementMesh, Mismatch};
use crate::{Error, Vec3};

/// Parts of a quadratic tetrahedron's weight on its nodes [-]: at a corner, between two.
const AT_CORNER: f64 = -0.05;
const BETWEEN: f64 = 0.2;

impl NonlinearModel {
    /// The same body under its weight and the pressures in its cavities ([`Self::under_pressure`]): each element with its density
    /// [kg/m³], under `gravity` [m/s²]. It is at rest after these have acted for long, with its tissues relaxed.
    ///
    /// # Errors
    /// When there is not one density for each element, or the body does not come to rest.
    pub fn under_gravity(self, densities: &[f64], gravity: &Vec3) -> Result<Self, Error> {
        let count = self.mesh().tetrahedra().len();
        if densities.len() != count {
            return Err(Mismatch::WrongLength {
                what: "the list of the elements' densities",
                found: densities.len(),
                expected: count,
            }
            .into());
        }
        let mesh = self.mesh();
        let elements = ElementMesh::from_tetrahedra(mesh).elements;
        let mut weight = vec![0.0_f32; 3 * self.nodes().len()];
        for (element, density) in densities.iter().enumerate() {
            if self.drag.piece(elements[10 * element]) > 0 {
                continue;
            }
            let [a, b, c, d] = mesh.positions(element);
            let volume = (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
            for (k, node) in elements[10 * element..][..10].iter().enumerate() {
                let part = if k < 4 { AT_CORNER } else { BETWEEN };
                for axis in 0..3 {
                    weight[3 * *node as usize + axis] +=
                        (part * density * volume * gravity[axis]) as f32;
                }
            }
        }
        self.settle(weight)
    }
}
