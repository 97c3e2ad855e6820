//! One battery for every law: a new one joins by a line in the list.
//!
//! Judge: central differences, by the order at which their error falls.

use nalgebra::Matrix3;
use palpate_mechanics::{Law, LinearElastic, Tangent};

use crate::contacts::{MODULUS, Random, tries};

/// Every implementor of [`Law`].
fn every_law() -> Vec<(String, Box<dyn Law>)> {
    let linear = [-0.3, 0.0, 0.3, 0.45, 0.499].map(|nu| {
        let law = LinearElastic::new(MODULUS, nu).unwrap();
        (
            format!("linear elastic, nu {nu}"),
            Box::new(law) as Box<dyn Law>,
        )
    });
    linear.into_iter().collect()
}

/// A deformation of up to a fifth that does not turn inside out.
fn deformation(random: &mut Random) -> Matrix3<f64> {
    Matrix3::identity() + 0.2 * Matrix3::from_fn(|_, _| random.sign())
}

fn moved(f: &Matrix3<f64>, entry: usize, step: f64) -> Matrix3<f64> {
    let mut moved = *f;
    moved[entry] += step;
    moved
}

/// The error must fall as the square of the step, or be rounding already (where the function is a
/// polynomial that central differences meet exactly).
fn falls_with_the_square(name: &str, scale: f64, error: impl Fn(f64) -> f64) {
    let errors = [2e-3, 1e-3, 5e-4].map(error);
    // Values of this scale, with sixteen digits, over the smallest step; ten for the sums.
    let rounding = 10.0 * f64::EPSILON * scale / 5e-4;
    if errors.iter().all(|&e| e < rounding) {
        return;
    }
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(
            (order - 2.0).abs() < 0.1,
            "{name}: order {order}: {errors:?}"
        );
    }
}

#[test]
fn rest_has_neither_energy_nor_stress() {
    for (name, law) in every_law() {
        let rest = Matrix3::identity();
        assert_eq!(law.energy(&rest), 0.0, "{name}");
        assert_eq!(law.stress(&rest), Matrix3::zeros(), "{name}");
    }
}

#[test]
fn stress_is_the_derivative_of_energy() {
    let mut random = Random(1);
    for (name, law) in every_law() {
        for _ in 0..tries(200) {
            let f = deformation(&mut random);
            let exact = law.stress(&f);
            falls_with_the_square(&name, law.energy(&f).abs() + exact.norm(), |step| {
                let difference = Matrix3::from_fn(|i, j| {
                    let entry = i + 3 * j;
                    let [up, down] = [step, -step].map(|s| law.energy(&moved(&f, entry, s)));
                    (up - down) / (2.0 * step)
                });
                (difference - exact).norm()
            });
        }
    }
}

#[test]
fn tangent_is_the_derivative_of_stress() {
    let mut random = Random(2);
    for (name, law) in every_law() {
        for _ in 0..tries(200) {
            let f = deformation(&mut random);
            let exact = law.tangent(&f);
            falls_with_the_square(&name, law.stress(&f).norm() + exact.norm(), |step| {
                let mut difference = Tangent::zeros();
                for entry in 0..9 {
                    let [up, down] = [step, -step].map(|s| law.stress(&moved(&f, entry, s)));
                    let slope = (up - down) / (2.0 * step);
                    difference
                        .column_mut(entry)
                        .copy_from_slice(slope.as_slice());
                }
                (difference - exact).norm()
            });
        }
    }
}

/// A tangent is a second derivative, so ∂P_ij/∂F_kl = ∂P_kl/∂F_ij.
#[test]
fn tangent_is_symmetric() {
    let mut random = Random(3);
    for (name, law) in every_law() {
        for _ in 0..tries(200) {
            let tangent = law.tangent(&deformation(&mut random));
            // Rounding.
            let off = (tangent - tangent.transpose()).norm();
            assert!(off < 1e-14 * tangent.norm(), "{name}: {off}");
        }
    }
}

/// Every law is a linear one for small strain, with a positive modulus.
#[test]
fn every_law_has_a_linearization_at_rest() {
    for (name, law) in every_law() {
        let linear = LinearElastic::at_rest(law.as_ref()).unwrap();
        let (found, exact) = (
            linear.tangent(&Matrix3::identity()),
            law.tangent(&Matrix3::identity()),
        );
        // 1 − 2ν cancels up to three digits.
        assert!((found - exact).norm() < 1e-12 * exact.norm(), "{name}");
    }
}
