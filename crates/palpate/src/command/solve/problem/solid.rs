use std::path::Path;

use palpate_files::scene::{Anchor, Shape};
use palpate_files::{Domain, Error, Keys};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Bond;

use super::required_table;

/// An organ of any shape, held somewhere and moved elsewhere.
#[derive(Debug, Clone)]
pub(in super::super) struct Solid {
    pub(in super::super) shape: Shape,
    pub(in super::super) held: Held,
    /// Points of the surface within the radius [m] of the centre [m] move.
    pub(in super::super) center: Vec3,
    /// [m]
    pub(in super::super) radius: f64,
    /// [m]
    pub(in super::super) displacement: Vec3,
    pub(in super::super) contact: Bond,
}

/// Where it is held.
#[derive(Debug, Clone)]
pub(in super::super) enum Held {
    /// As the problem says.
    Anchor(Anchor),
    /// Where a built-in organ grows.
    AsBuiltIn,
}

const CONTACTS: &[(&str, Bond)] = &[
    ("stick", Bond::Stick),
    ("slip", Bond::Slip),
    ("bonded", Bond::Stick),
];

const EXAMPLE: &str =
    "anchor = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }";

impl Solid {
    pub(super) const KEYS: &'static [&'static str] = &[
        "mesh",
        "mesh_unit",
        "builtin",
        "triangles",
        "anchor",
        "patch",
    ];

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let shape = Shape::from_keys(keys, folder)?;
        let held = held(keys, &shape)?;
        let patch = required_table(
            keys,
            "patch",
            &["center_m", "radius_m", "displacement_m", "contact"],
            "patch = { center_m = [0.0, 0.0, 0.05], radius_m = 0.003, displacement_m = [0.0, 0.0, -0.001] }",
        )?;
        Ok(Self {
            shape,
            held,
            center: patch.required_vector("center_m")?.into(),
            radius: patch.required_number("radius_m", Domain::POSITIVE)?,
            displacement: patch.required_vector("displacement_m")?.into(),
            contact: patch.word("contact", CONTACTS)?.unwrap_or(Bond::Stick),
        })
    }
}

fn held(keys: &Keys<'_>, shape: &Shape) -> Result<Held, Error> {
    let anchor = keys.table("anchor", Anchor::KEYS)?;
    let expected = format!("regions that are held, such as `{EXAMPLE}`");
    match anchor.map(|keys| Anchor::from_keys(&keys)).transpose()? {
        Some(anchor) if !anchor.is_empty() => Ok(Held::Anchor(anchor)),
        Some(_) => Err(keys.bad("anchor", expected)),
        None if matches!(shape, Shape::Builtin { .. }) => Ok(Held::AsBuiltIn),
        None => Err(keys.missing("anchor", expected)),
    }
}
