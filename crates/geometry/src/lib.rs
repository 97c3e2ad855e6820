//! Triangle meshes and what can be asked of them without mechanics.
//!
//! A [`TriangleMesh`] is any list of triangles; a [`Surface`] is one that has been checked: closed,
//! manifold, oriented outward, in one piece. Everything that touches an organ asks for a `Surface`.

mod mesh;

pub use mesh::adjacency::Adjacency;
pub use mesh::error::MeshError;
pub use mesh::triangles::{NodeId, TriangleId, TriangleMesh};

/// A point or a vector in space [m, unless said otherwise].
pub type Vec3 = nalgebra::Vector3<f64>;
