//! Measures a specimen, characterizes it, and presses a simulated block of the fitted tissue in the same way.
//! Builds on: `palpate_a_liver`. Asserts the difference between simulated and recorded force.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::{CharacterizeSettings, characterize, inverse::CandidateLaw};
use palpate_files::{BuiltinTissue, Recording, Scene, Tissue, protocol, recording::Samples, scene};
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass};
use palpate_measure::{DepthTrajectory, Rig, RigSettings, VirtualSpecimen};
use palpate_servo::Clock;
use palpate_simulate::{Error, Flow, Simulation, play};

const RAMP: protocol::Stimulus = protocol::Stimulus::RampAndHold {
    depth_m: 0.004,
    ramp_s: 0.5,
    hold_s: 10.0,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tissue = Tissue::builtin(BuiltinTissue::PigEsophagus);
    let specimen = VirtualSpecimen::of_tissue(&tissue, 1e-3, 5e-3, &mut |_| ())?;
    let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
    let (imperfections, settings) = (Imperfections::premium(), RigSettings::default());
    let clock = Clock::virtual_time();
    let mut rig = Rig::over(specimen, machine, imperfections, settings, clock, 1)?;
    let trajectory = DepthTrajectory::of(RAMP)?;
    rig.approach(&mut |_| true)?;
    rig.recover(&mut |_| true)?;
    let mut seen = Samples::default();
    rig.press(&trajectory, &mut |sample| {
        seen.time_s.push(sample.time);
        seen.depth_m.push(sample.depth.unwrap_or_default());
        seen.force_n.push(sample.force);
        true
    })?;
    let recording = Recording::new(rig.describe(&trajectory, 1), seen)?;
    let recorded = clean(&recording, &CleanSettings::default())?;

    // The specimen is linear, the fitted law is not.
    let mut settings = CharacterizeSettings::default();
    (settings.laws, settings.draws) = (vec![CandidateLaw::NeoHookean], None);
    let found = characterize(std::slice::from_ref(&recorded), &settings, &mut |_| ());
    let block = "format = 1\norgan = { builtin = \"cube\", builtin_tissue = \"pig-liver\" }";
    let mut block = Scene::parse(block, "block.toml")?;
    block.organ.tissue = scene::TissueChoice::Inline(Box::new(found.tissue(None)?));
    let simulation = Simulation::new(&block)?;
    let tool = &simulation.tools()[0];
    let site = simulation.site(tool, None);
    let motion = site.indented(tool, &recorded.time, &recorded.depth)?;
    let (mut off, mut largest) = (0.0_f64, 0.0_f64);
    play(&simulation, &motion, |frame| -> Result<Flow, Error> {
        let sample = recorded.time.partition_point(|time| *time < frame.time);
        let force = recorded.filtered_force[sample.min(recorded.time.len() - 1)];
        largest = largest.max(force);
        off = off.max((frame.state.tools[0].force.z - force).abs());
        Ok(Flow::Continue)
    })?;
    println!("{:.1} % off at most", 100.0 * off / largest);
    assert!(off < 0.15 * largest);
    Ok(())
}
