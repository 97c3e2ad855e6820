//! The tetrahedra of a body: a mesh with all of its walls, made coarser.

use std::ops::ControlFlow;

use palpate_geometry::{
    FillSettings, Surface, TetrahedronError, TetrahedronMesh, Vec3, coarsen_with_progress, fill,
    refine_to,
};

use crate::Error;
use crate::regions::Regions;
use crate::walls::Thickness;

/// Tetrahedra of the first mesh per requested node, and the factor by which their number grows if walls are lost.
const TETRAHEDRA_PER_NODE: usize = 8;
const MORE: usize = 3;

/// Length of the edges before coarsening, relative to the final ones [-].
const OF_EDGE: f64 = 0.6;

/// Where a body is thinner than this number of edges, they are shorter in proportion [-], by a factor of
/// [`MAX_GRADED`] at most: rims and lobes bend within their thickness. With twice as much grading the bulk becomes too
/// coarse for a tip. A body that is a wall of one element is not graded, nor are neighbours, whose short edges at a rim
/// fold where a stiffer organ presses on them.
const THIN: f64 = 3.0;
const MAX_GRADED: f64 = 3.0;

/// Part of the work before edges collapse [-].
const BEFORE_COLLAPSES: f64 = 0.3;

/// Number of attempts.
const FILLINGS: usize = 5;

/// A mesh of about `wanted` tetrahedra, or of more if walls are lost. If it has other holes than `surface`, for example
/// across a thin wall, one finer mesh is tried.
fn filled(surface: &Surface, mut wanted: usize) -> Result<TetrahedronMesh, TetrahedronError> {
    let of = |wanted| {
        fill(
            surface,
            &FillSettings::with_tetrahedron_count(surface, wanted),
        )
    };
    let mut filling = of(wanted);
    for _ in 1..FILLINGS {
        if filling.is_ok() {
            break;
        }
        wanted *= MORE;
        filling = of(wanted);
    }
    let is_faithful = |mesh: &TetrahedronMesh| has_topology_of(surface, mesh);
    if filling.as_ref().is_ok_and(|mesh| !is_faithful(mesh)) {
        let finer = of(MORE * wanted);
        if finer.as_ref().is_ok_and(is_faithful) {
            return finer;
        }
    }
    filling
}

/// Whether the boundary of `filling` is a closed surface with the Euler characteristic of `surface`.
fn has_topology_of(surface: &Surface, filling: &TetrahedronMesh) -> bool {
    let euler = |of: &Surface| {
        let mesh = of.mesh();
        2 * mesh.vertices().len() as i64 - mesh.triangles().len() as i64
    };
    filling
        .boundary_surface()
        .is_ok_and(|boundary| euler(&boundary) == euler(surface))
}

/// The factor by which edges are shorter where the body within `surface` is thin, if it has so many nodes [-].
pub(super) fn grading(surface: &Surface, nodes: usize) -> impl Fn(&Vec3) -> f64 {
    let edge = FillSettings::with_tetrahedron_count(surface, nodes).edge;
    let thickness = Thickness::new(surface);
    let is_wall = thickness.typical() < edge;
    move |place| match is_wall {
        true => 1.0,
        false => (THIN * edge / thickness.at(place)).clamp(1.0, MAX_GRADED),
    }
}

/// A mesh of about so many nodes in the body within `surface`: it has all of its walls and is made coarser; its edges
/// are shorter at inclusions, and by the factor `finer` [-]. Its regions are cavities, and there are warnings.
/// `on_progress` receives the completed part [-], and may cancel.
pub(super) fn tetrahedra(
    surface: &Surface,
    nodes: usize,
    regions: &Regions,
    finer: impl Fn(&Vec3) -> f64,
    on_progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(TetrahedronMesh, Vec<String>), Error> {
    let edge = FillSettings::with_tetrahedron_count(surface, nodes).edge;
    let longest = |place: &Vec3| regions.longest_edge(place).min(edge);
    let mut filling = filled(surface, TETRAHEDRA_PER_NODE * nodes);
    if regions.has_inclusions() {
        filling = filling
            .and_then(|coarse| refine_to(&coarse, Some(surface), |place| OF_EDGE * longest(place)));
    }
    let detail = |place: &Vec3| finer(place) * edge / longest(place);
    let mut on_progress = |part| on_progress(BEFORE_COLLAPSES + (1.0 - BEFORE_COLLAPSES) * part);
    let mesh = filling
        .and_then(|fine| coarsen_with_progress(&fine, surface, nodes, detail, &mut on_progress));
    if let Err(TetrahedronError::Cancelled) = mesh {
        return Err(palpate_mechanics::Error::Cancelled.into());
    }
    regions.with_cavities(mesh.map_err(palpate_mechanics::Error::from)?, surface)
}
