//! A pressure that follows the wall it acts on, as the gradient of the volume V that the wall encloses.
//!
//! The work of a constant pressure is p ΔV, so its force is p ∂V/∂u and its tangent p ∂²V/∂u², both
//! symmetric. A body of small strain is loaded in its shape at rest. V = ∫ π r² dz over the meridian of
//! an axisymmetric wall, and V = ⅓ ∫ x · n da over a solid's: the same as the force of the pressure
//! wherever the edge of the wall is fixed or lies in a plane of symmetry through the origin.
//!
//! A fluid that keeps its volume V₁ makes stationary Π − p (V − V₁) with its pressure p as an unknown of its own, whose row of
//! the matrix carries −ε V₀/μ for the reason given in `assembly`.
//!
//! *How we know*: `tube::lame`, `tube::follows_the_closed_form`, `hexahedra::pressed_ring_is_lames`, `cavities::…`.
//!
//! *Limits*: the force is wrong at an edge of the wall that is free to move off those planes; `pressed_faces` is for
//! such parts of a boundary.

use std::sync::LazyLock;

use super::assembly::PRESSURE_REGULARIZATION;
use super::element::ElementKind;
use super::mismatch::Mismatch;
use super::model::{FiniteElementModel, FiniteElementWorkspace};
use crate::{Error, Strain, Vec3};

/// A wall under pressure: sides of elements, three nodes each in an axisymmetric body, nine in a solid of hexahedra and six
/// in one of tetrahedra.
#[derive(Debug, Clone, PartialEq)]
pub struct Cavity {
    /// Nodes of the sides. In an axisymmetric body walked with the pressure on the left, r to the right
    /// and z up: upward along the inner wall of a tube. In a solid numbered like [`super::ElementKind::Quad9`], the normal ξ × η pointing
    /// away from the pressure. Of tetrahedra the three corners, counter-clockwise seen from the body, then the middles of
    /// their edges, the first of which lies between the first two.
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
        Ok(self.enclosed(model, unknowns))
    }

    fn enclosed(&self, model: &FiniteElementModel, unknowns: &[f64]) -> f64 {
        let each = self.sides.iter();
        each.map(|side| side_volume(model, unknowns, side).volume)
            .sum()
    }

    /// The volume that the wall encloses at rest [m³].
    pub(super) fn volume_at_rest(&self, model: &FiniteElementModel) -> f64 {
        self.enclosed(model, &vec![0.0; model.size()])
    }

    /// Change of the volume by the displacements [m³]; to the first order where strain is small.
    pub(super) fn growth(&self, model: &FiniteElementModel, unknowns: &[f64]) -> f64 {
        if is_small(model) {
            let mut gradient = vec![0.0; unknowns.len()];
            self.add_gradient(model, unknowns, 1.0, &mut gradient);
            return gradient.iter().zip(unknowns).map(|(g, u)| g * u).sum();
        }
        self.enclosed(model, unknowns) - self.volume_at_rest(model)
    }

    /// Every side has the nodes of a side of the model's elements, and they exist.
    pub(super) fn check(&self, model: &FiniteElementModel) -> Result<(), Mismatch> {
        let (kind, nodes) = (model.mesh.kind, model.mesh.nodes.len());
        let expected = match kind {
            ElementKind::Quad9 => 3,
            ElementKind::Hex27 => 9,
            ElementKind::Tet10 => 6,
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

    /// Adds the pressure of a fluid that keeps its volume, which is the unknown of this `number`; how much fluid there is
    /// beyond the volume at rest is a load.
    pub(super) fn add_constraint(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        number: usize,
        workspace: &mut FiniteElementWorkspace,
    ) {
        let pressure = unknowns[number];
        let mut gradient = vec![0.0; model.size()];
        self.add_gradient(model, unknowns, 1.0, &mut gradient);
        let (at_rest, change) = (self.volume_at_rest(model), self.growth(model, unknowns));
        let (residual, tangent) = (&mut workspace.residual, &mut workspace.tangent);
        for (column, slope) in gradient
            .iter()
            .enumerate()
            .filter(|(_, slope)| **slope != 0.0)
        {
            residual[column] -= pressure * slope;
            tangent[model.pattern.index(number, column)] -= slope;
        }
        residual[number] -= change;
        tangent[model.pattern.index(number, number)] -=
            PRESSURE_REGULARIZATION * at_rest / model.shear_modulus;
        self.add_curvature(model, unknowns, -pressure, tangent);
    }
}

pub(super) fn is_small(model: &FiniteElementModel) -> bool {
    model.law.volume().strain == Strain::Small
}

/// Positions of `nodes` with these `unknowns` [m].
pub(super) fn moved(model: &FiniteElementModel, unknowns: &[f64], nodes: &[u32]) -> Vec<Vec3> {
    let dimension = model.dimension();
    let each = nodes.iter().map(|&node| {
        let mut place = model.mesh.nodes[node as usize];
        for i in 0..dimension {
            place[i] += unknowns[node as usize * dimension + i];
        }
        place
    });
    each.collect()
}

fn side_volume(model: &FiniteElementModel, unknowns: &[f64], side: &[u32]) -> SideVolume {
    let places = moved(model, unknowns, side);
    match places.len() {
        3 => meridian(&places),
        6 => wall(&places, &TRIANGLE_PAIRS),
        _ => wall(&places, &SQUARE_PAIRS),
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

/// A point of integration on a side of N nodes: their shape functions, the derivatives of these, and its weight.
pub(super) struct SidePoint<const N: usize> {
    pub(super) value: [f64; N],
    pub(super) along: [f64; N],
    pub(super) across: [f64; N],
    pub(super) weight: f64,
}

/// Of the square [−1, 1]², nodes numbered like those of [`ElementKind::Quad9`].
fn square_points() -> [SidePoint<9>; 9] {
    std::array::from_fn(|point| {
        let [(xi, w1), (eta, w2)] = [LINE[point / 3], LINE[point % 3]];
        let ((n, dn), (m, dm)) = (shape(xi), shape(eta));
        SidePoint {
            value: std::array::from_fn(|a| n[a % 3] * m[a / 3]),
            along: std::array::from_fn(|a| dn[a % 3] * m[a / 3]),
            across: std::array::from_fn(|a| n[a % 3] * dm[a / 3]),
            weight: w1 * w2,
        }
    })
}

/// Points of degree four in the triangle of the corners (0, 0), (1, 0), (0, 1) [Dunavant 1985]: the triple product of a
/// quadratic side has that degree.
pub(super) const TRIANGLE: [([f64; 2], f64); 6] = [
    (
        [0.445_948_490_915_965, 0.445_948_490_915_965],
        0.111_690_794_839_005_7,
    ),
    (
        [0.108_103_018_168_070, 0.445_948_490_915_965],
        0.111_690_794_839_005_7,
    ),
    (
        [0.445_948_490_915_965, 0.108_103_018_168_070],
        0.111_690_794_839_005_7,
    ),
    (
        [0.091_576_213_509_771, 0.091_576_213_509_771],
        0.054_975_871_827_661,
    ),
    (
        [0.816_847_572_980_459, 0.091_576_213_509_771],
        0.054_975_871_827_661,
    ),
    (
        [0.091_576_213_509_771, 0.816_847_572_980_459],
        0.054_975_871_827_661,
    ),
];

pub(super) fn triangle_point(([x, y], weight): ([f64; 2], f64)) -> SidePoint<6> {
    let rest = 1.0 - x - y;
    SidePoint {
        value: [
            rest * (2.0 * rest - 1.0),
            x * (2.0 * x - 1.0),
            y * (2.0 * y - 1.0),
            4.0 * rest * x,
            4.0 * x * y,
            4.0 * y * rest,
        ],
        along: [
            1.0 - 4.0 * rest,
            4.0 * x - 1.0,
            0.0,
            4.0 * (rest - x),
            4.0 * y,
            -4.0 * y,
        ],
        across: [
            1.0 - 4.0 * rest,
            0.0,
            4.0 * y - 1.0,
            -4.0 * x,
            4.0 * x,
            4.0 * (rest - y),
        ],
        weight,
    }
}

/// Coefficients T of the volume V = ⅓ ∫ x · (x_ξ × x_η) dξ dη at a side of N nodes. It is cubic in their places, so that its
/// third derivative is constant:
///
/// ```text
/// c_ab = Σ_c T_abc x_c,   ∂²V/∂x_a ∂x_b: d_b ↦ d_b × c_ab,   ∂V/∂x_a = ½ Σ_b x_b × c_ab,   V = ⅓ Σ_a x_a · ∂V/∂x_a
/// ```
pub(crate) type Pairs<const N: usize> = [[[f64; N]; N]; N];

/// T of six nodes.
pub(crate) static TRIANGLE_PAIRS: LazyLock<Pairs<6>> =
    LazyLock::new(|| pairs(&TRIANGLE.map(triangle_point)));

/// T of nine nodes.
static SQUARE_PAIRS: LazyLock<Pairs<9>> = LazyLock::new(|| pairs(&square_points()));

fn pairs<const N: usize>(points: &[SidePoint<N>]) -> Pairs<N> {
    let mut sum = [[[0.0; N]; N]; N];
    for point in points {
        let SidePoint {
            value,
            along,
            across,
            weight,
        } = point;
        for (a, b) in (0..N * N).map(|k| (k / N, k % N)) {
            let minor = |f: &[f64; N], g: &[f64; N]| weight / 3.0 * (f[a] * g[b] - g[a] * f[b]);
            for c in 0..N {
                sum[a][b][c] += minor(value, along) * across[c]
                    + minor(along, across) * value[c]
                    + minor(across, value) * along[c];
            }
        }
    }
    sum
}

fn wall<const N: usize>(places: &[Vec3], pairs: &Pairs<N>) -> SideVolume {
    let count = 3 * N;
    let mut out = SideVolume {
        volume: 0.0,
        gradient: vec![0.0; count],
        curvature: vec![0.0; count * count],
    };
    for (a, b) in (0..N * N).map(|k| (k / N, k % N)) {
        let pair: Vec3 = pairs[a][b].iter().zip(places).map(|(t, x)| *t * x).sum();
        let gradient = 0.5 * places[b].cross(&pair);
        let cross = pair.cross_matrix();
        for i in 0..3 {
            out.gradient[3 * a + i] += gradient[i];
            for k in 0..3 {
                out.curvature[(3 * a + i) * count + 3 * b + k] -= cross[(i, k)];
            }
        }
        out.volume += places[a].dot(&gradient) / 3.0;
    }
    out
}
