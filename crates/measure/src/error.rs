/// Reason why a measurement fails.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A number of a stimulus makes no sense.
    #[error("{what} is {found}; give a number above zero")]
    Stimulus {
        /// Which one.
        what: &'static str,
        /// What it is.
        found: f64,
    },
    /// A stimulus goes deeper than allowed.
    #[error(
        "the stimulus goes {depth_mm:.1} mm deep, beyond the limit of {limit_mm:.1} mm; press less deep, or raise the limit"
    )]
    TooDeep {
        /// How deep it goes [mm].
        depth_mm: f64,
        /// How deep it may go [mm].
        limit_mm: f64,
    },
    /// A stimulus is faster than allowed.
    #[error(
        "the stimulus moves at up to {speed_mm_s:.0} mm/s, beyond the limit of {limit_mm_s:.0} mm/s; take a longer ramp, or swing less far or less often"
    )]
    TooFast {
        /// How fast it moves [mm/s].
        speed_mm_s: f64,
        /// How fast it may move [mm/s].
        limit_mm_s: f64,
    },
    /// A breath cannot be held so long.
    #[error(
        "the stimulus takes {duration:.1} s, and a breath is held for {breath:.1} s; hold for less time, or raise the budget"
    )]
    BreathHoldTooShort {
        /// How long it takes with the way to the tissue [s].
        duration: f64,
        /// How long a breath is held [s].
        breath: f64,
    },
    /// The course takes too long.
    #[error(
        "the stimulus takes {duration:.3e} s, and at most {longest} s are recorded; hold for less time"
    )]
    TooLong {
        /// How long it takes with the way to the tissue [s].
        duration: f64,
        /// The longest that is recorded [s].
        longest: f64,
    },
    /// The breath was held for the whole budget.
    #[error(
        "the breath was held for {breath:.1} s, its whole budget, and the indenter was withdrawn; bring it nearer to the tissue, or raise the budget"
    )]
    BreathHoldEnded {
        /// How long a breath is held [s].
        breath: f64,
    },
    /// The rig has not approached the tissue yet.
    #[error("where the tissue begins is not known; approach it first")]
    NotApproached,
    /// The indenter shall go beyond where it may.
    #[error(
        "the indenter would be at {to_mm:.1} mm {direction}, and may be from {least_mm:.1} to {most_mm:.1} mm; move it less far, or raise the limit"
    )]
    OutOfReach {
        /// Along the normal of the surface, or across it.
        direction: &'static str,
        /// Where it would be [mm].
        to_mm: f64,
        /// The least that it may be [mm].
        least_mm: f64,
        /// The most that it may be [mm].
        most_mm: f64,
    },
    /// The indenter shall go sideways through tissue.
    #[error(
        "the indenter is {depth_mm:.1} mm deep in tissue and does not go sideways there; withdraw it first"
    )]
    InTissue {
        /// How deep it is [mm].
        depth_mm: f64,
    },
    /// A direction does not lead out of tissue that lies below.
    #[error(
        "a normal leads out of the tissue and a tip hangs below its device; give a direction whose z is above 0"
    )]
    NotUpward,
    /// The surface is steeper than can be pressed.
    #[error(
        "the surface is {angle_deg:.0} degrees from the direction of the approach, beyond {limit_deg:.0}; turn the specimen, or state its normal"
    )]
    TooSteep {
        /// How steep it is [degrees].
        angle_deg: f64,
        /// How steep it may be [degrees].
        limit_deg: f64,
    },
    /// Nothing is under the indenter.
    #[error("no tissue was met on {way_mm:.0} mm; bring the indenter nearer")]
    NoContact {
        /// How far it went [mm].
        way_mm: f64,
    },
    /// The force became too large.
    #[error(
        "the force reached {force:.2} N, beyond the limit of {limit:.2} N, and the indenter was withdrawn; press less deep, or raise the limit"
    )]
    TooMuchForce {
        /// What the sensor showed [N].
        force: f64,
        /// What it may show [N].
        limit: f64,
    },
    /// The device, or the loop that drives it.
    #[error(transparent)]
    Device(#[from] palpate_servo::Fault),
    /// The force sensor.
    #[error(transparent)]
    Sensor(#[from] palpate_servo::SensorFault),
    /// The tissue of a specimen.
    #[error(transparent)]
    Mechanics(#[from] palpate_mechanics::Error),
}

impl Error {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Device(error) => error.is_input(),
            Self::Sensor(error) => error.is_input(),
            Self::Mechanics(error) => error.is_input(),
            Self::BreathHoldEnded { .. }
            | Self::NotApproached
            | Self::InTissue { .. }
            | Self::NoContact { .. }
            | Self::TooMuchForce { .. } => false,
            Self::Stimulus { .. }
            | Self::TooDeep { .. }
            | Self::TooFast { .. }
            | Self::BreathHoldTooShort { .. }
            | Self::TooLong { .. }
            | Self::OutOfReach { .. }
            | Self::NotUpward
            | Self::TooSteep { .. } => true,
        }
    }
}
