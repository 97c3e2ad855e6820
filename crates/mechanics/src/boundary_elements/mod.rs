//! Boundary elements: linear elasticity with unknowns on the surface alone.
//!
//! Somigliana's identity at the centroid of each flat triangle, with displacement u and traction t constant
//! on it (4.1) to (4.5):
//!
//! ```text
//! ½ uᵢ + Σⱼ Tᵢⱼ uⱼ = Σⱼ Uᵢⱼ tⱼ,   Tᵢⱼ = ∫ⱼ p* dA,   Uᵢⱼ = ∫ⱼ u* dA
//! ```
//!
//! with Kelvin's displacement u* and traction p* ([`Kelvin`]), which the source misprints
//! (`docs/errata.md`). All integrals are closed forms. With the unknowns, displacements of free triangles
//! and tractions of fixed ones, in x and a unit force on each triangle that can be touched in turn,
//!
//! ```text
//! A₀ x = U f/A,   A₀ = [½ 1 + T of free triangles, −U of fixed ones]
//! ```
//!
//! after a correction by which rotations of the whole solid need no traction (`rotations`), is factored once
//! ([`BoundaryProblem`]) and gives a [`SurfaceResponse`](crate::surface_response), on
//! which contacts are computed. A₀ is stored in single precision (its condition is some tens) and
//! is overwritten by its factors; U is computed as it is needed; no inverse is formed.
//!
//! *How we know*: `boundary_elements::…`: quadrature of the kernels, rigid motions, Kelvin's and Lamé's
//! solutions, the linear patch test with its order; `boundary_response::…`: new solutions with a fixed
//! contact, double precision.
//!
//! *Limits*: constant elements err with the first power of their size; one solid, linear and homogeneous;
//! walls thinner than a triangle is wide.

mod assembly;
mod factors;
mod integrals;
mod kelvin;
mod panel;
mod precision;
mod problem;
mod rotations;

pub use assembly::{InfluenceMatrices, Influences};
pub(crate) use integrals::Source;
pub use integrals::{PanelIntegrals, Place, integrate};
pub use kelvin::Kelvin;
pub use panel::Panel;
pub use precision::Precision;
pub(crate) use problem::fixed_triangles;
pub use problem::{BoundaryProblem, Progress, ResponseMemory, Stage};
