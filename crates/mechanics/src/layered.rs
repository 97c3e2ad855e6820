//! The compliance of a half-space under bonded layers for a load on its surface.
//!
//! A load of wave number k along the surface moves it by a part of its own that follows from the stiffness of each layer, two
//! displacements at two faces, exactly [Kausel and Roësset 1981]: with z inwards, u = U(z) along k and W(z) inwards,
//!
//! ```text
//! (U, W) = (1, 1) e^(−kz),   (kz, 3 − 4ν + kz) e^(−kz),   and both seen from the lower face
//! ```
//!
//! span a layer's states, and e^(±kz) those of motion across k. A load p f(kR) with a round shape moves its own weighted
//! mean by
//!
//! ```text
//! c = 1/(2π) ∫ C(k) f²(kR) k dk
//! ```
//!
//! which is exact for a known load. That of a flat punch is the sum of three, (1 − (r/a)²) to the powers −1/2, 1/2 and 3/2,
//! that yields least under a given force: it is flat. Loads along the surface are taken to have the same shapes.
//!
//! *How we know*: tests of this module, `regions::…` of `simulate`.
//!
//! *Limits*: flat layers, small strain; a smooth punch.

use std::f64::consts::PI;

use nalgebra::{Matrix2, Matrix3, Matrix4, Vector3};

use crate::LinearElastic;

/// A half-space with layers on it.
#[derive(Debug, Clone, PartialEq)]
pub struct LayeredHalfSpace {
    /// Thickness [m] and law of each layer, from the surface inwards.
    pub layers: Vec<(f64, LinearElastic)>,
    /// The law of the half-space below.
    pub base: LinearElastic,
}

/// The shape of a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadShape {
    /// That of a flat punch on a half-space.
    Punch,
    /// (1 − (r/R)²)².
    Bump,
}

/// Samples of the integral over k R, and where it ends: beyond, the layers are as thick as the half-space.
const SAMPLES: usize = 400;
const HIGHEST: f64 = 40.0;
const LOWEST: f64 = 1e-4;

impl LayeredHalfSpace {
    /// Compliance for a load of this radius [m] over that of a half-space of the outermost law: along its surface, and
    /// along its normal [-].
    pub fn compliance_ratios(&self, shape: LoadShape, radius: f64) -> [f64; 2] {
        let [layered, uniform] = self.compliances(shape, radius);
        [0, 1].map(|axis| match shape {
            LoadShape::Bump => layered[axis][(0, 0)] / uniform[axis][(0, 0)],
            LoadShape::Punch => {
                let least = layered[axis].try_inverse();
                let least = least.map_or(f64::NAN, |inverse| 1.0 / inverse.sum());
                least / uniform[axis][(0, 0)]
            }
        })
    }

    /// Depth and force of a sphere without friction where an area of this radius [m] touches, over those on a half-space of
    /// the outermost law [-].
    ///
    /// Its pressure is the sum of the loads of a punch, of which the first, which has no end at the edge, is zero.
    pub fn under_sphere(&self, radius: f64) -> [f64; 2] {
        // Means of (r/a)² over the loads.
        let squares = Vector3::new(2.0 / 3.0, 2.0 / 5.0, 2.0 / 7.0);
        let at = |compliance: &Matrix3<f64>| {
            let inverse = compliance.try_inverse().unwrap_or_default();
            let (of_depth, of_shape) = (inverse * Vector3::repeat(1.0), inverse * squares);
            let depth = of_shape[0] / of_depth[0];
            [depth, depth * of_depth.sum() - of_shape.sum()]
        };
        let [layered, uniform] = self.compliances(LoadShape::Punch, radius);
        let [found, alone] = [at(&layered[1]), at(&uniform[1])];
        [found[0] / alone[0], found[1] / alone[1]]
    }

    /// Mutual compliances of the loads of a shape, along the surface and along its normal, and on a half-space of the
    /// outermost law, all times the same factor [-].
    fn compliances(&self, shape: LoadShape, radius: f64) -> [[Matrix3<f64>; 2]; 2] {
        let surface = self.layers.first().map_or(self.base, |(_, law)| *law);
        let alone = Self {
            layers: Vec::new(),
            base: surface,
        };
        // By trapezes in ln x, x = k R: the layers change the slowest waves most.
        let ratio = (HIGHEST / LOWEST).ln() / SAMPLES as f64;
        let (mut layered, mut uniform) = ([Matrix3::zeros(); 2], [Matrix3::zeros(); 2]);
        for sample in 0..=SAMPLES {
            let x = LOWEST * (ratio * sample as f64).exp();
            let k = x / radius;
            let end = if sample % SAMPLES == 0 { 0.5 } else { 1.0 };
            let loads = Vector3::from(shape.transforms(x));
            let weight = ratio * end * k * k * loads * loads.transpose();
            let (own, of_surface) = (self.compliance(k), alone.compliance(k));
            for axis in 0..2 {
                layered[axis] += own[axis] * weight;
                uniform[axis] += of_surface[axis] * weight;
            }
        }
        if shape == LoadShape::Punch {
            // Waves above the highest are left out of what the layers change alone.
            for axis in 0..2 {
                let mut exact = uniform[axis];
                let scale = alone.compliance(1.0)[axis] / radius;
                for n in 0..3 {
                    exact[(0, n)] = scale * PI / 2.0;
                    exact[(n, 0)] = exact[(0, n)];
                }
                layered[axis] += exact - uniform[axis];
                uniform[axis] = exact;
            }
        }
        [layered, uniform]
    }

    /// C(k) [m³/N] at the wave number `k` [1/m]: along the surface, the mean over all directions of k, and along the normal.
    fn compliance(&self, k: f64) -> [f64; 2] {
        let mut plane = half_space(&self.base, k);
        let mut across = self.base.shear_modulus() * k;
        for (thickness, law) in self.layers.iter().rev() {
            let layer = layer(law, k, *thickness);
            let block = |i, j| layer.fixed_view::<2, 2>(i, j).into_owned();
            let below = (block(2, 2) + plane).try_inverse().unwrap_or_default();
            plane = block(0, 0) - block(0, 2) * below * block(2, 0);
            let own = law.shear_modulus() * k;
            let tangent = (k * thickness).tanh();
            across = own * (across + own * tangent) / (own + across * tangent);
        }
        let plane = plane.try_inverse().unwrap_or_default();
        [0.5 * (plane[(0, 0)] + 1.0 / across), plane[(1, 1)]]
    }
}

impl LoadShape {
    /// f(x) of the loads that it is a sum of, each one at zero. That of the half-space under a punch is the first.
    fn transforms(self, x: f64) -> [f64; 3] {
        match self {
            // Of (1 − (r/R)²) to the powers −1/2, 1/2 and 3/2: spherical Bessel functions.
            Self::Punch if x > 0.1 => {
                let (sine, cosine) = x.sin_cos();
                let (zero, one) = (sine / x, (sine / x - cosine) / x);
                let two = 3.0 * one / x - zero;
                [zero, 3.0 * one / x, 15.0 * two / (x * x)]
            }
            // Their series, to x⁴.
            Self::Punch => [6.0, 10.0, 14.0].map(|first| 1.0 - x * x / first),
            Self::Bump => [bump(x), 0.0, 0.0],
        }
    }
}

/// 48 J₃(x)/x³.
pub(crate) fn bump(x: f64) -> f64 {
    // J₃(x)/x³ = 1/(15 π) ∫₀^π cos(x cos t) sin⁶ t dt: a smooth periodic function, for which the midpoint rule is exact to
    // rounding once it has more points than x/2.
    const POINTS: usize = 40;
    let each = (0..POINTS).map(|i| {
        let t = PI * (i as f64 + 0.5) / POINTS as f64;
        (x * t.cos()).cos() * t.sin().powi(6)
    });
    48.0 / (15.0 * POINTS as f64) * each.sum::<f64>()
}

/// A state of plane strain at a face.
struct Face {
    displacement: [f64; 2],
    /// σ_xz and σ_zz [Pa].
    stress: [f64; 2],
}

/// The two states that fade with the depth z [m].
fn states(law: &LinearElastic, k: f64, z: f64) -> [Face; 2] {
    let (nu, shear) = (law.poissons_ratio(), law.shear_modulus());
    let fades = (-k * z).exp();
    let kz = k * z;
    let more = 3.0 - 4.0 * nu;
    // U, W and their slopes over z.
    let each = [
        [1.0, 1.0, -k, -k],
        [kz, more + kz, k - k * kz, k - k * (more + kz)],
    ];
    each.map(|state| {
        let [u, w, u_slope, w_slope] = state.map(|value| fades * value);
        let dilation = k * u + w_slope;
        let lame = 2.0 * shear * nu / (1.0 - 2.0 * nu);
        Face {
            displacement: [u, w],
            stress: [
                shear * (u_slope - k * w),
                lame * dilation + 2.0 * shear * w_slope,
            ],
        }
    })
}

/// Tractions on the surface of a half-space over its displacements [Pa/m].
fn half_space(law: &LinearElastic, k: f64) -> Matrix2<f64> {
    let [one, other] = states(law, k, 0.0);
    let columns =
        |of: fn(&Face) -> [f64; 2]| Matrix2::from_columns(&[of(&one).into(), of(&other).into()]);
    let moved = columns(|face| face.displacement);
    let loaded = columns(|face| face.stress.map(|stress| -stress));
    loaded * moved.try_inverse().unwrap_or_default()
}

/// Tractions on the upper and the lower face of a layer over their displacements [Pa/m].
fn layer(law: &LinearElastic, k: f64, thickness: f64) -> Matrix4<f64> {
    let (upper, lower) = (states(law, k, 0.0), states(law, k, thickness));
    let (mut moved, mut loaded) = (Matrix4::zeros(), Matrix4::zeros());
    for (column, (near, far)) in upper.iter().zip(&lower).enumerate() {
        // From the upper face; and the same from the lower one, where inwards is upwards.
        let up = [near, far];
        let down = [far, near];
        for face in 0..2 {
            let outwards = [-1.0, 1.0][face];
            for axis in 0..2 {
                let row = 2 * face + axis;
                moved[(row, column)] = up[face].displacement[axis];
                loaded[(row, column)] = outwards * up[face].stress[axis];
                let mirrored = [1.0, -1.0][axis];
                moved[(row, column + 2)] = mirrored * down[face].displacement[axis];
                loaded[(row, column + 2)] = -mirrored * outwards * down[face].stress[axis];
            }
        }
    }
    loaded * moved.try_inverse().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(modulus: f64, ratio: f64) -> LinearElastic {
        LinearElastic::new(modulus, ratio).unwrap()
    }

    /// Closed forms: a half-space yields 2 (1 − ν²)/(E k) along its normal and (1 + ν)(2 − ν)/(E k) along its surface, also
    /// where layers of the same law are drawn into it.
    #[test]
    fn layers_of_one_law_are_a_half_space() {
        for ratio in [0.0, 0.3, 0.49] {
            let own = law(3.0, ratio);
            let body = LayeredHalfSpace {
                layers: vec![(0.2, own), (0.7, own)],
                base: own,
            };
            for k in [0.1, 1.0, 10.0] {
                let [along, normal] = body.compliance(k);
                let expected = 2.0 * (1.0 - ratio * ratio) / (3.0 * k);
                assert!(
                    (normal / expected - 1.0).abs() < 1e-9,
                    "{normal} {expected}"
                );
                let expected = (1.0 + ratio) * (2.0 - ratio) / (3.0 * k);
                assert!((along / expected - 1.0).abs() < 1e-9, "{along} {expected}");
            }
        }
    }

    /// Closed form: a layer on a rigid base under a smooth load of any wave length,
    /// 2 (1 − ν²)/(E k) ((3 − 4ν) sinh 2x − 2x)/((3 − 4ν) cosh 2x + 2x² + 5 − 12ν + 8ν²), x = k h [Hayes et al. 1972].
    #[test]
    fn a_bonded_layer_yields_as_its_closed_form() {
        let (ratio, height) = (0.4, 0.5);
        let body = LayeredHalfSpace {
            layers: vec![(height, law(3.0, ratio))],
            base: law(3e9, ratio),
        };
        for k in [0.1, 1.0, 4.0] {
            let (x, more) = (k * height, 3.0 - 4.0 * ratio);
            let above = more * (2.0 * x).sinh() - 2.0 * x;
            let below =
                more * (2.0 * x).cosh() + 2.0 * x * x + 5.0 - 12.0 * ratio + 8.0 * ratio * ratio;
            let expected = 2.0 * (1.0 - ratio * ratio) / (3.0 * k) * above / below;
            let found = body.compliance(k)[1];
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{k}: {found} {expected}"
            );
        }
    }

    /// Judge: J₃ of a table, J₃(1) = 0.019563354, J₃(5) = 0.364831231, J₃(20) = −0.098901395.
    #[test]
    fn a_bump_has_its_transform() {
        for (x, j3) in [
            (1.0, 0.019_563_354),
            (5.0, 0.364_831_231),
            (20.0, -0.098_901_395),
        ] {
            let expected = 48.0 * j3 / f64::powi(x, 3);
            assert!(
                (bump(x) - expected).abs() < 1e-8,
                "{x}: {} {expected}",
                bump(x)
            );
        }
        assert!((bump(1e-4) - 1.0).abs() < 1e-8);
    }

    /// Judge: a layer bonded to a rigid base under a flat punch, without friction, of ν = 0.3 and 0.5, by Hayes et al.'s
    /// integral equation [Hayes et al. 1972], to the digits of their table.
    #[test]
    fn a_punch_on_a_layer_meets_hayes_factor() {
        // Poisson's ratio, radius over thickness, factor.
        let table = [
            (0.3, 0.2, 1.207),
            (0.3, 0.4, 1.472),
            (0.3, 0.6, 1.784),
            (0.3, 0.8, 2.124),
            (0.3, 1.0, 2.480),
            (0.4999, 0.2, 1.281),
            (0.4999, 0.4, 1.683),
            (0.4999, 0.6, 2.211),
            (0.4999, 0.8, 2.855),
            (0.4999, 1.0, 3.609),
        ];
        for (ratio, of_height, factor) in table {
            let body = LayeredHalfSpace {
                layers: vec![(1.0, law(3.0, ratio))],
                base: law(3e9, ratio),
            };
            let found = 1.0 / body.compliance_ratios(LoadShape::Punch, of_height)[1];
            println!("{ratio} {of_height}: {found} {factor}");
            assert!((found / factor - 1.0).abs() < 0.005);
        }
    }

    /// Closed forms: Hertz where the layer is thick and where it is thin; far from the base, the force F of an area a is as on the
    /// layer alone, and the depth is larger by what a point force far away is moved: C F.
    #[test]
    fn a_sphere_on_a_layer_meets_hertz() {
        let (layer, base) = (law(8.0, 0.4), law(2.0, 0.4));
        let body = |thickness: f64| LayeredHalfSpace {
            layers: vec![(thickness, layer)],
            base,
        };
        let [depth, force] = body(1e-3).under_sphere(1.0);
        assert!(
            (depth - 1.0).abs() < 0.02 && (force * 4.0 - 1.0).abs() < 0.02,
            "{depth} {force}"
        );
        let [depth, force] = body(1e3).under_sphere(1.0);
        assert!(
            (depth - 1.0).abs() < 0.01 && (force - 1.0).abs() < 0.01,
            "{depth} {force}"
        );
        // On a paraboloid of unit radius: F = 4/3 E/(1 − ν²) a³; a punch of the radius a yields 1/(2 a) on the layer.
        let radius = 0.1;
        let [depth, force] = body(1.0).under_sphere(radius);
        let more = body(1.0).compliance_ratios(LoadShape::Punch, radius)[1] - 1.0;
        let expected = 4.0 / 3.0 * radius.powi(3) * more / (2.0 * radius);
        let found = (depth - 1.0) * radius * radius;
        assert!((force - 1.0).abs() < 0.01, "{force}");
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
    }

    /// A load is wider than its layer or narrower: the base's compliance, and the layer's.
    #[test]
    fn wide_loads_feel_the_base() {
        let body = LayeredHalfSpace {
            layers: vec![(1e-3, law(8.0, 0.4))],
            base: law(2.0, 0.4),
        };
        for shape in [LoadShape::Punch, LoadShape::Bump] {
            let [along, normal] = body.compliance_ratios(shape, 1.0);
            assert!((along / 4.0 - 1.0).abs() < 0.02 && (normal / 4.0 - 1.0).abs() < 0.02);
            let [along, normal] = body.compliance_ratios(shape, 1e-5);
            assert!((along - 1.0).abs() < 0.05 && (normal - 1.0).abs() < 0.05);
        }
    }
}
