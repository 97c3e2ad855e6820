use crate::Vec3;

/// Why a blade does not cut.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CutError {
    /// A coordinate of the blade is NaN or infinite.
    #[error("the blade is at {at:?}, which is no place; give finite coordinates in metres")]
    NotFinite {
        /// The position given [m].
        at: [f64; 3],
    },
    /// The blade was to begin where there is no surface.
    #[error(
        "the blade is {distance_m:e} m from the surface, more than a triangle's edge of {edge_m:e} m; begin a cut where the blade touches"
    )]
    OffSurface {
        /// From the blade to the nearest triangle that was found [m].
        distance_m: f64,
        /// The longest edge of that triangle [m].
        edge_m: f64,
    },
    /// A triangle was named that the mesh does not have.
    #[error("there is no triangle {triangle} among {triangles}; name one of the cut mesh")]
    NoSuchTriangle {
        /// The number that was given.
        triangle: usize,
        /// How many triangles there are.
        triangles: usize,
    },
    /// A blade was moved or lifted that does not cut.
    #[error("no cut is under way; begin one before the blade moves on")]
    NotBegun,
    /// A cut was begun or undone while another was in progress.
    #[error("a cut is under way; end it first")]
    UnderWay,
}

impl CutError {
    /// The error that `at` [m] deserves, if any.
    pub(super) fn of_place(at: &Vec3) -> Result<(), Self> {
        if at.iter().all(|c| c.is_finite()) {
            return Ok(());
        }
        Err(Self::NotFinite {
            at: [at.x, at.y, at.z],
        })
    }
}
