//! Grasping: jaws hold tissue, pull it, lose some of it and release it.
//!
//! Jaws that shut grasp the tissue in the box that they sweep (`jaws`): in the organ-scale model the triangles there
//! (`patch`, solved in `global/held.rs`), else the place under the tip (`place`). From then on the tissue moves with
//! the tool as a rigid body, and the tool feels its whole reaction, pull included. The tip itself has no contact
//! meanwhile: its force at that moment becomes the first of the patch, so that grasping causes no jump.
//!
//! The jaws compress the tissue between them like a column of rubber, at most with their own force, and it slips
//! between two faces (`slip`):
//!
//! ```text
//! N = min(F_jaws, E A/3 (λ⁻² − λ)),   λ = gap/thickness,   |pull| ≤ 2 μ N
//! ```
//!
//! Tissue that has slid by the length of the jaws is lost, and so is tissue between jaws that open.
//!
//! *How we know*: `grip::…`.
//!
//! *Limits*: small strain, however far the pull; a tool feels a force and no torque, so that turning the tool does no
//! work on the hand; a pull across the jaws (along the tool's x) never causes slip; the patch keeps its size while it
//! slides.

mod grasp;
mod jaws;
mod place;
mod slip;

use palpate_files::Pose;
use palpate_files::session::{Event, Events};
use palpate_geometry::Vec3;
use palpate_mechanics::finite_spheres::LocalContact;

pub(crate) use grasp::{
    DisplayedGrasp, Grasp, Grasped, GraspedArea, GraspedPart, GraspedPatch, GraspedTriangle,
    MAX_PARTS, MAX_TRIANGLES,
};
pub(crate) use jaws::Swept;
pub(crate) use place::{GraspedPlace, answer};

use crate::simulation::Simulation;
use crate::state::{SimulationState, SimulationWorkspace, ToolState};
use crate::step::respond_again;
use crate::tool::Tool;
use slip::Slides;

/// Jaws that shut beyond the first value grasp the tissue between them [-], and release it when they open to less than
/// the second: the hysteresis ignores a trembling hand.
const GRASPS_ABOVE: f64 = 0.6;
const RELEASES_BELOW: f64 = 0.4;

/// Passes for slip in a step, since each slip changes the force on the other tool.
const MAX_SLIPS: usize = 12;

/// The state of a tool's jaws.
#[derive(Debug, Clone)]
pub(crate) struct Grip {
    /// A tool that appears with shut jaws has nothing between them.
    shut: bool,
    /// Whether they shut in this step.
    shuts: bool,
    pub(crate) grasp: Option<Grasp>,
    slides: Slides,
}

impl Default for Grip {
    fn default() -> Self {
        Self {
            shut: true,
            shuts: false,
            grasp: None,
            slides: Slides::NONE,
        }
    }
}

/// Moves the held tissue with the tool, or releases it where the jaws open.
pub(crate) fn follow(tool: &Tool, pose: Option<Pose>, state: &mut ToolState) -> Events {
    let own = &mut state.grip;
    let was_shut = own.shut;
    let grip = pose.map_or(1.0, |pose| pose.grip);
    own.shut = grip
        > if was_shut {
            RELEASES_BELOW
        } else {
            GRASPS_ABOVE
        };
    own.shuts = own.shut && !was_shut && tool.jaws.is_some();
    if let (Some(hold), Some(pose), true) = (&mut own.grasp, pose, own.shut) {
        hold.follow(tool, &pose);
        return Events::NONE;
    }
    match own.grasp.take() {
        Some(_) => [Event::GripRelease].into_iter().collect(),
        None => Events::NONE,
    }
}

/// After the forces of a step are known: jaws that have shut grasp, and held tissue slips where the pull exceeds
/// friction.
pub(crate) fn act(
    simulation: &Simulation,
    elapsed: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    for number in 0..simulation.tools.len() {
        if state.tools[number].grip.shuts {
            grasp(simulation, number, state, workspace);
        }
    }
    // The other tools take over the load that one tool loses.
    slide(simulation, elapsed, state, workspace);
    while lose(simulation, state, workspace) {
        slide(simulation, elapsed, state, workspace);
    }
    for (tool, own) in simulation.tools.iter().zip(&mut state.tools) {
        own.grip_force = own.press(simulation, tool);
    }
}

/// Repeats until no tool pulls more than it can hold.
fn slide(
    simulation: &Simulation,
    elapsed: f64,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    for own in &mut state.tools {
        own.grip.slides = Slides::NONE;
    }
    for _ in 0..MAX_SLIPS {
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

/// Releases tissue that has slid out of the jaws; returns whether there was any.
fn lose(
    simulation: &Simulation,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) -> bool {
    let mut lost = false;
    for (tool, own) in simulation.tools.iter().zip(&mut state.tools) {
        let length = tool.jaws.map_or(0.0, |jaws| jaws.length_m);
        let gone = |hold: &mut Grasp| hold.slid().norm() >= length;
        if own.grip.grasp.take_if(gone).is_some() {
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

fn grasp(
    simulation: &Simulation,
    number: usize,
    state: &mut SimulationState,
    workspace: &mut SimulationWorkspace,
) {
    let touched = state.tools[number].contact.is_some();
    let took = if let (Some(global), Some(workspace)) = (&simulation.global, &mut workspace.global)
    {
        global.grasp(simulation, number, &mut state.tools, workspace)
    } else if let Some(organ) = state.bent_organ() {
        organ.grasp(simulation, number, state)
    } else {
        let tool = &simulation.tools[number];
        let workspace = &mut workspace.models[number];
        place::grasp(simulation, tool, &mut state.tools[number], workspace)
    };
    let own = &mut state.tools[number];
    if let (true, Some(at)) = (took, own.grip.grasp.as_ref().map(Grasp::place)) {
        own.contact = None;
        own.row.events.insert(Event::Grip);
        if !touched {
            own.row.events.insert(Event::Contact);
            own.forget_elsewhere(&simulation.tools[number], &at);
        }
    }
}

impl Grip {
    /// Its patch of the organ-scale model.
    pub(crate) fn patch(&self) -> Option<&GraspedPatch> {
        self.grasp.as_ref()?.patch()
    }

    /// The held place of the local model, and its displacement [m].
    pub(crate) fn shown_place(&self) -> Option<(LocalContact, Vec3)> {
        let hold = self.grasp.as_ref()?;
        match &hold.grasped {
            Grasped::Place(held) => Some((held.place, hold.displaced())),
            Grasped::Patch(_) | Grasped::Area(_) => None,
        }
    }
}

impl ToolState {
    /// Whether its jaws hold tissue.
    pub fn is_grasping(&self) -> bool {
        self.grip.grasp.is_some()
    }

    /// Whether its tip touches the organ or its jaws hold it.
    pub(crate) fn touches(&self) -> bool {
        self.contact.is_some() || self.is_grasping()
    }

    /// Displacement of the tissue between its jaws from rest [m].
    pub(crate) fn pulled(&self) -> f64 {
        let hold = self.grip.grasp.as_ref();
        hold.map_or(0.0, |hold| hold.displaced().norm())
    }

    /// Force of each jaw on the tissue that they hold [N].
    fn press(&self, simulation: &Simulation, tool: &Tool) -> f64 {
        let modulus = simulation.material.at_rest.youngs_modulus();
        match (&self.grip.grasp, &tool.jaws, &self.pose) {
            (Some(hold), Some(jaws), Some(pose)) => {
                jaws::press(jaws, hold.area, hold.thickness, pose.grip, modulus)
            }
            _ => 0.0,
        }
    }

    /// The rotation of its jaws; without trocar and quaternion that of the surface at its contact, or upright.
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
