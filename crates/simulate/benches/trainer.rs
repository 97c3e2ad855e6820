//! A whole step of the trainer: two graspers hold and pull the esophagus, a hook cuts between them.
//!
//! Budgets: 1 ms with the 3,726 triangles of the source's model (section 7.4), 2 ms with 21,146 that are seen on
//! 4,000 that carry the mechanics. The shape of the whole organ is for a display and is made sixty times a second
//! where somebody touches; beside that stands a step that makes it every time.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_files::scene::ToolKind;
use palpate_files::{Pose, Scene};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

/// Shown triangles, and those that carry the mechanics.
const CASES: [(usize, usize); 2] = [(3_726, 1_500), (21_146, 4_000)];

/// Boundary elements, for they are ready sooner; what a step does with either response is the same.
fn simulation(shown: usize, mechanical: usize) -> Simulation {
    let tool = |name: &str, kind: &str| {
        format!(
            "[[tool]]\nname = \"{name}\"\nkind = \"{kind}\"\n\
             tip = {{ shape = \"flat\", radius_m = 0.0015, contact = \"stick\" }}\n"
        )
    };
    let text = format!(
        "format = 1\n[organ]\nbuiltin = \"esophagus\"\ntriangles = {shown}\n[organ.tissue]\nlaw = \"linear\"\n\
         youngs_modulus_pa = 30000.0\npoissons_ratio = 0.45\n[organ.touchable]\n\
         spheres = [{{ center_m = [0.0, -0.0075, 0.0], radius_m = 0.02 }}]\n[model]\nkind = \"hybrid\"\n\
         mechanical_triangles = {mechanical}\nresponse = \"boundary_elements\"\n[cutting]\n\
         toughness_j_per_m2 = 20.0\n{}{}",
        tool("left", "grasper"),
        tool("right", "grasper")
    );
    let mut scene = Scene::parse(&text, "trainer.toml").unwrap();
    // Files know two hands; an assistant has a third.
    let mut hook = scene.tools[1].clone();
    hook.name = "third".to_owned();
    hook.kind = ToolKind::Hook;
    hook.jaws = None;
    scene.tools.push(hook);
    Simulation::new(&scene).unwrap()
}

/// The hands at a step: down, shut, apart, and the hook to and fro between them.
fn poses(number: usize) -> [Option<Pose>; 3] {
    let part = (number as f64 / 100.0).min(1.0);
    let pull = 0.003 * (0.05 * number as f64).sin().abs();
    let at = |x: f64, y: f64, z: f64, grip: f64, cut: bool| {
        Some(Pose {
            position_m: [x, y, z],
            orientation: None,
            grip,
            cut,
        })
    };
    let grip = f64::from(u8::from(number > 20));
    let along = 0.006 * (0.02 * number as f64).sin();
    [
        at(0.0, -0.0062, 0.012 + pull * part, grip, false),
        at(0.0, -0.0062, -0.012 - pull * part, grip, false),
        at(0.0, -0.0068, along, 0.0, number > 30),
    ]
}

fn benches(criterion: &mut Criterion) {
    for (shown, mechanical) in CASES {
        let simulation = simulation(shown, mechanical);
        // The organ's shape in every step, and as often as a display shows it, which is how it is touched.
        for (shaped, period) in [
            ("shaped in every step", 0.0),
            ("shaped 60 times a second", 1.0 / 60.0),
        ] {
            go_on(criterion, shown, mechanical, shaped, &simulation, period);
        }
    }
}

fn go_on(
    criterion: &mut Criterion,
    shown: usize,
    mechanical: usize,
    shaped: &str,
    simulation: &Simulation,
    period: f64,
) {
    let mut state = SimulationState::new(simulation).show_every(period);
    let mut workspace = SimulationWorkspace::new(simulation);
    let mut number = 0;
    let mut go_on = |state: &mut SimulationState, workspace: &mut SimulationWorkspace| {
        let time = number as f64 * simulation.step();
        let poses = poses(number);
        step(
            simulation,
            time,
            simulation.step(),
            &poses,
            state,
            workspace,
        );
        number += 1;
    };
    for _ in 0..200 {
        go_on(&mut state, &mut workspace);
    }
    let holds = state.tools.iter().filter(|tool| tool.grip_force > 0.0);
    let cuts = state.cuts.as_ref().unwrap();
    eprintln!(
        "{shown} shown on {mechanical}: {} graspers hold, {:.1} mm are cut",
        holds.count(),
        1e3 * cuts.length()
    );
    let name = format!("trainer {shown} on {mechanical}, {shaped}");
    criterion.bench_function(&name, |bencher| {
        bencher.iter(|| {
            go_on(&mut state, &mut workspace);
            black_box(state.tools[0].force)
        });
    });
}

criterion_group!(trainer, benches);
criterion_main!(trainer);
