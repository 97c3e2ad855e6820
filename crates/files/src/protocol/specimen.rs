use std::path::Path;

use super::place::{self, MeasuredPlace, VirtualSurface};
use crate::recording::Condition;
use crate::scene::TissueChoice;
use crate::words::words;
use crate::{Domain, Error, Key, Keys};

words! {
    /// An organ whose forces were published.
    pub enum PublishedOrgan {
        /// Of pigs.
        Liver = "liver",
        /// Of pigs.
        Kidney = "kidney",
        /// Of pigs.
        Spleen = "spleen",
        /// Of pigs.
        Esophagus = "esophagus",
    }
}

/// The specimen under the indenter of a virtual device.
#[derive(Debug, Clone, PartialEq)]
pub enum MeasuredTissue {
    /// A wide and deep piece of a tissue.
    Tissue(TissueChoice),
    /// The static response of table 5-1, and the relaxation of table 6-3.
    Published(PublishedOrgan),
    /// The specimen under a real sensor.
    Real,
}

/// A specimen.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Its material.
    pub tissue: MeasuredTissue,
    /// The organ, for its recordings.
    pub organ: Option<String>,
    /// The animal, person or body.
    pub subject: Option<String>,
    /// The subject's weight [kg].
    pub weight_kg: Option<f64>,
    /// The place on the organ.
    pub site: Option<String>,
    /// The state of the tissue.
    pub condition: Option<Condition>,
    /// Whether a heart beats in it and breath moves it.
    pub alive: bool,
    /// How much stiffer than its tissue it is [-].
    pub factor: f64,
    /// The radius, not the diameter, of the indenter [m].
    pub indenter_radius_m: f64,
    /// The indented location, and the direction.
    pub place: MeasuredPlace,
    /// The shape of a virtual one.
    pub surface: VirtualSurface,
}

impl Measured {
    pub(super) const KEYS: &[Key] = &[
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1],
        Key::word(
            "published",
            PublishedOrgan::MEANINGS,
            "The organ of a pig that answers as it was published (tables 5-1 and 6-3), in place of a tissue.",
        )
        .optional("\"liver\"", "it is of its tissue"),
        Key::text("organ", "The organ, for its recordings.").optional("\"liver\"", "not said"),
        Key::label("subject", "The animal, person or body.").optional("\"pig-1\"", "not said"),
        Key::number("weight_kg", Domain::WEIGHT, "The subject's weight.")
            .optional("35.0", "not said"),
        Key::label("site", "The place on the organ.").optional("\"left lobe\"", "not said"),
        Key::word("condition", Condition::MEANINGS, "The state of the tissue.")
            .optional("\"ex_vivo\"", "not said"),
        Key::boolean("alive", "Whether a heart beats in it and breath moves it.").default("false"),
        Key::number("factor", Domain::FACTOR, "How much stiffer than its tissue it is.")
            .default("1.0"),
        Key::number(
            "indenter_radius_m",
            Domain::TIP_RADIUS,
            "The radius, not the diameter, of the indenter.",
        )
        .default("0.001"),
        Key::vector(
            "place_m",
            place::PLACE,
            "Where the indenter is moved before it approaches, from where the rig begins: x right, y away from the user, z up.",
        )
        .default("[0.0, 0.0, 0.0]"),
        Key::direction(
            "normal",
            "The direction out of the tissue, along which the indenter approaches, presses and withdraws; it leads up.",
        )
        .default("[0.0, 0.0, 1.0]"),
        Key::boolean(
            "measure_normal",
            "Whether the surface is touched around the place first, and the normal that is measured there taken.",
        )
        .default("false"),
        Key::direction(
            "surface_normal",
            "The normal of a virtual specimen's surface where the rig begins.",
        )
        .default("[0.0, 0.0, 1.0]"),
        Key::number(
            "surface_radius_m",
            Domain::LENGTH,
            "The radius of curvature of a virtual specimen's surface.",
        )
        .optional("0.05", "it is plane"),
    ];

    /// A specimen under a real sensor, which no document describes.
    pub(super) fn real_from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        const REAL: &str = "nothing: the specimen under a real force sensor is real";
        let of_virtual = [
            "tissue",
            "builtin_tissue",
            "published",
            "factor",
            "surface_normal",
            "surface_radius_m",
        ];
        of_virtual
            .iter()
            .try_for_each(|key| keys.refuse(key, REAL))?;
        Self::of(keys, MeasuredTissue::Real)
    }

    pub(super) fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let published = keys.word("published", PublishedOrgan::WORDS)?;
        let tissue = match published {
            Some(_) if keys.contains("tissue") => {
                return Err(keys.given_twice("published", "tissue"));
            }
            Some(_) if keys.contains("builtin_tissue") => {
                return Err(keys.given_twice("published", "builtin_tissue"));
            }
            Some(organ) => MeasuredTissue::Published(organ),
            None => MeasuredTissue::Tissue(TissueChoice::from_keys(keys, folder)?),
        };
        Self::of(keys, tissue)
    }

    fn of(keys: &Keys<'_>, tissue: MeasuredTissue) -> Result<Self, Error> {
        Ok(Self {
            tissue,
            organ: keys.text("organ")?,
            subject: keys.text_or_integer("subject")?,
            weight_kg: keys.number("weight_kg")?,
            site: keys.text_or_integer("site")?,
            condition: keys.word("condition", Condition::WORDS)?,
            alive: keys.boolean("alive")?.unwrap_or(false),
            factor: keys.number("factor")?.unwrap_or(1.0),
            indenter_radius_m: keys.number("indenter_radius_m")?.unwrap_or(0.001),
            place: MeasuredPlace::from_keys(keys)?,
            surface: VirtualSurface::from_keys(keys)?,
        })
    }
}
