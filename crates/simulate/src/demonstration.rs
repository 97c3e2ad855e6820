//! A script that does a task, at the pace of a person: it sees what a trainee sees, the forces, and knows the task's
//! numbers besides. It shows a way; it is no surgeon, and no standard of skill.
//!
//! *How we know*: `demonstration::…`.
//!
//! *Limits*: it moves tips and jaws, and turns no tool.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use palpate_files::scene::{Goal, ToolKind};
use palpate_files::{Event, Pose, Scene, Session};
use palpate_geometry::Vec3;

use crate::performance::{Performance, Status};
use crate::{Simulation, SimulationState, SimulationWorkspace, step};

/// Speed through the air [m/s], and in the tissue or towards it [m/s].
const FREE: f64 = 0.025;
const SLOW: f64 = 0.005;

/// How far over the surface a tip waits [m].
const ABOVE: f64 = 0.012;

/// How deep a probe presses [m], and a grasper before its jaws shut [m].
const PRESS: f64 = 0.005;
const BITE: f64 = 0.0016;

/// How far beside the line the other hand holds [m], and how far it pulls away from it [m].
const ASIDE: f64 = 0.0055;
const STRETCH: f64 = 0.0005;

/// How fast a pull follows what is missing of its force [m/(N s)].
const FOLLOWS: f64 = 0.03;

/// How far a cut goes on beyond the ends of its line [m].
const BEYOND: f64 = 0.002;

/// A demonstration without a time limit ends after this time [s].
const LONGEST: f64 = 300.0;

/// Points of a way over the surface are this far apart [m].
const SPACING: f64 = 0.001;

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
    /// Keeps a pull [N], for ever.
    Pull {
        tool: usize,
        wanted: Vec3,
    },
}

/// The surface at rest, as a script looks at it.
struct RestSurface<'s>(&'s Simulation);

impl RestSurface<'_> {
    /// The nearest point of the surface [m], and the outward normal there.
    fn at(&self, place: &Vec3) -> (Vec3, Vec3) {
        let mesh = self.0.surface().mesh();
        let nearest = self.0.tree.nearest(mesh, place);
        let normal = mesh.area_vector(nearest.triangle).normalize();
        (nearest.on.position, normal)
    }

    /// So far above the surface [m], or below it.
    fn over(&self, place: &Vec3, height: f64) -> Vec3 {
        let (point, normal) = self.at(place);
        point + height * normal
    }

    /// Where the surface faces a direction, in its middle [m].
    fn facing(&self, direction: &Vec3) -> Vec3 {
        let mesh = self.0.surface().mesh();
        let (low, high) = mesh.bounds();
        let (middle, extent) = (0.5 * (low + high), (high - low).norm());
        let from = middle + extent * direction;
        let hit = self.0.tree.cast(mesh, &from, &-direction, 2.0 * extent);
        hit.map_or(middle, |hit| from - hit.distance * direction)
    }
}

impl Demonstration {
    /// Of the task of `scene`, which `simulation` was made of; none where there is nothing to do, or no tool to do it
    /// with.
    pub fn new(scene: &Scene, simulation: &Simulation) -> Option<Self> {
        let ground = RestSurface(simulation);
        let steps = match &scene.task.goal {
            Goal::Free => return None,
            Goal::Find { target_m, size, .. } => {
                let mut steps = found(&ground, &Vec3::from(*target_m));
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
                pulled(&ground, tool, *force_n * direction.normalize())
            }
            Goal::Cut {
                from_m,
                to_m,
                layers,
                ..
            } => {
                let of = |kinds: &[ToolKind]| {
                    let mut tools = scene.tools.iter();
                    tools.position(|own| kinds.contains(&own.kind))
                };
                let blade = of(&[ToolKind::Scissors, ToolKind::Hook])?;
                let depths = depths(simulation, layers.unwrap_or(1));
                let line = [*from_m, *to_m].map(Vec3::from);
                cut(&ground, line, &depths, (blade, of(&[ToolKind::Grasper])))
            }
        };
        Some(Self {
            steps: steps.into(),
            tools: vec![None; scene.tools.len()],
            marks: false,
            states: None,
        })
    }

    /// The session of a demonstration of the task of `scene`, which `simulation` was made of, at the step of the model:
    /// until the task is over, or for its time limit. `watch` gets the part [-] that is done and may cancel it. None
    /// where there is nothing to do, no tool to do it with, or it was cancelled.
    pub fn record(
        scene: &Scene,
        simulation: &Simulation,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
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
            if time > longest || matches!(performance.status(), Status::Over { .. }) {
                break;
            }
            if number % 50 == 0 && watch(time / longest).is_break() {
                return None;
            }
            let elapsed = if number == 0 { 0.0 } else { period };
            let forces: Vec<Vec3> = state.tools.iter().map(|tool| tool.force).collect();
            let shown = script.follow(period, &forces).iter();
            let poses: Vec<_> = shown.map(|tool| tool.map(|own| own.pose())).collect();
            step(
                simulation,
                (time, elapsed),
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
            incomplete: None,
        })
    }

    /// The tools after another `elapsed` [s], under `forces` on them [N]; none for those that are not held.
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
                        let way = *to - own.grip;
                        let moved = way.abs().min(2.0 * left);
                        own.grip += moved * way.signum();
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
                    let way = *to - own.tip;
                    let moved = way.norm().min(*speed * left);
                    left -= moved / *speed;
                    match moved < way.norm() {
                        true => own.tip += moved * way.normalize(),
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

    /// Whether it has just marked where it is.
    pub fn marks(&self) -> bool {
        self.marks
    }

    /// The diameter that it has just stated [m]: that of the task, for a script knows it.
    pub fn states(&self) -> Option<f64> {
        self.states
    }
}

/// Presses beside a place, and on it.
fn found(ground: &RestSurface<'_>, target: &Vec3) -> Vec<Step> {
    let (_, normal) = ground.at(target);
    let across = normal.cross(&Vec3::z()).try_normalize(1e-6);
    let across = across.unwrap_or(Vec3::x());
    let along = normal.cross(&across);
    let beside = [
        0.022 * across,
        0.016 * along,
        -0.012 * across,
        Vec3::zeros(),
    ];
    let mut steps = Vec::new();
    for (number, aside) in beside.iter().enumerate() {
        let place = target + aside;
        let to = |height: f64, speed: f64| Step::Move {
            tool: 0,
            to: ground.over(&place, height),
            speed,
            cuts: false,
        };
        steps.extend([to(ABOVE, FREE), to(0.001, FREE), to(-PRESS, SLOW)]);
        steps.push(Step::Wait(0.8));
        match number + 1 == beside.len() {
            true => steps.push(Step::Mark),
            false => steps.extend([to(0.001, SLOW), to(ABOVE, FREE)]),
        }
    }
    steps
}

/// Grasps where the surface faces the pull, and pulls.
fn pulled(ground: &RestSurface<'_>, tool: usize, wanted: Vec3) -> Vec<Step> {
    let place = ground.facing(&wanted.normalize());
    let mut steps = grasped(ground, tool, &place);
    steps.push(Step::Pull { tool, wanted });
    steps
}

fn grasped(ground: &RestSurface<'_>, tool: usize, place: &Vec3) -> Vec<Step> {
    let to = |height: f64, speed: f64| Step::Move {
        tool,
        to: ground.over(place, height),
        speed,
        cuts: false,
    };
    vec![
        to(ABOVE, FREE),
        Step::Wait(0.5),
        to(0.001, FREE),
        to(-BITE, SLOW),
        Step::Grip { tool, to: 1.0 },
        Step::Wait(0.3),
    ]
}

/// How deep a blade goes to open each layer but the next [m]: half way between their lower faces.
fn depths(simulation: &Simulation, layers: usize) -> Vec<f64> {
    let bottoms = simulation.cut_depths();
    let depth = |number: usize| {
        let bottom = bottoms[number];
        match bottoms.get(number + 1) {
            Some(next) => 0.5 * (bottom + next),
            None => bottom + 0.0003,
        }
    };
    (0..layers.min(bottoms.len())).map(depth).collect()
}

/// Holds beside a line, if something can hold, and cuts along it, once for each depth.
fn cut(
    ground: &RestSurface<'_>,
    [from, to]: [Vec3; 2],
    depths: &[f64],
    (blade, grasper): (usize, Option<usize>),
) -> Vec<Step> {
    let along = (to - from).normalize();
    let mut steps = Vec::new();
    if let Some(tool) = grasper {
        let (middle, normal) = ground.at(&(0.5 * (from + to)));
        // The side that a left hand comes from.
        let aside = normal.cross(&along).normalize();
        let aside = if aside.x > 0.0 { -aside } else { aside };
        let place = middle + ASIDE * aside;
        steps.extend(grasped(ground, tool, &place));
        steps.push(Step::Move {
            tool,
            to: ground.over(&place, -BITE) + STRETCH * aside,
            speed: SLOW,
            cuts: false,
        });
    }
    let length = (to - from).norm() + 2.0 * BEYOND;
    let pieces = (length / SPACING).ceil() as u32;
    for depth in depths {
        let place =
            |piece: u32| from + along * (length * f64::from(piece) / f64::from(pieces) - BEYOND);
        let over = |piece: u32, height: f64, speed: f64, cuts: bool| Step::Move {
            tool: blade,
            to: ground.over(&place(piece), height),
            speed,
            cuts,
        };
        steps.extend([over(0, ABOVE, FREE, false), over(0, 0.001, FREE, false)]);
        steps.push(over(0, -depth, SLOW, false));
        steps.extend((0..=pieces).map(|piece| over(piece, -depth, SLOW, true)));
        steps.extend([
            over(pieces, 0.001, SLOW, false),
            over(pieces, ABOVE, FREE, false),
        ]);
    }
    steps
}
