//! Progressive cutting (section 7.7): what a blade does to the triangles, and how an opening is seen.

pub(crate) mod figure_7_15;
pub(crate) mod figure_7_16;
mod top;
