//! M1, the local model: the hemisphere of chapter 3, indented at the pole.

mod figure_3_3;
mod figure_3_4;
mod plots;
mod pole;
mod table_3_1;
mod timing;
mod uncalibrated;

pub(super) use figure_3_3::FIGURE_3_3;
pub(super) use figure_3_4::FIGURE_3_4;
pub(super) use table_3_1::TABLE_3_1;
