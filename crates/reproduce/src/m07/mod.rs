//! M7, laws without geometry: the tables and figures of sections 6.2 and 6.3.

pub(crate) mod equation_6_3;
pub(crate) mod figure_6_3;
pub(crate) mod figure_6_4;
pub(crate) mod figure_6_5;
mod springs;
pub(crate) mod table_6_1;
pub(crate) mod table_6_2;
