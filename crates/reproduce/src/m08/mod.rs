//! M8, characterization with continuum mechanics: the tables and figures of section 6.4.

mod block;
pub(crate) mod equation_6_17;
pub(crate) mod figure_6_11;
pub(crate) mod figure_6_12;
pub(crate) mod figure_6_7;
pub(crate) mod figure_6_8;
pub(crate) mod figure_6_9;
mod full_run;
pub(crate) mod section_6_4_4;
pub(crate) mod section_6_4_6;
mod starts;
pub(crate) mod table_6_3;
pub(crate) mod table_6_4;
mod unbounded;
