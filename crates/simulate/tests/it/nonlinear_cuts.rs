//! Cuts in an organ at large deformation.

use palpate_files::{Pose, Scene};
use palpate_geometry::Vec3;
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

/// An organ that a hook cuts and a probe touches.
fn simulation(organ: &str, cutting: &str, model: &str) -> Simulation {
    let tool = |name: &str, kind: &str| {
        format!(
            "[[tool]]\nname = \"{name}\"\nkind = \"{kind}\"\n\
             tip = {{ shape = \"flat\", radius_m = 0.001, contact = \"stick\" }}\n"
        )
    };
    let text = format!(
        "format = 1\n[organ]\n{organ}\n[organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\n\
         poissons_ratio = 0.45\n[cutting]\ntoughness_j_per_m2 = 1.0\n{cutting}\n[model]\n{model}\n{}{}",
        tool("right", "hook"),
        tool("left", "probe")
    );
    Simulation::new(&Scene::parse(&text, "cut.toml").unwrap()).unwrap()
}

const CUBE: &str = "builtin = \"cube\"\ntriangles = 3072";

struct Hands<'a> {
    simulation: &'a Simulation,
    state: SimulationState,
    workspace: SimulationWorkspace,
    steps: u32,
}

impl<'a> Hands<'a> {
    fn new(simulation: &'a Simulation) -> Self {
        Self {
            state: SimulationState::new(simulation),
            workspace: SimulationWorkspace::new(simulation),
            simulation,
            steps: 0,
        }
    }

    /// A step with the hook at `hook` [m], cutting, and the probe at `probe` [m], or one of them alone.
    fn at(&mut self, hook: Option<Vec3>, probe: Option<Vec3>) -> Vec3 {
        let pose = |place: Vec3, cut| Pose {
            position_m: place.into(),
            orientation: None,
            grip: 0.0,
            cut,
        };
        let poses = [
            hook.map(|place| pose(place, true)),
            probe.map(|place| pose(place, false)),
        ];
        let elapsed = self.simulation.step();
        let time = elapsed * f64::from(self.steps);
        self.steps += 1;
        step(
            self.simulation,
            (time, elapsed),
            &poses,
            &mut self.state,
            &mut self.workspace,
        );
        self.state.tools[1].force
    }

    /// From `from` to `to` [m], and up.
    fn cut(&mut self, from: Vec3, to: Vec3) {
        for k in 0..=200 {
            self.at(Some(from + (to - from) * (f64::from(k) / 200.0)), None);
        }
        self.at(None, None);
    }

    fn wait(&mut self, steps: usize) {
        for _ in 0..steps {
            self.at(None, None);
        }
    }

    /// The force of a probe that goes straight in to `place` [m] along the `outward` direction, and stays.
    fn feel(&mut self, place: Vec3, outward: Vec3) -> Vec3 {
        let mut force = Vec3::zeros();
        for k in 0..40 {
            let up = 2e-3 * (1.0 - f64::from(k) / 10.0).max(0.0);
            force = self.at(None, Some(place + up * outward));
        }
        self.wait(60);
        force
    }
}

/// On the upper side of the cube, 1 mm deep.
fn top(x: f64, y: f64) -> Vec3 {
    Vec3::new(x, y, 0.049)
}

#[test]
fn a_rim_is_softer_and_the_rest_is_not() {
    for kind in [
        "kind = \"hybrid\"\nmechanical_triangles = 1200\nresponse = \"boundary_elements\"",
        "kind = \"nonlinear\"",
        "kind = \"nonlinear\"\nnodes = 4000",
    ] {
        let simulation = simulation(CUBE, "depth_m = 0.008", kind);
        let mut hands = Hands::new(&simulation);
        let places = [0.0016, 0.003, 0.006, 0.026].map(|y| top(0.0, y));
        let uncut = places.map(|place| hands.feel(place, Vec3::z()));
        let began = std::time::Instant::now();
        hands.cut(top(-0.02, 0.0004), top(0.02, 0.0004));
        println!("cut in {:?}", began.elapsed());
        for _ in 0..500 {
            let began = std::time::Instant::now();
            hands.wait(1);
            if began.elapsed().as_secs_f64() > 0.02 {
                println!("a step of {:?}", began.elapsed());
            }
        }
        println!("{:?}", hands.workspace.warnings());
        assert!(hands.state.cuts.as_ref().unwrap().length() > 0.015);
        let cut = places.map(|place| hands.feel(place, Vec3::z()));
        let parts = [0, 1, 2, 3].map(|k| cut[k].z / uncut[k].z);
        println!("{kind}: force over that of the uncut organ: {parts:.3?}");
        println!("{:.4?}", uncut.map(|u| u.z));
        assert!(hands.state.undo_cut());
        hands.wait(500);
        let again = places.map(|place| hands.feel(place, Vec3::z()));
        println!("{:.3e}", (again[0] - uncut[0]).norm());
    }
}
