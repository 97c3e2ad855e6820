use std::ops::Bound::{Excluded, Included};
use std::path::Path;

use super::{Inclusion, Region, Shape, TissueChoice};
use crate::{BuiltinTissue, Domain, Error, Event, Key, Keys, Tissue};

/// Stiffness of a rigid body under a tip [N/m].
const RIGID_STIFFNESS: f64 = 1000.0;

/// Nodes of a neighbour that bends, about.
const SOFT_NODES: usize = 500;

/// The organ that is touched.
#[derive(Debug, Clone, PartialEq)]
pub struct Organ {
    /// Its surface.
    pub shape: Shape,
    /// What it is made of.
    pub tissue: TissueChoice,
    /// Where it is held; none when the scene does not say.
    pub anchor: Option<Region>,
    /// Where tools may touch it; everywhere when the scene does not say. The hybrid model prepares no more
    /// than this.
    pub touchable: Option<Region>,
    /// Its layers from outside to inside; empty for an organ of one tissue.
    pub layers: Vec<Layer>,
    /// Parts of another tissue in it.
    pub inclusions: Vec<Inclusion>,
    /// Stiff balls in it.
    pub nodules: Vec<Nodule>,
    /// Whether its parts stay out of one another, with the nonlinear model.
    pub self_contact: bool,
    /// Coulomb's coefficient between them [-].
    pub self_friction: f64,
}

/// A ball of stiffer tissue in an organ, such as a tumour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nodule {
    /// Its middle [m].
    pub center_m: [f64; 3],
    /// Its radius [m].
    pub radius_m: f64,
    /// Its modulus over that of the organ [-].
    pub stiffness_ratio: f64,
}

/// A layer of an organ. A blade opens it where it goes as deep as the layer's lower face, and any tool where the
/// layer is bare and the normal force exceeds `perforation_force_n`. The nonlinear model feels its tissue; with the other
/// models the organ answers as `organ.tissue` does. Below the layers is `organ.tissue`.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Its name, for people.
    pub name: String,
    /// Its thickness [m].
    pub thickness_m: f64,
    /// What it is made of.
    pub tissue: TissueChoice,
    /// The normal force on a tool at which it gives way when it is bare [N]; none when it never does.
    pub perforation_force_n: Option<f64>,
    /// The work that a cut through it takes per area of its face [J/m²]; none when `[cutting]` says it.
    pub toughness_j_per_m2: Option<f64>,
}

/// A body beside the organ.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbour {
    /// Its surface.
    pub shape: Shape,
    /// Where it stands.
    pub location: Location,
    /// Whether tools stop at it.
    pub collides: bool,
    /// Coulomb's coefficient between it and an organ of the nonlinear model [-].
    pub friction: f64,
    /// The force on a tip per depth in it [N/m], if it is rigid.
    pub stiffness_n_per_m: f64,
    /// What it is made of, if it bends.
    pub soft: Option<SoftNeighbour>,
}

/// What a neighbour is made of that bends with the organ of a nonlinear model.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftNeighbour {
    /// Its tissue.
    pub tissue: TissueChoice,
    /// Where it is held, in the scene; none for the attachment of a built-in organ, which stands where it does.
    pub anchor: Option<Region>,
    /// About how many nodes carry its mechanics.
    pub nodes: usize,
}

/// Where a body stands in the scene: each of its points is scaled about the body's own origin, turned about
/// x, then y, then z, and moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// Where its origin comes to [m].
    pub at_m: [f64; 3],
    /// About x, then y, then z of the scene, counter-clockwise [rad].
    pub turn_rad: [f64; 3],
    /// [-]
    pub scale: f64,
}

impl Default for Location {
    /// As it was made.
    fn default() -> Self {
        Self {
            at_m: [0.0; 3],
            turn_rad: [0.0; 3],
            scale: 1.0,
        }
    }
}

impl Organ {
    pub(super) const KEYS: &'static [Key] = &[
        Shape::KEYS[0],
        Shape::KEYS[1],
        Shape::KEYS[2],
        Shape::KEYS[3],
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1],
        Key::table(
            "anchor",
            Region::KEYS,
            "The fixed part: triangles whose centroid lies in one of these regions.",
        )
        .optional("", "the attachment of a built-in organ; none of a mesh, which only the local model allows"),
        Key::table("touchable", Region::KEYS, "Where tools may touch it; the hybrid model prepares no more than this.")
            .optional("", "everywhere"),
        Key::tables(
            "layer",
            Layer::KEYS,
            "Its layers from outside to inside, at most 6, above `tissue`. A blade opens a layer where it goes as deep as its \
             lower face, and any tool where it is bare and the normal force exceeds `perforation_force_n`. The nonlinear \
             model feels its tissue; with the others the organ answers as `tissue` does.",
        )
        .optional("", "it is of one tissue"),
        Key::tables(
            "inclusion",
            Inclusion::KEYS,
            "Parts of another tissue, such as a tumour or a vessel. The nonlinear model feels them.",
        )
        .optional("", "none"),
        Key::tables(
            "nodule",
            Nodule::KEYS,
            "Balls of stiffer tissue, whose answer the local and the hybrid model estimate.",
        )
        .optional("", "none"),
        Key::truth(
            "self_contact",
            "Nonlinear model: whether its parts stay out of one another where it folds or closes.",
        )
        .default("false"),
        Key::number(
            "self_friction",
            Domain::FRICTION,
            "Coulomb's coefficient between its parts, with `self_contact`.",
        )
        .default("0.0"),
    ];

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let region = |key| -> Result<Option<Region>, Error> {
            let table = keys.table(key)?;
            table.map(|keys| Region::from_keys(&keys)).transpose()
        };
        let layers = keys.tables("layer")?;
        if layers.len() > Event::OPENS_LAYER.len() {
            return Err(keys.bad("layer", "at most 6 layers: a session has an event for each"));
        }
        let nodules = keys.tables("nodule")?;
        let inclusions = keys.tables("inclusion")?;
        Ok(Self {
            self_contact: keys.truth("self_contact")?.unwrap_or(false),
            self_friction: keys.number("self_friction")?.unwrap_or(0.0),
            nodules: nodules
                .iter()
                .map(Nodule::from_keys)
                .collect::<Result<_, _>>()?,
            shape: Shape::from_keys(keys, folder)?,
            tissue: TissueChoice::from_keys(keys, folder)?,
            anchor: region("anchor")?,
            touchable: region("touchable")?,
            layers: layers
                .iter()
                .enumerate()
                .map(|(number, keys)| Layer::from_keys(keys, number, folder))
                .collect::<Result<_, _>>()?,
            inclusions: inclusions
                .iter()
                .enumerate()
                .map(|(number, keys)| Inclusion::from_keys(keys, number, folder))
                .collect::<Result<_, _>>()?,
        })
    }
}

const STIFFER: Domain =
    Domain::number("a number", [Excluded(1.0), Included(1e9)]).usually(1.0, 1000.0);

impl Nodule {
    const KEYS: &[Key] = &[
        Key::vector("center_m", Domain::POSITION, "Its middle.").required("[0.02, 0.01, 0.03]"),
        Key::number("radius_m", Domain::LENGTH, "Its radius.").required("0.005"),
        Key::number(
            "stiffness_ratio",
            STIFFER,
            "Its modulus over that of the organ.",
        )
        .required("6.0"),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            center_m: keys.required_vector("center_m")?,
            radius_m: keys.required_number("radius_m")?,
            stiffness_ratio: keys.required_number("stiffness_ratio")?,
        })
    }
}

impl Layer {
    /// The keys of a layer: name, thickness and tissue, then what a blade meets.
    pub const KEYS: &'static [Key] = &[
        Key::text("name", "What people call it.").optional("\"circular muscle\"", "its number"),
        Key::number("thickness_m", Domain::LENGTH, "Its thickness.").required("0.0008"),
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1],
        Key::number(
            "perforation_force_n",
            Domain::FORCE,
            "The normal force on a tool at which it gives way where it is bare.",
        )
        .optional("0.4", "it withstands every force"),
        Key::number(
            "toughness_j_per_m2",
            Domain::TOUGHNESS,
            "The work of a cut through it per area of the cut's face.",
        )
        .optional("164.0", "that of `[cutting]`"),
    ];

    fn from_keys(keys: &Keys<'_>, number: usize, folder: &Path) -> Result<Self, Error> {
        let name = keys.text("name")?;
        Ok(Self {
            name: name.unwrap_or_else(|| format!("layer {}", number + 1)),
            thickness_m: keys.required_number("thickness_m")?,
            tissue: TissueChoice::from_keys(keys, folder)?,
            perforation_force_n: keys.number("perforation_force_n")?,
            toughness_j_per_m2: keys.number("toughness_j_per_m2")?,
        })
    }
}

impl Neighbour {
    pub(super) const KEYS: &'static [Key] = &[
        Shape::KEYS[0],
        Shape::KEYS[1],
        Shape::KEYS[2],
        Shape::KEYS[3],
        Key::vector(
            "at_m",
            Domain::POSITION,
            "Where its origin comes to, after it is scaled and turned about it.",
        )
        .default("[0.0, 0.0, 0.0]"),
        Key::vector(
            "turn_rad",
            Domain::TURN,
            "How it is turned about x, then y, then z of the scene, counter-clockwise.",
        )
        .default("[0.0, 0.0, 0.0]"),
        Key::number(
            "scale",
            Domain::FACTOR,
            "How much larger it is than its shape.",
        )
        .default("1.0"),
        Key::truth(
            "collides",
            "Whether it stops the tips of tools and an organ of the nonlinear model.",
        )
        .default("false"),
        Key::path_or_table(
            "tissue",
            Tissue::KEYS,
            "Nonlinear model: what it is made of, a tissue file or a table with a tissue's keys. It then bends, is touched as \
             the organ is, and stays out of it.",
        )
        .optional("\"tissue.toml\"", "it is rigid, unless `builtin_tissue` names one"),
        Key::word(
            "builtin_tissue",
            BuiltinTissue::MEANINGS,
            "The same, of a tissue that comes with the program.",
        )
        .optional("\"pig-liver\"", "it is rigid, unless `tissue` says what it is made of"),
        Key::table(
            "anchor",
            Region::KEYS,
            "Where it is held, if it bends: its surface in one of these regions of the scene.",
        )
        .optional("", "the attachment of a built-in organ"),
        // As for `model.nodes`.
        Key::integer(
            "nodes",
            200,
            6_000,
            "About how many nodes carry its mechanics, if it bends.",
        )
        .default("500"),
        Key::number(
            "friction",
            Domain::FRICTION,
            "Coulomb's coefficient between it and an organ of the nonlinear model, if it collides or bends.",
        )
        .default("0.0"),
        // What a loop at 1 kHz displays without trembling on the devices of `docs/devices.md`.
        Key::number(
            "stiffness_n_per_m",
            Domain::STIFFNESS,
            "The force on a tip per depth in it, where it collides.",
        )
        .default("1000.0"),
    ];

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        Ok(Self {
            shape: Shape::from_keys(keys, folder)?,
            location: Location {
                at_m: keys.vector("at_m")?.unwrap_or_default(),
                turn_rad: keys.vector("turn_rad")?.unwrap_or_default(),
                scale: keys.number("scale")?.unwrap_or(1.0),
            },
            collides: keys.truth("collides")?.unwrap_or(false),
            friction: keys.number("friction")?.unwrap_or(0.0),
            stiffness_n_per_m: keys.number("stiffness_n_per_m")?.unwrap_or(RIGID_STIFFNESS),
            soft: SoftNeighbour::from_keys(keys, folder)?,
        })
    }
}

impl SoftNeighbour {
    /// None of a neighbour without a tissue.
    fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Option<Self>, Error> {
        if tissue_key(keys).is_none() {
            for key in ["anchor", "nodes"] {
                keys.refuse(key, "nothing, for a neighbour without `tissue` is rigid")?;
            }
            return Ok(None);
        }
        if keys.truth("collides")? == Some(true) {
            return Err(keys.bad(
                "collides",
                "nothing, for a neighbour with `tissue` bends, and is touched anyhow",
            ));
        }
        let anchor = keys.table("anchor")?;
        let anchor = anchor.map(|keys| Region::from_keys(&keys)).transpose()?;
        let is_held = anchor.as_ref().is_some_and(|region| !region.is_empty());
        if keys.contains("mesh") && !is_held {
            return Err(keys.missing(
                "anchor",
                "fixed regions, with `planes`, `boxes` or `spheres`, for a neighbour that bends has to be held somewhere",
            ));
        }
        let nodes = keys
            .integer("nodes")?
            .map_or(SOFT_NODES, |number| number as usize);
        let tissue = TissueChoice::from_keys(keys, folder)?;
        Ok(Some(Self {
            tissue,
            anchor,
            nodes,
        }))
    }
}

/// The key that says what a neighbour is made of.
pub(super) fn tissue_key(keys: &Keys<'_>) -> Option<&'static str> {
    ["tissue", "builtin_tissue"]
        .into_iter()
        .find(|key| keys.contains(key))
}
