/// Errors in the construction of a mesh.
#[non_exhaustive]
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
    /// Triangles without area.
    #[error(
        "{triangles} triangles have no area; weld the vertices, or mesh the surface again with even triangles"
    )]
    DegenerateTriangles {
        /// How many.
        triangles: usize,
    },
    /// Vertices that no triangle uses.
    #[error("{vertices} vertices belong to no triangle; drop them by repairing the mesh")]
    UnusedVertices {
        /// How many.
        vertices: usize,
    },
    /// The surface branches, or touches itself in a vertex.
    #[error(
        "the surface is not manifold: {edges} edges have more than two triangles and {vertices} vertices join separate fans; remove inner walls and doubled triangles, or wrap it (`palpate mesh wrap`, `palpate simulate --wrap`)"
    )]
    NotManifold {
        /// Edges with more than two triangles.
        edges: usize,
        /// Vertices where several fans of triangles touch.
        vertices: usize,
    },
    /// The surface has a border.
    #[error(
        "the surface is not closed: {edges} edges have one triangle only; weld the vertices or fill the holes, or wrap it (`palpate mesh wrap`, `palpate simulate --wrap`)"
    )]
    NotClosed {
        /// Edges with one triangle.
        edges: usize,
    },
    /// Neighbouring triangles turn in opposite senses.
    #[error(
        "the triangles are not oriented alike: {edges} edges have triangles of opposite sense; orient them consistently by repairing the mesh"
    )]
    NotOriented {
        /// Edges whose triangles disagree.
        edges: usize,
    },
    /// The triangles face inward.
    #[error(
        "the surface is inside out: its volume is {volume_m3:e} m³; flip all triangles by repairing the mesh"
    )]
    InsideOut {
        /// Signed volume [m³], not positive.
        volume_m3: f64,
    },
    /// There are several separate surfaces.
    #[error(
        "the mesh has {pieces} separate pieces; keep one of them, join them, or wrap them (`palpate mesh wrap`, `palpate simulate --wrap`)"
    )]
    SeveralPieces {
        /// How many.
        pieces: usize,
    },
}

impl MeshError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Empty
            | Self::NotFinite { .. }
            | Self::IndexOutOfRange { .. }
            | Self::DegenerateTriangles { .. }
            | Self::UnusedVertices { .. }
            | Self::NotManifold { .. }
            | Self::NotClosed { .. }
            | Self::NotOriented { .. }
            | Self::InsideOut { .. }
            | Self::SeveralPieces { .. } => true,
        }
    }
}
