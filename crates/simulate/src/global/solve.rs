use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_files::StoredResponse;
use palpate_geometry::{Surface, TriangleId};
use palpate_mechanics::boundary_elements::{self, BoundaryProblem, Stage};
use palpate_mechanics::surface_response::{ResponseParts, SurfaceResponse, TouchableTriangle};

use super::key::Ingredients;
use crate::{Error, Progress, Resources, Work};

/// The response of a surface, read if it is stored, or else solved and stored.
pub(super) fn response(
    ingredients: &Ingredients<'_>,
    resources: &Resources,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(SurfaceResponse, Vec<String>), Error> {
    let key = ingredients.key();
    let place = resources.responses.as_ref().map(|folder| folder.join(file_name(&key)));
    let mut doubts = Vec::new();
    if let Some(place) = place.as_ref().filter(|place| place.exists()) {
        tell(watch, Work::Reading, 0.0)?;
        match read(ingredients, &key, place) {
            Ok(found) => return Ok((found, doubts)),
            Err(error) => doubts.push(format!("{error}; it was solved anew")),
        }
    }
    let solved = solve(ingredients, resources, watch)?;
    if let Some(place) = place {
        tell(watch, Work::Storing, 1.0)?;
        store(&solved, key, &place)?;
    }
    Ok((solved, doubts))
}
