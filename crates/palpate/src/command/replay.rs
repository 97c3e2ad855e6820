//! `palpate replay`: plays a session again, step by step, on the same organ.

mod pictures;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use palpate_files::{Overwrite, Scene};
use palpate_simulate::{Replay, SessionFolder};
use palpate_viewer::{PlayedSession, Start};
use serde::Serialize;

use self::pictures::Pictures;
use super::window;
use crate::failure::Failure;
use crate::output::{self, VERSION};
use crate::progress::{Progress, Reader};
use crate::{interrupt, preparation};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate replay session
      opens a window: play, pause, rewind, view from any angle
  palpate replay session --compare expert
      both side by side in a window, on one clock
  palpate replay session --frames 20 --out pictures
      without a window: 20 pictures, and a check of every force against the recorded one
  palpate replay session --gif session.gif --speed 2
      an animation at twice the speed, for slides and web pages

The folder contains session.csv and scene.toml, as written by `palpate simulate` and the window.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The session's folder.
    #[arg(value_name = "SESSION_DIR")]
    session: PathBuf,
    /// The scene, if it is not in the session's folder.
    #[arg(long, value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Another session's folder, shown on the right on the same clock.
    #[arg(long, value_name = "SESSION_DIR", conflicts_with_all = ["frames", "gif", "json"])]
    compare: Option<PathBuf>,
    /// Write this many pictures, evenly spaced in time, instead of opening a window.
    #[arg(long, value_name = "N", requires = "out", value_parser = clap::value_parser!(u64).range(0..=100_000))]
    frames: Option<u64>,
    /// The folder for pictures; it is created if missing.
    #[arg(long, value_name = "DIR", requires = "frames", group = "pictures")]
    out: Option<PathBuf>,
    /// Write an animation of 12.5 pictures a second, instead of opening a window.
    #[arg(
        long,
        value_name = "FILE.gif",
        conflicts_with = "frames",
        group = "pictures"
    )]
    gif: Option<PathBuf>,
    /// Seconds of the session in a second of the animation, from 0.25 to 8.
    #[arg(long, value_name = "X", requires = "gif", default_value_t = 1.0, value_parser = speed)]
    speed: f64,
    /// Replace pictures that exist.
    #[arg(long, requires = "pictures")]
    overwrite: bool,
    /// Print the result as one JSON object, without a window.
    #[arg(long)]
    json: bool,
}

fn speed(text: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    let allowed = number.filter(|speed| (0.25..=8.0).contains(speed));
    allowed.ok_or_else(|| "a number from 0.25 to 8 is expected".to_owned())
}

/// The result of playing a session again.
#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    steps: usize,
    duration_s: f64,
    rows_compared: u64,
    /// Deviation of a force from the recorded one.
    largest_difference_n: f64,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    files: Vec<PathBuf>,
    warnings: Vec<String>,
}

/// Opens a window, or plays it without one.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = SessionFolder::read(&arguments.session)?;
    let own = prepared(&folder, arguments.scene.as_deref(), arguments.json)?;
    if arguments.frames.is_none() && arguments.gif.is_none() && !arguments.json {
        let other = match &arguments.compare {
            None => None,
            Some(other) => {
                let folder = SessionFolder::read(other)?;
                Some(Box::new(prepared(&folder, None, false)?))
            }
        };
        let start = Start::Replay(Box::new(own), other);
        return match window::open(start, None, preparation::resources()) {
            Err(why) if window::is_absent(&why) => Err(Failure::failed(format!(
                "{why}; --frames N --out DIR and --gif FILE.gif need no window"
            ))),
            outcome => Ok(outcome?),
        };
    }
    let mut answer = play(arguments, own)?;
    answer.warnings.extend(folder.warnings());
    if arguments.json {
        return output::json(&answer);
    }
    output::text(format!(
        "{} steps over {:.1} s were played again; {}",
        answer.steps,
        answer.duration_s,
        match (answer.rows_compared, answer.largest_difference_n) {
            (count, 0.0) => format!("all {count} forces are the recorded ones, to the last bit"),
            (count, off) => format!(
                "of {count} forces none differs from the recorded one by more than {off:.2e} N"
            ),
        }
    ))?;
    for file in &answer.files {
        output::line(file.display())?;
    }
    output::warnings(&answer.warnings);
    Ok(())
}

/// The session of a folder, ready to be played again on its scene or on that of `named`.
fn prepared(
    folder: &SessionFolder,
    named: Option<&Path>,
    json: bool,
) -> Result<PlayedSession, Failure> {
    let path = folder.path.display();
    let scene = match (named, folder.scene.clone()) {
        (Some(named), _) => Scene::read(named)?,
        (None, Some(scene)) => scene,
        (None, None) => {
            return Err(Failure::input(format!(
                "{path} has no scene.toml next to its session; name the scene with --scene SCENE.toml"
            )));
        }
    };
    let reader = Reader::of_json(json);
    let simulation = preparation::simulation(&scene, &preparation::resources(), reader)?;
    let simulation = Arc::new(simulation);
    Ok(PlayedSession {
        name: path.to_string(),
        scene,
        replay: Replay::new(simulation.clone(), &folder.session)?,
        simulation,
    })
}

/// Plays all steps, takes pictures and compares.
fn play(arguments: &Arguments, own: PlayedSession) -> Result<Answer, Failure> {
    let overwrite = Overwrite::of_option(arguments.overwrite);
    let mut replay = own.replay;
    let mut pictures = match (arguments.frames, &arguments.gif) {
        (_, Some(file)) => Some(Pictures::animation(
            file,
            arguments.speed,
            overwrite,
            &own.scene,
            &own.simulation,
            &replay,
        )?),
        (Some(count @ 1..), None) => {
            let folder = arguments.out.as_deref().unwrap_or(Path::new(""));
            Some(Pictures::files(
                folder,
                count,
                overwrite,
                &own.scene,
                &own.simulation,
                replay.steps(),
            )?)
        }
        _ => None,
    };
    let steps = replay.steps();
    let progress = Progress::new(Reader::of_json(arguments.json), Some(steps as u64));
    progress.show_step("steps played again");
    let (mut compared, mut largest) = (0, 0.0_f64);
    while replay.advance() {
        let number = replay.played() as u64 - 1;
        if number.is_multiple_of(64) {
            progress.at(number);
        }
        for row in replay.recorded() {
            let tool = &replay.state().tools[row.tool];
            if tool.pose.is_some() {
                let off = (0..3).map(|axis| tool.row.force_n[axis] - row.force_n[axis]);
                largest = off.fold(largest, |largest, off| largest.max(off.abs()));
                compared += 1;
            }
        }
        if let Some(pictures) = &mut pictures {
            pictures.see(&replay)?;
        }
        if interrupt::is_requested() {
            return Err(Failure::failed(
                "interrupted; pictures in files of their own are whole, an animation is not written",
            ));
        }
    }
    let mut warnings = own.simulation.warnings().to_vec();
    warnings.extend(replay.state().warnings(&own.simulation));
    if largest > 0.0 {
        warnings.push(
            "the forces are not those that were recorded to the last bit; another version or machine \
             rounds otherwise"
                .to_owned(),
        );
    }
    Ok(Answer {
        palpate: VERSION,
        steps,
        duration_s: replay.time(steps) - replay.time(0),
        rows_compared: compared,
        largest_difference_n: largest,
        files: pictures.map_or(Ok(Vec::new()), Pictures::finish)?,
        warnings,
    })
}
