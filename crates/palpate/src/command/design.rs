//! `palpate design`: the protocol that determines the parameters best.

use std::path::{Path, PathBuf};

use clap::Args;
use palpate_characterize::design::Criterion;
use palpate_characterize::inverse::CandidateLaw;
use palpate_files::write_atomically;
use palpate_jobs::design::{Answer, Known, PressesAnswer, Request, Within, design};

use super::overwrite::OverwriteOption;
use super::recordings::Recordings;
use crate::failure::Failure;
use crate::interrupt::{self, UninterruptedSection};
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate design liver.toml --out protocol.toml
      from a guess of the tissue; `palpate measure protocol.toml` runs it
  palpate design first.csv --law mooney_rivlin --out protocol.toml
      from a first recording and its noise, at equal depth and time
  palpate design first.csv --parameters tau_1_s,tau_2_s --press-time 20 --radii-mm 1,2,3 --out next.toml
      for relaxation only, within a held breath, with the available indenters
  palpate design liver.toml --depth-mm 4 --force-n 0.5 --total-time 60 --json
      within other limits; prints the expected intervals before and after as JSON

Compares thousands of ramp-and-hold protocols with flat punches by the 95 % intervals that `palpate characterize` is \
expected to find, for the guess and for stiffer, softer, slower and faster tissue.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// A guess, TISSUE.toml, or first recordings of one specimen.
    #[command(flatten)]
    known: Recordings,
    /// Write the protocol, for `palpate measure`.
    #[arg(long, value_name = "PROTOCOL.toml")]
    out: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// The law to fit to recordings, as in `palpate characterize`; default: the preferred law.
    #[arg(long)]
    law: Option<String>,
    /// The parameters to determine, such as c10_pa,tau_1_s; default: those of the law and the relaxation times.
    #[arg(long, value_delimiter = ',')]
    parameters: Vec<String>,
    /// The criterion to optimize.
    #[arg(long, value_enum, default_value = "minimax")]
    criterion: CriterionWord,
    /// The largest depth [mm]; default: the largest recorded depth, or 6.
    #[arg(long, value_name = "MM")]
    depth_mm: Option<f64>,
    /// The largest force [N]; default: 1.5.
    #[arg(long, value_name = "N")]
    force_n: Option<f64>,
    /// Total time of all presses, without pauses [s]; default: as recorded, or 61.5.
    #[arg(long, value_name = "SECONDS")]
    total_time: Option<f64>,
    /// Longest time of one press, such as a held breath [s].
    #[arg(long, value_name = "SECONDS")]
    press_time: Option<f64>,
    /// The fastest ramp [mm/s]; default: 45.
    #[arg(long, value_name = "MM_PER_S")]
    speed_mm_per_s: Option<f64>,
    /// The largest number of presses; default: 3.
    #[arg(long)]
    presses: Option<usize>,
    /// Radii of the available flat punches [mm]; default: 0.5, 1, 2 and 3 times the recorded radius.
    #[arg(long, value_name = "MM", value_delimiter = ',')]
    radii_mm: Vec<f64>,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// A criterion, by its word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum CriterionWord {
    /// Minimize the widest relative interval, over all guesses.
    Minimax,
    /// Minimize the determinant of the covariance.
    DOptimal,
}

/// Designs, writes and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let _claims = arguments.overwrite.claim(arguments.out.iter())?;
    interrupt::ends_between_files("interrupted; no protocol was found");
    let request = arguments.request()?;
    let progress = Progress::of_job(Reader::of_json(arguments.json));
    let found = design(&request, &progress)?;
    drop(progress);
    if let Some(path) = &arguments.out {
        let _unbroken = UninterruptedSection::begin();
        write_atomically(path, found.protocol.as_bytes())?;
    }
    if arguments.json {
        return output::json(&found.answer);
    }
    output::text(table(&found.answer))?;
    if let Some(path) = &arguments.out {
        output::line(format!("written: {}", path.display()))?;
    }
    output::warnings(&found.answer.warnings);
    Ok(())
}

fn table(answer: &Answer) -> String {
    let presses = |own: &PressesAnswer| {
        let depths: Vec<String> = own
            .depths_m
            .iter()
            .map(|depth| format!("{:.2}", 1e3 * depth))
            .collect();
        format!(
            "punch of radius {:.2} mm to {} mm, ramp {:.3} s, hold {:.1} s",
            1e3 * own.indenter_radius_m,
            depths.join(", "),
            own.ramp_s,
            own.hold_s
        )
    };
    let mut text = format!(
        "before    {}\ndesigned  {}\n\nIntervals of 95 %, half over the value:\n",
        presses(&answer.before),
        presses(&answer.designed)
    );
    for line in answer.lines() {
        text += &format!("  {}\n", line.trim_end());
    }
    text
}

impl Arguments {
    fn request(&self) -> Result<Request, Failure> {
        let recordings = self.known.request();
        let law = self
            .law
            .as_deref()
            .map(|name| palpate_jobs::characterize::Choice::law_named(name, None))
            .transpose()?;
        let millimetres = |value: f64| 1e-3 * value;
        let is_toml = |path: &PathBuf| path.extension().is_some_and(|own| own == "toml");
        let known = match recordings.paths.as_slice() {
            [only] if is_toml(only) => self.tissue(only, law)?,
            paths => match paths.iter().find(|path| is_toml(path)) {
                None => Known::Recordings(recordings, law),
                Some(tissue) => {
                    return Err(Failure::input(format!(
                        "{} is a tissue, and there are other files; name one tissue or recordings alone",
                        tissue.display()
                    )));
                }
            },
        };
        Ok(Request {
            known,
            parameters: self.parameters.clone(),
            criterion: match self.criterion {
                CriterionWord::Minimax => Criterion::Minimax,
                CriterionWord::DOptimal => Criterion::Determinant,
            },
            within: Within {
                depth_m: self.depth_mm.map(millimetres),
                force_n: self.force_n,
                time_s: self.total_time,
                press_s: self.press_time,
                speed_m_per_s: self.speed_mm_per_s.map(millimetres),
                presses: self.presses,
                radii_m: self.radii_mm.iter().copied().map(millimetres).collect(),
            },
        })
    }

    /// A guess, which states its own law.
    fn tissue(&self, path: &Path, law: Option<CandidateLaw>) -> Result<Known, Failure> {
        match law {
            None => Ok(Known::Tissue(path.to_owned())),
            Some(law) => Err(Failure::input(format!(
                "--law {} is for recordings, and {} states its law; leave it out",
                law.name().word(),
                path.display()
            ))),
        }
    }
}
