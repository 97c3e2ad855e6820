use std::ops::ControlFlow;
use std::sync::Arc;

use palpate_files::{Scene, Session};
use palpate_geometry::{AabbTree, Surface, Vec3};
use palpate_servo::{PointerHand, ServoSettings, lock_memory};
use palpate_simulate::interactive::{
    CUTS, Environment, Interaction, ModelCommand, PreparedModel, SceneDevices,
};
use palpate_simulate::{Progress, Replay, Resources, Simulation, read_neighbour};

use super::PlayedSession;
use super::covered::is_covered;
use super::hands::Hand;
use super::source::{Playback, Source};
use crate::displayed_organ::DisplayedOrgan;
use crate::render::{Body, Tint};
use crate::{Error, Gpu};

/// Request of a key to the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ModelRequest {
    /// The last cut is taken back.
    UndoCut,
    /// It stops, or goes on.
    Pause,
    /// The organ is as it was at the start.
    Reset,
    /// This place is meant, or it is done.
    Mark,
    /// The trainee states this diameter [m].
    StateDiameter(f64),
}

/// A scene that can be touched, once its devices are there.
pub(super) struct Prepared {
    scene: Scene,
    simulation: Arc<Simulation>,
    tree: AabbTree,
    organ: DisplayedOrgan,
    neighbours: Vec<Body>,
    warnings: Vec<String>,
    resources: Resources,
    /// None for a session that is played again.
    model: Option<PreparedModel>,
}

/// A scene that is being touched.
pub(super) struct Play {
    pub(super) scene: Scene,
    pub(super) simulation: Arc<Simulation>,
    /// Around the organ at rest.
    pub(super) tree: AabbTree,
    pub(super) source: Source,
    pub(super) organ: DisplayedOrgan,
    pub(super) neighbours: Vec<Body>,
    /// Warnings.
    pub(super) warnings: Vec<String>,
    /// Bounds of the models that acted since the start.
    pub(super) limits: Vec<String>,
    pointers: Vec<Option<PointerHand>>,
}

impl Prepared {
    /// Reads and prepares what `scene` names. It may be called on any thread; `watch` receives the progress, and may
    /// cancel it.
    ///
    /// # Errors
    /// When a file is missing or wrong.
    pub(super) fn of(
        scene: Scene,
        resources: &Resources,
        gpu: &Gpu,
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let simulation = Arc::new(Simulation::prepare(&scene, resources, watch)?);
        let model = PreparedModel::new(simulation.clone());
        let around = Self::around(scene, simulation, resources.clone(), gpu)?;
        Ok(Self {
            model: Some(model),
            ..around
        })
    }

    /// View of an existing simulation.
    fn around(
        scene: Scene,
        simulation: Arc<Simulation>,
        resources: Resources,
        gpu: &Gpu,
    ) -> Result<Self, Error> {
        let mut warnings = simulation.warnings().to_vec();
        let mut neighbours = Vec::new();
        for neighbour in scene.neighbours.iter().filter(|own| own.soft.is_none()) {
            let (surface, more) = read_neighbour(neighbour)?;
            warnings.extend(more);
            let tint = Tint::of(&neighbour.shape).receding();
            neighbours.push(Body::new(gpu, &surface, tint));
        }
        Ok(Self {
            tree: AabbTree::new(simulation.surface().mesh()),
            organ: DisplayedOrgan::new(gpu, &simulation, Tint::of(&scene.organ.shape))?,
            neighbours,
            warnings,
            simulation,
            scene,
            resources,
            model: None,
        })
    }

    /// Whether a tool is moved by a device that only one may drive.
    pub(super) fn has_devices(&self) -> bool {
        SceneDevices::any(&self.scene)
    }
}

impl Play {
    /// Whether a tool is moved by a device that displays forces.
    pub(super) fn has_devices(&self) -> bool {
        SceneDevices::any(&self.scene)
    }

    /// Opens the devices and starts the threads of the touch. Whatever had these devices before has to be gone: only
    /// one may drive them.
    ///
    /// # Errors
    /// When a device is missing, or a thread does not start.
    pub(super) fn start(mut prepared: Prepared, is_ended: fn() -> bool) -> Result<Self, Error> {
        if prepared.has_devices() {
            lock_memory();
        }
        let (scene, simulation) = (&prepared.scene, prepared.simulation.clone());
        let devices = SceneDevices::open(scene, &simulation, &prepared.resources.devices)?;
        let model = prepared.model.take();
        let interaction = Interaction::start_in(
            &environment(&prepared.resources, is_ended),
            model.unwrap_or_else(|| PreparedModel::new(simulation)),
            devices.devices,
            ServoSettings::default(),
        )?;
        let source = Source::Live(Box::new(interaction));
        Ok(Self::of(prepared, source, devices.pointers))
    }

    /// Goes on with what was prepared, while the devices stay open and their loops run. Whether the touch could: else it
    /// is as before.
    pub(super) fn take_over(&mut self, prepared: &mut Prepared, is_ended: fn() -> bool) -> bool {
        let (Source::Live(touch), Some(model)) = (&mut self.source, prepared.model.take()) else {
            return false;
        };
        let environment = environment(&prepared.resources, is_ended);
        touch.replace_model(&environment, model).is_ok()
    }

    /// Shows `prepared` from now on, whose model has taken over.
    pub(super) fn showing(self, prepared: Prepared) -> Self {
        Self::of(prepared, self.source, self.pointers)
    }

    /// A session that is played again.
    ///
    /// # Errors
    /// When a neighbour cannot be read.
    pub(super) fn of_session(session: PlayedSession, gpu: &Gpu) -> Result<Self, Error> {
        let playback = Playback::new(&session.simulation, session.replay);
        let nobody = session.scene.tools.iter().map(|_| None).collect();
        let prepared =
            Prepared::around(session.scene, session.simulation, Resources::default(), gpu)?;
        let source = Source::Replay(Box::new(playback));
        Ok(Self::of(prepared, source, nobody))
    }

    /// A session on the organ that is shown, called `name`.
    ///
    /// # Errors
    /// When the session is of another scene.
    pub(super) fn played_session(
        &self,
        name: String,
        session: &Session,
    ) -> Result<PlayedSession, Error> {
        Ok(PlayedSession {
            name,
            scene: self.scene.clone(),
            replay: Replay::new(self.simulation.clone(), session)?,
            simulation: self.simulation.clone(),
        })
    }

    fn of(prepared: Prepared, source: Source, pointers: Vec<Option<PointerHand>>) -> Self {
        Self {
            scene: prepared.scene,
            simulation: prepared.simulation,
            tree: prepared.tree,
            source,
            organ: prepared.organ,
            neighbours: prepared.neighbours,
            warnings: prepared.warnings,
            limits: Vec::new(),
            pointers,
        }
    }

    /// Takes over which bounds of the models have acted.
    pub(super) fn refresh_limits(&mut self) {
        let snapshot = self.source.snapshot();
        self.limits = snapshot.warnings(self.simulation.tools());
    }

    /// The organ at rest.
    pub(super) fn surface(&self) -> &Surface {
        self.simulation.surface()
    }

    /// Whether the organ, as it is now, lies between an `eye` and a `place` [m].
    pub(super) fn covers(&mut self, place: &Vec3, eye: &Vec3) -> bool {
        let triangles = self.simulation.surface().mesh().triangles();
        is_covered(&self.source.snapshot().vertices, triangles, place, eye)
    }

    /// Moves the tool of a hand to where the hand is, with its grip and its cut; from `start` [m] without a
    /// way there, if that is given.
    pub(super) fn hold(&mut self, tool: usize, hand: &Hand, start: Option<Vec3>) {
        let (Some(Some(pointer)), Some((tip, _))) = (self.pointers.get_mut(tool), hand.place)
        else {
            return;
        };
        pointer.turn_to(hand.turned());
        pointer.press(hand.grip, if hand.cuts { CUTS } else { 0 });
        match start {
            Some(start) => pointer.move_from(start, tip),
            None => pointer.move_to(tip),
        }
    }

    /// Sends a request to the model.
    pub(super) fn send(&mut self, request: ModelRequest) {
        let command = match request {
            ModelRequest::UndoCut => ModelCommand::UndoCut,
            ModelRequest::Reset => ModelCommand::Reset,
            ModelRequest::Mark => ModelCommand::Mark,
            ModelRequest::StateDiameter(diameter) => ModelCommand::StateDiameter(diameter),
            ModelRequest::Pause if self.source.snapshot().paused => ModelCommand::Resume,
            ModelRequest::Pause => ModelCommand::Pause,
        };
        self.source.send(command);
    }

    /// Makes the organ whole and at rest, and goes on if all stood still.
    pub(super) fn reset(&mut self) {
        self.go_on();
        self.source.send(ModelCommand::Reset);
    }

    /// Goes on, if all stood still.
    pub(super) fn go_on(&mut self) {
        self.source.send(ModelCommand::Resume);
    }
}

fn environment(resources: &Resources, is_ended: fn() -> bool) -> Environment<'_> {
    Environment {
        publishers: &resources.publishers,
        is_ended,
    }
}
