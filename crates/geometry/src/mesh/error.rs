/// What is wrong with a mesh that was asked for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// There is nothing to work on.
    #[error("the mesh has no triangles; give a file that holds a triangulated surface")]
    Empty,
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not a finite number; export the mesh again")]
    NotFinite {
        /// Number of the vertex, from zero.
        vertex: usize,
    },
    /// A triangle names a vertex that is not there.
    #[error(
        "triangle {triangle} names vertex {vertex}, but there are {vertices}; the file is damaged, export it again"
    )]
    IndexOutOfRange {
        /// Number of the triangle, from zero.
        triangle: usize,
        /// The vertex that it names.
        vertex: usize,
        /// How many vertices there are.
        vertices: usize,
    },
}
