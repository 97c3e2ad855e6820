//! The surface of a linear solid as a table: how it moves under a force on each triangle that a contact
//! may load. Whoever makes it (boundary elements; finite elements condensed to the surface), contacts
//! are computed from it in the same way.
//!
//! With f the forces on touchable triangles, u E = Ξ f. Everything goes with E, which is therefore not
//! part of it; forces instead of tractions make Ξ symmetric for a solid without errors. A contact c with
//! prescribed displacements d has f_c = Ξ_cc⁻¹ d E (4.5) to (4.7): 3 s equations for s triangles, where
//! the source has s.
//!
//! That is for patches whose triangles are known, such as what a grasper holds. A tip loads the surface
//! through [`TipField`], which knows its radius.
//!
//! *How we know*: `boundary_response::…`: new solutions with the patch held; `tip_field::…`: finite
//! elements.
//!
//! *Limits*: small strain; a triangle that is pulled inward by its neighbours is not let go.

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
