use std::path::PathBuf;

use palpate_characterize::inverse::CandidateLaw;
use palpate_files::text_cell;
use palpate_files::tissue::LawName;

use super::answer::{Answer, Known, Specimen};
use super::folder::{StudyFolder, TABLES};
use crate::Error;

/// Most terms of a relaxation.
const TERMS: usize = 4;

/// Numbers of linear elastic contact that have columns, and of which fit.
const CONTACT: [(&str, &str); 2] = [
    ("linear_elastic", "youngs_modulus_pa"),
    ("adhesion", "work_of_adhesion_j_per_m2"),
];

/// The laws that have columns: the usual ones, and any others that were fitted.
fn laws(answer: &Answer) -> Vec<LawName> {
    let has_column = |law: &LawName| {
        let mut found = answer.specimens.iter();
        CandidateLaw::DEFAULT
            .iter()
            .any(|usual| usual.name() == *law)
            || found.any(|own| own.laws.contains_key(law.word()))
    };
    CandidateLaw::NAMES.into_iter().filter(has_column).collect()
}

/// Writes `summary.csv`, a row for each specimen and for each file that could not be used, and `pooled.csv`.
pub(crate) fn write(answer: &Answer, folder: &StudyFolder) -> Result<(), Error> {
    let [summary, pooled_table] = TABLES;
    let laws = laws(answer);
    folder.write(summary, &table(&columns(&laws), specimens(answer, &laws))?)?;
    let names = [
        "parameter",
        "n",
        "mean",
        "standard_deviation",
        "low_95",
        "high_95",
        "specimens",
        "organ",
        "condition",
    ];
    let pooled = answer.pooled.iter().map(|(name, pooled)| {
        let [low, high] = pooled
            .interval_95
            .map_or([None; 2], |bounds| bounds.map(Some));
        vec![
            name.clone(),
            pooled.n.to_string(),
            pooled.mean.to_string(),
            shown(pooled.standard_deviation),
            shown(low),
            shown(high),
            pooled.specimens.to_string(),
            pooled.organ.clone().unwrap_or_default(),
            pooled.condition.clone().unwrap_or_default(),
        ]
    });
    folder.write(pooled_table, &table(&names.map(str::to_owned), pooled)?)
}

fn specimens(answer: &Answer, laws: &[LawName]) -> impl Iterator<Item = Vec<String>> {
    let unusable = answer.unusable.iter().map(|unusable| {
        let mut row = vec![String::new(); columns(laws).len()];
        row[0] = unusable.file.display().to_string();
        row[4] = row[0].clone();
        if let Some(problem) = row.last_mut() {
            *problem = unusable.reason.to_string();
        }
        row
    });
    let found = answer.specimens.iter().map(|own| row(own, laws));
    found.chain(unusable)
}

fn columns(laws: &[LawName]) -> Vec<String> {
    let mut names: Vec<String> = ["specimen", "organ", "subject", "site", "files"]
        .map(str::to_owned)
        .into();
    let modulus = [
        "mean_elastic_modulus_pa",
        "mean_elastic_modulus_standard_deviation_pa",
    ];
    names.extend(modulus.map(str::to_owned));
    names.push("mean_elastic_modulus_depth_m".to_owned());
    names.extend(CONTACT.map(|(fit, key)| format!("{fit}_{key}")));
    names.extend(["position_x_m", "position_y_m"].map(str::to_owned));
    for term in 1..=TERMS {
        names.extend([
            format!("g_{term}"),
            format!("g_{term}_standard_error"),
            format!("tau_{term}_s"),
            format!("tau_{term}_standard_error_s"),
        ]);
    }
    for own in laws {
        let law = own.word();
        for parameter in own.row().keys() {
            let bare = parameter.trim_end_matches("_pa");
            let unit = &parameter[bare.len()..];
            for of in ["", "_standard_error", "_discretisation_error"] {
                names.push(format!("{law}_{bare}{of}{unit}"));
            }
        }
        names.push(format!("{law}_misfit"));
    }
    names.extend(["preferred", "condition", "warnings", "problem"].map(str::to_owned));
    names
}

/// The values of [`columns`] for a specimen.
fn row(specimen: &Specimen, laws: &[LawName]) -> Vec<String> {
    let named = |name: &Option<String>| name.clone().unwrap_or_default();
    let path = |path: &PathBuf| path.display().to_string();
    let files: Vec<String> = specimen.files.iter().map(path).collect();
    let mut row = vec![
        specimen.title.clone(),
        named(&specimen.organ),
        named(&specimen.subject),
        named(&specimen.site),
        files.join(";"),
    ];
    let modulus = specimen.lumped.mean_elastic_modulus.as_ref();
    row.push(shown(modulus.map(|modulus| modulus.value)));
    row.push(shown(
        modulus.and_then(|modulus| modulus.standard_deviation),
    ));
    row.push(shown(modulus.map(|modulus| modulus.depth_m)));
    row.extend(CONTACT.map(|(fit, key)| {
        let found = match fit {
            "adhesion" => &specimen.lumped.adhesion,
            _ => &specimen.lumped.linear_elastic,
        };
        shown(found.as_ref().and_then(|found| Some(found.get(key)?.value)))
    }));
    let position = specimen.position_m;
    row.extend([0, 1].map(|axis| shown(position.map(|own| own[axis]))));
    let relaxation = specimen.relaxation.as_ref();
    for term in 0..TERMS {
        let of = |known: Option<&Known>| {
            [known.map(|k| k.value), known.and_then(|k| k.standard_error)].map(shown)
        };
        row.extend(of(relaxation.and_then(|found| found.g.get(term))));
        row.extend(of(relaxation.and_then(|found| found.tau_s.get(term))));
    }
    for own in laws {
        let law = specimen.laws.get(own.word());
        for parameter in own.row().keys() {
            let known = law.and_then(|law| law.parameters.get(parameter));
            row.push(shown(known.map(|known| known.value)));
            row.push(shown(known.and_then(|known| known.standard_error)));
            row.push(shown(known.and_then(|known| known.discretisation_error)));
        }
        row.push(shown(law.map(|law| law.misfit)));
    }
    row.push(named(&specimen.preferred));
    row.push(named(&specimen.condition));
    row.push(specimen.warnings.len().to_string());
    row.push(String::new());
    row
}

fn shown(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// A table as a document of this project, in which no text is a formula.
fn table(columns: &[String], rows: impl Iterator<Item = Vec<String>>) -> Result<String, Error> {
    let cannot = |error: csv::Error| {
        Error::failed(format!(
            "a table of the study cannot be written: {error}; please report this"
        ))
    };
    let mut writer = csv::Writer::from_writer(b"# format = 1\n".to_vec());
    writer.write_record(columns).map_err(cannot)?;
    for row in rows {
        let cells = row.iter().map(|cell| text_cell(cell).into_owned());
        writer.write_record(cells).map_err(cannot)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| cannot(error.into_error().into()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
