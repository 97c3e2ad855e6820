//! M8, characterization with continuum mechanics: the tables and figures of section 6.4.

mod block;
mod equation_6_17;
mod figure_6_11;
mod figure_6_12;
mod figure_6_7;
mod figure_6_8;
mod figure_6_9;
mod full_run;
mod section_6_4_4;
mod section_6_4_6;
mod starts;
mod table_6_3;
mod table_6_4;

pub(super) use equation_6_17::{EQUATION_6_17, EQUATION_6_18};
pub(super) use figure_6_7::FIGURE_6_7;
pub(super) use figure_6_8::FIGURE_6_8;
pub(super) use figure_6_9::{FIGURE_6_9, FIGURE_6_10};
pub(super) use figure_6_11::FIGURE_6_11;
pub(super) use figure_6_12::FIGURE_6_12;
pub(super) use section_6_4_4::SECTION_6_4_4;
pub(super) use section_6_4_6::SECTION_6_4_6;
pub(super) use table_6_3::TABLE_6_3;
pub(super) use table_6_4::{TABLE_6_4, TABLE_6_5};
