//! `palpate solve`: solves a described problem with the finite element reference.

use std::path::{Path, PathBuf};

use clap::Args;
use palpate_files::Claim;
use palpate_jobs::json_text;
use palpate_jobs::solve::{Answer, Problem, RequestedOutputs, in_words, solve};

use super::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::interrupt::{self, UninterruptedSection};
use crate::output;
use crate::plot::Draw;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = concat!(
    "\
Examples:
  palpate solve punch.toml
      prints depth, force and estimated error as a table
  palpate solve punch.toml --json --plot punch.png
      the same as one JSON object, and as a plot
  palpate solve kidney.toml --vtu kidney.vtu
      also writes the deformed body, for ParaView
  palpate solve ramp.toml --recording ramp.csv
      writes a recording, as an indenter would record it
  palpate solve beam_weight.toml --tissue silicone.toml
      fits the stiffness to measured displacements and writes the tissue

A problem names a body, its tissue and its loads. This is punch.toml:

",
    include_str!("../../../../../assets/problems/punch.toml"),
    "
The keys of each kind:
  indentation  block = { radius_m, height_m, base = \"bonded\" | \"lubricated\" }, outer side free;
               indenter = { radius_m, face = \"stick\" | \"slip\", or friction, side = \"stick\" |
               \"slide\" | \"none\" }, or { shape = \"sphere\", radius_m, face }, or
               { shape = \"cone\", half_angle_deg, radius_m (of its base), face }; depths_m, or
               ramp = { depth_m, ramp_s, hold_s, samples, method = \"convolution\" | \"full\" }
  hemisphere   radius_m, patch_radius_m, patch = \"slip\" | \"bonded\", depth_m; a linear tissue
  tube         length_m, inner_radius_m, outer_radius_m, ends fixed; pressure_pa or pressures_pa,
               and perhaps indent = { radius_m, depths_m, contact = \"stick\" | \"slip\" }
  uniaxial     stretches
  solid        mesh (a surface or tetrahedra) and mesh_unit, or builtin and triangles; anchor as in
               a scene; patch = { center_m, radius_m, displacement_m, contact = \"stick\" | \"slip\" },
               [[tool]] with shape, from_m, path_m and friction, gravity_m_per_s2, or [[load]] with
               force_n or pressure_pa and a place: box_m, center_m and radius_m, region = { planes,
               boxes, spheres } or line = { from_m, to_m }; points_m, whose displacement_m is asked
               for; [[point]] with name, at_m, and perhaps along and measured_m, to which
               fit_stiffness = true fits the tissue; [[region]] with name, tissue or cavity, and a
               shape: layer, ball, ellipsoid, capsule, surface or label
All have format = 1, kind, accuracy (0.01 if not given), and tissue (a table or a file) or \
builtin_tissue, as in a scene. A key ends in its unit; depths_mm is read as well as depths_m. \
Moduli are instantaneous; only a ramp relaxes. `palpate examples DIR` writes a problem of each kind."
);

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The problem: a body, its tissue and its loads.
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    /// Plot force against depth, or the problem's own result.
    #[arg(long, value_name = "FILE.png")]
    plot: Option<PathBuf>,
    /// Write the body with its displacement, for ParaView.
    #[arg(long, value_name = "FILE.vtu")]
    vtu: Option<PathBuf>,
    /// Write the forces of a `ramp` as a recording.
    #[arg(long, value_name = "FILE.csv")]
    recording: Option<PathBuf>,
    /// Write the tissue whose stiffness was fitted (`fit_stiffness`).
    #[arg(long, value_name = "FILE.toml")]
    tissue: Option<PathBuf>,
    /// Write the JSON object to a file as well.
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

/// Solves and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let problem = Problem::read(&arguments.problem)?;
    let _claims = claimed(arguments, &problem)?;
    interrupt::ends_between_files("interrupted; no answer was found");
    let progress = Progress::of_job(Reader::of_json(arguments.json));
    let wanted = RequestedOutputs {
        plot: arguments.plot.is_some(),
        vtu: arguments.vtu.is_some(),
    };
    let answer = solve(&problem, wanted, &progress)?;
    write(arguments, &answer)?;
    drop(progress);
    if arguments.json {
        return output::json(&answer);
    }
    output::text(in_words(&problem, &answer))?;
    for path in arguments.files() {
        output::line(format!("written: {}", path.display()))?;
    }
    output::warnings(&answer.solution.warnings);
    Ok(())
}

/// The files to write, if there is data for them: checked before the work, not after it.
fn claimed(arguments: &Arguments, problem: &Problem) -> Result<Vec<Claim>, Failure> {
    if arguments.vtu.is_some() && !problem.has_field() {
        return Err(Failure::input(
            "--vtu: only a solid and an indentation are written for ParaView; leave it out, or use \
             --plot",
        ));
    }
    if arguments.recording.is_some() && !problem.has_recording() {
        return Err(Failure::input(
            "--recording: only an indentation with a `ramp` has a course in time; leave it out, or \
             use --out",
        ));
    }
    if arguments.tissue.is_some() && !problem.fits_stiffness() {
        return Err(Failure::input(
            "--tissue: only a solid with `fit_stiffness = true` has a tissue of its own; leave it out, or fit the \
             stiffness to measured points",
        ));
    }
    arguments.overwrite.claim(arguments.files())
}

fn write(arguments: &Arguments, answer: &Answer) -> Result<(), Failure> {
    let solution = &answer.solution;
    // Ctrl-C is delayed until the files are complete.
    let _unbroken = UninterruptedSection::begin();
    if let Some(path) = &arguments.plot {
        solution.plot.write(path)?;
    }
    if let (Some(path), Some(bytes)) = (&arguments.vtu, &solution.vtu) {
        palpate_files::write_atomically(path, bytes)?;
    }
    if let (Some(path), Some(recording)) = (&arguments.recording, &solution.recording) {
        recording.write(path)?;
    }
    if let (Some(path), Some(tissue)) = (&arguments.tissue, solution.fitted_tissue()) {
        tissue.write(path)?;
    }
    if let Some(path) = &arguments.out {
        let json = json_text(answer)? + "\n";
        palpate_files::write_atomically(path, json.as_bytes())?;
    }
    Ok(())
}

impl Arguments {
    /// The files to be written.
    fn files(&self) -> impl Iterator<Item = &Path> {
        let Self {
            plot,
            vtu,
            recording,
            tissue,
            out,
            ..
        } = self;
        let files = [plot, vtu, recording, tissue, out];
        files.into_iter().filter_map(|path| path.as_deref())
    }
}
