//! Both hands at random: poke, slide, grip, pull, cut, collide.

use std::collections::HashSet;

use palpate_files::session::Event;
use palpate_files::{Pose, Scene};
use palpate_geometry::{TriangleMesh, Vec3};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

use crate::data;
use crate::scenes::Random;

/// Steps of a gesture.
const STEPS: usize = 24;

/// Cuts after which the organ is made whole again.
const MANY: usize = 25;

/// Triangles that splitting may come to, per triangle of the organ, and what one step may add to that.
const MAX_GROWTH: usize = 8;

/// A grasper in the left hand, and in the right what `blade` says.
fn scene(organ: &str, model: &str, blade: &str) -> Scene {
    let text = format!(
        "format = 1\n[organ]\n{organ}\n[organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\n\
         poissons_ratio = 0.45\n[[organ.layer]]\nname = \"muscle\"\nthickness_m = 0.0008\n\
         builtin_tissue = \"pig-esophagus\"\nperforation_force_n = 0.2\n\
         [[organ.layer]]\nname = \"mucosa\"\nthickness_m = 0.0004\nbuiltin_tissue = \"pig-esophagus\"\n\
         perforation_force_n = 0.1\n[cutting]\ntoughness_j_per_m2 = 20.0\n[model]\n{model}\n\
         [[tool]]\nname = \"left\"\nkind = \"grasper\"\n\
         tip = {{ shape = \"flat\", radius_m = 0.0015, contact = \"stick\" }}\n\
         [[tool]]\nname = \"right\"\nkind = \"{blade}\"\n\
         tip = {{ shape = \"sphere\", radius_m = 0.001, contact = \"stick\" }}\n"
    );
    Scene::parse(&text, "gestures.toml").unwrap()
}

#[derive(Debug, Default)]
struct Seen {
    steps: usize,
    forces: usize,
    holds: usize,
    cuts: usize,
    perforations: usize,
    slips: usize,
    largest: f64,
    triangles: usize,
}

struct Hands<'a> {
    simulation: &'a Simulation,
    state: SimulationState,
    workspace: SimulationWorkspace,
    random: Random,
    time: f64,
    seen: Seen,
}

/// What one hand does in a gesture.
#[derive(Clone, Copy)]
struct Plan {
    from: Vec3,
    to: Vec3,
    grips: [usize; 2],
    cuts: bool,
}

impl<'a> Hands<'a> {
    fn new(simulation: &'a Simulation) -> Self {
        Self {
            state: SimulationState::new(simulation),
            workspace: SimulationWorkspace::new(simulation),
            simulation,
            random: Random(7),
            time: 0.0,
            seen: Seen::default(),
        }
    }

    /// From above a place into it and on: along, out, or through.
    fn plan(&mut self) -> Plan {
        let (place, normal, along) = self.random.place(self.simulation);
        let depth = 0.004 * self.random.unit();
        let lift = 0.02 * (self.random.unit() - 0.5);
        let begins = (8.0 * self.random.unit()) as usize;
        Plan {
            from: place - depth * normal,
            to: place + 0.02 * self.random.unit() * along + lift * normal,
            grips: [
                begins,
                begins + (STEPS as f64 * self.random.unit()) as usize,
            ],
            cuts: self.random.unit() < 0.6,
        }
    }

    fn gesture(&mut self) {
        let plans = [self.plan(), self.plan()];
        for number in 0..STEPS {
            let part = number as f64 / (STEPS - 1) as f64;
            let poses = plans.map(|plan| {
                let within = (plan.grips[0]..plan.grips[1]).contains(&number);
                Some(Pose {
                    position_m: (plan.from + (plan.to - plan.from) * part).into(),
                    orientation: None,
                    grip: f64::from(u8::from(within)),
                    cut: plan.cuts,
                })
            });
            let elapsed = self.simulation.step();
            self.time += elapsed;
            step(
                self.simulation,
                self.time,
                elapsed,
                &poses,
                &mut self.state,
                &mut self.workspace,
            );
            self.look();
        }
    }

    fn look(&mut self) {
        for tool in &self.state.tools {
            let force = tool.force.norm();
            assert!(force.is_finite(), "{:?}", tool.row);
            assert!(tool.grip_force.is_finite() && tool.grip_force >= 0.0);
            assert!(!tool.row.events.contains(Event::NonFiniteForce), "{tool:?}");
            assert!(!tool.row.events.contains(Event::NoEquilibrium), "{tool:?}");
            self.seen.steps += 1;
            self.seen.forces += usize::from(force > 0.0);
            self.seen.holds += usize::from(tool.grip_force > 0.0);
            self.seen.cuts += usize::from(tool.row.events.contains(Event::Cut));
            self.seen.slips += usize::from(tool.row.events.contains(Event::GripRelease));
            self.seen.perforations += usize::from(tool.row.events.contains(Event::Perforation));
            self.seen.largest = self.seen.largest.max(force);
        }
    }

    /// The organ after a gesture, and now and then a new beginning.
    fn tidy(&mut self, number: usize) {
        let moved = self.state.deformed.vertices();
        assert!(
            moved
                .iter()
                .all(|vertex| vertex.iter().all(|c| c.is_finite()))
        );
        let Some(cuts) = &self.state.cuts else { return };
        if number.is_multiple_of(20) {
            assert!(
                cuts.places()
                    .iter()
                    .all(|p| p.iter().all(|c| c.is_finite()))
            );
            sound(cuts.mesh());
        }
        self.seen.triangles = self.seen.triangles.max(cuts.mesh().triangles().len());
        let most = (MAX_GROWTH + 1) * self.simulation.surface().mesh().triangles().len();
        assert!(
            self.seen.triangles < most,
            "{} triangles",
            self.seen.triangles
        );
        if cuts.count() > MANY {
            match number % 3 {
                0 => while self.state.undo_cut() {},
                _ => self.state.reset(self.simulation),
            }
        }
    }
}

/// Every directed edge belongs to one triangle, and every triangle has three corners. Judge: the definition of an
/// oriented manifold with borders.
fn sound(mesh: &TriangleMesh) {
    let mut edges = HashSet::new();
    for corners in mesh.triangles() {
        for k in 0..3 {
            assert!(corners[k] != corners[(k + 1) % 3]);
            assert!(edges.insert((corners[k], corners[(k + 1) % 3])));
        }
    }
}

/// `full` with `PALPATE_FULL=1`, else a hundredth of it.
fn tries(full: usize) -> usize {
    match std::env::var("PALPATE_FULL").is_ok_and(|value| value == "1") {
        true => full,
        false => full / 100,
    }
}

/// `full` gestures, or a part of them by default.
fn gestures(organ: &str, model: &str, full: usize) {
    for blade in ["scissors", "hook"] {
        let simulation = Simulation::new(&scene(organ, model, blade)).unwrap();
        let mut hands = Hands::new(&simulation);
        let count = tries(full / 2);
        for number in 0..count {
            hands.gesture();
            hands.tidy(number);
        }
        println!(
            "{organ} {model} {blade}: {count} gestures, {:?}",
            hands.seen
        );
        let seen = hands.seen;
        assert!(4 * seen.forces > seen.steps);
        assert!(seen.holds > 0 && seen.cuts > 0 && seen.perforations > 0 && seen.slips > 0);
    }
}

const LOCAL: &str = "kind = \"local\"";
const COARSE: &str =
    "kind = \"hybrid\"\nmechanical_triangles = 600\nresponse = \"boundary_elements\"";

#[test]
#[ignore = "long"]
fn on_the_esophagus() {
    gestures("builtin = \"esophagus\"\ntriangles = 2000", COARSE, 20_000);
    gestures("builtin = \"esophagus\"\ntriangles = 2000", LOCAL, 10_000);
}

#[test]
#[ignore = "long"]
fn on_the_stomach() {
    gestures("builtin = \"stomach\"\ntriangles = 2000", COARSE, 20_000);
}

#[test]
#[ignore = "long"]
fn on_the_liver() {
    gestures("builtin = \"liver\"\ntriangles = 2000", COARSE, 20_000);
}

/// On both real ones.
#[test]
#[ignore = "long"]
fn real_esophagi() {
    let Some(folder) = data::folder() else { return };
    for name in [
        "bp3d_esophagus_hollow_6000.ply",
        "gca_stomach_oesophagus_10000.ply",
    ] {
        let path = folder.join("meshes").join(name);
        let organ = format!("mesh = {:?}\nmesh_unit = \"m\"", path.display().to_string());
        gestures(&organ, LOCAL, 15_000);
    }
}
