//! T: the work of the traction on a facet, in the uncut body, on its modes.
//!
//! The table knows stress where it changes slowly from triangle to triangle. Near a force it does not, and there
//! the closed form A of a half-space or a plate is put in the place of what the triangles make of it:
//! T = Bᵀ Ξ + φ (A − Bᵀ Ξ_A), with φ of the force's place from one to zero between one and two reaches of the
//! facet.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Matrix2x3, Matrix3, Vector2};
use palpate_geometry::{Surface, TriangleId};

use super::facet::{Facet, Under};
use super::gradient::{Gradient, around};
use super::kernel::{FULLNESS, PROFILE, ROWS};
use super::near;
use super::plate::Plate;
use crate::Vec3;
use crate::finite_spheres::quartic;

/// Reach of a facet in radii of its stress on the surface, and in its depths, but no more than the last [-].
const IN_GRADIENTS: f64 = 0.75;
const IN_DEPTHS: f64 = 1.0;
const MOST_GRADIENTS: f64 = 1.2;

/// Beyond two reaches triangles are known as far as the loads of tips there go, in lengths √(2 A) of one [-].
const OF_LOADS: f64 = 2.2;

/// What a force beside a slit yields more, where the slit is deep, over the reciprocal of its distance: across,
/// along, outward [-].
pub const OF_RIM: [f64; 3] = [0.69, 0.2, 0.28];

/// Modes of a facet at most.
pub(super) const MODES: usize = 6;

/// A force that is spread over a disc, wherever its triangles are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// Its middle, at rest [m].
    pub place: Vec3,
    /// Outward unit normal there [-].
    pub normal: Vec3,
    /// Its radius [m].
    pub radius: f64,
}

/// A triangle near a facet, mode by mode, for a unit force along each axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    pub(super) triangle: TriangleId,
    /// φ (A − Bᵀ Ξ_A).
    pub(super) more: [[f32; 3]; MODES],
    /// Bᵀ Ξ_A.
    pub(super) resolved: [[f32; 3]; MODES],
}

/// Places in a disc that stand for it, in parts of its radius, with their weights.
const DISC: [([f64; 2], f64); 7] = [
    ([0.0, 0.0], 0.25),
    ([0.816_497, 0.0], 0.125),
    ([-0.816_497, 0.0], 0.125),
    ([0.408_248, FRAC_1_SQRT_2], 0.125),
    ([-0.408_248, FRAC_1_SQRT_2], 0.125),
    ([0.408_248, -FRAC_1_SQRT_2], 0.125),
    ([-0.408_248, -FRAC_1_SQRT_2], 0.125),
];

/// A force in the axes of a facet: where it is along the surface, its face, and how it turns.
struct Seen {
    at: [f64; 2],
    face: f64,
    fade: f64,
    /// From the axes of space to those of the facet, the normals upon one another.
    turn: Matrix3<f64>,
}

impl Facet {
    /// Where the closed forms are taken whole [m].
    pub(super) fn reach(&self, gradient: f64) -> f64 {
        let wanted = (IN_GRADIENTS * gradient).max(IN_DEPTHS * self.depth());
        wanted.min(MOST_GRADIENTS * gradient)
    }

    /// A force as the facet sees it; none that is too far or on another side.
    fn sees(&self, reach: f64, place: &Vec3, normal: &Vec3) -> Option<Seen> {
        let away = self.frame.tr_mul(&(place - self.middle));
        let outward = normal.dot(&self.frame.column(2));
        let face = if outward > 0.0 { 1.0 } else { -1.0 };
        let height = match self.under {
            Under::Solid { .. } => 0.0,
            Under::Wall { thickness, .. } => 0.5 * (face - 1.0) * thickness,
        };
        if outward.abs() < 0.2 || (face < 0.0 && matches!(self.under, Under::Solid { .. })) {
            return None;
        }
        let chord = (away - Vec3::new(0.0, 0.0, height)).norm();
        let fade = quartic((chord / reach - 1.0).max(0.0));
        // Along a surface that bends, not through it.
        let flat = (away.x * away.x + away.y * away.y).sqrt();
        let longer = if flat > 0.0 {
            (chord / flat).min(1.5)
        } else {
            1.0
        };
        let own = self.frame.column(2) * face;
        let turn = between(normal, &own);
        Some(Seen {
            at: [away.x * longer, away.y * longer],
            face,
            fade,
            turn: self.frame.transpose() * turn,
        })
    }

    /// A: mode by mode, of a unit force along each axis of the facet, at a place along the surface.
    fn closed(&self, nu: f64, ([x, y], face): ([f64; 2], f64), soft: f64) -> [Vec3; MODES] {
        let mut rows = [Vec3::zeros(); MODES];
        let ends = [-0.25, 0.25].map(|part| part * self.length - y);
        match self.under {
            Under::Solid { depth } => {
                for (m, profile) in PROFILE.iter().enumerate() {
                    let z = -(m as f64 + 0.5) * depth / ROWS as f64;
                    let weight = 0.5 * profile * self.length * depth / ROWS as f64;
                    for along in ends {
                        let traction = near::traction(nu, &Vec3::new(-x, along, z), soft) * weight;
                        for (row, traction) in rows.iter_mut().zip(traction.row_iter()) {
                            *row += traction.transpose();
                        }
                    }
                }
            }
            Under::Wall { thickness, .. } => {
                let plate = Plate { nu, thickness };
                // A wall feels no load narrower than this.
                let tilt = self.tilt(nu);
                let wide = soft + 0.1 * thickness * thickness;
                for along in ends {
                    let found = plate.resultants([-x, along], face, wide);
                    let [n, s, m, v] = found.map(|row| row * (0.5 * self.length));
                    let bulge = n + m * tilt;
                    for (row, found) in rows.iter_mut().zip([n, s, m, v, v, bulge]) {
                        *row += found;
                    }
                }
            }
        }
        rows
    }

    /// φ and φ A of a spot, along the axes of space.
    pub(super) fn of_spot(
        &self,
        (nu, reach): (f64, f64),
        spot: &Spot,
    ) -> Option<(f64, [Vec3; MODES])> {
        let seen = self.sees(reach, &spot.place, &spot.normal)?;
        if seen.fade == 0.0 {
            return None;
        }
        let mut rows = [Vec3::zeros(); MODES];
        let soft = (0.35 * spot.radius).powi(2);
        let in_wall = matches!(self.under, Under::Wall { .. });
        let beside = (seen.at[0] / spot.radius).abs().min(1.0).powi(2);
        let aside = (self.depth() - seen.at[0].abs()).max(0.0) * beside;
        let x = seen.at[0] + aside.copysign(seen.at[0]);
        for ([p, q], weight) in DISC {
            let y = seen.at[1] + q * spot.radius;
            let weight = weight * seen.fade;
            let found = self.closed(nu, ([x + p * spot.radius, y], seen.face), soft);
            for (row, found) in rows.iter_mut().zip(found) {
                *row += found * weight;
            }
            // What bends a wall is not the rim's.
            if in_wall {
                let own = ([seen.at[0] + p * spot.radius, y], seen.face);
                let own = self.closed(nu, own, soft);
                for ((row, found), own) in rows.iter_mut().zip(found).zip(own) {
                    row.z += (own.z - found.z) * weight;
                }
            }
        }
        Some((seen.fade, rows.map(|row| seen.turn.tr_mul(&row))))
    }

    /// Part of a spot's rim that the facet is [-], and what a deep slit adds there along the axes of space [1/m].
    pub(super) fn rim_of(&self, reach: f64, spot: &Spot) -> Option<(f64, Matrix3<f64>)> {
        let seen = self.sees(reach, &spot.place, &spot.normal)?;
        let through = matches!(self.under, Under::Wall { part, .. } if part >= 1.0);
        if seen.face < 0.0 && !through {
            return None;
        }
        let [x, y] = seen.at;
        let x = x.abs();
        let beside = (x / spot.radius).min(1.0).powi(2);
        let near = x.max(0.8 * spot.radius);
        let more = (1.0 / near - 1.0 / self.depth()).max(0.0) * beside;
        let ends = [-0.5, 0.5].map(|end| {
            let end = end * self.length - y;
            0.5 * end / (near * near + end * end).sqrt()
        });
        let [across, along, mut outward] = OF_RIM;
        if matches!(self.under, Under::Wall { .. }) {
            outward = 0.0;
        }
        let own = Matrix3::from_diagonal(&Vec3::new(across, along, outward)) * more;
        let along = seen.turn.tr_mul(&own) * seen.turn;
        Some((ends[1] - ends[0], along))
    }

    /// φ (A − Bᵀ Ξ_A) and Bᵀ Ξ_A of a triangle.
    pub(super) fn of_triangle(
        &self,
        (nu, reach): (f64, f64),
        (place, normal, area): (&Vec3, &Vec3, f64),
        parts: &[Part],
    ) -> Option<[[[f32; 3]; MODES]; 2]> {
        let seen = self.sees(reach, place, normal)?;
        let soft = 0.25 * area;
        let closed = if seen.fade > 0.0 {
            self.closed(nu, (seen.at, seen.face), soft)
        } else {
            [Vec3::zeros(); MODES]
        };
        let mut resolved = [Vec3::zeros(); MODES];
        for part in parts {
            let away = [part.at[0] - seen.at[0], part.at[1] - seen.at[1]];
            let moved = self.moved(nu, away, (part.face, seen.face), area);
            for (resolved, work) in resolved.iter_mut().zip(&part.work) {
                *resolved += moved.tr_mul(work);
            }
        }
        if matches!(self.under, Under::Wall { .. }) {
            resolved[5] = resolved[0] + resolved[2] * self.tilt(nu);
        }
        let turned = |rows: [Vec3; MODES]| rows.map(|row| seen.turn.tr_mul(&row));
        let (resolved, closed) = (turned(resolved), turned(closed));
        let short = |row: Vec3| [row.x as f32, row.y as f32, row.z as f32];
        let more = |mode: usize| short((closed[mode] - resolved[mode]) * seen.fade);
        Some([
            std::array::from_fn(more),
            std::array::from_fn(|mode| short(resolved[mode])),
        ])
    }

    /// Ξ_A: displacement of a triangle from a force on another, `away` from it along the surface.
    fn moved(&self, nu: f64, away: [f64; 2], faces: (f64, f64), area: f64) -> Matrix2x3<f64> {
        let flat = away[0] * away[0] + away[1] * away[1];
        // The mean of 1/r over a disc of the triangle's area is that at 0.59 of its radius.
        let soft = if flat < 1e-3 * area { 0.11 * area } else { 0.0 };
        match self.under {
            Under::Solid { .. } => near::displacement(nu, away, soft),
            Under::Wall { thickness, .. } => {
                let plate = Plate { nu, thickness };
                plate.displacement(away, [faces.0, faces.1], soft + 1e-3 * area)
            }
        }
    }

    /// The stress of a face, as the modes' work.
    pub(super) fn parts(&self, gradient: &Gradient, face: f64, parts: &mut Vec<Part>) {
        let (of_outer, of_inner) = self.of_faces();
        let factors = if face > 0.0 { of_outer } else { of_inner };
        for stress in &gradient.parts {
            let normal = self.frame.column(2) * face;
            let Some(seen) = self.sees(f64::INFINITY, &stress.centroid, &normal) else {
                continue;
            };
            let [across, along] =
                [stress.across, stress.along].map(|vector| self.frame.tr_mul(&vector).xy());
            parts.push(Part {
                at: seen.at,
                face,
                work: [across * factors[0], along * factors[1], across * factors[2]],
            });
        }
    }

    /// How the stresses of the outer and of the inner face count in the first three modes [m²].
    pub(super) fn of_faces(&self) -> ([f64; 3], [f64; 3]) {
        match self.under {
            Under::Solid { depth } => {
                let area = FULLNESS * depth * self.length;
                ([area, area, 0.0], [0.0; 3])
            }
            Under::Wall { thickness, .. } => {
                let area = thickness * self.length;
                (
                    [0.5 * area, 0.5 * area, area / 6.0],
                    [0.5 * area, 0.5 * area, -area / 6.0],
                )
            }
        }
    }
}

/// A triangle whose displacement counts in the stress on a facet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// Along the surface from the facet's middle, in its axes [m].
    at: [f64; 2],
    /// 1 on the outer face, −1 on the inner.
    face: f64,
    /// B: in the first three modes, in the facet's axes.
    work: [Vector2<f64>; 3],
}

/// The shortest turn of a unit vector onto another that is not opposite.
fn between(from: &Vec3, to: &Vec3) -> Matrix3<f64> {
    let axis = from.cross(to).cross_matrix();
    Matrix3::identity() + axis + axis * axis / (1.0 + from.dot(to))
}

/// The triangles of the outer face near a facet.
pub(super) fn triangles_near(
    surface: &Surface,
    facet: &Facet,
    (reach, size): (f64, f64),
    found: &mut Vec<TriangleId>,
) {
    let outward = facet.frame.column(2).into_owned();
    let far = 2.0 * reach + OF_LOADS * size;
    around(surface, (facet.outer, &facet.middle), &outward, far, found);
}
