//! M3, the global model: the boundary elements of table 4-1 and figure 4-2, and the kernels as printed.

mod body;
mod equation_4_3;
mod figure_4_2;
mod growth;
mod pressed;
mod table_4_1;
mod timing;

pub(super) use body::{Body, MODELS};
pub(super) use equation_4_3::EQUATION_4_3;
pub(super) use figure_4_2::FIGURE_4_2;
pub(super) use growth::GROWTH;
pub(super) use pressed::Pressed;
pub(super) use table_4_1::TABLE_4_1;
