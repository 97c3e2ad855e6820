//! Pieces that are deformed homogeneously, their fibres askew.
//!
//! Judges: energies written from the invariants of C, made least by sections of their own; the bisection of
//! `uniaxial::stretched`; central differences.

use palpate_mechanics::finite_elements::homogeneous::{Homogeneous, deformed};
use palpate_mechanics::finite_elements::uniaxial::stretched;
use palpate_mechanics::{FibreFrame, HolzapfelGasserOgden, Ogden, Vec3};

use crate::every_law::with_fibres;

/// C10, k1, k2, dispersion, angle of the families.
const LAWS: [[f64; 5]; 4] = [
    [1000.0, 3000.0, 1.5, 0.0, 0.0],
    [1000.0, 5000.0, 2.0, 0.1, 30.0],
    [1000.0, 50_000.0, 5.0, 0.05, 0.0],
    [1000.0, 2000.0, 1.0, 0.3, 80.0],
];

fn law(p: &[f64; 5], axis_deg: f64) -> HolzapfelGasserOgden {
    let (sin, cos) = axis_deg.to_radians().sin_cos();
    let frame = FibreFrame::new(&Vec3::new(cos, sin, 0.0), &Vec3::new(-sin, cos, 0.0)).unwrap();
    with_fibres(p, None).turned_to(frame)
}

/// Of F = [λ, s, 0; 0, b, 0; 0, 0, 1/(λ b)], by I1 and the squared stretch of each family.
fn energy(p: &[f64; 5], axis_deg: f64, [along, shear, wide]: [f64; 3]) -> f64 {
    let [c10, k1, k2, kappa, angle] = *p;
    let c = [along * along, along * shear, shear * shear + wide * wide];
    let first = c[0] + c[2] + (along * wide).powi(-2);
    let families = [angle, -angle].map(|own| {
        let (sin, cos) = (axis_deg + own).to_radians().sin_cos();
        let fourth = c[0] * cos * cos + 2.0 * c[1] * cos * sin + c[2] * sin * sin;
        let strain = kappa * (first - 3.0) + (1.0 - 3.0 * kappa) * (fourth - 1.0);
        k1 / (2.0 * k2) * ((k2 * strain.max(0.0).powi(2)).exp() - 1.0)
    });
    c10 * (first - 3.0) + families[0] + families[1]
}

/// The place of the least value of a convex function, by the golden section.
fn least(f: &dyn Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let part = 0.5 * (5.0_f64.sqrt() - 1.0);
    while high - low > 1e-9 {
        let [a, b] = [high - part * (high - low), low + part * (high - low)];
        if f(a) < f(b) {
            high = b;
        } else {
            low = a;
        }
    }
    0.5 * (low + high)
}

/// Stress of a strip whose free strains make the energy least, and these strains.
fn strip(p: &[f64; 5], axis_deg: f64, along: f64) -> (f64, [f64; 2]) {
    let shear_of = |wide: f64| {
        least(
            &|shear| energy(p, axis_deg, [along, shear, wide]),
            [-1.0, 1.0],
        )
    };
    let of_wide = |wide: f64| energy(p, axis_deg, [along, shear_of(wide), wide]);
    let wide = least(&of_wide, [0.3, 1.6]);
    let shear = shear_of(wide);
    let at = |by: f64| energy(p, axis_deg, [along + by, shear, wide]);
    ((at(1e-5) - at(-1e-5)) / 2e-5, [shear, wide.ln()])
}

/// Judge: the least energy. A section finds its place to about 1e-8, and the stress is as much off and, of differences of
/// steps of 1e-5, 1e-9.
#[test]
fn a_strip_that_is_askew_has_the_least_energy() {
    for p in &LAWS {
        for axis_deg in [0.0, 25.0, 45.0, -60.0, 90.0] {
            let law = law(p, axis_deg);
            for along in [0.8, 0.95, 1.1, 1.2] {
                let found = deformed(&law, Homogeneous::Uniaxial, along, None).unwrap();
                let (stress, free) = strip(p, axis_deg, along);
                let allowed = 1e-6 * (p[0] + stress.abs());
                let off = (found.nominal_stress - stress).abs();
                assert!(off < allowed, "{p:?} {axis_deg} {along}: {stress} {off}");
                for (found, exact) in found.free.iter().zip(free) {
                    assert!((found - exact).abs() < 1e-6, "{p:?} {axis_deg} {along}");
                }
                // From where another stretch ended it comes to the same.
                let near = deformed(&law, Homogeneous::Uniaxial, 0.99 * along, None).unwrap();
                let again = deformed(&law, Homogeneous::Uniaxial, along, Some(near.free)).unwrap();
                let apart = (again.nominal_stress - found.nominal_stress).abs();
                assert!(apart < 1e-9 * (p[0] + stress.abs()), "{apart}");
                // One family of fibres that is pulled askew turns, and the strip with it.
                let turns = p[4] == 0.0 && axis_deg == 45.0 && along > 1.0;
                assert!(!turns || free[0].abs() > 1e-2, "{p:?} {along}: {free:?}");
            }
        }
    }
}

/// Judges: the bisection where nothing shears; for an isotropic law the sides are alike.
#[test]
fn straight_strips_are_those_of_the_bisection() {
    for p in &LAWS {
        for axis_deg in [0.0, 90.0] {
            for along in [0.7, 0.95, 1.0, 1.05, 1.3] {
                let law = law(p, axis_deg);
                let exact = stretched(&law, along).unwrap();
                let found = deformed(&law, Homogeneous::Uniaxial, along, None).unwrap();
                let allowed = 1e-10 * (p[0] + p[1] + exact.nominal_stress.abs());
                let off = (found.nominal_stress - exact.nominal_stress).abs();
                assert!(off < allowed, "{p:?} {along}: {off}");
                assert!((found.free[1] - exact.lateral[0].ln()).abs() < 1e-10);
            }
        }
    }
    let ogden = Ogden::incompressible(&[[900.0, 5.7]]).unwrap();
    let found = deformed(&ogden, Homogeneous::Uniaxial, 1.4, None).unwrap();
    let exact = stretched(&ogden, 1.4).unwrap().nominal_stress;
    assert!((found.nominal_stress / exact - 1.0).abs() < 1e-12);
}

/// Energy [Pa] by how far a piece is from rest.
type Energy<'a> = &'a dyn Fn(f64) -> f64;

/// Judge: derivatives of the energy of the invariants along the path, which leaves nothing free.
#[test]
fn sheets_and_sheared_pieces_follow_their_energies() {
    for p in &LAWS {
        for axis_deg in [0.0, 30.0, -30.0, 90.0] {
            let law = law(p, axis_deg);
            for amount in [-0.2, 0.0, 0.1, 0.3] {
                let shear = |g: f64| energy(p, axis_deg, [1.0, g, 1.0]);
                let pull = |g: f64| energy(p, axis_deg, [1.0 + g, 0.0, 1.0]);
                let cases: [(Homogeneous, f64, Energy<'_>); 2] = [
                    (Homogeneous::SimpleShear, amount, &shear),
                    (Homogeneous::PlanarTension, 1.0 + amount, &pull),
                ];
                for (how, at, energy) in cases {
                    // At rest fibres begin to resist, which differences do not see.
                    let exact = match amount {
                        0.0 => 0.0,
                        _ => (energy(amount + 1e-5) - energy(amount - 1e-5)) / 2e-5,
                    };
                    let found = deformed(&law, how, at, None).unwrap().nominal_stress;
                    let allowed = 1e-7 * (p[0] + exact.abs());
                    assert!((found - exact).abs() < allowed, "{p:?} {how:?} {amount}");
                }
            }
        }
    }
}

/// Judge: central differences, right to the square of a step of 1e-5.
#[test]
fn stresses_change_with_parameters_as_differences_say() {
    let p = LAWS[1];
    for (how, amount) in [
        (Homogeneous::Uniaxial, 1.15),
        (Homogeneous::Uniaxial, 0.9),
        (Homogeneous::PlanarTension, 1.15),
        (Homogeneous::SimpleShear, 0.3),
    ] {
        for axis_deg in [0.0, 35.0, 90.0] {
            let found = deformed(&law(&p, axis_deg), how, amount, None).unwrap();
            for place in 0..p.len() {
                let at = |sign: f64| {
                    let mut moved = p;
                    moved[place] *= 1.0 + sign * 1e-5;
                    let law = law(&moved, axis_deg);
                    deformed(&law, how, amount, None).unwrap().nominal_stress
                };
                let exact = (at(1.0) - at(-1.0)) / (2e-5 * p[place]);
                let off = (found.by_parameter[place] - exact).abs();
                let scale = found.nominal_stress.abs() / p[place];
                assert!(off < 1e-6 * (scale + exact.abs()), "{how:?} {place}: {off}");
            }
        }
    }
}

#[test]
fn no_stretch_is_refused() {
    let law = law(&LAWS[0], 10.0);
    for stretch in [0.0, -1.0, f64::NAN, 1e200] {
        for how in [Homogeneous::Uniaxial, Homogeneous::PlanarTension] {
            assert!(deformed(&law, how, stretch, None).is_err(), "{stretch}");
        }
    }
    assert!(deformed(&law, Homogeneous::SimpleShear, f64::INFINITY, None).is_err());
    assert!(deformed(&law, Homogeneous::SimpleShear, -0.2, None).is_ok());
}
