//! M9, the hollow organ: the esophagus of section 6.4.5 and figure 7-17.

pub(crate) mod figure_6_15;
pub(crate) mod figure_7_17;
mod indented;
mod organ;
pub(crate) mod section_6_4_5;

pub(super) use figure_6_15::nearest_modulus;
pub(super) use indented::{POISSONS_RATIO, at_finite_strain, at_small_strain};
