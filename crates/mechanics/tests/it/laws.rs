//! One battery for every law.
//!
//! Judges: central differences, by the order at which their error falls; rotations; moduli at rest.

use nalgebra::Matrix3;
use palpate_mechanics::{Exponential, FibreFrame, Law, LinearElastic, NeoHookean, Tangent};

use crate::contacts::{MODULUS, Random, tries};
use crate::every_law::{Candidate, deformation, every_law, rotation};

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
        // Rounding hides the order of what is hardly more.
        assert!(
            (order - 2.0).abs() < 0.1 + rounding / pair[1],
            "{name}: order {order}: {errors:?}"
        );
    }
}

/// What rounding of a deformation does to stress [Pa]: its last digits times the tangent, tenfold for
/// the sums.
fn rounding(law: &Candidate, f: &Matrix3<f64>) -> f64 {
    10.0 * f64::EPSILON * law.tangent(f).norm() * f.norm()
}

/// The derivative of a function of F by central differences with `step`, numbered as a [`Tangent`].
fn differences(
    f: &Matrix3<f64>,
    step: f64,
    function: impl Fn(&Matrix3<f64>) -> Matrix3<f64>,
) -> Tangent {
    let mut found = Tangent::zeros();
    for entry in 0..9 {
        let [up, down] = [step, -step].map(|s| function(&moved(f, entry, s)));
        let slope = (up - down) / (2.0 * step);
        found.column_mut(entry).copy_from_slice(slope.as_slice());
    }
    found
}

/// As [`differences`], of a number.
fn gradient(f: &Matrix3<f64>, step: f64, function: impl Fn(&Matrix3<f64>) -> f64) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| {
        let [up, down] = [step, -step].map(|s| function(&moved(f, i + 3 * j, s)));
        (up - down) / (2.0 * step)
    })
}

#[test]
fn rest_has_neither_energy_nor_stress() {
    for law in every_law() {
        let rest = Matrix3::identity();
        // The projection rounds; linear elasticity has none.
        let allowed = if law.is_finite_strain() {
            rounding(&law, &rest)
        } else {
            0.0
        };
        assert_eq!(law.energy(&rest), 0.0, "{}", law.name);
        assert!(law.stress(&rest).norm() <= allowed, "{}", law.name);
    }
}

#[test]
fn stress_is_the_derivative_of_energy() {
    let mut random = Random(1);
    for law in every_law() {
        for _ in 0..tries(200) {
            let f = law.deformation(&mut random);
            let exact = law.stress(&f);
            falls_with_the_square(&law.name, law.energy(&f).abs() + exact.norm(), |step| {
                (gradient(&f, step, |f| law.energy(f)) - exact).norm()
            });
        }
    }
}

#[test]
fn tangent_is_the_derivative_of_stress() {
    let mut random = Random(2);
    for law in every_law() {
        for _ in 0..tries(200) {
            let f = law.deformation(&mut random);
            let exact = law.tangent(&f);
            falls_with_the_square(&law.name, law.stress(&f).norm() + exact.norm(), |step| {
                (differences(&f, step, |f| law.stress(f)) - exact).norm()
            });
        }
    }
}

/// Where two stretches or all three are the same, in which a formula by stretches would divide by zero.
#[test]
fn tangent_is_the_derivative_of_stress_at_equal_stretches() {
    let mut random = Random(3);
    for law in every_law() {
        for stretches in [[1.0, 1.0, 1.0], [1.2, 1.2, 0.7], [0.9, 1.3, 0.9]] {
            for apart in [0.0, 1e-12, 1e-8, 1e-5] {
                let stretch = Matrix3::from_diagonal(&stretches.into());
                let mut f = rotation(&mut random) * stretch * rotation(&mut random);
                f[0] += apart;
                if !law.is_smooth_near(&f) {
                    continue;
                }
                let exact = law.tangent(&f);
                falls_with_the_square(&law.name, law.stress(&f).norm() + exact.norm(), |step| {
                    (differences(&f, step, |f| law.stress(f)) - exact).norm()
                });
            }
        }
    }
}

/// A tangent is a second derivative, so ∂P_ij/∂F_kl = ∂P_kl/∂F_ij.
#[test]
fn tangent_is_symmetric() {
    let mut random = Random(3);
    for law in every_law() {
        for _ in 0..tries(200) {
            let tangent = law.tangent(&deformation(&mut random));
            // Rounding.
            let off = (tangent - tangent.transpose()).norm();
            assert!(off < 1e-14 * tangent.norm(), "{}: {off}", law.name);
        }
    }
}

/// Ψ(Q F) = Ψ(F), P(Q F) = Q P(F): who looks on does not matter.
#[test]
fn a_rotation_afterwards_turns_the_stress() {
    let mut random = Random(4);
    for law in every_law().iter().filter(|law| law.is_finite_strain()) {
        for _ in 0..tries(200) {
            let (f, q) = (deformation(&mut random), rotation(&mut random));
            let allowed = rounding(law, &f);
            let energy = law.energy(&(q * f)) - law.energy(&f);
            assert!(energy.abs() < allowed, "{}: {energy}", law.name);
            let stress = (law.stress(&(q * f)) - q * law.stress(&f)).norm();
            assert!(stress < allowed, "{}: {stress}", law.name);
        }
    }
}

/// Ψ(F Q) = Ψ(F), P(F Q) = P(F) Q: no direction in the tissue. A small strain is turned from both sides.
#[test]
fn a_rotation_before_changes_nothing() {
    let mut random = Random(5);
    for law in every_law().iter().filter(|law| law.fibres.is_none()) {
        for _ in 0..tries(200) {
            let (f, q) = (deformation(&mut random), rotation(&mut random));
            let left = if law.is_finite_strain() {
                Matrix3::identity()
            } else {
                q.transpose()
            };
            let allowed = rounding(law, &f);
            let energy = law.energy(&(left * f * q)) - law.energy(&f);
            assert!(energy.abs() < allowed, "{}: {energy}", law.name);
            let stress = (law.stress(&(left * f * q)) - left * law.stress(&f) * q).norm();
            assert!(stress < allowed, "{}: {stress}", law.name);
        }
    }
}

/// With fibres it changes nothing where their frame is turned with the tissue.
#[test]
fn a_rotation_before_turns_the_fibres() {
    let mut random = Random(18);
    for law in every_law() {
        let Some(fibres) = law.fibres else {
            continue;
        };
        // At rest no fibre is stretched, not even by rounding.
        assert_eq!(fibres.fibre_strains(&Matrix3::identity()), [0.0; 2]);
        for _ in 0..tries(200) {
            let (f, q) = (deformation(&mut random), rotation(&mut random));
            let [axis, across] = [random.vector(), random.vector()];
            let here = FibreFrame::new(&axis, &across).unwrap();
            let there = FibreFrame::new(&(q.transpose() * axis), &(q.transpose() * across));
            let [here, there] =
                [here, there.unwrap()].map(|frame| fibres.in_frame(&frame).unwrap());
            let allowed = 10.0 * f64::EPSILON * here.distortion_tangent(&f).norm() * f.norm();
            let energy = there.distortion_energy(&(f * q)) - here.distortion_energy(&f);
            assert!(energy.abs() < allowed, "{}: {energy}", law.name);
            let stress = there.distortion_stress(&(f * q)) - here.distortion_stress(&f) * q;
            assert!(stress.norm() < allowed, "{}: {stress}", law.name);
        }
    }
}

#[test]
fn distortion_does_not_feel_a_pure_dilation() {
    let mut random = Random(6);
    for law in every_law() {
        for scale in [0.3, 0.9, 1.0, 1.1, 3.0] {
            let f = if law.is_finite_strain() {
                scale * rotation(&mut random)
            } else {
                Matrix3::from_diagonal_element(scale)
            };
            // As in `rounding`, of distortion alone.
            let allowed =
                10.0 * f64::EPSILON * law.law.distortion_tangent(&f).norm() * f.norm().max(1.0);
            let energy = law.law.distortion_energy(&f);
            assert!(energy.abs() <= allowed * f.norm(), "{}: {energy}", law.name);
            let stress = law.law.distortion_stress(&f).norm();
            assert!(stress <= allowed, "{}: {stress}", law.name);
        }
        // And the same distortion at another volume is the same.
        let f = deformation(&mut random);
        if law.is_finite_strain() {
            let [here, there] = [f, 1.7 * f].map(|f| law.law.distortion_energy(&f));
            assert!((here - there).abs() < rounding(&law, &f), "{}", law.name);
        }
    }
}

/// Every isotropic law is a linear one for small strain, with the modulus that is written beside it.
#[test]
fn every_law_has_its_linearization_at_rest() {
    for law in every_law().iter().filter(|law| law.fibres.is_none()) {
        let linear = LinearElastic::at_rest(law.law.as_ref()).unwrap();
        let rest = Matrix3::identity();
        let (found, exact) = if law.is_incompressible() {
            (linear.distortion_tangent(&rest), law.tangent(&rest))
        } else {
            (linear.tangent(&rest), law.tangent(&rest))
        };
        // 1 − 2ν cancels up to three digits.
        let off = (found - exact).norm() / exact.norm();
        assert!(off < 1e-12, "{}: {off}", law.name);
        // Incompressible: E = 3 μ, which the linear law has but for ν = 0.49999 in place of ½.
        let found = if law.is_incompressible() {
            3.0 * linear.shear_modulus()
        } else {
            linear.youngs_modulus()
        };
        let off = found / law.youngs_modulus - 1.0;
        assert!(off.abs() < 1e-12, "{}: {found}", law.name);
    }
}

#[test]
fn a_small_strain_costs_energy() {
    let mut random = Random(7);
    for law in every_law() {
        for _ in 0..tries(200) {
            let any = Matrix3::from_fn(|_, _| random.sign());
            let mut strain = any + any.transpose();
            if law.is_incompressible() {
                strain -= Matrix3::from_diagonal_element(strain.trace() / 3.0);
            }
            let flat = nalgebra::SVector::<f64, 9>::from_column_slice(strain.as_slice());
            let energy = flat.dot(&(law.tangent(&Matrix3::identity()) * flat));
            // Twice the energy is at least the smaller of 2 μ and 3 κ times the strain's square.
            let bulk = law.law.volume().bulk_modulus;
            // Of the law without its fibres, which add to it.
            let shear = 3.0 * law.youngs_modulus / (9.0 - law.youngs_modulus / bulk);
            let least = 2.0 * shear;
            let least = least.min(3.0 * law.law.volume().bulk_modulus) * strain.norm_squared();
            assert!(energy > (1.0 - 1e-12) * least, "{}: {energy}", law.name);
        }
    }
}

#[test]
fn parameters_have_their_derivatives() {
    let mut random = Random(8);
    for law in every_law() {
        let parameters = law.law.parameters();
        let values: Vec<f64> = parameters.iter().map(|(_, value)| *value).collect();
        for (index, (parameter, value)) in parameters.iter().enumerate() {
            let name = format!("{}: {parameter}", law.name);
            // A unit of change that leaves the law one.
            let unit = match *parameter {
                "poissons_ratio" => 0.5 - value,
                "alpha" => 1.0,
                "k1_pa" | "k2" => *value,
                "dispersion" => value.min(1.0 / 3.0 - value),
                "fibre_angle_deg" => value.min(90.0 - value),
                // One of 1 changes stress by hardly more than its last digits, where the stretches are near 1.
                name if name.starts_with("alpha_") => 20.0,
                _ => MODULUS,
            };
            let f = law.deformation(&mut random);
            let at = |change: f64| {
                let mut values = values.clone();
                values[index] += change * unit;
                (law.rebuilt)(&values)
            };
            let (stress, compressibility) = law.law.sensitivities(index, &f);
            let scale = law.law.distortion_stress(&f).norm() + (stress * unit).norm();
            falls_with_the_square(&name, scale, |step| {
                let [up, down] = [step, -step].map(|s| at(s).distortion_stress(&f));
                ((up - down) / (2.0 * step) - stress * unit).norm()
            });
            let softness = |law: &dyn Law| 1.0 / law.volume().bulk_modulus;
            // 1 − 2ν is a difference of numbers of size 1.
            let scale = 1.0 / MODULUS + (compressibility * unit).abs();
            falls_with_the_square(&name, scale, |step| {
                let [up, down] = [step, -step].map(|s| softness(at(s).as_ref()));
                ((up - down) / (2.0 * step) - compressibility * unit).abs()
            });
        }
    }
}

#[test]
fn dilation_has_its_gradient_and_curvature() {
    let mut random = Random(9);
    for law in every_law() {
        let volume = law.law.volume();
        for _ in 0..tries(200) {
            let f = deformation(&mut random);
            // A determinant is of first degree in each entry: no error but rounding.
            falls_with_the_square(&law.name, 1.0, |step| {
                let found = gradient(&f, step, |f| volume.dilation(f));
                (found - volume.dilation_gradient(&f)).norm()
            });
            falls_with_the_square(&law.name, 1.0, |step| {
                let found = differences(&f, step, |f| volume.dilation_gradient(f));
                (found - volume.dilation_curvature(&f)).norm()
            });
        }
    }
}

/// A solver must notice, and nothing may panic.
#[test]
fn what_is_inside_out_has_no_stress() {
    let flat = Matrix3::from_diagonal(&[1.0, 1.0, 0.0].into());
    let mirrored = Matrix3::from_diagonal(&[1.0, 1.0, -1.0].into());
    let nowhere = Matrix3::repeat(f64::NAN);
    let far = Matrix3::from_diagonal_element(1e200);
    for law in every_law().iter().filter(|law| law.is_finite_strain()) {
        for f in [flat, mirrored, -Matrix3::identity(), nowhere, far] {
            assert!(law.law.distortion_energy(&f).is_nan(), "{}", law.name);
            let stress = law.law.distortion_stress(&f);
            assert!(stress.iter().all(|entry| entry.is_nan()), "{}", law.name);
            let tangent = law.law.distortion_tangent(&f);
            assert!(tangent.iter().all(|entry| entry.is_nan()), "{}", law.name);
        }
    }
}

#[test]
fn an_exponential_that_overflows_does_not_pass_for_a_number() {
    let law = Exponential::incompressible(MODULUS, 20.0).unwrap();
    let f = Matrix3::new(7.0, 0.1, 0.0, 0.0, 0.4, 0.0, 0.2, 0.0, 0.4);
    assert!(!law.distortion_energy(&f).is_finite());
    assert!(!law.distortion_stress(&f).norm().is_finite());
    assert!(!law.distortion_tangent(&f).norm().is_finite());
}

/// At α → 0 the exponential law is the neo-Hookean one with C10 = γ/2.
#[test]
fn without_stiffening_the_exponential_law_is_neo_hookean() {
    let mut random = Random(10);
    let plain = NeoHookean::incompressible(0.5 * MODULUS).unwrap();
    for alpha in [0.0, 1e-300, 1e-17, -1e-17] {
        let law = Exponential::incompressible(MODULUS, alpha).unwrap();
        let f = deformation(&mut random);
        let allowed = 1e-14 * plain.distortion_tangent(&f).norm();
        let energy = law.distortion_energy(&f) - plain.distortion_energy(&f);
        assert!(energy.abs() < allowed, "{alpha}: {energy}");
        let stress = law.distortion_stress(&f) - plain.distortion_stress(&f);
        assert!(stress.norm() < allowed, "{alpha}: {stress}");
        let tangent = law.distortion_tangent(&f) - plain.distortion_tangent(&f);
        assert!(tangent.norm() < allowed, "{alpha}: {tangent}");
    }
}

#[test]
fn distortion_is_its_three_parts() {
    let mut random = Random(17);
    for law in every_law() {
        for _ in 0..tries(200) {
            let f = deformation(&mut random);
            let all = law.law.distortion(&f);
            assert_eq!(all.energy, law.law.distortion_energy(&f), "{}", law.name);
            assert_eq!(all.stress, law.law.distortion_stress(&f), "{}", law.name);
            assert_eq!(all.tangent, law.law.distortion_tangent(&f), "{}", law.name);
        }
    }
}
