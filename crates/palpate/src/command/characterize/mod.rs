//! `palpate characterize`: the tissue behind recordings, with how well it is known.

mod answer;
mod pooled;
mod table;

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use clap::Args;
use palpate_characterize::inverse::SoughtLaw;
use palpate_characterize::viscoelastic::RelaxationSettings;
use palpate_characterize::{
    Characterization, CharacterizeSettings, CleanRecording, characterize, specimens,
};
use palpate_files::{Tissue, check_writable, write_whole};

use self::answer::{Answer, Specimen};
use super::recordings::{ReadRecording, Recordings, Unusable};
use crate::failure::Failure;
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate characterize liver-2mm.csv liver-4mm.csv --out liver.toml
      one tissue from two depths, for a scene or `palpate solve`
  palpate characterize recordings/ --json > parameters.json
      every specimen of a folder; one bad file does not stop the others
  palpate characterize meat.csv --set indenter_radius_m=0.004 --set indenter_shape=sphere
      what a file does not say itself
  palpate characterize liver.csv --law neo_hookean --abaqus liver.inp --febio liver.feb
      material cards for finite element packages

Recordings that name the same organ, subject, site and indenter are one specimen and are fitted
together. Tables of other programs are read by the names of their columns, or as --time, --depth
and --force say. All moduli are instantaneous; g is relative to them:
G(t) = G0 (1 - sum g (1 - exp(-t/tau))).";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    recordings: Recordings,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Write the tissue of the only specimen, for scenes and problems.
    #[arg(long, value_name = "TISSUE.toml")]
    out: Option<PathBuf>,
    /// Write its material card for Abaqus (and CalculiX, without relaxation).
    #[arg(long, value_name = "FILE.inp")]
    abaqus: Option<PathBuf>,
    /// Write its material card for FEBio.
    #[arg(long, value_name = "FILE.feb")]
    febio: Option<PathBuf>,
    /// The law to be written; by default the simplest that no other beats.
    #[arg(long, value_enum)]
    law: Option<Law>,
    /// Terms of the relaxation, 1 to 4; by default as many as the recordings can tell.
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=4))]
    terms: Option<u64>,
}

/// A law, by the words of a tissue file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
enum Law {
    NeoHookean,
    MooneyRivlin,
    Blatz,
}

impl From<Law> for SoughtLaw {
    fn from(law: Law) -> Self {
        match law {
            Law::NeoHookean => Self::NeoHookean,
            Law::MooneyRivlin => Self::MooneyRivlin,
            Law::Blatz => Self::Exponential,
        }
    }
}

/// One specimen with its recordings.
pub(super) struct Studied {
    pub(super) files: Vec<PathBuf>,
    pub(super) recordings: Vec<CleanRecording>,
    pub(super) found: Characterization,
}

/// Characterizes, writes and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    for file in arguments.files() {
        check_writable(file)?;
    }
    let progress = Progress::new(Reader::of_json(arguments.json), None);
    let reading = |path: &std::path::Path| progress.say(format!("reading {}", path.display()));
    let (recordings, unusable) = arguments.recordings.read(reading)?;
    drop(progress);
    let studied = study(arguments, recordings);
    arguments.write(&studied)?;
    let answer = Answer::new(&studied, &unusable);
    if arguments.json {
        return output::json(&answer);
    }
    output::text(table::of(&studied, &answer))?;
    for path in arguments.files() {
        output::text(format!("written: {}", path.display()))?;
    }
    output::warnings(&answer.warnings);
    output::warnings(&unusable.iter().map(Unusable::sentence).collect::<Vec<_>>());
    Ok(())
}

/// Every specimen, as many at once as there are cores.
fn study(arguments: &Arguments, recordings: Vec<ReadRecording>) -> Vec<Studied> {
    let headers: Vec<_> = recordings.iter().map(|read| &read.clean.header).collect();
    let groups = specimens(&headers);
    let progress = Progress::new(Reader::of_json(arguments.json), Some(groups.len() as u64));
    let settings = arguments.settings();
    let next = AtomicUsize::new(0);
    let found = Mutex::new(Vec::with_capacity(groups.len()));
    let work = || {
        while let Some(group) = groups.get(next.fetch_add(1, Ordering::Relaxed)) {
            let of_group = || group.iter().map(|&place| &recordings[place]);
            let clean: Vec<_> = of_group().map(|read| read.clean.clone()).collect();
            let name = Specimen::title(&clean[0].header, &recordings[group[0]].path);
            let say = |doing: &str| progress.say(format!("{name}: {doing}"));
            let found_here = characterize(&clean, &settings, &mut |doing| say(doing));
            let studied = Studied {
                files: of_group().map(|read| read.path.clone()).collect(),
                recordings: clean,
                found: found_here,
            };
            progress.step();
            if let Ok(mut found) = found.lock() {
                found.push((group[0], studied));
            }
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..cores.min(groups.len()) {
            scope.spawn(work);
        }
    });
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|(place, _)| *place);
    found.into_iter().map(|(_, studied)| studied).collect()
}

impl Arguments {
    fn settings(&self) -> CharacterizeSettings {
        CharacterizeSettings {
            relaxation: RelaxationSettings {
                terms: self.terms.map(|terms| terms as usize),
            },
            ..CharacterizeSettings::default()
        }
    }

    /// What is to be written.
    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.out, &self.abaqus, &self.febio].into_iter().flatten()
    }

    fn write(&self, studied: &[Studied]) -> Result<(), Failure> {
        if self.files().next().is_none() {
            return Ok(());
        }
        let [only] = studied else {
            return Err(Failure::input(format!(
                "there are {} specimens, and a tissue is of one; name the recordings of one, or leave out --out, --abaqus and --febio",
                studied.len()
            )));
        };
        let tissue = only.tissue(self.law.map(SoughtLaw::from))?;
        if let Some(path) = &self.out {
            tissue.write(path)?;
        }
        let card = |card: Result<String, palpate_files::card::NoCard>, path: &PathBuf| {
            let text = card.map_err(Failure::input)?;
            write_whole(path, text.as_bytes()).map_err(Failure::from)
        };
        if let Some(path) = &self.abaqus {
            card(tissue.to_abaqus(), path)?;
        }
        if let Some(path) = &self.febio {
            card(tissue.to_febio(), path)?;
        }
        Ok(())
    }
}

impl Studied {
    /// The tissue of one law, or of the one that is to be preferred.
    fn tissue(&self, law: Option<SoughtLaw>) -> Result<Tissue, Failure> {
        let named: Vec<String> = self
            .files
            .iter()
            .map(|path| path.display().to_string())
            .collect();
        let version = format!("palpate {}", output::VERSION);
        let mut tissue = self.found.tissue(law).map_err(Failure::input)?;
        tissue.name.clone_from(&self.recordings[0].header.organ);
        let of_recordings = self
            .recordings
            .iter()
            .flat_map(|recording| &recording.doubts);
        tissue.source.warnings.extend(of_recordings.cloned());
        tissue.source.recordings = named;
        tissue.source.version = Some(version);
        Ok(tissue)
    }
}
