//! Judge: the certificates of NIST's problems of nonlinear regression.

use palpate_characterize::Error;
use palpate_characterize::fit::{Differences, Fit, Settings, Stop, least_squares, uncertainty};

use super::nist::{Certified, PROBLEMS};
use super::parameters;

fn fitted(problem: &Certified, start: usize, differences: Differences) -> Result<Fit, Error> {
    let settings = Settings {
        differences,
        // Two of the starts lie at the far end of long valleys.
        iterations: 10_000,
        ..Settings::default()
    };
    let residuals = |b: &[f64], residuals: &mut [f64]| {
        for (residual, pair) in residuals.iter_mut().zip(problem.data.chunks_exact(2)) {
            *residual = (problem.model)(pair[1], b) - pair[0];
        }
        Some(())
    };
    let parameters = parameters(problem.starts[start]);
    least_squares(&parameters, problem.data.len() / 2, &settings, residuals)
}

/// Values, standard deviations and the sum of squares of every problem from both starts, but for one start from
/// which the way leads to a plateau.
///
/// Differences to both sides have about ten digits; of these the problems lose up to four in values that the
/// data hardly determine, and as many more in the standard deviations. The sum of squares tells of a wrong datum.
#[test]
fn certified_values_are_found_from_both_starts() {
    for problem in PROBLEMS {
        for start in 0..2 {
            if (problem.name, start) == ("BoxBOD", 0) {
                continue;
            }
            let fit = fitted(problem, start, Differences::Central).unwrap();
            let uncertainty = uncertainty(&fit);
            let case = format!("{} from {start}", problem.name);
            assert_eq!(fit.stop, Stop::Converged, "{case}");
            let near = |found: f64, known: f64, tolerance: f64, what: &str| {
                let error = (found / known - 1.0).abs();
                assert!(
                    error < tolerance,
                    "{case}: {what} {found:e}, certified {known:e}"
                );
            };
            near(
                fit.sum_of_squares(),
                problem.sum_of_squares,
                1e-9,
                "sum of squares",
            );
            for (i, (value, deviation)) in problem.values.iter().zip(problem.deviations).enumerate()
            {
                near(fit.parameters[i].value, *value, 1e-6, "value");
                let error = uncertainty.standard_error(i).unwrap();
                near(error, *deviation, 1e-5, "deviation");
            }
        }
    }
}
