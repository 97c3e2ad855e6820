//! A script that demonstrates a task at the pace of a person: it uses the forces, which a trainee sees, and the task's
//! numbers. It shows one way to do the task; it is no surgeon, and no standard of skill.
//!
//! *How we know*: `demonstration::…`.
//!
//! *Limits*: it moves tips and jaws, and turns no tool.

mod paths;
mod uncover;

use std::collections::VecDeque;
use std::ops::ControlFlow;

use palpate_files::scene::{Goal, ToolKind};
use palpate_files::{Event, Pose, Scene, Session};
use palpate_geometry::Vec3;

use crate::performance::{Performance, Status};
use crate::polyline::Polyline;
use crate::{Simulation, SimulationState, SimulationWorkspace, step};
use paths::{RestSurface, depths, steps_to_cut, steps_to_find, steps_to_pull};

/// Speed through the air [m/s], and in or towards the tissue [m/s].
const FREE: f64 = 0.025;
const SLOW: f64 = 0.005;

/// Gain of a pull: its speed per missing force [m/(N s)].
const FOLLOWS: f64 = 0.03;

/// A demonstration without a time limit ends after this time [s].
const LONGEST: f64 = 300.0;

/// A tool of a demonstration, at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShownTool {
    /// The tip [m].
    pub tip: Vec3,
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Whether it cuts.
    pub cuts: bool,
}

impl ShownTool {
    /// Its pose; a script turns no tool.
    fn pose(&self) -> Pose {
        Pose {
            position_m: self.tip.into(),
            orientation: None,
            grip: self.grip,
            cut: self.cuts,
        }
    }
}

/// A task that is being demonstrated.
#[derive(Debug, Clone)]
pub struct Demonstration {
    steps: VecDeque<Step>,
    tools: Vec<Option<ShownTool>>,
    marks: bool,
    states: Option<f64>,
}

#[derive(Debug, Clone, Copy)]
enum Step {
    Move {
        tool: usize,
        to: Vec3,
        speed: f64,
        cuts: bool,
    },
    Grip {
        tool: usize,
        to: f64,
    },
    /// [s]
    Wait(f64),
    Mark,
    /// States a diameter [m].
    State(f64),
    /// Keeps up a pull or a push [N], without end.
    Pull {
        tool: usize,
        wanted: Vec3,
    },
}

impl Demonstration {
    /// From the task of `scene`, from which `simulation` was made; none if the task has no goal, or no tool can do it.
    pub fn new(scene: &Scene, simulation: &Simulation) -> Option<Self> {
        let rest = RestSurface(simulation);
        let steps = match &scene.task.goal {
            Goal::Free => return None,
            Goal::Find { target_m, size, .. } => {
                let mut steps = steps_to_find(&rest, &Vec3::from(*target_m));
                if let Some(size) = size {
                    steps.extend([Step::Wait(1.5), Step::State(2.0 * size.radius_m)]);
                }
                steps
            }
            Goal::Traction {
                tool,
                force_n,
                direction,
                ..
            } => {
                let named = |own: &palpate_files::scene::Tool| match tool {
                    Some(name) => own.name == *name,
                    None => own.kind == ToolKind::Grasper,
                };
                let tool = scene.tools.iter().position(named)?;
                let direction = direction.map_or(-Vec3::y(), |(own, _)| Vec3::from(own));
                steps_to_pull(&rest, tool, *force_n * direction.normalize())
            }
            Goal::Cut { line, layers, .. } => {
                let of = |kinds: &[ToolKind]| {
                    let mut tools = scene.tools.iter();
                    tools.position(|own| kinds.contains(&own.kind))
                };
                let blade = of(&[ToolKind::Scissors, ToolKind::Hook])?;
                let depths = depths(simulation, layers.unwrap_or(1));
                let line = Polyline::new(line)?;
                steps_to_cut(&rest, &line, &depths, blade, of(&[ToolKind::Grasper]))
            }
            Goal::Touch(touch) => {
                let number = |name: &String| scene.tools.iter().position(|own| own.name == *name);
                let holder = touch.holder.as_ref().and_then(number);
                uncover::touched(simulation, touch, number(&touch.tool)?, holder)
            }
        };
        Some(Self {
            steps: steps.into(),
            tools: vec![None; scene.tools.len()],
            marks: false,
            states: None,
        })
    }

    /// The session of a demonstration of the task of `scene`, from which `simulation` was made, at the step of the
    /// model: until the task is over, or for its time limit. `on_progress` receives the completed part [-] and may cancel it.
    /// None if the task has no goal, no tool can do it, or it was cancelled.
    pub fn record(
        scene: &Scene,
        simulation: &Simulation,
        on_progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Option<Session> {
        let mut script = Self::new(scene, simulation)?;
        let tools: Vec<String> = scene.tools.iter().map(|tool| tool.name.clone()).collect();
        let mut performance = Performance::new(&scene.task, &tools);
        let mut state = SimulationState::new(simulation).show_every(f64::INFINITY);
        let mut workspace = SimulationWorkspace::new(simulation);
        let (period, longest) = (
            simulation.step(),
            scene.task.time_limit_s.unwrap_or(LONGEST),
        );
        let mut rows = Vec::new();
        for number in 0.. {
            let time = period * f64::from(number);
            if time > longest || matches!(performance.status(), Status::Ended { .. }) {
                break;
            }
            if number % 50 == 0 && on_progress(time / longest).is_break() {
                return None;
            }
            let elapsed = if number == 0 { 0.0 } else { period };
            let forces: Vec<Vec3> = state.tools.iter().map(|tool| tool.force).collect();
            let shown = script.follow(period, &forces).iter();
            let poses: Vec<_> = shown.map(|tool| tool.map(|own| own.pose())).collect();
            step(
                simulation,
                time,
                elapsed,
                &poses,
                &mut state,
                &mut workspace,
            );
            let mut says = Some((script.marks(), script.states()));
            for tool in state.tools.iter().filter(|tool| tool.pose.is_some()) {
                let mut row = tool.row;
                if let Some((marks, states)) = says.take() {
                    if marks {
                        row.events.insert(Event::Mark);
                    }
                    row.stated_diameter_m = states;
                }
                performance.add(&row);
                rows.push(row);
            }
        }
        Some(Session {
            header: simulation.session_header(),
            tools,
            rows,
            has_torques: true,
            incomplete: None,
        })
    }

    /// The tools after another `elapsed` [s], under `forces` on them [N]; none for absent tools.
    pub fn follow(&mut self, elapsed: f64, forces: &[Vec3]) -> &[Option<ShownTool>] {
        self.marks = false;
        self.states = None;
        let mut left = elapsed;
        while left > 0.0 {
            let Some(step) = self.steps.front_mut() else {
                break;
            };
            let is_done = match step {
                Step::Wait(time) => {
                    let waited = left.min(*time);
                    *time -= waited;
                    left -= waited;
                    *time <= 0.0
                }
                Step::Mark => {
                    self.marks = true;
                    true
                }
                Step::State(diameter) => {
                    self.states = Some(*diameter);
                    true
                }
                Step::Grip { tool, to } => match self.tools[*tool].as_mut() {
                    None => true,
                    Some(own) => {
                        // Half a second from open to shut.
                        let remaining = *to - own.grip;
                        let moved = remaining.abs().min(2.0 * left);
                        own.grip += moved * remaining.signum();
                        left -= 0.5 * moved;
                        (own.grip - *to).abs() < 1e-12
                    }
                },
                Step::Move {
                    tool,
                    to,
                    speed,
                    cuts,
                } => {
                    let own = self.tools[*tool].get_or_insert(ShownTool {
                        tip: *to,
                        grip: 0.0,
                        cuts: false,
                    });
                    own.cuts = *cuts;
                    let remaining = *to - own.tip;
                    let moved = remaining.norm().min(*speed * left);
                    left -= moved / *speed;
                    match moved < remaining.norm() {
                        true => own.tip += moved * remaining.normalize(),
                        false => own.tip = *to,
                    }
                    let arrived = own.tip == *to;
                    own.cuts &= !arrived || left > 0.0;
                    arrived
                }
                Step::Pull { tool, wanted } => {
                    let own = self.tools[*tool].as_mut();
                    if let (Some(own), Some(force)) = (own, forces.get(*tool)) {
                        // The force on the tool is against its pull.
                        let missing = *wanted + force;
                        let velocity = FOLLOWS * missing;
                        let size = velocity.norm().max(1e-12);
                        own.tip += velocity * (size.min(SLOW) / size) * left;
                    }
                    left = 0.0;
                    false
                }
            };
            if is_done {
                self.steps.pop_front();
            }
        }
        &self.tools
    }

    /// Whether it has just marked its position.
    pub fn marks(&self) -> bool {
        self.marks
    }

    /// The diameter that it has just stated [m]: that of the task, which a script knows.
    pub fn states(&self) -> Option<f64> {
        self.states
    }
}
