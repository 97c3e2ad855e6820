//! Points of a solid whose displacement is requested.

use palpate_files::quantity::rounded;
use palpate_geometry::{AabbTree, Surface};
use palpate_mechanics::Vec3;
use palpate_mechanics::finite_elements::solid::Body;

use super::super::super::problem::{Point, Solid};
use super::super::figures::PointFigures;
use crate::solve::table::Table;

/// A point farther outside of the body than this gets a warning [parts of its longest extent]; a nearer one is as
/// good as on its surface.
const OFF: f64 = 0.01;

/// Positions of the points in the body [m], and warnings.
pub(super) fn places(case: &Solid, body: &Body) -> (Vec<Vec3>, Vec<String>) {
    let mut warnings = Vec::new();
    let filled;
    let surface = match body {
        Body::Surface(surface) => Some(surface),
        Body::Volume(mesh) if case.points.iter().any(|point| point.is_nearest) => {
            // Where the boundary of a body is no surface, the solver rejects points far outside.
            filled = mesh.boundary_surface().ok();
            filled.as_ref()
        }
        Body::Volume(_) => None,
    };
    let tree = surface.map(|surface: &Surface| AabbTree::new(surface.mesh()));
    let (low, high) = body.bounds();
    let places = case.points.iter().map(|point| {
        let (Some(surface), Some(tree), true) = (surface, &tree, point.is_nearest) else {
            return point.at;
        };
        let (nearest, outside) = surface.signed_distance(tree, &point.at);
        if outside <= 0.0 {
            return point.at;
        }
        if outside > OFF * (high - low).max() {
            warnings.push(format!(
                "{}: `{}` is {} m outside of the body; its displacement is that of the nearest point of the surface",
                point.place,
                point.key,
                rounded(outside, 3)
            ));
        }
        nearest.on.position
    });
    let places = places.collect();
    (places, warnings)
}

/// Displacements of the points at these positions [m].
pub(super) fn figures(case: &Solid, at: &[Vec3], moved: &[Vec3]) -> Vec<PointFigures> {
    let each = case.points.iter().zip(at).zip(moved);
    each.map(|((point, at), moved)| figures_of(point, at, moved))
        .collect()
}

fn figures_of(point: &Point, at: &Vec3, moved: &Vec3) -> PointFigures {
    PointFigures {
        name: point.name.clone(),
        at_m: (*at).into(),
        displacement_m: (*moved).into(),
        measured_m: point.measured.map(|(_, way)| way),
        error_m: point.measured.map(|(along, way)| moved.dot(&along) - way),
    }
}

pub(super) fn table(points: &[PointFigures]) -> Table {
    let each = |axis: usize| {
        points
            .iter()
            .map(move |point| 1e3 * point.displacement_m[axis])
    };
    let table = Table::default()
        .with_texts("point", points.iter().map(|point| point.name.clone()))
        .with("moves: x [mm]", each(0))
        .with("y [mm]", each(1))
        .with("z [mm]", each(2));
    if points.iter().all(|point| point.measured_m.is_none()) {
        return table;
    }
    let number =
        |value: Option<f64>| value.map_or("–".to_owned(), |value| rounded(1e3 * value, 4));
    table
        .with_texts(
            "measured [mm]",
            points.iter().map(|point| number(point.measured_m)),
        )
        .with_texts(
            "off by [mm]",
            points.iter().map(|point| number(point.error_m)),
        )
}
