/// What a model cannot be made of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// Young's modulus is not a positive number.
    #[error("Young's modulus is {youngs_modulus} Pa; give a positive number")]
    YoungsModulusOutOfRange {
        /// The value given [Pa].
        youngs_modulus: f64,
    },
    /// Poisson's ratio is that of no solid, or of an incompressible one.
    #[error(
        "Poisson's ratio is {poissons_ratio}; give one above -1 and below 0.5 (0.49 is nearly incompressible)"
    )]
    PoissonsRatioOutOfRange {
        /// The value given [-].
        poissons_ratio: f64,
    },
    /// The relaxation function is none.
    #[error(
        "the Prony series has {terms} terms that sum to {sum}; give at most 8 with g >= 0 and tau > 0 whose g sum to less than 1"
    )]
    NoRelaxation {
        /// Sum of g [-].
        sum: f64,
        /// Number of terms.
        terms: usize,
    },
    /// Too few particles to fill two shells, or more than a step could ever solve.
    #[error("{particles} particles; give between 12 and 600 (34 is the source's number)")]
    ParticlesOutOfRange {
        /// The number given.
        particles: usize,
    },
    /// The particles do not determine the displacement.
    #[error(
        "{particles} particles in the {form} form do not determine the displacement at Poisson's ratio {poissons_ratio}; use the weak form or more particles"
    )]
    Undetermined {
        /// The number given.
        particles: usize,
        /// Weak or strong.
        form: &'static str,
        /// Poisson's ratio [-].
        poissons_ratio: f64,
    },
}
