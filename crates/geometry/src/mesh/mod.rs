pub(crate) mod adjacency;
pub(crate) mod error;
pub(crate) mod triangles;
