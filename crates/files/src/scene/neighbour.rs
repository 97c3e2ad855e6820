use std::path::Path;

use super::organ::Parts;
use super::{Inclusion, Layer, Region, Shape, TissueChoice};
use crate::{BuiltinTissue, Domain, Error, Key, Keys, Tissue};

/// Stiffness of a rigid body under a tip [N/m].
const RIGID_STIFFNESS: f64 = 1000.0;

/// Nodes of a neighbour that bends, about.
const SOFT_NODES: usize = 500;

/// As for `model.nodes`.
pub(super) const MIN_NODES: u64 = 200;
pub(super) const MAX_NODES: u64 = 6_000;

/// A body next to the organ.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbour {
    /// Its surface.
    pub shape: Shape,
    /// Its placement.
    pub location: Location,
    /// Whether tools stop at it.
    pub collides: bool,
    /// Coulomb's coefficient between it and an organ of the nonlinear model [-].
    pub friction: f64,
    /// The force on a tip per depth in it [N/m], if it is rigid.
    pub stiffness_n_per_m: f64,
    /// Its material, if it bends.
    pub soft: Option<SoftNeighbour>,
}

/// The material of a neighbour that bends with the organ of a nonlinear model.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftNeighbour {
    /// Its tissue.
    pub tissue: TissueChoice,
    /// Its layers from outside to inside; a `[[neighbour]]` has none.
    pub layers: Vec<Layer>,
    /// Parts of another tissue in it, and cavities; a `[[neighbour]]` has none.
    pub inclusions: Vec<Inclusion>,
    /// Where it is fixed, in the scene; none for the attachment of a built-in organ, which is placed with it.
    pub anchor: Option<Region>,
    /// About how many nodes carry its mechanics.
    pub nodes: usize,
}

/// Placement of a body in the scene: each of its points is scaled about the body's own origin, turned about x, then
/// y, then z, and moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// Position of its origin [m].
    pub at_m: [f64; 3],
    /// About x, then y, then z of the scene, counter-clockwise [rad].
    pub turn_rad: [f64; 3],
    /// [-]
    pub scale: f64,
}

impl Default for Location {
    /// The identity.
    fn default() -> Self {
        Self {
            at_m: [0.0; 3],
            turn_rad: [0.0; 3],
            scale: 1.0,
        }
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
        Key::boolean(
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
            "Where it is fixed, if it bends: its surface in one of these regions of the scene.",
        )
        .optional("", "the attachment of a built-in organ"),
        Key::integer(
            "nodes",
            MIN_NODES,
            MAX_NODES,
            "About how many nodes carry its mechanics, if it bends.",
        )
        .default("500"),
        Key::number(
            "friction",
            Domain::FRICTION,
            "Coulomb's coefficient between it and an organ of the nonlinear model, if it collides or bends.",
        )
        .default("0.0"),
        // The range that a loop at 1 kHz displays without vibration on the devices of `docs/devices.md`.
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
            location: Location::from_keys(keys)?,
            collides: keys.boolean("collides")?.unwrap_or(false),
            friction: keys.number("friction")?.unwrap_or(0.0),
            stiffness_n_per_m: keys.number("stiffness_n_per_m")?.unwrap_or(RIGID_STIFFNESS),
            soft: SoftNeighbour::from_keys(keys, folder)?,
        })
    }
}

impl Neighbour {
    /// Further organs: bodies that bend, next to the first.
    pub(super) fn of_organ(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        for key in ["touchable", "nodule", "self_contact", "self_friction"] {
            keys.refuse(
                key,
                "nothing in a further organ, for only the first `[[organ]]` can have it yet",
            )?;
        }
        for list in ["inclusion", "region"] {
            for keys in keys.tables(list)? {
                keys.refuse(
                    "stiffness_ratio",
                    "nothing in a further organ, for only in the first `[[organ]]` inclusions are estimated; give it a `tissue`",
                )?;
            }
        }
        for keys in keys.tables("layer")? {
            for key in ["perforation_force_n", "toughness_j_per_m2"] {
                keys.refuse(
                    key,
                    "nothing in a further organ, for only the first `[[organ]]` can be cut and perforated yet",
                )?;
            }
        }
        let tissue = SoftNeighbour::of_tissue(keys, folder)?;
        let Parts {
            layers, inclusions, ..
        } = Parts::from_keys(keys, folder, &tissue.tissue)?;
        Ok(Self {
            shape: Shape::from_keys(keys, folder)?,
            location: Location::from_keys(keys)?,
            collides: false,
            friction: keys.number("friction")?.unwrap_or(0.0),
            stiffness_n_per_m: RIGID_STIFFNESS,
            soft: Some(SoftNeighbour {
                layers,
                inclusions,
                ..tissue
            }),
        })
    }
}

impl Location {
    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            at_m: keys.vector("at_m")?.unwrap_or_default(),
            turn_rad: keys.vector("turn_rad")?.unwrap_or_default(),
            scale: keys.number("scale")?.unwrap_or(1.0),
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
        if keys.boolean("collides")? == Some(true) {
            return Err(keys.invalid(
                "collides",
                "nothing, for a neighbour with `tissue` bends, and is touched anyhow",
            ));
        }
        Self::of_tissue(keys, folder).map(Some)
    }

    fn of_tissue(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let anchor = keys.table("anchor")?;
        let anchor = anchor.map(|keys| Region::from_keys(&keys)).transpose()?;
        let is_fixed = anchor.as_ref().is_some_and(|region| !region.is_empty());
        if keys.contains("mesh") && !is_fixed {
            return Err(keys.missing(
                "anchor",
                "fixed regions, with `planes`, `boxes` or `spheres`, for a body that bends has to be fixed somewhere",
            ));
        }
        let nodes = keys
            .integer("nodes")?
            .map_or(SOFT_NODES, |number| number as usize);
        let tissue = TissueChoice::from_keys(keys, folder)?;
        Ok(Self {
            tissue,
            layers: Vec::new(),
            inclusions: Vec::new(),
            anchor,
            nodes,
        })
    }
}

/// The key of a neighbour's material.
pub(super) fn tissue_key(keys: &Keys<'_>) -> Option<&'static str> {
    ["tissue", "builtin_tissue"]
        .into_iter()
        .find(|key| keys.contains(key))
}
