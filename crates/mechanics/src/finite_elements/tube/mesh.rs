//! The half of a tube between its middle (z = 0) and one end, in the half-plane (r, z).

use super::super::cavity::Cavity;
use super::super::graded::resampled;
use super::super::mesh::ElementMesh;
use super::Tube;

/// Places in the wall [-]: finer at both surfaces, whose corners with a fixed end concentrate
/// stress.
const WALL: [f64; 5] = [0.0, 0.15, 0.5, 0.85, 1.0];

/// The mesh and its inner wall, with `parts` elements [-] in the place of each along both directions.
pub(super) fn half(tube: &Tube, parts: f64) -> (ElementMesh, Cavity) {
    let (inner, wall) = (tube.inner_radius, tube.wall());
    let wall_places = resampled(&WALL, parts);
    let columns: Vec<f64> = wall_places.iter().map(|part| inner + part * wall).collect();
    let half = 0.5 * tube.length;
    let rows = from_the_end(half, 0.15 * wall, 1.7, 0.7 * tube.outer_radius);
    let rows = resampled(&rows, parts);
    let mesh = ElementMesh::grid(&columns, &rows, |r, z| [r, z]);
    let width = 2 * columns.len() - 1;
    let side = |j: usize| (0..3).map(|k| ((2 * j + k) * width) as u32).collect();
    let sides = (0..rows.len() - 1).map(side).collect();
    (mesh, Cavity { sides })
}

/// Places from 0 to `length` [m] whose intervals shrink, by the factor `growth`, from at most `longest`
/// to about `first` at the end.
pub(super) fn from_the_end(length: f64, first: f64, growth: f64, longest: f64) -> Vec<f64> {
    let (mut intervals, mut reach, mut next) = (Vec::new(), 0.0, first);
    // As many as need the least stretch.
    while intervals.is_empty() || length / reach > (reach + next) / length {
        intervals.push(next);
        reach += next;
        next = (growth * next).min(longest);
    }
    let stretch = length / reach;
    let mut at = length;
    let mut places: Vec<f64> = std::iter::once(length)
        .chain(intervals.iter().map(|interval| {
            at -= stretch * interval;
            at
        }))
        .collect();
    places.reverse();
    places[0] = 0.0;
    places
}
