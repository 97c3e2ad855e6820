//! Rendering (section 7.5 and the pictures of sections 3.4 and 4.3), by the adapter of this machine.

mod look;
mod pictures;
mod table_7_1;

pub(crate) use pictures::{FIGURE_3_7, FIGURE_4_7, FIGURE_7_12};
pub(crate) use table_7_1::TABLE_7_1;
