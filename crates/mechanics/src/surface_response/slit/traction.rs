//! T: the work of the traction on a facet, in the uncut body, on its modes.
//!
//! The table resolves stress where it changes slowly from triangle to triangle. Near a force it does not, and
//! there the closed form A of a half-space or a plate replaces the stress from the triangles: T = Bᵀ Ξ + φ (A −
//! Bᵀ Ξ_A), with φ of the force's place from one to zero between one and two reaches of the facet.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Matrix2x3, Matrix3, Vector2};
use palpate_geometry::{Surface, TriangleId};

use super::curvature::Medium;
use super::facet::{CrackGeometry, Facet};
use super::gradient::{Gradient, around};
use super::kernel::{FULLNESS, PROFILE, ROWS};
use super::near;
use super::plate::Plate;
use crate::Vec3;
use crate::finite_spheres::quartic;

/// Reach of a facet in radii of its stress on the surface, and in its depths, but no more than the last [-].
const IN_GRADIENTS: f64 = 0.75;
const IN_DEPTHS: f64 = 1.0;
const MAX_GRADIENTS: f64 = 1.2;

/// Beyond two reaches triangles are known as far as the loads of tips there go, in lengths √(2 A) of one [-].
const OF_LOADS: f64 = 2.2;

/// Additional compliance of a force next to a deep slit, over the reciprocal of its distance: across, along,
/// outward [-].
pub const RIM_COMPLIANCE: [f64; 3] = [0.69, 0.2, 0.28];

/// A spot is as wide as this part of its radius beyond its places [-].
const OF_SPOT: f64 = 0.35;

/// A wall bends under a force on a triangle as if it were spread by the root of this part of the thickness's square [-].
const SOFT: f64 = 0.1;

/// Modes of a facet at most.
pub(super) const MODES: usize = 5;

/// A force that is spread over a disc, wherever its triangles are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscForce {
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

/// A triangle that bears a force.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loaded {
    /// Its centroid [m].
    pub(super) place: Vec3,
    /// Outward unit normal [-].
    pub(super) normal: Vec3,
    /// Its area [m²].
    pub(super) area: f64,
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
    /// Distance within which the closed forms have full weight [m].
    pub(super) fn reach(&self, gradient: f64) -> f64 {
        let wanted = (IN_GRADIENTS * gradient).max(IN_DEPTHS * self.depth());
        wanted.min(MAX_GRADIENTS * gradient)
    }

    /// A force as the facet sees it; none that is too far or on another side.
    fn sees(&self, reach: f64, place: &Vec3, normal: &Vec3) -> Option<Seen> {
        let away = self.frame.tr_mul(&(place - self.middle));
        let outward = normal.dot(&self.frame.column(2));
        let face = if outward > 0.0 { 1.0 } else { -1.0 };
        let height = match self.geometry {
            CrackGeometry::Solid { .. } => 0.0,
            CrackGeometry::Wall { thickness, .. } => 0.5 * (face - 1.0) * thickness,
        };
        if outward.abs() < 0.2
            || (face < 0.0 && matches!(self.geometry, CrackGeometry::Solid { .. }))
        {
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
    fn closed(&self, medium: Medium<'_>, [x, y]: [f64; 2], face: f64, soft: f64) -> [Vec3; MODES] {
        let Medium { nu, tube } = medium;
        let mut rows = [Vec3::zeros(); MODES];
        match self.geometry {
            CrackGeometry::Solid { depth } => {
                let ends = [-0.25, 0.25].map(|part| part * self.length - y);
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
            CrackGeometry::Wall { thickness, .. } => {
                let plate = Plate { nu, thickness };
                for along in [-0.375, -0.125, 0.125, 0.375].map(|part| part * self.length - y) {
                    let [mut n, s, m, mut v] = plate.resultants([-x, along], face, soft);
                    let [of_n, of_v, of_across] =
                        tube.of_force(self.curvature, thickness, [-x, along], face);
                    n.z += of_n;
                    v += Vec3::new(of_across, 0.0, of_v);
                    for (row, found) in rows.iter_mut().zip([n, s, m, v, v]) {
                        *row += found * (0.25 * self.length);
                    }
                }
            }
        }
        rows
    }

    /// φ and φ A of a spot, along the axes of space.
    pub(super) fn point_influence(
        &self,
        medium: Medium<'_>,
        reach: f64,
        spot: &DiscForce,
    ) -> Option<(f64, [Vec3; MODES])> {
        let seen = self.sees(reach, &spot.place, &spot.normal)?;
        let [x, y] = seen.at;
        let soft = (OF_SPOT * spot.radius).powi(2);
        let lateral = (x / spot.radius).abs().min(1.0);
        let mut rows = [Vec3::zeros(); MODES];
        if matches!(self.geometry, CrackGeometry::Solid { .. }) {
            if seen.fade == 0.0 {
                return None;
            }
            let aside = (self.depth() - x.abs()).max(0.0) * lateral * lateral;
            let x = x + aside.copysign(x);
            for ([p, q], weight) in DISC {
                let place = [x + p * spot.radius, y + q * spot.radius];
                let found = self.closed(medium, place, seen.face, soft);
                for (row, found) in rows.iter_mut().zip(found) {
                    *row += found * (weight * seen.fade);
                }
            }
        } else {
            // The table does not resolve the shear of a wall, so that this reaches farther.
            let far = self.sees(2.0 * reach, &spot.place, &spot.normal)?.fade;
            if far == 0.0 {
                return None;
            }
            // A force pulls at the side alone that it is on, and in the middle of the slit at none.
            let narrow = x.abs().min(spot.radius);
            let odd = lateral * (2.0 - lateral);
            let [across, along, outward] = [0, 1, 2].map(|axis| {
                let mut parts = Vec3::repeat(1.0);
                parts[axis] = odd;
                parts
            });
            let sides = [across, along, across, outward, outward];
            for ([p, q], weight) in DISC {
                let place = [x + p * narrow, y + q * spot.radius];
                let found = self.closed(medium, place, seen.face, soft);
                for (mode, row) in rows.iter_mut().enumerate() {
                    let fade = if mode < 3 { seen.fade } else { far };
                    *row += found[mode].component_mul(&sides[mode]) * (weight * fade);
                }
            }
        }
        Some((seen.fade, rows.map(|row| seen.turn.tr_mul(&row))))
    }

    /// The facet's part of a spot's rim [-], and the compliance that a deep slit adds there along the axes of
    /// space [1/m].
    pub(super) fn rim_of(&self, reach: f64, spot: &DiscForce) -> Option<(f64, Matrix3<f64>)> {
        let seen = self.sees(reach, &spot.place, &spot.normal)?;
        let through = matches!(self.geometry, CrackGeometry::Wall { part, .. } if part >= 1.0);
        if seen.face < 0.0 && !through {
            return None;
        }
        let [x, y] = seen.at;
        let x = x.abs();
        let lateral = (x / spot.radius).min(1.0);
        let lateral = lateral * (2.0 - lateral);
        let near = x.max(0.8 * spot.radius);
        let more = (1.0 / near - 1.0 / self.depth()).max(0.0) * lateral;
        let ends = [-0.5, 0.5].map(|end| {
            let end = end * self.length - y;
            0.5 * end / (near * near + end * end).sqrt()
        });
        let [across, along, mut outward] = RIM_COMPLIANCE;
        if matches!(self.geometry, CrackGeometry::Wall { .. }) {
            outward = 0.0;
        }
        let own = Matrix3::from_diagonal(&Vec3::new(across, along, outward)) * more;
        let along = seen.turn.tr_mul(&own) * seen.turn;
        Some((ends[1] - ends[0], along))
    }

    /// φ (A − Bᵀ Ξ_A) and Bᵀ Ξ_A of a triangle.
    pub(super) fn of_triangle(
        &self,
        medium: Medium<'_>,
        reach: f64,
        triangle: &Loaded,
        parts: &[Part],
        known: &Vec3,
    ) -> Option<[[[f32; 3]; MODES]; 2]> {
        let seen = self.sees(reach, &triangle.place, &triangle.normal)?;
        let area = triangle.area;
        let spread = match self.geometry {
            CrackGeometry::Solid { .. } => 0.0,
            CrackGeometry::Wall { thickness, .. } => SOFT * thickness * thickness,
        };
        let soft = 0.25 * area + spread;
        let closed = if seen.fade > 0.0 {
            self.closed(medium, seen.at, seen.face, soft)
        } else {
            [Vec3::zeros(); MODES]
        };
        let mut resolved = [Vec3::zeros(); MODES];
        for part in parts {
            let away = [part.at[0] - seen.at[0], part.at[1] - seen.at[1]];
            let moved = self.moved(medium.nu, away, [part.face, seen.face], area);
            for (resolved, work) in resolved.iter_mut().zip(&part.work) {
                *resolved += moved.tr_mul(work);
            }
        }
        // Triangles do not resolve how a curved wall bears an outward force next to it; the tube
        // does.
        if matches!(self.geometry, CrackGeometry::Wall { .. }) {
            resolved[0].z = (seen.turn * known).z;
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
    fn moved(&self, nu: f64, away: [f64; 2], faces: [f64; 2], area: f64) -> Matrix2x3<f64> {
        let flat = away[0] * away[0] + away[1] * away[1];
        // The mean of 1/r over a disc of the triangle's area is that at 0.59 of its radius.
        let soft = if flat < 1e-3 * area { 0.11 * area } else { 0.0 };
        match self.geometry {
            CrackGeometry::Solid { .. } => near::displacement(nu, away, soft),
            CrackGeometry::Wall { thickness, .. } => {
                let plate = Plate { nu, thickness };
                plate.displacement(away, faces, soft + 1e-3 * area)
            }
        }
    }

    /// The stress of a face, as the modes' work.
    pub(super) fn parts(&self, gradient: &Gradient, face: f64, parts: &mut Vec<Part>) {
        let (of_outer, of_inner) = self.of_faces(0.0);
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

    /// Weights of the stresses of the outer and of the inner face in the first three modes [m²], of a wall whose
    /// middle has this `curvature` [1/m]: over a curved wall stress goes with the reciprocal of the radius, and
    /// a moment alone makes no mean of the faces' stresses that is zero [Winkler 1858].
    pub(super) fn of_faces(&self, curvature: f64) -> ([f64; 3], [f64; 3]) {
        match self.geometry {
            CrackGeometry::Solid { depth } => {
                let area = FULLNESS * depth * self.length;
                ([area, area, 0.0], [0.0; 3])
            }
            CrackGeometry::Wall { thickness, .. } => {
                let area = thickness * self.length;
                let more = thickness * curvature / 6.0;
                (
                    [(0.5 + more) * area, 0.5 * area, area / 6.0],
                    [(0.5 - more) * area, 0.5 * area, -area / 6.0],
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
    reach: f64,
    size: f64,
    found: &mut Vec<TriangleId>,
) {
    let outward = facet.frame.column(2).into_owned();
    let far = 2.0 * reach + OF_LOADS * size;
    around(surface, facet.outer, &facet.middle, &outward, far, found);
}
