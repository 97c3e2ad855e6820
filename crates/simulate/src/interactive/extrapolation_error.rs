use palpate_geometry::Vec3;
use palpate_servo::Sample;

use super::model_loop::pose;
use super::{DevicePlacement, ExtrapolationError};
use crate::{Simulation, SimulationState, SimulationWorkspace, step};

/// The extrapolation error of a tool's servo loop at every tick: replays the `samples` of the device of tool `number`
/// at `mount` at the loop's own rate, and compares the force of each step with the one that the loop made. It takes as
/// long as that many steps.
pub fn measure_extrapolation_error(
    simulation: &Simulation,
    number: usize,
    placement: &DevicePlacement,
    samples: &[Sample],
) -> ExtrapolationError {
    let mut error = ExtrapolationError::default();
    let mut state = SimulationState::new(simulation);
    let mut workspace = SimulationWorkspace::new(simulation);
    let mut poses = vec![None; simulation.tools().len()];
    let mut before = None;
    for sample in samples {
        let time = sample.state.time;
        poses[number] = pose(placement, sample);
        let elapsed = before.map_or(simulation.step(), |before| time - before);
        step(
            simulation,
            time,
            elapsed,
            &poses,
            &mut state,
            &mut workspace,
        );
        before = Some(time);
        // Before the first answer the loop had no force.
        if sample.age.is_some_and(f64::is_finite) {
            error.add(
                &force_on_tool(simulation, placement, sample),
                &state.tools[number].force,
            );
        }
    }
    error
}

/// The force on the tool [N] that a loop made at `sample`, in the scene's frame and unscaled.
pub(super) fn force_on_tool(
    simulation: &Simulation,
    placement: &DevicePlacement,
    sample: &Sample,
) -> Vec3 {
    let of_model = (sample.commanded - sample.added) / simulation.force_scale();
    placement.force_on_tip(&sample.state.position, &of_model)
}
