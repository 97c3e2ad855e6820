//! A stretched bar: one point, closed forms, and finite elements.

use palpate_mechanics::finite_elements::uniaxial::nominal_stress;
use palpate_mechanics::{Error, Exponential, LinearElastic, MooneyRivlin, NeoHookean};

use crate::contacts::MODULUS;
use crate::every_law::every_law;

/// Incompressible laws, from half to thrice the length.
#[test]
fn incompressible_laws_have_their_closed_forms() {
    let (c10, c01, gamma, alpha) = (1200.0, 500.0, 3000.0, 0.7);
    let neo = NeoHookean::incompressible(c10).unwrap();
    let mooney = MooneyRivlin::incompressible(c10, c01).unwrap();
    let exponential = Exponential::incompressible(gamma, alpha).unwrap();
    for step in 0..=50 {
        let l = 0.5 + 0.05 * f64::from(step);
        let close = |found: Result<f64, Error>, exact: f64| {
            let found = found.unwrap();
            assert!(
                (found - exact).abs() < 1e-11 * (MODULUS + exact.abs()),
                "{l}: {found}"
            );
        };
        close(nominal_stress(&neo, l), 2.0 * c10 * (l - l.powi(-2)));
        close(
            nominal_stress(&mooney, l),
            2.0 * (1.0 - l.powi(-3)) * (c10 * l + c01),
        );
        // (6.2)
        let exact = gamma / (alpha + 1.0)
            * (l * (alpha * (l * l - 1.0)).exp() - l.powi(-2) * (alpha * (1.0 / l - 1.0)).exp());
        close(nominal_stress(&exponential, l), exact);
    }
}

/// For a volume that can change: sides without stress, and κ → ∞ is the incompressible law, its error
/// falling as 1/κ.
#[test]
fn compressible_laws_tend_to_incompressible_ones() {
    for stretch in [0.5, 0.9, 1.0, 1.3, 3.0] {
        let limit = nominal_stress(&NeoHookean::incompressible(1e3).unwrap(), stretch).unwrap();
        let errors = [1e5, 1e6, 1e7, 1e8].map(|bulk| {
            let law = NeoHookean::compressible(1e3, bulk).unwrap();
            (nominal_stress(&law, stretch).unwrap() - limit).abs()
        });
        for pair in errors.windows(2) {
            assert!(
                pair[1] < 0.13 * pair[0] + 1e-7 * MODULUS,
                "{stretch}: {errors:?}"
            );
        }
    }
}

/// E is the slope at rest, of every isotropic law; the error of the difference falls with the step.
#[test]
fn the_slope_at_rest_is_youngs_modulus() {
    for law in every_law().iter().filter(|law| law.fibres.is_none()) {
        let off = |strain: f64| {
            let stress = nominal_stress(law.law.as_ref(), 1.0 + strain).unwrap();
            (stress / strain / law.youngs_modulus - 1.0).abs()
        };
        // Second derivatives are of the size of α times the first.
        assert!(off(1e-4) < 1e-2, "{}: {}", law.name, off(1e-4));
        assert!(off(1e-6) < 1e-4, "{}: {}", law.name, off(1e-6));
        let at_rest = nominal_stress(law.law.as_ref(), 1.0).unwrap();
        assert!(at_rest.abs() < 1e-9 * law.youngs_modulus, "{}", law.name);
    }
}

#[test]
fn the_linear_law_is_linear() {
    for nu in [-0.3, 0.0, 0.3, 0.499_99] {
        let law = LinearElastic::new(MODULUS, nu).unwrap();
        for stretch in [0.2, 0.9, 1.1, 3.0] {
            let found = nominal_stress(&law, stretch).unwrap();
            let exact = MODULUS * (stretch - 1.0);
            // Rounding over 1 − 2 ν.
            assert!(
                (found / exact - 1.0).abs() < 1e-9,
                "{nu} {stretch}: {found}"
            );
        }
    }
}

#[test]
fn every_law_answers_from_a_tenth_to_tenfold_or_says_why_not() {
    for law in every_law() {
        for stretch in [0.1, 0.3, 0.9, 1.1, 3.0, 10.0] {
            match nominal_stress(law.law.as_ref(), stretch) {
                Ok(stress) => assert!(stress.is_finite()),
                Err(Error::StretchOutOfRange { .. }) if !(0.25..4.0).contains(&stretch) => {}
                Err(other) => panic!("{}: {other}", law.name),
            }
        }
        for stretch in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(nominal_stress(law.law.as_ref(), stretch).is_err());
        }
    }
}
