//! Pictures without a window: of a state of a simulation, and evenly over a motion.
//!
//! *How we know*: `golden::…`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::RgbaImage;
use palpate_files::{Scene, scene, write_atomically};
use palpate_geometry::{Surface, TriangleMesh, Vec3};
use palpate_simulate::interactive::OpenedSnapshot;
use palpate_simulate::{Frame, Simulation, SimulationState, read_neighbour};

use crate::displayed_organ::DisplayedOrgan;
use crate::render::{
    Body, Label, LabelTarget, Labels, Looks, Renderer, Target, Tint, ToolPicture, View,
    single_precision,
};
use crate::{Error, Gpu, TissuePicture, scene_camera};

/// Width and height of a frame [pixels].
pub const FRAME_SIZE: (u32, u32) = (1280, 800);

/// A scene that pictures are taken of.
pub struct Studio {
    /// The renderer.
    pub gpu: Gpu,
    /// How it is looked at.
    pub view: View,
    renderer: Renderer,
    organ: DisplayedOrgan,
    neighbours: Vec<Body>,
    tools: Vec<DisplayedTool>,
    target: Target,
    /// Once labels were asked for.
    labels: Option<LabelTarget>,
    surface: Surface,
    opened: OpenedSnapshot,
    /// Bodies drawn with the organ, such as its wire frame.
    pub other_bodies: Vec<Body>,
}

impl Studio {
    /// The scene of a simulation at rest, as the scene wants to be looked at, in pictures of `size`
    /// [pixels].
    ///
    /// # Errors
    /// When there is no adapter or a neighbour cannot be read.
    pub fn new(scene: &Scene, simulation: &Simulation, size: (u32, u32)) -> Result<Self, Error> {
        Self::with_gpu(Gpu::open()?, scene, simulation, size)
    }

    /// The same on an adapter that is open.
    ///
    /// # Errors
    /// When a neighbour cannot be read.
    pub fn with_gpu(
        gpu: Gpu,
        scene: &Scene,
        simulation: &Simulation,
        size: (u32, u32),
    ) -> Result<Self, Error> {
        let mesh = simulation.surface().mesh();
        let aspect = f64::from(size.0) / f64::from(size.1);
        let neighbours = scene
            .neighbours
            .iter()
            .filter(|neighbour| neighbour.soft.is_none())
            .map(|neighbour| {
                let (surface, _) = read_neighbour(neighbour)?;
                let tint = Tint::of(&neighbour.shape).receding();
                Ok(Body::new(&gpu, &surface, tint).labelled(Label::Neighbour))
            })
            .collect::<Result<_, Error>>()?;
        let (low, high) = mesh.bounds();
        Ok(Self {
            renderer: Renderer::new(&gpu),
            organ: DisplayedOrgan::new(&gpu, simulation, Tint::of(&scene.organ.shape))?,
            neighbours,
            tools: seen_tools(scene, simulation),
            target: Target::new(&gpu, size, 4),
            labels: None,
            surface: simulation.surface().clone(),
            opened: OpenedSnapshot::default(),
            other_bodies: Vec::new(),
            view: View {
                camera: scene_camera(&scene.view, mesh, None, aspect),
                shading: scene.view.shading,
                looks: Looks::ALL,
                reach: (high - low).norm(),
            },
            gpu,
        })
    }

    /// Lays `picture` around the organ; none is the inside of an abdomen.
    pub fn surround(&mut self, picture: Option<&TissuePicture>) {
        self.renderer.surround(&self.gpu, picture);
    }

    /// A picture of `state`.
    ///
    /// # Errors
    /// When the adapter was lost.
    pub fn picture(&mut self, state: &SimulationState) -> Result<RgbaImage, Error> {
        self.take(state);
        self.draw(state)
    }

    /// How far everything in the picture of `state` is, and what it is.
    ///
    /// # Errors
    /// When the adapter cannot draw it, or was lost.
    pub fn labels(&mut self, state: &SimulationState) -> Result<Labels, Error> {
        self.take(state);
        let size = self.target.size();
        let target = match &mut self.labels {
            Some(target) => target,
            none => none.insert(LabelTarget::new(&self.gpu, size)?),
        };
        let bodies: Vec<&Body> = self.organ.bodies().chain(&self.neighbours).collect();
        let tools = tool_pictures(&self.tools, state);
        self.renderer
            .measure(&self.gpu, &self.view, &bodies, &tools, target);
        target.read(&self.gpu)
    }

    /// Forgets the openings of the last picture: the next one is of another organ, whose cuts are counted anew.
    pub fn forget_cuts(&mut self) {
        self.opened = OpenedSnapshot::default();
        self.organ.close();
    }

    /// Moves the organ to where `state` has it, with its openings.
    fn take(&mut self, state: &SimulationState) {
        let mut opened = std::mem::take(&mut self.opened);
        if let Some(cuts) = &state.cuts {
            opened.fill(cuts, state);
        }
        let is_cut = opened.version > 0;
        self.shape(state, is_cut.then_some(&opened));
        self.opened = opened;
    }

    /// A picture of `state` with these openings in place of those that it has.
    ///
    /// # Errors
    /// When the adapter was lost.
    pub fn picture_of(
        &mut self,
        state: &SimulationState,
        opening: Option<&OpenedSnapshot>,
    ) -> Result<RgbaImage, Error> {
        self.shape(state, opening);
        self.draw(state)
    }

    fn shape(&mut self, state: &SimulationState, opening: Option<&OpenedSnapshot>) {
        let vertices = single_precision(state.deformed.vertices());
        match opening {
            Some(opening) => {
                self.organ
                    .open(&self.gpu, opening, &self.surface, &vertices);
            }
            None => self
                .organ
                .deform(&self.gpu, &vertices, state.organ_field.as_ref()),
        }
    }

    fn draw(&mut self, state: &SimulationState) -> Result<RgbaImage, Error> {
        let bodies: Vec<&Body> = self
            .organ
            .bodies()
            .chain(&self.other_bodies)
            .chain(&self.neighbours)
            .collect();
        let tools = tool_pictures(&self.tools, state);
        self.renderer
            .draw(&self.gpu, &self.view, &bodies, &tools, &self.target);
        self.target.read(&self.gpu)
    }
}

/// A tool of a scene, and what it looks like if not as its kind does.
pub type DisplayedTool = (scene::Tool, Option<Arc<TriangleMesh>>);

fn seen_tools(scene: &Scene, simulation: &Simulation) -> Vec<DisplayedTool> {
    let looks = simulation
        .tools()
        .iter()
        .map(|tool| tool.display_mesh.clone());
    scene.tools.iter().cloned().zip(looks).collect()
}

/// The tools that are there, as a state has them.
pub fn tool_pictures(tools: &[DisplayedTool], state: &SimulationState) -> Vec<ToolPicture> {
    tools
        .iter()
        .zip(&state.tools)
        .zip(0..)
        .filter(|((_, own), _)| own.pose.is_some())
        .map(|(((tool, look), own), number)| {
            let row = &own.row;
            let picture = ToolPicture::new(tool, row.position_m, row.orientation)
                .looking_like(look.as_ref())
                .gripping(row.grip)
                .labelled(Label::Tool(number));
            match &own.contact {
                Some(contact) => picture.touching(contact.point()),
                None => picture,
            }
        })
        .collect()
}

/// Writes pictures at even times of a motion: `frame-0001.png` and so on.
pub struct FrameWriter {
    studio: Studio,
    folder: PathBuf,
    wanted: u64,
    written: Vec<PathBuf>,
}

impl FrameWriter {
    /// Writes `wanted` pictures into `folder`, which exists.
    ///
    /// # Errors
    /// When there is no adapter or a neighbour cannot be read.
    pub fn new(
        scene: &Scene,
        simulation: &Simulation,
        folder: &Path,
        wanted: u64,
    ) -> Result<Self, Error> {
        Ok(Self {
            studio: Studio::new(scene, simulation, FRAME_SIZE)?,
            folder: folder.to_owned(),
            wanted,
            written: Vec::new(),
        })
    }

    /// From the side of the organ where `place` [m] is, unless the scene says where the eye is.
    #[must_use]
    pub fn facing(mut self, scene: &Scene, simulation: &Simulation, place: &Vec3) -> Self {
        let (width, height) = FRAME_SIZE;
        let mesh = simulation.surface().mesh();
        let aspect = f64::from(width) / f64::from(height);
        self.studio.view.camera = scene_camera(&scene.view, mesh, Some(place), aspect);
        self
    }

    /// Writes this step's picture when it is due: the first step's, and so on to the last.
    ///
    /// # Errors
    /// When the adapter was lost or the file cannot be written.
    pub fn add(&mut self, frame: &Frame<'_>) -> Result<(), Error> {
        let count = self.written.len() as u64;
        if !frame.is_due(count, self.wanted) {
            return Ok(());
        }
        let picture = self.studio.picture(frame.state)?;
        let path = self.folder.join(format!("frame-{:04}.png", count + 1));
        write_atomically(&path, &png(&picture)?)?;
        self.written.push(path);
        Ok(())
    }

    /// The files that were written.
    pub fn finish(self) -> Vec<PathBuf> {
        self.written
    }
}

/// `picture` as a PNG file.
///
/// # Errors
/// When it is larger than memory.
pub fn png(picture: &RgbaImage) -> Result<Vec<u8>, Error> {
    use image::codecs::png::{CompressionType, FilterType, PngEncoder};
    let mut bytes = std::io::Cursor::new(Vec::new());
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    // Pictures are opaque.
    let opaque = image::DynamicImage::ImageRgba8(picture.clone()).into_rgb8();
    opaque
        .write_with_encoder(encoder)
        .map_err(|cause| Error::Unencodable {
            cause: cause.to_string(),
        })?;
    Ok(bytes.into_inner())
}
