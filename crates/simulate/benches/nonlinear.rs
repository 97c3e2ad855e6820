//! A step of an organ at large deformation: a grasper pulls the esophagus to and fro, free or past a rigid neighbour.
//!
//! Budgets of what a force waits for: 2.5 ms with 1,500 nodes, 5 ms with 4,000, in 99 of 100 steps on one core.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]
#![allow(clippy::print_stdout, reason = "criterion prints no percentiles")]

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_files::{Pose, Scene};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, shape, touch};

fn simulation(nodes: usize, neighbour: &str) -> Simulation {
    let text = format!(
        "format = 1\n[organ]\nbuiltin = \"esophagus\"\n[organ.tissue]\nlaw = \"linear\"\n\
         youngs_modulus_pa = 30000.0\npoissons_ratio = 0.45\n[model]\nkind = \"nonlinear\"\nnodes = {nodes}\n\
         {neighbour}[[tool]]\nname = \"left\"\nkind = \"grasper\"\n\
         tip = {{ shape = \"flat\", radius_m = 0.0015, contact = \"stick\" }}\n"
    );
    Simulation::new(&Scene::parse(&text, "bench.toml").unwrap()).unwrap()
}

/// Half a ball of 15 mm, 5 mm beside the esophagus.
const NEIGHBOUR: &str = "[[neighbour]]\nbuiltin = \"hemisphere\"\nscale = 0.3\nturn_deg = [-90, 0, 0]\n\
                         at_m = [0.0, -0.0275, 0.015]\ncollides = true\n";

/// The hand at a step: down, shut, then aside by up to 20 mm and back in two seconds, at 30 mm/s.
fn pose(number: usize) -> Pose {
    let time = 0.005 * number.saturating_sub(40) as f64;
    let aside = 0.01 * (1.0 - (std::f64::consts::PI * time).cos());
    Pose {
        position_m: [0.0, -0.0062 - aside, 0.0],
        orientation: None,
        grip: f64::from(u8::from(number > 20)),
        cut: false,
    }
}

fn benches(criterion: &mut Criterion) {
    for nodes in [1_500, 4_000] {
        for (beside, neighbour) in [("free", ""), ("past a neighbour", NEIGHBOUR)] {
            let simulation = simulation(nodes, neighbour);
            let mut state = SimulationState::new(&simulation).show_every(1.0 / 60.0);
            let mut workspace = SimulationWorkspace::new(&simulation);
            let mut number = 0;
            // Until the esophagus is held and lies against the neighbour.
            while number < 200 {
                let time = number as f64 * simulation.step();
                let poses = [Some(pose(number))];
                let elapsed = simulation.step();
                touch(
                    &simulation,
                    time,
                    elapsed,
                    &poses,
                    &mut state,
                    &mut workspace,
                );
                number += 1;
            }
            assert!(state.tools[0].grip_force > 0.0, "nothing is held");
            let mut times = Vec::new();
            criterion.bench_function(&format!("touch, {nodes} nodes, {beside}"), |bencher| {
                bencher.iter(|| {
                    let time = number as f64 * simulation.step();
                    let elapsed = simulation.step();
                    let poses = [Some(pose(number))];
                    let begin = Instant::now();
                    touch(
                        &simulation,
                        time,
                        elapsed,
                        &poses,
                        &mut state,
                        &mut workspace,
                    );
                    times.push(begin.elapsed());
                    number += 1;
                    black_box(state.tools[0].force)
                });
            });
            times.sort_unstable();
            if let [_, .., _] = times[..] {
                let part = |percent: usize| times[percent * (times.len() - 1) / 100];
                println!("median {:?}, 99 of 100 within {:?}", part(50), part(99));
            }
            criterion.bench_function(&format!("shape, {nodes} nodes, {beside}"), |bencher| {
                bencher.iter(|| {
                    let time = number as f64 * simulation.step();
                    number += 4;
                    shape(&simulation, time, &mut state, &mut workspace);
                });
            });
        }
    }
}

criterion_group!(nonlinear, benches);
criterion_main!(nonlinear);
