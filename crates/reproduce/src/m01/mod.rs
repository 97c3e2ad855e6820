//! M1, the local model: the hemisphere of chapter 3, indented at the pole.

pub(crate) mod figure_3_3;
pub(crate) mod figure_3_4;
mod pole;
pub(crate) mod table_3_1;
mod timing;
mod uncalibrated;
