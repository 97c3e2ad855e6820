use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use palpate_characterize::CleanRecording;
use palpate_characterize::inverse::SoughtLaw;
use palpate_files::recording::RecordingHeader;
use serde::{Deserialize, Serialize};

use super::values::{Known, LawAnswer, Modulus, Named, RelaxationAnswer};
use crate::characterize::finished::Studied;

/// What was found about one specimen.
#[derive(Debug, Serialize, Deserialize)]
pub struct Specimen {
    /// By its organ, subject and site, or by its first file.
    pub title: String,
    /// Its recordings.
    pub files: Vec<PathBuf>,
    /// Its name; none where no file says it.
    pub organ: Option<String>,
    /// As the files say.
    pub subject: Option<String>,
    /// As the files say.
    pub site: Option<String>,
    /// (6.1).
    pub mean_elastic_modulus: Option<Modulus>,
    /// Why it is null.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Prony series.
    pub relaxation: Option<RelaxationAnswer>,
    /// The law.
    pub neo_hookean: Option<LawAnswer>,
    /// The law.
    pub mooney_rivlin: Option<LawAnswer>,
    /// Blatz's law, by inverse finite elements.
    pub exponential: Option<LawAnswer>,
    /// Lumped, (6.3).
    pub kelvin: Option<Named>,
    /// Blatz's law on a column, section 6.3.
    pub blatz: Option<Named>,
    /// Lumped, table 6-2.
    pub nonlinear_springs: Option<Named>,
    /// The law to be preferred, by its name in a tissue file.
    pub preferred: Option<String>,
    /// What can be told apart and what cannot, in plain sentences.
    pub identifiability: Vec<String>,
    /// What deserves doubt, in recordings and in what was found.
    pub warnings: Vec<String>,
    /// Why something is null.
    pub reasons: BTreeMap<String, String>,
}

impl Specimen {
    pub(crate) fn new(studied: &Studied) -> Self {
        let found = &studied.found;
        let header = &studied.recordings[0].header;
        let mut reasons = BTreeMap::new();
        let mut law = |sought: SoughtLaw, key: &str| {
            let pulled = found.uniaxial.iter().find(|(law, _)| *law == sought);
            let pressed = found.laws.iter().find(|(law, _)| *law == sought);
            let answer = match (pulled, pressed) {
                (Some((_, pulled)), _) => pulled.as_ref().map(LawAnswer::of_uniaxial),
                (None, Some((_, pressed))) => pressed.as_ref().map(LawAnswer::new),
                (None, None) => return None,
            };
            answer
                .map_err(|error| reasons.insert(key.to_owned(), error.to_string()))
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
                    .map(|(key, known)| ((*key).to_owned(), Known::of(known)))
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
            .filter_map(|(key, why)| Some((key.to_owned(), why?.to_string())));
        reasons.extend(said);
        let steps = found.relaxation_of_steps.as_ref().ok();
        let relaxation = found
            .relaxation
            .as_ref()
            .map(|r| RelaxationAnswer::new(r, steps));
        let relaxation = relaxation
            .map_err(|error| reasons.insert("relaxation".to_owned(), error.to_string()))
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
            preferred: found
                .preferred_law()
                .map(|law| law.name().word().to_owned()),
            identifiability: found.identifiability.clone(),
            warnings: warnings(studied, reasons.get("neo_hookean")),
            reasons,
        }
    }

    /// The elastic laws that were found, by their keys.
    pub fn laws(&self) -> impl Iterator<Item = (&'static str, &LawAnswer)> {
        let laws = [
            ("neo_hookean", &self.neo_hookean),
            ("mooney_rivlin", &self.mooney_rivlin),
            ("exponential", &self.exponential),
        ];
        laws.into_iter()
            .filter_map(|(key, law)| Some((key, law.as_ref()?)))
    }

    /// What a specimen is called: by its organ and subject, or by its first file.
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

/// What deserves doubt in recordings and in what was found; `no_law` is why there is no law.
fn warnings(studied: &Studied, no_law: Option<&String>) -> Vec<String> {
    let of_file = |(recording, file): (&CleanRecording, &PathBuf)| {
        let doubts = recording.doubts.iter();
        let named = doubts.map(|doubt| format!("{}: {doubt}", file.display()));
        named.collect::<Vec<_>>()
    };
    let recordings = studied.recordings.iter().zip(&studied.files);
    let found = studied
        .found
        .identifiability
        .iter()
        .chain(&studied.found.doubts);
    recordings
        .flat_map(of_file)
        .chain(found.chain(no_law).cloned())
        .collect()
}
