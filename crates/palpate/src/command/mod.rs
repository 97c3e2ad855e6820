//! The command line: one file per command.

mod analyze;
pub(crate) mod cache;
mod characterize;
mod demonstration;
mod design;
mod devices;
mod examples;
mod measure;
mod mesh;
mod overwrite;
mod precompute;
pub(crate) mod progress;
mod quality;
mod recordings;
mod replay;
mod reproduce;
mod scene;
mod score;
mod shell;
mod simulate;
mod solve;
mod teacher;
mod validate;
mod window;

use clap::{Parser, Subcommand, ValueEnum};
use palpate_files::Language;

use crate::failure::Failure;
use crate::output;

/// The licences of what this program is built of; `.ci/notices` writes them.
const NOTICES: &str = include_str!("../../../../THIRD-PARTY.txt");

/// Examples at the end of `palpate --help`.
const EXAMPLES: &str = "\
Examples:
  palpate
      opens a window with tasks to practise and organs to touch; without a display it plays a
      demonstration and writes ./palpate-demo
  palpate simulate scene.toml
      opens a window with your scene
  palpate simulate scene.toml --headless --motion motion.csv --out session
      plays the tool motions on the scene and writes session/session.csv
  palpate score session --expert expert
      measures the session: time, path lengths, forces and errors, compared with an expert's
  palpate replay session
      replays the session, from any angle
  palpate precompute scene.toml
      prepares the hybrid model of the whole organ once; afterwards the scene opens immediately
  palpate solve problem.toml --plot force.png
      forces under an indenter, the inflation of a tube and more, by finite elements
  palpate measure
      opens the rig's window with a virtual specimen; with --headless --out recordings it runs a
      protocol without a window
  palpate characterize liver-2mm.csv liver-4mm.csv --out liver.toml
      finds the material parameters behind recordings, with their uncertainty
  palpate design liver-2mm.csv --out protocol.toml
      designs the protocol that determines these parameters best
  palpate progress --report progress.html
      learning curves of all trainees, compared with the experts
  palpate quality
      servo jitter, missed ticks and force errors at 1 to 4 kHz on this machine
  palpate devices
      lists the connected haptic devices
  palpate mesh info kidney.stl --unit mm
      checks a mesh and reports whether it can be simulated
  palpate mesh isosurface segmentation.nii.gz --label liver --out liver.ply
      extracts an organ's surface from a segmented volume
  palpate reproduce table-3-1
      compares a published table with our results
  palpate examples .
      writes example scenes, motions, tasks, problems and a recording
  palpate scene --template --out scene.toml
      writes a scene with every key explained
  palpate validate scene.toml
      identifies a file and checks it

Every command has its own --help. With --json a command prints one machine-readable document on standard output. No \
command replaces an existing file without --overwrite. Exit status: 0 success, 2 invalid input, 1 any other \
failure.";

/// Soft-tissue touch, from the first indentation to the trained hand.
///
/// Without a command it opens a window; without a display it runs a demonstration.
#[derive(Debug, Parser)]
#[command(name = "palpate", version, long_version = output::LONG_VERSION, after_help = EXAMPLES, disable_help_subcommand = true)]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct CommandLine {
    /// Print the licences of the libraries and fonts that this program contains.
    #[arg(long)]
    notices: bool,
    /// The language of the window, instead of that of its settings.
    #[arg(long, value_enum)]
    language: Option<Speech>,
    #[command(subcommand)]
    command: Option<Command>,
}

/// A language of the window.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Speech {
    /// English
    En,
    /// German
    De,
    /// French
    Fr,
}

impl Speech {
    fn language(self) -> Language {
        match self {
            Self::En => Language::English,
            Self::De => Language::German,
            Self::Fr => Language::French,
        }
    }
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Touch an organ in a window, or play back tool motions and record the forces on the hand.
    Simulate(simulate::Arguments),
    /// Run the slow preparation of a scene's global model once, so that it runs at haptic rates.
    Precompute(precompute::Arguments),
    /// Solve a problem with finite elements: the reference for all other models.
    Solve(solve::Arguments),
    /// Press an indenter into specimens, in a window or by a protocol, and record depth and force.
    Measure(measure::Arguments),
    /// Analyze recordings without a material model: static force, relaxation, response to sines and chirps.
    Analyze(analyze::Arguments),
    /// Replay a session in a window, from any angle, or write pictures of it.
    Replay(replay::Arguments),
    /// Score a session: time, path lengths, forces, errors and the task, compared with an expert's.
    Score(score::Arguments),
    /// Fit material laws and relaxation to recordings, with the uncertainty of every parameter.
    Characterize(characterize::Arguments),
    /// Design the protocol that determines the parameters of a tissue best.
    Design(design::Arguments),
    /// Show trainees' progress: attempts, learning curves, and who reaches the experts' level.
    Progress(progress::Arguments),
    /// Manage cohorts, assignments and experts.
    Teacher(teacher::Arguments),
    /// Recompute the tables and figures of the source and compare them with the published values.
    Reproduce(reproduce::Arguments),
    /// Measure the quality of haptic rendering on this machine: jitter, missed ticks, force errors.
    Quality(quality::Arguments),
    /// List connected haptic devices with their limits, and test them.
    Devices(devices::Arguments),
    /// Check, simplify, convert and wrap meshes, and extract them from segmented volumes.
    #[command(subcommand)]
    Mesh(mesh::Mesh),
    /// Write a template, JSON Schema or reference of a document, with every key explained.
    Scene(scene::Arguments),
    /// Identify files and check them.
    Validate(validate::Arguments),
    /// Write the example files of the documentation to a folder.
    Examples(examples::Arguments),
    /// Show or clear the cache of prepared organs and specimens.
    Cache(cache::Arguments),
    /// Print a shell completion script.
    Completions(shell::Completions),
    /// Write manual pages to a folder.
    Manual(shell::Manual),
}

impl CommandLine {
    /// Does what the line says.
    pub(crate) fn run(self) -> Result<(), Failure> {
        match self.command {
            None if self.notices => output::text(NOTICES),
            None => demonstration::run(self.language.map(Speech::language)),
            Some(Command::Simulate(arguments)) => simulate::run(&arguments),
            Some(Command::Precompute(arguments)) => precompute::run(&arguments),
            Some(Command::Solve(arguments)) => solve::run(&arguments),
            Some(Command::Measure(arguments)) => measure::run(&arguments),
            Some(Command::Analyze(arguments)) => analyze::run(&arguments),
            Some(Command::Characterize(arguments)) => characterize::run(&arguments),
            Some(Command::Design(arguments)) => design::run(&arguments),
            Some(Command::Replay(arguments)) => replay::run(&arguments),
            Some(Command::Score(arguments)) => score::run(&arguments),
            Some(Command::Progress(arguments)) => progress::run(&arguments),
            Some(Command::Teacher(arguments)) => teacher::run(&arguments),
            Some(Command::Reproduce(arguments)) => reproduce::run(&arguments),
            Some(Command::Quality(arguments)) => quality::run(&arguments),
            Some(Command::Devices(arguments)) => devices::run(&arguments),
            Some(Command::Mesh(command)) => mesh::run(&command),
            Some(Command::Scene(arguments)) => scene::run(&arguments),
            Some(Command::Validate(arguments)) => validate::run(&arguments),
            Some(Command::Examples(arguments)) => examples::run(&arguments),
            Some(Command::Cache(arguments)) => cache::run(&arguments),
            Some(Command::Completions(arguments)) => shell::completions(&arguments),
            Some(Command::Manual(arguments)) => shell::manual(&arguments),
        }
    }
}
