use std::f64::consts::FRAC_PI_2;

use palpate_files::{Domain, Error, Key, Keys};
use palpate_mechanics::contact::Friction;

use super::{BOND_MEANINGS, BONDS, length_below};

/// Half a ball on its fixed base, pressed at the pole.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hemisphere {
    /// [m]
    pub(crate) radius: f64,
    /// Arc from the pole within which every point of the surface moves [m].
    pub(crate) patch_radius: f64,
    pub(crate) patch: Friction,
    /// Displacement of the patch along −z [m].
    pub(crate) depth: f64,
}

impl Hemisphere {
    pub(crate) const KEYS: &'static [Key] = &[
        Key::number("radius_m", Domain::LENGTH, "Its radius.").required("0.05"),
        Key::number(
            "patch_radius_m",
            Domain::LENGTH,
            "Arc from the pole within which every point of the surface moves.",
        )
        .required("0.003"),
        Key::word(
            "patch",
            BOND_MEANINGS,
            "The tangential boundary condition of the patch.",
        )
        .required("\"slip\""),
        Key::number(
            "depth_m",
            Domain::DEPTH_OR_NONE,
            "How far the patch moves towards the base.",
        )
        .required("0.001"),
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let radius = keys.required_number("radius_m")?;
        let quarter = FRAC_PI_2 * radius;
        let what = "the arc from the pole to the base";
        let depth = keys.required_number("depth_m")?;
        if depth >= radius {
            return Err(keys.invalid("depth_m", format!("less than the radius, {radius} m")));
        }
        let patch = keys.word("patch", BONDS)?;
        Ok(Self {
            radius,
            patch_radius: length_below(keys, "patch_radius_m", quarter, what)?,
            patch: patch.ok_or_else(|| keys.missing("patch", "\"slip\" or \"bonded\""))?,
            depth,
        })
    }
}
