use std::ops::ControlFlow;
use std::sync::Arc;

use palpate_files::Scene;
use palpate_geometry::{AabbTree, Surface};
use palpate_servo::{PointerHand, ServoSettings};
use palpate_simulate::interactive::{Interaction, SceneDevices};
use palpate_simulate::{Progress, Resources, Simulation, read_organ};

use super::gesture::Aim;
use crate::render::{Body, Tint};
use crate::seen_organ::SeenOrgan;
use crate::{Error, Gpu};

/// A scene that is being touched.
pub(super) struct Play {
    pub(super) scene: Scene,
    pub(super) simulation: Arc<Simulation>,
    /// Around the organ at rest.
    pub(super) tree: AabbTree,
    pub(super) interaction: Interaction,
    pub(super) organ: SeenOrgan,
    pub(super) neighbours: Vec<Body>,
    /// What deserves doubt.
    pub(super) doubts: Vec<String>,
    hands: Vec<Option<PointerHand>>,
}

impl Play {
    /// Reads and prepares what `scene` names, and starts the threads of the touch. It may be called on any
    /// thread; `watch` hears how far it is, and may break it off.
    ///
    /// # Errors
    /// When a file is missing or wrong, a device has no driver, or a thread does not start.
    pub(super) fn start(
        scene: Scene,
        resources: &Resources,
        gpu: &Gpu,
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<Self, Error> {
        let simulation = Arc::new(Simulation::prepare(&scene, resources, watch)?);
        let mut doubts = simulation.doubts().to_vec();
        let mut neighbours = Vec::new();
        for neighbour in &scene.neighbours {
            let (surface, more) = read_organ(&neighbour.shape)?;
            doubts.extend(more);
            let tint = Tint::of(&neighbour.shape).receding();
            neighbours.push(Body::new(gpu, &surface, tint));
        }
        let devices = SceneDevices::open(&scene, &simulation)?;
        let interaction = Interaction::start(
            simulation.clone(),
            devices.stations,
            ServoSettings::default(),
        )?;
        Ok(Self {
            tree: AabbTree::new(simulation.surface().mesh()),
            organ: SeenOrgan::new(gpu, &simulation, Tint::of(&scene.organ.shape))?,
            neighbours,
            doubts,
            interaction,
            hands: devices.pointers,
            simulation,
            scene,
        })
    }

    /// The organ at rest.
    pub(super) fn surface(&self) -> &Surface {
        self.simulation.surface()
    }

    /// Moves the hand of a tool.
    pub(super) fn move_hand(&mut self, tool: usize, aim: &Aim) {
        if let Some(Some(hand)) = self.hands.get_mut(tool) {
            hand.turn_to(Some(aim.turned));
            match aim.from {
                Some(start) => hand.move_from(start, aim.tip),
                None => hand.move_to(aim.tip),
            }
        }
    }
}
