//! `palpate mesh wrap`: a closed surface around open or defective triangles.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use palpate_files::{Claim, Overwrite};
use palpate_geometry::{Deviation, Gaps, LengthUnit, WrapSettings};
use palpate_jobs::envelope::{Envelope, envelope};
use serde::Serialize;

use super::written::{Output, Written, with_stem_suffix};
use crate::command::overwrite::OverwriteOption;
use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use crate::{interrupt, output};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate mesh wrap atlas-kidney.glb kidney.ply
  palpate mesh wrap atlas-kidney.glb kidney.ply --keep-inner
  palpate mesh wrap scan.stl organ.ply --unit mm --distance 0.001 --close-gaps 0.004 --triangles 20000

Caps holes with a boundary loop at any width. Closes gaps without one, such as gaps between pieces or narrow fissures \
of the organ, up to --close-gaps; where it is not given, up to 2 mm, and only where the body is otherwise open or in pieces. If nothing \
is enclosed then, closes also wider openings, where they are narrowest, with a warning. \
Removes inner walls and cavities, unless --keep-inner writes them to files of their own, for the regions of a scene or a \
problem (`surface = \"kidney-inner-1.ply\"`). Every surface is closed, manifold, oriented outward, connected and free of \
self-intersections.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The triangles: STL, OBJ, PLY or glTF.
    #[arg(value_name = "RAW")]
    file: PathBuf,
    /// The file to write, in metres: .stl, .obj, .ply or .vtp.
    #[arg(value_name = "OUT", required_unless_present = "named")]
    out: Option<PathBuf>,
    /// The same as OUT.
    #[arg(long = "out", value_name = "OUT", conflicts_with = "out")]
    named: Option<PathBuf>,
    /// Largest distance of the surface from the triangles [m].
    #[arg(long, value_name = "M", default_value_t = WrapSettings::default().distance)]
    distance: f64,
    /// Width of gaps to close [m] [default: 0.002 where the body is not closed without, else 0].
    #[arg(long, value_name = "M")]
    close_gaps: Option<f64>,
    /// Also write the closed surfaces inside, such as vessels, cavities, parts and inner walls, to OUT-inner-1, OUT-inner-2,
    /// ..., the largest first. Leaves out those nearer to the envelope than about --distance.
    #[arg(long)]
    keep_inner: bool,
    /// Maximum number of triangles, of each surface.
    #[arg(long, value_name = "N", default_value_t = WrapSettings::default().triangles)]
    triangles: usize,
    /// The unit of the file: m, cm, mm or um.
    #[arg(long)]
    unit: Option<String>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwrite: OverwriteOption,
}

#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    #[serde(flatten)]
    written: Written,
    triangles_before: usize,
    envelope_to_input: Deviation,
    input_to_envelope: Deviation,
    holes_capped: usize,
    widest_rim_m: f64,
    /// Width up to which gaps were closed.
    gaps_closed_m: f64,
    /// Of an opening without a rim that was closed.
    widest_opening_m: Option<f64>,
    pieces_left_out: usize,
    inner_surfaces: Vec<Written>,
    cavities_filled_m3: f64,
    seconds: f64,
    warnings: Vec<String>,
}

/// Wraps and reports.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let path = arguments.out.as_ref().or(arguments.named.as_ref());
    let path = path.ok_or_else(|| Failure::input("name the file to write"))?;
    let out = Output::new(path, LengthUnit::Metre)?;
    let inner_path = |number: usize| with_stem_suffix(path, &format!("inner-{number}"));
    let first = arguments.keep_inner.then(|| inner_path(1));
    let _claims = arguments
        .overwrite
        .claim([path.clone()].into_iter().chain(first))?;
    interrupt::ends_between_files("interrupted; nothing was written");
    let progress = Progress::of_job(Reader::of_json(arguments.json));
    let begin = Instant::now();
    let settings = WrapSettings {
        distance: arguments.distance,
        gaps: match arguments.close_gaps {
            Some(width) => Gaps::Close(width),
            None => WrapSettings::default().gaps,
        },
        triangles: arguments.triangles,
        keep_inner: arguments.keep_inner,
    };
    let unit = arguments.unit.as_deref();
    let (found, triangles_before) = envelope_of(&arguments.file, unit, &settings, &progress)?;
    let Envelope { wrapped, warnings } = found;
    let more = (2..=wrapped.inner.len()).map(inner_path);
    let _more_claims = arguments.overwrite.claim(more)?;
    let mut inner_surfaces = Vec::new();
    for (number, surface) in (1..).zip(&wrapped.inner) {
        let out = Output::new(&inner_path(number), LengthUnit::Metre)?;
        inner_surfaces.push(out.write(surface.mesh())?);
    }
    let answer = Answer {
        palpate: output::VERSION,
        written: out.write(wrapped.surface.mesh())?,
        inner_surfaces,
        triangles_before,
        envelope_to_input: wrapped.to_input,
        input_to_envelope: wrapped.of_input,
        holes_capped: wrapped.holes,
        widest_rim_m: wrapped.widest_rim,
        gaps_closed_m: wrapped.gaps,
        widest_opening_m: wrapped.opening,
        pieces_left_out: wrapped.other_pieces,
        cavities_filled_m3: wrapped.filled,
        seconds: begin.elapsed().as_secs_f64(),
        warnings,
    };
    drop(progress);
    if arguments.json {
        return output::json(&answer);
    }
    output::warnings(&answer.warnings);
    output::text(answer.text())
}

/// The envelope of the file at a path, in the unit that is given or its own, and the number of triangles in the file.
fn envelope_of(
    path: &Path,
    unit: Option<&str>,
    settings: &WrapSettings,
    progress: &Progress,
) -> Result<(Envelope, usize), Failure> {
    progress.show_step("reading the triangles");
    let imported = super::read(path, unit)?;
    let mut found =
        envelope(&imported.mesh, settings, progress).map_err(|error| error.about(path))?;
    found.warnings.splice(0..0, imported.warnings);
    Ok((found, imported.mesh.triangles().len()))
}

/// Writes the envelope of the mesh at `path`, with the usual settings, to the file `out`; and warnings.
pub(crate) fn wrap_into(out: &Path, path: &Path, reader: Reader) -> Result<Vec<String>, Failure> {
    let output = Output::new(out, LengthUnit::Metre)?;
    let _claims = Claim::of_files([out], Overwrite::Refused)?;
    let progress = Progress::of_job(reader);
    let (found, _) = envelope_of(path, None, &WrapSettings::default(), &progress)?;
    output.write(found.wrapped.surface.mesh())?;
    Ok(found.warnings)
}

impl Answer {
    fn text(&self) -> String {
        let holes = match self.holes_capped {
            0 => "none".to_owned(),
            count => format!("{count}, the widest over {:.2} mm", 1e3 * self.widest_rim_m),
        };
        let inner = self.inner_surfaces.iter().map(|surface| {
            format!(
                "\nsurface inside, {:.4e} m³, {} triangles: {}",
                surface.volume_m3,
                surface.triangles,
                surface.file.display()
            )
        });
        let inner: String = inner.collect();
        format!(
            "{} triangles became {}, written to {} in metres\n\
             from the envelope to the triangles  {}\n\
             from the triangles to the envelope  {} (more where they lie inside)\n\
             holes with a rim that were capped   {holes}\n\
             gaps that were closed               up to {:.2} mm\n\
             volume                              {:.4e} m³\n\
             took                                {:.1} s{inner}",
            self.triangles_before,
            self.written.triangles,
            self.written.file.display(),
            self.envelope_to_input,
            self.input_to_envelope,
            1e3 * self.gaps_closed_m,
            self.written.volume_m3,
            self.seconds
        )
    }
}
