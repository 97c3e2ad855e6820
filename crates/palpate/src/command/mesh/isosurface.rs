//! `palpate mesh isosurface`: the surface of an organ from a segmented volume.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::Args;
use palpate_files::{Claim, Overwrite, printable};
use palpate_geometry::{
    DicomFolder, DicomSeries, Isosurface, IsosurfaceSettings, Label, LabelMap, LengthUnit,
    isosurface_with_progress, read_dicom_folder, read_label_map,
};
use serde::Serialize;

use super::written::{Output, Written, with_stem_suffix};
use crate::failure::Failure;
use crate::progress::{Progress, Reader};
use palpate_jobs::{ProgressCallback, label};

use crate::{interrupt, output};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate mesh isosurface segmentation.nii.gz
      lists the labels with their volumes
  palpate mesh isosurface segmentation.nii.gz --label liver --out liver.ply
  palpate mesh isosurface segmentation.nii.gz --label liver --inside liver_tumor --out liver.ply
      the liver with its tumour filled in, and the tumour's own surface in liver-liver_tumor.ply: a
      scene or a problem takes it as an [[inclusion]]
  palpate mesh isosurface segmentation.nrrd --label all --out organs
      writes one file per label to the folder organs
  palpate mesh isosurface patient
      lists the DICOM series in a folder, and the labels of its segmentation object (SEG)

The surface is closed and connected, even where the volume's border cuts the organ; smoothing removes voxel steps \
without loss of volume. Coordinates in metres, shared by all organs of a volume: x to the patient's left, y to the \
back, z to the head. No name and no date of a patient is read. Labels are named by the file (TotalSegmentator, 3D Slicer) \
or by a file next to it, segmentation.json, with {\"labels\": {\"5\": \"liver\"}}. Limits: 400 million voxels (1 GB of memory) per \
volume, and 4 million triangles per label before simplification (2.5 GB, minutes).";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The label map: .nii, .nii.gz, .nrrd, a DICOM segmentation (SEG), or a folder with DICOM files.
    #[arg(value_name = "LABELS")]
    file: PathBuf,
    /// A label's name or number, or all; default: list the labels.
    #[arg(long, requires = "out")]
    label: Option<String>,
    /// A label that lies inside of the organ, by name or number; may be repeated. The organ's surface
    /// encloses it, and its own surface is written next to OUT, as OUT-LABEL. Where it reaches the border of the organ, one voxel of
    /// the organ is put between.
    #[arg(long, value_name = "LABEL", requires = "label")]
    inside: Vec<String>,
    /// The file to write (.stl, .obj, .ply, .vtp); with --label all a folder, for .ply files.
    #[arg(long, requires = "label")]
    out: Option<PathBuf>,
    /// Replace surfaces that exist.
    #[arg(long, requires = "out")]
    overwrite: bool,
    /// Maximum number of triangles of each surface.
    #[arg(long, value_name = "N", default_value_t = IsosurfaceSettings::default().triangles)]
    triangles: usize,
    /// Smoothing iterations; 0 keeps the voxel steps.
    #[arg(long, value_name = "ROUNDS", default_value_t = IsosurfaceSettings::default().smoothing)]
    smooth: usize,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Answer {
    palpate: &'static str,
    /// Those of a folder with DICOM files.
    series: Vec<DicomSeries>,
    #[serde(serialize_with = "palpate_jobs::lossy")]
    segmentations: Vec<PathBuf>,
    /// Of the label map; none where a folder has none, or several.
    size: Option<[usize; 3]>,
    spacing_m: Option<[f64; 3]>,
    labels: Vec<Label>,
    surfaces: Vec<Surfaced>,
    warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Surfaced {
    label: u16,
    name: Option<String>,
    #[serde(flatten)]
    written: Written,
    voxel_volume_m3: f64,
    cut_by_the_border: bool,
}

/// Lists labels, or makes surfaces of them.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    interrupt::ends_between_files("interrupted; the surfaces that were written are whole");
    let progress = Progress::of_job(Reader::of_json(arguments.json));
    progress.show_step("reading the volume");
    let folder = match arguments.file.is_dir() {
        true => read_dicom_folder(&arguments.file)?,
        false => DicomFolder::default(),
    };
    if arguments.file.is_dir() && folder.series.is_empty() && folder.segmentations.is_empty() {
        return Err(Failure::input(format!(
            "{}: no DICOM image or segmentation in this folder; name the folder of one patient's files",
            arguments.file.display()
        )));
    }
    // A folder of images is listed; only a label asks for its one segmentation.
    let map = match arguments.file.is_dir() && folder.segmentations.len() != 1 {
        true if arguments.label.is_none() => None,
        _ => Some(read_label_map(&arguments.file)?),
    };
    let labels = map.as_ref().map(LabelMap::labels).unwrap_or_default();
    let mut warnings = map
        .as_ref()
        .map_or(Vec::new(), |map| map.warnings().to_vec());
    let mut surfaces = Vec::new();
    if let (Some(map), Some(wanted), Some(out)) = (&map, &arguments.label, &arguments.out) {
        let overwrite = Overwrite::of_option(arguments.overwrite);
        let chosen = chosen(&labels, wanted, &arguments.inside, out, overwrite)?;
        let count = chosen.surfaces.len() as f64;
        let apart = match chosen.inside.is_empty() {
            true => None,
            false => Some(apart(map, &chosen, &mut warnings)?),
        };
        for (number, (label, out)) in chosen.surfaces.iter().enumerate() {
            progress.show_step(format!("the surface of {}", label::in_words(label)));
            let at =
                |part| ProgressCallback::report_fraction(&progress, (number as f64 + part) / count);
            let made = match number == 0 && !chosen.inside.is_empty() {
                true => {
                    let whole = map.with_inside(label.number, &chosen.inside);
                    surface(&whole, label, out, arguments, &at)?
                }
                false => surface(apart.as_ref().unwrap_or(map), label, out, arguments, &at)?,
            };
            warnings.extend(label::warnings(label, &made.0));
            surfaces.push(made.1);
        }
    }
    drop(progress);
    let answer = Answer {
        palpate: output::VERSION,
        series: folder.series,
        segmentations: folder.segmentations,
        size: map.as_ref().map(LabelMap::size),
        spacing_m: map.as_ref().map(LabelMap::spacing),
        labels,
        surfaces,
        warnings,
    };
    if arguments.json {
        return output::json(&answer);
    }
    output::warnings(&answer.warnings);
    output::text(answer.text())
}

/// The files to write.
struct Chosen<'l> {
    surfaces: Vec<(&'l Label, PathBuf)>,
    /// Numbers of labels that belong to the first.
    inside: Vec<u16>,
    /// Until all are written nobody else may write there.
    _claims: Vec<Claim>,
}

/// The requested labels, each with its file, locked by this program.
fn chosen<'l>(
    labels: &'l [Label],
    wanted: &str,
    inside: &[String],
    out: &Path,
    overwrite: Overwrite,
) -> Result<Chosen<'l>, Failure> {
    if wanted == "all" {
        if !inside.is_empty() {
            return Err(Failure::input(
                "--inside says what lies in one organ; name its label instead of all",
            ));
        }
        let claim = Claim::of_folder(out, overwrite)?;
        let name = |label: &Label| format!("{}.ply", file_name(label));
        claim.check(labels.iter().map(name))?;
        let chosen = labels.iter().map(|label| (label, out.join(name(label))));
        return Ok(Chosen {
            surfaces: chosen.collect(),
            inside: Vec::new(),
            _claims: vec![claim],
        });
    }
    let label = label::find(labels, wanted)?;
    let mut surfaces = vec![(label, out.to_owned())];
    for wanted in inside {
        let found = label::find(labels, wanted)?;
        if surfaces
            .iter()
            .any(|(other, _)| other.number == found.number)
        {
            return Err(Failure::input(format!(
                "--inside {wanted} names a label that is asked for already; name each once"
            )));
        }
        surfaces.push((found, with_stem_suffix(out, &plain_name(found))));
    }
    Ok(Chosen {
        inside: surfaces[1..]
            .iter()
            .map(|(label, _)| label.number)
            .collect(),
        _claims: Claim::of_files(surfaces.iter().map(|(_, path)| path), overwrite)?,
        surfaces,
    })
}

/// The map whose labels inside are surrounded by tissue of the organ; warnings where they were not.
fn apart(
    map: &LabelMap,
    chosen: &Chosen<'_>,
    warnings: &mut Vec<String>,
) -> Result<LabelMap, Failure> {
    let (organ, _) = &chosen.surfaces[0];
    let (apart, moved) = map.separated(organ.number, &chosen.inside);
    let organ = label::in_words(organ);
    for ((inner, _), voxels) in chosen.surfaces[1..].iter().zip(moved) {
        let (inner, all) = (label::in_words(inner), inner.voxels);
        if voxels == all {
            return Err(Failure::input(format!(
                "no voxel of {inner} has only {organ} around it; leave it out, or take smaller voxels"
            )));
        }
        if voxels > 0 {
            warnings.push(format!(
                "{inner} reaches the border of {organ} or another label inside: {voxels} of its {all} voxels were given to {organ}, so \
                 that a voxel of tissue lies between"
            ));
        }
    }
    Ok(apart)
}

fn surface(
    map: &LabelMap,
    label: &Label,
    out: &Path,
    arguments: &Arguments,
    at: &dyn Fn(f64),
) -> Result<(Isosurface, Surfaced), Failure> {
    let out = Output::new(out, LengthUnit::Metre)?;
    let settings = IsosurfaceSettings {
        smoothing: arguments.smooth,
        triangles: arguments.triangles,
    };
    let found = isosurface_with_progress(map, label.number, &settings, &mut |part| {
        at(part);
        ControlFlow::Continue(())
    });
    let found = found?;
    let surfaced = Surfaced {
        label: label.number,
        name: label.name.clone(),
        written: out.write(&found.simplified.mesh)?,
        voxel_volume_m3: found.voxel_volume,
        cut_by_the_border: found.is_cut,
    };
    Ok((found, surfaced))
}

/// The label's number and name.
fn file_name(label: &Label) -> String {
    match &label.name {
        Some(_) => format!("{}_{}", label.number, plain_name(label)),
        None => plain_name(label),
    }
}

/// The label's name without characters that file names cannot have, or its number.
fn plain_name(label: &Label) -> String {
    let name = label.name.as_deref().unwrap_or_default();
    let plain = name.chars().map(|c| match c.is_alphanumeric() || c == '-' {
        true => c,
        false => '_',
    });
    let plain: String = plain.collect();
    match plain.trim_matches('_') {
        "" => format!("label_{}", label.number),
        name => name.to_owned(),
    }
}

impl Answer {
    fn text(&self) -> String {
        if self.surfaces.is_empty() {
            let series = self.series.iter().map(series_text);
            let files = self.segmentations.iter();
            let files =
                files.map(|file| format!("segmentation {}\n", printable(&file.to_string_lossy())));
            let labels = self.labels.iter().map(|label| {
                format!(
                    "{:>6}  {:<28} {:>10} voxels {:>10.1} ml\n",
                    label.number,
                    printable(label.name.as_deref().unwrap_or("(no name)")),
                    label.voxels,
                    1e6 * label.volume
                )
            });
            let text: String = series.chain(files).chain(labels).collect();
            return match text.is_empty() {
                true => "no labels\n".to_owned(),
                false => text,
            };
        }
        let rows = self.surfaces.iter().map(|surface| {
            format!(
                "{}  {} triangles, {:.1} ml ({:.1} ml of voxels)\n",
                surface.written.file.display(),
                surface.written.triangles,
                1e6 * surface.written.volume_m3,
                1e6 * surface.voxel_volume_m3
            )
        });
        rows.collect()
    }
}

fn series_text(series: &DicomSeries) -> String {
    let [columns, rows] = series.size;
    let spacing = series.spacing_m.map_or(String::new(), |spacing| {
        let [column, row, image] = spacing.map(|metres| 1e3 * metres);
        format!(", {column:.3} x {row:.3} x {image:.3} mm")
    });
    let images = series.images;
    format!(
        "{} images: {images} of {columns} x {rows} pixels{spacing}\n",
        series.modality
    )
}
