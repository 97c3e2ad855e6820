//! The geometry of the layers and inclusions of a scene.

use palpate_files::scene::{Inclusion, InclusionPlace, Layer, Shape};
use palpate_geometry::{AabbTree, Surface};
use palpate_mechanics::regions::{RegionError, RegionMap, RegionPlace};

use crate::{Error, read_organ};

/// The shape of an inclusion, whose file is read if it has one, and warnings.
///
/// # Errors
/// When the file cannot be read or has no closed surface.
pub fn read_inclusion(inclusion: &InclusionPlace) -> Result<(RegionPlace, Vec<String>), Error> {
    match inclusion {
        InclusionPlace::Shape(shape) => Ok((RegionPlace::Shape(*shape), Vec::new())),
        InclusionPlace::Mesh { path, unit } => {
            let (path, unit) = (path.clone(), *unit);
            let (surface, warnings) = read_organ(&Shape::Mesh { path, unit })?;
            Ok((RegionPlace::Enclosed(surface.into()), warnings))
        }
    }
}

/// The geometry of the effective `layers` and the `inclusions` of a body with this surface and its tree, in this order;
/// and warnings.
pub(crate) fn read_regions(
    layers: &[Layer],
    inclusions: &[Inclusion],
    surface: &Surface,
    tree: &AabbTree,
) -> Result<(RegionMap, Vec<String>), Error> {
    let mut places: Vec<RegionPlace> = layers
        .iter()
        .map(|layer| RegionPlace::Layer(layer.thickness_m))
        .collect();
    let mut warnings = Vec::new();
    for inclusion in inclusions {
        let (place, more) = read_inclusion(&inclusion.place)?;
        places.push(place);
        warnings.extend(more);
    }
    let map = RegionMap::new(surface, tree, places);
    let map = map.map_err(|error| refused(error, inclusions, layers.len()))?;
    Ok((map, warnings))
}

/// The error with the names of the inclusions.
fn refused(error: RegionError, inclusions: &[Inclusion], layers: usize) -> Error {
    let name = |region: usize| inclusions[region - layers].name.clone();
    match error {
        RegionError::Outside { region, outside } => Error::InclusionOutside {
            name: name(region),
            outside,
        },
        RegionError::Overlap {
            regions: [one, other],
        } => Error::InclusionsOverlap {
            one: name(one),
            other: name(other),
        },
        other => palpate_mechanics::Error::from(other).into(),
    }
}
