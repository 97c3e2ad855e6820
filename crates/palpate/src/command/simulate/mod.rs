//! `palpate simulate`: an organ in a window, or without one tool motions, or the indentation of a recording.

mod repeated;
mod shown;

use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};

use clap::Args;
use palpate_devices::publisher::{Protocol, Publisher};
use palpate_files::scene::{LARGEST_SEED, Shape};
use palpate_files::{Motion, Overwrite, Scene};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::interactive::SceneDevices;
use palpate_simulate::{Resources, Simulation, draw_variant};
use palpate_viewer::{FrameWriter, Start};

use self::repeated::Repeated;
use super::mesh::wrap::wrap_into;
use super::window;
use crate::failure::Failure;
use crate::output;
use crate::preparation;
use crate::progress::Reader;
use crate::recorded::{Recording, Report, claimed, record};
use crate::training;

/// The default scene.
pub(crate) const ESOPHAGUS: &str = include_str!("../../../../../assets/esophagus/scene.toml");

/// Extensions of meshes.
const MESHES: [&str; 5] = ["stl", "obj", "ply", "gltf", "glb"];

/// The tool and the tissue for an organ without a scene; its shape replaces the liver's.
const AROUND_A_MESH: &str = "\
format = 1
organ = { builtin = \"liver\", builtin_tissue = \"pig-liver\" }
tool = [{ name = \"right\", kind = \"probe\", device = \"mouse\", tip = { shape = \"flat\", radius_m = 0.002 } }]
";

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate simulate scene.toml
      opens a window in which the mouse moves the tool
  palpate simulate liver.ply
      opens your own organ; assumes pig liver unless a scene says otherwise
  palpate simulate atlas-kidney.glb --wrap
      the same of an atlas' organ that is open, doubled or in pieces: writes atlas-kidney-wrapped.ply
      first
  palpate simulate scene.toml --headless --motion motion.csv --out session
      writes session/session.csv (forces on the tool at every step), plots and summary.json; --overwrite
      replaces an existing session
  palpate simulate scene.toml --headless --indentation recording.csv --out session
      presses as deep as recorded, at the organ's top centre or --at another location, and
      compares the simulated force with the recorded one (session/beside.png)
  palpate simulate --headless --motion motion.csv --out session --fields 60 --frames 60
      on the built-in esophagus, with 60 surfaces for ParaView (open session/surfaces.pvd) and
      60 pictures (session/frame-0001.png and so on)
  palpate simulate scene.toml --openigtlink
      opens a window and serves the simulation to 3D Slicer on this machine (docs/slicer.md)
  palpate simulate scene.toml --headless --publish
      no window: a haptic device moves the tools, and clients of ROS read poses, forces and the
      organ from ws://127.0.0.1:9090 (docs/how_to/robot_learning.md)
  palpate simulate scene.toml --headless --openigtlink=0.0.0.0:18944
      no window: a haptic device moves the tools, and any machine that can reach this one can
      watch

A scene names an organ, its tissue, the model and the tools; a motion says where the tips are:
  # format = 1
  time_s,tool,x_m,y_m,z_m
  0.0,right,0.0,0.0,0.052
  1.0,right,0.0,0.0,0.047";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The scene, or a mesh of an organ; without one, the built-in esophagus.
    #[arg(value_name = "SCENE.toml|MESH")]
    scene: Option<PathBuf>,
    /// Wrap the mesh first: a closed envelope of any triangles, within 0.5 mm and with gaps of up to 2 mm closed, written to
    /// this file [default: the name of the mesh with -wrapped.ply, in this folder]. `palpate mesh wrap` has the settings.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, requires = "scene")]
    wrap: Option<Option<PathBuf>>,
    /// Play without a window; needs --motion or --indentation, and --out; or --openigtlink or --publish.
    #[arg(long)]
    headless: bool,
    /// The tool motions to play: time_s, tool, x_m, y_m, z_m.
    #[arg(long, value_name = "MOTION.csv", group = "played")]
    motion: Option<PathBuf>,
    /// The recording of `palpate measure`, or of another rig, whose indentation the first tool repeats.
    #[arg(long, value_name = "RECORDING.csv", group = "played")]
    indentation: Option<PathBuf>,
    /// The location: the point of the organ nearest to this one [m]; default: nearest to the top centre of its bounding
    /// box.
    #[arg(long, value_name = "X,Y,Z", requires = "indentation", allow_hyphen_values = true, value_parser = repeated::point)]
    at: Option<[f64; 3]>,
    /// The random variant of a scene with [draw]; a window draws a new one for each attempt.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=LARGEST_SEED))]
    seed: u64,
    /// The folder for the session; it is created if missing.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace an existing session in the folder.
    #[arg(long, requires = "out")]
    overwrite: bool,
    /// Write this many deformed surfaces, evenly spaced in time, for ParaView.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=100_000))]
    fields: u64,
    /// Write this many pictures, evenly spaced in time: frame-0001.png and so on.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(0..=100_000))]
    frames: u64,
    /// Print the summary as one JSON object.
    #[arg(long)]
    json: bool,
    /// Serve the simulation to 3D Slicer and others over OpenIGTLink; on this machine only, unless ADDRESS says
    /// otherwise.
    #[arg(long, value_name = "[ADDRESS:]PORT", num_args = 0..=1, require_equals = true, default_missing_value = "18944", value_parser = room_address)]
    openigtlink: Option<SocketAddr>,
    /// Publish poses, forces and the organ to clients of ROS, as JSON over a WebSocket (rosbridge); on this machine only,
    /// unless ADDRESS says otherwise.
    #[arg(long, value_name = "[ADDRESS:]PORT", num_args = 0..=1, require_equals = true, default_missing_value = "9090", value_parser = room_address)]
    publish: Option<SocketAddr>,
}

/// A port of this machine, or of an address.
fn room_address(text: &str) -> Result<SocketAddr, String> {
    let port = text
        .parse()
        .map(|port: u16| SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    let address = port.or_else(|_| text.parse());
    address.map_err(|_| {
        "give a port, as in 18944, or an address with one, as in 0.0.0.0:18944".to_owned()
    })
}

/// Plays the motions.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let played = match (&arguments.motion, &arguments.indentation) {
        (Some(motion), _) => Some(Played::Motion(motion)),
        (None, Some(recording)) => Some(Played::Indentation(recording)),
        (None, None) => None,
    };
    let shows = arguments.openigtlink.is_some() || arguments.publish.is_some();
    match (arguments.headless, played, &arguments.out) {
        (true, Some(played), Some(out)) if !shows => play(arguments, &played, out),
        (true, None, None) if shows => {
            let scene = draw_variant(&arguments.touched()?, arguments.seed)?;
            shown::run(scene, arguments.resources()?)
        }
        (false, None, None) => touch(arguments),
        (true, Some(_), Some(_)) => Err(Failure::input(
            "a motion is played faster than it can be displayed; leave --openigtlink and --publish out, or --motion and --out",
        )),
        (true, ..) => Err(Failure::input(
            "--headless plays a motion or an indentation; add --motion MOTION.csv --out DIR, or --openigtlink or \
             --publish alone to show a touch",
        )),
        _ => Err(Failure::input(
            "in a window the mouse moves the tools; play a motion with --headless --motion MOTION.csv \
             --out DIR",
        )),
    }
}

/// What moves the tools where no window is.
enum Played<'a> {
    Motion(&'a Path),
    Indentation(&'a Path),
}

impl Arguments {
    /// What is touched, by whatever moves its tools.
    fn touched(&self) -> Result<Scene, Failure> {
        self.refuse_pictures()?;
        match &self.scene {
            Some(path) => self.scene_of(path),
            None => training::free(),
        }
    }

    /// A scene file, or a mesh with a probe over it.
    fn scene_of(&self, path: &Path) -> Result<Scene, Failure> {
        if !is_mesh(path) {
            return match self.wrap {
                None => Ok(Scene::read(path)?),
                Some(_) => Err(Failure::input(
                    "--wrap is for a mesh; wrap the mesh of a scene with `palpate mesh wrap`",
                )),
            };
        }
        let mesh = match &self.wrap {
            None => path.to_owned(),
            Some(out) => {
                let out = out.clone().unwrap_or_else(|| wrapped_name(path));
                if out.exists() {
                    return Err(Failure::input(format!(
                        "{} is there already; open it instead of the mesh, or name another file with --wrap=FILE",
                        out.display()
                    )));
                }
                let warnings = wrap_into(&out, path, Reader::of_json(self.json))?;
                output::warnings(&warnings);
                if !self.json {
                    output::line(format!("the envelope is in {}", out.display()))?;
                }
                out
            }
        };
        let mut scene = Scene::parse(AROUND_A_MESH, "scene around a mesh")?;
        scene.organ.shape = Shape::Mesh {
            path: mesh,
            unit: None,
        };
        Ok(scene)
    }

    /// Pictures and fields belong to a motion.
    fn refuse_pictures(&self) -> Result<(), Failure> {
        match self.json || self.frames > 0 || self.fields > 0 {
            true => Err(Failure::input(
                "--json, --frames and --fields belong to a motion; add --headless --motion MOTION.csv --out DIR",
            )),
            false => Ok(()),
        }
    }

    /// What a touch may use, with the server that shows it.
    fn resources(&self) -> Result<Resources, Failure> {
        let servers = [
            (self.openigtlink, Protocol::OpenIgtLink, "--openigtlink"),
            (self.publish, Protocol::Rosbridge, "--publish"),
        ];
        let servers = servers.into_iter();
        let opened = servers.filter_map(|(address, protocol, option)| {
            let address = address?;
            let opened = Publisher::open(address, protocol).map_err(|error| {
                Failure::failed(format!(
                    "nothing can be shown at {address} ({error}); give another port with {option}"
                ))
            });
            Some(opened)
        });
        Ok(Resources {
            publishers: opened.collect::<Result<_, _>>()?,
            ..preparation::resources_with_devices()?
        })
    }
}

fn is_mesh(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    MESHES.iter().any(|mesh| extension == *mesh)
}

/// The default file of a mesh's envelope, in the working directory.
fn wrapped_name(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push("-wrapped.ply");
    name.into()
}

/// In a window, until it is closed.
fn touch(arguments: &Arguments) -> Result<(), Failure> {
    arguments.refuse_pictures()?;
    let start = match &arguments.scene {
        Some(path) => Start::Scene(Box::new(arguments.scene_of(path)?)),
        None => Start::Home,
    };
    let resources = arguments.resources()?;
    // Before a window, and the minutes that an organ may take.
    if let Start::Scene(scene) = &start {
        SceneDevices::check(scene, &resources.devices)?;
    }
    match window::open(start, Some(training::training()?), resources) {
        Err(why) if window::is_absent(&why) => Err(Failure::failed(format!(
            "{why}; --headless plays a motion without a window"
        ))),
        outcome => Ok(outcome?),
    }
}

/// Without a window, from a file.
fn play(arguments: &Arguments, played: &Played<'_>, out: &Path) -> Result<(), Failure> {
    let report = simulate(arguments, played, out)?;
    if arguments.json {
        output::json(&report)?;
    } else {
        output::text(report.text())?;
        output::line(format!("recorded in {}", out.display()))?;
        output::warnings(report.warnings());
    }
    report.outcome()
}

/// Rows of a motion that are considered for the viewpoint, at most.
const MAX_ROWS: usize = 1000;

/// The place of a tool that is deepest in the organ, or nearest to it, over the rows of `motion` [m].
fn touched(simulation: &Simulation, motion: &Motion) -> Option<Vec3> {
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let count: usize = motion.tools().iter().map(|tool| tool.rows().len()).sum();
    let rows = motion.tools().iter().flat_map(|tool| tool.rows());
    let rows = rows.step_by(1 + count / MAX_ROWS);
    let places = rows.map(|row| Vec3::from(row.pose.position_m));
    let depths = places.map(|place| (surface.signed_distance(&tree, &place).1, place));
    let deepest = depths.min_by(|(one, _), (other, _)| one.total_cmp(other));
    deepest.map(|(_, place)| place)
}

fn simulate(arguments: &Arguments, played: &Played<'_>, out: &Path) -> Result<Report, Failure> {
    let scene = match &arguments.scene {
        Some(path) => draw_variant(&arguments.scene_of(path)?, arguments.seed)?,
        None => Scene::parse(ESOPHAGUS, "built-in scene")?,
    };
    let reader = Reader::of_json(arguments.json);
    let prepared = || preparation::simulation(&scene, &preparation::resources(), reader);
    let claimed = || claimed(out, Overwrite::of_option(arguments.overwrite));
    // All inputs are read and the folder checked before any preparation or output.
    let (motion, folder, simulation, comparison) = match played {
        Played::Motion(path) => (Motion::read(path)?, claimed()?, prepared()?, None),
        Played::Indentation(path) => {
            let repeated = Repeated::read(path)?;
            let folder = claimed()?;
            let simulation = prepared()?;
            let (motion, comparison) = repeated.on(&scene, &simulation, arguments.at)?;
            (motion, folder, simulation, Some(comparison))
        }
    };
    let frames = match arguments.frames {
        0 => None,
        wanted => {
            let frames = FrameWriter::new(&scene, &simulation, out, wanted)?;
            Some(match touched(&simulation, &motion) {
                Some(place) => frames.facing(&scene, &simulation, &place),
                None => frames,
            })
        }
    };
    let recording = Recording {
        scene: &scene,
        folder,
        surfaces: arguments.fields,
        frames,
        comparison,
        reader,
    };
    record(&simulation, &motion, recording)
}
