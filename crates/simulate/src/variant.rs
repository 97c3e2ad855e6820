//! Variants of a scene with random numbers.
//!
//! *How we know*: `variants::…`.

use palpate_files::Scene;
use palpate_files::scene::{OnSurface, SurfacePoint};
use palpate_geometry::{NodeId, Surface, Vec3};

use crate::{Error, organ};

/// The variant of a scene for a seed: the same seed gives the same scene, to the last bit. A scene without random
/// numbers is its only variant.
///
/// # Errors
/// When the organ or a neighbour cannot be read, a surface has no point in the random region, or a random value is
/// outside the domain of its key.
pub fn draw_variant(scene: &Scene, seed: u64) -> Result<Scene, Error> {
    let Some(draws) = &scene.draws else {
        return Ok(scene.clone());
    };
    if draws.surfaces().next().is_none() {
        return Ok(scene.drawn(seed, &|_, _| None)?);
    }
    // Bodies that are drawn themselves are those of the variant: their shapes need no surface.
    let sized = scene.drawn(seed, &|on, _| Some(on.middle()))?;
    let mut surfaces: Vec<(Option<usize>, Surface)> = Vec::new();
    for on in draws.surfaces() {
        if surfaces.iter().any(|(body, _)| *body == on.neighbour) {
            continue;
        }
        let (surface, _) = match on.neighbour.and_then(|number| sized.neighbours.get(number)) {
            Some(neighbour) => organ::read_neighbour(neighbour)?,
            None => organ::read_organ(&sized.organ.shape)?,
        };
        surfaces.push((on.neighbour, surface));
    }
    let find = |on: &OnSurface, numbers| {
        let (_, surface) = surfaces.iter().find(|(body, _)| *body == on.neighbour)?;
        point_on(surface, on, numbers)
    };
    Ok(scene.drawn(seed, &find)?)
}

/// A point of a part of a surface, even over its area: the first number chooses a triangle, the others a point of it.
fn point_on(surface: &Surface, on: &OnSurface, [which, u, v]: [f64; 3]) -> Option<SurfacePoint> {
    let mesh = surface.mesh();
    let corners = |nodes: &[NodeId; 3]| nodes.map(|node| mesh.vertices()[node.0 as usize]);
    let spanned = |[a, b, c]: &[Vec3; 3]| (b - a).cross(&(c - a));
    let mut total = 0.0;
    let mut sums = Vec::new();
    for nodes in mesh.triangles() {
        let corners = corners(nodes);
        let span = spanned(&corners);
        let area = span.norm();
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        if area > 0.0 && on.contains(middle.into(), (span / area).into()) {
            total += area;
            sums.push((total, corners));
        }
    }
    let wanted = which * total;
    let at = sums.partition_point(|(sum, _)| *sum <= wanted);
    let (_, corners) = sums.get(at).or(sums.last())?;
    let [a, b, c] = corners;
    // Folded back into the triangle, which is half of a parallelogram.
    let (u, v) = if u + v > 1.0 {
        (1.0 - u, 1.0 - v)
    } else {
        (u, v)
    };
    let point = a + (b - a) * u + (c - a) * v;
    let normal = spanned(corners).normalize();
    Some(SurfacePoint {
        point_m: point.into(),
        normal: normal.into(),
    })
}
