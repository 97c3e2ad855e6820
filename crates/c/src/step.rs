use palpate_files::Pose;
use palpate_files::session::Event;
use palpate_geometry::Vec3;
use palpate_simulate::interactive::affine_force;
use palpate_simulate::{Simulation, step};
use palpate_simulate::{SimulationState, ToolState};

use crate::events;
use crate::pointers::{self, Answer};
use crate::refused::Refused;
use crate::state::{Own, StateHandle, a_time};
use crate::status::{Status, answer};

/// Where a tool is. All zero is a tool that is not there.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolPose {
    /// The tip in the scene's frame [m].
    pub position_m: [f64; 3],
    /// The quaternion (qx, qy, qz, qw) of length 1 that takes the tool's frame to the scene's [-]; the shaft runs along
    /// the tool's +z, away from the tissue. Read if `has_orientation`.
    pub orientation: [f64; 4],
    /// How far its jaws are shut, from 0 to 1 [-].
    pub grip: f64,
    /// Other than 0: somebody holds it; else the rest is not read.
    pub is_there: u8,
    /// Other than 0: `orientation` is stated; else the shaft stands on the surface, or runs to its trocar.
    pub has_orientation: u8,
    /// Other than 0: its blade is lowered.
    pub cut: u8,
}

/// What a tool feels after a step.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolTouch {
    /// The force of the tissue on it, in the scene's frame [N].
    pub force_n: [f64; 3],
    /// For a loop that is quicker than the steps: up to 5 mm from where the step had the tip, the force is
    /// `with_pull_n` + `gradient_n_per_m` times the way from there, of which what pulls along `normal` is left out unless
    /// the jaws hold.
    pub with_pull_n: [f64; 3],
    /// How the force changes with the tip: row by row, change of x, y, z of the force per metre [N/m].
    pub gradient_n_per_m: [f64; 9],
    /// The touched point of the surface at rest [m]; zero without contact.
    pub point_m: [f64; 3],
    /// Unit outward normal of the surface at rest there [-]; zero without contact.
    pub normal: [f64; 3],
    /// How far the tip is below the surface at rest [m].
    pub depth_m: f64,
    /// The quaternion (qx, qy, qz, qw) that takes the tool's frame to the scene's, as it was stated or found [-].
    pub orientation: [f64; 4],
    /// With how much each of its jaws presses on the tissue between them [N].
    pub grip_force_n: f64,
    /// The torque on it about its tip, in the scene's frame [N m]: of tissue that bears on the shaft of a tool without a
    /// trocar.
    pub torque_nm: [f64; 3],
    /// What happened to it in this step: a sum of PALPATE_EVENT_....
    pub events: u32,
    /// 1 if its tip touches or its jaws hold, else 0.
    pub contact: u8,
    /// 1 if its jaws hold tissue, else 0.
    pub holds: u8,
}

/// Takes a state one step on to `time_s` [s], with its tools at `poses`, and tells at `touches` what they feel: arrays of
/// `tools`, in the scene's order; `touches` may be null. What lies between the tool's last place and this one took the
/// time since the last step; a first one has no time before it, and whatever depth there is comes as a jump. A step
/// waits for nothing and, but for a cut that adds triangles, allocates nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_step(
    state: *mut StateHandle,
    time_s: f64,
    poses: *const ToolPose,
    tools: usize,
    touches: *mut ToolTouch,
) -> Status {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        let state = unsafe { pointers::borrowed(state, "state") }?;
        let known = state.simulation.tools().len();
        if tools != known {
            let given = tools;
            return Err(Refused::OtherTools { known, given });
        }
        // SAFETY: the header demands it of who calls; there are as many as the scene has tools.
        let poses = unsafe { pointers::array(poses, tools, "poses") }?;
        let touches = match touches.is_null() {
            true => None,
            false => Some(Answer::at(touches, "touches")?),
        };
        let mut own = state.own()?;
        own.step(&state.simulation, a_time("time_s", time_s)?, poses)?;
        if let Some(touches) = touches {
            for number in 0..tools {
                let touch = touch(&state.simulation, number, &own.course.state, time_s);
                // SAFETY: the header demands an array of so many.
                unsafe { touches.put(number, touch) };
            }
        }
        Ok(())
    })
}

impl Own {
    fn step(
        &mut self,
        simulation: &Simulation,
        time: f64,
        poses: &[ToolPose],
    ) -> Result<(), Refused> {
        let was = self.course.time.unwrap_or(time);
        if time < was {
            return Err(Refused::TimeGoesBack { was, is: time });
        }
        self.poses.clear();
        for (tool, pose) in poses.iter().enumerate() {
            self.poses.push(pose.checked(tool)?);
        }
        let undone = std::mem::take(&mut self.course.undo) && self.course.state.undo_cut();
        step(
            simulation,
            time,
            time - was,
            &self.poses,
            &mut self.course.state,
            &mut self.workspace,
        );
        self.course.time = Some(time);
        if undone {
            for tool in &mut self.course.state.tools {
                tool.row.events.insert(Event::UndoCut);
            }
        }
        Ok(())
    }
}

impl ToolPose {
    /// What the step takes, of tool number `tool`.
    fn checked(&self, tool: usize) -> Result<Option<Pose>, Refused> {
        if self.is_there == 0 {
            return Ok(None);
        }
        let position = self.position_m;
        if !position.iter().all(|number| number.is_finite()) {
            return Err(Refused::NoPosition { tool, position });
        }
        let grip = self.grip;
        if !(0.0..=1.0).contains(&grip) {
            return Err(Refused::NoGrip { tool, grip });
        }
        let orientation = match self.has_orientation {
            0 => None,
            _ => Some(unit(self.orientation).ok_or(Refused::NoOrientation {
                tool,
                orientation: self.orientation,
            })?),
        };
        Ok(Some(Pose {
            position_m: position,
            orientation,
            grip,
            cut: self.cut != 0,
        }))
    }
}

/// Half a percent off is somebody's single precision or a forgotten normalisation; more is another mistake.
const NEARLY_ONE: std::ops::RangeInclusive<f64> = 0.99..=1.01;

/// A quaternion that is one; the step makes its length exactly 1.
fn unit(quaternion: [f64; 4]) -> Option<[f64; 4]> {
    let square: f64 = quaternion.iter().map(|part| part * part).sum();
    NEARLY_ONE.contains(&square).then_some(quaternion)
}

/// What tool `number` feels in a state after the step to `time` [s].
fn touch(simulation: &Simulation, number: usize, state: &SimulationState, time: f64) -> ToolTouch {
    let own: &ToolState = &state.tools[number];
    let near = affine_force(&simulation.tools()[number], own, time);
    let at = own
        .contact
        .map(|contact| (contact.point(), contact.normal()));
    let (point, normal) = at.unwrap_or((Vec3::zeros(), Vec3::zeros()));
    let contact = own.contact.is_some() || own.is_grasping();
    ToolTouch {
        force_n: own.force.into(),
        with_pull_n: near.force.into(),
        // Its columns, one after the other, are the rows of what it is transposed.
        gradient_n_per_m: std::array::from_fn(|entry| near.gradient[(entry / 3, entry % 3)]),
        point_m: point.into(),
        normal: normal.into(),
        depth_m: if contact { own.row.depth_m } else { 0.0 },
        orientation: own.row.orientation,
        grip_force_n: own.grip_force,
        torque_nm: own.torque.into(),
        events: events::bits(own.row.events),
        contact: contact.into(),
        holds: own.is_grasping().into(),
    }
}
