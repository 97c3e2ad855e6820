use std::f64::consts::{PI, TAU};

use super::description::PATIENT_AXES;
use super::revolved::{PARTS, Profile, Vec2, grid_size, grid_triangles};
use super::{AnchorPlane, OrganDescription};
use crate::{MeshError, TriangleMesh, Vec3};

/// Fewer, and the rims of the wall are lost.
pub(super) const MIN_TRIANGLES: usize = 400;

/// Length along the axis, from rim to rim.
const LENGTH: f64 = 0.06;
const HALF_WALL: f64 = 0.00125;
/// Radius of the middle of the wall, away from the ends.
const MIDDLE_RADIUS: f64 = 0.00625;
/// The axis is an arc: it leaves the diaphragm straight down and turns left.
const BEND_RADIUS: f64 = 0.17;
/// What the wall widens by at an end, and over which length that fades.
const HIATUS_FLARE: (f64, f64) = (0.001, 0.006);
const CARDIA_FLARE: (f64, f64) = (0.004, 0.008);
/// Length of each end that is fixed.
const HELD_LENGTH: f64 = 0.004;

/// Rows per radian of turn, against rows per radius of length: keeps the rims round.
const RIM_WEIGHT: f64 = 0.2;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The lower esophagus, from the diaphragm (top) to the stomach (bottom): a tube \
                  with a lumen that is open at both ends.",
        axes: PATIENT_AXES,
        origin: "on the axis of the lumen, half-way between the ends; there the axis is nearly \
                 along z, and it bends to the left on its way down (radius 170 mm)",
        lengths: "60 mm long; outer diameter 15 mm, lumen 10 mm, wall 2.5 mm at half length; 2 mm \
                  wider at the diaphragm, 8 mm wider at the stomach",
        fixed: "both ends, 4 mm of each",
        extent: Vec3::new(0.0287, 0.0218, 0.0622),
        volume: 6.46e-6,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    [(HELD_LENGTH, -1.0), (LENGTH - HELD_LENGTH, 1.0)]
        .into_iter()
        .map(|(along, side)| {
            let (point, _, downward) = axis(along);
            AnchorPlane {
                point,
                normal: -side * downward,
            }
        })
        .collect()
}

/// Rows of vertices around the wall, each turned by half a step against the last. Rows are spaced
/// in proportion to their radius, so that triangles are equilateral up to the curvature.
pub(super) fn surface_mesh(triangles: usize) -> Result<TriangleMesh, MeshError> {
    let profile = Profile::new(outline, RIM_WEIGHT, Vec2::y());
    let (rows, steps) = grid_size(triangles, profile.conformal_length());
    let mut vertices = Vec::with_capacity(rows * steps);
    for row in 0..rows {
        let place = profile.point(row as f64 / rows as f64);
        let (centre, leftward, _) = axis(place.y);
        for step in 0..steps {
            let turn = step as f64 + 0.5 * (row % 2) as f64;
            let (sine, cosine) = (TAU * turn / steps as f64).sin_cos();
            vertices.push(centre + place.x * (cosine * leftward + sine * Vec3::y()));
        }
    }
    TriangleMesh::new(vertices, grid_triangles(rows, steps))
}

/// Point of the axis, the unit vector across it in the plane of the bend, and the one along it,
/// `along` metres below the top.
fn axis(along: f64) -> (Vec3, Vec3, Vec3) {
    let (sine, cosine) = (along / BEND_RADIUS).sin_cos();
    let (half_sine, half_cosine) = (0.5 * LENGTH / BEND_RADIUS).sin_cos();
    let point = BEND_RADIUS * Vec3::new(half_cosine - cosine, 0.0, half_sine - sine);
    (
        point,
        Vec3::new(cosine, 0.0, sine),
        Vec3::new(sine, 0.0, -cosine),
    )
}

/// The outline of the wall in the plane (radius, length along the axis): down the outside, around
/// the lower rim, up the lumen, around the upper rim.
fn outline(parameter: f64) -> Vec2 {
    let free_length = LENGTH - 2.0 * HALF_WALL;
    let part = parameter.rem_euclid(PARTS);
    let fraction = part.fract();
    let (along, turn) = match part as usize {
        0 => (fraction * free_length, 0.0),
        1 => (free_length, PI * fraction),
        2 => ((1.0 - fraction) * free_length, PI),
        _ => (0.0, PI * (1.0 + fraction)),
    };
    let along = along + HALF_WALL;
    let (radius, slope) = middle_of_wall(along);
    // From the middle of the wall, half a wall outward, turned towards the end at the rims.
    let (outward, downward) = (HALF_WALL * turn.cos(), HALF_WALL * turn.sin());
    let stretch = slope.hypot(1.0);
    Vec2::new(
        radius + (outward + slope * downward) / stretch,
        along + (downward - slope * outward) / stretch,
    )
}

/// Radius of the middle of the wall and its slope.
fn middle_of_wall(along: f64) -> (f64, f64) {
    let hiatus = HIATUS_FLARE.0 * (-along / HIATUS_FLARE.1).exp();
    let cardia = CARDIA_FLARE.0 * ((along - LENGTH) / CARDIA_FLARE.1).exp();
    (
        MIDDLE_RADIUS + hiatus + cardia,
        cardia / CARDIA_FLARE.1 - hiatus / HIATUS_FLARE.1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wall_is_as_thick_as_said_at_half_length() {
        let outside = outline(0.5);
        let inside = outline(2.5);
        assert!((outside.x - 0.0075).abs() < 2e-4, "{outside:?}");
        assert!((inside.x - 0.005).abs() < 2e-4, "{inside:?}");
    }

    #[test]
    fn the_count_is_near_what_was_asked_for() {
        for wanted in [400, 500, 3_726, 21_146, 70_000] {
            let made = surface_mesh(wanted).unwrap().triangles().len();
            assert!(
                made.abs_diff(wanted) as f64 <= 0.02 * wanted as f64 + 20.0,
                "{made} for {wanted}"
            );
        }
    }
}
