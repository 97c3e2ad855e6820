//! The physical quantities of the documents.
//!
//! Domains span from instrument resolution to the limits of any body; usual ranges are those of soft tissue, from
//! mucus to cartilage, and of instruments for it, from the tip of an atomic force microscope to a hand.

use std::ops::Bound::{Excluded, Included};

use super::Domain;

impl Domain {
    /// A radius of an indenter or a tip [m].
    pub const TIP_RADIUS: Self =
        Self::quantity("the radius of a tip", "m", [Included(1e-9), Included(0.1)])
            .usually(1e-6, 0.02);

    /// A coordinate [m], which may reach far beyond any organ.
    pub const COORDINATE: Self =
        Self::quantity("a coordinate", "m", [Included(-1e6), Included(1e6)]);

    /// A length of an organ, a specimen, an instrument or a region [m].
    pub const LENGTH: Self =
        Self::quantity("a length", "m", [Included(1e-9), Included(10.0)]).usually(1e-5, 1.0);

    /// How far tissue is pressed [m].
    pub const DEPTH: Self =
        Self::quantity("a depth", "m", [Included(1e-10), Included(1.0)]).usually(1e-8, 0.05);

    /// How far tissue is pressed, or not at all [m].
    pub const DEPTH_OR_NONE: Self =
        Self::quantity("a depth", "m", [Included(0.0), Included(1.0)]).usually(1e-8, 0.05);

    /// A coordinate [m].
    pub const POSITION: Self =
        Self::quantity("a coordinate", "m", [Included(-1e4), Included(1e4)]).usually(-5.0, 5.0);

    /// An area of tissue [m²].
    pub const AREA: Self =
        Self::quantity("an area", "m2", [Included(1e-18), Included(10.0)]).usually(1e-12, 0.1);

    /// A time constant [s].
    pub const TIME_CONSTANT: Self =
        Self::quantity("a time constant", "s", [Included(1e-6), Included(1e7)]).usually(1e-4, 1e5);

    /// A duration [s].
    pub const DURATION: Self =
        Self::quantity("a duration", "s", [Included(1e-6), Included(1e6)]).usually(1e-3, 1e4);

    /// A duration, which may be zero [s].
    pub const DURATION_OR_NONE: Self =
        Self::quantity("a duration", "s", [Included(0.0), Included(1e6)]).usually(1e-3, 1e4);

    /// A time since death [s].
    pub const POST_MORTEM: Self =
        Self::quantity("a time since death", "s", [Included(0.0), Included(1e9)]).usually(1.0, 1e7);

    /// A time in a table, from any beginning [s].
    pub const TIME: Self = Self::quantity("a time", "s", [Included(-1e12), Included(1e12)]);

    /// A period of the model [s].
    pub const STEP: Self =
        Self::quantity("a period", "s", [Included(1e-5), Included(1.0)]).usually(5e-4, 0.05);

    /// A frequency, of a stimulus or of samples [Hz].
    pub const FREQUENCY: Self =
        Self::quantity("a frequency", "hz", [Included(1e-6), Included(1e7)]).usually(1e-3, 1e5);

    /// A speed of an indenter [m/s]. Slower, the path to the tissue takes hours, and every tick of it is stored.
    pub const SPEED: Self =
        Self::quantity("a speed", "m_per_s", [Included(1e-5), Included(1.0)]).usually(1e-4, 0.5);

    /// A force on tissue or on a hand [N].
    pub const FORCE: Self =
        Self::quantity("a force", "n", [Included(1e-9), Included(1e4)]).usually(1e-4, 200.0);

    /// A force on tissue or on a hand, or none [N].
    pub const FORCE_OR_NONE: Self =
        Self::quantity("a force", "n", [Included(0.0), Included(1e4)]).usually(1e-4, 200.0);

    /// A force in a table [N], or that of a stress on a square metre.
    pub const ANY_FORCE: Self = Self::quantity("a force", "n", [Included(-1e9), Included(1e9)]);

    /// The range of a torque sensor [N m].
    pub const TORQUE: Self =
        Self::quantity("a torque", "n_m", [Included(1e-9), Included(1e4)]).usually(1e-4, 100.0);

    /// A torque in a table [N m].
    pub const ANY_TORQUE: Self = Self::quantity("a torque", "n_m", [Included(-1e9), Included(1e9)]);

    /// A modulus of tissue [Pa].
    pub const MODULUS: Self = Self::quantity(
        "a modulus of tissue",
        "pa",
        [Included(1e-3), Included(1e11)],
    )
    .usually(20.0, 2e7);

    /// A parameter of a law that may be below zero [Pa].
    pub const SIGNED_MODULUS: Self = Self::quantity(
        "a modulus of tissue",
        "pa",
        [Included(-1e11), Included(1e11)],
    )
    .usually(-2e7, 2e7);

    /// Usual ratios of the modulus of a base to that of the layer on it, which identify both [-].
    pub const BASE_RATIOS: [f64; 2] = [0.01, 100.0];

    /// The modulus of a base over that of the layer on it [-].
    pub const BASE_RATIO: Self = Self::number(
        "a ratio of moduli",
        [
            Included(Self::BASE_RATIOS[0]),
            Included(Self::BASE_RATIOS[1]),
        ],
    );

    /// A pressure in a hollow organ [Pa].
    pub const PRESSURE: Self =
        Self::quantity("a pressure", "pa", [Included(0.0), Included(1e7)]).usually(1.0, 1e5);

    /// A pressure in a hollow organ, or a suction [Pa].
    pub const PRESSURE_OR_SUCTION: Self =
        Self::quantity("a pressure", "pa", [Included(-1e7), Included(1e7)]).usually(-1e5, 1e5);

    /// A density of tissue, named with either of two units [kg/m³].
    pub const DENSITY: Self = Self::quantity(
        "the density of a tissue",
        "kg_m3",
        [Included(0.01), Included(1e5)],
    )
    .usually(100.0, 3000.0);

    /// A body's weight [kg].
    pub const WEIGHT: Self =
        Self::quantity("a body's weight", "kg", [Included(1e-6), Included(1e5)])
            .usually(1e-3, 1500.0);

    /// How far a cantilever bends for each volt of its optical lever [m/V].
    pub const SENSITIVITY: Self =
        Self::quantity("a sensitivity", "m_per_v", [Included(1e-12), Included(1.0)])
            .usually(1e-9, 1e-5);

    /// A stiffness of a spring [N/m].
    pub const STIFFNESS: Self =
        Self::quantity("a stiffness", "n_per_m", [Included(1e-9), Included(1e9)])
            .usually(1e-4, 1e5);

    /// A stiffness of a spring that may be missing [N/m].
    pub const STIFFNESS_OR_NONE: Self =
        Self::quantity("a stiffness", "n_per_m", [Included(0.0), Included(1e9)]).usually(1e-4, 1e5);

    /// A component of an acceleration [m/s²].
    pub const ACCELERATION: Self = Self::quantity(
        "an acceleration",
        "m_per_s2",
        [Included(-100.0), Included(100.0)],
    );

    /// A coefficient of damping [N s/m].
    pub const DAMPING: Self = Self::quantity(
        "a coefficient of damping",
        "n_s_per_m",
        [Included(1e-9), Included(1e9)],
    )
    .usually(1e-4, 1e7);

    /// The work of a cut per area of its face [J/m²].
    pub const TOUGHNESS: Self = Self::quantity(
        "the toughness of a tissue",
        "j_per_m2",
        [Included(0.0), Included(1e7)],
    )
    .usually(1.0, 3e4);

    /// A coefficient of friction [-].
    pub const FRICTION: Self = Self::number(
        "a coefficient of friction",
        [Included(0.0), Included(100.0)],
    )
    .usually(0.0, 2.0);

    /// The exponent of a stiffening law [-].
    pub const EXPONENT: Self =
        Self::number("an exponent", [Included(0.0), Included(1e4)]).usually(1e-3, 100.0);

    /// A factor on forces or stiffness [-].
    pub const FACTOR: Self =
        Self::number("a factor", [Included(1e-6), Included(1e6)]).usually(0.01, 100.0);

    /// An angle between an axis and a side [degrees].
    pub const HALF_ANGLE: Self = Self::number("an angle", [Excluded(0.0), Excluded(90.0)])
        .with_remark("in degrees")
        .usually(5.0, 89.0);

    /// An angle between a direction and an axis [degrees].
    pub const AXIS_ANGLE: Self =
        Self::number("an angle", [Included(-180.0), Included(180.0)]).with_remark("in degrees");

    /// The angle of a family of fibres to their reference axis [degrees].
    pub const FIBRE_ANGLE: Self =
        Self::number("an angle", [Included(0.0), Included(90.0)]).with_remark("in degrees");

    /// The dispersion of fibres around their direction [-].
    pub const DISPERSION: Self = Self::number("a dispersion", [Included(0.0), Included(1.0 / 3.0)])
        .with_remark("0 is no dispersion, 1/3 an isotropic one");

    /// An angle of a turn [rad].
    pub const TURN: Self =
        Self::quantity("an angle", "rad", [Included(-1e3), Included(1e3)]).usually(-6.3, 6.3);
}
