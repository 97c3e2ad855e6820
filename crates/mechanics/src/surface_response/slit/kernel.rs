//! H: the closing traction on a facet by a unit jump on another, by displacement discontinuities [Crouch and
//! Starfield 1983].

use std::f64::consts::PI;

use nalgebra::{Matrix3, Matrix5};

use super::curvature::{Curvature, Medium};
use super::facet::{CrackGeometry, Facet};
use super::plate::Plate;
use super::spring;
use crate::Vec3;

/// Rows in which the depth of a facet in a solid is taken.
pub(super) const ROWS: usize = 4;

/// The half of an ellipse over the depth, at the middles of the rows: the profile of a jump [-].
pub(super) const PROFILE: [f64; ROWS] = [
    0.992_156_741_649_221_9,
    0.927_024_810_886_958,
    0.780_624_749_799_799_8,
    0.484_122_918_275_927_1,
];

/// Work of an even traction on the profile, in parts of that on an even jump [-].
pub(super) const FULLNESS: f64 = 0.795_982_305_153;

/// What H of the rows is off that of the ellipse, in the plane [-].
const OF_ROWS: f64 = 1.1118;

/// A slit from a free surface opens by more than half of one twice as deep: 1.1215² [-].
const OF_SURFACE: f64 = 1.258;

/// Raise of H's diagonal at an end of the slit, in parts of what a jump does to itself: at one end, at both
/// ends of a facet that is alone; of deflections that bend, too.
const AT_END: f64 = 0.3;
const ALONE: f64 = 1.0;
const AT_BENT_END: f64 = 1.125;
const BENT_ALONE: f64 = 22.5;

/// Between layers that do not interact and a thin plate, where bending is (3 + ν)/(1 + ν) times as
/// stiff [-].
const OF_BENDING: f64 = 0.5;

/// Facets that turn by less from one another are taken as of one plane: cosine [-].
const ONE_PLANE: f64 = 0.8;

/// The part of H between the modes of two facets, over E [m].
pub(super) fn coupling(medium: Medium<'_>, one: &Facet, other: &Facet) -> Matrix5<f64> {
    0.5 * (pull(medium, one, other) + pull(medium, other, one).transpose())
}

/// Pivots of a block by itself [m].
pub(super) fn pivots(block: &Matrix5<f64>, modes: usize) -> [f64; 5] {
    let mut rest = *block;
    std::array::from_fn(|mode| {
        let pivot = rest[(mode, mode)];
        if mode < modes && pivot > 0.0 {
            for i in mode + 1..5 {
                let factor = rest[(i, mode)] / pivot;
                for j in mode + 1..5 {
                    rest[(i, j)] -= factor * rest[(mode, j)];
                }
            }
        }
        pivot
    })
}

/// H of a facet with itself over E [m], and the increments of its diagonal where one end is free, or both.
pub(super) fn own(medium: Medium<'_>, facet: &Facet) -> (Matrix5<f64>, [[f64; 5]; 2]) {
    let mut matrix = pull(medium, facet, facet);
    let mut ends = [[0.0; 5]; 2];
    for mode in 0..5 {
        let (one, both) = if mode >= 4 {
            (AT_BENT_END, BENT_ALONE)
        } else {
            (AT_END, ALONE)
        };
        ends[0][mode] = one * matrix[(mode, mode)];
        ends[1][mode] = both * matrix[(mode, mode)];
    }
    if let CrackGeometry::Wall { part, .. } = facet.geometry
        && part < 1.0
    {
        matrix += spring::ligament(medium.nu, part) * facet.length;
    }
    (matrix, ends)
}

/// Less the work of the traction on the modes of `seen` by unit jumps of `jumping`.
fn pull(medium: Medium<'_>, seen: &Facet, jumping: &Facet) -> Matrix5<f64> {
    let Medium { nu, tube } = medium;
    match (seen.geometry, jumping.geometry) {
        (CrackGeometry::Solid { depth }, CrackGeometry::Solid { depth: other }) => {
            let block = in_solid(nu, seen, depth, jumping, other);
            let mut matrix = Matrix5::zeros();
            matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&block);
            matrix
        }
        (
            CrackGeometry::Wall { thickness, .. },
            CrackGeometry::Wall {
                thickness: other, ..
            },
        ) => {
            let thickness = 0.5 * (thickness + other);
            in_wall(nu, seen, jumping, thickness) + of_curvature(tube, seen, jumping, thickness)
        }
        _ => Matrix5::zeros(),
    }
}

/// ∫ 1/r³, ∫ x²/r⁵, ∫ y²/r⁵ over a rectangle from a place of its plane [1/m], as finite parts.
fn rectangle([x, y]: [f64; 2], half: [f64; 2]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (end, sign) in [(half[0], 1.0), (-half[0], -1.0)] {
        for (side, other) in [(half[1], 1.0), (-half[1], -1.0)] {
            let (p, q) = (end - x, side - y);
            let r = (p * p + q * q).sqrt();
            let part = -sign * other / (3.0 * p * q * r);
            sums[1] += part * (p * p + 2.0 * q * q);
            sums[2] += part * (q * q + 2.0 * p * p);
        }
    }
    sums[0] = sums[1] + sums[2];
    sums
}

/// The same, carried over evenly where the place is too near to the end of the rectangle along x.
fn rectangle_beside([x, y]: [f64; 2], half: [f64; 2]) -> [f64; 3] {
    let near = 0.5 * half[0];
    let off = x.abs() - half[0];
    if off.abs() >= near {
        return rectangle([x, y], half);
    }
    let [inside, outside] = [half[0] - near, half[0] + near].map(|x| rectangle([x, y], half));
    let part = 0.5 * (1.0 + off / near);
    [0, 1, 2].map(|k| inside[k] * (1.0 - part) + outside[k] * part)
}

fn in_solid(nu: f64, seen: &Facet, depth: f64, jumping: &Facet, other: f64) -> Matrix3<f64> {
    let factor = 1.0 / (8.0 * PI * (1.0 + nu) * (1.0 - nu));
    let turn = jumping.frame.tr_mul(&seen.frame);
    let at = jumping.frame.tr_mul(&(seen.middle - jumping.middle));
    let size = jumping.length.max(seen.length);
    let one_plane = in_one_plane(&turn, &at, size);
    let (mine, yours) = (depth / ROWS as f64, other / ROWS as f64);
    let free = Matrix3::from_diagonal(&Vec3::new(1.0 / OF_SURFACE, 1.0, 1.0 / OF_SURFACE));
    let far = at.norm() > 3.0 * (jumping.length + other);
    let area = seen.length * mine;
    let row = |m: usize, height: f64| (m as f64 + 0.5) * height;
    let mut sum = Matrix3::zeros();
    if far || !one_plane {
        // Jumps as points, at the middles of two rows of each.
        let plane = turn.column(0).into_owned();
        let weight = 0.5 * FULLNESS;
        for m in [0.25, 0.75] {
            for k in [0.25, 0.75, -0.25, -0.75] {
                let mut r = at;
                r.z = -m * depth - (-k * other);
                let soft = 0.1 * (jumping.length * other).min(seen.length * depth);
                let stress = point(nu, &r, soft);
                let traction = stress.map(|stress| turn.tr_mul(&(stress * plane)));
                let work = Matrix3::from_columns(&traction) * (weight * weight);
                sum -= work * (seen.length * depth * jumping.length * other);
            }
        }
        return sum * free;
    }
    let half = [0.5 * jumping.length, 0.5 * yours];
    let mut diagonal = Vec3::zeros();
    for (m, of_seen) in PROFILE.iter().enumerate() {
        for (k, jump_influence) in PROFILE.iter().enumerate() {
            for image in [1.0, -1.0] {
                let height = row(m, mine) - image * row(k, yours);
                let height = clear(height, yours);
                let [all, along, down] = rectangle_beside([at.y, height], half);
                let shear = 1.0 - 2.0 * nu;
                let each = Vec3::new(
                    all,
                    shear * all + 3.0 * nu * along,
                    shear * all + 3.0 * nu * down,
                );
                diagonal -= each * (of_seen * jump_influence * area * factor);
            }
        }
    }
    let own = Matrix3::from_diagonal(&(diagonal * OF_ROWS)) * free;
    turn.tr_mul(&own) * turn[(0, 0)].signum()
}

/// Whether facets are taken as of one plane.
fn in_one_plane(turn: &Matrix3<f64>, at: &Vec3, size: f64) -> bool {
    turn[(0, 0)].abs() > ONE_PLANE && at.x.abs() < 0.4 * size
}

/// A height that is not on the edge of a row.
fn clear(height: f64, row: f64) -> f64 {
    let off = height.abs() - 0.5 * row;
    if off.abs() < 0.2 * row {
        let moved = 0.5 * row + if off < 0.0 { -0.2 } else { 0.2 } * row;
        moved.copysign(height)
    } else {
        height
    }
}

/// Stress [1/m³] at `r` [m], over E, from a unit jump on a unit area of the plane x = 0 along each axis.
fn point(nu: f64, r: &Vec3, soft: f64) -> [Matrix3<f64>; 3] {
    let distance = (r.norm_squared() + soft).sqrt();
    let u = r / distance;
    let factor = 1.0 / (8.0 * PI * (1.0 + nu) * (1.0 - nu) * distance.powi(3));
    dislocation(nu, 3.0, &u).map(|stress| stress * factor)
}

/// The shape of the stress from a jump along each axis on the plane x = 0, in the direction `u`; β = 3 in space, 2 in
/// the plane.
fn dislocation(nu: f64, beta: f64, u: &Vec3) -> [Matrix3<f64>; 3] {
    let n = Vec3::x();
    let gamma = beta + 2.0;
    let slope = u.x;
    let shape = 1.0 - 2.0 * nu;
    [0, 1, 2].map(|k| {
        Matrix3::from_fn(|i, j| {
            let d = |a: usize, b: usize| f64::from(u8::from(a == b));
            beta * slope
                * (shape * d(i, j) * u[k] + nu * (d(i, k) * u[j] + d(j, k) * u[i])
                    - gamma * u[i] * u[j] * u[k])
                + beta * nu * (n[i] * u[j] * u[k] + n[j] * u[i] * u[k])
                + shape * (beta * n[k] * u[i] * u[j] + n[j] * d(i, k) + n[i] * d(j, k))
                - (1.0 - 4.0 * nu) * n[k] * d(i, j)
        })
    })
}

/// −f.p. ∫ 1/s² over a piece from a place `x` pieces away, times its length; carried over evenly where the place is
/// in its piece or near to its end.
fn line(x: f64) -> f64 {
    let x = x.abs();
    if x < 1.0 {
        4.0 - 16.0 / 3.0 * x * x
    } else {
        -1.0 / (x * x - 0.25)
    }
}

/// What curvature adds: for facets that lie along one another.
fn of_curvature(tube: &Curvature, seen: &Facet, jumping: &Facet, thickness: f64) -> Matrix5<f64> {
    let cosine = jumping.frame.column(0).dot(&seen.frame.column(0));
    let at = jumping.frame.tr_mul(&(seen.middle - jumping.middle));
    let away = at.norm().copysign(at.y);
    let curvature = 0.5 * (seen.curvature + jumping.curvature);
    // Means over both facets by Gauss, two places each.
    let [near, far] = [seen.length - jumping.length, seen.length + jumping.length]
        .map(|length| 0.5 * length / 3.0_f64.sqrt());
    let mut sum = Matrix5::zeros();
    for off in [near, -near, far, -far] {
        sum += tube.jump_influence(curvature, thickness, away + off);
    }
    sum.row_mut(4).scale_mut(cosine.signum());
    sum * (0.25 * cosine * cosine * seen.length * jumping.length)
}

fn in_wall(nu: f64, seen: &Facet, jumping: &Facet, thickness: f64) -> Matrix5<f64> {
    let turn = jumping.frame.tr_mul(&seen.frame);
    let at = jumping.frame.tr_mul(&(seen.middle - jumping.middle));
    let length = 0.5 * (seen.length + jumping.length);
    let one_plane = in_one_plane(&turn, &at, length);
    // Along a wall that bends, not through it.
    let away = at.norm().copysign(at.y);
    let plate = Plate { nu, thickness };
    let stretch = thickness / (4.0 * PI);
    let thin = (3.0 + nu) / (1.0 + nu);
    // M 2/w by θ w/2.
    let bend = thickness / (12.0 * PI) * thin.powf(OF_BENDING);
    let shear = 5.0 / 6.0 * thickness / (4.0 * PI * (1.0 + nu));
    let lift = plate.bending() * (1.0 - nu) * (3.0 + nu) / (4.0 * PI) / (length * length);
    let mut matrix = Matrix5::zeros();
    let parts = seen.length * jumping.length / (length * length);
    if one_plane {
        let x = away / length;
        let near = line(x) * parts;
        let sign = turn[(0, 0)].signum();
        let flat = turn.fixed_view::<2, 2>(0, 0).transpose() * sign;
        for i in 0..2 {
            for j in 0..2 {
                matrix[(i, j)] = flat[(i, j)] * near * stretch;
            }
        }
        matrix[(2, 2)] = near * bend;
        matrix[(3, 3)] = sign * near * shear;
        let second = 2.0 * line(x) - line(x - 1.0) - line(x + 1.0);
        matrix[(4, 4)] = sign * second * parts * lift;
        return matrix;
    }
    let mut r = at;
    r.z = 0.0;
    let squared = (at.norm_squared()).max(0.25 * length * length);
    let u = r.try_normalize(0.0).unwrap_or(Vec3::y());
    let plane = turn.column(0).into_owned();
    let stress = dislocation(nu / (1.0 + nu), 2.0, &u);
    let work = -stretch * seen.length * jumping.length / squared;
    for (k, stress) in stress.iter().take(2).enumerate() {
        let traction = turn.tr_mul(&(stress * plane));
        for i in 0..2 {
            matrix[(i, k)] = work * traction[i];
        }
    }
    matrix[(2, 2)] = matrix[(0, 0)] * bend / stretch;
    let x = squared.sqrt() / length;
    matrix[(3, 3)] = -shear * plane.x * seen.length * jumping.length / squared;
    let second = 2.0 * line(x) - line(x - 1.0) - line(x + 1.0);
    matrix[(4, 4)] = plane.x * second * parts * lift;
    matrix
}
