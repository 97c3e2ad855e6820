//! T: the work of the traction on a facet, in the uncut body, on its modes.
//!
//! The table knows stress where it changes slowly from triangle to triangle. Near a force it does not, and there
//! the closed form A of a half-space or a plate is put in the place of what the triangles make of it:
//! T = Bᵀ Ξ + φ (A − Bᵀ Ξ_A), with φ from one to zero between one and two reaches of the facet.

use nalgebra::{Matrix3, Rotation3};
use palpate_geometry::{Surface, TriangleId};

use super::facet::{Facet, Under};
use super::gradient::{Gradient, around};
use super::kernel::{FULLNESS, PROFILE, ROWS};
use super::near;
use super::plate::Plate;
use crate::Vec3;
use crate::finite_spheres::quartic;

/// Reach of a facet in radii of its stress on the surface, and in its depths [-], but no more than such triangles
/// as make up its stress fill so many times over.
const IN_GRADIENTS: f64 = 1.2;
const IN_DEPTHS: f64 = 1.0;
const MOST_GRADIENTS: f64 = 1.3;

/// What a force beside a slit yields more, where the slit is deep, over the reciprocal of its distance: across,
/// along, outward [-].
const OF_RIM: [f64; 3] = [0.69, 0.3, 0.28];

/// Nearer than this part of the depth, the modes of a facet do not know what a force does to the rim [-].
const RIM: f64 = 0.75;

/// Modes of a facet at most.
pub(super) const MODES: usize = 5;

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

/// A triangle near a facet: what is added to its smooth row, mode by mode, for a unit force along each axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    pub(super) triangle: TriangleId,
    pub(super) rows: [[f32; 3]; MODES],
}

/// Places in a disc that stand for it, in parts of its radius, with their weights.
const DISC: [([f64; 2], f64); 7] = [
    ([0.0, 0.0], 0.25),
    ([0.816_497, 0.0], 0.125),
    ([-0.816_497, 0.0], 0.125),
    ([0.408_248, 0.707_107], 0.125),
    ([-0.408_248, 0.707_107], 0.125),
    ([0.408_248, -0.707_107], 0.125),
    ([-0.408_248, -0.707_107], 0.125),
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
        if fade == 0.0 {
            return None;
        }
        // Along a surface that bends, not through it.
        let flat = (away.x * away.x + away.y * away.y).sqrt();
        let longer = if flat > 0.0 {
            (chord / flat).min(1.5)
        } else {
            1.0
        };
        let own = self.frame.column(2) * face;
        let turn = Rotation3::rotation_between(normal, &own)?;
        Some(Seen {
            at: [away.x * longer, away.y * longer],
            face,
            fade,
            turn: self.frame.transpose() * turn.matrix(),
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
                // Loads are felt by the wall as if they were this wide at least [Westergaard 1926].
                let wide = soft + 0.1 * thickness * thickness;
                for along in ends {
                    let found = plate.resultants([-x, along], face, wide);
                    let [n, s, m, v] = found.map(|row| row * (0.5 * self.length));
                    for (row, found) in rows.iter_mut().zip([n, s, m, v, v]) {
                        *row += found;
                    }
                }
            }
        }
        rows
    }

    /// What the closed forms add to a spot's tractions, along the axes of space.
    pub(super) fn of_spot(&self, (nu, reach): (f64, f64), spot: &Spot) -> Option<[Vec3; MODES]> {
        let seen = self.sees(reach, &spot.place, &spot.normal)?;
        let mut rows = [Vec3::zeros(); MODES];
        let soft = (0.35 * spot.radius).powi(2);
        let beside = (seen.at[0] / spot.radius).abs().min(1.0).powi(2);
        let aside = (self.rim() - seen.at[0].abs()).max(0.0) * beside;
        let x = seen.at[0] + aside.copysign(seen.at[0]);
        for ([p, q], weight) in DISC {
            let at = [x + p * spot.radius, seen.at[1] + q * spot.radius];
            let found = self.closed(nu, (at, seen.face), soft);
            for (row, found) in rows.iter_mut().zip(found) {
                *row += found * (weight * seen.fade);
            }
        }
        Some(rows.map(|row| seen.turn.tr_mul(&row)))
    }

    /// Within what distance of the slit the rim yields by itself [m].
    fn rim(&self) -> f64 {
        RIM * match self.under {
            Under::Solid { depth } => depth,
            Under::Wall { thickness, part } => thickness * part,
        }
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
        let more = (1.0 / near - 1.0 / self.rim()).max(0.0) * beside;
        let ends = [-0.5, 0.5].map(|end| {
            let end = end * self.length - y;
            0.5 * end / (near * near + end * end).sqrt()
        });
        let own = Matrix3::from_diagonal(&Vec3::from(OF_RIM)) * more;
        let along = seen.turn.tr_mul(&own) * seen.turn;
        Some((ends[1] - ends[0], along))
    }

    /// What the smooth stress of a triangle's force has of the closed form, and the closed form itself.
    pub(super) fn of_triangle(
        &self,
        (nu, reach): (f64, f64),
        (place, normal, area): (&Vec3, &Vec3, f64),
        gradients: &[Gradient; 2],
    ) -> Option<[[Vec3; MODES]; 2]> {
        let seen = self.sees(reach, place, normal)?;
        let soft = 0.25 * area;
        let closed = self.closed(nu, (seen.at, seen.face), soft);
        let mut stresses = [[Vec3::zeros(); 2]; 2];
        for (side, gradient) in gradients.iter().enumerate() {
            let other = if side == 0 { 1.0 } else { -1.0 };
            for part in &gradient.parts {
                let away = self.frame.tr_mul(&(part.centroid - place));
                let moved = self.moved(nu, &away, (other, seen.face), area);
                let [across, along] = [part.across, part.along].map(|v| self.frame.tr_mul(&v));
                stresses[side][0] += moved.tr_mul(&across);
                stresses[side][1] += moved.tr_mul(&along);
            }
        }
        let resolved = self.of_stress(stresses);
        let turned = |rows: [Vec3; MODES]| rows.map(|row| seen.turn.tr_mul(&row) * seen.fade);
        Some([turned(resolved), turned(closed)])
    }

    /// Ξ_A: displacement of a triangle from a force on another.
    fn moved(&self, nu: f64, away: &Vec3, faces: (f64, f64), area: f64) -> Matrix3<f64> {
        let flat = away.x * away.x + away.y * away.y;
        // The mean of 1/r over a disc of the triangle's area is that at 0.59 of its radius.
        let soft = if flat < 1e-3 * area { 0.11 * area } else { 0.0 };
        match self.under {
            Under::Solid { .. } => near::displacement(nu, away, soft),
            Under::Wall { thickness, .. } => {
                let plate = Plate { nu, thickness };
                plate.displacement([away.x, away.y], [faces.0, faces.1], soft + 1e-3 * area)
            }
        }
    }

    /// The modes' work of the stresses σ_nn, σ_ns on the two faces of what is cut.
    pub(super) fn of_stress(&self, [outer, inner]: [[Vec3; 2]; 2]) -> [Vec3; MODES] {
        let (of_outer, of_inner) = self.of_faces();
        std::array::from_fn(|mode| {
            let kind = mode % 2;
            if mode < 3 {
                outer[kind] * of_outer[mode] + inner[kind] * of_inner[mode]
            } else {
                Vec3::zeros()
            }
        })
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

/// The triangles near a facet on both faces of what it cuts.
pub(super) fn triangles_near(
    surface: &Surface,
    facet: &Facet,
    reach: f64,
    found: &mut [Vec<TriangleId>; 2],
) {
    let outward = facet.frame.column(2).into_owned();
    around(
        surface,
        (facet.outer, &facet.middle),
        &outward,
        2.0 * reach,
        &mut found[0],
    );
    found[1].clear();
    if let (Some(inner), Under::Wall { thickness, .. }) = (facet.inner, facet.under) {
        let below = facet.middle - outward * thickness;
        around(
            surface,
            (inner, &below),
            &-outward,
            2.0 * reach,
            &mut found[1],
        );
    }
}
