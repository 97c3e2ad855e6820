//! Incompressible laws under the stretches and the shear that have closed forms.
//!
//! Judge: the textbook's nominal stress; for the exponential law the source's (6.2), with λ deformed
//! over undeformed.

use nalgebra::{Matrix3, Vector3};
use palpate_mechanics::{Exponential, Law, MooneyRivlin, NeoHookean, Ogden, ReducedPolynomial};

use crate::contacts::{MODULUS, Random};
use crate::every_law::{OGDEN, rotation};

/// Stretches from half to thrice the length.
fn stretches() -> impl Iterator<Item = f64> {
    (0..=50).map(|step| 0.5 + 0.05 * f64::from(step))
}

/// A stress of a law.
struct Found {
    /// [Pa].
    stress: f64,
    /// What rounding may do to it [Pa].
    rounding: f64,
}

/// First diagonal stress of an incompressible body with free third faces: P = ∂W/∂F + p cof F, the
/// pressure from P_33 = 0. The body is turned before and after.
fn nominal(law: &dyn Law, principal: [f64; 3], random: &mut Random) -> Found {
    let [before, after] = [rotation(random), rotation(random)];
    let f = after * Matrix3::from_diagonal(&principal.into()) * before;
    let turned_back = |m: Matrix3<f64>| after.transpose() * m * before.transpose();
    let distortion = turned_back(law.distortion_stress(&f));
    let cofactors = turned_back(law.volume().dilation_gradient(&f));
    let pressure = -distortion[(2, 2)] / cofactors[(2, 2)];
    let stress = distortion + pressure * cofactors;
    // The tangent times the last digits of F, hundredfold: the pressure amplifies by up to λ³ = 27.
    let rounding = 100.0 * f64::EPSILON * law.distortion_tangent(&f).norm() * f.norm();
    Found {
        stress: stress[(0, 0)],
        rounding,
    }
}

fn uniaxial(stretch: f64) -> [f64; 3] {
    [stretch, stretch.sqrt().recip(), stretch.sqrt().recip()]
}

fn equibiaxial(stretch: f64) -> [f64; 3] {
    [stretch, stretch, stretch.powi(-2)]
}

/// Planar tension: the second direction is held.
fn planar(stretch: f64) -> [f64; 3] {
    [stretch, 1.0, stretch.recip()]
}

/// Cauchy stress τ = (P F^T)_12 of the shear k; no pressure reaches it.
fn shear(law: &dyn Law, amount: f64, random: &mut Random) -> Found {
    let turn = rotation(random);
    let f = Matrix3::identity() + amount * Vector3::x() * Vector3::y().transpose();
    let stress = law.distortion_stress(&(turn * f * turn.transpose()));
    let cauchy = turn.transpose() * stress * turn * f.transpose();
    let rounding = 100.0 * f64::EPSILON * law.distortion_tangent(&f).norm() * f.norm();
    Found {
        stress: cauchy[(0, 1)],
        rounding,
    }
}

fn compare(what: &str, at: f64, found: Found, exact: f64) {
    let Found {
        stress: found,
        rounding,
    } = found;
    let off = (found - exact).abs();
    assert!(
        off <= rounding,
        "{what} at {at}: {found}, not {exact}; {off} over {rounding}"
    );
}

#[test]
fn neo_hookean() {
    let mut random = Random(1);
    let c10 = MODULUS / 6.0;
    let law = NeoHookean::incompressible(c10).unwrap();
    for l in stretches() {
        let found = nominal(&law, uniaxial(l), &mut random);
        compare("tension", l, found, 2.0 * c10 * (l - l.powi(-2)));
        let found = nominal(&law, equibiaxial(l), &mut random);
        compare("two ways", l, found, 2.0 * c10 * (l - l.powi(-5)));
        let found = shear(&law, l, &mut random);
        compare("shear", l, found, 2.0 * c10 * l);
    }
}

#[test]
fn mooney_rivlin() {
    let mut random = Random(2);
    for (c10, c01) in [
        (1700.0, 0.0),
        (1200.0, 500.0),
        (0.0, 1700.0),
        (2500.0, -800.0),
    ] {
        let law = MooneyRivlin::incompressible(c10, c01).unwrap();
        for l in stretches() {
            let found = nominal(&law, uniaxial(l), &mut random);
            let exact = 2.0 * (1.0 - l.powi(-3)) * (c10 * l + c01);
            compare("tension", l, found, exact);
            let found = nominal(&law, equibiaxial(l), &mut random);
            let exact = 2.0 * (l - l.powi(-5)) * (c10 + c01 * l.powi(2));
            compare("two ways", l, found, exact);
            let found = shear(&law, l, &mut random);
            compare("shear", l, found, 2.0 * (c10 + c01) * l);
        }
    }
}

#[test]
fn exponential() {
    let mut random = Random(3);
    let gamma = MODULUS / 3.0;
    for alpha in [-0.5, 1e-9, 0.5, 5.0, 20.0] {
        let law = Exponential::incompressible(gamma, alpha).unwrap();
        // γ/(α + 1) λ exp(α (λ² − 1)).
        let term = |l: f64| gamma / (alpha + 1.0) * l * (alpha * (l * l - 1.0)).exp();
        for l in stretches() {
            let found = nominal(&law, uniaxial(l), &mut random);
            // (6.2)
            let exact = gamma / (alpha + 1.0)
                * (l * (alpha * (l.powi(2) - 1.0)).exp()
                    - l.powi(-2) * (alpha * (1.0 / l - 1.0)).exp());
            compare("tension", l, found, exact);
            // Half of dW/dλ along (λ, λ, λ⁻²).
            let found = nominal(&law, equibiaxial(l), &mut random);
            let exact = term(l) - l.powi(-3) * term(l.powi(-2));
            compare("two ways", l, found, exact);
            // dW/dk along (λ, 1/λ, 1), where k = λ − 1/λ.
            let amount = l - 1.0 / l;
            let found = shear(&law, amount, &mut random);
            let exact = (term(l) - l.powi(-2) * term(1.0 / l)) / (1.0 + l.powi(-2));
            compare("shear", amount, found, exact);
        }
    }
}

/// Ogden (1972): the nominal stress is Σ 2 μ/α (λ^(α − 1) − λ^(−c α − 1)) with c = ½, 2 and 1 in tension, two ways and
/// planar tension; the shear stress of k = λ − 1/λ is dW/dk = Σ 2 μ/α (λ^α − λ^−α)/(λ + 1/λ).
#[test]
fn ogden() {
    let mut random = Random(4);
    let shear_modulus = MODULUS / 3.0;
    // At α = 0 the closed form is a limit.
    for terms in OGDEN
        .into_iter()
        .filter(|[first, ..]| first[1].abs() > 1e-3)
    {
        let terms: Vec<[f64; 2]> = terms
            .into_iter()
            .filter(|[share, _]| *share != 0.0)
            .map(|[share, alpha]| [share * shear_modulus, alpha])
            .collect();
        let law = Ogden::incompressible(&terms).unwrap();
        let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
            terms.iter().map(|&[mu, a]| 2.0 * mu / a * of(a)).sum()
        };
        for l in stretches() {
            let ways: [(&str, [f64; 3], f64); 3] = [
                ("tension", uniaxial(l), 0.5),
                ("two ways", equibiaxial(l), 2.0),
                ("planar", planar(l), 1.0),
            ];
            for (name, principal, c) in ways {
                let exact = sum(&|a| l.powf(a - 1.0) - l.powf(-c * a - 1.0));
                compare(name, l, nominal(&law, principal, &mut random), exact);
            }
            let amount = l - 1.0 / l;
            let exact = sum(&|a| (l.powf(a) - l.powf(-a)) / (l + 1.0 / l));
            compare("shear", amount, shear(&law, amount, &mut random), exact);
        }
    }
}

/// Yeoh (1993): twice W′(I₁ − 3) times the neo-Hookean geometry of each test.
#[test]
fn reduced_polynomial() {
    let mut random = Random(5);
    for c in [
        [1700.0, 0.0, 0.0],
        [1200.0, -80.0, 9.0],
        [300.0, 200.0, 50.0],
    ] {
        let law = ReducedPolynomial::incompressible(&c).unwrap();
        let slope = |i: f64| c[0] + 2.0 * c[1] * (i - 3.0) + 3.0 * c[2] * (i - 3.0).powi(2);
        for l in stretches() {
            let exact = 2.0 * (l - l.powi(-2)) * slope(l * l + 2.0 / l);
            compare("tension", l, nominal(&law, uniaxial(l), &mut random), exact);
            let exact = 2.0 * (l - l.powi(-5)) * slope(2.0 * l * l + l.powi(-4));
            compare(
                "two ways",
                l,
                nominal(&law, equibiaxial(l), &mut random),
                exact,
            );
            let exact = 2.0 * (l - l.powi(-3)) * slope(l * l + 1.0 + l.powi(-2));
            compare("planar", l, nominal(&law, planar(l), &mut random), exact);
            compare(
                "shear",
                l,
                shear(&law, l, &mut random),
                2.0 * l * slope(3.0 + l * l),
            );
        }
    }
}
