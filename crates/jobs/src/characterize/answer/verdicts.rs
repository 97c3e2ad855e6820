//! How well each parameter is identified.

use nalgebra::DMatrix;
use palpate_characterize::fit::{Verdict, verdicts};
use palpate_characterize::inverse::Correlations;
use serde::{Deserialize, Serialize};

use super::values::{Known, LawAnswer, RelaxationAnswer};

/// How well a parameter is identified, decided from its standard error and its correlations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Identified {
    /// By itself.
    Known,
    /// Its error is correlated with that of another parameter, named by `correlated_with`.
    Correlated,
    /// Its standard error is more than a quarter of it, or the tests do not determine it.
    HardlyKnown,
    /// It ended on a bound.
    OnBound,
    /// The recordings state it.
    Stated,
}

/// The other parameter of a correlation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Partner {
    /// By its key; of the relaxation `g_1`, `tau_1_s` and so on.
    pub parameter: String,
    /// Of both errors [-].
    pub correlation: f64,
}

/// Judges the parameters of a `law` by their `correlations`, which may be those of the relaxation too.
pub(super) fn judge_law(law: &mut LawAnswer, correlations: &Correlations) {
    let parameters = law.parameters.iter_mut();
    let named = parameters.map(|(name, known)| (name.clone(), known));
    judge(named.collect(), correlations);
}

/// Judges gᵢ and τᵢ.
pub(super) fn judge_relaxation(relaxation: &mut RelaxationAnswer, correlations: &Correlations) {
    let g = (1..).zip(&mut relaxation.g);
    let g = g.map(|(place, known)| (format!("g_{place}"), known));
    let tau = (1..).zip(&mut relaxation.tau_s);
    let tau = tau.map(|(place, known)| (format!("tau_{place}_s"), known));
    judge(g.chain(tau).collect(), correlations);
}

fn judge(parameters: Vec<(String, &mut Known)>, correlations: &Correlations) {
    // Correlations may be those of others too, which are judged elsewhere: for these they have errors.
    let mut errors = vec![Some(0.0); correlations.names.len()];
    let place = |name: &str| correlations.names.iter().position(|own| own == name);
    let relative = |known: &Known| Some(known.standard_error? / known.value.abs());
    for (name, known) in &parameters {
        if let Some(place) = place(name) {
            errors[place] = relative(known);
        }
    }
    let all = verdicts(&errors, &correlations.matrix);
    for (name, known) in parameters {
        let verdict = match place(&name) {
            Some(place) => all[place],
            // Without an error, or of another fit: by its own error alone.
            None => verdicts(&[relative(known)], &DMatrix::identity(1, 1))[0],
        };
        known.verdict = Some(match verdict {
            Verdict::Known => Identified::Known,
            Verdict::Correlated { .. } => Identified::Correlated,
            Verdict::HardlyKnown => Identified::HardlyKnown,
            Verdict::NoEstimate => Identified::OnBound,
        });
        if let Verdict::Correlated { with, correlation } = verdict {
            let parameter = correlations.names[with].clone();
            known.correlated_with = Some(Partner {
                parameter,
                correlation,
            });
        }
    }
}
