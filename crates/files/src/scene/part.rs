use std::path::Path;

use super::inclusion::{BALL, CAPSULE, ELLIPSOID, InclusionShape, STIFFNESS_RATIO};
use super::{CavityContent, InclusionPlace, LengthUnit, Shape, TissueChoice};
use crate::{Domain, Error, Key, Keys};

/// A part of a body that is not of its tissue, as in a table `[[region]]`.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyPart {
    /// Its name, for people.
    pub name: String,
    /// Its location.
    pub place: PartPlace,
    /// The key of its location.
    pub key: &'static str,
    /// Its material.
    pub content: PartContent,
}

/// The material of a part of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum PartContent {
    /// A tissue.
    Tissue(TissueChoice),
    /// None: it is a cavity.
    Cavity(CavityContent),
}

/// The location of a part of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum PartPlace {
    /// The next layer from outside, of this thickness [m].
    Layer(f64),
    /// A shape inside.
    Inclusion(InclusionPlace),
    /// Cells of a volume mesh, by the number of their region in its file.
    Label(i64),
    /// The same, by the name of their region.
    Group(String),
}

const NAME: Key =
    Key::text("name", "What people call it.").optional("\"tumour\"", "its group or number");

const LAYER: Key = Key::table(
    "layer",
    &[Key::number("thickness_m", Domain::LENGTH, "Its thickness.").required("0.0015")],
    "A layer below the outer surface; several lie one below the other, from outside inwards, in the order of the file. A \
     layer or another shape has to be there.",
)
.optional("", "another shape is there")
.in_template();

const SURFACE: Key = Key::path(
    "surface",
    "A mesh file with a closed surface in the body, as of a tumour or a vessel.",
)
.optional("\"tumour.stl\"", "another shape is there");

/// The largest number of a region in a file.
const LARGEST: u64 = 1_000_000_000;

pub(super) const CAVITY: Key = Key::table(
    "cavity",
    CavityContent::KEYS,
    "In place of a tissue: a cavity that tissue encloses, such as a gall bladder; `{}` is an empty one. Of the \
     models of a scene only the nonlinear one has it.",
)
.optional("", "it is of a tissue");

impl BodyPart {
    /// The keys of a part of a body within a surface.
    pub const OF_SURFACE: &'static [Key] = &[
        NAME,
        LAYER,
        Key::table("ball", BALL, "A ball.").optional("", "another shape is there"),
        Key::table("ellipsoid", ELLIPSOID, "An ellipsoid.").optional("", "another shape is there"),
        Key::table(
            "capsule",
            CAPSULE,
            "All points within a distance of a line segment.",
        )
        .optional("", "another shape is there"),
        SURFACE,
        Shape::KEYS[1],
        Key::integer(
            "label",
            0,
            LARGEST,
            "The number of a region in the file of a volume mesh: for `palpate solve` alone, for the organ of a scene is a \
             surface.",
        )
        .optional("2", "another shape is there"),
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1].optional(
            "\"pig-liver\"",
            "`tissue`, `cavity` or `stiffness_ratio` is there",
        )
        .in_template(),
        CAVITY,
        STIFFNESS_RATIO,
    ];

    /// The keys of a part of a body that may be a volume mesh.
    pub const OF_VOLUME: &'static [Key] = &[
        NAME,
        LAYER,
        Self::OF_SURFACE[2],
        Self::OF_SURFACE[3],
        Self::OF_SURFACE[4],
        SURFACE,
        Shape::KEYS[1],
        Key::integer(
            "label",
            0,
            LARGEST,
            "The number of a region in the file of a volume mesh: a physical group of Gmsh, or a whole number in the cell \
             data of VTK.",
        )
        .optional("2", "another shape is there"),
        Key::integer("number", 0, LARGEST, "As `label`.").optional("2", "another shape is there"),
        Key::text("group", "The name of the physical group in a Gmsh file.")
            .optional("\"tumour\"", "another shape is there"),
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1].optional("\"pig-liver\"", "`tissue` or `cavity` is there").in_template(),
        CAVITY,
    ];

    /// The part of a table with these keys, the `number`th from 0; paths begin in `folder`.
    ///
    /// # Errors
    /// When the table has no shape or two, neither a tissue nor a cavity or both, or a layer is a cavity.
    pub fn from_keys(keys: &Keys<'_>, number: usize, folder: &Path) -> Result<Self, Error> {
        let (key, place) = PartPlace::from_keys(keys, folder)?;
        let name = keys.text("name")?.unwrap_or_else(|| match &place {
            PartPlace::Group(group) => group.clone(),
            PartPlace::Label(label) => format!("region {label}"),
            PartPlace::Layer(_) | PartPlace::Inclusion(_) => format!("region {}", number + 1),
        });
        Ok(Self {
            name,
            place,
            key,
            content: PartContent::from_keys(keys, folder)?,
        })
    }
}

impl PartContent {
    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let Some(cavity) = keys.table("cavity")? else {
            return Ok(Self::Tissue(TissueChoice::from_keys(keys, folder)?));
        };
        for key in ["tissue", "builtin_tissue"] {
            if keys.contains(key) {
                return Err(keys.given_twice("cavity", key));
            }
        }
        if keys.contains("layer") {
            return Err(keys.invalid("layer", "a shape that tissue encloses"));
        }
        Ok(Self::Cavity(CavityContent::from_keys(&cavity)?))
    }
}

impl PartPlace {
    /// Every key for the location of a part.
    const SHAPES: [&str; 8] = [
        "layer",
        "ball",
        "ellipsoid",
        "capsule",
        "surface",
        "label",
        "number",
        "group",
    ];

    /// The one shape of a table, and its key.
    fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<(&'static str, Self), Error> {
        let mut given = Self::SHAPES.into_iter().filter(|key| keys.contains(key));
        let Some(key) = given.next() else {
            return Err(keys.missing(
                "layer",
                "one shape: `layer = { thickness_m }`, `ball = { center_m, radius_m }`, `ellipsoid = { center_m, radii_m \
                 }`, `capsule = { from_m, to_m, radius_m }`, `surface = \"file.stl\"` or, of a volume mesh, `label = n`",
            ));
        };
        if let Some(other) = given.next() {
            return Err(keys.given_twice(key, other));
        }
        if key != "surface" {
            keys.refuse("mesh_unit", "no unit without `surface`")?;
        }
        let not_there = || keys.missing(key, "a value");
        let place = match key {
            "layer" => {
                let layer = keys.table(key)?.ok_or_else(not_there)?;
                Self::Layer(layer.required_number("thickness_m")?)
            }
            "surface" => Self::Inclusion(InclusionPlace::Mesh {
                path: folder.join(keys.text(key)?.ok_or_else(not_there)?),
                unit: keys.word("mesh_unit", LengthUnit::WORDS)?,
            }),
            "label" | "number" => Self::Label(keys.integer(key)?.ok_or_else(not_there)? as i64),
            "group" => Self::Group(keys.text(key)?.ok_or_else(not_there)?),
            _ => Self::Inclusion(InclusionPlace::Shape(InclusionShape::from_keys(keys)?)),
        };
        Ok((key, place))
    }
}
