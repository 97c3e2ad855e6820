//! The compliance that an inclusion takes from a half-space under a load on its surface.
//!
//! An inclusion of other moduli in a stress that is σ without it makes the compliance C of a load smaller by x C, with
//!
//! ```text
//! x C = ∫ (A_K σ_m²/K + A_G s:s/(2 G)) dV,   A_K = (K'/K − 1)/(1 + α (K'/K − 1)),   A_G alike with G and β
//! ```
//!
//! over the inclusion, σ_m and s being the mean and the deviator of the stress of a unit force, and α and β those of a ball
//! [Eshelby 1957]. That holds where it is small relative to its depth. Where it takes a large part of the energy, C is smaller by
//! x/(1 + (1 − β) x) of itself: the bound for balls of that share [Hashin and Shtrikman 1963], which makes a tip that is deep in a
//! large inclusion as stiff as the inclusion. Stresses are those of a flat punch [Sneddon 1946], and of loads (1 − (r/R)²)² as
//! sums of punches, in closed form.
//!
//! A mesh whose load is wider than a tip lacks the inclusion's effect on the tip: the difference of the two that
//! [`InclusionField::compliance_decrease`] gives.
//!
//! *How we know*: tests of this module; `regions::…` of `simulate`, compared with finite elements.
//!
//! *Limits*: the force along the normal; a flat surface; inclusions interact neither with one another nor with the surface; of
//! other shapes than a ball, α and β are those of a ball.

use std::f64::consts::PI;

use nalgebra::Complex;
use palpate_files::scene::InclusionShape;

use crate::regions::{RegionMap, places_in_shape};
use crate::{LinearElastic, Vec3};

/// Places of an inclusion at which stress is taken, about.
const PLACES: f64 = 200.0;

/// Punches of which a load is the sum.
const PUNCHES: usize = 8;

/// Least effect of an inclusion on a tip, taken as a point, that counts [-].
const LEAST: f64 = 3e-3;

/// Least stiffness over a soft inclusion, relative to that without it [-].
const MIN_STIFFNESS: f64 = 0.1;

/// The inclusions of a body.
#[derive(Debug, Clone, Default)]
pub struct InclusionField {
    inclusions: Vec<Inclusion>,
    poissons_ratio: f64,
    /// Young's modulus of what is around over that to which compliances are scaled [-].
    modulus: f64,
}

#[derive(Debug, Clone)]
struct Inclusion {
    places: Vec<Vec3>,
    /// Of each place [m³].
    volume: f64,
    /// A_K E/K and A_G E/(2 G), with the moduli of what is around [-].
    changes: [f64; 2],
    /// α and β [-].
    shares: [f64; 2],
}

/// A load on the surface: a sum of punches with these weights [-] and radii [m].
#[derive(Debug, Clone, Copy)]
pub struct Load([(f64, f64); PUNCHES]);

impl InclusionField {
    /// Of the shapes of a `map`, in tissue of the law `around` and with the bulk and shear `moduli` of its regions [Pa] from number 0
    /// on: zeros of what is empty. Compliances are scaled to the Young's modulus `unit` [Pa].
    pub fn new(map: &RegionMap, around: &LinearElastic, moduli: &[[f64; 2]], unit: f64) -> Self {
        let places = |number| map.places_in(number, PLACES);
        let inclusions = moduli.iter().enumerate();
        Self::of(
            inclusions.filter_map(|(number, moduli)| Some((places(number)?, *moduli))),
            around,
            unit,
        )
    }

    /// Of shapes in tissue of the law `around` that are so many times as stiff [-]; compliances are scaled to the Young's modulus `unit`
    /// [Pa].
    pub fn of_shapes<'a>(
        shapes: impl IntoIterator<Item = (&'a InclusionShape, f64)>,
        around: &LinearElastic,
        unit: f64,
    ) -> Self {
        let of_around = [around.bulk_modulus(), around.shear_modulus()];
        let inclusions = shapes.into_iter().filter_map(|(shape, ratio)| {
            let places = places_in_shape(shape, PLACES)?;
            Some((places, of_around.map(|modulus| ratio * modulus)))
        });
        Self::of(inclusions, around, unit)
    }

    /// Of inclusions by their places, the volume of each [m³], and their bulk and shear moduli [Pa].
    fn of(
        inclusions: impl Iterator<Item = ((Vec<Vec3>, f64), [f64; 2])>,
        around: &LinearElastic,
        unit: f64,
    ) -> Self {
        let nu = around.poissons_ratio();
        let shares = [
            (1.0 + nu) / (3.0 * (1.0 - nu)),
            2.0 * (4.0 - 5.0 * nu) / (15.0 * (1.0 - nu)),
        ];
        let modulus = around.youngs_modulus();
        let of_energy = [around.bulk_modulus(), 2.0 * around.shear_modulus()];
        let of_around = [around.bulk_modulus(), around.shear_modulus()];
        let inclusions = inclusions.map(|((places, volume), moduli)| {
            let changes = [0, 1].map(|k| {
                let more = moduli[k] / of_around[k] - 1.0;
                more / (1.0 + shares[k] * more) * modulus / of_energy[k]
            });
            Inclusion {
                places,
                volume,
                changes,
                shares,
            }
        });
        Self {
            inclusions: inclusions.filter(|own| own.changes != [0.0; 2]).collect(),
            poissons_ratio: nu,
            modulus: modulus / unit,
        }
    }

    /// With those of `other`, in the same tissue, as well.
    pub fn joined(mut self, other: &Self) -> Self {
        self.inclusions.extend_from_slice(&other.inclusions);
        self
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.inclusions.is_empty()
    }

    /// Decrease by the inclusions of the mean displacement of each load at `place` [m] along the outward `normal` [-], times Young's
    /// modulus over the force [1/m]: positive over stiff inclusions. Inclusions out of reach of a flat tip of the radius `tip` [m]
    /// do not count; of several, each takes its part of what the others leave.
    pub fn compliance_decrease<const LOADS: usize>(
        &self,
        loads: &[Load; LOADS],
        tip: f64,
        place: &Vec3,
        normal: &Vec3,
    ) -> [f64; LOADS] {
        let mut left = [1.0; LOADS];
        for inclusion in &self.inclusions {
            if self.is_out_of_reach(inclusion, tip, place) {
                continue;
            }
            for (left, load) in left.iter_mut().zip(loads) {
                *left *= 1.0 - self.part_of(inclusion, load, [place, normal]);
            }
        }
        std::array::from_fn(|n| {
            let own = loads[n].own_compliance(self.poissons_ratio);
            own * (1.0 - left[n]) / self.modulus
        })
    }

    /// Decrease of a sphere's displacement, times Young's modulus over the force [1/m], under the forces at which areas of these `radii`
    /// [m] would touch it without inclusions, where `less` is that of loads √(1 − (r/a)²) of the same radii, each so many times the one
    /// before.
    ///
    /// Of all areas a the one that touches has the least energy: with the compliance C(a) of that load,
    /// F = −4 a/(5 R C′(a)) and δ = a²/(5 R) + F C(a), which without inclusions is Hertz's contact.
    pub fn sphere_displacement_decrease<const RADII: usize>(
        &self,
        radii: [f64; RADII],
        less: [f64; RADII],
    ) -> [f64; RADII] {
        let flat = 1.0 - self.poissons_ratio * self.poissons_ratio;
        let step = (radii[1] / radii[0]).ln();
        let at: [(f64, f64); RADII] = std::array::from_fn(|n| {
            let (low, high) = (n.saturating_sub(1), (n + 1).min(RADII - 1));
            let slope = (less[high] - less[low]) / ((high - low) as f64 * step);
            let area = radii[n];
            // The force, over what it would be without inclusions; and the radius that it would have then.
            let ratio = 1.0 / (1.0 + 5.0 * area * slope / (3.0 * flat)).max(MIN_STIFFNESS);
            let alone = area * ratio.cbrt();
            let depth = area * area * (0.2 + ratio * (0.8 - 4.0 / (3.0 * flat) * area * less[n]));
            let found = 0.75 * flat * (alone * alone - depth) / alone.powi(3);
            (alone, found)
        });
        radii.map(|radius| {
            let above = at.iter().position(|(alone, _)| *alone >= radius);
            let above = above.unwrap_or(RADII - 1).max(1);
            let [(low, from), (high, to)] = [at[above - 1], at[above]];
            let part = (radius / low).ln() / (high / low).ln();
            from + part.clamp(0.0, 1.0) * (to - from)
        })
    }

    /// Whether the effect of an inclusion on a tip at `place`, taken as a point, is negligible.
    fn is_out_of_reach(&self, inclusion: &Inclusion, tip: f64, place: &Vec3) -> bool {
        let changes = inclusion.changes.iter().map(|change| change.abs());
        // A point force has a stress of 3/(2 π r²) at most, and a tip the compliance 1/(2 a).
        let squares = inclusion.places.iter().map(|inside| {
            let stress = 1.5 / (PI * (inside - place).norm_squared());
            stress * stress
        });
        2.0 * tip * changes.sum::<f64>() * inclusion.volume * squares.sum::<f64>() < LEAST
    }

    /// The part of its own compliance by which a load at a place and normal moves itself less [-].
    fn part_of(&self, inclusion: &Inclusion, load: &Load, [place, normal]: [&Vec3; 2]) -> f64 {
        let mut energies = [0.0; 2];
        for inside in &inclusion.places {
            let way = inside - place;
            let depth = -way.dot(normal);
            if depth <= 0.0 {
                continue;
            }
            let off = (way.norm_squared() - depth * depth).max(0.0).sqrt();
            let stress = load.stress(off, depth, self.poissons_ratio);
            for ((energy, stress), change) in energies.iter_mut().zip(stress).zip(inclusion.changes)
            {
                *energy += inclusion.volume * change * stress;
            }
        }
        let own = load.own_compliance(self.poissons_ratio);
        let x = energies.map(|energy| energy / own);
        let sizes = x.map(f64::abs);
        let all = sizes[0] + sizes[1];
        if all == 0.0 {
            return 0.0;
        }
        let share = (sizes[0] * inclusion.shares[0] + sizes[1] * inclusion.shares[1]) / all;
        let x = x[0] + x[1];
        x / (1.0 + (1.0 - share) * x).max(MIN_STIFFNESS)
    }
}

impl Load {
    /// That of a flat punch of this radius [m].
    pub fn punch(radius: f64) -> Self {
        let mut punches = [(0.0, radius); PUNCHES];
        punches[0].0 = 1.0;
        Self(punches)
    }

    /// √(1 − (r/a)²), that of a sphere [Hertz 1881], of this radius [m]: punches of the radii t a with the weights 3 t² dt.
    pub fn hertz(radius: f64) -> Self {
        Self::punches_of(radius, |sine, cosine| 3.0 * sine.powi(2) * cosine)
    }

    /// (1 − (r/R)²)² of this radius [m]: punches of the radii t R with the weights 32/π t² (1 − t²)^(3/2) dt.
    pub fn bump(radius: f64) -> Self {
        Self::punches_of(radius, |sine, cosine| {
            32.0 / PI * sine.powi(2) * cosine.powi(4)
        })
    }

    /// Punches of the radii sin(θ) R with weights [1/rad].
    fn punches_of(radius: f64, weight: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|n| {
            let step = 0.5 * PI / PUNCHES as f64;
            let (sine, cosine) = (step * (n as f64 + 0.5)).sin_cos();
            (weight(sine, cosine) * step, sine * radius)
        }))
    }

    fn punches(&self) -> impl Iterator<Item = &(f64, f64)> + Clone {
        self.0.iter().filter(|(weight, _)| *weight > 0.0)
    }

    /// Compliance of a half-space for this load, times Young's modulus [1/m].
    fn own_compliance(&self, poissons_ratio: f64) -> f64 {
        let pairs = self.punches().flat_map(|one| {
            let other = self.punches();
            other.map(move |other| one.0 * other.0 / (2.0 * one.1.max(other.1)))
        });
        (1.0 - poissons_ratio * poissons_ratio) * pairs.sum::<f64>()
    }

    /// σ_m² and s:s [1/m⁴] of a unit force, at the distance `off` [m] from its axis and the depth `z` [m].
    fn stress(&self, off: f64, z: f64, poissons_ratio: f64) -> [f64; 2] {
        let r = off.max(1e-6 * z);
        // σ_zz, σ_rz, σ_rr, σ_θθ: imaginary parts, for a punch is a point force at an imaginary depth.
        let mut sums = [0.0; 4];
        for (weight, radius) in self.punches() {
            let depth = Complex::new(z, -radius);
            let distance = root(depth * depth + r * r);
            let cubed = distance * distance * distance;
            let bent = (distance - depth) / r;
            let around = (bent * (1.0 - 2.0 * poissons_ratio) - bent * z / distance) / r;
            let inverse = distance.inv();
            let each = [
                inverse + depth * z / cubed,
                Complex::from(z * r) / cubed,
                inverse - depth * z / cubed - around,
                inverse * (2.0 * poissons_ratio) + around,
            ];
            let unit = -weight / (2.0 * PI * radius);
            for (sum, one) in sums.iter_mut().zip(each) {
                *sum += unit * one.im;
            }
        }
        let [axial, shear, radial, hoop] = sums;
        let mean = (axial + radial + hoop) / 3.0;
        let deviator = [axial, radial, hoop].map(|stress| (stress - mean).powi(2));
        [
            mean * mean,
            deviator.iter().sum::<f64>() + 2.0 * shear * shear,
        ]
    }
}

/// The square root with a positive real part, of what has an imaginary part that is not positive. Without angles it takes a fifth of the
/// time.
fn root(of: Complex<f64>) -> Complex<f64> {
    let size = (of.re * of.re + of.im * of.im).sqrt();
    // Of the two parts the one that loses no digits, and the other from their product.
    if of.re > 0.0 {
        let real = (0.5 * (size + of.re)).sqrt();
        Complex::new(real, 0.5 * of.im / real)
    } else {
        let imaginary = -(0.5 * (size - of.re)).sqrt();
        Complex::new(0.5 * of.im / imaginary, imaginary)
    }
}

#[cfg(test)]
mod tests {
    use palpate_files::scene::InclusionShape;
    use palpate_geometry::{AabbTree, Organ, Surface};

    use super::*;
    use crate::layered::bump;
    use crate::regions::RegionPlace;

    /// Judges: Boussinesq's point force far away; σ_zz of a punch on its axis, F/(2 π a²) (1 + 3 ζ²)/(1 + ζ²)² with ζ = z/a
    /// [Johnson 1985]; equilibrium, σ_zz over a plane being the force.
    #[test]
    fn stresses_are_those_of_closed_forms() {
        let (a, nu) = (0.004, 0.3);
        let load = Load::punch(a);
        let [mean, deviator] = load.stress(0.3, 0.4, nu);
        let far = 0.5_f64;
        let expected = -(1.0 + nu) * 0.4 / (3.0 * PI * far.powi(3));
        assert!((mean / expected.powi(2) - 1.0).abs() < 1e-3, "{mean}");
        let incompressible = load.stress(0.3, 0.4, 0.5)[1];
        let radial = 1.5 * 0.8 / (PI * far * far);
        assert!((incompressible / (2.0 / 3.0 * radial * radial) - 1.0).abs() < 1e-3);
        assert!(deviator > 0.0);
        // In incompressible tissue the stress on the axis is uniaxial but for a mean: s:s = 2/3 (σ_zz − σ_rr)².
        let zeta: f64 = 1.5;
        let [mean, deviator] = load.stress(0.0, zeta * a, 0.5);
        let axial = -(1.0 + 3.0 * zeta.powi(2)) / (1.0 + zeta.powi(2)).powi(2) / (2.0 * PI * a * a);
        let found = -mean.sqrt() - (2.0 / 3.0 * deviator).sqrt();
        assert!((found / axial - 1.0).abs() < 1e-3, "{found} {axial}");
    }

    /// Judge: its square, to rounding; and the sign.
    #[test]
    fn a_root_is_that_of_its_square() {
        for re in [-3.0, -1e-9, 0.0, 1e-9, 2.0, 1e3] {
            for im in [-2.0, -1e-9, -1e-3, -1e3] {
                let (of, own) = (Complex::new(re, im), root(Complex::new(re, im)));
                assert!((own * own - of).norm() < 1e-15 * of.norm(), "{of}: {own}");
                assert!(own.re >= 0.0 && own.im <= 0.0, "{of}: {own}");
            }
        }
    }

    /// Judge: the Hankel transform of the load and its integral.
    #[test]
    fn a_load_is_the_sum_of_its_punches() {
        let load = Load::bump(1.0);
        for x in [0.0, 1.0, 3.0, 6.0] {
            let sum: f64 = load
                .punches()
                .map(|(weight, t)| {
                    weight
                        * if x == 0.0 {
                            1.0
                        } else {
                            (x * t).sin() / (x * t)
                        }
                })
                .sum();
            assert!((sum - bump(x)).abs() < 1e-5, "{x}: {sum} {}", bump(x));
        }
        // 48² ∫ J₃²(x) x⁻⁶ dx/π; tolerance: the cusp at equal radii, the square of a step.
        let own = load.own_compliance(0.0);
        assert!((own * PI / 2.408_17 - 1.0).abs() < 0.01, "{}", own * PI);
    }

    fn ball(radius: f64, depth: f64, times: f64) -> InclusionField {
        let shape = InclusionShape::Ball {
            center_m: [0.0, 0.0, 0.05 - depth],
            radius_m: radius,
        };
        inclusion(shape, times)
    }

    /// A shape in the built-in cube, so many times as stiff.
    fn inclusion(shape: InclusionShape, times: f64) -> InclusionField {
        let surface = Surface::new(Organ::Cube.surface_mesh(768).unwrap()).unwrap();
        let tree = AabbTree::new(surface.mesh());
        let map = RegionMap::new(&surface, &tree, [RegionPlace::Shape(shape)]).unwrap();
        let around = LinearElastic::new(1.0, 0.499).unwrap();
        let moduli = [around.bulk_modulus(), around.shear_modulus()];
        let inside = moduli.map(|modulus| times * modulus);
        InclusionField::new(&map, &around, &[moduli, inside], 1.0)
    }

    /// Judges: a ball so deep that the stress in it is that of a point force, whose energy is known [Eshelby 1957]: the mean of cos²θ/r⁴
    /// over a ball is that of its centre and 0.8 (ρ/d)² more; none far away; one that is softer yields more; a load with the second
    /// moment of the tip's, R = 1.63 a, stands for it. Tolerance 5 %: a tip is no point, by (a/d)² in the stress.
    #[test]
    fn a_deep_ball_is_felt_by_its_energy() {
        let (radius, depth, a) = (0.009, 0.04, 0.004);
        let place = 0.05 * Vec3::z();
        let difference = |times, load| {
            let field = ball(radius, depth, times);
            let loads = [Load::bump(load), Load::punch(a)];
            let [load, tip] = field.compliance_decrease(&loads, a, &place, &Vec3::z());
            load - tip
        };
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        let stress: f64 = 1.5 / (PI * depth * depth);
        let mean = stress * stress * (1.0 + 0.8 * (radius / depth).powi(2));
        let expected = -2.0 / (1.0 + 0.4 * 2.0) * volume * mean;
        // A load as wide as a metre moves nothing.
        let found = difference(3.0, 1.0);
        assert!((found / expected - 1.0).abs() < 0.05, "{found} {expected}");
        assert!(difference(0.1, 1.0) > 0.0 && difference(1.0, 1.0) == 0.0);
        assert!(difference(3.0, 1.63 * a).abs() < 0.01 * found.abs());
        let far = place + 0.045 * Vec3::x();
        let aside = ball(0.002, 0.01, 3.0).compliance_decrease(
            &[Load::punch(1e-4)],
            1e-4,
            &far,
            &Vec3::z(),
        );
        assert_eq!(aside, [0.0]);
    }

    /// Closed forms: Hertz, also in tissue that is stiffer everywhere; and a way that grows with the force alone, as over what is far
    /// away, is added. Tolerance of 1/a at radii h = ln √2 apart: its slope is that of a secant, h²/6, and between two it is on a
    /// line, h²/8.
    #[test]
    fn a_sphere_meets_hertz() {
        let field = ball(0.002, 0.03, 3.0);
        let radii: [f64; 9] = std::array::from_fn(|n| 1e-3 * 2.0_f64.powf(0.5 * n as f64));
        assert_eq!(
            field
                .sphere_displacement_decrease(radii, [0.0; 9])
                .map(f64::abs),
            [0.0; 9]
        );
        for found in field.sphere_displacement_decrease(radii, [7.0; 9]) {
            assert!((found / 7.0 - 1.0).abs() < 1e-9, "{found}");
        }
        let (part, flat) = (0.3_f64, 1.0 - 0.499 * 0.499);
        let less = radii.map(|radius| part * 0.6 * flat / radius);
        let found = field.sphere_displacement_decrease(radii, less);
        for (radius, found) in radii.iter().zip(found).skip(1).take(7) {
            let depth = 1.0 - (1.0 - part).powf(2.0 / 3.0);
            let expected = 0.75 * flat / radius * depth;
            assert!(
                (found / expected - 1.0).abs() < 0.035,
                "{radius}: {found} {expected}"
            );
        }
    }

    /// Judge: the same tip over the middle, which has as much of the inclusion on each side as the end has on one.
    #[test]
    fn the_end_of_a_long_inclusion_is_felt() {
        let vessel = InclusionShape::Capsule {
            from_m: [-0.04, 0.0, 0.04],
            to_m: [0.04, 0.0, 0.04],
            radius_m: 0.004,
        };
        let field = inclusion(vessel, 10.0);
        let at = |x: f64| {
            let place = Vec3::new(x, 0.0, 0.05);
            -field.compliance_decrease(&[Load::punch(0.002)], 0.002, &place, &Vec3::z())[0]
        };
        let (middle, end) = (at(0.0), at(0.04));
        assert!(
            middle < 0.0 && end < 0.5 * middle && end > middle,
            "{middle} {end}"
        );
    }
}
