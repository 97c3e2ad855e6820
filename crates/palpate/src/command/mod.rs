//! The command line: one file per command.

mod analyze;
mod cache;
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

use clap::{Parser, Subcommand};

use crate::failure::Failure;
use crate::output;

/// The licences of what this program is built of; `.ci/notices` writes them.
const NOTICES: &str = include_str!("../../../../THIRD-PARTY.txt");

/// Examples at the end of `palpate --help`.
const EXAMPLES: &str = "\
Examples:
  palpate
      opens a window with tasks to practise and organs to touch. Without a display it plays a
      first touch instead and writes ./palpate-demo
  palpate simulate scene.toml
      opens a window with your scene
  palpate simulate scene.toml --headless --motion motion.csv --out session
      plays the tool motions on the scene and writes session/session.csv
  palpate score session --expert expert
      how well it was done: time, ways, forces, errors, beside an expert's
  palpate replay session
      the session again, from any side
  palpate precompute scene.toml
      prepares the whole organ of the hybrid model once; then the scene opens at once
  palpate solve problem.toml --plot force.png
      the force of an indenter, the swelling of a tube and more, by finite elements
  palpate measure
      opens the rig's window over a specimen that is not there; with --headless --out recordings
      a protocol is carried out without one
  palpate characterize liver-2mm.csv liver-4mm.csv --out liver.toml
      the tissue behind recordings, with its uncertainty
  palpate design liver-2mm.csv --out protocol.toml
      how to press next, so that its parameters are known best
  palpate progress --report progress.html
      learning curves of all trainees beside the experts
  palpate quality
      how late a 1 kHz loop is on this machine, and how far its forces are off
  palpate devices
      which haptic devices are there
  palpate mesh info kidney.stl --unit mm
      what is wrong with a mesh, and whether it can be simulated
  palpate mesh isosurface segmentation.nii.gz --label liver --out liver.ply
      an organ from a segmented volume
  palpate reproduce table-3-1
      a published table beside ours
  palpate examples .
      writes scenes, motions, tasks, problems and a recording, to begin from
  palpate scene --template --out scene.toml
      a scene to begin from, with every key explained
  palpate validate scene.toml
      what a file is, and whether it is right

Every command has its own --help. With --json a command prints one machine-readable document on standard output. No \
command replaces a file that exists without --overwrite. Exit status: 0 done, 2 the input has to be mended, 1 a \
failure.";

/// Soft-tissue touch, from the first indentation to the trained hand.
///
/// Without a command, the window opens; where there is no display, a demonstration runs.
#[derive(Debug, Parser)]
#[command(name = "palpate", version, long_version = output::LONG_VERSION, after_help = EXAMPLES, disable_help_subcommand = true)]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct CommandLine {
    /// Print the licences of the libraries and fonts that this program contains.
    #[arg(long)]
    notices: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Touch an organ in a window, or play tool motions on it and record what the hand would feel.
    Simulate(simulate::Arguments),
    /// Prepare the whole organ of a scene, once, so that it can be touched at haptic rates.
    Precompute(precompute::Arguments),
    /// Solve a described problem with finite elements, the reference for everything else.
    Solve(solve::Arguments),
    /// Press an indenter into specimens, in a window or by a protocol, and record depth and force.
    Measure(measure::Arguments),
    /// What recordings show without a model: static force, relaxation, answers to sines and chirps.
    Analyze(analyze::Arguments),
    /// Look at a session again, from any side, or take pictures of it.
    Replay(replay::Arguments),
    /// Measure a session: time, ways, forces, errors, the task, and all that beside an expert's.
    Score(score::Arguments),
    /// Find the tissue behind recordings: relaxation and laws, with how well they are known.
    Characterize(characterize::Arguments),
    /// Find how to press, so that the parameters of a tissue are known best.
    Design(design::Arguments),
    /// How trainees come along: attempts, learning curves, and who is as good as the experts.
    Progress(progress::Arguments),
    /// Cohorts, assignments and experts: a teacher's commands.
    Teacher(teacher::Arguments),
    /// Recompute the tables and figures of the source, published values beside ours.
    Reproduce(reproduce::Arguments),
    /// Measure how good touch is on this machine: rates, lateness, errors.
    Quality(quality::Arguments),
    /// List the haptic devices that are there, with their limits, and test them.
    Devices(devices::Arguments),
    /// Look at meshes, make them smaller, convert them, make them from segmented volumes.
    #[command(subcommand)]
    Mesh(mesh::Mesh),
    /// Write a scene or another document to begin from, with every key explained.
    Scene(scene::Arguments),
    /// Say what files are, and whether they are right.
    Validate(validate::Arguments),
    /// Write the example files of the documentation into a folder.
    Examples(examples::Arguments),
    /// Tell or clear what is kept because it took long, and can be made again.
    Cache(cache::Arguments),
    /// Print the script by which a shell completes the command line.
    Completions(shell::Completions),
    /// Write manual pages into a folder.
    Manual(shell::Manual),
}

impl CommandLine {
    /// Does what the line says.
    pub(crate) fn run(self) -> Result<(), Failure> {
        match self.command {
            None if self.notices => output::text(NOTICES),
            None => demonstration::run(),
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
