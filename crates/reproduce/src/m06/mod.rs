//! M6, what recordings show without a model: the tables and figures of chapter 5.

mod figure_5_1;
mod figure_5_14;
mod figure_5_15;
mod figure_5_16;
mod printed;
mod swing;
mod table_5_1;

pub(super) use figure_5_1::FIGURE_5_1;
pub(super) use figure_5_14::FIGURE_5_14;
pub(super) use figure_5_15::FIGURE_5_15;
pub(super) use figure_5_16::FIGURE_5_16;
pub(super) use printed::Printed;
pub(super) use table_5_1::TABLE_5_1;
