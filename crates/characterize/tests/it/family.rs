//! Laws whose curves are solved while they are sought.

use palpate_characterize::inverse::{
    Body, CandidateLaw, Curves, Indentation, LawDescription, Terms, law_fit,
};
use palpate_mechanics::PronySeries;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::tube::Tube;

/// Judge: finite elements at a shape that the fit does not know; forces of a curve solved at the found shape and
/// those of the true one are the same to what `law_fit` asks of the shape, 3e-4, which is the 1e-3 of γ and 3e-3
/// of α here. A search that solves at each of its steps takes nine runs.
#[test]
fn an_exponential_law_needs_few_runs() {
    let (gamma, alpha, radius) = (800.0, 2.3, 1e-3);
    let series = PronySeries::new(&[(0.3, 2.0)]).unwrap();
    let body = Body::under_punch(radius);
    let time: Vec<f64> = (0..200).map(|i| 0.02 * f64::from(i)).collect();
    let depth: Vec<f64> = time.iter().map(|t| 1e-3 * (t / 0.5).min(1.0)).collect();
    let mut of_truth = Curves::new(body, CandidateLaw::Exponential, 1e-3);
    let curve = of_truth.of(gamma, &[alpha]).unwrap().force;
    let force: Vec<f64> = curve.relaxed(&series, &time, &depth);
    let force: Vec<f64> = force.iter().map(|unit| gamma * unit).collect();
    let indentation = Indentation::new(&time, &depth, &force);
    let mut curves = Curves::new(body, CandidateLaw::Exponential, 1e-3);
    let found = law_fit(&mut curves, &[indentation], &series).unwrap();
    let off = [
        found.modulus() / gamma - 1.0,
        found.shape()[0] / alpha - 1.0,
    ];
    println!("{off:?} in {} runs", found.solves);
    assert!(off[0].abs() < 1e-3 && off[1].abs() < 3e-3, "{off:?}");
    assert!(found.solves <= 6, "{} runs", found.solves);
}

/// Judge: finite elements at shapes that the fit does not know, without noise. The force at the shapes that were found is
/// the true one to 1e-3, some times what `law_fit` asks of each depth; a parameter is the true one but for ten times that
/// where the force tells it, and else within its interval, which then is wide.
#[test]
#[ignore = "long"]
fn laws_of_several_shapes_return_or_say_that_they_do_not() {
    let truths: [(CandidateLaw, &[f64]); 4] = [
        (CandidateLaw::Ogden(Terms::One), &[5.3]),
        (CandidateLaw::ReducedPolynomial(Terms::Two), &[0.31]),
        (CandidateLaw::ReducedPolynomial(Terms::Three), &[0.12, 0.11]),
        (CandidateLaw::Ogden(Terms::Two), &[3.7, 0.4, -4.1]),
    ];
    let (modulus, series) = (800.0, PronySeries::default());
    let body = Body::under_punch(1e-3);
    let depth: Vec<f64> = (0..=100).map(|i| 1.5e-5 * f64::from(i)).collect();
    let time: Vec<f64> = (0..=100).map(|i| 0.01 * f64::from(i)).collect();
    for (law, shape) in truths {
        let mut curves = Curves::new(body, law, 1.5e-3);
        let curve = curves.of(f64::INFINITY, shape).unwrap().force;
        let force: Vec<f64> = depth.iter().map(|d| modulus * curve.force(*d)).collect();
        let indentation = [Indentation::new(&time, &depth, &force)];
        let mut curves = Curves::new(body, law, 1.5e-3);
        let found = law_fit(&mut curves, &indentation, &series).unwrap();
        let found = LawDescription::of(found, &indentation);
        println!(
            "{law:?}: {} runs, {:?}",
            found.found.solves, found.parameters
        );
        let most = force[100];
        for (found, force) in found.found.forces[0].iter().zip(&force) {
            assert!(
                (found - force).abs() < 1e-3 * most,
                "{law:?}: {found} {force}"
            );
        }
        let truth = law.parameters(modulus, shape);
        for (place, ((name, own), truth)) in found.parameters.iter().zip(&truth).enumerate() {
            let error = own.standard_error.unwrap_or(f64::INFINITY);
            let off = (own.value - truth.value).abs();
            let quantile = found
                .uncertainty
                .quantile(place, 0.95)
                .unwrap_or(f64::INFINITY);
            println!("{name}: {} ± {error} of {}", own.value, truth.value);
            assert!(
                off < 0.01 * truth.value.abs() || off < quantile * error,
                "{name}"
            );
        }
        assert!(found.found.solves <= 12, "{} runs", found.found.solves);
    }
}

/// The pressure stiffens the tube, so its curve belongs to one modulus, and the fit has to go round by round.
/// Judge: the run at the true modulus; law_fit ends when a round changes the modulus by less than 1e-3, of which
/// the error left is a part, since half of the force or less comes with the pressure. Without the pressure in its
/// curve, a fit would be off by what the pressure adds to the force, which is asserted to be more than 10 %.
#[test]
#[ignore = "six to eight runs of a tube's finite elements under pressure: minutes"]
fn a_tube_under_pressure_gives_its_modulus() {
    let modulus = 866.7;
    let of = |pressure| {
        let body = Body::Tube {
            tube: Tube {
                length: 0.04,
                inner_radius: 5e-3,
                outer_radius: 7.5e-3,
            },
            radius: 2e-3,
            face: Friction::Frictionless,
            pressure,
        };
        Curves::new(body, CandidateLaw::NeoHookean, 1.5e-3)
    };
    let series = PronySeries::new(&[]).unwrap();
    let depth: Vec<f64> = (1..=40).map(|i| 1.5e-3 / 40.0 * f64::from(i)).collect();
    let time: Vec<f64> = (1..=40).map(|i| 0.05 * f64::from(i)).collect();
    let felt = |mut curves: Curves| -> Vec<f64> {
        let curve = curves.of(modulus, &[]).unwrap().force;
        let unit = curve.relaxed(&series, &time, &depth);
        unit.iter().map(|unit| modulus * unit).collect()
    };
    let (force, without) = (felt(of(300.0)), felt(of(0.0)));
    let added = force[39] / without[39] - 1.0;
    let indentation = Indentation::new(&time, &depth, &force);
    let found = law_fit(&mut of(300.0), &[indentation], &series).unwrap();
    let off = found.modulus() / modulus - 1.0;
    println!(
        "300 Pa add {added:.3}; the modulus is off by {off:.1e} after {} runs",
        found.solves
    );
    assert!(added > 0.1, "{added}");
    assert!(off.abs() < 1e-3, "{off}");
}
