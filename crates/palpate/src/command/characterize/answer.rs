use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use palpate_characterize::inverse::{LawDescription, SoughtLaw};
use palpate_characterize::lumped::UniaxialFit;
use palpate_characterize::viscoelastic::Relaxation;
use palpate_files::Estimate;
use palpate_files::recording::RecordingHeader;
use serde::Serialize;

use super::Studied;
use super::pooled::{self, Pooled};
use crate::command::recordings::Unusable;
use crate::output::VERSION;

/// The machine-readable answer.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    pub(super) specimens: Vec<Specimen>,
    pooled: BTreeMap<String, Pooled>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unusable: Vec<Unusable>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) warnings: Vec<String>,
}

/// What was found about one specimen.
#[derive(Debug, Serialize)]
pub(super) struct Specimen {
    files: Vec<PathBuf>,
    organ: Option<String>,
    subject: Option<String>,
    site: Option<String>,
    pub(super) mean_elastic_modulus: Option<Modulus>,
    /// Why it is null.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    pub(super) relaxation: Option<RelaxationAnswer>,
    pub(super) neo_hookean: Option<LawAnswer>,
    pub(super) mooney_rivlin: Option<LawAnswer>,
    pub(super) exponential: Option<LawAnswer>,
    kelvin: Option<Named>,
    blatz: Option<Named>,
    nonlinear_springs: Option<Named>,
    /// The law to be preferred, by its name in a tissue file.
    pub(super) preferred: Option<&'static str>,
    pub(super) identifiability: Vec<String>,
    /// Why something is null.
    reasons: BTreeMap<&'static str, String>,
    #[serde(skip)]
    pub(super) title: String,
}

/// Parameters by their names.
type Named = BTreeMap<&'static str, Known>;

/// The mean elastic modulus (6.1).
#[derive(Debug, Serialize)]
pub(super) struct Modulus {
    pub(super) value: f64,
    /// Over the holds at that depth; null for one.
    pub(super) standard_deviation: Option<f64>,
    pub(super) depth_m: f64,
    holds: usize,
}

/// A number with its error by noise and what the model's elements may be off.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Known {
    pub(super) value: f64,
    pub(super) standard_error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    discretisation_error: Option<f64>,
}

/// A relaxation function.
#[derive(Debug, Serialize)]
pub(super) struct RelaxationAnswer {
    pub(super) g: Vec<Known>,
    pub(super) tau_s: Vec<Known>,
    alpha: Vec<f64>,
    sum_squared_error: f64,
    /// By what power the elastic force grows faster with depth than a neo-Hookean (or linear) one [-].
    shape_exponent: Known,
    /// The same if every ramp is taken for a step.
    as_step: Option<Steps>,
    /// What one, two, three and four terms come to.
    tried: Vec<Tried>,
}

/// A relaxation function without its errors.
#[derive(Debug, Serialize)]
struct Steps {
    g: Vec<f64>,
    tau_s: Vec<f64>,
    sum_squared_error: f64,
}

/// A number of terms that was tried.
#[derive(Debug, Serialize)]
struct Tried {
    terms: usize,
    sum_squared_error: f64,
    information_criterion: f64,
}

/// An elastic law.
#[derive(Debug, Serialize)]
pub(super) struct LawAnswer {
    #[serde(flatten)]
    pub(super) parameters: BTreeMap<&'static str, Known>,
    #[serde(skip_serializing_if = "Option::is_none")]
    correlation: Option<f64>,
    iterations: usize,
    /// Runs of finite elements: none where the force is tabulated.
    solves: usize,
    /// Σ ε² [N²], or of nominal stresses [Pa²].
    sum_squared_error: f64,
    /// Root mean square of what the law does not follow, over the largest force [-].
    pub(super) misfit: f64,
}

impl Answer {
    pub(super) fn new(studied: &[Studied], unusable: &[Unusable]) -> Self {
        let specimens: Vec<Specimen> = studied.iter().map(Specimen::new).collect();
        let several = specimens.len() > 1;
        let mut warnings = Vec::new();
        for (studied, specimen) in studied.iter().zip(&specimens) {
            let said =
                studied
                    .recordings
                    .iter()
                    .zip(&studied.files)
                    .flat_map(|(recording, file)| {
                        recording
                            .doubts
                            .iter()
                            .map(move |doubt| format!("{}: {doubt}", file.display()))
                    });
            warnings.extend(said);
            let unknown = specimen.reasons.get("neo_hookean");
            let found = specimen.identifiability.iter().chain(&studied.found.doubts);
            warnings.extend(found.chain(unknown).map(|doubt| match several {
                true => format!("{}: {doubt}", specimen.title),
                false => doubt.clone(),
            }));
        }
        warnings.extend(unusable.iter().map(Unusable::sentence));
        Self {
            palpate: VERSION,
            pooled: pooled::of(studied),
            specimens,
            unusable: unusable.to_vec(),
            warnings,
        }
    }
}

impl Specimen {
    fn new(studied: &Studied) -> Self {
        let found = &studied.found;
        let header = &studied.recordings[0].header;
        let mut reasons = BTreeMap::new();
        let mut law = |sought: SoughtLaw, key: &'static str| {
            let pulled = found.uniaxial.iter().find(|(law, _)| *law == sought);
            let pressed = found.laws.iter().find(|(law, _)| *law == sought);
            let answer = match (pulled, pressed) {
                (Some((_, pulled)), _) => pulled.as_ref().map(LawAnswer::of_uniaxial),
                (None, Some((_, pressed))) => pressed.as_ref().map(LawAnswer::new),
                (None, None) => return None,
            };
            answer
                .map_err(|error| reasons.insert(key, error.to_string()))
                .ok()
        };
        let [neo_hookean, mooney_rivlin, exponential] = [
            law(SoughtLaw::NeoHookean, "neo_hookean"),
            law(SoughtLaw::MooneyRivlin, "mooney_rivlin"),
            law(SoughtLaw::Exponential, "exponential"),
        ];
        let bare = &found.without_geometry;
        let lumped = bare.lumped();
        let named = |name: &str| -> Option<Named> {
            let tables = lumped.tables();
            let (_, parameters) = tables.into_iter().find(|(table, _)| *table == name)?;
            Some(
                parameters
                    .iter()
                    .map(|(key, known)| (*key, Known::of(known)))
                    .collect(),
            )
        };
        let said = [
            ("mean_elastic_modulus", bare.mean_modulus.as_ref().err()),
            ("kelvin", bare.kelvin.as_ref().err()),
            ("blatz", bare.column.as_ref().err()),
            ("nonlinear_springs", bare.springs.as_ref().err()),
        ];
        let said = said
            .into_iter()
            .filter_map(|(key, why)| Some((key, why?.to_string())));
        reasons.extend(said);
        let steps = found.relaxation_of_steps.as_ref().ok();
        let relaxation = found
            .relaxation
            .as_ref()
            .map(|r| RelaxationAnswer::new(r, steps));
        let relaxation = relaxation
            .map_err(|error| reasons.insert("relaxation", error.to_string()))
            .ok();
        Self {
            title: Self::title(header, &studied.files[0]),
            files: studied.files.clone(),
            organ: header.organ.clone(),
            subject: header.subject.clone(),
            site: header.site.clone(),
            mean_elastic_modulus: bare.mean_modulus.as_ref().ok().map(|found| Modulus {
                value: found.value,
                standard_deviation: found.standard_deviation,
                depth_m: found.depth_m,
                holds: found.holds,
            }),
            reason: reasons.get("mean_elastic_modulus").cloned(),
            kelvin: named("kelvin"),
            blatz: named("blatz"),
            nonlinear_springs: named("nonlinear_springs"),
            relaxation,
            neo_hookean,
            mooney_rivlin,
            exponential,
            preferred: found.preferred_law().map(|law| law.name().word()),
            identifiability: found.identifiability.clone(),
            reasons,
        }
    }

    /// What a specimen is called: by its organ and subject, or by its first file.
    pub(super) fn title(header: &RecordingHeader, file: &Path) -> String {
        let named = [&header.organ, &header.subject, &header.site].map(|name| name.as_deref());
        let named: Vec<&str> = named.into_iter().flatten().collect();
        match named.as_slice() {
            [] => file
                .file_stem()
                .map_or_else(String::new, |stem| stem.to_string_lossy().into()),
            named => named.join(", "),
        }
    }
}

impl Known {
    fn of(estimate: &Estimate) -> Self {
        Self {
            value: estimate.value,
            standard_error: estimate.standard_error,
            discretisation_error: None,
        }
    }
}

impl RelaxationAnswer {
    fn new(found: &Relaxation, steps: Option<&Relaxation>) -> Self {
        let column = |place: usize| found.terms.iter().map(move |term| Known::of(&term[place]));
        Self {
            g: column(0).collect(),
            tau_s: column(1).collect(),
            alpha: found
                .product
                .terms
                .iter()
                .map(|(alpha, _)| *alpha)
                .collect(),
            sum_squared_error: found.sum_of_squares,
            shape_exponent: Known::of(&found.exponent),
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
    fn new(law: &LawDescription) -> Self {
        let known = |((name, estimate), off): (&(&'static str, Estimate), &f64)| {
            let known = Known {
                discretisation_error: Some(*off),
                ..Known::of(estimate)
            };
            (*name, known)
        };
        Self {
            parameters: law
                .parameters
                .iter()
                .zip(&law.discretisation)
                .map(known)
                .collect(),
            correlation: law.correlation,
            iterations: law.found.fit.iterations.len() - 1,
            solves: law.found.solves,
            sum_squared_error: law.sum_of_squares,
            misfit: law.misfit,
        }
    }

    fn of_uniaxial(law: &UniaxialFit) -> Self {
        let correlation = law.uncertainty.correlation();
        Self {
            parameters: law
                .parameters
                .iter()
                .map(|(name, known)| (*name, Known::of(known)))
                .collect(),
            correlation: (correlation.ncols() > 1).then(|| correlation[(0, 1)]),
            iterations: law.fit.iterations.len() - 1,
            solves: 0,
            sum_squared_error: law.fit.sum_of_squares(),
            misfit: law.misfit,
        }
    }
}
