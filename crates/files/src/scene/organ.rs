use std::path::Path;

use super::neighbour::{MAX_NODES, MIN_NODES};
use super::{
    BodyPart, EstimatedInclusion, Inclusion, Neighbour, PartContent, PartPlace, Region, Shape,
    TissueChoice,
};
use crate::{Domain, Error, Event, Key, Keys};

/// The default placement of an organ.
const OF_FURTHER: &str = "as its mesh does; of a further organ alone";

/// The organ that is touched.
#[derive(Debug, Clone, PartialEq)]
pub struct Organ {
    /// Its surface.
    pub shape: Shape,
    /// Its material.
    pub tissue: TissueChoice,
    /// Where it is fixed; none when the scene does not state it.
    pub anchor: Option<Region>,
    /// Where tools may touch it; everywhere when the scene does not state it. The hybrid model prepares no more than
    /// this.
    pub touchable: Option<Region>,
    /// Its layers from outside to inside; empty for an organ of one tissue.
    pub layers: Vec<Layer>,
    /// Parts of another tissue in it, and cavities.
    pub inclusions: Vec<Inclusion>,
    /// Stiff parts in it whose effect is estimated.
    pub estimated_inclusions: Vec<EstimatedInclusion>,
    /// Whether it has self-contact, with the nonlinear model.
    pub self_contact: bool,
    /// Coulomb's coefficient between them [-].
    pub self_friction: f64,
}

/// A layer of an organ. A blade opens it where it cuts as deep as the layer's lower face, and any tool where the
/// layer is exposed and the normal force exceeds `perforation_force_n`. The hybrid and the nonlinear model include
/// its tissue; with the local model the organ responds as `organ.tissue`. Below the layers is `organ.tissue`.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Its name, for people.
    pub name: String,
    /// Its thickness [m].
    pub thickness_m: f64,
    /// Its material.
    pub tissue: TissueChoice,
    /// The normal force on a tool at which it perforates when it is exposed [N]; none when it never does.
    pub perforation_force_n: Option<f64>,
    /// The fracture work per area of a cut through it [J/m²]; none when `[cutting]` states it.
    pub toughness_j_per_m2: Option<f64>,
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
            "The fixed part: triangles whose centroid lies in one of these regions, and with the nonlinear model the nodes of its \
             mesh to which the nearest point of the surface does.",
        )
        .optional("", "the attachment of a built-in organ; none of a mesh, which only the local model allows"),
        Key::table("touchable", Region::KEYS, "Where tools may touch it; the hybrid model prepares no more than this.")
            .optional("", "everywhere"),
        Key::tables(
            "layer",
            Layer::KEYS,
            "Its layers from outside to inside, at most 6, above `tissue`. A blade opens a layer where it goes as deep as its \
             lower face, and any tool where it is bare and the normal force exceeds `perforation_force_n`. The hybrid and \
             the nonlinear model feel its tissue; with the local one the organ answers as `tissue` does.",
        )
        .optional("", "it is of one tissue"),
        Key::tables(
            "inclusion",
            Inclusion::KEYS,
            "Parts of another tissue, such as a tumour or a vessel, which the hybrid and the nonlinear model solve and the local one \
             estimates, and cavities, which the nonlinear model has.",
        )
        .optional("", "none"),
        Key::tables(
            "region",
            BodyPart::OF_SURFACE,
            "Layers, in the order of the file after those of `layer`, and inclusions and cavities, after those of `inclusion`: \
             all in one list.",
        )
        .optional("", "none"),
        Key::tables(
            "nodule",
            EstimatedInclusion::BALL_KEYS,
            "Earlier form of an `inclusion` with a `ball` and a `stiffness_ratio`, which is still read.",
        )
        .optional("", "none"),
        Key::boolean(
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
        Neighbour::KEYS[4].optional("[0.0, 0.0, 0.0]", OF_FURTHER),
        Neighbour::KEYS[5].optional("[0.0, 0.0, 0.0]", OF_FURTHER),
        Neighbour::KEYS[6].optional("1.0", OF_FURTHER),
        Key::integer(
            "nodes",
            MIN_NODES,
            MAX_NODES,
            "A further organ: about how many nodes carry its mechanics; `model.nodes` says it of the first.",
        )
        .optional("500", "500 of a further organ"),
        Key::number(
            "friction",
            Domain::FRICTION,
            "A further organ: Coulomb's coefficient between it and other organs.",
        )
        .optional("0.2", "0.0"),
    ];

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        for key in ["at_m", "turn_rad", "scale", "nodes", "friction"] {
            keys.refuse(
                key,
                "nothing in the first organ, which stands as its mesh does; it is for further organs",
            )?;
        }
        let region = |key| -> Result<Option<Region>, Error> {
            let table = keys.table(key)?;
            table.map(|keys| Region::from_keys(&keys)).transpose()
        };
        let tissue = TissueChoice::from_keys(keys, folder)?;
        let Parts {
            layers,
            inclusions,
            estimated: mut estimated_inclusions,
        } = Parts::from_keys(keys, folder, &tissue)?;
        for (number, keys) in keys.tables("nodule")?.iter().enumerate() {
            estimated_inclusions.push(EstimatedInclusion::from_ball_keys(keys, number)?);
        }
        Ok(Self {
            self_contact: keys.boolean("self_contact")?.unwrap_or(false),
            self_friction: keys.number("self_friction")?.unwrap_or(0.0),
            estimated_inclusions,
            shape: Shape::from_keys(keys, folder)?,
            tissue,
            anchor: region("anchor")?,
            touchable: region("touchable")?,
            layers,
            inclusions,
        })
    }
}

/// Parts of an organ that are not of its tissue.
pub(super) struct Parts {
    pub(super) layers: Vec<Layer>,
    pub(super) inclusions: Vec<Inclusion>,
    pub(super) estimated: Vec<EstimatedInclusion>,
}

impl Parts {
    /// Those of an organ of tissue `around`.
    pub(super) fn from_keys(
        keys: &Keys<'_>,
        folder: &Path,
        around: &TissueChoice,
    ) -> Result<Self, Error> {
        let layers = keys.tables("layer")?;
        let mut layers: Vec<Layer> = layers
            .iter()
            .enumerate()
            .map(|(number, keys)| Layer::from_keys(keys, number, folder, around))
            .collect::<Result<_, _>>()?;
        let (mut inclusions, mut estimated) = (Vec::new(), Vec::new());
        for (number, keys) in keys.tables("inclusion")?.iter().enumerate() {
            match EstimatedInclusion::from_keys(keys, "inclusion", number)? {
                Some(own) => estimated.push(own),
                None => inclusions.push(Inclusion::from_keys(keys, number, folder)?),
            }
        }
        let mut key = "layer";
        for (number, keys) in keys.tables("region")?.iter().enumerate() {
            if let Some(own) = EstimatedInclusion::from_keys(keys, "region", number)? {
                estimated.push(own);
                continue;
            }
            let BodyPart {
                name,
                place,
                content,
                key: shape,
            } = BodyPart::from_keys(keys, number, folder)?;
            match place {
                PartPlace::Layer(thickness_m) => {
                    let PartContent::Tissue(tissue) = content else {
                        return Err(keys.invalid("cavity", "a tissue, as a layer is of one"));
                    };
                    key = "region";
                    layers.push(Layer {
                        name,
                        thickness_m,
                        tissue,
                        perforation_force_n: None,
                        toughness_j_per_m2: None,
                    });
                }
                PartPlace::Inclusion(place) => inclusions.push(Inclusion {
                    name,
                    place,
                    content,
                }),
                PartPlace::Label(_) | PartPlace::Group(_) => {
                    return Err(keys.invalid(
                    shape,
                    "`surface = \"file.stl\"` or another shape, for the mesh of an organ is a surface, which has no numbered \
                     regions",
                ));
                }
            }
        }
        if layers.len() > Event::OPENS_LAYER.len() {
            return Err(keys.invalid(key, "at most 6 layers: a session has an event for each"));
        }
        Ok(Self {
            layers,
            inclusions,
            estimated,
        })
    }
}

/// Rejects the cavities of an organ, for a model that has none.
pub(super) fn refuse_cavities(organ: &Keys<'_>) -> Result<(), Error> {
    for key in ["inclusion", "region"] {
        for part in organ.tables(key)? {
            part.refuse(
                "cavity",
                "a tissue, for only `model.kind = \"nonlinear\"` has cavities",
            )?;
        }
    }
    Ok(())
}

impl Layer {
    /// The keys of a layer: name, thickness and tissue, then those for cutting.
    pub const KEYS: &'static [Key] = &[
        Key::text("name", "What people call it.").optional("\"circular muscle\"", "its number"),
        Key::number("thickness_m", Domain::LENGTH, "Its thickness.").required("0.0008"),
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1].optional("\"pig-liver\"", "that of the organ"),
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

    /// Of an organ of tissue `around`, which a layer without a tissue of its own has too.
    fn from_keys(
        keys: &Keys<'_>,
        number: usize,
        folder: &Path,
        around: &TissueChoice,
    ) -> Result<Self, Error> {
        let name = keys.text("name")?;
        let has_own = keys.contains("tissue") || keys.contains("builtin_tissue");
        Ok(Self {
            name: name.unwrap_or_else(|| format!("layer {}", number + 1)),
            thickness_m: keys.required_number("thickness_m")?,
            tissue: match has_own {
                true => TissueChoice::from_keys(keys, folder)?,
                false => around.clone(),
            },
            perforation_force_n: keys.number("perforation_force_n")?,
            toughness_j_per_m2: keys.number("toughness_j_per_m2")?,
        })
    }
}
