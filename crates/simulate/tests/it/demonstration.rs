//! Scripts that do the tasks that come with the program, and a finger that follows the force alone.

use palpate_files::scene::ModelKind;
use palpate_files::session::Event;
use palpate_files::{Pose, Scene};
use palpate_geometry::Vec3;
use palpate_simulate::performance::{Performance, Score, Status};
use palpate_simulate::{
    Demonstration, Simulation, SimulationState, SimulationWorkspace, draw_variant, step,
};

const STEP: f64 = 0.01;

/// A variant of a task that comes with the program, under the local model and on a coarser organ.
fn variant(text: &str, seed: u64) -> (Scene, Simulation) {
    let text = text.replace("triangles = 16000", "triangles = 6000");
    let text = text.replace("triangles = 14000", "triangles = 6000");
    let mut scene = draw_variant(&Scene::parse(&text, "task.toml").unwrap(), seed).unwrap();
    scene.model.kind = ModelKind::Local;
    scene.neighbours.clear();
    let simulation = Simulation::new(&scene).unwrap();
    (scene, simulation)
}

/// What comes of a demonstration, and the fastest speed of a tip in it [m/s].
fn shown((scene, simulation): &(Scene, Simulation)) -> (Status, Score, f64) {
    let mut script = Demonstration::new(scene, simulation).unwrap();
    let names: Vec<String> = scene.tools.iter().map(|tool| tool.name.clone()).collect();
    let mut performance = Performance::new(&scene.task, &names);
    let mut state = SimulationState::new(simulation);
    let mut workspace = SimulationWorkspace::new(simulation);
    let (mut fastest, mut before) = (0.0_f64, vec![None; names.len()]);
    for number in 0..12_000 {
        let elapsed = if number == 0 { 0.0 } else { STEP };
        let forces: Vec<Vec3> = state.tools.iter().map(|tool| tool.force).collect();
        let tools = script.follow(STEP, &forces).to_vec();
        for (now, before) in tools.iter().zip(&mut before) {
            if let (Some(now), Some(before)) =
                (now, before.replace(now.map(|own| own.tip)).flatten())
            {
                let way: Vec3 = now.tip - before;
                fastest = fastest.max(way.norm() / STEP);
            }
        }
        let poses: Vec<Option<Pose>> = tools
            .iter()
            .map(|tool| {
                tool.map(|own| Pose {
                    position_m: own.tip.into(),
                    orientation: None,
                    grip: own.grip,
                    cut: own.cuts,
                })
            })
            .collect();
        let time = STEP * f64::from(number);
        step(
            simulation,
            (time, elapsed),
            &poses,
            &mut state,
            &mut workspace,
        );
        for (number, tool) in state.tools.iter().enumerate() {
            let mut row = tool.row;
            if script.marks() && number == 0 {
                row.events.insert(Event::Mark);
            }
            performance.add(&row);
        }
        if matches!(performance.status(), Status::Over { .. }) {
            break;
        }
    }
    (performance.status(), performance.score(), fastest)
}

fn passes_at_a_human_pace(text: &str, seeds: std::ops::Range<u64>) {
    for seed in seeds {
        let (status, score, fastest) = shown(&variant(text, seed));
        println!(
            "{seed}: {:.1} s, {:.1} mm/s, {:?} {:?} {:?}",
            score.duration,
            1e3 * fastest,
            score.outcome,
            score.errors,
            score.forces.iter().map(|f| f.peak).collect::<Vec<_>>()
        );
        assert_eq!(status, Status::Over { late: false }, "{seed}");
        assert_eq!(score.outcome.passed(), Some(true), "{seed}");
        assert_eq!(
            score.errors.force_limit + score.errors.perforations + score.errors.drops,
            0,
            "{seed}"
        );
        // Hands at work move at some centimetres a second.
        assert!(fastest < 0.05 && score.duration > 10.0, "{seed}");
    }
}

#[test]
fn the_palpation_is_shown() {
    passes_at_a_human_pace(
        include_str!("../../../../assets/tasks/palpation.toml"),
        0..4,
    );
}

#[test]
fn the_traction_is_shown() {
    passes_at_a_human_pace(include_str!("../../../../assets/tasks/traction.toml"), 0..4);
}

#[test]
fn the_myotomy_is_shown() {
    passes_at_a_human_pace(include_str!("../../../../assets/tasks/myotomy.toml"), 0..3);
}
