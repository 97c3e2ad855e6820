use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use palpate_characterize::fit::correlated_pairs;
use palpate_characterize::inverse::{CandidateLaw, Correlations};
use palpate_characterize::{Characterization, CleanRecording, WithoutGeometry};
use palpate_files::recording::RecordingHeader;
use palpate_files::tissue::LawName;
use serde::{Deserialize, Serialize};

use super::fit::{FitAnswer, fits};
use super::values::{
    Known, LawAnswer, LumpedAnswer, Named, RelaxationAnswer, adhesion, correlations_of_piece,
    elastic_contact,
};
use super::verdicts::judge_relaxation;
use crate::characterize::finished::Studied;

/// Results for one specimen.
#[derive(Debug, Serialize, Deserialize)]
pub struct Specimen {
    /// By its organ, subject and site, or by its first file.
    pub title: String,
    /// Its recordings.
    #[serde(serialize_with = "crate::lossy")]
    pub files: Vec<PathBuf>,
    /// The organ; none where no file states it.
    pub organ: Option<String>,
    /// As the files state it.
    pub subject: Option<String>,
    /// As the files state it.
    pub site: Option<String>,
    /// As the files state it.
    pub condition: Option<String>,
    /// The indented location on its surface [m]; none where no file states it.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub position_m: Option<[f64; 3]>,
    /// Prony series.
    pub relaxation: Option<RelaxationAnswer>,
    /// The fitted laws, by their names in a tissue file.
    pub laws: BTreeMap<String, LawAnswer>,
    /// How they were fitted, by the same names.
    pub fits: BTreeMap<String, FitAnswer>,
    /// Parameters of models without geometry.
    pub lumped: LumpedAnswer,
    /// The preferred law: a key of `laws`.
    pub preferred: Option<String>,
    /// Which parameters the recordings can and cannot identify, in plain sentences.
    pub identifiability: Vec<String>,
    /// Warnings about the recordings and the results.
    pub warnings: Vec<String>,
    /// Why a result is missing, by its key in `laws` or `lumped`, or `relaxation`.
    pub reasons: BTreeMap<String, String>,
}

impl Specimen {
    pub(crate) fn new(studied: &Studied) -> Self {
        let found = &studied.found;
        let header = &studied.recordings[0].header;
        let mut reasons = BTreeMap::new();
        let laws = laws(found, &mut reasons);
        let steps = found.relaxation_of_steps.as_ref().ok();
        let relaxation = found.relaxation.as_ref().map(|of| {
            let mut answer = RelaxationAnswer::new(of, steps);
            judge_relaxation(
                &mut answer,
                &correlations(found).unwrap_or_else(|| of.correlations()),
            );
            answer
        });
        let relaxation = relaxation
            .map_err(|error| reasons.insert("relaxation".to_owned(), error.to_string()))
            .ok();
        Self {
            title: Self::title(header, &studied.files[0]),
            files: studied.files.clone(),
            organ: header.organ.clone(),
            subject: header.subject.clone(),
            site: header.site.clone(),
            condition: header.condition.map(|own| own.word().to_owned()),
            position_m: header.position_m,
            lumped: lumped(&found.without_geometry, &mut reasons),
            relaxation,
            laws,
            fits: fits(found),
            preferred: found
                .preferred_law()
                .map(|law| law.name().word().to_owned()),
            identifiability: identifiability(found),
            warnings: warnings(studied, reasons.get("neo_hookean")),
            reasons,
        }
    }

    /// The fitted elastic laws, by their keys, the simplest first.
    pub fn laws(&self) -> impl Iterator<Item = (&'static str, &LawAnswer)> {
        let laws = CandidateLaw::NAMES.into_iter().map(LawName::word);
        laws.filter_map(|name| Some((name, self.laws.get(name)?)))
    }

    /// The preferred law, by its key.
    pub fn preferred(&self) -> Option<(&str, &LawAnswer)> {
        let name = self.preferred.as_deref()?;
        Some((name, self.laws.get(name)?))
    }

    /// The title of a specimen: its organ and subject, or its first file.
    pub(crate) fn title(header: &RecordingHeader, file: &Path) -> String {
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

/// The fitted laws; the reasons for missing ones go to `reasons`.
fn laws(
    found: &Characterization,
    reasons: &mut BTreeMap<String, String>,
) -> BTreeMap<String, LawAnswer> {
    let pulled = found.uniaxial.iter().map(|(law, pulled)| {
        let answer = pulled.as_ref().map(LawAnswer::of_uniaxial);
        (law, answer)
    });
    let pressed = found.laws.iter().map(|(law, pressed)| {
        let answer = pressed.as_ref().map(LawAnswer::new);
        (law, answer)
    });
    let mut laws = BTreeMap::new();
    for (law, answer) in pulled.chain(pressed) {
        let name = law.name().word().to_owned();
        match answer {
            Ok(answer) => drop(laws.insert(name, answer)),
            Err(why) => drop(reasons.insert(name, why.to_string())),
        }
    }
    laws
}

/// Models without geometry; the reasons for missing ones go to `reasons`.
fn lumped(bare: &WithoutGeometry, reasons: &mut BTreeMap<String, String>) -> LumpedAnswer {
    let tables = bare.lumped();
    let tables = tables.tables();
    let named = |name: &str| -> Option<Named> {
        let (_, parameters) = tables.iter().find(|(table, _)| *table == name)?;
        let each = parameters.iter();
        Some(
            each.map(|(key, known)| ((*key).to_owned(), Known::of(known)))
                .collect(),
        )
    };
    let why = [
        ("mean_elastic_modulus", bare.mean_modulus.as_ref().err()),
        ("linear_elastic", bare.linear_elastic.as_ref().err()),
        ("adhesion", bare.adhesion.as_ref().err()),
        ("kelvin", bare.kelvin.as_ref().err()),
        ("column", bare.column.as_ref().err()),
        ("nonlinear_springs", bare.springs.as_ref().err()),
    ];
    let why = why
        .into_iter()
        .filter_map(|(key, why)| Some((key.to_owned(), why?.to_string())));
    reasons.extend(why);
    LumpedAnswer {
        mean_elastic_modulus: bare.mean_modulus.as_ref().ok().copied(),
        linear_elastic: bare.linear_elastic.as_ref().ok().map(elastic_contact),
        adhesion: bare.adhesion.as_ref().ok().map(adhesion),
        kelvin: named("kelvin"),
        column: named("column"),
        nonlinear_springs: named("nonlinear_springs"),
    }
}

/// Correlations of the errors of the preferred law and of the relaxation; none without a law.
fn correlations(found: &Characterization) -> Option<Correlations> {
    let preferred = found.preferred_law()?;
    let pressed = found.laws.iter().find(|(law, _)| *law == preferred);
    let pulled = found.uniaxial.iter().find(|(law, _)| *law == preferred);
    let pressed = pressed.and_then(|(_, law)| Some(law.as_ref().ok()?.correlations()));
    pressed.or_else(|| Some(correlations_of_piece(pulled?.1.as_ref().ok()?)))
}

/// Warnings of the fits, and which parameters of the preferred law and the relaxation are identified only in
/// combination.
fn identifiability(found: &Characterization) -> Vec<String> {
    let relaxation = || Some(found.relaxation.as_ref().ok()?.correlations());
    let own = correlations(found).or_else(relaxation);
    let pairs = own.map(|own| correlated_pairs(&own.names, &own.matrix));
    let law = found.preferred_law();
    // The parameters of the law come first.
    let count = law.map_or(0, CandidateLaw::count);
    let named = |(places, pair): ([usize; 2], String)| match law {
        Some(law) if places.iter().any(|place| *place < count) => {
            format!("{}: {pair}", law.name().word())
        }
        _ => pair,
    };
    let pairs = pairs.into_iter().flatten().map(named);
    found.identifiability.iter().cloned().chain(pairs).collect()
}

/// Warnings about recordings and results; `no_law` is why there is no law.
fn warnings(studied: &Studied, no_law: Option<&String>) -> Vec<String> {
    let of_file = |(recording, file): (&CleanRecording, &PathBuf)| {
        let warnings = recording.warnings.iter();
        let named = warnings.map(|warning| format!("{}: {warning}", file.display()));
        named.collect::<Vec<_>>()
    };
    let recordings = studied.recordings.iter().zip(&studied.files);
    let found = studied
        .found
        .identifiability
        .iter()
        .chain(&studied.found.warnings);
    recordings
        .flat_map(of_file)
        .chain(found.chain(no_law).cloned())
        .collect()
}
