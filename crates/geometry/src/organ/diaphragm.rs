use std::f64::consts::{PI, TAU};

use super::description::PATIENT_AXES;
use super::revolved::{PARTS, Profile, Vec2, grid_size, grid_triangles};
use super::warp::{MILLIMETRE, bell, ramp, step};
use super::{AnchorPlane, OrganDescription};
use crate::{MeshError, TriangleMesh, Vec3};

/// Fewer, and the rims of the sheet are lost.
pub(super) const MIN_TRIANGLES: usize = 400;

/// Half of its thickness [mm].
const HALF: f64 = 2.0;

/// Radius of the hiatus [mm], and half axes of the whole sheet to the sides, the front and the back [mm].
const HIATUS: f64 = 11.0;
const SIDES: f64 = 70.0;
const FRONT: f64 = 54.0;
const BACK: f64 = 48.0;

/// A radius between these [mm], by which rows are spaced, and rows per radian of turn at the rims.
const TYPICAL: f64 = 57.0;
const RIM_WEIGHT: f64 = 0.02;

/// Each side is fixed from here outward [m].
const FIXED_FROM: f64 = 0.050;

pub(super) fn description() -> OrganDescription {
    OrganDescription {
        summary: "The diaphragm around the esophagus: a sheet with a hiatus, which rises to the front \
                  and to both domes and falls along the spine.",
        axes: PATIENT_AXES,
        origin: "in the middle of the hiatus, half-way through the sheet",
        lengths: "144 mm from side to side, 106 mm from front to back, 4 mm thick; the hiatus is 18 mm \
                  wide; the domes rise 25 to 30 mm above it",
        fixed: "both sides, where it grows from the ribs: what lies more than 50 mm from the hiatus",
        extent: Vec3::new(0.1440, 0.1059, 0.0541),
        volume: 52.2e-6,
    }
}

pub(super) fn anchor() -> Vec<AnchorPlane> {
    [1.0, -1.0]
        .into_iter()
        .map(|side| AnchorPlane {
            point: Vec3::new(side * FIXED_FROM, 0.0, 0.0),
            normal: -side * Vec3::x(),
        })
        .collect()
}

/// Rows of vertices around the hiatus: outward above, around the rim, inward below, around the hiatus.
pub(super) fn surface_mesh(triangles: usize) -> Result<TriangleMesh, MeshError> {
    let profile = Profile::new(outline, RIM_WEIGHT, Vec2::x());
    let (rows, steps) = grid_size(triangles, profile.conformal_length());
    let mut vertices = Vec::with_capacity(rows * steps);
    for row in 0..rows {
        let parameter = profile.parameter(row as f64 / rows as f64);
        let (along, turn) = place(parameter);
        for step in 0..steps {
            let around = step as f64 + 0.5 * (row % 2) as f64;
            vertices.push(skin(along, turn, TAU * around / steps as f64));
        }
    }
    TriangleMesh::new(vertices, grid_triangles(rows, steps))
}

/// For a parameter from 0 to 4: the part of the way from the hiatus to the rim, and how far the skin has
/// turned from above [rad].
fn place(parameter: f64) -> (f64, f64) {
    let part = parameter.rem_euclid(PARTS);
    let fraction = part.fract();
    match part as usize {
        0 => (fraction, 0.0),
        1 => (1.0, PI * fraction),
        2 => (1.0 - fraction, PI),
        _ => (0.0, PI * (1.0 + fraction)),
    }
}

/// The same as a flat outline for spacing the rows: radius and height [mm], along a way from the hiatus.
fn outline(parameter: f64) -> Vec2 {
    let (along, turn) = place(parameter);
    let radius = HIATUS * (TYPICAL / HIATUS).powf(along);
    Vec2::new(radius + HALF * turn.sin(), HALF * turn.cos())
}

/// A point of the skin [m].
fn skin(along: f64, turn: f64, angle: f64) -> Vec3 {
    let at = |along: f64, angle: f64| -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        let depth = if sin < 0.0 { FRONT } else { BACK };
        let outer = 1.0 / (cos / SIDES).hypot(sin / depth);
        let radius = HIATUS * (outer / HIATUS).powf(along);
        let (x, y) = (radius * cos, radius * sin);
        Vec3::new(x, y, height(x, y))
    };
    let small = 1e-4;
    let outward = at(along + small, angle) - at(along - small, angle);
    let around = at(along, angle + small) - at(along, angle - small);
    let up = outward.cross(&around);
    let up = up.normalize() * up.z.signum();
    let outward = outward.normalize();
    MILLIMETRE * (at(along, angle) + HALF * (turn.cos() * up + turn.sin() * outward))
}

/// How high the middle of the sheet lies [mm] where it is (x, y) [mm] from the hiatus.
fn height(x: f64, y: f64) -> f64 {
    let front = -y;
    // The central tendon rises to the front; the left dome is a little lower than the right one.
    let tendon = 13.0 * step((front - 20.0) / 18.0);
    let left = 15.0 * bell((x - 46.0) / 30.0) * step((front + 16.0) / 16.0);
    let right = 19.0 * bell((x + 48.0) / 32.0) * step((front + 16.0) / 16.0);
    let spine = 6.4 * ramp((y - 18.0) / 10.0);
    tendon + left + right - spine
}
