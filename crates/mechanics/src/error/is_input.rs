use super::Error;

impl Error {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Tetrahedra(error) => error.is_input(),
            Self::Mismatch(error) => error.is_input(),
            Self::NoMemoryForFactors { .. }
            | Self::NoEquilibrium { .. }
            | Self::NoPath { .. }
            | Self::NoSolid { .. }
            | Self::NoMemory { .. }
            | Self::NotEnoughMemory { .. }
            | Self::Cancelled
            | Self::NotInEquilibrium { .. } => false,
            Self::YoungsModulusOutOfRange { .. }
            | Self::PoissonsRatioOutOfRange { .. }
            | Self::NeoHookeanOutOfRange { .. }
            | Self::MooneyRivlinOutOfRange { .. }
            | Self::ExponentialOutOfRange { .. }
            | Self::OgdenOutOfRange { .. }
            | Self::ReducedPolynomialOutOfRange { .. }
            | Self::BulkModulusOutOfRange { .. }
            | Self::NoRelaxation { .. }
            | Self::TooManyLevels { .. }
            | Self::ParticlesOutOfRange { .. }
            | Self::Undetermined { .. }
            | Self::NotWithoutCalibration { .. }
            | Self::NodeOutOfRange { .. }
            | Self::NoElements
            | Self::InvertedElement { .. }
            | Self::Locking { .. }
            | Self::TubeOutOfRange { .. }
            | Self::PressureOutOfRange { .. }
            | Self::LimitPointExceeded { .. }
            | Self::BlockTooSmall { .. }
            | Self::TissueEntersPunch { .. }
            | Self::SurfaceFolds { .. }
            | Self::ImpossibleDepth { .. }
            | Self::TimesDoNotAscend
            | Self::NotALength { .. }
            | Self::DepthIsNoNumber { .. }
            | Self::PatchReachesBase { .. }
            | Self::StretchOutOfRange { .. }
            | Self::NothingFixed
            | Self::UnfixedPiece { .. }
            | Self::PatchOffSurface { .. }
            | Self::PatchCoversBody { .. }
            | Self::EmptyPatch { .. }
            | Self::PatchIsFixed { .. }
            | Self::DisplacementBeyondBody { .. }
            | Self::TooManyUnknowns { .. }
            | Self::PunchOutOfRange { .. }
            | Self::TubeDepthOutOfRange { .. }
            | Self::GuidedEnds
            | Self::TouchableIsFixed { .. }
            | Self::SliverTriangle { .. }
            | Self::InvalidResponse { .. }
            | Self::SlitTooLarge { .. }
            | Self::TriangleOutOfRange { .. }
            | Self::TouchableNotAscending { .. }
            | Self::NothingTouchable
            | Self::OtherSurface { .. }
            | Self::InvalidSlit { .. }
            | Self::Region(_)
            | Self::Fibres(_)
            | Self::Solid(_) => true,
        }
    }
}
