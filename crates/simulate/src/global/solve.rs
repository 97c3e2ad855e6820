use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use palpate_files::StoredResponse;
use palpate_mechanics::boundary_elements::{BoundaryProblem, Progress as Solving, Stage};
use palpate_mechanics::finite_elements::condensed::CondensedProblem;
use palpate_mechanics::surface_response::{
    ResponseParts, Sampling, SurfaceResponse, TouchableTriangle,
};

use super::key::Ingredients;
use super::method::Method;
use crate::preparation::tell;
use crate::{Error, Progress, Resources, Work};

/// Where the response of `ingredients` is stored, or would be.
fn place(ingredients: &Ingredients<'_>, resources: &Resources) -> Option<PathBuf> {
    let folder = resources.responses.as_ref()?;
    // A quarter of the digits is enough to tell files apart; the whole key stands in them.
    Some(folder.join(format!("{}.response", &ingredients.key()[..16])))
}

/// A response, where it came from, and warnings.
pub(super) struct Found {
    pub(super) response: SurfaceResponse,
    /// The file that holds it.
    pub(super) file: Option<PathBuf>,
    /// Whether it was read.
    pub(super) was_kept: bool,
    pub(super) warnings: Vec<String>,
}

/// The response of a surface, read if it is stored, or else solved and stored.
pub(super) fn response(
    ingredients: &Ingredients<'_>,
    resources: &Resources,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Found, Error> {
    let mut file = place(ingredients, resources);
    let mut warnings = Vec::new();
    if let Some(place) = file.as_ref().filter(|place| place.exists()) {
        tell(watch, Progress::begin(Work::Reading))?;
        match read(ingredients, place, resources.memory) {
            Ok(response) => {
                return Ok(Found {
                    response,
                    file,
                    was_kept: true,
                    warnings,
                });
            }
            // It is made again, in its place.
            Err(error) => warnings.push(format!("{error} (done just now)")),
        }
    }
    let response = solve(ingredients, resources.memory, watch)?;
    if let Some(place) = &file {
        tell(watch, Progress::begin(Work::Storing))?;
        if let Err(error) = store(ingredients, &response, place) {
            warnings.push(format!("the organ's response is not cached: {error}"));
            file = None;
        }
    }
    Ok(Found {
        response,
        file,
        was_kept: false,
        warnings,
    })
}

/// The response, solved.
pub(super) fn solve(
    ingredients: &Ingredients<'_>,
    memory: usize,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<SurfaceResponse, Error> {
    let &Ingredients {
        surface,
        poissons_ratio,
        held,
        touchable,
        method,
        regions,
    } = ingredients;
    let mut watch = |solving| watch(of_stage(solving, method));
    let response = match method {
        Method::BoundaryElements => BoundaryProblem {
            surface,
            poissons_ratio,
            held,
            touchable,
        }
        .solve(memory, &mut watch),
        Method::FiniteElements { edge } => CondensedProblem {
            surface,
            poissons_ratio,
            held,
            touchable,
            edge,
            regions,
        }
        .solve(memory, &mut watch),
    };
    Ok(response?)
}

fn of_stage(solving: Solving, method: Method) -> Progress {
    let work = match (solving.stage, method) {
        (Stage::Assembly, Method::BoundaryElements) => Work::Influences,
        (Stage::Assembly, Method::FiniteElements { .. }) => Work::Tetrahedra,
        (Stage::Factors, _) => Work::Factors,
        (Stage::Columns, _) => Work::Responses,
    };
    Progress {
        work,
        part: solving.part,
    }
}

fn read(
    ingredients: &Ingredients<'_>,
    place: &Path,
    memory: usize,
) -> Result<SurfaceResponse, Error> {
    let stored = StoredResponse::read(place, memory)?;
    let same = stored
        .touchable
        .iter()
        .copied()
        .eq(ingredients.touchable.iter().map(|t| t.0));
    if stored.key != ingredients.key() || !same {
        return Err(Error::OtherResponse {
            path: place.to_owned(),
        });
    }
    let of = |&triangle| TouchableTriangle::of(ingredients.surface, triangle);
    Ok(SurfaceResponse::new(ResponseParts {
        poissons_ratio: ingredients.poissons_ratio,
        touchable: ingredients.touchable.iter().filter_map(of).collect(),
        held: ingredients.held.to_vec(),
        triangles: stored.triangles,
        sampling: match ingredients.method {
            Method::BoundaryElements => Sampling::Centroids,
            Method::FiniteElements { .. } => Sampling::Means,
        },
        displacements: stored.displacements.into_owned(),
    })?)
}

fn store(
    ingredients: &Ingredients<'_>,
    solved: &SurfaceResponse,
    place: &Path,
) -> Result<(), Error> {
    let parts = solved.parts();
    if let Some(folder) = place.parent() {
        // What goes wrong here is told by the writing, with the same name.
        let _ = std::fs::create_dir_all(folder);
    }
    let stored = StoredResponse {
        key: ingredients.key(),
        made_by: format!(
            "palpate {}, {}, {} triangles of which {} can be touched, Poisson's ratio {}",
            env!("CARGO_PKG_VERSION"),
            ingredients.method.words(),
            parts.triangles,
            parts.touchable.len(),
            parts.poissons_ratio,
        ),
        touchable: ingredients.touchable.iter().map(|t| t.0).collect(),
        triangles: parts.triangles,
        displacements: parts.displacements.as_slice().into(),
    };
    Ok(stored.write(place)?)
}
