//! Parts of a solid with a tissue of their own.

use std::path::Path;

use palpate_files::scene::{BodyPart, Inclusion, Layer, PartPlace, TissueChoice};
use palpate_files::tissue::LawName;
use palpate_files::{Error, Key, Keys, Place, Tissue};
use palpate_mechanics::Material;

use crate::Error as JobError;

/// A part of a solid.
#[derive(Debug, Clone)]
pub(crate) struct SolidPart {
    pub(crate) name: String,
    pub(crate) place: PartPlace,
    pub(crate) tissue: Tissue,
    pub(crate) material: Material,
    /// Where it is in the document, and the full name of the key that says where it lies.
    pub(crate) found_at: Place,
    pub(crate) key: String,
}

/// The tables of a problem that name parts.
pub(super) const KEYS: [Key; 3] = [
    Key::tables(
        "region",
        BodyPart::OF_VOLUME,
        "Parts with a tissue of their own: layers, shapes inside such as a tumour or a vessel, and regions of a volume mesh. \
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
    Layer::KEYS[2],
    Layer::KEYS[3],
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
        parts.push(part((keys, "thickness_m"), name, place, (tissue, law))?);
    }
    for (number, keys) in keys.tables("inclusion")?.iter().enumerate() {
        let inclusion = Inclusion::from_keys(keys, number, folder)?;
        let shapes = ["ball", "ellipsoid", "capsule", "mesh"];
        let key = shapes.into_iter().find(|key| keys.contains(key));
        let place = PartPlace::Inclusion(inclusion.place);
        let tissue = inclusion.tissue.read()?;
        let key = key.unwrap_or("name");
        parts.push(part((keys, key), inclusion.name, place, (tissue, law))?);
    }
    for (number, keys) in keys.tables("region")?.iter().enumerate() {
        let part_of_file = BodyPart::from_keys(keys, number, folder)?;
        let tissue = part_of_file.tissue.read()?;
        let key = (keys, part_of_file.key);
        parts.push(part(
            key,
            part_of_file.name,
            part_of_file.place,
            (tissue, law),
        )?);
    }
    Ok(parts)
}

fn part(
    (keys, key): (&Keys<'_>, &'static str),
    name: String,
    place: PartPlace,
    (tissue, law): (Tissue, LawName),
) -> Result<SolidPart, JobError> {
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
    Ok(SolidPart {
        name,
        place,
        material: Material::from_tissue(&tissue)?,
        tissue,
        found_at: keys.place_of_key(key),
        key: keys.full_name(key),
    })
}
