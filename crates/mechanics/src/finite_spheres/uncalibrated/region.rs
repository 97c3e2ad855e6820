//! The map from the template, half a unit ball, to the organ under a tip of unit radius.
//!
//! A template place is (σ, φ, f): distance from the contact in the half ball, azimuth, fraction of the
//! polar angle. The organ's distance r obeys 1/r = (1 − σ²)/(c σ) + 1/b(f, φ): far away r ≈ c/(2 (1 − σ)),
//! so that a field that falls as 1/r is linear in σ, and σ = 1 is the fixed boundary of the organ, at the
//! distance b, infinite on a half-space. The polar angle is f ψ(r, φ), with ψ that of the surface.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Vector3};

use crate::Vec3;

/// c [tip radii]: half of the template lies within about this distance.
const SCALE: f64 = 4.0;

/// Bounds of κ r/2, the sine of the turn of the surface, where it bends down and where it bends up: an organ
/// that went on bending up would leave no half-space below, and is flat from there on.
const STEEPEST_DOWN: f64 = 0.95;
const STEEPEST_UP: f64 = 0.3;

/// Where the surface bends up with the curvature κ the base is never met, and where that begins, along the azimuth, 1/b
/// grows as √(κ/t): its slope has no finite energy. So 1/b is nowhere less than this part of √(κ/t) [-].
const LEAST: f64 = 0.2;

/// The organ around a contact; lengths in tip radii.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Region {
    /// κ₁₁, κ₁₂, κ₂₂ [1/tip radius].
    pub(super) curvature: Vector3<f64>,
    /// Distance along the inward normal to the fixed base of the organ [tip radii].
    pub(super) thickness: f64,
}

/// A place of the template: σ, φ, f.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TemplatePlace {
    pub(super) distance: f64,
    pub(super) azimuth: f64,
    pub(super) fraction: f64,
}

/// A place of the template mapped into the organ, with the derivatives that integration needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mapped {
    /// Distance from the contact [tip radii].
    pub(super) distance: f64,
    /// 1/b, b being the distance of the fixed boundary in this direction [1/tip radius].
    pub(super) inverse_fixed_distance: f64,
    /// The place with the surface bent flat [tip radii]: where the punch's field is evaluated.
    pub(super) flat: Vec3,
    /// |det ∂x/∂(σ, φ, f)|.
    pub(super) volume: f64,
    /// ∂y/∂x, y being the place in the half ball.
    pub(super) template_by_place: Matrix3<f64>,
    /// ∂(flat)/∂x.
    pub(super) flat_by_place: Matrix3<f64>,
    /// ∇(1 − r/b), the factor that vanishes on the fixed boundary.
    pub(super) factor_gradient: Vec3,
}

/// y of a place in the half ball.
pub(super) fn in_half_ball(place: &TemplatePlace) -> Vec3 {
    spherical(place.distance, place.fraction * FRAC_PI_2, place.azimuth)
}

impl Region {
    /// ψ(r, φ) and its derivatives by r and φ.
    fn surface_angle(&self, radius: f64, azimuth: f64) -> (f64, f64, f64) {
        let (sine, cosine) = azimuth.sin_cos();
        let [k11, k12, k22] = self.curvature.into();
        let along = k11 * cosine * cosine + 2.0 * k12 * cosine * sine + k22 * sine * sine;
        let turning =
            2.0 * (k22 - k11) * sine * cosine + 2.0 * k12 * (cosine.powi(2) - sine.powi(2));
        let m = 0.5 * along * radius;
        let (m, growth) = bounded(m);
        let slope = -0.5 * growth / (1.0 - m * m).sqrt();
        (
            FRAC_PI_2 - m.asin(),
            slope * along,
            slope * turning * radius,
        )
    }

    /// 1/b and its derivatives by φ and f; zero where the organ is not fixed.
    fn inverse_fixed_distance(&self, azimuth: f64, fraction: f64) -> [f64; 3] {
        if !self.thickness.is_finite() {
            return [0.0; 3];
        }
        let [q, by_azimuth, by_fraction] = self.inverse_base(azimuth, fraction);
        let [k11, k12, k22] = self.curvature.into();
        let up = (0.5 * (k11 - k22)).hypot(k12) - 0.5 * (k11 + k22);
        if up <= 0.0 {
            return [q, by_azimuth, by_fraction];
        }
        // Smooth at zero. At κ t = 1 the base comes nearer below the contact by 4 · 10⁻⁴.
        let least = LEAST * (up.min(1.0 / self.thickness) / self.thickness).sqrt();
        let inverse_b = (q.powi(4) + least.powi(4)).powf(0.25);
        let slope = (q / inverse_b).powi(3);
        [inverse_b, slope * by_azimuth, slope * by_fraction]
    }

    /// One over the distance of the base and its derivatives by φ and f; zero where the base is not met.
    fn inverse_base(&self, azimuth: f64, fraction: f64) -> [f64; 3] {
        // Depth over distance, cos(f ψ), minus t/r: positive beyond the base.
        let beyond = |q: f64| {
            let (surface, ..) = self.surface_angle(1.0 / q, azimuth);
            (fraction * surface).cos() - self.thickness * q
        };
        let (mut low, mut high) = (0.0, 1.0001 / self.thickness);
        while high - low > 1e-14 / self.thickness {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if beyond(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        if low == 0.0 {
            return [0.0; 3];
        }
        let (surface, by_radius, by_azimuth) = self.surface_angle(1.0 / high, azimuth);
        let sine = (fraction * surface).sin();
        let by_q = sine * fraction * by_radius / (high * high) - self.thickness;
        [
            high,
            sine * fraction * by_azimuth / by_q,
            sine * surface / by_q,
        ]
    }

    /// Distance in the half ball of the place at `radius` [tip radii]; none beyond the fixed boundary.
    pub(super) fn template_distance(
        &self,
        radius: f64,
        azimuth: f64,
        fraction: f64,
    ) -> Option<f64> {
        let [inverse_b, ..] = self.inverse_fixed_distance(azimuth, fraction);
        let inverse = 1.0 / radius - inverse_b;
        (inverse > 0.0).then(|| half_ball_distance(1.0 / inverse))
    }

    /// 1 − r/b at a place.
    pub(super) fn vanishing_factor(&self, radius: f64, azimuth: f64, fraction: f64) -> f64 {
        let [inverse_b, ..] = self.inverse_fixed_distance(azimuth, fraction);
        (1.0 - radius * inverse_b).max(0.0)
    }

    /// Distance, azimuth and fraction of a place `x` [tip radii]; above the surface that of the surface.
    pub(super) fn coordinates(&self, x: &Vec3) -> (f64, f64, f64) {
        let radius = x.norm();
        let outwards = x.x.hypot(x.y);
        let azimuth = if outwards > 0.0 { x.y.atan2(x.x) } else { 0.0 };
        let (surface, ..) = self.surface_angle(radius, azimuth);
        let fraction = outwards.atan2(-x.z).clamp(0.0, PI) / surface;
        (radius, azimuth, fraction.min(1.0))
    }

    pub(super) fn map(&self, place: &TemplatePlace) -> Mapped {
        let TemplatePlace {
            distance: sigma,
            azimuth,
            fraction,
        } = *place;
        let [inverse_b, inverse_b_by_azimuth, inverse_b_by_fraction] =
            self.inverse_fixed_distance(azimuth, fraction);
        let inverse = (1.0 - sigma * sigma) / (SCALE * sigma) + inverse_b;
        let r = 1.0 / inverse;
        let by_inverse = -r * r;
        let radial = Vec3::new(
            -by_inverse * (1.0 + sigma * sigma) / (SCALE * sigma * sigma),
            by_inverse * inverse_b_by_azimuth,
            by_inverse * inverse_b_by_fraction,
        );
        let (surface, by_radius, by_azimuth) = self.surface_angle(r, azimuth);
        let polar = fraction * surface;
        let turning =
            radial * (fraction * by_radius) + Vec3::new(0.0, fraction * by_azimuth, surface);
        let flat_polar = fraction * FRAC_PI_2;
        let flat_turning = Vec3::new(0.0, 0.0, FRAC_PI_2);
        let by_template = columns(r, radial, polar, turning, azimuth);
        let flat = columns(r, radial, flat_polar, flat_turning, azimuth);
        let ball = columns(sigma, Vec3::x(), flat_polar, flat_turning, azimuth);
        let inverted = by_template.try_inverse();
        let inverted = inverted.unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        let factor_gradient =
            radial * -inverse_b - Vec3::new(0.0, inverse_b_by_azimuth, inverse_b_by_fraction) * r;
        Mapped {
            distance: r,
            inverse_fixed_distance: inverse_b,
            flat: spherical(r, flat_polar, azimuth),
            volume: by_template.determinant().abs(),
            template_by_place: ball * inverted,
            flat_by_place: flat * inverted,
            factor_gradient: inverted.tr_mul(&factor_gradient),
        }
    }
}

/// σ of a distance on the half-space [tip radii].
pub(super) fn half_ball_distance(radius: f64) -> f64 {
    let ratio = radius / SCALE;
    2.0 * ratio / (1.0 + (1.0 + 4.0 * ratio * ratio).sqrt())
}

/// κ r/2 within its bounds, smoothly, and the derivative of that. At 0.7, the rim of a hemisphere, it takes
/// 1 % away, at −0.03 half a percent.
fn bounded(m: f64) -> (f64, f64) {
    let (bound, power) = match m >= 0.0 {
        true => (STEEPEST_DOWN, 8),
        false => (STEEPEST_UP, 2),
    };
    let base = 1.0 + (m.abs() / bound).powi(power);
    let root = base.powf(-1.0 / f64::from(power));
    (m * root, root / base)
}

fn spherical(radius: f64, polar: f64, azimuth: f64) -> Vec3 {
    let (sine, cosine) = azimuth.sin_cos();
    let (across, along) = polar.sin_cos();
    radius * Vec3::new(across * cosine, across * sine, -along)
}

/// Derivatives of a place at (r, polar, azimuth) by (σ, φ, f), given those of r and of the polar angle.
fn columns(r: f64, radial: Vec3, polar: f64, turning: Vec3, azimuth: f64) -> Matrix3<f64> {
    let (sine, cosine) = azimuth.sin_cos();
    let (across, along) = polar.sin_cos();
    let outward = Vec3::new(across * cosine, across * sine, -along);
    let down = Vec3::new(along * cosine, along * sine, across);
    let around = Vec3::new(-sine, cosine, 0.0) * (r * across);
    outward * radial.transpose() + r * down * turning.transpose() + around * Vec3::y().transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place_in_organ(region: &Region, place: &TemplatePlace) -> Vec3 {
        let r = region.map(place).distance;
        let (surface, ..) = region.surface_angle(r, place.azimuth);
        spherical(r, place.fraction * surface, place.azimuth)
    }

    /// Judge: central differences of the map itself.
    #[test]
    fn derivatives_are_those_of_the_map() {
        for (curvature, thickness) in [
            ([0.0, 0.0, 0.0], f64::INFINITY),
            ([0.1, 0.02, 0.05], 8.0),
            ([0.0, 0.0, 0.0], 3.0),
            ([0.1, 0.0, -0.1], 12.0),
        ] {
            let region = Region {
                curvature: Vector3::from(curvature),
                thickness,
            };
            let place = TemplatePlace {
                distance: 0.4,
                azimuth: 0.7,
                fraction: 0.6,
            };
            let step = 1e-6;
            let moved = |axis: usize, by: f64| {
                let mut q = [place.distance, place.azimuth, place.fraction];
                q[axis] += by;
                let [distance, azimuth, fraction] = q;
                TemplatePlace {
                    distance,
                    azimuth,
                    fraction,
                }
            };
            let jacobian = |of: &dyn Fn(&TemplatePlace) -> Vec3| {
                let column =
                    |axis| (of(&moved(axis, step)) - of(&moved(axis, -step))) / (2.0 * step);
                Matrix3::from_columns(&[column(0), column(1), column(2)])
            };
            let by_template = jacobian(&|p| place_in_organ(&region, p));
            let mapped = region.map(&place);
            // Differences of 1e-6 with a root found to 1e-14: eight digits.
            let ball = jacobian(&|p| in_half_ball(p));
            let expected = ball * by_template.try_inverse().unwrap();
            assert!(
                (mapped.template_by_place - expected).norm() < 1e-6,
                "{region:?}"
            );
            assert!((mapped.volume / by_template.determinant().abs() - 1.0).abs() < 1e-6);
            let flat = jacobian(&|p| region.map(p).flat);
            let expected = flat * by_template.try_inverse().unwrap();
            assert!(
                (mapped.flat_by_place - expected).norm() < 1e-6,
                "{region:?}"
            );
        }
    }

    #[test]
    fn template_ends_at_the_held_base_of_a_slab() {
        let region = Region {
            curvature: Vector3::zeros(),
            thickness: 3.0,
        };
        for fraction in [0.0, 0.4, 0.8] {
            let place = TemplatePlace {
                distance: 1.0,
                azimuth: 0.3,
                fraction,
            };
            // Rounding and the root's 1e-14.
            assert!((place_in_organ(&region, &place).z + 3.0).abs() < 1e-9);
        }
    }
}
