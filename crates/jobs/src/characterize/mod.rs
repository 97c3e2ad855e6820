//! Fits the tissue of each specimen to its recordings, with the uncertainty of every parameter.

mod answer;
mod evaluation;
mod finished;
mod fit_plots;
mod folder;
mod pooled;
mod study;
mod summary;

use std::path::PathBuf;

use palpate_characterize::CharacterizeSettings;
use palpate_characterize::fit::Draws;
use palpate_characterize::inverse::{CandidateLaw, MIN_DRAWS, Terms};
use palpate_characterize::viscoelastic::RelaxationSettings;
use palpate_files::tissue::LawName;

pub use answer::{
    Answer, CovarianceAnswer, ElasticAnswer, FitAnswer, Identified, Known, LawAnswer, LumpedAnswer,
    Named, Noise, Partner, RelaxationAnswer, Specimen, Steps, Tried,
};
pub use evaluation::FoundLaw;
pub use fit_plots::{
    DrawnCurve, DrawnFit, DrawnLaw, DrawnRecording, DrawnRelaxation, DrawnSeries, FitPlots, LEVEL,
};
pub use folder::StudyFolder;
pub use pooled::Pooled;

use crate::{Error, ProgressCallback, Recordings, Unusable, nearest};

/// Options of a characterization, named as in the command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// The only law to fit; none: those of [`CandidateLaw::DEFAULT`].
    pub law: Option<CandidateLaw>,
    /// Terms of the relaxation; none: as many as the recordings can resolve.
    pub terms: Option<usize>,
    /// Bootstrap samples for the uncertainty of parameters: 0 for none, otherwise [`MIN_DRAWS`] or more.
    pub draws: usize,
    /// The seed of the bootstrap.
    pub seed: u64,
    /// Whether full viscoelastic runs of finite elements are solved in the loop of the fit, of one specimen and one law.
    pub in_loop: bool,
    /// Whether only linear elastic contact and adhesion are fitted, in closed form, as for a map of many curves.
    pub closed_forms: bool,
}

impl Default for Choice {
    fn default() -> Self {
        Self {
            law: None,
            terms: None,
            draws: 100,
            seed: 1,
            in_loop: false,
            closed_forms: false,
        }
    }
}

impl Choice {
    /// The law of a name in files, and of this order where it is one of a series: by default 1 of `ogden` and 2 of
    /// `reduced_polynomial`.
    ///
    /// # Errors
    /// When there is no such law, or not of this order.
    pub fn law_named(name: &str, order: Option<usize>) -> Result<CandidateLaw, Error> {
        let law = LawName::from_word(name).and_then(CandidateLaw::of_name);
        let law = law.ok_or_else(|| {
            let names = CandidateLaw::NAMES.map(LawName::word);
            let meant = nearest(name, &names);
            Error::input(format!(
                "there is no law `{name}` to seek; name one of {}, such as {meant}",
                names.join(", ")
            ))
        })?;
        let Some(order) = order else {
            return Ok(law);
        };
        let terms = Terms::of(order).ok_or_else(|| {
            Error::input(format!("the order of the law is {order}; give 1, 2 or 3"))
        })?;
        law.with_terms(terms).ok_or_else(|| {
            Error::input(format!(
                "the law `{name}` has no order; leave it out, or seek `ogden` or `reduced_polynomial`"
            ))
        })
    }

    /// Refuses fewer draws than a spread needs.
    fn check(self) -> Result<(), Error> {
        if (1..MIN_DRAWS).contains(&self.draws) {
            return Err(Error::input(format!(
                "{} draws are too few for a spread; ask for {MIN_DRAWS} or more, or for 0 to repeat no fit",
                self.draws
            )));
        }
        Ok(())
    }

    /// Refuses finite elements in the loop of more than one fit.
    fn check_loop(self, specimens: usize) -> Result<(), Error> {
        if self.in_loop && self.law.is_none() {
            return Err(Error::input(
                "finite elements in the loop need one law; name it, such as neo_hookean",
            ));
        }
        if self.in_loop && specimens > 1 {
            return Err(Error::input(format!(
                "finite elements in the loop need one specimen, and there are {specimens}; name the recordings of one"
            )));
        }
        Ok(())
    }

    fn settings(self) -> CharacterizeSettings {
        let all = CharacterizeSettings::default();
        CharacterizeSettings {
            relaxation: RelaxationSettings { terms: self.terms },
            draws: (self.draws > 0).then_some(Draws {
                count: self.draws,
                seed: self.seed,
            }),
            laws: self.law.map_or(all.laws, |law| vec![law]),
            in_loop: self.in_loop,
            closed_forms: self.closed_forms,
        }
    }
}

/// Characterized specimens.
#[derive(Debug)]
pub struct Characterized {
    /// The answer that `--json` prints.
    pub answer: Answer,
    /// Plot data of each specimen.
    pub portraits: Vec<FitPlots>,
    /// The fit of each recording of each specimen, with its file: at every sample, or for a study at the samples
    /// stored in its folder.
    pub samples: Vec<Vec<(String, DrawnFit)>>,
    /// The text of the tissue file of each specimen, or why there is none.
    pub tissues: Vec<Result<String, Error>>,
}

/// The usable specimens among `recordings`, each with its title and recordings, and the recordings that cannot be
/// used.
///
/// # Errors
/// When no recording can be used.
pub fn specimens(recordings: &Recordings) -> Result<(Vec<NamedSpecimen>, Vec<Unusable>), Error> {
    let (read, unusable) = recordings.read(|_| ())?;
    let headers: Vec<_> = read.iter().map(|read| &read.clean.header).collect();
    let groups = palpate_characterize::specimens(&headers);
    let named = groups.into_iter().map(|group| {
        let first = &read[group[0]];
        let files = group.iter().map(|place| read[*place].path.clone());
        (
            Specimen::title(&first.clean.header, &first.path),
            files.collect(),
        )
    });
    Ok((named.collect(), unusable))
}

/// The title of a specimen, and its recordings.
pub type NamedSpecimen = (String, Vec<PathBuf>);

/// Characterizes every specimen of `recordings`, on all cores, and returns them in their order. Reads stored results
/// from `folder` and writes each new result there at once, then the tables.
///
/// # Errors
/// When no recording can be used, or a file cannot be written.
pub fn characterize(
    recordings: &Recordings,
    choice: Choice,
    folder: Option<&StudyFolder>,
    watch: &dyn ProgressCallback,
) -> Result<Characterized, Error> {
    choice.check()?;
    let (read, unusable) =
        recordings.read(|path| watch.report_step(&format!("reading {}", path.display())))?;
    let headers: Vec<_> = read.iter().map(|read| &read.clean.header).collect();
    choice.check_loop(palpate_characterize::specimens(&headers).len())?;
    let finished = study::of(read, &choice.settings(), folder, watch)?;
    let (mut specimens, mut portraits) = (Vec::new(), Vec::new());
    let (mut tissues, mut samples) = (Vec::new(), Vec::new());
    for mut finished in finished {
        samples.push(match folder {
            Some(_) => finished.portrait.fitted(),
            None => std::mem::take(&mut finished.samples),
        });
        tissues.push(finished.tissue());
        specimens.push(finished.specimen);
        portraits.push(finished.portrait);
    }
    let answer = Answer::new(specimens, unusable);
    if let Some(folder) = folder {
        summary::write(&answer, folder)?;
    }
    Ok(Characterized {
        answer,
        portraits,
        samples,
        tissues,
    })
}
