use std::ops::Bound::{Excluded, Included};

use palpate_files::{Domain, Error, Key, Keys, Tissue, Word};
use palpate_mechanics::{FibreFrame, Vec3};

use super::some_numbers;

/// A bar pulled or pressed along its axis, free to widen.
#[derive(Debug, Clone)]
pub(crate) struct Uniaxial {
    /// Length over length at rest [-].
    pub(crate) stretches: Vec<f64>,
    /// Directions of the fibres of the tissue, if it has any, where the bar is pulled along x.
    pub(crate) frame: FibreFrame,
    /// Names of the stretches of its sides.
    pub(crate) sides: [&'static str; 2],
}

/// The fibre direction along which a bar is pulled.
#[derive(Debug, Clone, Copy)]
enum Pulled {
    Axis,
    Across,
    Normal,
}

const PULLED: &[(&str, Pulled)] = &[
    ("axis", Pulled::Axis),
    ("across", Pulled::Across),
    ("normal", Pulled::Normal),
];

const PULLED_MEANINGS: &[Word] = &[
    (
        "axis",
        "The reference axis, with the two families at `fibre_angle_deg` to the load.",
    ),
    ("across", "The second axis of the plane of the families."),
    ("normal", "The normal of that plane."),
];

const AXIS: &str = "stretch along the axis [-]";
const ACROSS: &str = "stretch across [-]";
const NORMAL: &str = "stretch along the normal [-]";

const STRETCH: Domain = Domain::number("a stretch", [Excluded(0.0), Included(1e3)])
    .usually(0.05, 10.0)
    .with_remark("1 is at rest");

impl Uniaxial {
    pub(crate) const KEYS: &'static [Key] = &[
        Key::numbers(
            "stretches",
            STRETCH,
            "Length over length at rest, for each answer.",
        )
        .required("[0.9, 1.1, 1.5]"),
        Key::word(
            "pulled_along",
            PULLED_MEANINGS,
            "With the law `holzapfel_gasser_ogden`: which direction of its fibres the bar is pulled along.",
        )
        .optional("\"across\"", "`axis`"),
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>, tissue: &Tissue) -> Result<Self, Error> {
        if !tissue.elasticity.law().has_fibres() {
            keys.refuse(
                "pulled_along",
                "no direction, for the law of the tissue has no fibres",
            )?;
        }
        let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
        let (frame, sides) = match keys.word("pulled_along", PULLED)?.unwrap_or(Pulled::Axis) {
            Pulled::Axis => (FibreFrame::new(&x, &y), [ACROSS, NORMAL]),
            Pulled::Across => (FibreFrame::new(&y, &x), [AXIS, NORMAL]),
            Pulled::Normal => (FibreFrame::new(&y, &z), [AXIS, ACROSS]),
        };
        Ok(Self {
            stretches: some_numbers(keys, "stretches", None)?,
            frame: frame.unwrap_or(FibreFrame::ALONG_AXES),
            sides,
        })
    }
}
