//! The surface response of a linear solid as a table: its displacements under a force on each triangle
//! that a contact may load. Boundary elements, or finite elements condensed to the surface, make it;
//! contacts use both in the same way.
//!
//! With f the forces on touchable triangles, u E = Ξ f. Everything scales with E, which is therefore not
//! part of it; forces instead of tractions make Ξ symmetric for a solid without errors. A contact c with
//! prescribed displacements d has f_c = Ξ_cc⁻¹ d E (4.5) to (4.7): 3 s equations for s triangles, where
//! the source has s.
//!
//! That is for patches whose triangles are known, such as the tissue in a grasper. A tip loads the
//! surface through [`TipField`], which takes its radius into account.
//!
//! *How we know*: `boundary_response::…`: new solutions with a fixed patch; `tip_field::…`: finite
//! elements.
//!
//! *Limits*: small strain; a triangle that its neighbours pull inward is not released.

mod dimple;
mod parts;
mod patch;
mod response;
pub mod slit;
mod tip_field;

pub use dimple::PressedTip;
pub(crate) use parts::zeros;
pub use parts::{ResponseParts, Sampling, TouchableTriangle};
pub use patch::{MovedTriangle, PatchContact, PatchWorkspace, Reciprocity};
pub use response::{SurfaceResponse, TouchId};
pub use tip_field::{Share, TipField, TipLoad};
