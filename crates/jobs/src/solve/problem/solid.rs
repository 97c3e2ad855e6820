use std::ops::Bound::Included;
use std::path::Path;

use palpate_files::scene::{Region, Shape};
use palpate_files::{Domain, Error, Key, Keys};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Friction;

use super::{BOND_MEANINGS, BONDS, required_table};

/// An organ of any shape, held somewhere and moved elsewhere.
#[derive(Debug, Clone)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    /// Where it is held; none: where a built-in organ grows.
    pub(crate) anchor: Option<Region>,
    /// Points of the surface within the radius [m] of the centre [m] move.
    pub(crate) center: Vec3,
    /// [m]
    pub(crate) radius: f64,
    /// [m]
    pub(crate) displacement: Vec3,
    pub(crate) contact: Friction,
}

const DISPLACEMENT: Domain =
    Domain::quantity("a displacement", "m", [Included(-1.0), Included(1.0)]).usually(-0.1, 0.1);

const EXAMPLE: &str =
    "anchor = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }";

impl Solid {
    pub(crate) const KEYS: &'static [Key] = &[
        Shape::KEYS[0],
        Shape::KEYS[1],
        Shape::KEYS[2],
        Shape::KEYS[3],
        Key::table("anchor", Region::KEYS, "The fixed part.")
            .optional("", "where a built-in shape grows"),
        Key::table(
            "patch",
            Self::PATCH,
            "The part of the surface that is moved.",
        )
        .required(""),
    ];

    const PATCH: &[Key] = &[
        Key::vector("center_m", Domain::POSITION, "Its centre.").required("[0.0, 0.0, 0.05]"),
        Key::number(
            "radius_m",
            Domain::LENGTH,
            "Points of the surface within this distance of the centre move.",
        )
        .required("0.003"),
        Key::vector("displacement_m", DISPLACEMENT, "How far they move.")
            .required("[0.0, 0.0, -0.001]"),
        Key::word(
            "contact",
            BOND_MEANINGS,
            "Their tangential boundary condition.",
        )
        .default("\"stick\""),
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let shape = Shape::from_keys(keys, folder)?;
        let anchor = anchor(keys, &shape)?;
        let patch = required_table(
            keys,
            "patch",
            "patch = { center_m = [0.0, 0.0, 0.05], radius_m = 0.003, displacement_m = [0.0, 0.0, -0.001] }",
        )?;
        Ok(Self {
            shape,
            anchor,
            center: patch.required_vector("center_m")?.into(),
            radius: patch.required_number("radius_m")?,
            displacement: patch.required_vector("displacement_m")?.into(),
            contact: patch.word("contact", BONDS)?.unwrap_or(Friction::Bonded),
        })
    }
}

fn anchor(keys: &Keys<'_>, shape: &Shape) -> Result<Option<Region>, Error> {
    let anchor = keys.table("anchor")?;
    let expected = format!("fixed regions, such as `{EXAMPLE}`");
    match anchor.map(|keys| Region::from_keys(&keys)).transpose()? {
        Some(anchor) if !anchor.is_empty() => Ok(Some(anchor)),
        Some(_) => Err(keys.bad("anchor", expected)),
        None if matches!(shape, Shape::Builtin { .. }) => Ok(None),
        None => Err(keys.missing("anchor", expected)),
    }
}
