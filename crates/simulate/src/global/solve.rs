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
use crate::preparation::report_progress;
use crate::{Error, Progress, Resources, Work};

/// The file for the stored response of `ingredients`, whether it exists or not.
fn place(ingredients: &Ingredients<'_>, resources: &Resources) -> Option<PathBuf> {
    let folder = resources.responses.as_ref()?;
    // A quarter of the digits is enough to distinguish files; the whole key is inside them.
    Some(folder.join(format!("{}.response", &ingredients.key()[..16])))
}

/// A response, its origin, and warnings.
pub(super) struct Found {
    pub(super) response: SurfaceResponse,
    /// The file that holds it.
    pub(super) file: Option<PathBuf>,
    /// Whether it was read.
    pub(super) was_cached: bool,
    pub(super) warnings: Vec<String>,
}

/// The response of a surface, read if it is stored, or else solved and stored.
pub(super) fn response(
    ingredients: &Ingredients<'_>,
    resources: &Resources,
    on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Found, Error> {
    let mut file = place(ingredients, resources);
    let mut warnings = Vec::new();
    if let Some(place) = file.as_ref().filter(|place| place.exists()) {
        report_progress(on_progress, Progress::begin(Work::Reading))?;
        match read(ingredients, place, resources.memory) {
            Ok(response) => {
                return Ok(Found {
                    response,
                    file,
                    was_cached: true,
                    warnings,
                });
            }
            // It is solved again and replaced.
            Err(error) => warnings.push(format!("{error} (done just now)")),
        }
    }
    let response = solve(ingredients, resources.memory, on_progress)?;
    if let Some(place) = &file {
        report_progress(on_progress, Progress::begin(Work::Storing))?;
        if let Err(error) = store(ingredients, &response, place) {
            warnings.push(format!("the organ's response is not cached: {error}"));
            file = None;
        }
    }
    Ok(Found {
        response,
        file,
        was_cached: false,
        warnings,
    })
}

/// Solves the response.
pub(super) fn solve(
    ingredients: &Ingredients<'_>,
    memory: usize,
    on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<SurfaceResponse, Error> {
    let &Ingredients {
        surface,
        poissons_ratio,
        fixed,
        touchable,
        method,
        regions,
    } = ingredients;
    let mut on_progress = |solving| on_progress(of_stage(solving, method));
    let response = match method {
        Method::BoundaryElements => BoundaryProblem {
            surface,
            poissons_ratio,
            fixed,
            touchable,
        }
        .solve(memory, &mut on_progress),
        Method::FiniteElements { edge } => CondensedProblem {
            surface,
            poissons_ratio,
            fixed,
            touchable,
            edge,
            regions,
        }
        .solve(memory, &mut on_progress),
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
        fixed: ingredients.fixed.to_vec(),
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
        // Writing reports any error here, with the same name.
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
