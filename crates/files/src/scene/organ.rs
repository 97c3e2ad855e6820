use std::ops::Bound::{Excluded, Included};
use std::path::Path;

use super::{Inclusion, Region, Shape, TissueChoice};
use crate::{Domain, Error, Event, Keys};

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
}

/// A ball of stiffer tissue in an organ, such as a tumour.
///
/// ```toml
/// [[organ.nodule]]
/// center_m = [0.02, 0.01, 0.03]
/// radius_m = 0.005
/// stiffness_ratio = 6.0        # its modulus over that of the organ
/// ```
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
///
/// ```toml
/// [[organ.layer]]              # from outside to inside, at most 6
/// name = "circular muscle"
/// thickness_m = 0.0008
/// builtin_tissue = "pig-esophagus"
/// perforation_force_n = 0.4    # default: it withstands every force
/// toughness_j_per_m2 = 164.0   # default: that of [cutting]
/// ```
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

/// A body that is shown beside the organ and not deformed.
#[derive(Debug, Clone, PartialEq)]
pub struct Neighbour {
    /// Its surface.
    pub shape: Shape,
    /// Where it stands.
    pub location: Location,
    /// Whether tools stop at it.
    pub collides: bool,
}

/// Where a body stands in the scene: each of its points is scaled about the body's own origin, turned about
/// x, then y, then z, and moved.
///
/// ```toml
/// [[neighbour]]
/// builtin = "stomach"
/// at_m = [0.01, 0.0, -0.08]    # where its origin comes to
/// turn_deg = [0.0, 0.0, 20.0]  # about x, y and z of the scene, in this order
/// scale = 1.1
/// ```
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
    pub(super) const KEYS: &'static [&'static str] = &[
        "mesh",
        "mesh_unit",
        "builtin",
        "triangles",
        "tissue",
        "builtin_tissue",
        "anchor",
        "touchable",
        "layer",
        "inclusion",
        "nodule",
    ];

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let region = |key| -> Result<Option<Region>, Error> {
            let table = keys.table(key, Region::KEYS)?;
            table.map(|keys| Region::from_keys(&keys)).transpose()
        };
        let layers = keys.tables("layer", Layer::KEYS)?;
        if layers.len() > Event::OPENS_LAYER.len() {
            return Err(keys.bad("layer", "at most 6 layers: a session has an event for each"));
        }
        let nodules = keys.tables("nodule", Nodule::KEYS)?;
        let inclusions = keys.tables("inclusion", Inclusion::KEYS)?;
        Ok(Self {
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
    const KEYS: &[&str] = &["center_m", "radius_m", "stiffness_ratio"];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            center_m: keys.required_vector("center_m", Domain::POSITION)?,
            radius_m: keys.required_number("radius_m", Domain::LENGTH)?,
            stiffness_ratio: keys.required_number("stiffness_ratio", STIFFER)?,
        })
    }
}

impl Layer {
    const KEYS: &[&str] = &[
        "name",
        "thickness_m",
        "tissue",
        "builtin_tissue",
        "perforation_force_n",
        "toughness_j_per_m2",
    ];

    fn from_keys(keys: &Keys<'_>, number: usize, folder: &Path) -> Result<Self, Error> {
        let name = keys.text("name")?;
        Ok(Self {
            name: name.unwrap_or_else(|| format!("layer {}", number + 1)),
            thickness_m: keys.required_number("thickness_m", Domain::LENGTH)?,
            tissue: TissueChoice::from_keys(keys, folder)?,
            perforation_force_n: keys.number("perforation_force_n", Domain::FORCE)?,
            toughness_j_per_m2: keys.number("toughness_j_per_m2", Domain::TOUGHNESS)?,
        })
    }
}

impl Neighbour {
    pub(super) const KEYS: &'static [&'static str] = &[
        "mesh",
        "mesh_unit",
        "builtin",
        "triangles",
        "at_m",
        "turn_rad",
        "scale",
        "collides",
    ];

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        Ok(Self {
            shape: Shape::from_keys(keys, folder)?,
            location: Location {
                at_m: keys.vector("at_m", Domain::POSITION)?.unwrap_or_default(),
                turn_rad: keys.vector("turn_rad", Domain::TURN)?.unwrap_or_default(),
                scale: keys.number("scale", Domain::FACTOR)?.unwrap_or(1.0),
            },
            collides: keys.truth("collides")?.unwrap_or(false),
        })
    }
}
