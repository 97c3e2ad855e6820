use std::collections::HashMap;

use palpate_geometry::{
    NodeId, Surface, TriangleId, TriangleMesh, Vec3, closest_on_triangle, collect_on_all_cores,
};
use palpate_mechanics::contact::Tip;
use palpate_mechanics::inclusion::{InclusionField, Load};

/// Radii for which the inclusions are tabulated, as a geometric series: of contact areas, up to that of the tool, and
/// of loads, from this part of the least contact area on [-].
const TIPS: usize = 9;
const TIP_FACTOR: f64 = std::f64::consts::SQRT_2;
const LOADS: usize = 8;
const LOAD_FACTOR: f64 = 2.0;
const MIN_LOAD: f64 = 1.7;

/// Radius of the flat punch that spreads a force as far as Hertz's pressure does, relative to the radius of that: ⟨r²⟩
/// is ⅔ a² of the one and ⅖ a² of the other [-].
const PUNCH_OF_HERTZ: f64 = 0.774_596_669_241_483;

/// Nodes of a triangle: its corners, then the middles of 01, 12, 20.
const PLACES: usize = 6;

/// Reduction of the displacement of tips, and of the loads that represent them in a mesh, by inclusions under the
/// displayed surface; empty for bodies without any.
#[derive(Debug, Clone, Default)]
pub(crate) struct InclusionTable {
    /// Radius of the least contact area [m].
    least: f64,
    /// Values of each node, and the nodes of each triangle, for interpolation.
    reductions: Vec<Reductions>,
    at: Vec<[u32; PLACES]>,
}

/// The reduction for each of the radii [1/m]; for a sphere the radii are those without inclusions under the same force.
#[derive(Debug, Clone, Copy, Default)]
struct Reductions {
    tips: [f64; TIPS],
    loads: [f64; LOADS],
}

/// Additional displacement of a tip relative to its load at a location, for each radius of contact [1/m].
#[derive(Debug, Clone, Copy)]
pub(crate) struct TipExchange {
    least: f64,
    at: [f64; TIPS],
}

impl InclusionTable {
    /// For a tip on bodies with these inclusions, with their triangles in succession.
    pub(crate) fn new(tip: Tip, bodies: &[(&Surface, InclusionField)]) -> Self {
        if bodies.iter().all(|(_, field)| field.is_empty()) {
            return Self::default();
        }
        let (Tip::Flat { radius } | Tip::Sphere { radius }) = tip;
        let radii = radii(tip);
        let least = radii[0];
        let loads: [Load; LOADS] =
            std::array::from_fn(|n| Load::bump(MIN_LOAD * least * LOAD_FACTOR.powi(n as i32)));
        let (mut reductions, mut at) = (Vec::new(), Vec::new());
        for (surface, field) in bodies {
            let first = reductions.len();
            let places = places(surface, |places| {
                at.push(places.map(|own| (first + own) as u32))
            });
            reductions.extend(collect_on_all_cores(&places, |_, (place, normal)| {
                Reductions {
                    tips: match tip {
                        Tip::Flat { .. } => {
                            let load = Load::punch(radius);
                            [field.compliance_decrease(&[load], radius, place, normal)[0]; TIPS]
                        }
                        Tip::Sphere { .. } => {
                            let loads = radii.map(Load::hertz);
                            field.sphere_displacement_decrease(
                                radii,
                                field.compliance_decrease(&loads, radius, place, normal),
                            )
                        }
                    },
                    loads: field.compliance_decrease(&loads, radius, place, normal),
                }
            }));
        }
        Self {
            least,
            reductions,
            at,
        }
    }

    /// At a `place` [m] of a triangle of the displayed `mesh`, relative to a load of the radius `load` [m]; none
    /// without any effect.
    pub(crate) fn exchange(
        &self,
        mesh: &TriangleMesh,
        triangle: TriangleId,
        place: &Vec3,
        load: f64,
    ) -> Option<TipExchange> {
        let at = self.at.get(triangle.index())?;
        let on = closest_on_triangle(&mesh.positions(triangle), place);
        let [a, b, c] = on.barycentric;
        let corner = |l: f64| l * (2.0 * l - 1.0);
        let shape = [
            corner(a),
            corner(b),
            corner(c),
            4.0 * a * b,
            4.0 * b * c,
            4.0 * c * a,
        ];
        let (below, within) = position::<LOADS>(load / (MIN_LOAD * self.least), LOAD_FACTOR);
        let mut sums = [0.0; TIPS];
        for (own, shape) in at.iter().zip(shape) {
            let Reductions { tips, loads } = &self.reductions[*own as usize];
            let of_load = (1.0 - within) * loads[below] + within * loads[below + 1];
            for (sum, of_tip) in sums.iter_mut().zip(tips) {
                *sum += shape * (of_load - of_tip);
            }
        }
        Some(TipExchange {
            least: self.least,
            at: sums,
        })
    }
}

/// Contact areas for which inclusions are tabulated [m].
fn radii(tip: Tip) -> [f64; TIPS] {
    let least = match tip {
        Tip::Flat { radius } => radius,
        Tip::Sphere { radius } => radius * TIP_FACTOR.powi(1 - TIPS as i32),
    };
    std::array::from_fn(|n| least * TIP_FACTOR.powi(n as i32))
}

impl TipExchange {
    /// For inclusions that are in no mesh, at a `place` [m] and along an outward `normal` [-]: loads do not include
    /// them.
    pub(crate) fn unsolved(field: &InclusionField, tip: Tip, place: &Vec3, normal: &Vec3) -> Self {
        let radii = radii(tip);
        let less = match tip {
            Tip::Flat { radius } => {
                [field.compliance_decrease(&[Load::punch(radius)], radius, place, normal)[0]; TIPS]
            }
            Tip::Sphere { radius } => {
                let loads = radii.map(|touching| Load::punch(PUNCH_OF_HERTZ * touching));
                field.sphere_displacement_decrease(
                    radii,
                    field.compliance_decrease(&loads, radius, place, normal),
                )
            }
        };
        Self {
            least: radii[0],
            at: less.map(|less| -less),
        }
    }

    /// The value under the force at which the contact area would have the radius `touching` [m] without inclusions, and
    /// its derivative with the logarithm of the force.
    pub(crate) fn compliance(&self, touching: f64) -> [f64; 2] {
        let (below, within) = position::<TIPS>(touching / self.least, TIP_FACTOR);
        // Through the two with the slopes of those around them, which are continuous.
        let slope = |n: usize| {
            let (low, high) = (n.saturating_sub(1), (n + 1).min(TIPS - 1));
            (self.at[high] - self.at[low]) / (high - low) as f64
        };
        let (from, more) = (self.at[below], self.at[below + 1] - self.at[below]);
        let (start, end) = (slope(below), slope(below + 1));
        let (second, third) = (3.0 * more - 2.0 * start - end, start + end - 2.0 * more);
        let compliance = from + within * (start + within * (second + within * third));
        let growth = start + within * (2.0 * second + within * 3.0 * third);
        // Beyond all of them it is that of the last. And a ∝ F^(1/3).
        let is_between = within > 0.0 && within < 1.0;
        let growth = growth / (3.0 * TIP_FACTOR.ln());
        [compliance, if is_between { growth } else { 0.0 }]
    }
}

/// The index of the lower of two successive radii around `times` the first one, and the fraction in between.
fn position<const RADII: usize>(times: f64, factor: f64) -> (usize, f64) {
    let position = times.log(factor).clamp(0.0, (RADII - 1) as f64);
    let below = (position as usize).min(RADII - 2);
    (below, position - below as f64)
}

/// The nodes of a surface [m] and the outward normals there [-]: its vertices, then the middles of its edges.
/// `of_triangle` receives the node numbers of each triangle.
fn places(surface: &Surface, mut of_triangle: impl FnMut([usize; PLACES])) -> Vec<(Vec3, Vec3)> {
    let (vertices, normals) = (surface.mesh().vertices(), surface.vertex_normals());
    let each = vertices.iter().zip(normals);
    let mut places: Vec<(Vec3, Vec3)> =
        each.map(|(at, normal)| (*at, normal.normalize())).collect();
    let mut middles = HashMap::new();
    for triangle in surface.mesh().triangle_ids() {
        let [a, b, c] = surface.mesh().corners(triangle).map(NodeId::index);
        let mut middle = |one: usize, other: usize| {
            *middles
                .entry([one.min(other), one.max(other)])
                .or_insert_with(|| {
                    let normal = normals[one] * 0.5 + normals[other] * 0.5;
                    let at = vertices[one] * 0.5 + vertices[other] * 0.5;
                    places.push((at, normal.normalize()));
                    places.len() - 1
                })
        };
        of_triangle([a, b, c, middle(a, b), middle(b, c), middle(c, a)]);
    }
    places
}
