//! M7, laws without geometry: the tables and figures of sections 6.2 and 6.3.

mod equation_6_3;
mod figure_6_3;
mod figure_6_4;
mod figure_6_5;
mod springs;
mod table_6_1;
mod table_6_2;

pub(super) use equation_6_3::EQUATION_6_3;
pub(super) use figure_6_3::FIGURE_6_3;
pub(super) use figure_6_4::FIGURE_6_4;
pub(super) use figure_6_5::FIGURE_6_5;
pub(super) use table_6_1::TABLE_6_1;
pub(super) use table_6_2::TABLE_6_2;
