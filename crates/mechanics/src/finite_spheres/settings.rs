pub use palpate_files::scene::{Assembly, Form, Placement};

/// Settings of the local model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FiniteSphereSettings {
    /// Number of particles, 12 to 600.
    pub particles: usize,
    /// How the equations are made.
    pub form: Form,
    /// Placement of the particles.
    pub placement: Placement,
    /// How the equations are solved.
    pub solver: Solver,
    /// How often they are made.
    pub assembly: Assembly,
    /// How finely they are integrated.
    pub integration: Integration,
    /// How their solution gives a force.
    pub calibration: Calibration,
}

/// How the particles' solution gives a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Calibration {
    /// Spacing and exterior are fitted, so that a half-space and hemispheres have their known force.
    Fitted,
    /// Nothing is fitted; each sphere carries the field of a punch in addition to its polynomials.
    None,
    /// Nothing is fitted, and spheres carry polynomials alone: what the particles do by themselves.
    ParticlesAlone,
}

/// How the equations are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solver {
    /// By factors.
    Direct,
    /// By generalised minimal residuals to this relative residual [-], as in the source.
    Gmres {
        /// Relative residual to reach [-].
        tolerance: f64,
    },
}

/// How many integration points a model of two shells has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integration {
    /// 128.
    Coarse,
    /// 414.
    Standard,
    /// 960.
    Fine,
}

impl Default for FiniteSphereSettings {
    fn default() -> Self {
        Self {
            particles: super::SOURCE_PARTICLES,
            form: Form::Weak,
            placement: Placement::Template,
            solver: Solver::Direct,
            assembly: Assembly::EveryStep,
            integration: Integration::Standard,
            calibration: Calibration::Fitted,
        }
    }
}
