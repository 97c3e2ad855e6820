//! The local model: the point-collocation method of finite spheres around the tool tip (chapter 3).
//!
//! A handful of particles is placed around the contact, in shells of the radii h, 2h … The outermost
//! shell is fixed (section 3.3); the particle at the contact carries the tool. Displacement is
//! interpolated by moving least squares, u(x) = Σ φ_J(x) U_J (3-8) to (3-10), and found either by
//! collocation of the field equations (the source's strong form, (3-5) to (3-7)) or by Galerkin's
//! condition on the same functions (weak form, the default), with φ_J(x_I) in the rows of the fixed
//! and the tool's particles: the U_J are not displacements.
//!
//! With [`Calibration::None`] nothing is fitted (`uncalibrated`). By default three corrections give the force, all in `exterior`: the radius a of the tool,
//! with h = a/α; the compliance beyond the shells; and the finite size of the organ, which is fixed somewhere.
//!
//! *How we know*: `agreement::hemisphere_meets_its_closed_form`, `agreement::flat_contact_is_the_half_space`,
//! `convergence::finer_integration_changes_the_force_less`, `invariants::stiffness_is_symmetric_and_positive`.
//!
//! *Limits*: small strain; one contact at a time; thin walls and distant anchors have no effect on
//! the force (use the hybrid model for those).

mod exterior;
mod field;
mod layout;
mod model;
mod quadrature;
mod reuse;
mod settings;
mod shape_function;
mod solution;
mod source_placement;
mod strong_form;
mod uncalibrated;
mod weak_form;
mod weight;
mod workspace;

pub use exterior::{EXTERIOR_CONSTANTS, ExteriorConstants, LARGEST_CALIBRATED_RATIO};
pub use layout::SOURCE_PARTICLES;
pub use model::{FiniteSphereModel, LocalContact, Response, Surroundings};
pub use settings::{
    Assembly, Calibration, FiniteSphereSettings, Form, Integration, Placement, Solver,
};
pub use source_placement::first_direction;
pub use weight::quartic;
pub use workspace::FiniteSphereWorkspace;
