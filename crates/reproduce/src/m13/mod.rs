//! Rendering (section 7.5 and the pictures of sections 3.4 and 4.3), by the adapter of this machine.

pub(crate) mod pictures;
pub(crate) mod table_7_1;
mod visual_measures;
