use super::Organ;
use crate::MeshError;

/// Why a built-in organ could not be made.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OrganError {
    /// No built-in has this name.
    #[error("there is no built-in organ {found:?}; choose one of {}", names())]
    UnknownName {
        /// The name that was given.
        found: String,
    },
    /// The number of triangles is out of range.
    #[error("the {organ} cannot be made of {triangles} triangles; ask for {least} to {most}")]
    TriangleCount {
        /// The requested organ.
        organ: Organ,
        /// The requested number.
        triangles: usize,
        /// The smallest possible number.
        least: usize,
        /// The largest possible number.
        most: usize,
    },
    /// The mesh was refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl OrganError {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Mesh(error) => error.is_input(),
            Self::UnknownName { .. } | Self::TriangleCount { .. } => true,
        }
    }
}

fn names() -> String {
    Organ::ALL.map(Organ::name).join(", ")
}
