//! `palpate characterize`: fits the tissue of recordings, with the uncertainty of every parameter.

mod report;
mod table;
mod warnings;

use std::path::PathBuf;

use clap::Args;
use palpate_files::tissue::LawName;
use palpate_files::{Tissue, write_atomically};
use palpate_jobs::Error;
use palpate_jobs::characterize::{Choice, StudyFolder, characterize};

use super::overwrite::OverwriteOption;
use super::recordings::Recordings;
use crate::failure::Failure;
use crate::interrupt::{self, UninterruptedSection};
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate characterize liver-2mm.csv liver-4mm.csv --out liver.toml
      fits one tissue to two depths, for a scene or `palpate solve`
  palpate characterize recordings/ --json > parameters.json
      every specimen of a folder; one bad file does not stop the others
  palpate characterize recordings/ --study livers/
      the same, saved: livers/summary.csv, pooled.csv and a tissue for each specimen. The same
      command resumes an interrupted study; with --overwrite it refits changed specimens
  palpate characterize recordings/ --report livers.html
      writes an HTML report with plots
  palpate characterize meat.csv --set indenter_radius_m=0.004 --set indenter_shape=sphere
      states what the file does not
  palpate characterize map.jpk-force-map --set indenter_shape=sphere --set indenter_radius_m=5e-6 --closed-forms --report map.html
      Young's modulus at each place of a map, with a picture
  palpate characterize liver.csv --law neo_hookean --abaqus liver.inp --febio liver.feb
      material cards for finite element packages
  palpate characterize strip-0.csv strip-45.csv strip-90.csv --out muscle.toml --febio muscle.feb
      one law with fibres for strips that are cut at several angles to them
  palpate characterize liver.csv --law neo_hookean --in-loop
      with full viscoelastic finite elements inside the fit, for deep and fast presses

Recordings with the same organ, subject, site and indenter are one specimen and are fitted together. Columns of other \
programs' tables are found by their names, or given by --time, --depth and --force. All moduli are instantaneous; g \
is relative to them:
G(t) = G0 (1 - sum g (1 - exp(-t/tau))).";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    recordings: Recordings,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Save each finished specimen and summary tables in this folder; an interrupted study resumes.
    #[arg(long, value_name = "FOLDER")]
    study: Option<PathBuf>,
    /// Write the tissue of a single specimen, for scenes and problems.
    #[arg(long, value_name = "TISSUE.toml")]
    out: Option<PathBuf>,
    /// Write its material card for Abaqus (and CalculiX, without relaxation).
    #[arg(long, value_name = "FILE.inp")]
    abaqus: Option<PathBuf>,
    /// Write its material card for FEBio.
    #[arg(long, value_name = "FILE.feb")]
    febio: Option<PathBuf>,
    /// Write an HTML report with plots of all results.
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Fit this law only; default: the first three, and of pieces that state `fibre_axis_angle_deg` also the last, which has
    /// fibres, of which the simplest that no other beats is preferred.
    #[arg(long, value_enum)]
    law: Option<Law>,
    /// Number of terms of `ogden` (default 1: mu and alpha) or `reduced_polynomial` (default 2: C10 and C20; 3 is Yeoh's
    /// law).
    #[arg(long, value_name = "TERMS", requires = "law", value_parser = clap::value_parser!(u64).range(1..=3))]
    order: Option<u64>,
    /// Run full viscoelastic finite elements inside the fit, for one specimen and one law: takes seconds per run, and
    /// corrects the error of the product of elastic force and G(t).
    #[arg(long, requires = "law")]
    in_loop: bool,
    /// Fit linear elastic contact and adhesion alone, in closed form: no laws, no relaxation, no finite elements. For
    /// maps of many curves; a report shows a map of the moduli.
    #[arg(long, conflicts_with_all = ["law", "in_loop", "terms", "out", "abaqus", "febio"])]
    closed_forms: bool,
    /// Bootstrap samples (block-resampled residuals) for the uncertainty of parameters; 0 for none, otherwise at least
    /// 10.
    #[arg(long, value_name = "TIMES", default_value_t = 100, value_parser = clap::value_parser!(u64).range(..=10_000))]
    draws: u64,
    /// Number of relaxation terms, 1 to 4; default: as many as the recordings can resolve.
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=4))]
    terms: Option<u64>,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// A law, by the words of a tissue file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
enum Law {
    NeoHookean,
    MooneyRivlin,
    #[value(alias = "blatz")]
    Exponential,
    Ogden,
    ReducedPolynomial,
    HolzapfelGasserOgden,
}

impl From<Law> for LawName {
    fn from(law: Law) -> Self {
        match law {
            Law::NeoHookean => Self::NeoHookean,
            Law::MooneyRivlin => Self::MooneyRivlin,
            Law::Exponential => Self::Exponential,
            Law::Ogden => Self::Ogden,
            Law::ReducedPolynomial => Self::ReducedPolynomial,
            Law::HolzapfelGasserOgden => Self::HolzapfelGasserOgden,
        }
    }
}

/// Characterizes, writes and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let files = arguments.files().chain(&arguments.report);
    let _claims = arguments.overwrite.claim(files)?;
    let open = |path| StudyFolder::open(path, arguments.overwrite.rule());
    let folder = arguments.study.as_deref().map(open).transpose()?;
    interrupt::ends_between_files(match &arguments.study {
        None => "interrupted; nothing was found".to_owned(),
        Some(folder) => format!(
            "stopped; finished specimens are in {}; the same command continues",
            folder.display()
        ),
    });
    let recordings = arguments.recordings.request();
    let progress = Progress::of_job(Reader::of_json(arguments.json));
    let found = characterize(&recordings, arguments.choice()?, folder.as_ref(), &progress)?;
    let answer = found.answer;
    let warnings = progress.unprinted(warnings::for_people(&answer));
    let unbroken = UninterruptedSection::begin();
    arguments.write(found.tissues)?;
    if let Some(path) = &arguments.report {
        let page = report::html(&answer, &found.portraits, &arguments.settings());
        write_atomically(path, page.as_bytes())?;
    }
    drop(unbroken);
    if arguments.json {
        return output::json(&answer);
    }
    output::text(table::of(&answer))?;
    let written = [&arguments.study, &arguments.report].into_iter().flatten();
    for path in arguments.files().chain(written) {
        output::line(format!("written: {}", path.display()))?;
    }
    output::warnings(&warnings);
    Ok(())
}

impl Arguments {
    fn choice(&self) -> Result<Choice, Error> {
        let order = self.order.map(|order| order as usize);
        let law = self.law.map(LawName::from);
        let law = law.map(|law| Choice::law_named(law.word(), order));
        Ok(Choice {
            law: law.transpose()?,
            terms: self.terms.map(|terms| terms as usize),
            draws: self.draws as usize,
            in_loop: self.in_loop,
            closed_forms: self.closed_forms,
            ..Choice::default()
        })
    }

    /// The options of the command, by name and value.
    fn settings(&self) -> Vec<(String, String)> {
        let mut settings = Vec::new();
        let mut add = |name: &str, value: String| settings.push((name.to_owned(), value));
        if let Some(law) = self.law {
            add("--law", LawName::from(law).word().to_owned());
        }
        if let Some(order) = self.order {
            add("--order", order.to_string());
        }
        if let Some(terms) = self.terms {
            add("--terms", terms.to_string());
        }
        if self.in_loop {
            add("--in-loop", String::new());
        }
        if self.closed_forms {
            add("--closed-forms", String::new());
        }
        add("--draws", self.draws.to_string());
        settings.extend(self.recordings.request().options());
        settings
    }

    /// The files to write for a single specimen.
    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.out, &self.abaqus, &self.febio].into_iter().flatten()
    }

    fn write(&self, tissues: Vec<Result<String, Error>>) -> Result<(), Failure> {
        if self.files().next().is_none() {
            return Ok(());
        }
        let [only] = <[_; 1]>::try_from(tissues).map_err(|several| {
            Failure::input(format!(
                "there are {} specimens, and a tissue is of one; name the recordings of one, or use --study for a tissue of each",
                several.len()
            ))
        })?;
        let text = only?;
        if let Some(path) = &self.out {
            write_atomically(path, text.as_bytes())?;
        }
        let card = |to_card: fn(&Tissue) -> Result<String, palpate_files::card::NoCard>,
                    path: &PathBuf| {
            let tissue = Tissue::parse(&text, path)?;
            let card = to_card(&tissue)?;
            write_atomically(path, card.as_bytes()).map_err(Failure::from)
        };
        if let Some(path) = &self.abaqus {
            card(Tissue::to_abaqus, path)?;
        }
        if let Some(path) = &self.febio {
            card(Tissue::to_febio, path)?;
        }
        Ok(())
    }
}
