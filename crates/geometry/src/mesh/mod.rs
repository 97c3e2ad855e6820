pub(crate) mod adjacency;
pub(crate) mod edges;
pub(crate) mod error;
pub(crate) mod tetrahedra;
pub(crate) mod triangles;
