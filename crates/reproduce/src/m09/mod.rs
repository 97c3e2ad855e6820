//! M9, the hollow organ: the esophagus of section 6.4.5 and figure 7-17.

mod figure_6_15;
mod figure_7_17;
mod indented;
mod organ;
mod section_6_4_5;

pub(super) use figure_6_15::{FIGURE_6_15, nearest_modulus};
pub(super) use figure_7_17::FIGURE_7_17;
pub(super) use indented::{POISSONS_RATIO, at_finite_strain, at_small_strain};
pub(super) use section_6_4_5::SECTION_6_4_5;
