//! Jaws that hold tissue, pull it, lose some of it and let it go.
//!
//! Jaws that shut take hold of what lies in the box that they sweep (`jaws`): in the whole organ of the
//! triangles there (`patch`, solved in `global/held.rs`), else of the place under the tip (`place`). From then
//! on the tissue goes with the tool as a rigid body does, and the tool feels all that it answers, pull too. The
//! tip itself touches nothing as long: its force at that moment becomes the first of the patch, so that
//! taking hold makes no jump.
//!
//! The jaws press on what is between them as on a column of rubber, at most with their own force, and it
//! slips between two faces (`slip`):
//!
//! ```text
//! N = min(F_jaws, E A/3 (λ⁻² − λ)),   λ = gap/thickness,   |pull| ≤ 2 μ N
//! ```
//!
//! Tissue that has slid by the length of the jaws is gone, and so is that between jaws that open.
//!
//! *How we know*: `grip::…`.
//!
//! *Limits*: small strain, however far the pull; a tool feels a force and no torque, so that work done by
//! turning it is not felt; what is pulled across the jaws (along the tool's x) never slips; the patch keeps its
//! size while it slides.

mod hold;
mod jaws;
mod place;
mod slip;

use palpate_files::Pose;
use palpate_files::session::{Event, Events};
use palpate_geometry::Vec3;
use palpate_mechanics::finite_spheres::LocalContact;

pub(crate) use hold::{
    Held, HeldArea, HeldPart, HeldPatch, HeldTriangle, Hold, MOST_PARTS, MOST_TRIANGLES, SeenHold,
};
pub(crate) use jaws::Swept;
pub(crate) use place::{HeldPlace, answer};

use crate::simulation::Simulation;
use crate::state::{SimulationState, SimulationWorkspace, ToolState};
use crate::step::respond_again;
use crate::tool::Tool;
use slip::Slides;

/// Jaws that shut beyond this take hold of what is between them [-], and let go when they open to less than
/// the other: a hand that trembles does neither.
const TAKES_HOLD: f64 = 0.6;
const LETS_GO: f64 = 0.4;

/// How often slips are looked for in a step, each changing what the other tool feels.
const MOST_SLIPS: usize = 12;

/// What the jaws of a tool do.
#[derive(Debug, Clone)]
pub(crate) struct Grip {
    /// A tool that comes with shut jaws has nothing between them.
    shut: bool,
    /// Whether they shut in this step.
    shuts: bool,
    pub(crate) hold: Option<Hold>,
    slides: Slides,
}

impl Default for Grip {
    fn default() -> Self {
        Self {
            shut: true,
            shuts: false,
            hold: None,
            slides: Slides::NONE,
        }
    }
}

/// Moves what the jaws hold along with the tool, or lets it go where they open.
pub(crate) fn follow(tool: &Tool, pose: Option<Pose>, state: &mut ToolState) -> Events {
    let own = &mut state.grip;
    let was_shut = own.shut;
    let grip = pose.map_or(1.0, |pose| pose.grip);
    own.shut = grip > if was_shut { LETS_GO } else { TAKES_HOLD };
    own.shuts = own.shut && !was_shut && tool.jaws.is_some();
    if let (Some(hold), Some(pose), true) = (&mut own.hold, pose, own.shut) {
        hold.follow(tool, &pose);
        return Events::NONE;
    }
    match own.hold.take() {
        Some(_) => [Event::GripRelease].into_iter().collect(),
        None => Events::NONE,
    }
}

/// After the forces of a step are found: jaws that have shut take hold, and held tissue slips where it is
/// pulled too hard.
pub(crate) fn act(
    simulation: &Simulation,
    elapsed: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    for number in 0..simulation.tools.len() {
        if state.tools[number].grip.shuts {
            take_hold(simulation, number, state, workspace);
        }
    }
    // What one tool loses, the others feel.
    slide(simulation, elapsed, state, workspace);
    while lose(simulation, state, workspace) {
        slide(simulation, elapsed, state, workspace);
    }
    for (tool, own) in simulation.tools.iter().zip(&mut state.tools) {
        own.grip_force = own.press(simulation, tool);
    }
}

/// Until no tool pulls more than it can hold.
fn slide(
    simulation: &Simulation,
    elapsed: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    for own in &mut state.tools {
        own.grip.slides = Slides::NONE;
    }
    for _ in 0..MOST_SLIPS {
        let mut slipped = false;
        for (tool, own) in simulation.tools.iter().zip(&mut state.tools) {
            slipped |= slip::slip(simulation, tool, elapsed, own);
        }
        if !slipped {
            return;
        }
        respond_again(simulation, state, workspace);
    }
}

/// Lets go what has slid out of its jaws; whether there was any.
fn lose(
    simulation: &Simulation,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) -> bool {
    let mut lost = false;
    for (tool, own) in simulation.tools.iter().zip(&mut state.tools) {
        let length = tool.jaws.map_or(0.0, |jaws| jaws.length_m);
        let gone = |hold: &mut Hold| hold.slid().norm() >= length;
        if own.grip.hold.take_if(gone).is_some() {
            own.row.events.insert(Event::GripRelease);
            own.row.events.insert(Event::Release);
            lost = true;
        }
    }
    if lost {
        respond_again(simulation, state, workspace);
    }
    lost
}

fn take_hold(
    simulation: &Simulation,
    number: usize,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    let touched = state.tools[number].contact.is_some();
    let took = if let (Some(global), Some(workspace)) = (&simulation.global, &mut workspace.global)
    {
        global.take_hold(simulation, number, &mut state.tools, workspace)
    } else if let Some(organ) = state.bent_organ() {
        organ.take_hold(simulation, number, state)
    } else {
        let tool = &simulation.tools[number];
        let workspace = &mut workspace.models[number];
        place::take_hold(simulation, tool, &mut state.tools[number], workspace)
    };
    let own = &mut state.tools[number];
    if let (true, Some(at)) = (took, own.grip.hold.as_ref().map(Hold::place)) {
        own.contact = None;
        own.row.events.insert(Event::Grip);
        if !touched {
            own.row.events.insert(Event::Contact);
            own.forget_elsewhere(&simulation.tools[number], &at);
        }
    }
}

impl Grip {
    /// What is held of the whole organ.
    pub(crate) fn patch(&self) -> Option<&HeldPatch> {
        self.hold.as_ref()?.patch()
    }

    /// The held place of the local model, and how far it is displaced [m].
    pub(crate) fn shown_place(&self) -> Option<(LocalContact, Vec3)> {
        let hold = self.hold.as_ref()?;
        match &hold.held {
            Held::Place(held) => Some((held.place, hold.displaced())),
            Held::Patch(_) | Held::Area(_) => None,
        }
    }
}

impl ToolState {
    /// Whether its jaws hold tissue.
    pub fn holds(&self) -> bool {
        self.grip.hold.is_some()
    }

    /// Whether its tip touches the organ or its jaws hold it.
    pub(crate) fn touches(&self) -> bool {
        self.contact.is_some() || self.holds()
    }

    /// How far the tissue between its jaws is from its rest [m].
    pub(crate) fn pulled(&self) -> f64 {
        let hold = self.grip.hold.as_ref();
        hold.map_or(0.0, |hold| hold.displaced().norm())
    }

    /// With how much each jaw presses on what they hold [N].
    fn press(&self, simulation: &Simulation, tool: &Tool) -> f64 {
        let modulus = simulation.material.at_rest.youngs_modulus();
        match (&self.grip.hold, &tool.jaws, &self.pose) {
            (Some(hold), Some(jaws), Some(pose)) => {
                jaws::press(jaws, hold.area, hold.thickness, pose.grip, modulus)
            }
            _ => 0.0,
        }
    }

    /// The rotation of its jaws; where neither trocar nor quaternion says it, that of the surface at its
    /// contact, or upright.
    fn turned(&self, tool: &Tool, pose: &Pose) -> nalgebra::UnitQuaternion<f64> {
        let normal = self.contact.map(|contact| contact.normal());
        crate::orientation::orientation(
            &Vec3::from(pose.position_m),
            tool.trocar.as_ref(),
            pose.orientation,
            normal.as_ref(),
        )
    }

    /// The box that its jaws sweep.
    pub(crate) fn swept(&self, tool: &Tool) -> Option<Swept> {
        let (pose, jaws) = (self.pose?, tool.jaws?);
        let tip = Vec3::from(pose.position_m);
        Some(Swept::new(
            &jaws,
            tip,
            self.turned(tool, &pose),
            tool.overhang(),
        ))
    }
}
