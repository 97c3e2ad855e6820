//! Local enhancement (section 4.3): the displayed surface near a tip when displacements are known per
//! triangle of a coarse mesh.
//!
//! The triangles around the contact are replaced by finer ones on curved patches (`pn_triangle`, `patch`),
//! and displacements û at the centroids become a field, u(x) = Σ Φ_i(x) û_i (4.9), (4.10). Φ is linear
//! between means over the triangles at each vertex, or Shepard's functions (4.12) [Shepard 1968], or moving
//! least squares (4.11) in two tangent coordinates, with the quartic weight (4.13).
//!
//! Φ alone would shrink the dimple, which is narrower than a coarse triangle. So it spreads only the residual of the closed form p of the half-space under each tip: u = Σ
//! A_k p_k(x) + Σ Φ_i(x) (û_i − Σ s_k p_k(x_i)), with s_k the half-space part of the tip's displacement and A_k such that u is the displacement at
//! contact k. The same rows carry the field to a finer mesh of the whole organ, whose own triangles are then made finer around a contact.
//!
//! *How we know*: `enhance::every_patch_is_watertight`, `enhance::patches_converge_to_the_sphere`,
//! `carried_field::moving_least_squares_carry_a_linear_field`, `carried_field::a_thin_wall_does_not_leak`,
//! `carried_field::the_dimple_is_as_deep_as_the_tip`.
//!
//! *Limits*: geometry only, no mechanics: between the centroids the field is smooth, not right. A surface
//! that follows a coarse mesh changes its triangles when the contact changes its own, by the height of the
//! patches over their triangles; a fine mesh that is carried does not.

mod carrier;
mod corner_normals;
mod field;
mod functions;
mod interpolation;
mod model;
mod neighborhood;
mod patch;
mod pn_triangle;
mod press;
mod weights;

pub use carrier::EmbeddedDisplayPoints;
pub use field::SurfaceField;
pub use functions::{moving_least_squares, shepard};
pub use interpolation::{Interpolation, SurfacePoint};
pub use model::{EnhancementModel, MAX_LEVELS};
pub use neighborhood::Neighborhood;
pub use patch::EnhancedPatch;
pub use press::{Press, profile};
pub use weights::Weights;
