//! Progressive cutting (section 7.7): triangles under a blade, and pictures of an opening.

pub(crate) mod figure_7_15;
pub(crate) mod figure_7_16;
mod top;
