//! The successive contact point, found among the neighbours of the last one (section 7.6).
//!
//! A tip at p that slides along an organ keeps its contact point c where p = c − d n(c), n being the
//! averaged normal of a [`PatchField`]: c and d are continuous in p, while the nearest point of a mesh
//! leaps at every edge. Inside a triangle c and n are linear in the barycentric weights, so
//! p = Σ bᵢ (xᵢ − t nᵢ) is three equations for b and t, solved by Newton's method; a negative
//! weight selects the next neighbour [Panozzo et al. 2013, Phong projection].
//!
//! *How we know*: `analytic::contact_point_on_sphere_is_radial`, `invariants::slide_has_no_leaps`.
//!
//! *Limits*: deeper than the organ is round, the normals cross and the equation has no solution near by;
//! the contact point then moves towards the tip along the surface at a limited rate. It never turns its
//! normal faster than [`FASTEST_TURN`] nor runs far ahead of the tip, so that the force stays
//! continuous over ridges.

use nalgebra::{Matrix3, Vector3};

use crate::proximity::closest_on_triangle;
use crate::{PatchField, Surface, TriangleId, Vec3};

/// A point of a surface, and how deep a tip lies below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// The triangle of the contact point.
    pub triangle: TriangleId,
    /// Weights of its corners [-].
    pub barycentric: [f64; 3],
    /// The contact point at rest [m].
    pub point: Vec3,
    /// The averaged unit outward normal there [-].
    pub normal: Vec3,
    /// Depth of the tip below it along the outward normal [m]; negative outside.
    pub depth: f64,
}

/// More triangles than this in one step is a leap, not a slide: the caller searches anew.
const MAX_CROSSED_TRIANGLES: usize = 256;

/// Fastest turn of the contact's normal per travel of the tip [rad/m]: 0.03 rad, or 3 % of the force, in
/// a tenth of a millimetre.
pub const FASTEST_TURN: f64 = 300.0;

/// Fastest travel of the contact point per travel of the tip [-].
const FASTEST_TRAVEL: f64 = 2.0;

/// The contact point of a tip that moved from `before` to `tip` [m], starting from the last one,
/// `from`. `None` when the tip moved too far to follow.
pub fn follow(
    surface: &Surface,
    field: &PatchField,
    from: &ContactPoint,
    before: &Vec3,
    tip: &Vec3,
) -> Option<ContactPoint> {
    let (moved, normal) = ((tip - before).norm(), from.normal);
    let aim = project_contact_point(surface, field.vertex_normals(), from, tip).map_or_else(
        || {
            // Nothing to solve for: straight along the surface towards the tip.
            let towards = tip - from.point;
            nearest_among_neighbors(
                surface,
                field,
                from.triangle,
                &(from.point + towards - normal * normal.dot(&towards)),
            )
        },
        Some,
    )?;
    let reached = approach(surface, field, from, &aim, moved)?;
    Some(ContactPoint {
        depth: reached.normal.dot(&(reached.point - tip)),
        ..reached
    })
}

/// The contact point on the way from `from` to `aim`, as far as a tip that has `moved` [m] takes it.
fn approach(
    surface: &Surface,
    field: &PatchField,
    from: &ContactPoint,
    aim: &ContactPoint,
    moved: f64,
) -> Option<ContactPoint> {
    let way = aim.point - from.point;
    let mut part = FASTEST_TRAVEL * moved / way.norm();
    let mut reached = *aim;
    for _ in 0..6 {
        if part < 1.0 {
            let there = from.point + part * way;
            reached = nearest_among_neighbors(surface, field, from.triangle, &there)?;
        }
        let too_fast = reached.normal.angle(&from.normal) / (FASTEST_TURN * moved);
        if too_fast <= 1.0 {
            break;
        }
        // The normal turns unevenly along the way: again, with a little to spare.
        part = 0.9 * part.min(1.0) / too_fast;
    }
    Some(reached)
}

/// The point whose normal, between unit `normals` at the vertices, passes through `tip` [m], if there is one
/// near `from`.
pub fn project_contact_point(
    surface: &Surface,
    normals: &[Vec3],
    from: &ContactPoint,
    tip: &Vec3,
) -> Option<ContactPoint> {
    let mut at = Trial {
        triangle: from.triangle,
        barycentric: from.barycentric,
        along: from.depth,
    };
    let mut before = None;
    for _ in 0..MAX_CROSSED_TRIANGLES {
        let solved = solve_in_triangle(surface, normals, &at, tip)?;
        let (lowest, weight) = lowest(&solved.barycentric);
        if weight >= -1e-10 {
            return Some(contact_point(surface, normals, &solved));
        }
        let opposite_edge = (lowest + 1) % 3;
        let neighbor = surface.adjacency().across(solved.triangle)[opposite_edge]?;
        if before == Some(neighbor) {
            // To and fro over one edge: the normals cross here.
            return None;
        }
        before = Some(solved.triangle);
        at = Trial {
            triangle: neighbor,
            barycentric: [1.0 / 3.0; 3],
            along: solved.along,
        };
    }
    None
}

#[derive(Clone, Copy)]
struct Trial {
    triangle: TriangleId,
    barycentric: [f64; 3],
    /// t of the module's equation [m].
    along: f64,
}

fn solve_in_triangle(
    surface: &Surface,
    normals: &[Vec3],
    start: &Trial,
    tip: &Vec3,
) -> Option<Trial> {
    let x = surface.mesh().positions(start.triangle);
    let corners = surface.mesh().corners(start.triangle);
    let n = corners.map(|node| normals[node.index()]);
    let size = (x[1] - x[0]).norm() + (x[2] - x[0]).norm();
    let facing = (x[1] - x[0]).cross(&(x[2] - x[0]));
    let (mut b1, mut b2, mut t) = (start.barycentric[1], start.barycentric[2], start.along);
    for _ in 0..20 {
        let normal = n[0] + b1 * (n[1] - n[0]) + b2 * (n[2] - n[0]);
        let point = x[0] + b1 * (x[1] - x[0]) + b2 * (x[2] - x[0]);
        let along_first = x[1] - x[0] - t * (n[1] - n[0]);
        let along_second = x[2] - x[0] - t * (n[2] - n[0]);
        let residual = point - t * normal - tip;
        let jacobian = Matrix3::from_columns(&[along_first, along_second, -normal]);
        // The normals must not have crossed: the offset triangle faces as the triangle does.
        if along_first.cross(&along_second).dot(&facing) <= 0.0 {
            return None;
        }
        let step: Vector3<f64> = jacobian.lu().solve(&residual)?;
        b1 -= step[0];
        b2 -= step[1];
        t -= step[2];
        let far_off = b1.abs() > 1e3 || b2.abs() > 1e3;
        if far_off || !t.is_finite() {
            return None;
        }
        if step[0].abs() + step[1].abs() < 1e-13 && step[2].abs() < 1e-13 * size {
            break;
        }
    }
    Some(Trial {
        triangle: start.triangle,
        barycentric: [1.0 - b1 - b2, b1, b2],
        along: t,
    })
}

fn lowest(weights: &[f64; 3]) -> (usize, f64) {
    let mut lowest = 0;
    for k in 1..3 {
        if weights[k] < weights[lowest] {
            lowest = k;
        }
    }
    (lowest, weights[lowest])
}

fn contact_point(surface: &Surface, normals: &[Vec3], trial: &Trial) -> ContactPoint {
    let x = surface.mesh().positions(trial.triangle);
    let corners = surface.mesh().corners(trial.triangle);
    let mut point = Vec3::zeros();
    let mut normal = Vec3::zeros();
    for k in 0..3 {
        point += trial.barycentric[k] * x[k];
        normal += trial.barycentric[k] * normals[corners[k].index()];
    }
    ContactPoint {
        triangle: trial.triangle,
        barycentric: trial.barycentric,
        point,
        normal: normal.normalize(),
        depth: trial.along * normal.norm(),
    }
}

/// Goes downhill in distance from triangle to neighbouring triangle.
fn nearest_among_neighbors(
    surface: &Surface,
    field: &PatchField,
    start: TriangleId,
    tip: &Vec3,
) -> Option<ContactPoint> {
    let mesh = surface.mesh();
    let mut triangle = start;
    let mut on = closest_on_triangle(&mesh.positions(triangle), tip);
    let mut distance = (on.position - tip).norm();
    for _ in 0..MAX_CROSSED_TRIANGLES {
        let mut better = None;
        for node in mesh.corners(triangle) {
            for &other in surface.adjacency().around(node) {
                let candidate = closest_on_triangle(&mesh.positions(other), tip);
                let to_candidate = (candidate.position - tip).norm();
                if to_candidate < distance * (1.0 - 1e-12) {
                    distance = to_candidate;
                    better = Some((other, candidate));
                }
            }
        }
        let Some((other, candidate)) = better else {
            let patch = field.at(surface, triangle, &on.barycentric);
            let below = patch.normal.dot(&(on.position - tip)) >= 0.0;
            return Some(ContactPoint {
                triangle,
                barycentric: on.barycentric,
                point: on.position,
                normal: patch.normal,
                depth: if below { distance } else { -distance },
            });
        };
        (triangle, on) = (other, candidate);
    }
    None
}
