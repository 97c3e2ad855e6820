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
    let nu = kelvin.poissons_ratio();
    let n = panel.normal;
    let seen = Seen::from(panel, x, place);
    let (h, omega, sums) = (seen.height, seen.solid_angle, &seen.sums);
    let normals = n * n.transpose();
    let (inverse, along) = seen.distances(&n);
    let displacement = Matrix3::identity() * ((3.0 - 4.0 * nu) * inverse) + along;

    let away = 1.0 - 2.0 * nu;
    let q = sums.cube;
    let stretch = (Matrix3::identity() - normals) * omega - (q + n * (q * n).transpose()) * h
        + normals * (omega + h * q.trace());
    let turning = n * sums.outline.transpose() - sums.outline * n.transpose();
    let traction = Matrix3::identity() * (away * omega) + stretch - turning * away;
    PanelIntegrals {
        displacement: displacement * kelvin.displacement_factor(),
        traction: traction * kelvin.traction_factor(),
    }
}

/// ∫ 1/r dA [m] and ∫ r rᵀ/r³ dA [m] over `panel` from the place `x` [m], which lies `on` it or not.
pub(crate) fn distances(panel: &Panel, x: &Vec3, place: Place) -> (f64, Matrix3<f64>) {
    Seen::from(panel, x, place).distances(&panel.normal)
}

/// A panel, seen from a place.
struct Seen {
    height: f64,
    solid_angle: f64,
    sums: Sums,
}

impl Seen {
    fn from(panel: &Panel, x: &Vec3, place: Place) -> Self {
        let ends = panel.corners.map(|corner| corner - x);
        let (height, solid_angle) = match place {
            Place::Elsewhere => (ends[0].dot(&panel.normal), solid_angle(&ends)),
            Place::OnPanel => (0.0, 0.0),
        };
        let sums = Sums::around(&ends, &panel.normal, height);
        Self {
            height,
            solid_angle,
            sums,
        }
    }

    fn distances(&self, n: &Vec3) -> (f64, Matrix3<f64>) {
        let inverse = self.sums.inverse - self.height * self.solid_angle;
        let d = self.sums.distance;
        let normals = n * n.transpose();
        let hessian = d + n * (d * n).transpose() + normals * (2.0 * inverse - d.trace());
        (inverse, Matrix3::identity() * inverse - hessian)
    }
}

/// Where a place is, seen from a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// On the panel, inside its edges.
    OnPanel,
    /// Not on it.
    Elsewhere,
}

/// Sums over the edges.
struct Sums {
    /// Σ d L.
    inverse: f64,
    /// D.
    distance: Matrix3<f64>,
    /// Q.
    cube: Matrix3<f64>,
    /// l.
    outline: Vec3,
}

impl Sums {
    fn around(ends: &[Vec3; 3], n: &Vec3, h: f64) -> Self {
        let mut sums = Self {
            inverse: 0.0,
            distance: Matrix3::zeros(),
            cube: Matrix3::zeros(),
            outline: Vec3::zeros(),
        };
        for k in 0..3 {
            let (a, b) = (ends[k], ends[(k + 1) % 3]);
            let length = (b - a).norm();
            let m = (b - a) / length;
            let e = m.cross(n);
            let (d, s1) = (a.dot(&e), a.dot(&m));
            let s2 = s1 + length;
            let (r1, r2) = (a.norm(), b.norm());
            // The two forms are equal; each cancels where the other does not.
            let log = if s1 + s2 > 0.0 {
                ((r2 + s2) / (r1 + s1)).ln()
            } else {
                ((r1 - s1) / (r2 - s2)).ln()
            };
            let p = e * d + n * h;
            let q2 = d * d + h * h;
            let across = if q2 > 0.0 {
                p * ((s2 / r2 - s1 / r1) / q2)
            } else {
                Vec3::zeros()
            };
            sums.inverse += d * log;
            sums.distance += e * (p * log + m * (r2 - r1)).transpose();
            sums.cube += e * (across + m * (1.0 / r1 - 1.0 / r2)).transpose();
            sums.outline += e * log;
        }
        sums
    }
}

/// Solid angle of a triangle with corners at `ends`, positive seen from behind [Van Oosterom and Strackee 1983].
fn solid_angle(ends: &[Vec3; 3]) -> f64 {
    let [a, b, c] = ends;
    let [ra, rb, rc] = [a.norm(), b.norm(), c.norm()];
    let volume = a.dot(&b.cross(c));
    let rest = ra * rb * rc + a.dot(b) * rc + b.dot(c) * ra + c.dot(a) * rb;
    2.0 * volume.atan2(rest)
}
