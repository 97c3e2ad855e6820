//! Simulations are made with a bar of how far it is, from what was prepared before where there is such.

use palpate_files::Scene;
use palpate_simulate::{Resources, Simulation};

pub(crate) use palpate_jobs::preparation::{resources, resources_with_devices};

use crate::failure::Failure;
use crate::progress::{Progress, Reader};

/// Makes the simulation of `scene`, and tells `reader` how far it is. Ctrl-C breaks it off.
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
