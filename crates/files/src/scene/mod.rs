//! The scene: an organ and its tissue, its surroundings, the model that moves it and the tools that touch it.

mod cavity;
mod cut_line;
mod cutting;
mod draw;
mod goal;
mod inclusion;
mod jaws;
mod model;
mod model_words;
mod neighbour;
mod organ;
mod part;
mod region;
mod self_contained;
mod shape;
mod task;
mod tissue_choice;
mod tool;
mod view;

use std::path::{Path, PathBuf};

pub use cavity::CavityContent;
pub use cut_line::CutLine;
pub use cutting::{CutMode, Cutting};
pub use draw::{Drawn, Draws, FindOnSurface, LARGEST_SEED, OnSurface, SurfacePoint, Variant};
pub use goal::{Goal, SizeGoal, TouchGoal};
pub use inclusion::{EstimatedInclusion, Inclusion, InclusionPlace, InclusionShape};
pub use jaws::Jaws;
use model::Requirements;
pub use model::{Enhancement, LocalSettings, Model};
pub use model_words::{
    Assembly, Calibration, EnhancementArea, Form, HandOver, IntegrationPoints, ModelKind,
    Placement, ResponseMethod, Smoothing, Solver,
};
pub use neighbour::{Location, Neighbour, SoftNeighbour};
pub use organ::{Layer, Organ};
pub use part::{BodyPart, PartContent, PartPlace};
pub use region::{Region, RegionBox, RegionPlane, RegionSphere};
pub use self_contained::self_contained;
pub use shape::{BuiltinOrgan, LengthUnit, Shape};
pub use task::Task;
use task::TaskScene;
pub use tissue_choice::TissueChoice;
pub use tool::{DeviceKind, Tip, TipContact, TipShape, Tool, ToolKind, ToolMesh};
pub use view::{Shading, View};

use crate::atomic_write::{MAX_DOCUMENT_BYTES, read_text};
use crate::{Document, Error, Key};

/// A scene. Keys that the file leaves out have their defaults here.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The folder of the scene's file. The paths in the scene already begin with it.
    pub folder: PathBuf,
    /// The organ that is touched.
    pub organ: Organ,
    /// Its surroundings.
    pub neighbours: Vec<Neighbour>,
    /// The model of the organ.
    pub model: Model,
    /// The settings for cutting.
    pub cutting: Cutting,
    /// The tools: one or two, with different names.
    pub tools: Vec<Tool>,
    /// The view of the scene.
    pub view: View,
    /// The task.
    pub task: Task,
    /// The draws to make before a simulation ([`Scene::drawn`]); none for a scene of fixed numbers.
    pub draws: Option<Draws>,
    /// Which variant of a task it is; none for a scene that was not drawn.
    pub variant: Option<Variant>,
    /// Its text, which means the same in any folder ([`self_contained`]); none after a change.
    pub written: Option<String>,
    /// Warnings about its numbers, as sentences; none after a change.
    pub warnings: Vec<String>,
}

impl Scene {
    /// The keys of a scene, without `format`.
    pub const KEYS: &'static [Key] = &[
        Key::table_or_tables(
            "organ",
            Organ::KEYS,
            "The organ that is touched. As a list, `[[organ]]`, the first is this one, and further ones are bodies beside it that \
             bend, as a `[[neighbour]]` with a tissue does.",
        )
        .required(""),
        Key::tables(
            "neighbour",
            Neighbour::KEYS,
            "Bodies that are shown with the organ: rigid ones, and those that bend.",
        )
        .optional("", "none"),
        Key::table("model", Model::KEYS, "How the organ is moved.").optional("", "the defaults of its keys"),
        Key::table("cutting", Cutting::KEYS, "How the organ is cut.")
            .optional("", "the defaults of its keys"),
        Key::tables("tool", Tool::KEYS, "The tools: one, or one for each hand.")
            .optional("", "one probe, which the mouse moves"),
        Key::table(
            "view",
            View::KEYS,
            "The camera; without these keys it is placed so that the organ fills the picture.",
        )
        .optional("", "the defaults of its keys"),
        Key::table("task", Task::KEYS, "What there is to do, and how a performance is judged.")
            .optional("", "nothing"),
        Key::named(
            "draw",
            draw::DRAW,
            "Values that are drawn for each attempt, by name. `{ draw = \"NAME\" }` takes one in place of any value.",
        )
        .optional("", "every attempt is the same"),
        Key::table(
            "variant",
            Variant::KEYS,
            "What was drawn of a scene with `[draw]`. The program writes it.",
        )
        .optional("", "nothing"),
    ];

    /// Reads a scene file.
    ///
    /// # Errors
    /// When the file cannot be read or does not describe a scene.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_DOCUMENT_BYTES)?, path)
    }

    /// Reads the text of a scene file; `path` is its name in errors, and relative paths in the
    /// scene begin in its folder.
    ///
    /// # Errors
    /// When the text does not describe a scene.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let mut document = Document::parse(text, path)?;
        let draws = document.change(Draws::take)?;
        let keys = document.keys(Self::KEYS)?;
        let organs = keys.tables("organ")?;
        let Some((organ, further)) = organs.split_first() else {
            return Err(keys.missing("organ", "a table `[organ]`"));
        };
        let neighbours = keys.tables("neighbour")?;
        let touched = Organ::from_keys(organ, &folder)?;
        let tools = tool::from_keys(&keys, &folder)?;
        let cutting = keys.table("cutting")?;
        let model = keys.table("model")?;
        let rigid_or_soft = neighbours
            .iter()
            .map(|keys| Neighbour::from_keys(keys, &folder));
        let organs = further
            .iter()
            .map(|keys| Neighbour::of_organ(keys, &folder));
        let around: Vec<Neighbour> = rigid_or_soft.chain(organs).collect::<Result<_, _>>()?;
        let does = Requirements {
            cuts: cutting.is_some(),
            bends: touched.self_contact || around.iter().any(|body| body.soft.is_some()),
            is_hollow: touched.inclusions.iter().any(|own| own.cavity().is_some()),
        };
        let model = Model::from_keys(model.as_ref(), &touched, &tools, does)?;
        if model.kind != ModelKind::Nonlinear {
            organ::refuse_cavities(organ)?;
            if let Some(second) = further.first() {
                let shape = ["mesh", "builtin"]
                    .into_iter()
                    .find(|key| second.contains(key));
                return Err(second.invalid(
                    shape.unwrap_or("mesh"),
                    "one organ, for only `model.kind = \"nonlinear\"` has several; or a rigid `[[neighbour]]`",
                ));
            }
            for keys in &neighbours {
                if let Some(key) = neighbour::tissue_key(keys) {
                    keys.refuse(
                        key,
                        "nothing, for only `model.kind = \"nonlinear\"` bends a neighbour",
                    )?;
                }
            }
        }
        let neighbours = around;
        if let Some(draws) = &draws {
            draws.check_neighbours(neighbours.len())?;
        }
        let around = TaskScene {
            layers: touched.layers.len(),
            tools: &tools,
            neighbours: &neighbours,
        };
        let task = Task::from_keys(keys.table("task")?.as_ref(), &folder, &around)?;
        let mut scene = Self {
            organ: touched,
            neighbours,
            model,
            cutting: Cutting::from_keys(cutting.as_ref())?,
            tools,
            view: View::from_keys(keys.table("view")?.as_ref())?,
            task,
            folder,
            draws,
            variant: Variant::from_keys(&keys)?,
            written: Some(self_contained(text, path)?),
            warnings: keys.warnings(),
        };
        if let Some(reason) = model.reason {
            scene.warnings.push(format!(
                "{}: model.kind = \"auto\" is {:?}, for {reason}",
                path.display(),
                model.kind.word()
            ));
        }
        if scene.lacks_anchor() {
            return Err(organ.missing(
                "anchor",
                "fixed regions, such as `[organ.anchor]` with `planes`, \
                 for a global model needs a fixed part of the body",
            ));
        }
        Ok(scene)
    }

    /// Built-in organs are fixed at their attachment; a mesh is fixed only where the scene states it.
    fn lacks_anchor(&self) -> bool {
        self.model.kind != ModelKind::Local
            && matches!(self.organ.shape, Shape::Mesh { .. })
            && self.organ.anchor.as_ref().is_none_or(Region::is_empty)
    }
}
