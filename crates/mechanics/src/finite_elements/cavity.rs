//! A pressure that follows the wall it acts on, as the gradient of the volume V that the wall encloses.
//!
//! The work of a constant pressure is p ΔV, so its force is p ∂V/∂u and its tangent p ∂²V/∂u², both
//! symmetric. A body of small strain is loaded in its shape at rest. V = ∫ π r² dz over the meridian of
//! an axisymmetric wall, and V = ⅓ ∫ x · n da over a solid's: the same as the force of the pressure
//! wherever the edge of the wall is held or lies in a plane of symmetry through the origin.
//!
//! *How we know*: `tube::lame`, `tube::follows_the_closed_form`, `hexahedra::pressed_ring_is_lames`.
//!
//! *Limits*: an edge of the wall that is free to move off those planes would feel a wrong force; sides of tetrahedra
//! are refused.

use super::element::ElementKind;
use super::mismatch::Mismatch;
use super::model::FiniteElementModel;
use crate::{Error, Strain, Vec3};

/// A wall under pressure: sides of elements, three nodes each in an axisymmetric body and nine in a
/// solid of hexahedra.
#[derive(Debug, Clone, PartialEq)]
pub struct Cavity {
    /// Nodes of the sides. In an axisymmetric body walked with the pressure on the left, r to the right
    /// and z up: upward along the inner wall of a tube. In a solid numbered like [`super::ElementKind::Quad9`], the normal ξ × η pointing
    /// away from the pressure.
    pub sides: Vec<Vec<u32>>,
}

/// Volume [m³], its gradient [m²] and curvature [m] over the unknowns of one side.
struct SideVolume {
    volume: f64,
    gradient: Vec<f64>,
    curvature: Vec<f64>,
}

impl Cavity {
    /// The volume that the displaced wall encloses [m³].
    ///
    /// # Errors
    /// When the sides are none of the model, or the unknowns are not all of it.
    pub fn volume(&self, model: &FiniteElementModel, unknowns: &[f64]) -> Result<f64, Error> {
        self.check(model)?;
        model.check_length("the list of unknowns", unknowns.len())?;
        let each = |side: &Vec<u32>| side_volume(model, unknowns, side).volume;
        Ok(self.sides.iter().map(each).sum())
    }

    /// Every side has the nodes of a side of the model's elements, and they exist.
    pub(super) fn check(&self, model: &FiniteElementModel) -> Result<(), Mismatch> {
        let (kind, nodes) = (model.mesh.kind, model.mesh.nodes.len());
        let expected = match kind {
            ElementKind::Quad9 => 3,
            ElementKind::Hex27 => 9,
            ElementKind::Tet10 => return Err(Mismatch::CavityOfElements { kind }),
        };
        for (number, side) in self.sides.iter().enumerate() {
            if side.len() != expected {
                return Err(Mismatch::CavitySide {
                    side: number,
                    found: side.len(),
                    expected,
                });
            }
            if let Some(&node) = side.iter().find(|&&node| node as usize >= nodes) {
                return Err(Mismatch::NodeBeyondMesh {
                    what: "a side of the cavity",
                    node: node as usize,
                    nodes,
                });
            }
        }
        Ok(())
    }

    /// Adds ∂V/∂u, `factor` times, to `out`.
    pub(super) fn add_gradient(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        let dimension = model.dimension();
        let rest = is_small(model).then(|| vec![0.0; unknowns.len()]);
        let unknowns = rest.as_deref().unwrap_or(unknowns);
        for side in &self.sides {
            let gradient = side_volume(model, unknowns, side).gradient;
            for (place, value) in gradient.iter().enumerate() {
                out[side[place / dimension] as usize * dimension + place % dimension] +=
                    factor * value;
            }
        }
    }

    /// Adds ∂²V/∂u², `factor` times, to the lower triangle `values`.
    pub(super) fn add_curvature(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        factor: f64,
        values: &mut [f64],
    ) {
        if is_small(model) {
            return;
        }
        let dimension = model.dimension();
        for side in &self.sides {
            let curvature = side_volume(model, unknowns, side).curvature;
            let count = side.len() * dimension;
            let number =
                |place: usize| side[place / dimension] as usize * dimension + place % dimension;
            for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
                let (row, column) = (number(i), number(j));
                if row >= column {
                    values[model.pattern.index(row, column)] += factor * curvature[i * count + j];
                }
            }
        }
    }
}

fn is_small(model: &FiniteElementModel) -> bool {
    model.law.volume().strain == Strain::Small
}

fn side_volume(model: &FiniteElementModel, unknowns: &[f64], side: &[u32]) -> SideVolume {
    let dimension = model.dimension();
    let places: Vec<Vec3> = side
        .iter()
        .map(|&node| {
            let mut place = model.mesh.nodes[node as usize];
            for i in 0..dimension {
                place[i] += unknowns[node as usize * dimension + i];
            }
            place
        })
        .collect();
    if dimension == 2 {
        meridian(&places)
    } else {
        wall(&places)
    }
}

/// Gauss's three points on [−1, 1].
const LINE: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];

fn shape(x: f64) -> ([f64; 3], [f64; 3]) {
    (
        [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)],
        [x - 0.5, -2.0 * x, x + 0.5],
    )
}

/// V = ∫ π r² z' dξ.
fn meridian(places: &[Vec3]) -> SideVolume {
    use std::f64::consts::PI;
    let mut out = SideVolume {
        volume: 0.0,
        gradient: vec![0.0; 6],
        curvature: vec![0.0; 36],
    };
    for (x, weight) in LINE {
        let (n, slope) = shape(x);
        let r: f64 = (0..3).map(|a| n[a] * places[a].x).sum();
        let rise: f64 = (0..3).map(|a| slope[a] * places[a].y).sum();
        out.volume += weight * PI * r * r * rise;
        for a in 0..3 {
            out.gradient[2 * a] += weight * 2.0 * PI * r * n[a] * rise;
            out.gradient[2 * a + 1] += weight * PI * r * r * slope[a];
            for b in 0..3 {
                out.curvature[2 * a * 6 + 2 * b] += weight * 2.0 * PI * n[a] * n[b] * rise;
                let mixed = weight * 2.0 * PI * r * n[a] * slope[b];
                out.curvature[2 * a * 6 + 2 * b + 1] += mixed;
                out.curvature[(2 * b + 1) * 6 + 2 * a] += mixed;
            }
        }
    }
    out
}

/// V = ⅓ ∫ x · (x_ξ × x_η) dξ dη.
fn wall(places: &[Vec3]) -> SideVolume {
    let count = 27;
    let mut out = SideVolume {
        volume: 0.0,
        gradient: vec![0.0; count],
        curvature: vec![0.0; count * count],
    };
    for ((xi, w1), (eta, w2)) in LINE.iter().flat_map(|a| LINE.iter().map(move |b| (*a, *b))) {
        let ((n, dn), (m, dm)) = (shape(xi), shape(eta));
        let value = |a: usize| n[a % 3] * m[a / 3];
        let along = |a: usize| dn[a % 3] * m[a / 3];
        let across = |a: usize| n[a % 3] * dm[a / 3];
        let sum = |f: &dyn Fn(usize) -> f64| (0..9).map(|a| f(a) * places[a]).sum::<Vec3>();
        let (x, e, h) = (sum(&value), sum(&along), sum(&across));
        let weight = w1 * w2 / 3.0;
        out.volume += weight * x.dot(&e.cross(&h));
        for a in 0..9 {
            // The triple product is linear in each of x, x_ξ, x_η.
            let gradient =
                value(a) * e.cross(&h) + along(a) * h.cross(&x) + across(a) * x.cross(&e);
            for i in 0..3 {
                out.gradient[3 * a + i] += weight * gradient[i];
            }
            for b in 0..9 {
                let pair = (value(a) * along(b) - along(a) * value(b)) * h
                    + (along(a) * across(b) - across(a) * along(b)) * x
                    + (across(a) * value(b) - value(a) * across(b)) * e;
                // u_a · (u_b × pair) is bilinear: the cross matrix of pair, turned.
                let cross = pair.cross_matrix();
                for i in 0..3 {
                    for k in 0..3 {
                        out.curvature[(3 * a + i) * count + 3 * b + k] -= weight * cross[(i, k)];
                    }
                }
            }
        }
    }
    out
}
