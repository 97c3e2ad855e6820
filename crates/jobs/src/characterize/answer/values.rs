use std::collections::BTreeMap;

use palpate_characterize::inverse::{Correlations, LawDescription};
use palpate_characterize::lumped::{Adhesion, ElasticContact, MeanModulus, UniaxialFit};
use palpate_characterize::viscoelastic::Relaxation;
use palpate_files::Estimate;
use serde::{Deserialize, Serialize};

use super::verdicts::{Identified, Partner, judge_law};

/// Parameters by their names.
pub type Named = BTreeMap<String, Known>;

/// A number with its error.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Known {
    /// In the unit of its key.
    pub value: f64,
    /// Standard error from noise, from the zeros of the recordings, and, for laws and relaxations, from model error.
    pub standard_error: Option<f64>,
    /// 95 % confidence interval: the standard error times the quantile of Student's distribution, to both sides.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub interval_95: Option<[f64; 2]>,
    /// How well the parameter is identified; null where this was not assessed.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub verdict: Option<Identified>,
    /// The parameter with which its error is correlated.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub correlated_with: Option<Partner>,
    /// The part by the elements and by the product of force and G(t), a bound.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub discretisation_error: Option<f64>,
    /// The spread over repeated fits with block-resampled residuals.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub bootstrap_error: Option<f64>,
    /// 95 % bounds of the objective with the relaxation fixed at its fitted values, so without the uncertainty of the
    /// relaxation; a side without a bound is null.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub profile_95: Option<[Option<f64>; 2]>,
}

/// Parameters found without the geometry of the specimen: they apply to this indenter on this specimen.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct LumpedAnswer {
    /// (6.1).
    pub mean_elastic_modulus: Option<MeanModulus>,
    /// Linear elastic contact, fitted to the approach: Young's modulus, where contact begins and the misfit.
    #[serde(default)]
    pub linear_elastic: Option<Named>,
    /// Adhesion of a sphere [Johnson, Kendall and Roberts 1971], fitted to the retraction: the same, the work of adhesion and
    /// the pull-off force.
    #[serde(default)]
    pub adhesion: Option<Named>,
    /// Two springs and a damper, (6.3).
    pub kelvin: Option<Named>,
    /// The exponential law on a column of effective size, section 6.3.
    pub column: Option<Named>,
    /// Table 6-2.
    pub nonlinear_springs: Option<Named>,
}

/// How far noise spreads the parameters of a law.
#[derive(Debug, Serialize, Deserialize)]
pub struct Noise {
    /// Standard deviation of independent noise, over the largest force [-].
    pub noise: f64,
    /// Spread of each parameter, in its unit.
    pub spread: BTreeMap<String, f64>,
}

/// A relaxation function.
#[derive(Debug, Serialize, Deserialize)]
pub struct RelaxationAnswer {
    /// Relative to the instantaneous modulus [-].
    pub g: Vec<Known>,
    /// [s]
    pub tau_s: Vec<Known>,
    alpha: Vec<f64>,
    sum_squared_error: f64,
    /// Exponent of depth by which the elastic force grows faster than a neo-Hookean (or linear) one [-].
    shape_exponent: Known,
    /// The same if every ramp is treated as a step.
    as_step: Option<Steps>,
    /// Results with one, two, three and four terms.
    tried: Vec<Tried>,
}

/// A relaxation function without its errors.
#[derive(Debug, Serialize, Deserialize)]
pub struct Steps {
    g: Vec<f64>,
    tau_s: Vec<f64>,
    sum_squared_error: f64,
}

/// A number of terms that was tried.
#[derive(Debug, Serialize, Deserialize)]
pub struct Tried {
    terms: usize,
    sum_squared_error: f64,
    information_criterion: f64,
}

/// An elastic law.
#[derive(Debug, Serialize, Deserialize)]
pub struct LawAnswer {
    /// By their keys.
    #[serde(flatten)]
    pub parameters: BTreeMap<String, Known>,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    correlation: Option<f64>,
    /// Effect of noise on the parameters (6.4.6).
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub noise_study: Vec<Noise>,
    /// Why there is no repeated fit, or none with block-resampled residuals.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    not_repeated: Option<String>,
    /// Iterations of the fit.
    pub iterations: usize,
    /// Finite element runs: none where the force is tabulated.
    pub solves: usize,
    /// Σ ε² [N²], or of nominal stresses [Pa²].
    sum_squared_error: f64,
    /// Root mean square of the residuals, over the largest force [-].
    pub misfit: f64,
}

impl Known {
    pub(crate) fn of(estimate: &Estimate) -> Self {
        Self {
            value: estimate.value,
            standard_error: estimate.standard_error,
            interval_95: None,
            verdict: None,
            correlated_with: None,
            discretisation_error: None,
            bootstrap_error: None,
            profile_95: None,
        }
    }

    /// The same with its interval, half of which is `reach`.
    fn reaching(self, reach: Option<f64>) -> Self {
        Self {
            interval_95: reach.map(|reach| [self.value - reach, self.value + reach]),
            ..self
        }
    }

    /// A number without an error.
    fn exact(value: f64) -> Self {
        Self::of(&Estimate {
            value,
            standard_error: None,
        })
    }

    /// The same with its interval, from the `quantile` [-] of its distribution.
    fn within(self, quantile: Option<f64>) -> Self {
        let reach = self
            .standard_error
            .zip(quantile)
            .map(|(error, t)| t * error);
        self.reaching(reach)
    }
}

/// Linear elastic contact by its keys.
pub(super) fn elastic_contact(found: &ElasticContact) -> Named {
    let modulus = Known::of(&found.youngs_modulus_pa).reaching(found.reach_pa);
    Named::from([
        ("youngs_modulus_pa".to_owned(), modulus),
        ("contact_m".to_owned(), Known::of(&found.contact_m)),
        ("misfit".to_owned(), Known::exact(found.misfit)),
    ])
}

/// Adhesion by its keys.
pub(super) fn adhesion(found: &Adhesion) -> Named {
    let mut named = elastic_contact(&found.elastic);
    let work = Known::of(&found.work_j_per_m2).reaching(found.reach_j_per_m2);
    named.insert("work_of_adhesion_j_per_m2".to_owned(), work);
    named.insert("pull_off_n".to_owned(), Known::exact(found.pull_off_n));
    named
}

/// Of intervals [-].
const LEVEL: f64 = 0.95;

impl RelaxationAnswer {
    pub(crate) fn new(found: &Relaxation, steps: Option<&Relaxation>) -> Self {
        let off = found.quasi_linear_errors();
        let column = |place: usize| -> Vec<Known> {
            let terms = found.terms.iter().zip(&found.quantiles);
            let known = terms.map(move |(term, t)| Known::of(&term[place]).within(Some(t[place])));
            let with_error = |(known, off): (Known, &[f64; 2])| Known {
                discretisation_error: Some(off[place]),
                ..known
            };
            known.zip(&off).map(with_error).collect()
        };
        Self {
            g: column(0),
            tau_s: column(1),
            alpha: found
                .product
                .terms
                .iter()
                .map(|(alpha, _)| *alpha)
                .collect(),
            sum_squared_error: found.sum_of_squares,
            shape_exponent: Known::of(&found.exponent).within(Some(found.exponent_quantile)),
            as_step: steps.map(|steps| Steps {
                g: steps.series.terms().iter().map(|(g, _)| *g).collect(),
                tau_s: steps.series.terms().iter().map(|(_, tau)| *tau).collect(),
                sum_squared_error: steps.sum_of_squares,
            }),
            tried: found
                .tried
                .iter()
                .map(|&(terms, sum_squared_error, information_criterion)| Tried {
                    terms,
                    sum_squared_error,
                    information_criterion,
                })
                .collect(),
        }
    }
}

impl LawAnswer {
    pub(crate) fn new(law: &LawDescription) -> Self {
        let repeated = law.repeated.as_ref().and_then(|found| found.as_ref().ok());
        let known = |(place, (name, estimate)): (usize, &(&'static str, Estimate))| {
            let known = Known {
                discretisation_error: Some(law.discretisation[place]),
                bootstrap_error: repeated
                    .and_then(|again| again.bootstrap.as_ref())
                    .map(|spreads| spreads[place]),
                profile_95: repeated.and_then(|again| again.profiles[place]),
                ..Known::of(estimate).within(law.uncertainty.quantile(place, LEVEL))
            };
            ((*name).to_owned(), known)
        };
        let names = || law.parameters.iter().map(|(name, _)| (*name).to_owned());
        let noise = repeated.iter().flat_map(|again| &again.noise);
        let noise = noise.map(|effect| Noise {
            noise: effect.noise,
            spread: names().zip(effect.spread.iter().copied()).collect(),
        });
        let refused = law.repeated.as_ref().and_then(|found| match found {
            Ok(again) if again.bootstrap.is_none() => Some(format!(
                "no residuals are drawn in other blocks: they stay alike for so long that a block has {} samples, \
                 more than any recording; record for longer",
                again.block
            )),
            Ok(_) => None,
            Err(error) => Some(error.to_string()),
        });
        let mut own = Self {
            parameters: law.parameters.iter().enumerate().map(known).collect(),
            noise_study: noise.collect(),
            not_repeated: refused,
            correlation: law.correlation,
            iterations: law.found.fit.iterations.len() - 1,
            solves: law.found.solves,
            sum_squared_error: law.sum_of_squares,
            misfit: law.misfit,
        };
        judge_law(&mut own, &law.correlations());
        own
    }

    pub(crate) fn of_uniaxial(law: &UniaxialFit) -> Self {
        let correlation = law.uncertainty.correlation();
        let mut own = Self {
            parameters: law
                .parameters
                .iter()
                .enumerate()
                .map(|(place, (name, known))| {
                    let quantile = law.uncertainty.quantile(place, LEVEL);
                    ((*name).to_owned(), Known::of(known).within(quantile))
                })
                .collect(),
            noise_study: Vec::new(),
            not_repeated: None,
            correlation: (correlation.ncols() > 1).then(|| correlation[(0, 1)]),
            iterations: law.fit.iterations.len() - 1,
            solves: 0,
            sum_squared_error: law.fit.sum_of_squares(),
            misfit: law.misfit,
        };
        judge_law(&mut own, &correlations_of_piece(law));
        let fixed = law.fit.parameters.iter().filter(|own| own.fixed);
        let fixed = fixed.map(|own| (own.name.as_str(), Identified::Stated));
        let undetermined = law.undetermined.iter();
        let undetermined = undetermined.map(|name| (*name, Identified::HardlyKnown));
        for (name, verdict) in fixed.chain(undetermined) {
            if let Some(known) = own.parameters.get_mut(name) {
                known.verdict = Some(verdict);
            }
        }
        own
    }
}

/// Correlations of the parameters of a piece.
pub(crate) fn correlations_of_piece(law: &UniaxialFit) -> Correlations {
    let names = law.parameters.iter().map(|(name, _)| (*name).to_owned());
    let [covariance, _] = law.uncertainty.of_all(law.parameters.len());
    Correlations::of(names.collect(), &covariance)
}
