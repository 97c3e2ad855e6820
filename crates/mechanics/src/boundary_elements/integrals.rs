//! Kelvin's kernels integrated over a flat triangle, in closed form for every place, its own centroid
//! included.
//!
//! With r = y − x, h = r·n, and per edge the unit tangent m, the outward in-plane normal e, d = (a − x)·e,
//! s₁ = (a − x)·m, s₂ = (b − x)·m, r₁, r₂ the distances of its ends, L = ln((r₂ + s₂)/(r₁ + s₁)),
//! p = d e + h n and q² = d² + h²:
//!
//! ```text
//! Ω = ∫ h/r³           the solid angle
//! I = ∫ 1/r            = Σ d L − h Ω
//! ∫ rᵢ rₖ/r³           = I 1 − (D + n ⊗ D n + (2 I − tr D) n ⊗ n),  D = Σ e ⊗ (p L + m (r₂ − r₁))
//! 3 h ∫ rᵢ rₖ/r⁵       = (1 − n n) Ω − h (Q + n ⊗ Q n) + (Ω + h tr Q) n n,
//!                        Q = Σ e ⊗ (p (s₂/r₂ − s₁/r₁)/q² + m (1/r₁ − 1/r₂))
//! ∫ (r ⊗ n − n ⊗ r)/r³ = n ⊗ l − l ⊗ n,  l = Σ e L
//! ```
//!
//! All follow from Gauss's theorem in the plane of the triangle.
//!
//! *How we know*: `boundary_elements::closed_forms_are_the_integrals_of_the_kernels`.
//!
//! *Limits*: a place on an edge or a corner has no value.

use nalgebra::Matrix3;

use super::kelvin::Kelvin;
use super::panel::Panel;
use crate::Vec3;

/// Integrals of Kelvin's kernels over a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelIntegrals {
    /// ∫ u* dA [m³/N].
    pub displacement: Matrix3<f64>,
    /// ∫ p* dA [-]; the principal value where the place lies on the panel.
    pub traction: Matrix3<f64>,
}

/// Both integrals over `panel` from the place `x` [m], which lies `on` it or not.
pub fn integrate(kelvin: &Kelvin, panel: &Panel, x: &Vec3, place: Place) -> PanelIntegrals {
    let source = Source::new(panel);
    PanelIntegrals {
        displacement: source.displacement(kelvin, x, place),
        traction: source.traction(kelvin, x, place),
    }
}

/// A place relative to a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// On the panel, inside its edges.
    OnPanel,
    /// Not on it.
    Elsewhere,
}

/// A panel whose integrals are wanted from many places.
pub(crate) struct Source<'a> {
    panel: &'a Panel,
    edges: [Edge; 3],
}

/// An edge: m, e and its length.
struct Edge {
    along: Vec3,
    outward: Vec3,
    length: f64,
}

/// A panel as it is seen from a place.
struct Seen {
    corners: [Vec3; 3],
    /// r₁ and r₂ of the edges.
    distances: [f64; 3],
    /// h.
    height: f64,
    /// Ω.
    solid_angle: f64,
}

/// An edge as it is seen from a place: d, s₁, s₂, L.
struct SeenEdge {
    away: f64,
    ends: [f64; 2],
    log: f64,
}

impl<'a> Source<'a> {
    /// The triangle `panel`.
    pub(crate) fn new(panel: &'a Panel) -> Self {
        let edges = [0, 1, 2].map(|k| {
            let way = panel.corners[(k + 1) % 3] - panel.corners[k];
            let length = way.norm();
            let along = way / length;
            let outward = along.cross(&panel.normal);
            Edge {
                along,
                outward,
                length,
            }
        });
        Self { panel, edges }
    }

    /// ∫ u* dA [m³/N].
    pub(super) fn displacement(&self, kelvin: &Kelvin, x: &Vec3, place: Place) -> Matrix3<f64> {
        let (inverse, along) = self.distances(x, place);
        let shape = 3.0 - 4.0 * kelvin.poissons_ratio();
        (Matrix3::from_diagonal_element(shape * inverse) + along) * kelvin.displacement_factor()
    }

    /// ∫ p* dA [-].
    pub(super) fn traction(&self, kelvin: &Kelvin, x: &Vec3, place: Place) -> Matrix3<f64> {
        let away = 1.0 - 2.0 * kelvin.poissons_ratio();
        let (n, seen) = (self.panel.normal, self.seen(x, place));
        let (h, omega) = (seen.height, seen.solid_angle);
        let (mut q, mut outline) = (Matrix3::zeros(), Vec3::zeros());
        for (k, edge) in self.edges.iter().enumerate() {
            let SeenEdge { away, ends, log } = seen.edge(edge, k);
            let [inverse1, inverse2] = [k, k + 1].map(|end| 1.0 / seen.distances[end % 3]);
            let squared = away * away + h * h;
            // A place on the line of the edge sees nothing of it.
            let across = if squared > 0.0 {
                (ends[1] * inverse2 - ends[0] * inverse1) / squared
            } else {
                0.0
            };
            let p = edge.outward * away + n * h;
            let row = p * across + edge.along * (inverse1 - inverse2);
            q += edge.outward * row.transpose();
            outline += edge.outward * log;
        }
        let normals = n * n.transpose();
        let stretch = Matrix3::from_diagonal_element((1.0 + away) * omega)
            - (q + n * (q * n).transpose()) * h
            + normals * (h * q.trace());
        let turning = n * outline.transpose() - outline * n.transpose();
        (stretch - turning * away) * kelvin.traction_factor()
    }

    /// ∫ 1/r dA [m] and ∫ r rᵀ/r³ dA [m] from the place `x` [m], which lies `on` the panel or not.
    pub(crate) fn distances(&self, x: &Vec3, place: Place) -> (f64, Matrix3<f64>) {
        let (n, seen) = (self.panel.normal, self.seen(x, place));
        let h = seen.height;
        let (mut inverse, mut d) = (-h * seen.solid_angle, Matrix3::zeros());
        for (k, edge) in self.edges.iter().enumerate() {
            let SeenEdge { away, log, .. } = seen.edge(edge, k);
            let longer = seen.distances[(k + 1) % 3] - seen.distances[k];
            let p = edge.outward * away + n * h;
            inverse += away * log;
            d += edge.outward * (p * log + edge.along * longer).transpose();
        }
        let normals = n * n.transpose();
        let hessian = d + n * (d * n).transpose() + normals * (2.0 * inverse - d.trace());
        (inverse, Matrix3::from_diagonal_element(inverse) - hessian)
    }

    fn seen(&self, x: &Vec3, place: Place) -> Seen {
        let corners = self.panel.corners.map(|corner| corner - x);
        let distances = corners.map(|corner| corner.norm());
        let (height, solid_angle) = match place {
            Place::Elsewhere => (
                corners[0].dot(&self.panel.normal),
                solid_angle(&corners, &distances),
            ),
            Place::OnPanel => (0.0, 0.0),
        };
        Seen {
            corners,
            distances,
            height,
            solid_angle,
        }
    }
}

impl Seen {
    fn edge(&self, edge: &Edge, k: usize) -> SeenEdge {
        let first = self.corners[k].dot(&edge.along);
        let ends = [first, first + edge.length];
        let [r1, r2] = [self.distances[k], self.distances[(k + 1) % 3]];
        // The two forms are equal; each cancels where the other does not.
        let log = if ends[0] + ends[1] > 0.0 {
            ((r2 + ends[1]) / (r1 + ends[0])).ln()
        } else {
            ((r1 - ends[0]) / (r2 - ends[1])).ln()
        };
        SeenEdge {
            away: self.corners[k].dot(&edge.outward),
            ends,
            log,
        }
    }
}

/// Solid angle of a triangle with corners at `ends` and `distances`, positive seen from behind
/// [Van Oosterom and Strackee 1983].
fn solid_angle(ends: &[Vec3; 3], distances: &[f64; 3]) -> f64 {
    let [a, b, c] = ends;
    let [ra, rb, rc] = distances;
    let volume = a.dot(&b.cross(c));
    let rest = ra * rb * rc + a.dot(b) * rc + b.dot(c) * ra + c.dot(a) * rb;
    2.0 * volume.atan2(rest)
}
