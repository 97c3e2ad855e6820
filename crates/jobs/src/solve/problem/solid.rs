use std::ops::Bound::Included;
use std::path::Path;

use palpate_files::scene::{Region, Shape};
use palpate_files::{Domain, Error, Keys};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Bond;

use super::required_table;

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
    pub(crate) contact: Bond,
}

const CONTACTS: &[(&str, Bond)] = &[
    ("stick", Bond::Stick),
    ("slip", Bond::Slip),
    ("bonded", Bond::Stick),
];

const DISPLACEMENT: Domain =
    Domain::quantity("a displacement", "m", [Included(-1.0), Included(1.0)]).usually(-0.1, 0.1);

const EXAMPLE: &str =
    "anchor = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }";

impl Solid {
    pub(crate) const KEYS: &'static [&'static str] = &[
        "mesh",
        "mesh_unit",
        "builtin",
        "triangles",
        "anchor",
        "patch",
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let shape = Shape::from_keys(keys, folder)?;
        let anchor = anchor(keys, &shape)?;
        let patch = required_table(
            keys,
            "patch",
            &["center_m", "radius_m", "displacement_m", "contact"],
            "patch = { center_m = [0.0, 0.0, 0.05], radius_m = 0.003, displacement_m = [0.0, 0.0, -0.001] }",
        )?;
        Ok(Self {
            shape,
            anchor,
            center: patch.required_vector("center_m", Domain::POSITION)?.into(),
            radius: patch.required_number("radius_m", Domain::LENGTH)?,
            displacement: patch
                .required_vector("displacement_m", DISPLACEMENT)?
                .into(),
            contact: patch.word("contact", CONTACTS)?.unwrap_or(Bond::Stick),
        })
    }
}

fn anchor(keys: &Keys<'_>, shape: &Shape) -> Result<Option<Region>, Error> {
    let anchor = keys.table("anchor", Region::KEYS)?;
    let expected = format!("regions that are held, such as `{EXAMPLE}`");
    match anchor.map(|keys| Region::from_keys(&keys)).transpose()? {
        Some(anchor) if !anchor.is_empty() => Ok(Some(anchor)),
        Some(_) => Err(keys.bad("anchor", expected)),
        None if matches!(shape, Shape::Builtin { .. }) => Ok(None),
        None => Err(keys.missing("anchor", expected)),
    }
}
