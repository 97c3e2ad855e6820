//! Triangle meshes and what can be asked of them without mechanics.
//!
//! A [`TriangleMesh`] is any list of triangles; a [`Surface`] is one that has been checked: closed,
//! manifold, oriented outward, in one piece. Everything that touches an organ asks for a `Surface`.

mod aabb_tree;
mod check;
mod mesh;
mod neighborhood_watch;
mod organ;
mod patch_field;
mod proximity;
mod surface;

pub use aabb_tree::{AabbTree, Hit, Nearest};
pub use mesh::adjacency::Adjacency;
pub use mesh::error::MeshError;
pub use mesh::triangles::{NodeId, TriangleId, TriangleMesh};
pub use neighborhood_watch::{Footing, follow};
pub use organ::{AnchorPlane, Organ, OrganDescription, OrganError};
pub use patch_field::{Patch, PatchField};
pub use proximity::{PointOnTriangle, closest_on_triangle};
pub use surface::Surface;

/// A point or a vector in space [m, unless said otherwise].
pub type Vec3 = nalgebra::Vector3<f64>;
