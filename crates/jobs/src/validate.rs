//! `validate`: identifies a file and checks it, with all files that it names.

use std::path::{Path, PathBuf};

use palpate_files::quantity::plain_quantity;
use palpate_files::recording::{ForeignColumns, RecordingHeader, StimulusKind};
use palpate_files::scene::{Goal, Inclusion, Layer, Shape, Task};
use palpate_files::{
    Document, Incomplete, MAX_DOCUMENT_BYTES, MAX_TABLE_BYTES, Motion, Protocol, Recording, Scene,
    Session, Tissue, read_bytes, read_text,
};
use palpate_geometry::{
    Label, LengthUnit, Vec3, VolumeRegion, extent_warning, read_label_map, read_tetrahedra,
};
use serde::Serialize;

use crate::Error;
use crate::recordings::ENDINGS;
use crate::solve::Problem;

/// A valid file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Validated {
    /// The file.
    pub file: PathBuf,
    /// Its kind.
    pub kind: Kind,
    /// Its content, for people.
    pub content: String,
    /// Warnings, as sentences.
    pub warnings: Vec<String>,
}

/// The kind of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A scene without a task.
    Scene,
    /// A scene with a task.
    Task,
    /// A tissue.
    Tissue,
    /// A protocol of the rig.
    Protocol,
    /// A problem for finite elements.
    Problem,
    /// Poses of tools over time.
    Motion,
    /// Depth and force over time.
    Recording,
    /// Motions and forces of tools over time.
    Session,
    /// A surface.
    Mesh,
    /// Tetrahedra.
    VolumeMesh,
    /// A segmented volume.
    LabelMap,
}

impl Kind {
    /// The word for people.
    pub fn word(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Task => "task",
            Self::Tissue => "tissue",
            Self::Protocol => "protocol",
            Self::Problem => "problem",
            Self::Motion => "motion",
            Self::Recording => "recording",
            Self::Session => "session",
            Self::Mesh => "mesh",
            Self::VolumeMesh => "volume mesh",
            Self::LabelMap => "label map",
        }
    }
}

/// Reads `path`, identifies it, and reads every file that it names.
///
/// # Errors
/// When it cannot be read, is of no kind that this project reads, or is invalid.
pub fn validate(path: &Path) -> Result<Validated, Error> {
    let ending = path.extension().map(|end| end.to_ascii_lowercase());
    let read = match ending.as_ref().and_then(|end| end.to_str()) {
        Some("toml") => document(path),
        Some("csv" | "txt" | "tsv" | "part") => table(path),
        Some(end) if ENDINGS.contains(&end) => recording(path),
        Some("stl" | "obj" | "ply" | "gltf" | "glb") => mesh(path),
        Some("msh" | "vtk" | "vtu") => volume_mesh(path),
        Some("nii" | "gz" | "nrrd" | "dcm") => label_map(path),
        _ => Err(Error::input(format!(
            "{}: the end of its name says none of what is read here: .toml (scene, task, tissue, protocol, problem), \
             .csv, .tsv or .txt (motion, recording, session), .jpk-force, .jpk-force-map, .jpk-qi-data, .jpk-qi-series, .ibw or .nid (recordings), .stl, \
             .obj, .ply, .gltf or .glb (mesh), .msh, .vtk or .vtu (volume mesh), .nii, .nii.gz, .nrrd or .dcm (label map)",
            path.display()
        ))),
    };
    read.map_err(|error| error.about(path))
}

fn document(path: &Path) -> Result<Validated, Error> {
    let document = Document::parse(&read_text(path, MAX_DOCUMENT_BYTES)?, path)?;
    let keys = document.open_keys(&[]);
    // Each kind has a required key of its own.
    match () {
        () if keys.contains("organ") => scene(path),
        () if keys.contains("specimen") || keys.contains("stimulus") => protocol(path),
        () if keys.contains("kind") => problem(path),
        () if keys.contains("tissue") => tissue(path),
        () => Err(Error::input(format!(
            "{}: it has neither `organ` (a scene or task), `specimen` (a protocol), `kind` (a problem) nor `tissue` \
             (a tissue)",
            path.display()
        ))),
    }
}

/// Variants to check of a scene with random draws.
const VARIANTS: u64 = 20;

fn scene(path: &Path) -> Result<Validated, Error> {
    let read = Scene::read(path)?;
    // A location that most variants have may be missing for some.
    let variants = (0..VARIANTS).map(|seed| palpate_simulate::draw_variant(&read, seed));
    let mut variants = variants.collect::<Result<Vec<_>, _>>()?;
    variants
        .iter()
        .try_for_each(palpate_simulate::check_target)?;
    let (surface, surface_warnings) = palpate_simulate::read_organ(&variants[0].organ.shape)?;
    variants
        .iter()
        .try_for_each(|one| palpate_simulate::check_estimated_inclusions(one, &surface))?;
    let scene = variants.swap_remove(0);
    let mut warnings = scene.warnings.clone();
    warnings.extend(surface_warnings);
    palpate_simulate::read_tissue(&scene.organ.tissue)?;
    warnings.extend(parts(&scene.organ.layers, &scene.organ.inclusions)?);
    for neighbour in &scene.neighbours {
        palpate_simulate::read_neighbour(neighbour)?;
        if let Some(soft) = &neighbour.soft {
            palpate_simulate::read_tissue(&soft.tissue)?;
            warnings.extend(parts(&soft.layers, &soft.inclusions)?);
        }
    }
    let organ = match &scene.organ.shape {
        Shape::Mesh { path, .. } => path.display().to_string(),
        Shape::Builtin { organ, .. } => format!("built-in {}", organ.word()),
    };
    let tools: Vec<_> = scene.tools.iter().map(|tool| tool.name.as_str()).collect();
    let triangles = surface.mesh().triangles().len();
    let mut content = format!(
        "{organ} of {triangles} triangles, {} model, tools {}",
        scene.model.kind.word(),
        tools.join(" and ")
    );
    let kind = match scene.task == Task::default() {
        true => Kind::Scene,
        false => Kind::Task,
    };
    if let Some(title) = &scene.task.title {
        content = format!("{title:?}, {content}");
    }
    if kind == Kind::Task && scene.task.goal == Goal::Free {
        warnings.push(
            "the task has no goal ([task.find], [task.traction], [task.cut] or [task.touch]): it ends when the trainee says so"
                .to_owned(),
        );
    }
    Ok(Validated {
        file: path.to_owned(),
        kind,
        content,
        warnings,
    })
}

/// Reads the files that the layers and inclusions of a body name.
fn parts(layers: &[Layer], inclusions: &[Inclusion]) -> Result<Vec<String>, Error> {
    let tissues = layers.iter().map(|layer| &layer.tissue);
    let of_inclusions = inclusions.iter().filter_map(Inclusion::tissue);
    let tissues = tissues.chain(of_inclusions);
    for tissue in tissues {
        palpate_simulate::read_tissue(tissue)?;
    }
    let mut warnings = Vec::new();
    for inclusion in inclusions {
        warnings.extend(palpate_simulate::read_inclusion(&inclusion.place)?.1);
    }
    Ok(warnings)
}

fn protocol(path: &Path) -> Result<Validated, Error> {
    let protocol = Protocol::read(path)?;
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Protocol,
        content: format!(
            "{} on {}",
            counted(protocol.stimuli.len(), "stimulus", "stimuli"),
            counted(protocol.specimens.len(), "specimen", "specimens")
        ),
        warnings: protocol.warnings,
    })
}

fn problem(path: &Path) -> Result<Validated, Error> {
    let problem = Problem::read(path)?;
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Problem,
        content: format!(
            "{} of {} tissue",
            problem.kind(),
            problem.tissue.elasticity.law()
        ),
        warnings: problem.warnings,
    })
}

fn tissue(path: &Path) -> Result<Validated, Error> {
    let tissue = Tissue::read(path)?;
    let name = tissue.name.as_ref().map(|name| format!("{name:?}, "));
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Tissue,
        content: format!(
            "{}{}, {}",
            name.unwrap_or_default(),
            tissue.elasticity.law(),
            match tissue.prony.len() {
                0 => "elastic".to_owned(),
                count => counted(count, "relaxation term", "relaxation terms"),
            }
        ),
        warnings: tissue.warnings,
    })
}

fn table(path: &Path) -> Result<Validated, Error> {
    let bytes = read_bytes(path, MAX_TABLE_BYTES)?;
    let text = String::from_utf8_lossy(&bytes);
    let names = text
        .lines()
        .map(|line| line.trim_start_matches('\u{feff}').trim())
        .find(|line| !line.is_empty() && !line.starts_with('#'))
        .unwrap_or_default();
    let has = |name: &str| names.split(',').any(|column| column.trim() == name);
    match (has("tool"), text.contains("# scene_digest")) {
        (true, true) => session(path),
        (true, false) => motion(path),
        (false, _) => recording(path),
    }
}

fn session(path: &Path) -> Result<Validated, Error> {
    let session = Session::read(path)?;
    let rows = session.rows.iter();
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Session,
        content: format!(
            "tools {}, {} model, {} to {:.3} s",
            session.tools.join(" and "),
            session.header.model.word(),
            counted(session.rows.len(), "row", "rows"),
            rows.map(|row| row.time_s).fold(0.0, f64::max)
        ),
        warnings: incomplete_warning(session.incomplete.as_ref()),
    })
}

fn motion(path: &Path) -> Result<Validated, Error> {
    let motion = Motion::read(path)?;
    let names: Vec<_> = motion.tools().iter().map(|tool| tool.name()).collect();
    let mut warnings = motion.warnings().to_vec();
    warnings.extend(incomplete_warning(motion.incomplete()));
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Motion,
        content: format!(
            "tools {}, {:.3} to {:.3} s",
            names.join(" and "),
            motion.first_time_s(),
            motion.final_time_s()
        ),
        warnings,
    })
}

/// One recording or all those of a map; a warning that several share is given once.
fn recording(path: &Path) -> Result<Validated, Error> {
    let none = (ForeignColumns::default(), RecordingHeader::default());
    let all = Recording::read_all(path, &none.0, &none.1)?;
    let mut warnings: Vec<String> = Vec::new();
    for recording in &all {
        let own = recording.remarks().iter().cloned();
        for warning in own.chain(incomplete_warning(recording.incomplete())) {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
    }
    let stimulus = all.first().and_then(|own| own.header.stimulus);
    let is_piece = stimulus.is_some_and(StimulusKind::is_of_piece);
    // A piece may be pulled, which gives negative depths.
    let larger = |a: f64, b: f64| match is_piece {
        true if b.abs() > a.abs() => b,
        true => a,
        false => a.max(b),
    };
    let largest = |of: fn(&Recording) -> &[f64], key| {
        let values = all.iter().flat_map(of).copied();
        plain_quantity(key, values.fold(0.0, larger), None)
    };
    let samples = all.iter().map(|own| own.time_s().len()).sum();
    let map = match all.len() {
        1 => String::new(),
        count => format!("a map of {count} curves, "),
    };
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Recording,
        content: format!(
            "{map}{}, to {} and {} in {}",
            counted(samples, "sample", "samples"),
            largest(Recording::depth_m, "_m"),
            largest(Recording::force_n, "_n"),
            largest(Recording::time_s, "_s")
        ),
        warnings,
    })
}

fn mesh(path: &Path) -> Result<Validated, Error> {
    let shape = Shape::Mesh {
        path: path.to_owned(),
        unit: None,
    };
    let (surface, warnings) = palpate_simulate::read_organ(&shape)?;
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::Mesh,
        content: format!(
            "a closed surface of {} triangles; `palpate mesh info` says more",
            surface.mesh().triangles().len()
        ),
        warnings,
    })
}

fn volume_mesh(path: &Path) -> Result<Validated, Error> {
    // The file does not state its unit; the document that names the file does.
    let read = read_tetrahedra(path, Some(LengthUnit::Metre))?;
    let named = |region: &VolumeRegion| match &region.name {
        Some(name) => name.clone(),
        None => region.number.to_string(),
    };
    let regions: Vec<String> = read.regions.iter().map(named).collect();
    let of_regions = match regions.len() {
        0 | 1 => String::new(),
        _ => format!(", regions {}", regions.join(", ")),
    };
    let corners = read.mesh.vertices().iter();
    let bounds = corners.fold(None, |bounds: Option<(Vec3, Vec3)>, corner| {
        let (low, high) = bounds.unwrap_or((*corner, *corner));
        Some((low.inf(corner), high.sup(corner)))
    });
    let extent = bounds.map_or_else(Vec3::zeros, |(low, high)| high - low);
    let [x, y, z] = [0, 1, 2].map(|axis| plain_quantity("", extent[axis], None));
    let of_unit = extent_warning(extent.max());
    let mut warnings = read.warnings;
    warnings.retain(|warning| Some(warning) != of_unit.as_ref());
    if read.turned > 0 {
        let turned = counted(read.turned, "tetrahedron was", "tetrahedra were");
        warnings.push(format!("{turned} inverted, and turned"));
    }
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::VolumeMesh,
        content: format!(
            "{} and {}, {x} × {y} × {z} in the unit of the file{of_regions}",
            counted(read.mesh.tetrahedra().len(), "tetrahedron", "tetrahedra"),
            counted(read.mesh.vertices().len(), "vertex", "vertices")
        ),
        warnings,
    })
}

fn label_map(path: &Path) -> Result<Validated, Error> {
    let map = read_label_map(path)?;
    let labels = map.labels();
    let named = |label: &Label| match &label.name {
        Some(name) => format!("{} ({name})", label.number),
        None => label.number.to_string(),
    };
    let named: Vec<String> = labels.iter().map(named).collect();
    let [x, y, z] = map.size();
    Ok(Validated {
        file: path.to_owned(),
        kind: Kind::LabelMap,
        content: format!(
            "{x} × {y} × {z} voxels, labels {}; `palpate mesh isosurface` says more",
            named.join(", ")
        ),
        warnings: map.warnings().to_vec(),
    })
}

fn incomplete_warning(incomplete: Option<&Incomplete>) -> Vec<String> {
    incomplete.map(Incomplete::to_string).into_iter().collect()
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
