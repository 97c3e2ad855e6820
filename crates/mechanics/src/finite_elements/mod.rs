//! Finite elements: the reference for the other methods.
//!
//! An [`ElementMesh`] and a law make a [`FiniteElementModel`]; [`Supports`] fix and load it; and
//! [`equilibrate`] finds the [`FiniteElementState`] without a residual.

mod assembly;
mod cavity;
pub mod condensed;
mod continuation;
#[cfg(test)]
mod derivatives;
mod element;
mod equilibrium;
pub mod estimate;
mod friction;
mod graded;
pub mod hemisphere;
pub mod homogeneous;
pub mod indentation;
mod line_search;
mod linear_system;
mod mapping;
mod mesh;
mod mismatch;
mod model;
mod newton;
mod path;
mod pressed_faces;
mod punched;
mod relaxation;
pub mod rigid_tool;
mod sensitivity;
mod snap;
pub mod solid;
mod supports;
mod surface;
pub mod tube;
pub mod uniaxial;

pub use cavity::Cavity;
pub(crate) use cavity::TRIANGLE_PAIRS;
pub use element::ElementKind;
pub use equilibrium::equilibrate;
pub use linear_system::LinearSystem;
pub use mesh::ElementMesh;
pub use mismatch::Mismatch;
pub use model::{FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation};
pub use newton::{Equilibrium, Failure};
pub use path::{Path, PathPoint};
pub use punched::{PunchedLines, PunchedMesh};
pub use relaxation::{RelaxationHistory, RelaxationStep};
pub use supports::{RigidSurface, Sliding, Supports};
