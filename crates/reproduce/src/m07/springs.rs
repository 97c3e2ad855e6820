//! The springs of table 6-2.

use palpate_characterize::lumped::springs_force;
use palpate_files::Estimate;
use palpate_files::tissue::NonlinearSprings;
use palpate_mechanics::finite_elements::indentation::History;

use crate::published::TABLE_6_2;

/// The organs of the table.
pub(super) const ORGANS: [&str; 2] = ["liver", "esophagus"];

/// Depths of the loading conditions [mm]: those of figure 5-12.
pub(super) const DEPTHS_MM: [u32; 4] = [2, 4, 6, 8];

/// The printed parameters of `organ`, in their order.
pub(super) fn printed(organ: &str) -> Option<[f64; 8]> {
    let mut values = [0.0; 8];
    for (value, name) in values.iter_mut().zip(NonlinearSprings::NAMES) {
        *value = TABLE_6_2.value(organ, name)?;
    }
    Some(values)
}

/// Forces [N] with these parameters over `course`.
pub(super) fn forces(values: [f64; 8], course: &History) -> Option<Vec<f64>> {
    let springs = NonlinearSprings::of(values.map(Estimate::exactly));
    springs_force(&springs, &course.times, &course.depths)
}
