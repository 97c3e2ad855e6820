//! Incompressible laws under the stretches and the shear that have closed forms.
//!
//! Judge: the textbook's nominal stress; for the exponential law the source's (6.2), with λ deformed
//! over undeformed.

use nalgebra::{Matrix3, Vector3};
use palpate_mechanics::{Exponential, Law, MooneyRivlin, NeoHookean, Ogden, ReducedPolynomial};

use crate::contacts::{MODULUS, Random};
use crate::every_law::rotation;

/// Stretches from half to thrice the length.
fn stretches() -> impl Iterator<Item = f64> {
    (0..=50).map(|step| 0.5 + 0.05 * f64::from(step))
}

/// First diagonal stress of an incompressible body with free third faces: P = ∂W/∂F + p cof F, the
/// pressure from P_33 = 0. The body is turned before and after. Beside it what rounding may do.
fn nominal(law: &dyn Law, principal: [f64; 3], random: &mut Random) -> (f64, f64) {
    let [before, after] = [rotation(random), rotation(random)];
    let f = after * Matrix3::from_diagonal(&principal.into()) * before;
    let turned_back = |m: Matrix3<f64>| after.transpose() * m * before.transpose();
    let distortion = turned_back(law.distortion_stress(&f));
    let cofactors = turned_back(law.volume().dilation_gradient(&f));
    let pressure = -distortion[(2, 2)] / cofactors[(2, 2)];
    let stress = distortion + pressure * cofactors;
    // The tangent times the last digits of F, hundredfold: the pressure amplifies by up to λ³ = 27.
    let rounding = 100.0 * f64::EPSILON * law.distortion_tangent(&f).norm() * f.norm();
    (stress[(0, 0)], rounding)
}

fn uniaxial(stretch: f64) -> [f64; 3] {
    [stretch, stretch.sqrt().recip(), stretch.sqrt().recip()]
}

fn equibiaxial(stretch: f64) -> [f64; 3] {
    [stretch, stretch, stretch.powi(-2)]
}

/// Cauchy stress τ = (P F^T)_12 of the shear k; no pressure reaches it.
fn shear(law: &dyn Law, amount: f64, random: &mut Random) -> (f64, f64) {
    let turn = rotation(random);
    let f = Matrix3::identity() + amount * Vector3::x() * Vector3::y().transpose();
    let stress = law.distortion_stress(&(turn * f * turn.transpose()));
    let cauchy = turn.transpose() * stress * turn * f.transpose();
    let rounding = 100.0 * f64::EPSILON * law.distortion_tangent(&f).norm() * f.norm();
    (cauchy[(0, 1)], rounding)
}

fn compare(what: &str, at: f64, (found, rounding): (f64, f64), exact: f64) {
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

/// Judge: the textbook's stresses of a law of principal stretches and of one of the first invariant [Holzapfel 2000,
/// sections 6.5 and 6.6].
#[test]
fn ogden_and_the_reduced_polynomial() {
    let mut random = Random(4);
    let mu = MODULUS / 3.0;
    let sets: [&[[f64; 2]]; 4] = [
        &[[mu, 4.28]],
        &[[mu, -3.0]],
        &[[0.7 * mu, 1.3], [0.3 * mu, 5.0]],
        &[[0.6 * mu, 1.3], [0.5 * mu, 5.0], [-0.1 * mu, -2.0]],
    ];
    for terms in sets {
        let law = Ogden::incompressible(terms).unwrap();
        // λ dW/dλ.
        let term = |l: f64| -> f64 {
            let each = terms.iter();
            each.map(|[mu, alpha]| 2.0 * mu / alpha * l.powf(*alpha))
                .sum()
        };
        for l in stretches() {
            let found = nominal(&law, uniaxial(l), &mut random);
            compare("tension", l, found, (term(l) - term(l.sqrt().recip())) / l);
            let found = nominal(&law, equibiaxial(l), &mut random);
            compare("two ways", l, found, (term(l) - term(l.powi(-2))) / l);
            let found = nominal(&law, [l, 1.0, 1.0 / l], &mut random);
            compare("planar tension", l, found, (term(l) - term(1.0 / l)) / l);
            let amount = l - 1.0 / l;
            let found = shear(&law, amount, &mut random);
            let exact = (term(l) - term(1.0 / l)) / (l + 1.0 / l);
            compare("shear", amount, found, exact);
        }
    }
    for [c10, c20, c30] in [
        [1700.0, 0.0, 0.0],
        [1700.0, 900.0, 0.0],
        [1700.0, -200.0, 400.0],
    ] {
        let law = ReducedPolynomial::incompressible(&[c10, c20, c30]).unwrap();
        let slope = |x: f64| c10 + 2.0 * c20 * x + 3.0 * c30 * x * x;
        for l in stretches() {
            let found = nominal(&law, uniaxial(l), &mut random);
            let x = l * l + 2.0 / l - 3.0;
            compare("tension", l, found, 2.0 * (l - l.powi(-2)) * slope(x));
            let found = nominal(&law, equibiaxial(l), &mut random);
            let x = 2.0 * l * l + l.powi(-4) - 3.0;
            compare("two ways", l, found, 2.0 * (l - l.powi(-5)) * slope(x));
            let found = shear(&law, l, &mut random);
            compare("shear", l, found, 2.0 * slope(l * l) * l);
        }
    }
}

/// Judge: another law's code.
#[test]
fn ogden_holds_neo_hooke_and_mooney_rivlin() {
    let mut random = Random(5);
    let (c10, c01) = (1200.0, 500.0);
    let ogden = Ogden::incompressible(&[[2.0 * c10, 2.0], [2.0 * c01, -2.0]]).unwrap();
    let mooney = MooneyRivlin::incompressible(c10, c01).unwrap();
    for _ in 0..100 {
        let f = crate::every_law::deformation(&mut random);
        let off = ogden.distortion_tangent(&f) - mooney.distortion_tangent(&f);
        // The eigenvalues of C in double precision, with what the pressure that both leave out adds.
        assert!(
            off.norm() < 1e-11 * mooney.distortion_tangent(&f).norm(),
            "{off}"
        );
    }
}
