//! A body that hangs under its own weight.

use super::constraints::Conditions;
use super::model::NonlinearModel;
use super::state::NonlinearState;
use super::step::{Pace, advance};
use crate::finite_elements::{ElementMesh, Mismatch};
use crate::{Error, Vec3};

/// Parts of a quadratic tetrahedron's weight on its nodes [-]: at a corner, between two.
const AT_CORNER: f64 = -0.05;
const BETWEEN: f64 = 0.2;

/// The weight comes in so many parts, each in so many steps; then so many steps more at most, until a step moves no node by
/// more than a part of the body's size [-].
const PARTS: usize = 20;
const STEPS: usize = 2;
const MOST_STEPS: usize = 200;
const SETTLED: f64 = 1e-7;

/// Long enough for every tissue to have relaxed [s].
const LONG: f64 = 1e12;

impl NonlinearModel {
    /// The same body under its weight: each element with its density [kg/m³], under `gravity` [m/s²]. It is at rest where it
    /// has hung for long, whatever its tissues relax by.
    ///
    /// # Errors
    /// When there is not one density for each element, or the body does not come to rest.
    pub fn under_gravity(mut self, densities: &[f64], gravity: &Vec3) -> Result<Self, Error> {
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
        let mut state = NonlinearState::at_rest(&self, 0);
        let mut workspace = self.workspace(0);
        let pace = Pace {
            iterations: 40,
            elapsed: LONG,
        };
        let size = self
            .nodes()
            .iter()
            .map(|node| (node - self.nodes()[0]).norm());
        let farthest = SETTLED * size.fold(0.0, f64::max);
        let mut last = Vec::new();
        for step in 1..=PARTS * STEPS + MOST_STEPS {
            let part = (step.div_ceil(STEPS) as f32 / PARTS as f32).min(1.0);
            self.weight = weight.iter().map(|force| part * force).collect();
            last.clone_from(&state.displacements);
            let ended = advance(
                &self,
                Conditions::of_tools(&[]),
                pace,
                &mut state,
                &mut workspace,
            );
            let moved = last.iter().zip(&state.displacements);
            let moved = moved.fold(0.0_f64, |most, (from, to)| most.max((to - from).abs()));
            if ended.was_reset {
                break;
            }
            if step > PARTS * STEPS && moved < farthest {
                state.stop();
                self.settled = Some(Box::new(state));
                return Ok(self);
            }
        }
        Err(Error::UnsoundResponse {
            fault: "it does not come to rest under its own weight",
        })
    }
}
