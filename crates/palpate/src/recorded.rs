//! Plays a motion and fills its folder: the session, surfaces for ParaView, plots and the summary.

mod cuts;
mod force_comparison;
mod surfaces;
mod trace;

use std::path::{Path, PathBuf};

use palpate_files::{Claim, Error, Incomplete, Motion, Overwrite, Scene, write_atomically};
use palpate_simulate::{
    CavitySummary, Flow, SessionFolder, Simulation, Summary, check_motion, play,
};
use palpate_viewer::FrameWriter;
use serde::Serialize;

use crate::failure::Failure;
use crate::interrupt;
use crate::output::VERSION;
use crate::progress::{Progress, Reader};
pub(crate) use force_comparison::Comparison;
use force_comparison::ComparisonAnswer;
use surfaces::Surfaces;
use trace::Traces;

/// The destination of a motion, and the outputs in addition to the session.
pub(crate) struct Recording<'a> {
    /// The scene of the simulation.
    pub(crate) scene: &'a Scene,
    /// The folder, as [`claimed`].
    pub(crate) folder: Claim,
    /// Surfaces to write for ParaView, evenly over the motion.
    pub(crate) surfaces: u64,
    /// Takes pictures, evenly over the motion.
    pub(crate) frames: Option<FrameWriter>,
    /// The recording that the first tool repeats.
    pub(crate) comparison: Option<Comparison>,
    pub(crate) reader: Reader,
}

/// The content of `summary.json` and of `--json`.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    palpate: &'static str,
    #[serde(flatten)]
    summary: Summary,
    #[serde(skip_serializing_if = "Option::is_none")]
    beside: Option<ComparisonAnswer>,
    /// Why the motion may lack rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    incomplete: Option<String>,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    files: Vec<PathBuf>,
}

/// The file of a summary, next to that of a session.
const SUMMARY: &str = "summary.json";

/// The folder of a recording, locked by this program, without files that the recording would replace unless that is
/// allowed.
pub(crate) fn claimed(folder: &Path, overwrite: Overwrite) -> Result<Claim, Failure> {
    let claim = Claim::of_folder(folder, overwrite).map_err(|error| match error {
        Error::Write { .. } => Failure::failed(format!(
            "{error}; name a folder that can be written with --out"
        )),
        other => other.into(),
    })?;
    claim.check([
        "session.csv",
        "scene.toml",
        SUMMARY,
        "force.png",
        "force-depth.png",
        "beside.png",
        "surfaces.pvd",
        "surface-0001.vtp",
        "frame-0001.png",
    ])?;
    Ok(claim)
}

/// Plays `motion` and records it. A rejected motion leaves the folder as it was.
pub(crate) fn record(
    simulation: &Simulation,
    motion: &Motion,
    mut recording: Recording<'_>,
) -> Result<Report, Failure> {
    check_motion(simulation, motion)?;
    let folder = recording.folder.path().to_owned();
    let folder = folder.as_path();
    // After this call Ctrl-C ends the motion, and the steps so far are written completely.
    interrupt::is_requested();
    let names: Vec<_> = simulation.tools().iter().map(|t| t.name.clone()).collect();
    let mut writer = SessionFolder::create(recording.folder, recording.scene, simulation)?;
    let mut surfaces = Surfaces::new(folder, recording.surfaces);
    let mut traces = Traces::new(&names);
    let mut progress: Option<Progress> = None;
    let summary = play(simulation, motion, |frame| -> Result<Flow, Failure> {
        let bar = progress.get_or_insert_with(|| {
            let bar = Progress::new(recording.reader, Some(frame.steps));
            bar.show_step("steps played");
            bar
        });
        if frame.number.is_multiple_of(64) {
            bar.at(frame.number);
        }
        for row in frame.rows() {
            writer.write(row)?;
            if let Some(comparison) = recording.comparison.as_mut().filter(|_| row.tool == 0) {
                comparison.add(row);
            }
        }
        traces.add(frame);
        surfaces.add(simulation, frame)?;
        if let Some(frames) = &mut recording.frames {
            frames.add(frame)?;
        }
        match interrupt::is_requested() {
            true => Ok(Flow::Stop),
            false => Ok(Flow::Continue),
        }
    })?;
    drop(progress);
    let path = folder.join(SUMMARY);
    // Locks the folder until all is written.
    let _claim = writer.finish()?;
    let mut files = vec![SessionFolder::session_file(folder)];
    files.extend(surfaces.finish()?);
    files.extend(
        recording
            .frames
            .map(FrameWriter::finish)
            .unwrap_or_default(),
    );
    files.extend(traces.draw(folder, recording.comparison.as_ref())?);
    files.push(path.clone());
    let report = Report::new(summary, motion, files, recording.comparison);
    let json = serde_json::to_string_pretty(&report)
        .map_err(|cause| Failure::failed(format!("the summary is no JSON ({cause})")))?
        + "\n";
    write_atomically(&path, json.as_bytes())?;
    Ok(report)
}

/// A cavity, for a person.
fn cavity_line(cavity: &CavitySummary) -> String {
    format!(
        "\n{}: {:.0} Pa at the end, {:.0} to {:.0} Pa; {:.2} cm³, at rest {:.2} cm³",
        cavity.name,
        cavity.pressure,
        cavity.lowest,
        cavity.highest,
        1e6 * cavity.volume,
        1e6 * cavity.volume_at_rest
    )
}

impl Report {
    fn new(
        mut summary: Summary,
        motion: &Motion,
        files: Vec<PathBuf>,
        comparison: Option<Comparison>,
    ) -> Self {
        let (beside, warnings) = comparison.map(Comparison::finish).unzip();
        let incomplete = motion
            .incomplete()
            .map(|why| (why, format!("the motion is {why}")));
        // A motion that is written by hand rarely has an end mark, which alone is no warning.
        let warned = incomplete
            .iter()
            .filter(|(why, _)| **why != Incomplete::Unmarked);
        let warned: Vec<String> = warned.map(|(_, sentence)| sentence.clone()).collect();
        let unusual = motion.warnings().iter().cloned().chain(warned);
        let warnings = warnings.into_iter().flatten();
        summary.warnings.extend(unusual.chain(warnings));
        Self {
            palpate: VERSION,
            summary,
            beside,
            incomplete: incomplete.map(|(_, sentence)| sentence),
            files,
        }
    }

    pub(crate) fn warnings(&self) -> &[String] {
        &self.summary.warnings
    }

    /// For a person.
    pub(crate) fn text(&self) -> String {
        let summary = &self.summary;
        let times = &summary.step_times;
        format!(
            "{} steps, {} contact{}, peak force {:.4} N, largest depth {:.2} mm\n\
             a step took {:.0} µs (median), {:.0} µs (99 %), {:.0} µs (99.9 %), {:.0} µs at most{}{}{}{}",
            summary.steps,
            summary.contacts,
            if summary.contacts == 1 { "" } else { "s" },
            summary.peak_force,
            1e3 * summary.deepest,
            1e6 * times.p50,
            1e6 * times.p99,
            1e6 * times.p99_9,
            1e6 * times.max,
            summary.cuts.as_ref().map_or(String::new(), cuts::line),
            summary.cavities.iter().map(cavity_line).collect::<String>(),
            self.beside
                .as_ref()
                .map_or(String::new(), ComparisonAnswer::line),
            self.incomplete
                .as_ref()
                .map_or(String::new(), |sentence| format!("\n{sentence}")),
        )
    }

    /// An interrupted motion is no success.
    pub(crate) fn outcome(&self) -> Result<(), Failure> {
        match self.summary.interrupted {
            true => Err(Failure::failed(format!(
                "interrupted after {} steps; what was played is recorded whole",
                self.summary.steps
            ))),
            false => Ok(()),
        }
    }
}
