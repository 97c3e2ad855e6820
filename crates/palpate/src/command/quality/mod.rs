//! `palpate quality`: the quality of haptic rendering on this machine.

mod answer;

use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use clap::Args;
use palpate_files::Scene;
use palpate_servo::{ServoSettings, lock_memory};
use palpate_simulate::Simulation;
use palpate_simulate::interactive::{Interaction, PlacedDevice, Quality};

use answer::{Answer, Run};

use super::simulate::ESOPHAGUS;
use crate::failure::Failure;
use crate::output;
use crate::preparation;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate quality
      scripted hands on the built-in esophagus, at 1, 2 and 4 kHz
  palpate quality scene.toml --rates 1000 4000 --seconds 60 --json
      your scene for a minute, as one JSON object

Scripted hands palpate the organ in real time, every two seconds and 4 mm deep, on the same threads as a device and a \
window. Jitter: how late each tick starts. Extrapolation error: the difference between the force extrapolated between \
model steps and the model's next force. Energy: work that the loop does on the hands; a passive organ only absorbs \
energy.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The scene; without one, the built-in esophagus.
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Rates of the servo loop [Hz], one run each.
    #[arg(long, value_name = "HZ", num_args = 1.., value_delimiter = ',', default_values_t = [1000, 2000, 4000], value_parser = clap::value_parser!(u32).range(100..=10_000))]
    rates: Vec<u32>,
    /// Duration of each run [s].
    #[arg(long, value_name = "S", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=3600))]
    seconds: u32,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Measures and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scene = match &arguments.scene {
        Some(path) => Scene::read(path)?,
        None => Scene::parse(ESOPHAGUS, "built-in scene")?,
    };
    let reader = Reader::of_json(arguments.json);
    let simulation = preparation::simulation(&scene, &preparation::resources(), reader)?;
    let simulation = Arc::new(simulation);
    let progress = Progress::new(reader, None);
    let memory = lock_memory();
    let mut warnings = simulation.warnings().to_vec();
    let mut runs = Vec::new();
    for &rate in &arguments.rates {
        progress.show_step(format!("{rate} Hz for {} s", arguments.seconds));
        let quality = touch(&simulation, rate, arguments.seconds)?;
        for warning in quality.warnings(memory) {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        runs.push(Run::new(rate, &simulation, &quality));
    }
    drop(progress);
    let answer = Answer {
        palpate: output::VERSION,
        runs,
        warnings,
    };
    if arguments.json {
        return output::json(&answer);
    }
    output::text(answer.text())?;
    output::warnings(&answer.warnings);
    Ok(())
}

fn touch(simulation: &Arc<Simulation>, rate: u32, seconds: u32) -> Result<Quality, Failure> {
    let tools = simulation.tools().iter();
    let hands = tools.map(|tool| Some(PlacedDevice::palpating(simulation, tool)));
    let settings = ServoSettings {
        period: 1.0 / f64::from(rate),
        ..ServoSettings::default()
    };
    let mut touching = Interaction::start(simulation.clone(), hands.collect(), settings)?;
    // Nobody holds a device, so no force can hurt: a fault on a busy machine is counted, and the force armed again.
    for _ in 0..10 * seconds {
        thread::sleep(Duration::from_millis(100));
        touching.arm();
    }
    Ok(touching.stop()?)
}
