//! Progressive cutting (section 7.7): what a blade does to the triangles, and how an opening is seen.

mod figure_7_15;
mod figure_7_16;
mod top;

pub(crate) use figure_7_15::FIGURE_7_15;
pub(crate) use figure_7_16::FIGURE_7_16;
