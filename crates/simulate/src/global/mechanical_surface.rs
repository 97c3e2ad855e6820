use palpate_geometry::{SimplifySettings, Surface, simplify};

use crate::Error;

/// A mesh of at most so many triangles carries its own mechanics.
const MOST_OF_ITS_OWN: usize = 6_000;

/// So many are made of a finer one.
const OF_A_FINER_ONE: usize = 4_000;

/// The surface that carries the mechanics of `shown`: itself, or one of at most `wanted` triangles; with
/// what deserves doubt.
pub(super) fn mechanical_surface(
    shown: &Surface,
    wanted: Option<usize>,
) -> Result<(Surface, Vec<String>), Error> {
    let triangles = shown.mesh().triangles().len();
    if triangles <= wanted.unwrap_or(MOST_OF_ITS_OWN) {
        return Ok((shown.clone(), Vec::new()));
    }
    let wanted = wanted.unwrap_or(OF_A_FINER_ONE);
    let coarse = simplify(shown.mesh(), &SimplifySettings::to(wanted))?;
    let mut doubts = Vec::new();
    if coarse.self_intersections > 0 {
        doubts.push(format!(
            "{} triangles of the mechanical mesh meet others; raise `model.mechanical_triangles` above {wanted}",
            coarse.self_intersections
        ));
    }
    let surface = Surface::new(coarse.mesh).map_err(Error::MechanicalMesh)?;
    Ok((surface, doubts))
}
