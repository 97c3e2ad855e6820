//! M6, analysis of recordings without a model: the tables and figures of chapter 5.

pub(crate) mod figure_5_1;
pub(crate) mod figure_5_14;
pub(crate) mod figure_5_15;
pub(crate) mod figure_5_16;
mod printed;
mod swing;
pub(crate) mod table_5_1;

pub(super) use printed::Printed;
