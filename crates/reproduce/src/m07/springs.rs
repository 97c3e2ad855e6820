//! The springs of table 6-2.

use palpate_characterize::lumped::springs_force;
use palpate_files::Estimate;
use palpate_files::tissue::NonlinearSprings;
use palpate_mechanics::finite_elements::indentation::History;

use crate::Error;
use crate::published::cell;

/// The organs of the table.
pub(super) const ORGANS: [&str; 2] = ["liver", "esophagus"];

/// Depths of the loading conditions [mm]: those of figure 5-12.
pub(super) const DEPTHS_MM: [u32; 4] = [2, 4, 6, 8];

/// The printed parameters of `organ`, in their order.
pub(super) fn printed(organ: &str) -> Result<[f64; 8], Error> {
    let mut values = [0.0; 8];
    for (value, name) in values.iter_mut().zip(NonlinearSprings::NAMES) {
        *value = cell(&format!("table-6-2 {organ} {name}"))?;
    }
    Ok(values)
}

/// Forces [N] with these parameters over `course`.
pub(super) fn forces(values: [f64; 8], course: &History) -> Result<Vec<f64>, Error> {
    let springs = NonlinearSprings::of(values.map(Estimate::exactly));
    let forces = springs_force(&springs, &course.times, &course.depths);
    forces.ok_or_else(|| Error::failed("a spring is faster than 1 kHz"))
}
