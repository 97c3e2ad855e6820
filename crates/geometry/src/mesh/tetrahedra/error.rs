/// Errors in the construction of tetrahedra.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TetrahedronError {
    /// There is nothing to work on.
    #[error("the mesh has no tetrahedra; give one that fills a volume")]
    Empty,
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not a finite number; make the mesh again")]
    NotFinite {
        /// Number of the vertex, from zero, among those that are used.
        vertex: usize,
    },
    /// A tetrahedron names a vertex that is not there.
    #[error(
        "tetrahedron {tetrahedron} names vertex {vertex}, but there are {vertices}; make the mesh again"
    )]
    IndexOutOfRange {
        /// Number of the tetrahedron, from zero.
        tetrahedron: usize,
        /// The vertex that it names.
        vertex: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A tetrahedron is inside out.
    #[error(
        "tetrahedron {tetrahedron} is inverted: its volume is {volume_m3:e} m³; swap two of its corners, or mesh the volume again"
    )]
    Inverted {
        /// Number of the tetrahedron, from zero.
        tetrahedron: usize,
        /// Its signed volume [m³].
        volume_m3: f64,
    },
    /// A tetrahedron has no volume.
    #[error("tetrahedron {tetrahedron} has no volume; remove it, or mesh the volume again")]
    Flat {
        /// Number of the tetrahedron, from zero.
        tetrahedron: usize,
    },
    /// More than two tetrahedra meet in a face.
    #[error(
        "the face {corners:?} belongs to {tetrahedra} tetrahedra where at most two can meet; remove the doubled ones"
    )]
    NonManifoldFace {
        /// The vertices of the face.
        corners: [usize; 3],
        /// How many tetrahedra have it.
        tetrahedra: usize,
    },
    /// There is not one region for each tetrahedron.
    #[error(
        "there are regions for {found} tetrahedra, but {tetrahedra} tetrahedra; give one for each"
    )]
    WrongRegions {
        /// How many regions were given.
        found: usize,
        /// How many tetrahedra there are.
        tetrahedra: usize,
    },
    /// A region that was to be taken out is no hole in the others.
    #[error(
        "region {region} is not enclosed by others: it reaches the boundary, or another region that is taken out"
    )]
    NotEnclosed {
        /// The region.
        region: u32,
    },
    /// A length that is none.
    #[error("{what} is {found:e} m where a positive length was expected; give one in metres")]
    NotALength {
        /// Whose length.
        what: &'static str,
        /// The number given [m].
        found: f64,
    },
    /// More elements than allowed.
    #[error(
        "about {expected:.3e} tetrahedra would come of an edge of {edge_m:e} m, at most {most} are allowed; give a longer edge"
    )]
    TooMany {
        /// How many would come, or were there when it was given up [-].
        expected: f64,
        /// The edge that was asked for [m].
        edge_m: f64,
        /// How many are allowed.
        most: usize,
    },
    /// Bisection ended before its edges were short enough.
    #[error(
        "after {rounds} rounds of bisection an edge is still {edge_m:e} m long, longer than was asked for there; ask for a longer edge"
    )]
    NotRefined {
        /// How often tetrahedra were bisected.
        rounds: usize,
        /// The longest edge of those that were still to be bisected [m].
        edge_m: f64,
    },
    /// The caller cancelled the work.
    #[error("cancelled before the tetrahedra were done")]
    Cancelled,
    /// The lattice is too coarse for the body.
    #[error(
        "an edge of {edge_m:e} m is too coarse: {lost_percent:.1} % of the volume is lost; give one of at most a third of the thinnest part"
    )]
    TooCoarse {
        /// The edge that was asked for [m].
        edge_m: f64,
        /// Part of the volume that no tetrahedron in one piece fills [%].
        lost_percent: f64,
    },
}

impl TetrahedronError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Empty
            | Self::NotFinite { .. }
            | Self::IndexOutOfRange { .. }
            | Self::Inverted { .. }
            | Self::Flat { .. }
            | Self::NonManifoldFace { .. }
            | Self::WrongRegions { .. }
            | Self::NotEnclosed { .. }
            | Self::NotALength { .. }
            | Self::TooMany { .. }
            | Self::NotRefined { .. }
            | Self::TooCoarse { .. } => true,
            Self::Cancelled => false,
        }
    }
}
