//! Warnings.

use palpate_simulate::TRUSTED_DEPTH;

use super::super::problem::Problem;

/// Depth over the contact radius beyond which small strain is inaccurate [-].
const LARGE_STRAIN: f64 = 0.2;

/// Highest frequency that the source could follow and its devices respond to [Hz].
const FAST: f64 = 8.0;

/// Warnings of every kind of problem.
pub(crate) fn shared(problem: &Problem, estimated_error: f64) -> Vec<String> {
    let mut warnings = [&problem.warnings[..], &problem.material.warnings].concat();
    // A NaN error is not within the requested accuracy.
    if estimated_error.is_nan() || estimated_error > problem.accuracy {
        warnings.push(format!(
            "the accuracy was not reached: the estimated error is {:.2} %, {} % were asked for; \
             the mesh is as fine as it is made",
            100.0 * estimated_error,
            100.0 * problem.accuracy,
        ));
    }
    warnings
}

/// Warnings for a contact of a radius [m] pressed to `depths` [m].
pub(crate) fn of_depths(problem: &Problem, radius: f64, depths: &[f64]) -> Vec<String> {
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    let mut warnings = Vec::new();
    if deepest > TRUSTED_DEPTH {
        warnings.push(format!(
            "the depth reaches {:.1} mm; beyond 10 mm no model here has been compared with tissue",
            1e3 * deepest
        ));
    }
    if problem.is_small_strain() && deepest > LARGE_STRAIN * radius {
        warnings.push(format!(
            "the linear law is for small strain, but the depth is {:.2} of the contact's radius; \
             a hyperelastic law follows large strain",
            deepest / radius
        ));
    }
    warnings
}

/// Warnings for a ramp that takes `ramp` [s], which is a quarter of a sine's period.
pub(crate) fn of_ramp(problem: &Problem, ramp: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    let frequency = 0.25 / ramp;
    if frequency > FAST {
        warnings.push(format!(
            "the ramp is as fast as a sine of {frequency:.0} Hz; beyond 8 Hz no measurement \
             stands behind the relaxation, and inertia is left out"
        ));
    }
    if problem.tissue.prony.is_empty() {
        warnings.push(
            "the tissue has no `prony` terms, so that nothing relaxes during a hold".to_owned(),
        );
    }
    warnings
}
