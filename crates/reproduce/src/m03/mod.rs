//! M3, the global model: the boundary elements of table 4-1 and figure 4-2, and the kernels as printed.

mod body;
pub(crate) mod equation_4_3;
pub(crate) mod figure_4_2;
pub(crate) mod growth;
mod pressed;
pub(crate) mod table_4_1;
mod timing;

pub(super) use body::{Body, MODELS};
pub(super) use pressed::Pressed;
