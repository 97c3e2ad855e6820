//! Presses into the liver and holds: the force jumps up, then relaxes.
//!
//! Builds on: nothing. Asserts the fraction of the force that remains after 40 s.

#![allow(clippy::print_stdout, reason = "an example shows its result")]

use palpate_files::{Pose, Scene};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

const SCENE: &str = r#"
format = 1
organ = { builtin = "liver", builtin_tissue = "pig-liver" }
tool = [{ name = "right", tip = { shape = "flat", radius_m = 0.001 } }]
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let simulation = Simulation::new(&Scene::parse(SCENE, "liver.toml")?)?;
    let mut state = SimulationState::new(&simulation);
    let mut workspace = SimulationWorkspace::new(&simulation);

    // 4 mm below the first vertex, along its inward normal.
    let surface = simulation.surface();
    let tip = surface.mesh().vertices()[0] - 0.004 * surface.vertex_normals()[0];
    let pose = Pose {
        position_m: tip.into(),
        orientation: None,
        grip: 0.0,
        cut: false,
    };

    let mut forces = Vec::new();
    for k in 0..=400 {
        let (time, elapsed) = (0.1 * f64::from(k), if k == 0 { 0.0 } else { 0.1 });
        step(
            &simulation,
            time,
            elapsed,
            &[Some(pose)],
            &mut state,
            &mut workspace,
        );
        forces.push(state.tools[0].force.norm()); // [N]
    }
    let (first, last) = (forces[0], forces[400]);
    println!("{first:.4} N at once, {last:.4} N after 40 s");

    // 1 − g₁ − g₂ of the tissue (table 6-3), plus the remaining relaxation of the slower term.
    assert!((last / first - 0.5115).abs() < 1e-3);
    Ok(())
}
