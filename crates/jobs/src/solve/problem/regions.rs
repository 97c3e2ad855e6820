//! Parts of a solid with a tissue of their own.

use std::path::Path;

use palpate_files::scene::{
    BodyPart, CavityContent, Inclusion, Layer, PartContent, PartPlace, TissueChoice,
};
use palpate_files::tissue::LawName;
use palpate_files::{Error, Key, Keys, Place, Tissue};
use palpate_mechanics::Material;

use crate::Error as JobError;

/// A part of a solid.
#[derive(Debug, Clone)]
pub(crate) struct SolidPart {
    pub(crate) name: String,
    pub(crate) place: PartPlace,
    pub(crate) content: SolidContent,
    /// Its place in the document, and the full name of the key of its location.
    pub(crate) found_at: Place,
    pub(crate) key: String,
}

/// The material of a part of a solid.
#[derive(Debug, Clone)]
pub(crate) enum SolidContent {
    Tissue(Box<(Tissue, Material)>),
    Cavity(CavityContent),
}

impl SolidPart {
    /// Its tissue, none of a cavity.
    pub(crate) fn tissue(&self) -> Option<&Tissue> {
        match &self.content {
            SolidContent::Tissue(tissue) => Some(&tissue.0),
            SolidContent::Cavity(_) => None,
        }
    }

    /// Whether it is a cavity whose pressure loads the body.
    pub(super) fn presses(&self) -> bool {
        match &self.content {
            SolidContent::Cavity(content) => content.own_pressure() != 0.0,
            SolidContent::Tissue(_) => false,
        }
    }
}

/// The tables of a problem that name parts.
pub(super) const KEYS: [Key; 3] = [
    Key::tables(
        "region",
        BodyPart::OF_VOLUME,
        "Parts with a tissue of their own, and cavities: layers, shapes inside such as a tumour or a vessel, and regions of a volume mesh. \
         Shapes are above layers, and these above regions of the mesh. What is in none of them is of `tissue`. Tetrahedra do \
         not cross their borders.",
    )
    .optional("", "it is of one tissue"),
    Key::tables(
        "layer",
        LAYER,
        "Layers from the outer surface inwards, outside of those of `region`.",
    )
    .optional("", "none"),
    Key::tables("inclusion", Inclusion::KEYS, "Shapes inside, as in `region`.").optional("", "none"),
];

const LAYER: &[Key] = &[
    Layer::KEYS[0],
    Layer::KEYS[1],
    TissueChoice::KEYS[0],
    TissueChoice::KEYS[1],
];

/// The parts of a problem, layers first, whose body is of `law`.
pub(super) fn from_keys(
    keys: &Keys<'_>,
    folder: &Path,
    law: LawName,
) -> Result<Vec<SolidPart>, JobError> {
    let mut parts = Vec::new();
    for (number, keys) in keys.tables("layer")?.iter().enumerate() {
        let name = keys.text("name")?;
        let name = name.unwrap_or_else(|| format!("layer {}", number + 1));
        let place = PartPlace::Layer(keys.required_number("thickness_m")?);
        let tissue = TissueChoice::from_keys(keys, folder)?.read()?;
        let content = tissue_of(keys, tissue, law)?;
        parts.push(part(keys, "thickness_m", name, place, content));
    }
    for (number, keys) in keys.tables("inclusion")?.iter().enumerate() {
        let inclusion = Inclusion::from_keys(keys, number, folder)?;
        let shapes = ["ball", "ellipsoid", "capsule", "mesh"];
        let key = shapes.into_iter().find(|key| keys.contains(key));
        let place = PartPlace::Inclusion(inclusion.place);
        let content = content_of(keys, inclusion.content, law)?;
        let key = key.unwrap_or("name");
        parts.push(part(keys, key, inclusion.name, place, content));
    }
    for (number, keys) in keys.tables("region")?.iter().enumerate() {
        let found = BodyPart::from_keys(keys, number, folder)?;
        let content = content_of(keys, found.content, law)?;
        parts.push(part(keys, found.key, found.name, found.place, content));
    }
    Ok(parts)
}

fn part(
    keys: &Keys<'_>,
    key: &'static str,
    name: String,
    place: PartPlace,
    content: SolidContent,
) -> SolidPart {
    SolidPart {
        name,
        place,
        content,
        found_at: keys.place_of_key(key),
        key: keys.full_name(key),
    }
}

/// The material of a part of a body of `law`.
fn content_of(
    keys: &Keys<'_>,
    content: PartContent,
    law: LawName,
) -> Result<SolidContent, JobError> {
    match content {
        PartContent::Tissue(tissue) => tissue_of(keys, tissue.read()?, law),
        PartContent::Cavity(content) => Ok(SolidContent::Cavity(content)),
    }
}

/// The tissue of a part of a body of `law`.
fn tissue_of(keys: &Keys<'_>, tissue: Tissue, law: LawName) -> Result<SolidContent, JobError> {
    let is_small = |law| law == LawName::Linear;
    let found = tissue.elasticity.law();
    if is_small(found) != is_small(law) {
        let expected = match is_small(law) {
            true => "a linear law, as that of the body: it is for small strain",
            false => "a law for large strain, as that of the body",
        };
        let key = match keys.contains("tissue") {
            true => "tissue",
            false => "builtin_tissue",
        };
        return Err(Error::BadValue {
            place: keys.place_of_key(key),
            key: keys.full_name(key),
            found: found.to_string(),
            expected: expected.into(),
        }
        .into());
    }
    let material = Material::from_tissue(&tissue)?;
    Ok(SolidContent::Tissue(Box::new((tissue, material))))
}
