//! Makes simulations with a progress bar, from cached results if there are any.

use palpate_files::Scene;
use palpate_simulate::{Resources, Simulation};

pub(crate) use palpate_jobs::preparation::{resources, resources_with_devices};

use crate::failure::Failure;
use crate::progress::{Progress, Reader};

/// Makes the simulation of `scene`, and reports progress to `reader`. Ctrl-C cancels it.
pub(crate) fn simulation(
    scene: &Scene,
    resources: &Resources,
    reader: Reader,
) -> Result<Simulation, Failure> {
    let bar = Progress::of_parts(reader);
    Ok(palpate_jobs::preparation::simulation(
        scene, resources, &bar,
    )?)
}
