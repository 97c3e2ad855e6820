use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use palpate_files::StoredResponse;
use palpate_mechanics::boundary_elements::{BoundaryProblem, Panel, Progress as Solving, Stage};
use palpate_mechanics::surface_response::{ResponseParts, SurfaceResponse, TouchableTriangle};

use super::key::Ingredients;
use crate::{Error, Progress, Resources, Work};

/// Where the response of `ingredients` is stored, or would be.
fn place(ingredients: &Ingredients<'_>, resources: &Resources) -> Option<PathBuf> {
    let folder = resources.responses.as_ref()?;
    // A quarter of the digits is enough to tell files apart; the whole key stands in them.
    Some(folder.join(format!("{}.response", &ingredients.key()[..16])))
}

/// A response, where it came from, and what deserves doubt.
pub(super) struct Found {
    pub(super) response: SurfaceResponse,
    /// The file that holds it.
    pub(super) file: Option<PathBuf>,
    /// Whether it was read.
    pub(super) was_kept: bool,
    pub(super) doubts: Vec<String>,
}

/// The response of a surface, read if it is stored, or else solved and stored.
pub(super) fn response(
    ingredients: &Ingredients<'_>,
    resources: &Resources,
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Found, Error> {
    let mut file = place(ingredients, resources);
    let mut doubts = Vec::new();
    if let Some(place) = file.as_ref().filter(|place| place.exists()) {
        tell(watch, Work::Reading)?;
        match read(ingredients, place) {
            Ok(response) => {
                return Ok(Found {
                    response,
                    file,
                    was_kept: true,
                    doubts,
                });
            }
            // It is made again, in its place.
            Err(error) => doubts.push(format!("{error} (done just now)")),
        }
    }
    let problem = BoundaryProblem {
        surface: ingredients.surface,
        poissons_ratio: ingredients.poissons_ratio,
        held: ingredients.held,
        touchable: ingredients.touchable,
    };
    let response = problem.solve(resources.memory, &mut |solving| watch(of_stage(solving)))?;
    if let Some(place) = &file {
        tell(watch, Work::Storing)?;
        if let Err(error) = store(ingredients, &response, place) {
            doubts.push(format!("the organ's response is not kept: {error}"));
            file = None;
        }
    }
    Ok(Found {
        response,
        file,
        was_kept: false,
        doubts,
    })
}

fn tell(watch: &mut dyn FnMut(Progress) -> ControlFlow<()>, work: Work) -> Result<(), Error> {
    match watch(Progress { work, part: 0.0 }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(palpate_mechanics::Error::BrokenOff.into()),
    }
}

fn of_stage(solving: Solving) -> Progress {
    let work = match solving.stage {
        Stage::Assembly => Work::Influences,
        Stage::Factors => Work::Factors,
        Stage::Columns => Work::Responses,
    };
    Progress {
        work,
        part: solving.part,
    }
}

fn read(ingredients: &Ingredients<'_>, place: &Path) -> Result<SurfaceResponse, Error> {
    let stored = StoredResponse::read(place)?;
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
    let mesh = ingredients.surface.mesh();
    let touchable = ingredients.touchable.iter().filter_map(|&triangle| {
        let panel = Panel::new(mesh.positions(triangle))?;
        Some(TouchableTriangle {
            triangle,
            centroid: panel.centroid,
            normal: panel.normal,
            area: panel.area,
        })
    });
    Ok(SurfaceResponse::new(ResponseParts {
        poissons_ratio: ingredients.poissons_ratio,
        touchable: touchable.collect(),
        triangles: stored.triangles,
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
            "palpate {}, boundary elements, {} triangles of which {} can be touched, Poisson's ratio {}",
            env!("CARGO_PKG_VERSION"),
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
