//! Laws whose curves are solved while they are sought.

use palpate_characterize::inverse::{Body, Curves, Indentation, SoughtLaw, law_fit};
use palpate_mechanics::PronySeries;

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
    let mut of_truth = Curves::new(body, SoughtLaw::Exponential, 1e-3);
    let curve = of_truth.of(gamma, alpha).unwrap().force;
    let force: Vec<f64> = curve.relaxed(&series, &time, &depth);
    let force: Vec<f64> = force.iter().map(|unit| gamma * unit).collect();
    let indentation = Indentation {
        time: &time,
        depth: &depth,
        force: &force,
    };
    let mut curves = Curves::new(body, SoughtLaw::Exponential, 1e-3);
    let found = law_fit(&mut curves, &[indentation], &series).unwrap();
    let off = [found.modulus() / gamma - 1.0, found.shape() / alpha - 1.0];
    println!("{off:?} in {} runs", found.solves);
    assert!(off[0].abs() < 1e-3 && off[1].abs() < 3e-3, "{off:?}");
    assert!(found.solves <= 6, "{} runs", found.solves);
}
