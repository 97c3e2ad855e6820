//! A body at large deformation under tools, at haptic rates.
//!
//! Quadratic tetrahedra that resist their mean change of volume most, of a law that is stable under compression (`law`), in
//! quasi-static equilibrium with rigid tools, each of which moves a few nodes through its own compliance
//! ([`Coupling`]). One step per period:
//!
//! 1. continue the last motion as far as the tools continue their paths; in contact the mean of two, with friction none;
//! 2. forces of the elements, rotations of the nodes;
//! 3. one step of Newton's method by a few conjugate gradients, projected onto the conditions of the tools and contacts and
//!    preconditioned by the factors of the stiffness at rest, turned with the nodes, Q K⁻¹ Qᵀ;
//! 4. if the forces along the step have turned against it, back to the zero of their secant.
//!
//! No matrix is assembled in a step: the product of the stiffness with a vector is the change of the elements'
//! forces. All of it runs in single precision, eight elements at a time; displacements are stored in
//! double.
//!
//! Cavities press on their walls (`cavities`); a fluid in one keeps its volume.
//!
//! *How we know*: `nonlinear::…`.
//!
//! *Limits*: quasi-static: no mass. A step does not solve to convergence; its error against it is in
//! `docs/theory/large_deformation.md`.

mod boundary;
mod cavities;
mod complementarity;
mod constraints;
mod contact;
mod coupling;
mod drag;
mod elements;
mod embedded;
mod friction;
mod gravity;
mod kernel;
mod lanes;
mod law;
mod model;
mod predictor;
mod relaxation;
mod rest;
mod rotation;
mod settling;
mod state;
mod state_transfer;
mod step;
#[cfg(test)]
mod tests;
mod touching;
mod touching_search;

pub use boundary::{Boundary, SpreadLoad};
pub use cavities::BodyCavity;
pub use constraints::Conditions;
pub use contact::{Against, BoundaryPoint, MAX_CONTACTS, TOOL_POINTS, UnilateralContact};
pub use coupling::Coupling;
pub use embedded::EmbeddedPoints;
pub use law::Moduli;
pub use model::{MAX_INFLUENCE_BYTES, NonlinearModel};
pub use state::NonlinearState;
pub use state_transfer::StateTransfer;
pub use step::{Advance, StepSettings, Workspace, advance};
pub use touching::TouchingBoundary;
pub use touching_search::{TouchingPoint, TouchingSearch};
