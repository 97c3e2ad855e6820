//! Compliance of the organ around each contact of the local model, beyond a half-space.
//!
//! The particles reach a few tip radii. The effects of the organ's size, anchor and curvature act over a distance, and
//! are smooth over its surface: boundary elements of a few hundred triangles resolve them, and where walls are too thin
//! for these, some thousand tetrahedra.

use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::Matrix3;
use palpate_files::Scene;
use palpate_files::scene::{ResponseMethod, Smoothing};
use palpate_geometry::{AabbTree, Surface};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::enhance::Interpolation;
use palpate_mechanics::surface_response::TipField;

use super::key::Ingredients;
use super::mechanical_surface::mechanical_surface;
use super::method::Method;
use super::solve::solve;
use super::{centroid, fixed_region};
use crate::Error;
use crate::tool::Tool;
use crate::walls::Walls;

/// Number of mechanical triangles: on a cube, it makes the force under a tip 1 % too small, and 300 triangles 2 %.
const TRIANGLES: usize = 500;

/// More tetrahedra would take longer than acceptable for this model: some seconds.
const MAX_TETRAHEDRA: f64 = 5_000.0;

/// Gives every tool the compliance of the organ of `scene` beyond a half-space; the organ is displayed as `shown`;
/// returns a warning.
pub(crate) fn surround(
    tools: &mut [Tool],
    scene: &Scene,
    shown: &Surface,
    law: &LinearElastic,
    memory: usize,
) -> Result<Option<String>, Error> {
    let (surface, _) = mechanical_surface(shown, Some(TRIANGLES))?;
    let anchor = fixed_region(&scene.organ.shape, scene.organ.anchor.as_ref());
    let mesh = surface.mesh();
    let (fixed, free): (Vec<_>, Vec<_>) = mesh
        .triangle_ids()
        .partition(|&triangle| anchor.contains(centroid(&surface, triangle)));
    let walls = Walls::new(&surface, &free);
    let by = |method| {
        let ingredients = Ingredients {
            surface: &surface,
            poissons_ratio: law.poissons_ratio(),
            fixed: &fixed,
            touchable: &free,
            method,
            regions: None,
        };
        solve(&ingredients, memory, &mut |_| ControlFlow::Continue(()))
    };
    let finite = Method::finite(
        ResponseMethod::Automatic,
        false,
        &surface,
        &walls,
        MAX_TETRAHEDRA,
    );
    let finite = finite.into_iter().find_map(|method| by(method).ok());
    let (response, warning) = match finite {
        Some(response) => (response, None),
        None => {
            let instead = "set `model.kind` to \"hybrid\" or \"nonlinear\"";
            (by(Method::BoundaryElements)?, walls.warning(instead))
        }
    };
    let tree = AabbTree::new(mesh);
    let interpolation = Interpolation::new(surface.clone(), Smoothing::None);
    let places: Vec<_> = shown
        .mesh()
        .vertices()
        .iter()
        .zip(shown.vertex_normals())
        .map(|(place, normal)| interpolation.nearest_facing(&tree, place, normal))
        .collect();
    let mut known: Vec<(f64, Arc<[Matrix3<f64>]>)> = Vec::new();
    for tool in tools {
        let radius = tool.typical_radius;
        let same = known.iter().find(|(of, _)| *of == radius);
        let further = if let Some((_, further)) = same {
            further.clone()
        } else {
            let field = TipField::new(&response, &surface, radius)?;
            let at = places.iter().map(|at| {
                let load = field.at(&surface, at.triangle, &at.barycentric);
                load.structural_compliance()
            });
            let further: Arc<[_]> = at.collect();
            known.push((radius, further.clone()));
            further
        };
        tool.structural_compliance = Some(further);
    }
    Ok(warning)
}
