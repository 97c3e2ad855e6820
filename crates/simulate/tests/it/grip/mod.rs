//! Jaws that hold tissue.

mod agreement;
mod energy;
mod holding;
mod invariants;
mod jumps;
mod shown;

use nalgebra::UnitQuaternion;
use palpate_files::scene::{Jaws, ToolKind};
use palpate_files::{Event, Pose, Scene};
use palpate_geometry::{TriangleId, Vec3};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, ToolState, step};

use crate::scenes::Setting;

/// By boundary elements, which are ready in a second.
const HEMISPHERE: Setting<'_> = Setting {
    organ: "builtin = \"hemisphere\"\ntriangles = 400",
    kind: "hybrid",
    model: "response = \"boundary_elements\"",
    poissons_ratio: 0.3,
    shape: "flat",
    radius: 2e-3,
    contact: "stick",
    prony: "[]",
};

const POLE: Vec3 = Vec3::new(0.0, 0.0, 0.05);

/// The scene of a setting whose tool is a grasper, or two of them.
pub(crate) fn grasping(setting: &Setting<'_>, jaws: Jaws, tools: usize) -> Scene {
    let mut scene = setting.scene();
    scene.tools[0].kind = ToolKind::Grasper;
    scene.tools[0].jaws = Some(jaws);
    if tools == 2 {
        let mut left = scene.tools[0].clone();
        left.name = "left".to_owned();
        scene.tools.push(left);
    }
    scene
}

/// Graspers that are stepped by hand.
pub(crate) struct Hands<'a> {
    simulation: &'a Simulation,
    pub(crate) state: SimulationState,
    pub(crate) workspace: SimulationWorkspace,
    time: f64,
}

pub(crate) fn pose(tip: &Vec3, turned: &UnitQuaternion<f64>, grip: f64) -> Option<Pose> {
    Some(Pose {
        position_m: (*tip).into(),
        orientation: Some([turned.i, turned.j, turned.k, turned.w]),
        grip,
        cut: false,
    })
}

impl<'a> Hands<'a> {
    pub(crate) fn new(simulation: &'a Simulation) -> Self {
        Self {
            simulation,
            state: SimulationState::new(simulation),
            workspace: SimulationWorkspace::new(simulation),
            time: 0.0,
        }
    }

    pub(crate) fn go(&mut self, poses: &[Option<Pose>]) {
        let elapsed = self.simulation.step();
        step(
            self.simulation,
            self.time,
            elapsed,
            poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.time += elapsed;
    }

    /// The first tool upright at `tip` [m]; the force on it [N].
    fn at(&mut self, tip: &Vec3, grip: f64) -> Vec3 {
        self.go(&[pose(tip, &UnitQuaternion::identity(), grip)]);
        self.state.tools[0].force
    }

    fn tool(&self) -> &ToolState {
        &self.state.tools[0]
    }

    fn did(&self, event: Event) -> bool {
        self.tool().row.events.contains(event)
    }

    /// Whether every vertex is where it is at rest, to the last bit.
    fn is_at_rest(&self) -> bool {
        self.state.deformed.vertices() == self.simulation.surface().mesh().vertices()
    }
}

/// Jaws as wide as they open, around the hexagon of triangles at the pole and no further.
fn around_the_pole(simulation: &Simulation) -> (Jaws, Vec<TriangleId>) {
    let mesh = simulation.surface().mesh();
    let pole: Vec<_> = mesh
        .triangle_ids()
        .filter(|&id| {
            mesh.positions(id)
                .iter()
                .any(|corner| (corner - POLE).norm() < 1e-9)
        })
        .collect();
    let [a, b, _] = mesh.positions(pole[0]);
    let width = 1.4 * (a - b).norm();
    let jaws = Jaws {
        opening_m: width,
        width_m: width,
        friction: 1e6,
        ..Jaws::GRASPER
    };
    (jaws, pole)
}

fn with_jaws(setting: &Setting<'_>, jaws: impl Fn(&Simulation) -> Jaws) -> Simulation {
    let scene = grasping(setting, Jaws::GRASPER, 1);
    let plain = Simulation::new(&scene).unwrap();
    Simulation::new(&grasping(setting, jaws(&plain), 1)).unwrap()
}
