use palpate_files::Estimate;
use palpate_files::tissue::Kelvin;

use crate::Error;
use crate::fit::{Fit, Parameter, Settings, correlated_uncertainty, least_squares};

/// History of the depth in a fit of a relaxing law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthHistory {
    /// The recorded history.
    Recorded,
    /// A step to the largest depth at the first sample that reaches it; samples before are left out.
    Step,
}

/// The parameters of (6.3) and the fit that found them.
#[derive(Debug, Clone, PartialEq)]
pub struct KelvinFit {
    /// The parameters, with their standard errors.
    pub kelvin: Kelvin,
    /// The fit of k₁, k₂ and τ = b/k₁.
    pub fit: Fit,
}

/// Two springs and a damper through `times` [s], `depths` [m] and `forces` [N].
///
/// # Errors
/// When there are fewer than four samples in contact.
pub fn fit_kelvin(
    times: &[f64],
    depths: &[f64],
    forces: &[f64],
    history: DepthHistory,
) -> Result<KelvinFit, Error> {
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    let reached = |&i: &usize| depths[i] >= 0.999 * deepest;
    let first = match history {
        DepthHistory::Recorded => 0,
        DepthHistory::Step => (0..depths.len()).find(reached).unwrap_or(0),
    };
    let samples = depths.len() - first;
    if samples < 4 || deepest <= 0.0 {
        return Err(Error::TooShort {
            samples,
            task: "Kelvin's law",
            least: 4,
        });
    }
    let (times, forces) = (&times[first..], &forces[first..]);
    let depths: Vec<f64> = match history {
        DepthHistory::Recorded => depths.to_vec(),
        DepthHistory::Step => vec![deepest; samples],
    };
    let largest = forces.iter().copied().fold(0.0, f64::max);
    let duration = times[samples - 1] - times[0];
    let [stiff, soft] = [largest, forces[samples - 1].max(0.01 * largest)].map(|f| f / deepest);
    let parameters = [
        Parameter::new("k1_n_per_m", stiff).within(0.0, 100.0 * stiff),
        Parameter::new("k2_n_per_m", soft).within(0.0, 100.0 * stiff),
        Parameter::new("tau_s", 0.2 * duration).within(1e-3 * duration, 100.0 * duration),
    ];
    let fit = least_squares(
        &parameters,
        samples,
        &Settings::default(),
        |p, residuals| {
            respond(p, times, &depths, residuals);
            for (residual, force) in residuals.iter_mut().zip(forces) {
                *residual -= force;
            }
            Some(())
        },
    )?;
    Ok(KelvinFit {
        kelvin: parameters_of(&fit),
        fit,
    })
}

/// Forces [N] of the law with k₁ [N/m], k₂ [N/m] and τ [s], exact for depths that are linear between samples.
fn respond(p: &[f64], times: &[f64], depths: &[f64], forces: &mut [f64]) {
    let (k1, k2, tau) = (p[0], p[1], p[2]);
    // Extension of the spring in series with the damper.
    let mut extension = depths[0];
    for i in 0..times.len() {
        if i > 0 {
            let step = times[i] - times[i - 1];
            let decay = (-step / tau).exp();
            let moved = depths[i] - depths[i - 1];
            let share = if step > 0.0 {
                (1.0 - decay) * tau / step
            } else {
                1.0
            };
            extension = decay * extension + share * moved;
        }
        forces[i] = k2 * depths[i] + (k1 - k2) * extension;
    }
}

fn parameters_of(fit: &Fit) -> Kelvin {
    let known = correlated_uncertainty(fit, &[fit.residuals.len()]);
    let estimate = |i: usize| Estimate {
        value: fit.parameters[i].value,
        standard_error: known.standard_error(i),
    };
    let [k1, k2, tau] = [0, 1, 2].map(estimate);
    // b = τ k₁, whose error follows from both and their correlation.
    let places = [0, 2].map(|i| known.chosen.iter().position(|&chosen| chosen == i));
    let damping_error = match places {
        [Some(a), Some(b)] => {
            let c = &known.covariance;
            let square = tau.value.powi(2) * c[(a, a)]
                + k1.value.powi(2) * c[(b, b)]
                + 2.0 * tau.value * k1.value * c[(a, b)];
            Some(square.max(0.0).sqrt())
        }
        _ => None,
    };
    Kelvin {
        k1_n_per_m: k1,
        k2_n_per_m: k2,
        b_n_s_per_m: Estimate {
            value: tau.value * k1.value,
            standard_error: damping_error,
        },
        tau_s: Some(tau),
    }
}
